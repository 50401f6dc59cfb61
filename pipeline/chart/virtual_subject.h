// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/chart/sweep.h"

namespace abrdf {

/// A coloured glossy weave on a grid, the same on every machine: to measure times on.
Subject virtualSubject(const AngularGrid& grid);

}  // namespace abrdf
