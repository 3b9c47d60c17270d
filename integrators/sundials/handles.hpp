// SPDX-License-Identifier: BSD-3-Clause
// Owning handles for the objects of SUNDIALS. Each handle deletes its object by the function of the library.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <memory>

namespace polhode::inline integrators::sundials {

template <auto destroy>
struct Destroy {
  template <class T>
  void operator()(T* object) const {
    destroy(object);
  }
};
inline void free_context(SUNContext context) { SUNContext_Free(&context); }

using Context = std::unique_ptr<_SUNContext, Destroy<free_context>>;
using Vector = std::unique_ptr<_generic_N_Vector, Destroy<N_VDestroy>>;
using Matrix = std::unique_ptr<_generic_SUNMatrix, Destroy<SUNMatDestroy>>;
using LinearSolver = std::unique_ptr<_generic_SUNLinearSolver, Destroy<SUNLinSolFree>>;
using NonlinearSolver = std::unique_ptr<_generic_SUNNonlinearSolver, Destroy<SUNNonlinSolFree>>;

}  // namespace polhode::integrators::sundials
