// SPDX-License-Identifier: BSD-3-Clause
#include "integrators/catalogue.hpp"

#include "core/problem/catalogue.hpp"

// One line for each method. The function with the name of the method declares it, in the file with that name or with
// the name of its family.
#define POLHODE_INTEGRATORS(METHOD) \
  METHOD(explicit_euler) \
  METHOD(semi_implicit_euler) \
  METHOD(semi_implicit_euler_exp) \
  METHOD(explicit_midpoint) \
  METHOD(heun) \
  METHOD(velocity_verlet) \
  METHOD(rk4) \
  METHOD(lie_euler) \
  METHOD(crouch_grossman3) \
  METHOD(rkmk4) \
  METHOD(commutator_free4) \
  METHOD(buss2) \
  METHOD(lie_midpoint) \
  METHOD(simo_wong) \
  METHOD(implicit_midpoint) \
  METHOD(gauss4) \
  METHOD(gauss6) \
  METHOD(dmv) \
  METHOD(dmv4) \
  METHOD(dmv6) \
  METHOD(mclachlan_reich) \
  METHOD(mclachlan_reich_yoshida4) \
  METHOD(mclachlan_reich_suzuki4) \
  METHOD(mclachlan_reich_kahan_li6) \
  METHOD(symmetric_rotor2) \
  METHOD(symmetric_rotor4) \
  METHOD(no_squish) \
  METHOD(exact_rotor) \
  METHOD(exact_rotor_yoshida4) \
  METHOD(exact_rotor_suzuki4) \
  METHOD(exact_rotor_kahan_li6) \
  METHOD(recipe_ode) \
  METHOD(recipe_bullet) \
  METHOD(recipe_simbody) \
  METHOD(recipe_bullet_joints) \
  METHOD(recipe_ode_step) \
  METHOD(recipe_ode_quickstep) \
  METHOD(recipe_dart_joints) \
  METHOD(recipe_box2d_soft_step) \
  METHOD(shake) \
  METHOD(rattle) \
  METHOD(shake_lie) \
  METHOD(rattle_lie) \
  METHOD(generalized_alpha_index3) \
  METHOD(generalized_alpha_index2) \
  METHOD(half_explicit4) \
  METHOD(cvode_adams) \
  METHOD(cvode_bdf) \
  METHOD(arkode_erk) \
  METHOD(arkode_dirk) \
  METHOD(ida_index1) \
  METHOD(ida_index2) \
  METHOD(ida_index3) \
  METHOD(ida_ggl) \
  METHOD(ida_ah) \
  METHOD(odeint_rk4) \
  METHOD(odeint_adams_bashforth_moulton) \
  METHOD(odeint_cash_karp54) \
  METHOD(odeint_dopri5) \
  METHOD(odeint_fehlberg78) \
  METHOD(odeint_bulirsch_stoer) \
  METHOD(odeint_rosenbrock4)

namespace polhode::inline integrators {

POLHODE_CATALOGUE(IntegratorEntry, integrator_catalogue, POLHODE_INTEGRATORS)

const IntegratorEntry* find_integrator(std::string_view name) {
  return find_entry(integrator_catalogue(), name,
                    [](const auto& entry) -> std::string_view { return entry.declaration.name; });
}

}  // namespace polhode::integrators
