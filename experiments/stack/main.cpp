// SPDX-License-Identifier: BSD-3-Clause
// How long does a stack of boxes stand, how deep do they sink into each other, and what becomes of the energy?
#include "experiments/stack/standing.hpp"
#include "experiments/study/study.hpp"

int main(int argc, char** argv) {
  return polhode::study::run_experiment(
      {.name = "stack",
       .question = "How long does a stack of boxes stand, how deep do they sink into each other, and what becomes of "
                   "the energy?",
       .defaults = {{"scenario", "stack"},
                    {"integrator", "semi_implicit_euler"},
                    {"dt", "0.00833333333333333,0.0166666666666667,0.0333333333333333"},
                    {"response", "sequential_impulses,single_impulse"}},
       .vary = {{"body.box.repeat", "[1,1,2];[1,1,3];[1,1,5];[1,1,10];[1,1,15];[1,1,20]"}},
       // The computing time of this response grows as the cube of the number of contacts.
       .more = {{.defaults = {{"response", "simultaneous"}},
                 .vary = {{"body.box.repeat", "[1,1,2];[1,1,3]"}},
                 .by_default_only = true}},
       .analysis_alone = true,
       .analysis = polhode::study::stack::how_stacks_stand,
       .needs = {.figures = 1}},
      argc, argv);
}
