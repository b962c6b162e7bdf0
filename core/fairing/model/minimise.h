// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/base/termination.h"
#include "core/fairing/model/fairing_model.h"
#include "core/fairing/model/fairing_state.h"

namespace batten {

/// Why and how a minimisation ended.
struct FairingRun {
  FairingState state;
  Termination why = Termination::IterationLimit;
  int iterations = 0;
  double damping = 1e-3;  ///< As FairingLimits::damping: for a later run from here.
};
struct FairingLimits {
  int iterations = 40;
  double relativeDecrease = 1e-4;   ///< [-] LevenbergOptions::smallDecrease.
  double damping = 1e-3;            ///< [stiffness of the longest wave] to begin with.
  double slideFloor = kSlideFloor;  ///< Of FairingModel.
};
/// Levenberg-Marquardt from a state.
FairingRun minimise(const FairingSetup& setup, const FairingObjective& objective, const FairingCorridor& corridor,
                    FairingState start, const FairingLimits& limits, const RunContext& context);

}  // namespace batten
