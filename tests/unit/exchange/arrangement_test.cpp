// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/arrangement.h"

#include <gtest/gtest.h>

#include <set>

#include "core/exchange/export_file.h"
#include "core/exchange/svg_check.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

Vec2 startOf(const ExportPiece& piece) { return piece.curve.point(piece.curve.start()); }
Vec2 endOf(const ExportPiece& piece) { return piece.curve.point(piece.curve.end()); }

TEST(Arrangement, JoinedKeepsTheLinesAndApartMakesEveryPieceOne) {
  const ExportDocument document = test::exportOfAllKinds();
  const auto joined = arranged(document, true), apart = arranged(document, false);
  ASSERT_TRUE(joined && apart);
  EXPECT_EQ(joined->document.curves.size(), 6u);
  ASSERT_EQ(apart->document.curves.size(), 8u) << "the loop with three corners is three curves";
  std::set<std::string> ids;
  for (const ExportCurve& curve : apart->document.curves) ids.insert(curve.id);
  EXPECT_EQ(ids.size(), 8u);
  EXPECT_EQ(apart->document.curves[6].id, "curve-6.2");
  EXPECT_EQ(apart->document.curves[6].pieces[0].name, "curve-6.2");
  EXPECT_FALSE(apart->document.curves[6].closed);
  EXPECT_TRUE(apart->document.curves[3].closed) << "a smooth loop stays one";
}

TEST(Arrangement, SvgHoldsPathsJoinedOrApart) {
  const ExportDocument document = test::exportOfAllKinds();
  for (const bool joined : {true, false}) {
    ExportSettings settings;
    settings.joined = joined;
    const auto file = exportedFile(document, settings);
    ASSERT_TRUE(file) << file.error().message;
    std::size_t paths = 0;
    for (auto at = file->bytes.find("<path "); at != std::string::npos; at = file->bytes.find("<path ", at + 1))
      ++paths;
    EXPECT_EQ(paths, joined ? 6u : 8u);
  }
}

TEST(Arrangement, LeavesOutWhatLiesOnAnotherCurve) {
  ExportDocument document = test::exportOfAllKinds();
  document.curves.push_back({"again", false, {{test::oneSpan()}}});
  document.curves.push_back({"backwards", false, {{reversed(test::severalSpans())}}});
  document.curves.push_back({"part", false, {{split(test::severalSpans(), 27.0)->right}}});
  const NurbsCurve loop = test::smoothLoop();
  const auto cut = split(loop, 0.4 * loop.start() + 0.6 * loop.end());
  document.curves.push_back({"of the loop", false, {{cut->left}, {cut->right}}});
  for (const ExportFormat format : {ExportFormat::Svg, ExportFormat::Pdf, ExportFormat::Dxf, ExportFormat::Csv}) {
    ExportSettings settings;
    settings.format = format;
    const auto file = exportedFile(document, settings);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->report.doubles, 5);
    EXPECT_EQ(file->report.curves, 8);
  }
  // Near is not on top.
  ExportDocument two = test::exportOfAllKinds();
  two.curves.resize(1);
  two.curves.push_back({"beside", false, {{test::oneSpan().mapped(Eigen::Matrix2d::Identity(), Vec2(0, 1e-3))}}});
  EXPECT_EQ(arranged(two, true)->doubles, 0);
}

TEST(Arrangement, TurnsWhatIsMarked) {
  ExportDocument document = test::exportOfAllKinds();
  document.curves[0].pieces[0].direction = PieceDirection{0, true};
  document.curves[1].pieces[0].direction = PieceDirection{1, false};
  const auto made = arranged(document, false);
  ASSERT_TRUE(made);
  const ExportPiece &first = made->document.curves[0].pieces[0], &second = made->document.curves[1].pieces[0];
  EXPECT_EQ(startOf(first), endOf(document.curves[0].pieces[0]));
  EXPECT_EQ(endOf(first), startOf(document.curves[0].pieces[0]));
  EXPECT_TRUE(second.curve == document.curves[1].pieces[0].curve);
}

TEST(Arrangement, AJoinedLineRunsTheWayOfItsLatestMark) {
  ExportDocument document = test::exportOfAllKinds();
  ExportCurve& loop = document.curves[5];
  loop.pieces[0].direction = PieceDirection{3, false};
  loop.pieces[1].direction = PieceDirection{4, true};
  const auto made = arranged(document, true);
  ASSERT_TRUE(made);
  const ExportCurve& turned = made->document.curves[5];
  ASSERT_EQ(turned.pieces.size(), 3u);
  EXPECT_TRUE(turned.closed);
  EXPECT_EQ(startOf(turned.pieces[0]), endOf(loop.pieces[2]));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((endOf(turned.pieces[i]) - startOf(turned.pieces[(i + 1) % 3])).norm(), 1e-12);
}

TEST(Arrangement, ClosedLinesBeginWhereTheyAreAskedTo) {
  ExportDocument document = test::exportOfAllKinds();
  const NurbsCurve& smooth = document.curves[3].pieces[0].curve;
  const Vec2 wanted = smooth.point(0.3 * smooth.start() + 0.7 * smooth.end());
  document.curves[3].startMm = wanted + Vec2(0.1, 0.1);
  document.curves[5].startMm = Vec2(108, 16);  // near the second corner
  const auto made = arranged(document, true);
  ASSERT_TRUE(made);
  EXPECT_LT((startOf(made->document.curves[3].pieces[0]) - wanted).norm(), 0.2);
  EXPECT_LT((startOf(made->document.curves[5].pieces[0]) - Vec2(110, 15)).norm(), 1e-12);
  EXPECT_TRUE(made->document.curves[5].closed);
  // Every format writes them.
  for (const ExportFormat format : {ExportFormat::Svg, ExportFormat::Json, ExportFormat::Dxf, ExportFormat::Pdf}) {
    ExportSettings settings;
    settings.format = format;
    EXPECT_TRUE(exportedFile(document, settings));
  }
}

}  // namespace
}  // namespace batten
