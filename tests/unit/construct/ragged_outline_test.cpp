// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/construct/light/light_pieces.h"
#include "tests/unit/construct/light_shapes.h"

namespace batten {
namespace {

constexpr double kRadius = 100.0, kRagHeight = 0.6;  // px
constexpr int kRagWaves = 60;

// A disc whose border goes to and fro all round.
NurbsCurve raggedCircle() {
  test::TruthPiece piece;
  constexpr int kSteps = 6000;
  for (int i = 0; i < kSteps; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSteps, r = kRadius + kRagHeight * std::cos(kRagWaves * a);
    piece.points.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  return test::denseCurve(piece, true);
}

struct RaggedCase {
  bool isUneven = true, smooths = true;
  std::optional<double> detail = {};
};

ConstructedPiece lightOfRagged(const RaggedCase& c) {
  ConstructContour contour;
  contour.pieces.resize(1);
  contour.pieces.front().closed = true;
  contour.pieces.front().detail = c.detail;
  contour.inkWidthPx = 20.0;
  contour.isUneven = c.isUneven;
  ConstructParams params;
  params.smoothRagged = c.smooths;
  std::vector<ConstructedPiece> made(1);
  made.front().curve = raggedCircle();
  EXPECT_TRUE(makePiecesLight(made, contour, params, {}));
  return std::move(made.front());
}

TEST(RaggedOutline, OfUnevenInkIsDrawnAsItWasMeant) {
  const ConstructedPiece meant = lightOfRagged({});
  EXPECT_LT(meant.curve.controlPointCount(), 20);
  for (int i = 0; i < 100; ++i) {
    const double u = meant.curve.start() + i / 100.0 * (meant.curve.end() - meant.curve.start());
    EXPECT_NEAR(meant.curve.point(u).norm(), kRadius, 2.0);
  }
  EXPECT_NE(meant.report.note.find("construct.smooth_ragged"), std::string::npos) << meant.report.note;
}

TEST(RaggedOutline, OfSolidInkIsFollowed) {
  for (const RaggedCase& c : {RaggedCase{.isUneven = false}, RaggedCase{.smooths = false}, RaggedCase{.detail = 0.0}}) {
    const ConstructedPiece followed = lightOfRagged(c);
    EXPECT_GT(followed.curve.controlPointCount(), kRagWaves);
    EXPECT_EQ(followed.report.note.find("construct.smooth_ragged"), std::string::npos);
  }
}

}  // namespace
}  // namespace batten
