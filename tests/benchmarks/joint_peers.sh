#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Error against cost of jointed mechanisms, ours beside other programs: tests/benchmarks/joint_peers.sh OUT leaves
# OUT/peers.csv and, drawn by gnuplot, OUT/peers.svg. Build the target `joint_peers` first.
set -eu
bin=$(cd -P -- "$(dirname -- "$0")/../../build/release/bin" && pwd)
out=${1:?"usage: tests/benchmarks/joint_peers.sh OUT"}
mkdir -p -- "$out"
"$bin/joint_peers" > "$out/peers.csv"
gnuplot << GNUPLOT
set terminal svg size 1280,590 font 'sans,13' background 'white'
set output '$out/peers.svg'
set datafile separator ','
set logscale xy
set format x '10^{%L}'
set format y '10^{%L}'
set xlabel 'wall time (s)'
set grid lc rgb '#e4e4e4'
set yrange [1e-14:1]
set key off
series = "'polhode,rk4; projected' 'polhode,rattle' 'polhode,half_explicit4' 'polhode,odeint_fehlberg78; projected' 'polhode,ida_ggl' 'polhode,recipe_ode_step' 'Simbody,Runge-Kutta-Merson' 'MuJoCo,Euler' 'MuJoCo,RK4' 'ODE,dWorldStep' 'ODE,dWorldQuickStep' 'Bullet,sequential impulses; single precision' 'DART,semi-implicit Euler'"
colours = "0072B2 009E73 56B4E9 000000 A0006E 8C510A D55E00 CC79A7 CC79A7 E69F00 E69F00 8C510A 56B4E9"
marks = "7 5 9 13 15 3 4 6 8 6 8 12 10"
mark(s) = int(word(marks, s))
dash(s) = s <= 6 ? 1 : 2
comma(t) = strstrt(t, ',')
label(t) = substr(t, 1, comma(t) - 1).': '.substr(t, comma(t) + 1, strlen(t))
at(what, mechanism) = sprintf("< awk -F'\"' -v OFS= '{ gsub(\", \", \"; \", \$2); print \$1, \$2, \$3 }' '$out/peers.csv' | grep '^%s,%s,'", mechanism, what)
set multiplot
set tmargin at screen 0.92; set bmargin at screen 0.36
titles = "'pendulum, 10 s' 'two four-bars, 4 s' 'ten rods and a heavy ball, 2 s'"
names = "pendulum squares chain"
do for [k = 1:3] {
  set lmargin at screen 0.065 + 0.315 * (k - 1)
  set rmargin at screen 0.065 + 0.315 * (k - 1) + 0.285
  set title word(titles, k)
  if (k == 1) { set ylabel 'position error at the end (m)' } else { unset ylabel; set format y '' }
  plot for [s = 1:words(series)] at(word(series, s), word(names, k)) using 7:8 with linespoints \\
    lc rgb '#'.word(colours, s) pt mark(s) dt dash(s) lw 1.5 ps 0.7
}
unset title; unset xlabel; unset ylabel; unset tics; unset border; unset logscale; unset grid
set tmargin at screen 0.26; set bmargin at screen 0.0; set lmargin at screen 0.02; set rmargin at screen 0.98
set key center center maxrows 7 width 4 samplen 3 noenhanced
set xrange [0:1]; set yrange [0:1]; set format y '%g'
plot for [s = 1:words(series)] NaN with linespoints lc rgb '#'.word(colours, s) pt mark(s) \\
  dt dash(s) lw 1.5 ps 0.7 title label(word(series, s))
unset multiplot
GNUPLOT
