// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/method_style.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace polhode::study::inline plot {
namespace {

struct NamedStyle {
  std::string_view method;
  MethodStyle style;
};

// Colour, marker and dash of each method, in the catalogue's order. The nine methods of the default study have nine
// colours, nine markers and solid lines; the methods of a family have different colours and markers. A method that is
// not here takes a style that is free; a row fixes it for all studies.
constexpr std::array style_table = {
    NamedStyle{"explicit_euler", {0, 0, 0}},
    NamedStyle{"semi_implicit_euler", {1, 1, 0}},
    NamedStyle{"semi_implicit_euler_exp", {4, 7, 4}},
    NamedStyle{"explicit_midpoint", {2, 2, 0}},
    NamedStyle{"heun", {5, 6, 1}},
    NamedStyle{"velocity_verlet", {6, 4, 3}},
    NamedStyle{"rk4", {3, 3, 0}},
    NamedStyle{"lie_euler", {7, 0, 2}},
    NamedStyle{"crouch_grossman3", {2, 6, 3}},
    NamedStyle{"rkmk4", {1, 7, 1}},
    NamedStyle{"commutator_free4", {8, 8, 1}},
    NamedStyle{"buss2", {0, 9, 4}},
    NamedStyle{"lie_midpoint", {4, 4, 0}},
    NamedStyle{"simo_wong", {3, 5, 3}},
    NamedStyle{"implicit_midpoint", {6, 8, 3}},
    NamedStyle{"gauss4", {7, 6, 4}},
    NamedStyle{"gauss6", {1, 9, 0}},
    NamedStyle{"dmv", {5, 5, 0}},
    NamedStyle{"dmv4", {0, 1, 1}},
    NamedStyle{"dmv6", {8, 0, 1}},
    NamedStyle{"mclachlan_reich", {4, 9, 2}},
    NamedStyle{"mclachlan_reich_yoshida4", {3, 8, 4}},
    NamedStyle{"mclachlan_reich_suzuki4", {0, 5, 4}},
    NamedStyle{"mclachlan_reich_kahan_li6", {6, 3, 2}},
    NamedStyle{"symmetric_rotor2", {7, 1, 3}},
    NamedStyle{"symmetric_rotor4", {5, 7, 2}},
    NamedStyle{"no_squish", {8, 4, 2}},
    NamedStyle{"exact_rotor", {1, 2, 3}},
    NamedStyle{"exact_rotor_yoshida4", {4, 5, 1}},
    NamedStyle{"exact_rotor_suzuki4", {0, 3, 3}},
    NamedStyle{"exact_rotor_kahan_li6", {3, 9, 3}},
    NamedStyle{"recipe_ode", {5, 8, 2}},
    NamedStyle{"recipe_bullet", {2, 3, 4}},
    NamedStyle{"recipe_simbody", {8, 9, 1}},
    NamedStyle{"recipe_bullet_joints", {2, 12, 0}},
    NamedStyle{"recipe_ode_step", {5, 12, 1}},
    NamedStyle{"recipe_ode_quickstep", {7, 12, 2}},
    NamedStyle{"recipe_dart_joints", {4, 12, 3}},
    NamedStyle{"recipe_box2d_soft_step", {8, 12, 4}},
    NamedStyle{"shake", {0, 10, 0}},
    NamedStyle{"rattle", {1, 11, 0}},
    NamedStyle{"shake_lie", {2, 10, 1}},
    NamedStyle{"rattle_lie", {3, 11, 1}},
    NamedStyle{"generalized_alpha_index3", {5, 2, 1}},
    NamedStyle{"generalized_alpha_index2", {4, 6, 2}},
    NamedStyle{"half_explicit4", {6, 10, 4}},
    NamedStyle{"cvode_adams", {6, 6, 0}},
    NamedStyle{"cvode_bdf", {7, 8, 0}},
    NamedStyle{"arkode_erk", {4, 2, 2}},
    NamedStyle{"arkode_dirk", {0, 7, 3}},
    NamedStyle{"ida_index1", {1, 10, 2}},
    NamedStyle{"ida_index2", {2, 11, 2}},
    NamedStyle{"ida_index3", {3, 0, 3}},
    NamedStyle{"ida_ggl", {5, 10, 3}},
    NamedStyle{"ida_ah", {8, 11, 3}},
    NamedStyle{"odeint_rk4", {2, 4, 1}},
    NamedStyle{"odeint_adams_bashforth_moulton", {3, 2, 4}},
    NamedStyle{"odeint_cash_karp54", {7, 5, 2}},
    NamedStyle{"odeint_dopri5", {8, 7, 0}},
    NamedStyle{"odeint_fehlberg78", {1, 3, 1}},
    NamedStyle{"odeint_bulirsch_stoer", {4, 1, 2}},
    NamedStyle{"odeint_rosenbrock4", {5, 0, 4}},
};

// The same for the broad and narrow phases, which stand in figures without methods.
constexpr std::array phase_table = {
    NamedStyle{"all_pairs", {0, 0, 0}},    NamedStyle{"sweep_and_prune", {1, 1, 0}},
    NamedStyle{"uniform_grid", {2, 2, 0}}, NamedStyle{"quadtree", {3, 3, 0}},
    NamedStyle{"octree", {4, 4, 0}},       NamedStyle{"bvh", {5, 5, 0}},
    NamedStyle{"bsp_tree", {6, 6, 0}},     NamedStyle{"sat", {0, 0, 0}},
    NamedStyle{"gjk", {1, 1, 0}},          NamedStyle{"sat_course_report", {2, 2, 0}},
};

bool shares(const MethodStyle& a, const MethodStyle& b) {
  return a.marker == b.marker && (a.colour == b.colour || a.dash == b.dash);
}

/// Styles that are unlike those of the table and each other; then all others, so that there are as many as needed.
std::vector<MethodStyle> free_styles(std::size_t number) {
  std::vector<MethodStyle> taken, found;
  for (const NamedStyle& row : style_table) taken.push_back(row.style);
  for (const bool unlike : {true, false}) {
    for (std::size_t dash = 0; dash < style::dashes.size(); ++dash) {
      for (std::size_t marker = 0; marker < style::markers.size(); ++marker) {
        for (std::size_t colour = 0; colour < style::colours.size() && found.size() < number; ++colour) {
          const MethodStyle one{colour, marker, dash};
          const auto like = [&](const MethodStyle& other) { return unlike ? shares(one, other) : one == other; };
          if (std::any_of(taken.begin(), taken.end(), like)) continue;
          taken.push_back(one);
          found.push_back(one);
        }
      }
    }
  }
  while (found.size() < number) found.push_back(taken[found.size() % taken.size()]);
  return found;
}

const NamedStyle* row_of(const std::string& name) {
  const auto found =
      std::find_if(style_table.begin(), style_table.end(), [&](const auto& row) { return row.method == name; });
  return found == style_table.end() ? nullptr : &*found;
}

}  // namespace

std::vector<MethodStyle> styles_of(const std::vector<std::string>& names) {
  const bool methods =
      std::any_of(names.begin(), names.end(), [](const auto& name) { return row_of(name) != nullptr; });
  const auto free = free_styles(names.size());
  std::vector<MethodStyle> styles;
  std::size_t unknown = 0;
  for (const std::string& name : names) {
    const NamedStyle* row = row_of(name);
    const auto phase =
        std::find_if(phase_table.begin(), phase_table.end(), [&](const auto& r) { return r.method == name; });
    if (row == nullptr && !methods && phase != phase_table.end()) row = &*phase;
    if (row == nullptr && !methods && unknown < style::colours.size()) {
      styles.push_back({unknown, unknown, 0});
      ++unknown;
    } else {
      styles.push_back(row != nullptr ? row->style : free[unknown++]);
    }
  }
  return styles;
}

std::string html_colour(const MethodStyle& style) { return "#" + std::string(style::colours[style.colour]); }

}  // namespace polhode::study::plot
