// SPDX-License-Identifier: BSD-3-Clause
// How wrong are energy, momentum and the time of an impact, for each method, timing and response?
#include "experiments/impact/impacts.hpp"
#include "experiments/study/study.hpp"

int main(int argc, char** argv) {
  return polhode::study::run_experiment(
      {.name = "impact",
       .question = "How wrong are energy, momentum and the time of an impact, for each method, timing and response?",
       .defaults = {{"scenario", "tumbling_cube,spinning_cubes"},
                    {"integrator", "semi_implicit_euler,explicit_midpoint,rk4"},
                    {"dt", "0.064,0.032,0.016,0.008,0.004,0.002,0.001"},
                    {"tolerance", "1e-6,1e-8,1e-10"},
                    {"t-end", "2"},
                    {"response", "single_impulse,sequential_impulses,simultaneous"},
                    {"impact-timing", "time_stepping,time_stepping_free_end,event_located"}},
       .refine = polhode::study::impact::exact_impacts,
       .analysis_alone = true,
       .analysis = polhode::study::impact::errors_of_impacts,
       .needs = {.figures = 2}},
      argc, argv);
}
