// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/known_splits.h"

#include "core/fairing/target_splits.h"

namespace batten {

const std::vector<double>& KnownSplits::of(const NurbsCurve& curve, bool closed, const FairingParams& params) {
  if (!(curve == curve_) || closed != closed_ || !(params == params_)) {
    curve_ = curve;
    closed_ = closed;
    params_ = params;
    splits_ = targetSplits(curve, closed, params);
  }
  return splits_;
}

}  // namespace batten
