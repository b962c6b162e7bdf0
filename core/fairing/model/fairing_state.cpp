// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/fairing_state.h"

#include <cmath>
#include <utility>

namespace batten {
namespace {

/// The terms of an objective add up to more, whatever the order.
constexpr double kSurelyMore = 1.0 + 1e-9;

}  // namespace

std::vector<SpanPlace> FairingState::feet() const {
  std::vector<SpanPlace> feet;
  feet.reserve(samples.size());
  for (const FairingSample& sample : samples) feet.push_back(sample.foot);
  return feet;
}

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
  state.samples.reserve(state.arc.places.size());
  state.residual.resize(count);
  const double length = state.arc.length, domain = setup.original.end() - setup.original.start();
  const bool profile = !objective.wanted.empty();
  const double root = std::sqrt(count), spread = std::sqrt(length / count);
  double misfit = 0.0;  // so far
  const double givesUpAt = kSurelyMore * most;
  for (int i = 0; i < count; ++i) {
    if (setup.check.isCancelled()) return std::nullopt;
    FairingSample& sample = state.samples.emplace_back();
    sample.jet = state.curve.at(state.arc.places[i], 4);
    const Jet& jet = sample.jet;
    if (!(jet[1].norm() > kCuspShare * length / domain)) return std::nullopt;
    sample.curvature = curvatureJet(jet);
    sample.foot = footPoint(setup.reference, jet[0], feet[i]);
    const Jet foot = setup.reference.at(sample.foot, 1);
    if (foot[1].norm() > 0.0) sample.normalAtFoot = leftNormal(foot[1].normalized());
    const double e = sample.distance = (jet[0] - foot[0]).dot(sample.normalAtFoot);
    state.residual[i] = profile ? (sample.curvature.kappa - setup.start.length / length * objective.wanted[i]) /
                                      objective.reference / root
                                : sample.curvature.slope * spread / objective.reference;
    const double miss = e - setup.offsetAt(sample.foot);
    state.total += corridor.weight * corridor.weight * miss * miss / count;
    if (corridor.barrier) {
      const double share = e / corridor.barrier->boundMm;
      if (!(std::abs(share) < 1.0)) return std::nullopt;
      state.total -= corridor.barrier->weight / count * std::log1p(-share * share);
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
