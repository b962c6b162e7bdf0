// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/arrangement.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include "core/exchange/cad/dxf_reader.h"
#include "core/exchange/cad/rhino_reader.h"
#include "core/exchange/export_file.h"
#include "core/exchange/import_file.h"
#include "core/exchange/model/cad_drawing.h"
#include "core/exchange/model/curves_on_top.h"
#include "core/exchange/occt/iges.h"
#include "core/exchange/occt/open_cascade.h"
#include "core/exchange/occt/step_reader.h"
#include "core/exchange/pdf_writer.h"
#include "core/exchange/svg/svg_check.h"
#include "core/exchange/text/csv_writer.h"
#include "core/exchange/text/polynomial_writer.h"
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
  for (const ExportCurve& curve : apart->document.curves) {
    ids.insert(curve.id);
    EXPECT_EQ(curve.pieces.capacity(), 1u) << "a line of thousands is not held once for each of its pieces";
  }
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
    EXPECT_EQ(file->report.curves, 6);
    EXPECT_EQ(file->report.pieces, 8);
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

TEST(Arrangement, ACurveOnAnotherLayerIsNoDouble) {
  ExportDocument document = test::exportOfAllKinds();
  document.curves.push_back(document.curves[0]);
  document.curves.back().id = "curve-1-sketched";
  document.curves.back().layer = "Sketched";
  const auto made = arranged(document, true);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->doubles, 0);
  EXPECT_EQ(made->document.curves.size(), 7u);
}

/// The start and the direction there of the only curve of a file that holds `document`.
std::pair<Vec2, Vec2> writtenStart(const ExportDocument& document, const char* ending) {
  const auto path = std::filesystem::temp_directory_path() / ("batten-way" + std::to_string(getpid()) + ending);
  ExportSettings settings;
  settings.format = *formatOf(path);
  const auto written = exportToFile(document, settings, path);
  EXPECT_TRUE(written) << written.error().message;
  const auto read = readImportFile(path);
  EXPECT_TRUE(read) << read.error().message;
  std::filesystem::remove(path);
  if (!read || read->file.lines.empty()) return {};
  const NurbsCurve& curve = read->file.lines[0].curves[0].curve;
  return {curve.point(curve.start()), curve.derivatives(curve.start(), 1)[1].normalized()};
}

TEST(Arrangement, ArcsAndCirclesKeepTheWayTheUserAskedFor) {
  for (const char* ending : {".dxf", ".igs", ".step"}) {
    if (std::string(ending) != ".dxf" && !hasOpenCascade()) continue;
    for (const bool turned : {true, false}) {
      ExportDocument document = test::exportOfAllKinds();
      const NurbsCurve arc = curveOf(CadArc{{60, 50}, 12.5, 0.4, 2.1}).value();
      document.curves = {{"arc", false, {{arc}}}};
      document.curves[0].pieces[0].direction = PieceDirection{0, turned};
      const double angle = turned ? 2.5 : 0.4;
      const auto [at, way] = writtenStart(document, ending);
      EXPECT_LT((at - (Vec2(60, 50) + 12.5 * Vec2(std::cos(angle), std::sin(angle)))).norm(), 1e-6) << ending;
      EXPECT_GT((turned ? -1.0 : 1.0) * way.dot(Vec2(-std::sin(angle), std::cos(angle))), 0.999) << ending;

      const NurbsCurve circle = curveOf(CadArc{{60, 50}, 7.25, 1.0, 2 * M_PI}).value();
      document.curves = {{"circle", true, {{circle}}}};
      document.curves[0].pieces[0].direction = PieceDirection{0, turned};
      document.curves[0].startMm = Vec2(60, 58);
      const auto [start, direction] = writtenStart(document, ending);
      EXPECT_LT((start - Vec2(60, 57.25)).norm(), 1e-6) << ending;
      EXPECT_GT((turned ? 1.0 : -1.0) * direction.x(), 0.999) << ending;
    }
  }
}

/// What reading a file back for the check says of it, [mm]; nothing where other curves are found.
std::optional<double> readBackDifference(const ExportedFile& file, const ExportDocument& expected,
                                         const ExportSettings& settings) {
  const auto of = [](const auto& result) { return result ? std::optional<double>(*result) : std::nullopt; };
  switch (settings.format) {
    case ExportFormat::Svg: {
      const auto check = checkSvg(file.bytes, expected);
      return check ? std::optional(check->largestErrorMm) : std::nullopt;
    }
    case ExportFormat::Pdf:
      return of(checkPdf(file.bytes, expected));
    case ExportFormat::Csv:
      return of(checkCsv(file.bytes, expected, settings));
    case ExportFormat::Polynomials:
      return of(checkPolynomials(file.bytes, expected, settings));
    default: {
      const auto made = cadExport(expected, settings);
      const auto back = settings.format == ExportFormat::Dxf    ? readDxf(file.bytes)
                        : settings.format == ExportFormat::Iges ? readIges(file.bytes)
                        : settings.format == ExportFormat::Step ? readStep(file.bytes)
                                                                : readRhino(file.bytes);
      return made && back ? of(largestDifference(made->drawing, *back)) : std::nullopt;
    }
  }
}

