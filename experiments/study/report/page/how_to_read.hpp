// SPDX-License-Identifier: BSD-3-Clause
// Explanation of the numbers and figures of report.html, shown in a box of the page.
#pragma once

#include <string_view>

namespace polhode::study::inline report::inline page {

inline constexpr std::string_view how_to_read = R"html(<details class="box" id="reading">
<summary>How to read this: what the numbers and figures are</summary>
<dl>
<dt>Energy drift</dt>
<dd>Energy is a ledger: kinetic + potential − work of non-conservative forces + energy lost in contact − energy injected by projection.
Its drift is what the ledger cannot explain. It is relative to the energy scale of the motion: the largest kinetic energy or
change of potential energy along the true motion, or what the scenario fixes. All runs of a scenario and a duration share that
scale, whatever the origin and the zero of the potential. A positive drift is energy that the method made.</dd>
<dt>Drift rate, class of the drift</dt>
<dd>The rate is the slope of a straight line by least squares. The exponent p of |drift| ∝ t<sup>p</sup> is what is left
when oscillations are set aside: bounded (p below ¼), random walk (below ¾, rounding errors
have ½; sublinear where the drift goes one way), linear (below 1½),
quadratic (below 2½), faster. The intervals hold the truth in 95 of 100 cases; where one reaches into another class, or an
oscillation is too slow for the run, the class is undecided, with the duration that would decide. Round-off: the drift never
passes what rounding can add up to. Saturated: it rests at the size of the energy itself. Jumps: it changes at impacts alone.</dd>
<dt>Momentum drift</dt>
<dd>The size of the change of the momentum vector, relative to the largest sum of the sizes of the bodies’ momenta along the true
motion; only where the forces conserve it.</dd>
<dt>Orientation defect</dt>
<dd>How far the stored numbers are from a rotation: ||q| − 1| of a quaternion, the Frobenius norm of RᵀR − 1
of a matrix.</dd>
<dt>Attitude error</dt>
<dd>The angle between the exact and the computed attitude, where an exact solution is known. With <span class="nowrap">--reference</span> a
motion in extended precision stands in for it elsewhere, where that proves its digits.</dd>
<dt>Along the polhode and off it</dt>
<dd>The momentum of a free body goes round in the body on its polhode, the curve of constant energy and |L|. How far the
computed one is early or late there is an error of phase (in s); its distance from the curve, over |L|, is an error of
shape, which no shift in time repairs: energy or |L| are no longer those of the start.</dd>
<dt>Against time</dt>
<dd>Long runs are thinned: each point stands for a stretch of the run and holds the largest value in it. The
vertical axis is logarithmic on both sides of zero and linear about it, so that signs and many orders of
magnitude are seen at once.</dd>
<dt>Slope</dt>
<dd>p in drift ∝ step<sup>p</sup>: a straight line fitted by least squares to the logarithms of completed runs
whose value is ten times round-off and below 0.5 (rad, or relative), from the smallest step on as long as the points
stay on one line. Where fewer than three are left, or they scatter, the data tell no order, and the page says why. The
declared order is that of the motion’s error; an invariant may drift by a higher power.</dd>
<dt>Round-off</dt>
<dd>A value below 16 ε √steps, what rounding errors alone may add up to (ε = 2.2e-16 in double
precision). Of the energy, the same of the terms that were added, not of their difference: energy_round_off_J in runs.csv.</dd>
<dt>– in a table</dt>
<dd>Not defined for that run: no exact solution is known and no reference proves digits enough, the forces do
not conserve that momentum, or the run ended too early.</dd>
</dl>
</details>
)html";

}  // namespace polhode::study::report::page
