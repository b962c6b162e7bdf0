// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/curve/nurbs_curve.h"
#include "core/fairing/fairing_params.h"

namespace batten {

/// What targetSplits() found last, and for what: canvas and plot ask for it whenever they are painted.
class KnownSplits {
 public:
  const std::vector<double>& of(const NurbsCurve&, bool closed, const FairingParams&);

 private:
  NurbsCurve curve_;
  bool closed_ = false;
  FairingParams params_;
  std::vector<double> splits_;
};

}  // namespace batten
