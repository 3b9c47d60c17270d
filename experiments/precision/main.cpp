// SPDX-License-Identifier: BSD-3-Clause
// Where does rounding take over from truncation, how does it grow, and what does compensated summation save?
#include "experiments/precision/rounding.hpp"
#include "experiments/study/study.hpp"

int main(int argc, char** argv) {
  return polhode::study::run_experiment(
      {.name = "precision",
       .question = "Where does rounding take over from truncation, how does it grow, and what does compensated "
                   "summation save?",
       .defaults = {{"scenario", "dyadic_top"},
                    {"integrator", "explicit_midpoint,rk4,odeint_adams_bashforth_moulton"},
                    {"angular-state", "velocity_body"},
                    {"precision", "float,double,long_double"},
                    {"summation", "plain,compensated"},
                    {"dt", "0.125,0.0625,0.03125,0.015625,0.0078125,0.00390625,0.001953125,0.0009765625"},
                    {"tolerance", "1e-3,1e-4,1e-5,1e-6,1e-7,1e-8,1e-9,1e-10,1e-11,1e-12"},
                    {"t-end", "256"},
                    {"samples", "128"}},
       .vary = {{"body.0.angular_velocity.2", "0.5:0.84375:12"}},
       .curves_are_results = true,
       .analysis = polhode::study::precision::rounding_and_truncation,
       .needs = {.figures = 2}},
      argc, argv);
}
