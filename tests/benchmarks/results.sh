#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Wall times of `results` on a store of a million runs: tests/benchmarks/results.sh [RUNS]. Build `results` and
# `million_runs` first.
set -eu
bin=$(cd -P -- "$(dirname -- "$0")/../../build/release/bin" && pwd)
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
"$bin/million_runs" "$folder/store" "${1:-1000000}"
ls -l "$folder/store" | awk '$NF ~ /results.sqlite$/ { print "store:", $5, "bytes" }'
TIMEFORMAT='  %R s wall, %U s processor'
timed() {
  echo "results $*"
  (cd -- "$folder" && time "$bin/results" store "$@" | tail -n 1)
}
timed
timed --where "integrator == 'rk4' and dt < 0.0002" --limit 10
timed --where "energy_scale_J < 1000 and integrator == 'rk4'" --limit 10
timed --where "body.0.mass == 500" --columns run,dt,body.0.mass --limit 10
timed --sort -energy_scale_J --limit 10
timed --group integrator --show count,median:energy_scale_J
timed --format csv --out all.csv
