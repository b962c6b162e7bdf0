// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/export_builder.h"

#include <gtest/gtest.h>

namespace batten {
namespace {

NurbsCurve segment(double from, double to) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 5; ++i) points.emplace_back(from + (to - from) * i / 5.0, 0.0);
  return NurbsCurve::make(5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, points).value();
}

/// Two contours: a closed one cut into four pieces 0..3, and an open one of two pieces 4, 5.
struct Scene {
  PipelineOutput output;
  FairedSet faired;
  Scan scan;

  Scene() {
    ContourSet contours;
    contours.contours.resize(2);
    contours.contours[0].closed = true;
    for (const float width : {9.0f, 4.0f, 5.0f}) contours.contours[1].points.push_back({.widthPx = width});
    PieceSet pieces;
    for (int i = 0; i < 6; ++i) {
      Piece& piece = pieces.pieces.emplace_back();
      piece.contour = i < 4 ? 0 : 1;
      piece.index = i < 4 ? i : i - 4;
      TracedCurve& curve = faired.curves.emplace_back();
      curve.contour = piece.contour;
      curve.piece = i;
      curve.sketched = curve.faired = segment(i, i == 3 ? 0 : i + 1);  // back to the start
    }
    output.contours = std::make_shared<ContourSet>(contours);
    output.pieces = std::make_shared<PieceSet>(pieces);
    output.frame = {100, 50, 0.5};
    scan.path = "/somewhere/car.png";
    scan.dpi = 50.8;
  }
  ExportDocument build(const Recipe& recipe = {}) {
    output.faired = std::make_shared<FairedSet>(faired);
    return exportDocument(output, recipe, scan);
  }
};

std::vector<int> firstAbscissas(const ExportCurve& curve) {
  std::vector<int> list;
  for (const ExportPiece& piece : curve.pieces)
    list.push_back(static_cast<int>(piece.curve.controlPoints().front().x()));
  return list;
}

TEST(ExportBuilder, GroupsThePiecesOfAContour) {
  Scene scene;
  const ExportDocument document = scene.build();
  ASSERT_EQ(document.curves.size(), 2u);
  EXPECT_EQ(document.curves[0].id, "curve-1");
  EXPECT_TRUE(document.curves[0].closed);
  EXPECT_EQ(firstAbscissas(document.curves[0]), (std::vector{0, 1, 2, 3}));
  EXPECT_FALSE(document.curves[1].closed);
  EXPECT_EQ(firstAbscissas(document.curves[1]), (std::vector{4, 5}));
  EXPECT_FALSE(document.curves[0].strokeWidthMm.has_value());
  EXPECT_EQ(document.curves[1].strokeWidthMm, 2.5);
  EXPECT_EQ(document.title, "car.png");
  EXPECT_EQ(document.dpi, 50.8);
  Recipe recipe;
  recipe.dpi = 100.0;
  EXPECT_EQ(scene.build(recipe).dpi, 100.0);
}

TEST(ExportBuilder, ALoopWhoseCurvesDoNotMeetIsNotClosed) {
  Scene scene;
  scene.faired.curves[2].faired = segment(2.0, 2.9);
  const ExportDocument document = scene.build();
  ASSERT_EQ(document.curves.size(), 2u);
  EXPECT_FALSE(document.curves[0].closed);
  EXPECT_EQ(document.curves[0].pieces.size(), 4u);
}

TEST(ExportBuilder, AnExcludedPieceOpensTheLoopWithoutCuttingItAgain) {
  Scene scene;
  scene.faired.curves[1].included = false;
  const ExportDocument document = scene.build();
  ASSERT_EQ(document.curves.size(), 2u);
  EXPECT_FALSE(document.curves[0].closed);
  EXPECT_EQ(firstAbscissas(document.curves[0]), (std::vector{2, 3, 0}));
}

TEST(ExportBuilder, AMissingPieceInterruptsTheLine) {
  Scene scene;
  scene.faired.curves.erase(scene.faired.curves.begin() + 3);
  scene.faired.curves.erase(scene.faired.curves.begin() + 1);
  const ExportDocument document = scene.build();
  ASSERT_EQ(document.curves.size(), 3u);
  EXPECT_EQ(firstAbscissas(document.curves[0]), std::vector{2});
  EXPECT_EQ(firstAbscissas(document.curves[1]), std::vector{0});
  EXPECT_FALSE(document.curves[0].closed || document.curves[1].closed);
  EXPECT_EQ(document.curves[2].id, "curve-5");
}

TEST(ExportBuilder, NamesPathsAndPiecesByTheNumbersOfTheirCurves) {
  Scene scene;
  scene.output.numbers = std::make_shared<PieceNumbers>(PieceNumbers{{9, 4, 12, 30, 2, 77}, {}});
  scene.faired.curves[1].included = false;
  const ExportDocument document = scene.build();
  ASSERT_EQ(document.curves.size(), 2u);
  EXPECT_EQ(document.curves[0].id, "curve-9");
  ASSERT_EQ(document.curves[0].pieces.size(), 3u);
  EXPECT_EQ(document.curves[0].pieces[0].name, "Curve 12");
  EXPECT_EQ(document.curves[0].pieces[0].number, 12);
  EXPECT_EQ(document.curves[0].pieces[2].name, "Curve 9");
  EXPECT_EQ(document.curves[1].id, "curve-2");
  EXPECT_EQ(document.curves[1].pieces[1].name, "Curve 77");
}

TEST(ExportBuilder, ARunWithoutResultGivesNothing) {
  Scene scene;
  EXPECT_TRUE(exportDocument(scene.output, {}, scene.scan).curves.empty());
  for (TracedCurve& curve : scene.faired.curves) curve.included = false;
  EXPECT_TRUE(scene.build().curves.empty());
}

}  // namespace
}  // namespace batten
