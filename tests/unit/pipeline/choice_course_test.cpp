// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/choice_course.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/pipeline/run/piece_choices.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {
namespace {

/// An arc of a circle of 200 px about (300, 300), a point every degree.
Piece arc(double fromDeg, double toDeg) {
  Piece piece;
  const double step = fromDeg < toDeg ? 1.0 : -1.0;
  for (double a = fromDeg; step * a <= step * toDeg; a += step) {
    const double rad = a * std::numbers::pi / 180.0;
    piece.points.push_back({Vec2(300.0 + 200.0 * std::cos(rad), 300.0 + 200.0 * std::sin(rad))});
  }
  piece.lengthPx = std::abs(toDeg - fromDeg) * std::numbers::pi / 180.0 * 200.0;
  return piece;
}

Piece ring(double fromDeg, bool isReversed) {
  Piece piece = isReversed ? arc(fromDeg, fromDeg - 359.0) : arc(fromDeg, fromDeg + 359.0);
  piece.closed = true;
  return piece;
}

PieceSet setOf(const Piece& piece) {
  PieceSet set;
  set.pieces = {piece};
  return set;
}

const std::vector<ProfilePoint> kDrawn = {{0.0, 0.01}, {0.25, 0.05}, {0.5, 0.03}, {0.8, -0.02}, {1.0, 0.04}};

PieceChoice drawnOn(const Piece& piece, const std::vector<ProfilePoint>& profile = kDrawn) {
  PieceChoice choice;
  choice.anchorsPx = anchorsOf(piece);
  choice.mode = FairingMode::Target;
  choice.target = FairingTarget::Drawn;
  choice.profile = profile;
  choice.startHold = EndHold{true, false};
  choice.endHold = EndHold{true, true};
  return choice;
}

double curvatureAt(const std::vector<ProfilePoint>& profile, double fraction, bool closed = false) {
  return drawnProfile(profile, closed).curvatureAt(fraction);
}

TEST(ChoiceCourse, ALineThatRunsAsItDidKeepsItsChoiceExactly) {
  const Piece line = arc(0, 200);
  const PieceChoice choice = drawnOn(line);
  EXPECT_EQ(alongPiece(choice, line), choice);
  Piece moved = arc(2, 197);
  for (PiecePoint& p : moved.points) p.at += Vec2(1.5, -1.0);
  EXPECT_EQ(alongPiece(choice, moved), choice);
}

TEST(ChoiceCourse, ALineThatRunsTheOtherWayTurnsItsProfileAndItsEnds) {
  const PieceChoice choice = drawnOn(arc(0, 200));
  const PieceChoice along = alongPiece(choice, arc(200, 0));
  EXPECT_EQ(along.startHold, (EndHold{true, true}));
  EXPECT_EQ(along.endHold, (EndHold{true, false}));
  ASSERT_EQ(along.profile.size(), kDrawn.size());
  for (std::size_t i = 0; i < kDrawn.size(); ++i) {
    const ProfilePoint& was = kDrawn[kDrawn.size() - 1 - i];
    EXPECT_NEAR(along.profile[i].fraction, 1.0 - was.fraction, 1e-12);
    EXPECT_EQ(along.profile[i].kappa, -was.kappa) << "a left turn is a right turn on the way back";
  }
}

TEST(ChoiceCourse, AnEditOnTheWayBackIsSaidOnTheWayBack) {
  std::vector<PieceChoice> choices = {drawnOn(arc(0, 200))};
  const Piece back = arc(200, 0);
  const std::size_t own = makeOwnChoice(choices, setOf(back), 0);
  ASSERT_EQ(own, 0u);
  EXPECT_EQ(choices[0].anchorsPx, anchorsOf(back));
  choices[0].profile.front().kappa = 0.5;
  EXPECT_EQ(alongPiece(choices[0], back).profile.front().kappa, 0.5);
  const PieceChoice again = alongPiece(choices[0], arc(0, 200));
  EXPECT_EQ(again.profile.back().kappa, -0.5);
  EXPECT_EQ(again.startHold, (EndHold{true, false}));
}

TEST(ChoiceCourse, EachPartOfACutLineFollowsItsPartOfTheProfile) {
  const PieceChoice choice = drawnOn(arc(0, 200));
  for (const bool isReversed : {false, true}) {
    const PieceChoice part = alongPiece(choice, isReversed ? arc(150, 50) : arc(50, 150));
    const double sign = isReversed ? -1.0 : 1.0;
    for (const double t : {0.0, 0.5, 1.0}) {
      const double f = isReversed ? 0.75 - 0.5 * t : 0.25 + 0.5 * t;
      EXPECT_NEAR(curvatureAt(part.profile, t), sign * curvatureAt(kDrawn, f), 2e-3) << isReversed << ' ' << t;
    }
  }
}

TEST(ChoiceCourse, AClosedLineMayBeginElsewhereAndRunTheOtherWay) {
  const std::vector<ProfilePoint> drawn = {{0.0, 0.01}, {0.25, 0.05}, {0.5, 0.03}, {0.75, 0.02}};
  const PieceChoice choice = drawnOn(ring(0, false), drawn);
  EXPECT_EQ(alongPiece(choice, ring(0, false)), choice);
  for (const bool isReversed : {false, true})
    for (const double begin : {0.0, 90.0, 200.0}) {
      const PieceChoice along = alongPiece(choice, ring(begin, isReversed));
      EXPECT_EQ(along.profile.size(), drawn.size());
      const double sign = isReversed ? -1.0 : 1.0;
      for (const double t : {0.0, 0.1, 0.45, 0.7}) {
        const double f = begin / 360.0 + sign * t, folded = f - std::floor(f);
        EXPECT_NEAR(curvatureAt(along.profile, t, true), sign * curvatureAt(drawn, folded, true), 1e-3)
            << isReversed << ' ' << begin << ' ' << t;
      }
    }
}

TEST(ChoiceCourse, ASingleAnchorKnowsNoDirection) {
  PieceChoice choice = drawnOn(arc(0, 200));
  choice.anchorsPx.resize(1);
  EXPECT_EQ(alongPiece(choice, arc(200, 0)), choice);
}

}  // namespace
}  // namespace batten
