// SPDX-License-Identifier: BSD-3-Clause
#include "integrators/compensated.hpp"

#include <stdexcept>

#include "integrators/shifted_system.hpp"

namespace polhode::inline integrators {
namespace {

/// sum ← fl(sum + carried + addend); carried ← the round-off of that sum.
template <class S>
void add(S& sum, S& carried, S addend) {
  const S a = addend + carried;
  const S total = sum + a;
  const S taken = total - sum;
  carried = (sum - (total - taken)) + (a - taken);
  sum = total;
}

template <class S>
class Compensated final : public Integrator<S> {
 public:
  Compensated(const IncrementMaker<S>& make, const System<S>& system, const IntegratorSettings& settings)
      : shifted_(system),
        increment_{0, shifted_.zero()},
        carried_(shifted_.zero()),
        method_(make(shifted_, settings)) {}

  void begin(const State<S>& state) override {
    carried_.setZero();
    look_from(state);
    method_->begin(increment_);
  }

  StepResult step(State<S>& state, double h) override {
    look_from(state);
    StepResult result = method_->step(increment_, h);
    if (!result.ok()) return result;
    for (Eigen::Index i = 0; i < state.y.size(); ++i) add(state.y[i], carried_[i], increment_.y[i]);
    state.t = increment_.t;
    return result;
  }

  std::int64_t evaluations() const override { return method_->evaluations(); }
  std::optional<std::int64_t> iterations() const override { return method_->iterations(); }

  void discard_history(const State<S>& state) override {
    carried_.setZero();
    look_from(state);
    method_->discard_history(increment_);
  }

 private:
  void look_from(const State<S>& state) {
    shifted_.stand_at(state.y);
    increment_.t = state.t;
    increment_.y.setZero();
  }

  ShiftedSystem<S> shifted_;
  State<S> increment_;
  VectorX<S> carried_;
  IntegratorPointer<S> method_;
};

}  // namespace

template <class S>
IntegratorPointer<S> make_compensated(const IntegratorEntry& entry, const System<S>& system,
                                      const IntegratorSettings& settings) {
  if (!entry.declaration.additive) throw std::invalid_argument(entry.declaration.name + " is not additive");
  return std::make_unique<Compensated<S>>(entry.increment<S>(), system, settings);
}

template IntegratorPointer<float> make_compensated(const IntegratorEntry&, const System<float>&,
                                                   const IntegratorSettings&);
template IntegratorPointer<double> make_compensated(const IntegratorEntry&, const System<double>&,
                                                    const IntegratorSettings&);
template IntegratorPointer<long double> make_compensated(const IntegratorEntry&, const System<long double>&,
                                                         const IntegratorSettings&);

}  // namespace polhode::integrators
