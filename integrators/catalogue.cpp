// SPDX-License-Identifier: BSD-3-Clause
#include "integrators/catalogue.hpp"

#include <algorithm>

namespace polhode {

// One line declares a method (it stands in the file of its name), one line lists it.
IntegratorEntry explicit_euler();
IntegratorEntry semi_implicit_euler();
IntegratorEntry semi_implicit_euler_exp();
IntegratorEntry explicit_midpoint();
IntegratorEntry heun();
IntegratorEntry velocity_verlet();
IntegratorEntry rk4();
IntegratorEntry lie_euler();
IntegratorEntry crouch_grossman3();
IntegratorEntry rkmk4();
IntegratorEntry commutator_free4();
IntegratorEntry buss2();
IntegratorEntry lie_midpoint();
IntegratorEntry simo_wong();
IntegratorEntry recipe_ode();
IntegratorEntry recipe_bullet();
IntegratorEntry recipe_simbody();
IntegratorEntry cvode_adams();
IntegratorEntry cvode_bdf();
IntegratorEntry odeint_dopri5();

const std::vector<IntegratorEntry>& integrator_catalogue() {
  static const std::vector<IntegratorEntry> entries = {
      explicit_euler(), semi_implicit_euler(), semi_implicit_euler_exp(), explicit_midpoint(), heun(),
      velocity_verlet(), rk4(),
      lie_euler(), crouch_grossman3(), rkmk4(), commutator_free4(), buss2(), lie_midpoint(), simo_wong(),
      recipe_ode(), recipe_bullet(), recipe_simbody(),
      cvode_adams(), cvode_bdf(), odeint_dopri5(),
  };
  return entries;
}

const IntegratorEntry* find_integrator(std::string_view name) {
  const auto& all = integrator_catalogue();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.declaration.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace polhode
