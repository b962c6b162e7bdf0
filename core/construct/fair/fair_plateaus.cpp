// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_plateaus.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/construct/fair/fair_structure.h"

namespace batten {
namespace {

constexpr double kSlopeShare = 0.25;  // of the mean slope of a stretch
constexpr double kStretchCost = 1.0;  // [chi2] what a stretch may pay for it
constexpr double kLessSlope = 0.4;    // next try of a stretch that paid more
constexpr double kNearWindows = 1.5;  // half windows of an extremum: flat is what the curve is there anyhow
constexpr int kPlateauRounds = 3;     // tries of a stretch; the last one asks for no slope
constexpr double kFlatSlope = 0.05;   // of the mean slope: a plateau
constexpr double kFlatShare = 0.02;   // of a stretch that may be plateaus as it is

/// Number of the stretch that a place belongs to; the end of a closed curve belongs to its first stretch.
std::size_t stretchAt(const FairStructure& structure, bool closed, double u) {
  const auto& extrema = structure.extrema;
  const auto next = std::lower_bound(extrema.begin(), extrema.end(), u,
                                     [](const FairExtremum& e, double place) { return e.u < place; });
  const std::size_t i = next - extrema.begin();
  return closed && i == extrema.size() ? 0 : i;
}

/// Penalised chi2 by stretches.
std::vector<double> costByStretch(const FairFrame& frame, const FairPosterior& posterior,
                                  const FairStructure& structure, const Eigen::VectorXd& c) {
  const auto& extrema = structure.extrema;
  const bool closed = frame.base.knots().closed;
  std::vector<double> cost(extrema.size() + (closed ? 0 : 1), 0.0);
  const auto at = [&](double u) -> double& { return cost[stretchAt(structure, closed, u)]; };
  for (const FairBlock& block : frame.blocks) {
    const double e = block.offset - dot(block.row, c);
    at(block.u) += frame.blockLength * block.weight / posterior.s0 * e * e;
  }
  for (std::size_t j = 0; j < frame.penalty.size(); ++j) {
    const double bend = frame.penalty[j].bend + dot(frame.penalty[j].bendRow, c);
    at(frame.penalty[j].u) += frame.cell / posterior.tau2[j] * bend * bend;
  }
  return cost;
}

/// Mean slopes of the stretches, without sign.
std::vector<double> meanSlopes(const FairFrame& frame, const FairStructure& structure, const Eigen::VectorXd& c) {
  const auto& e = structure.extrema;
  const UniformKnots& knots = frame.base.knots();
  std::vector<double> slopes;
  const auto add = [&](double u0, double kappa0, double u1, double kappa1) {
    slopes.push_back(u1 > u0 ? std::abs(kappa1 - kappa0) / (u1 - u0) : 0.0);
  };
  if (knots.closed) {
    if (e.empty()) return {};
    add(e.back().u - knots.length, e.back().kappa, e.front().u, e.front().kappa);
  } else {
    const double start = kappaAt(frame.checks.front(), c), end = kappaAt(frame.checks.back(), c);
    if (e.empty()) {
      add(0.0, start, knots.length, end);
      return slopes;
    }
    add(0.0, start, e.front().u, e.front().kappa);
  }
  for (std::size_t i = 0; i + 1 < e.size(); ++i) add(e[i].u, e[i].kappa, e[i + 1].u, e[i + 1].kappa);
  if (!knots.closed) add(e.back().u, e.back().kappa, knots.length, kappaAt(frame.checks.back(), c));
  return slopes;
}

/// Whether a place lies so near to an extremum that the curve is flat there anyhow. @param period of a closed curve; 0:
/// open.
bool isNearExtremum(const FairStructure& structure, double u, double period) {
  const auto& e = structure.extrema;
  const double reach = kNearWindows * kWidestWindowPx;
  const auto isNear = [&](double place) {
    const auto before = [](const FairExtremum& x, double from) { return x.u < from; };
    for (auto it = std::lower_bound(e.begin(), e.end(), place - reach, before); it != e.end(); ++it) {
      if (it->u > place + reach) break;
      if (std::abs(place - it->u) < kNearWindows * it->halfWidth) return true;
    }
    return false;
  };
  return isNear(u) || (period > 0.0 && (isNear(u - period) || isNear(u + period)));
}

/// No minimum slope is required where there is practically no plateau.
void spareSteady(const FairFrame& frame, const FairStructure& structure, const Eigen::VectorXd& c,
                 std::vector<double>& slopes) {
  std::vector<int> flat(slopes.size(), 0), all(slopes.size(), 0);
  const bool closed = frame.base.knots().closed;
  for (const FrameStation& s : frame.checks) {
    const std::size_t i = stretchAt(structure, closed, s.u);
    if (i >= slopes.size()) continue;
    ++all[i];
    if (!isNearExtremum(structure, s.u, closed ? frame.base.knots().length : 0.0) &&
        std::abs(s.slope + dot(s.slopeRow, c)) < kFlatSlope * slopes[i])
      ++flat[i];
  }
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (flat[i] <= kFlatShare * all[i]) slopes[i] = 0.0;
  }
}

}  // namespace

StructureFit withoutPlateaus(const FairFrame& frame, const FairPosterior& posterior, FairStructure& structure,
                             StructureFit fit, CancelCheck check) {
  std::vector<double> slopes = meanSlopes(frame, structure, fit.c);
  if (slopes.empty()) return fit;
  spareSteady(frame, structure, fit.c, slopes);
  for (double& slope : slopes) slope *= kSlopeShare;
  const std::vector<double> before = costByStretch(frame, posterior, structure, fit.c);
  FairStructure wanted = structure;
  for (int round = 0; round < kPlateauRounds; ++round) {
    if (std::none_of(slopes.begin(), slopes.end(), [](double s) { return s > 0.0; })) break;
    wanted = structure;
    wanted.leastSlope = slopes;
    auto lifted = fitStructure(frame, posterior, wanted, fit.c, {}, check);
    if (!lifted || !lifted->converged) break;
    const std::vector<double> after = costByStretch(frame, posterior, structure, lifted->c);
    bool paid = false;
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      if (after[i] - before[i] <= kStretchCost) continue;
      slopes[i] *= round + 2 < kPlateauRounds ? kLessSlope : 0.0;
      paid = true;
    }
    if (paid) continue;
    structure = std::move(wanted);
    return std::move(*lifted);
  }
  return fit;
}

}  // namespace batten
