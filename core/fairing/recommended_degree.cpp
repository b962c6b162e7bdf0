// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/recommended_degree.h"

#include <tuple>

#include "core/fairing/profile/target_degrees.h"

namespace batten {
namespace {

std::optional<int> mostSimilar(const FairedByDegree& faired) {
  std::optional<int> degree;
  double best = 0.0;
  for (std::size_t i = 0; i < faired.size(); ++i) {
    if (!faired[i] || !faired[i]->report.similarityAfter) continue;
    const double s = *faired[i]->report.similarityAfter;
    if (degree && s <= best) continue;
    degree = static_cast<int>(i) + 1;
    best = s;
  }
  return degree;
}

std::optional<int> fairest(const FairedByDegree& faired, std::optional<int> nearest, double toleranceMm) {
  std::optional<int> best;
  const auto rank = [&](int degree) {
    const FairingReport& report = faired[degree - 1]->report;
    const bool isMet = report.withinTolerance && report.extremaAfter <= report.extremaBefore;
    const bool isAllowed = degree == nearest || (report.neededMm && *report.neededMm <= toleranceMm);
    return std::tuple(!isMet, !isAllowed, report.extremaAfter);
  };
  for (int degree = 1; degree <= kMostTargetDegree; ++degree)
    if (faired[degree - 1] && (!best || rank(degree) < rank(*best))) best = degree;
  return best;
}

}  // namespace

std::optional<int> degreeToRecommend(const FairedByDegree& faired, std::optional<int> nearest,
                                     const FairingParams& params) {
  return params.targetChoice == TargetChoice::Similarity ? mostSimilar(faired)
                                                         : fairest(faired, nearest, params.toleranceMm);
}

}  // namespace batten
