// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/fairing_state.h"

#include <cmath>
#include <utility>

namespace batten {
namespace {

/// The terms of an objective add up to more, whatever the order.
constexpr double kSurelyMore = 1.0 + 1e-9;

}  // namespace

std::optional<FairingState> evaluate(const FairingSetup& setup, const FairingObjective& objective,
                                     const FairingCorridor& corridor, std::vector<Vec2> points,
                                     const std::vector<SpanPlace>& feet, double most) {
  FairingState state;
  state.points = std::move(points);
  state.curve = SpanCurve(setup.basis, state.points);
  const int count = setup.sampleCount();
  auto arc = equalArcPlaces(state.curve, count, setup.closed, setup.check);
  if (!arc) return std::nullopt;
  state.arc = std::move(*arc);
  const auto size = static_cast<std::size_t>(count);
  state.jets.resize(size);
  state.curvature.resize(size);
  state.feet.resize(size);
  state.distance.resize(size);
  state.normal.resize(size);
  state.residual.resize(count);
  const double length = state.arc.length, domain = setup.original.end() - setup.original.start();
  const bool profile = !objective.wanted.empty();
  double misfit = 0.0;  // so far
  const double givesUpAt = kSurelyMore * most;
  for (int i = 0; i < count; ++i) {
    if (setup.check.isCancelled()) return std::nullopt;
    const auto at = static_cast<std::size_t>(i);
    state.jets[at] = state.curve.at(state.arc.places[at], 4);
    const Jet& jet = state.jets[at];
    if (!(jet[1].norm() > kCuspShare * length / domain)) return std::nullopt;
    state.curvature[at] = curvatureJet(jet);
    state.feet[at] = footPoint(setup.reference, jet[0], feet[at]);
    const Jet foot = setup.reference.at(state.feet[at], 1);
    state.normal[at] = foot[1].norm() > 0.0 ? leftNormal(foot[1].normalized()) : Vec2(Vec2::Zero());
    const double e = state.distance[at] = (jet[0] - foot[0]).dot(state.normal[at]);
    state.residual[i] = profile ? (state.curvature[at].kappa - setup.start.length / length * objective.wanted[at]) /
                                      objective.reference / std::sqrt(count)
                                : state.curvature[at].slope * std::sqrt(length / count) / objective.reference;
    const double miss = e - setup.offsetAt(state.feet[at]);
    state.total += corridor.weight * corridor.weight * miss * miss / count;
    if (corridor.barrier > 0.0) {
      const double share = e / corridor.bound;
      if (!(std::abs(share) < 1.0)) return std::nullopt;
      state.total -= corridor.barrier / count * std::log1p(-share * share);
    }
    misfit += state.residual[i] * state.residual[i];
    if (misfit + state.total > givesUpAt) return std::nullopt;
  }
  state.misfit = state.residual.squaredNorm();
  state.total += state.misfit;
  if (!std::isfinite(state.total)) return std::nullopt;
  return state;
}

}  // namespace batten
