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
IntegratorEntry arkode_erk();
IntegratorEntry arkode_dirk();
IntegratorEntry odeint_rk4();
IntegratorEntry odeint_adams_bashforth_moulton();
IntegratorEntry odeint_cash_karp54();
IntegratorEntry odeint_dopri5();
IntegratorEntry odeint_fehlberg78();
IntegratorEntry odeint_bulirsch_stoer();
IntegratorEntry odeint_rosenbrock4();

const std::vector<IntegratorEntry>& integrator_catalogue() {
  static const std::vector<IntegratorEntry> entries = {
      explicit_euler(),
      semi_implicit_euler(),
      explicit_midpoint(),
      rk4(),
      cvode_adams(),
      cvode_bdf(),
      arkode_erk(),
      arkode_dirk(),
      odeint_rk4(),
      odeint_adams_bashforth_moulton(),
      odeint_cash_karp54(),
      odeint_dopri5(),
      odeint_fehlberg78(),
      odeint_bulirsch_stoer(),
      odeint_rosenbrock4(),
  };
  return entries;
}

const IntegratorEntry* find_integrator(std::string_view name) {
  const auto& all = integrator_catalogue();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.declaration.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace polhode
