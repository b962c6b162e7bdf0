// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/left_as_drawn.h"

#include <gtest/gtest.h>

namespace batten {
namespace {

/// A curve that fairing gave back as it was.
TracedCurve leftBy(FairingMode mode, std::optional<int> keepExtrema) {
  TracedCurve curve;
  curve.sketched =
      NurbsCurve::make(2, {0.0, 0.0, 0.0, 1.0, 1.0, 1.0}, {Vec2(0.0, 0.0), Vec2(5.0, 4.0), Vec2(12.0, 0.0)}).value();
  curve.faired = curve.sketched;
  curve.fairingUsed.mode = mode;
  curve.fairingUsed.keepExtrema = {keepExtrema};
  return curve;
}

TEST(LeftAsDrawn, MonotoneSaysWhetherThereWasAnExtremumOrOneThatIsKept) {
  EXPECT_EQ(leftAsDrawnReason(leftBy(FairingMode::Monotone, 0)), "Unchanged: it has no curvature extremum to remove.");
  EXPECT_EQ(leftAsDrawnReason(leftBy(FairingMode::Monotone, 5)),
            "Unchanged: it has no more curvature extrema than are to be kept.");
  TracedCurve chosen = leftBy(FairingMode::Monotone, std::nullopt);
  chosen.fairingUsed.keptAt = {0.5};
  EXPECT_EQ(leftAsDrawnReason(chosen), "Unchanged: it has no more curvature extrema than are to be kept.");
}

TEST(LeftAsDrawn, SaysNothingWhereFairingWasNotAskedFor) {
  EXPECT_EQ(leftAsDrawnReason(leftBy(FairingMode::None, 0)), "");
}

TEST(LeftAsDrawn, TheNoteOfTheFairingComesFirst) {
  TracedCurve curve = leftBy(FairingMode::LowPass, 0);
  EXPECT_EQ(leftAsDrawnReason(curve), "Unchanged: it has no waves below this wavelength.");
  curve.fairing.note = "Stopped.";
  EXPECT_EQ(leftAsDrawnReason(curve), "Stopped.");
}

}  // namespace
}  // namespace batten
