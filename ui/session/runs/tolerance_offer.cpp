// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/runs/tolerance_offer.h"

#include "core/fairing/edge_length_fairing.h"
#include "core/pipeline/run/fair_stage.h"
#include "core/pipeline/run/fairing_distance.h"
#include "ui/session/background/guarded.h"

namespace batten {
namespace {

bool isReached(const TracedCurve& curve, double toleranceMm, const RunContext& context) {
  FairingParams params = curve.fairingUsed;
  params.toleranceMm = toleranceMm;
  if (!movesEdgeLengths(params)) params.takenMm = startsOffMm(curve, context);
  const auto faired = fairedAs(curve, params, context);
  return faired && faired->report.withinTolerance;
}

}  // namespace

void ToleranceOffer::ask(const TracedCurve* curve, std::optional<double> toleranceMm) {
  if (!curve || !toleranceMm) {
    worker_.cancelAll();
    ++request_;
    askedMm_.reset();
    isEnough_ = isTrying_ = false;
    return;
  }
  if (askedMm_ == toleranceMm && curve_ == curve->sketched && params_ == curve->fairingUsed) return;
  curve_ = curve->sketched;
  params_ = curve->fairingUsed;
  askedMm_ = toleranceMm;
  isEnough_ = false;
  isTrying_ = true;
  worker_.start([this, job = *curve, mm = *toleranceMm, id = ++request_](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    const auto enough = guarded<bool>([&] { return Result<bool>(isReached(job, mm, context)); });
    if (token.isCancelled()) return;
    inbox_.post([this, id, isOne = enough.value_or(false)] {
      if (id != request_) return;
      isTrying_ = false;
      if (!isOne) return;
      isEnough_ = true;
      emit changed();
    });
  });
}

}  // namespace batten
