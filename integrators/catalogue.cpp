// SPDX-License-Identifier: BSD-3-Clause
#include "integrators/catalogue.hpp"

#include <algorithm>

namespace polhode {

// One line declares a method (it stands in the file of its name), one line lists it.
IntegratorEntry explicit_euler();
IntegratorEntry semi_implicit_euler();
IntegratorEntry explicit_midpoint();
IntegratorEntry rk4();
IntegratorEntry cvode_adams();
IntegratorEntry cvode_bdf();
IntegratorEntry odeint_dopri5();
IntegratorEntry mclachlan_reich();
IntegratorEntry dmv();
IntegratorEntry dmv4();
IntegratorEntry dmv6();

const std::vector<IntegratorEntry>& integrator_catalogue() {
  static const std::vector<IntegratorEntry> entries = {
      explicit_euler(), semi_implicit_euler(), explicit_midpoint(), rk4(),
      cvode_adams(),    cvode_bdf(),           odeint_dopri5(),
      mclachlan_reich(),
      dmv(),
      dmv4(),
      dmv6(),
  };
  return entries;
}

const IntegratorEntry* find_integrator(std::string_view name) {
  const auto& all = integrator_catalogue();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.declaration.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace polhode
