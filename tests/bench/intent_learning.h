// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
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
/// each round from bundles that such weights made before; with one fold, from all pages. Cautions are those of the
/// learned weights.
std::vector<IntentWeights> crossValidatedWeights(const std::vector<LearningPage>& pages, int folds);

/// The same weights with the cautions and side factors at which the score is highest, found one after the other.
IntentWeights tunedCautions(IntentWeights weights, const std::function<double(const IntentWeights&)>& score);

/// As they stand in core/contour/intent/intent_weights.cpp.
void printWeights(const IntentWeights& weights);

}  // namespace batten::test
