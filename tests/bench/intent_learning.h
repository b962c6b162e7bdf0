// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/intent/stroke_groups.h"
#include "tests/bench/stroke_drawing.h"

namespace batten::test {

/// A drawing to learn from: its traced strokes.
struct LearningPage {
  const StrokeDrawing* drawing = nullptr;
  std::vector<Contour> lines;  ///< Not merged.
  double widthPx = 1.0;
};

/// For every page weights that were learned from the pages of the other folds alone (page i is in fold i % folds), in
/// each round from bundles that such weights made before. Cautions are those of the learned weights.
std::vector<IntentWeights> crossValidatedWeights(const std::vector<LearningPage>& pages, int folds);

}  // namespace batten::test
