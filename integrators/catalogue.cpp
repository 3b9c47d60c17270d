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
IntegratorEntry symmetric_rotor2();
IntegratorEntry symmetric_rotor4();
IntegratorEntry no_squish();
IntegratorEntry exact_rotor();
IntegratorEntry mclachlan_reich_yoshida4();
IntegratorEntry mclachlan_reich_suzuki4();
IntegratorEntry mclachlan_reich_kahan_li6();
IntegratorEntry exact_rotor_yoshida4();
IntegratorEntry exact_rotor_suzuki4();
IntegratorEntry exact_rotor_kahan_li6();
IntegratorEntry implicit_midpoint();
IntegratorEntry gauss4();
IntegratorEntry gauss6();

const std::vector<IntegratorEntry>& integrator_catalogue() {
  static const std::vector<IntegratorEntry> entries = {
      explicit_euler(), semi_implicit_euler(), explicit_midpoint(), rk4(),
      cvode_adams(),    cvode_bdf(),           odeint_dopri5(),
      mclachlan_reich(),
      dmv(),
      dmv4(),
      dmv6(),
      symmetric_rotor2(),
      symmetric_rotor4(),
      no_squish(),
      exact_rotor(),
      mclachlan_reich_yoshida4(),
      mclachlan_reich_suzuki4(),
      mclachlan_reich_kahan_li6(),
      exact_rotor_yoshida4(),
      exact_rotor_suzuki4(),
      exact_rotor_kahan_li6(),
      implicit_midpoint(),
      gauss4(),
      gauss6(),
  };
  return entries;
}

const IntegratorEntry* find_integrator(std::string_view name) {
  const auto& all = integrator_catalogue();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.declaration.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace polhode
