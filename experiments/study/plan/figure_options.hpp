// SPDX-License-Identifier: BSD-3-Clause
// Options that choose figures and their look, shared by all programs that draw.
#pragma once

#include <span>
#include <string_view>

#include "experiments/study/plot/figure_choice.hpp"

namespace CLI {
class App;
class Option;
}

namespace polhode::study::inline plan {

struct FigureName {
  std::string_view name, shows;
};

/// The figures of every study.
std::span<const FigureName> figure_names();

/// Adds --figure-width, --figure-font, --figure-title and --figure-language.
void add_look_options(CLI::App& app, Look& look);

/// Adds --figure and these. `closed`: there are no figures but figure_names();
/// otherwise an experiment's analysis has further ones. `excludes`: an option that cannot be given with --figure.
void add_figure_options(CLI::App& app, FigureChoice& choice, bool closed, CLI::Option* excludes);

}  // namespace polhode::study::plan
