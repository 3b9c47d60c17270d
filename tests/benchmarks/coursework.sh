#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The coursework study (200 runs, 2.7 million steps, energy after every step) through energy_drift, whole process, beside
# the same study written by hand: pairs in turn, the median of the ratios of their processor times.
#   tests/benchmarks/coursework.sh [PRESET] [PAIRS]
set -eu
bin=$(cd -P -- "$(dirname -- "$0")/../.." && pwd)/build/${1:-release}/bin
for program in energy_drift coursework_by_hand; do
  if [ ! -x "$bin/$program" ]; then
    echo "$bin/$program is not there: build it (cmake --build build/${1:-release} --target $program)" >&2
    exit 2
  fi
done
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

study() {
  rm -rf "$out/study"
  "$bin/energy_drift" --scenario coursework --integrator explicit_euler,semi_implicit_euler,explicit_midpoint,rk4 \
    --dt 0.001,0.0016,0.0025,0.004,0.00625,0.01,0.016,0.025,0.04,0.05 --normalize step --t-end 50 --jobs 1 \
    --vary 'body.0.angular_velocity=[0.01,1,0.01];[1,0.01,0.01];[0.01,0.01,1];[0.5,0.5,0.5];[0.3,1,-0.5]' \
    --no-figures --out "$out/study" "$@" >/dev/null
}
TIMEFORMAT='%U %S'
seconds() { { time "$@" >/dev/null; } 2>&1 | awk 'END { print $1 + $2 }'; }

for state in velocity_body velocity_world momentum_world; do
  for _ in $(seq "${2:-7}"); do
    echo "$(seconds study --angular-state $state) $(seconds "$bin/coursework_by_hand")"
  done | sort -n | awk -v s=$state '{ a[NR] = $1; b[NR] = $2; r[NR] = $1 / $2 }
    END { n = asort_(r, NR); printf "%-15s polhode %.3f s, by hand %.3f s, ratio %.2f\n", s, a[int((NR + 1) / 2)], b[int((NR + 1) / 2)], r[int((NR + 1) / 2)] }
    function asort_(x, n,  i, j, t) { for (i = 2; i <= n; ++i) for (j = i; j > 1 && x[j] < x[j - 1]; --j) { t = x[j]; x[j] = x[j - 1]; x[j - 1] = t } return n }'
done
