// SPDX-License-Identifier: BSD-3-Clause
// Options that choose figures and their look, shared by all programs that draw.
#pragma once

#include <span>
#include <string_view>

#include "experiments/study/plot/figure_choice.hpp"
#include "experiments/study/text/command_line.hpp"

namespace polhode::study::inline plan {

struct FigureName {
  std::string_view name, shows;
};

/// The figures of every study.
std::span<const FigureName> figure_names();

/// Adds --figure-width, --figure-font, --figure-title and --figure-language.
void add_look_options(CommandLine& line, FigureLook& look);

/// Adds --figure and these. `closed`: there are no figures but figure_names();
/// otherwise an experiment's analysis has further ones. `excludes`: an option that cannot be given with --figure.
void add_figure_options(CommandLine& line, FigureChoice& choice, bool closed, const CommandLineOption* excludes);

}  // namespace polhode::study::plan
