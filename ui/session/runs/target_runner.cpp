// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/runs/target_runner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/pipeline/run/curve_targets.h"
#include "ui/session/background/guarded.h"

namespace batten {
namespace {

/// Of its length: a curve that is longer or shorter by more is another one.
constexpr double kOtherCurve = 0.2;

/// The settings that the outcomes depend on: the chosen mode and target do not change them.
FairingParams paramsOfTargets(FairingParams params) {
  params.mode = FairingMode::None;
  params.target = FairingTarget::Recommended;
  params.lowPassMm = FairingParams{}.lowPassMm;
  params.keepExtrema = {};
  params.keptAt.clear();
  params.profile.clear();
  params.spanTargets.clear();
  return params;
}

}  // namespace

bool TargetRunner::start(const TracedCurve& curve, const std::optional<double>& span) {
  const FairingParams params = paramsOfTargets(curve.fairingUsed);
  if (isOf(curve) && params_ == params && span_ == span) return false;
  curve_ = curve.sketched;
  params_ = params;
  span_ = span;
  isComputing_ = true;
  worker_.start([this, id = ++newest_, job = curve, span](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    auto result = guarded<TargetOutcomes>([&] { return targetsFor(job, context, span); });
    if (!result && result.error().code == ErrorCode::Cancelled) return;
    std::shared_ptr<const TargetOutcomes> outcomes;
    if (result) outcomes = std::make_shared<const TargetOutcomes>(std::move(*result));
    inbox_.post([this, id, outcomes, length = job.sketchedFigures.lengthMm] { apply(id, outcomes, length); });
  });
  return true;
}

void TargetRunner::cancel() {
  worker_.cancelAll();
  if (!std::exchange(isComputing_, false)) return;
  ++newest_;
  forget();
}

void TargetRunner::stop() {
  cancel();
  forget();
}

bool TargetRunner::isLikeAnother(const TracedCurve& curve) const {
  const double length = curve.sketchedFigures.lengthMm;
  return std::abs(length - shownLengthMm_) > kOtherCurve * std::max(length, shownLengthMm_);
}

void TargetRunner::apply(std::uint64_t id, std::shared_ptr<const TargetOutcomes> outcomes, double lengthMm) {
  if (id != newest_) return;
  shownLengthMm_ = lengthMm;
  isComputing_ = false;
  show_(std::move(outcomes));
}

}  // namespace batten
