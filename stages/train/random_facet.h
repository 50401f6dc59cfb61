// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/facet.h"
#include "abrdf/random.h"

namespace abrdf {

/// Roughnesses of random lobes lie between these (alpha of the slopes).
inline constexpr double kLeastRoughness = 0.006;
inline constexpr double kMostRoughness = 0.95;

/// What a facet has beside its body, mostly.
enum class FacetKind { kLobe, kTwoLobes, kVelvet, kFibre, kDiffuse };
FacetKind randomFacetKind(Random& random);

/// A facet of a kind that reflects something: the distributions of its parameters are in
/// random_facet.cpp (design: estimator.md, section 3). Neither tilted nor masked. The same numbers
/// on every machine.
Facet randomFacet(FacetKind kind, Random& random);

/// `facet` with its lobes made round and without fibre, so that nothing changes when it is turned.
Facet isotropic(Facet facet);

}  // namespace abrdf