TEST(Arrangement, TheCheckComparesWithTheTurnedCurves) {
  ExportDocument plain = test::exportOfAllKinds();
  ExportDocument turned = plain;
  for (ExportCurve& line : turned.curves) line.pieces[0].direction = PieceDirection{0, true};
  turned.curves[3].startMm = plain.curves[3].pieces[0].curve.point(0.4 * plain.curves[3].pieces[0].curve.end());
  for (const ExportFormat format : {ExportFormat::Svg, ExportFormat::Pdf, ExportFormat::Csv, ExportFormat::Polynomials,
                                    ExportFormat::Dxf, ExportFormat::Iges, ExportFormat::Step, ExportFormat::Rhino}) {
    if (!hasOpenCascade() && (format == ExportFormat::Iges || format == ExportFormat::Step)) continue;
    ExportSettings settings;
    settings.format = format;
    settings.splinesOnly = true;
    const auto file = exportedFile(turned, settings), other = exportedFile(plain, settings);
    ASSERT_TRUE(file) << endingsOf(format)[0] << " " << file.error().message;
    ASSERT_TRUE(other) << endingsOf(format)[0];
    EXPECT_NE(file->bytes, other->bytes) << endingsOf(format)[0];
    const ExportDocument expected = arranged(turned, isJoined(settings))->document;
    const auto same = readBackDifference(*file, expected, settings);
    ASSERT_TRUE(same) << endingsOf(format)[0];
    EXPECT_LE(*same, isApproximate(settings) ? 1.05 * defaultTolerance(settings) : 1e-9) << endingsOf(format)[0];
    // The same curves as they ran before are found out.
    EXPECT_GT(readBackDifference(*other, expected, settings).value_or(1e9), 1.0) << endingsOf(format)[0];
  }
}

TEST(Arrangement, ArcsOfWhichNothingWasAskedStayEntitiesOfTheFormat) {
  ExportDocument document = test::exportOfAllKinds();
  document.curves = {{"arc", false, {{reversed(curveOf(CadArc{{60, 50}, 12.5, 0.4, 2.1}).value())}}}};
  ExportSettings settings;
  settings.format = ExportFormat::Dxf;
  const auto file = exportedFile(document, settings);
  ASSERT_TRUE(file);
  EXPECT_NE(file->bytes.find("\nARC\n"), std::string::npos);
}

ExportCurve importedLine(const char* id, const Vec2& from, const Vec2& to) {
  ExportCurve line{id, false, {{curveOf(CadLine{from, to}).value()}}};
  line.isImported = true;
  return line;
}

TEST(Arrangement, ImportedLinesAreJoinedWhateverTheirOrderAndDirection) {
  ExportDocument document = test::exportOfAllKinds();
  // A square whose sides come out of order, two of them backwards; a chain of two; a junction of three.
  document.curves = {importedLine("south", {0, 0}, {10, 0}), importedLine("north", {0, 10}, {10, 10}),
                     importedLine("west", {0, 0}, {0, 10}),  importedLine("east", {10, 0}, {10, 10}),
                     importedLine("one", {40, 0}, {30, 0}),  importedLine("two", {40, 0}, {50, 5}),
                     importedLine("a", {70, 0}, {80, 0}),    importedLine("b", {80, 0}, {90, 4}),
                     importedLine("c", {80, 0}, {90, -4})};
  const auto made = arranged(document, true);
  ASSERT_TRUE(made);
  const auto& lines = made->document.curves;
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0].id, "south");
  EXPECT_TRUE(lines[0].closed);
  ASSERT_EQ(lines[0].pieces.size(), 4u);
  EXPECT_EQ(startOf(lines[0].pieces[0]), Vec2(0, 0));
  EXPECT_EQ(endOf(lines[0].pieces[0]), Vec2(10, 0)) << "the first keeps its direction";
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(endOf(lines[0].pieces[i]), startOf(lines[0].pieces[(i + 1) % 4]));
  ASSERT_EQ(lines[1].pieces.size(), 2u);
  EXPECT_FALSE(lines[1].closed);
  EXPECT_EQ(startOf(lines[1].pieces[0]), Vec2(50, 5)) << "before the first comes the other, turned";
  EXPECT_EQ(endOf(lines[1].pieces[1]), Vec2(30, 0));
  EXPECT_EQ(arranged(document, false)->document.curves.size(), 9u);
  // A direction that was chosen counts, and what is no import stays apart.
  document.curves[5].pieces[0].direction = PieceDirection{0, false};
  EXPECT_EQ(startOf(arranged(document, true)->document.curves[1].pieces[0]), Vec2(30, 0));
  for (ExportCurve& line : document.curves) line.isImported = false;
  EXPECT_EQ(arranged(document, true)->document.curves.size(), 9u);
}

// Among curves that cross everywhere those are found that lie on another one, and no others.
TEST(Arrangement, FindsDoublesAmongManyCurvesThatCross) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(0.0, 200.0);
  ExportDocument document;
  constexpr std::size_t kCurves = 60;
  for (std::size_t i = 0; i < kCurves; ++i) {
    std::vector<Vec2> points;
    for (int k = 0; k < 12; ++k) points.emplace_back(place(random), place(random));
    document.curves.emplace_back().pieces.emplace_back().curve =
        test::made(3, {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 9}, points);
  }
  PiecesOnTop expected;
  for (std::size_t i = 0; i < kCurves; i += 7) {  // the whole curve again, the other way round, and a part of it
    const NurbsCurve whole = document.curves[i].pieces[0].curve;
    for (const NurbsCurve& again : {whole, reversed(whole), split(whole, 4.3)->right}) {
      expected.insert({document.curves.size(), 0});
      document.curves.emplace_back().pieces.emplace_back().curve = again;
    }
    // Only its start lies on the other.
    const auto half = split(whole, 2.5)->left;
    std::vector<Vec2> away(half.controlPoints().begin(), half.controlPoints().end());
    away.back() += Vec2(3.0, 1.0);
    document.curves.emplace_back().pieces.emplace_back().curve =
        test::made(3, {half.knots().begin(), half.knots().end()}, away);
  }
  const auto found = piecesOnTop(document);
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, expected);
}

}  // namespace
}  // namespace batten
