# SPDX-License-Identifier: BSD-3-Clause
# What `run`, `test` and `.ci/run` share: install, configure, build. Sourced by bash with $root (the checkout) set.
# All that these functions print goes to stderr, so that stdout is the program's own.

say() { printf '%s: %s\n' "${0##*/}" "$*" >&2; }

# install_packages [PROGRAM]: what is missing of packages.txt, and of the own list of the program, or of the guide, where it
# has one; touches apt only if something is.
install_packages() {
  command -v dpkg-query >/dev/null || return 0 # not a Debian: CMake will name what it cannot find
  local wanted have missing as_root started=$SECONDS lists=("$root/packages.txt") own
  for own in "$root/experiments/${1:-}/packages.txt" "$root/${1:-}/packages.txt"; do
    [ -z "${1:-}" ] || [ ! -f "$own" ] || lists+=("$own")
  done
  wanted=$(sed 's/#.*//' "${lists[@]}" | tr -s '[:space:]' '\n')
  have=$(dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' $wanted 2>/dev/null | sed -n 's/^.i *//p') || true
  missing=$(printf '%s\n' $wanted | grep -vxF "$have" | tr '\n' ' ') || true
  [ -n "$missing" ] || return 0

  as_root=
  if [ "$(id -u)" != 0 ]; then
    if ! command -v sudo >/dev/null; then
      say "missing packages, and neither root nor sudo to install them: apt-get install $missing"
      exit 1
    fi
    as_root=sudo
  fi
  say "installing $missing"
  if ! { $as_root apt-get update -q && $as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends $missing; } >&2; then
    say "could not install $missing"
    exit 1
  fi
  rm -f "$root"/build/*/configured # CMake looks again for what it did not find
  say "installed in $((SECONDS - started)) s"
}

# configure PRESET [CMake arguments]: only if the preset was not configured yet, or the presets changed since, or the
# checkout was moved, or there are arguments. (A changed CMakeLists.txt is the build's own business.)
configure() {
  local preset=$1 folder="$root/build/$1"
  shift
  if [ $# = 0 ] && [ "$folder/configured" -nt "$root/CMakePresets.json" ] &&
    grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
    return
  fi
  mkdir -p "$folder"
  say "configuring build/$preset"
  if ! (cd "$root" && cmake --fresh --preset "$preset" "$@") >"$folder/configure.log" 2>&1; then
    cat "$folder/configure.log" >&2
    exit 1
  fi
  touch "$folder/configured"
}

# is_target FOLDER TARGET: whether the build that is configured in the folder knows the target.
is_target() {
  cmake --build "$1" --target help 2>/dev/null | grep -qE "^(\.\.\. )?$2(:| |\$)"
}

# build PRESET [TARGET ...]: says nothing when there is nothing to do. One build at a time in a checkout. A target that the
# build does not know is one whose packages were not there when it was configured: CMake looks for them again.
build() {
  local preset=$1 folder="$root/build/$1" chatter='Re-checking globbed directories|Asking git for the commit|no work to do'
  local target
  shift
  for target in "$@"; do
    [ ! -x "$folder/bin/$target" ] && ! is_target "$folder" "$target" || continue
    rm -f "$folder/configured"
    configure "$preset"
    is_target "$folder" "$target" && continue
    say "$target cannot be built: CMake does not find what it needs, see build/$preset/configure.log"
    exit 1
  done
  exec 9>"$root/build/lock"
  flock 9
  if ! (set -o pipefail
    cmake --build "$folder" ${1:+--target "$@"} 2>&1 | { grep -vE --line-buffered "$chatter" >&2 || true; }); then
    say "the build failed"
    exit 1
  fi
  exec 9>&-
}
