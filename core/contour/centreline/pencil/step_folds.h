// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace batten {

/// to[i] = what the values at grey[i + step] make, step after step in their order, for i < count. @pre stepCount > 0
using StepFold = void (*)(const float* grey, const int* steps, int stepCount, int count, float* to);

/// Folds over places beside every pixel of a row.
struct StepFolds {
  StepFold sum, least, most;
};
/// For any processor.
StepFolds plainStepFolds();
/// The fastest that this processor has; the same bits.
StepFolds stepFolds();

}  // namespace batten
