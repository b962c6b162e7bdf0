// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/cancel_check.h"

namespace batten {

/// An extremum of sampled curvature.
struct StructureExtremum {
  int sample = 0;       ///< Where it stands among the samples.
  bool maximum = true;  ///< Of the signed curvature; else a minimum.
};

/// Which extrema a curvature profile has, in order. Without extrema `rising` says which way it goes.
struct CurvatureStructure {
  std::vector<StructureExtremum> extrema;
  bool rising = true;
};

/// All structures from the sampled profile's own down to the simplest one: each drops the extremum at an end, or the
/// pair of neighbours, that moves the curve least to remove. To take a bump of height h and half wave w out of the
/// curvature moves the curve by about h w^2 / (2 pi^2).
struct StructureLevel {
  CurvatureStructure structure;
  double estimateMm = 0.0;  ///< Largest such move so far.
};
/// @param s arc length of the samples, ascending [mm]; @param kappa [1/mm].
/// @param closed the last sample is followed by the first at `length`; pairs only, and never below four (four-vertex
/// theorem).
std::vector<StructureLevel> structureLevels(std::span<const double> s, std::span<const double> kappa, double length,
                                            bool closed, CancelCheck check = {});

/// The structure that keeps the extrema nearest to given samples, and between two of one kind the extreme that parts
/// them.
CurvatureStructure structureAt(std::span<const double> kappa, const CurvatureStructure& all,
                               std::span<const int> samples, bool closed);

}  // namespace batten
