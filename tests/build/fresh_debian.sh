#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Does the checkout build from nothing? Makes a minimal Debian 12 with git and ca-certificates alone, clones the last
# commit into it, and times `./run` and `./test` there. Needs root and debootstrap; not part of ./test, for it
# downloads some hundred packages.
#
#   tests/build/fresh_debian.sh [DIRECTORY]
#
# DIRECTORY (it must not exist) is kept for a look around; without it a temporary one is removed at the end. The bare
# system is kept as ${POLHODE_CHROOT_CACHE:-/tmp/polhode-chroot}/base.tar, from which the next run starts.
set -euo pipefail
checkout=$(cd -P -- "$(dirname -- "$0")/../.." && pwd)
cache=${POLHODE_CHROOT_CACHE:-/tmp/polhode-chroot}

if [ $# -gt 0 ]; then
  mkdir -- "$1"
  target=$(cd -P -- "$1" && pwd)
else
  target=$(mktemp -d "${TMPDIR:-/tmp}/fresh-debian.XXXXXX")
fi
chmod 755 "$target"
clean_up() {
  if mountpoint -q "$target/proc"; then umount "$target/proc"; fi
  if [ "$#" = 0 ]; then rm -rf --one-file-system "$target"; fi
}
trap 'clean_up "$@"' EXIT
trap 'exit 130' INT TERM

phase() { # phase NAME COMMAND ...: runs it and says how long it took and how it ended
  local name=$1 started status=0
  shift
  printf '== %s\n' "$name"
  started=$(date +%s%N)
  "$@" || status=$?
  printf '== %s: %d.%02d s, status %d\n' "$name" $((($(date +%s%N) - started) / 1000000000)) \
    $((($(date +%s%N) - started) / 10000000 % 100)) "$status"
  return "$status"
}

# The Debian mirror that this machine's apt uses.
mirror_of() { apt-get indextargets --format '$(REPO_URI) $(CODENAME)' 'Created-By: Packages' 'Origin: Debian' |
  awk -v release="$1" '$2 == release { print $1; exit }'; }

make_base() {
  local mirror
  mirror=$(mirror_of bookworm)
  debootstrap --variant=minbase bookworm "$target" "${mirror:-http://deb.debian.org/debian/}"
  apt-get indextargets --format 'deb $(REPO_URI) $(CODENAME) $(COMPONENT)' 'Created-By: Packages' 'Origin: Debian' |
    grep ' bookworm' | sort -u >"$target/etc/apt/sources.list"
  echo 'Dpkg::Use-Pty "0";' >"$target/etc/apt/apt.conf.d/99chroot"
  # Proxies, and whether this machine's apt minds an old mirror.
  apt-config dump | grep -E '^Acquire::([a-z]+::)?(Proxy|Check-Valid-Until|Check-Date)' \
    >>"$target/etc/apt/apt.conf.d/99chroot" || true
  mkdir -p "$cache"
  tar -C "$target" --one-file-system -cf "$cache/base.tar.new" .
  mv "$cache/base.tar.new" "$cache/base.tar"
}

inside() { # inside [--user NAME] COMMAND ...: in the new system, in an empty folder of its own
  local user=root:root
  if [ "$1" = --user ]; then
    user=$2
    shift 2
  fi
  chroot --userspec="$user" "$target" /usr/bin/env HOME=/tmp LC_ALL=C.UTF-8 \
    sh -c 'cd "/srv/some where" && exec "$@"' sh "$@"
}

if [ -f "$cache/base.tar" ]; then
  phase "unpack the base system" tar -C "$target" -xf "$cache/base.tar"
else
  phase "debootstrap" make_base
fi
cp /etc/resolv.conf /etc/hosts "$target/etc/"
mount -t proc proc "$target/proc"

place="/srv/pol hode" # a space, to see that nothing minds
mkdir "$target/srv/some where"
chmod 777 "$target/srv/some where"
phase "install git" inside sh -c \
  'apt-get -q update && apt-get -q -y install --no-install-recommends git ca-certificates' >"$target/install-git.log" 2>&1
phase "clone" git clone -q --no-hardlinks "$checkout" "$target$place"

printf '== without root and without sudo, in one line:\n'
refusal=$(inside --user nobody:nogroup "$place/run" 2>&1) && exit 1
printf '%s\n' "$refusal"
[[ $refusal == "run: missing packages"*libeigen3-dev* && $(wc -l <<<"$refusal") == 1 ]]

phase "first ./run energy_drift --list (install, build, run)" inside "$place/run" energy_drift --list
phase "second ./run energy_drift --list" inside "$place/run" energy_drift --list
phase "./run (the default study)" inside "$place/run"
phase "./run again" inside "$place/run"
phase "./test" inside "$place/test"
