// SPDX-License-Identifier: BSD-3-Clause
// Volume, centroid and inertia of a polyhedron by integrals over its faces.
// Source: Mirtich, Fast and accurate computation of polyhedral mass properties, Journal of Graphics Tools 1(2), 1996.
#pragma once

#include "collision/shape.hpp"
#include "collision/shapes/polytope.hpp"

namespace polhode::inline collision::inline shapes {

MassProperties polyhedron_mass(const Polytope& polytope);

}  // namespace polhode::collision::shapes
