// SPDX-License-Identifier: GPL-3.0-or-later
// What monotone curvature says of ends that are held, and what the parts of a curve say together.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "core/fairing/fairing.h"
#include "core/fairing/fairing_report.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

constexpr double kToleranceMm = 0.01;

// The pointed end of an ellipse: both ends have the same curvature, so that only a circle of it could be monotone
// between them, and that does not reach from the one to the other.
NurbsCurve pointedEnd() {
  const auto tip = [](double t) {
    const double a = std::numbers::pi / 2.0 + 2.0 * (t - 0.5);
    return Vec2(70.0 * std::cos(a), 150.0 * std::sin(a));
  };
  return test::fitted(tip, 40);
}

FairingParams heldMonotone(double toleranceMm, KeptExtrema keep) {
  FairingParams params;
  params.mode = FairingMode::Monotone;
  params.toleranceMm = toleranceMm;
  params.keepExtrema = keep;
  params.startHold = params.endHold = {true, true};
  return params;
}

// [mm] The tolerance that free ends need by a note.
std::optional<double> toldOfFreeEnds(const std::string& note) {
  const std::string words = "; with free ends it needs a tolerance of ";
  const auto told = note.find(words);
  if (told == std::string::npos) return std::nullopt;
  return std::stod(note.substr(told + words.size()));
}

TEST(HeldEnds, AreSaidToForbidWhatTheyForbid) {
  const NurbsCurve start = pointedEnd();
  for (const KeptExtrema keep : {KeptExtrema{0}, KeptExtrema{}}) {
    FairingParams params = heldMonotone(kToleranceMm, keep);
    const auto held = fair(start, false, params, {});
    ASSERT_TRUE(held);
    EXPECT_EQ(held->report.maxDeviationMm, 0.0);
    const std::string& note = held->report.note;
    if (keep.count) {
      const auto told = toldOfFreeEnds(note);
      ASSERT_TRUE(told) << note;
      params.startHold = params.endHold = {};
      const auto free = fair(start, false, params, {});
      ASSERT_TRUE(free);
      EXPECT_NEAR(*told, free->report.neededMm.value(), 0.01 * free->report.neededMm.value());
    } else {
      EXPECT_NE(note, "No extremum can be removed within the tolerance.") << "no word of what it would take";
      EXPECT_NE(note.find("a tolerance of "), std::string::npos) << note;
    }
  }
}

TEST(HeldEnds, WhatIsTakenOfTheToleranceComesOffOnce) {
  constexpr double kTakenMm = 2.0 * kToleranceMm;
  const NurbsCurve start = pointedEnd();
  const auto whole = fair(start, false, heldMonotone(kToleranceMm, KeptExtrema{0}), {});
  FairingParams params = heldMonotone(kToleranceMm + kTakenMm, KeptExtrema{0});
  params.takenMm = kTakenMm;
  const auto taken = fair(start, false, params, {});
  ASSERT_TRUE(whole && taken);
  const auto needed = toldOfFreeEnds(whole->report.note), neededToo = toldOfFreeEnds(taken->report.note);
  ASSERT_TRUE(needed && neededToo) << taken->report.note;
  EXPECT_NEAR(*neededToo, *needed + kTakenMm, 0.01 * *needed);
}

FairingReport partOf(bool isWithin, std::optional<double> neededMm) {
  FairingReport part;
  part.withinTolerance = isWithin;
  part.neededMm = neededMm;
  return part;
}

TEST(FairingParts, NoToleranceIsEnoughForAllWhereNoneIsForOne) {
  const FairingReport near = partOf(true, 0.1), far = partOf(false, 0.4), never = partOf(false, std::nullopt);
  FairingReport sum;
  addPart(sum, near);
  addPart(sum, far);
  EXPECT_EQ(sum.neededMm, 0.4);
  addPart(sum, never);
  EXPECT_EQ(sum.neededMm, std::nullopt);
  addPart(sum, far);
  EXPECT_EQ(sum.neededMm, std::nullopt);
  EXPECT_FALSE(sum.withinTolerance);
}

}  // namespace
}  // namespace batten
