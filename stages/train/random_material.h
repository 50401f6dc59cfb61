// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/analytic_material.h"
#include "abrdf/material_class.h"
#include "abrdf/random.h"

#include <cstdint>
#include <vector>

namespace abrdf {

/// A random grey material of a class: the distributions of all its parameters are in
/// random_material.cpp and random_facet.cpp (design: estimator.md, section 3). The same numbers on
/// every machine.
AnalyticMaterial randomMaterial(MaterialClass materialClass, Random& random);

/// Materials 0 .. count-1 of a class and a seed; the first of a longer list are those of a shorter.
std::vector<AnalyticMaterial> randomMaterials(MaterialClass materialClass, std::size_t count,
                                              std::uint64_t seed);

}  // namespace abrdf
