// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/import_curves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/curve/closest_point.h"
#include "core/curve/knot_operations.h"
#include "core/document/export_builder.h"
#include "core/document/report.h"
#include "core/exchange/export_file.h"
#include "core/exchange/import_file.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {
namespace {

using testing::HasSubstr;

NurbsCurve cubic(const Vec2& from) {
  return NurbsCurve::make(3, {0, 0, 0, 0, 20, 40, 40, 40, 40},
                          {from, from + Vec2(10, 8), from + Vec2(20, 10), from + Vec2(30, 4), from + Vec2(40, 6)})
      .value();
}
NurbsCurve straight(const Vec2& from, const Vec2& to) {
  const double length = (to - from).norm();
  return NurbsCurve::make(1, {0, 0, length, length}, {from, to}).value();
}
NurbsCurve circle(const Vec2& centre, double radius) {
  const double w = std::sqrt(0.5);
  std::vector<Vec2> points;
  for (const auto& [x, y] : {std::pair(1, 0), {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}})
    points.push_back(centre + radius * Vec2(x, y));
  return NurbsCurve::make(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, points, {1, w, 1, w, 1, w, 1, w, 1}).value();
}

/// Far from the origin, as a car's coordinates are: a corner between a cubic and a line, a circle, and a wave of
/// points.
ImportedFile roof() {
  ImportedFile file{"roof.dxf", "mm", {}};
  const Vec2 at(-2100.25, 850.5);
  file.lines.push_back({"roof", {}, {{cubic(at)}, {straight(at + Vec2(40, 6), at + Vec2(60, 0))}}, {}, {}, false});
  file.lines.push_back({"wheel", {}, {{circle(at + Vec2(30, -20), 12.0)}}, {}, {}, true});
  ImportedLine wave{"wave", {}, {}, {}, {40}, false};
  for (int i = 0; i <= 80; ++i) {
    const double x = i;
    wave.points.push_back(at + Vec2(0.75 * x, 30.0 + 4.0 * std::sin(0.1 * x) + (i > 40 ? 1.5 * (x - 40) : 0.0)));
  }
  file.lines.push_back(wave);
  return file;
}

PipelineOutput run(const Recipe& recipe) {
  const Scan page = blankScan(recipe.page->widthPx, recipe.page->heightPx, *recipe.dpi);
  StageCache cache;
  return runPipeline(page, recipe, cache, {}, {});
}

TEST(ImportedCurves, StayExactWhereverTheyLie) {
  const Recipe recipe = drawingOf(roof());
  ASSERT_FALSE(validate(recipe)) << validate(recipe)->message;
  const auto out = run(recipe);
  ASSERT_FALSE(out.error) << out.error->message;
  ASSERT_EQ(out.faired->curves.size(), 5u) << "two of the roof, the wheel, two of the wave";
  const auto& lines = recipe.imports[0].lines;
  EXPECT_TRUE(out.faired->curves[0].faired == lines[0].curves[0].curve);
  EXPECT_TRUE(out.faired->curves[1].faired == lines[0].curves[1].curve);
  EXPECT_TRUE(out.faired->curves[2].faired == lines[1].curves[0].curve);
  EXPECT_TRUE(out.faired->curves[2].closed);
  for (const TracedCurve& curve : out.faired->curves) {
    EXPECT_LT(curve.sketchedFigures.fromPoints.max, 1.0 * out.frame.mmPerPx);
    const Vec2 px = out.frame.pointToImage(curve.faired.point(curve.faired.start()));
    EXPECT_TRUE(px.x() >= 0 && px.x() <= out.frame.widthPx && px.y() >= 0 && px.y() <= out.frame.heightPx)
        << "the page lies around the lines";
  }
  // The wave is made of its points and keeps its corner exactly.
  const Vec2 corner = lines[2].points[40];
  EXPECT_LT((out.faired->curves[3].faired.point(1e9) - corner).norm(), 1e-9);
  EXPECT_LT((out.faired->curves[4].faired.point(0.0) - corner).norm(), 1e-9);
  const auto document = exportDocument(out, recipe, blankScan(16, 16, 96.0));
  EXPECT_EQ(document.curves.size(), 3u);
  EXPECT_EQ(document.title, "roof.dxf");
}

TEST(ImportedCurves, LiveInTheRecipeToTheLastBit) {
  Recipe recipe = drawingOf(roof());
  recipe.scanPage = {3, 150.0};
  const auto back = recipeFromJson(recipeToJson(recipe));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(*back == recipe);
  EXPECT_THAT(recipeToJson(recipe), HasSubstr("\"source\": \"roof.dxf\""));
}

TEST(ImportedCurves, KeepTheirNamesAndLayersInFilesAndReports) {
  ImportedFile file = roof();
  file.lines[0].curves[0].name = "front";
  file.lines[0].curves[1].name = "rear";
  file.lines[0].layer = "body";
  file.lines[1].layer = "Faired";
  Recipe recipe = drawingOf(file);
  EXPECT_TRUE(recipeFromJson(recipeToJson(recipe))->imports == recipe.imports);
  const auto out = run(recipe);
  ASSERT_FALSE(out.error) << out.error->message;
  const Scan page = blankScan(16, 16, 96.0);
  const auto document = exportDocument(out, recipe, page, ExportedCurves::Both);
  std::vector<std::string> names, layers;
  for (const ExportCurve& line : document.curves) {
    layers.push_back(line.layer);
    for (const ExportPiece& piece : line.pieces) names.push_back(piece.name);
  }
  const std::vector<std::string> all = {"front", "rear", "wheel", "wave 1", "wave 2"};
  ASSERT_EQ(names.size(), 10u);
  EXPECT_EQ(std::vector<std::string>(names.begin() + 5, names.end()), all);
  EXPECT_EQ(layers,
            (std::vector<std::string>{"body sketched", "Faired sketched", "Sketched", "body", "Faired", "Faired"}));
  EXPECT_EQ(exportDocument(out, recipe, page).curves[0].layer, "body");
  EXPECT_THAT(reportToJson(page, recipe, out, {}), HasSubstr("\"name\": \"rear\""));
  // A part of a curve is told from the rest of it.
  recipe.cornerMarks.push_back({out.frame.pointToImage(file.lines[0].curves[0].curve.point(20.0))});
  const auto cut = run(recipe);
  ASSERT_EQ(cut.faired->curves.size(), 6u);
  EXPECT_EQ(nameOfCurve(cut, recipe, cut.faired->curves[1]), "front 2");
  EXPECT_EQ(nameOfCurve(cut, recipe, cut.faired->curves[2]), "rear");
}

TEST(ImportedCurves, NamesThatBattenGaveAreNumbersAgain) {
  ImportedFile file = roof();
  file.lines[0].name = file.lines[0].curves[0].name = "Curve 7";
  file.lines[0].curves[1].name = "Curve 3";
  file.lines[1].curves[0].name = "Curve 7";  // of one name the first
  file.lines[2].name = "Curve 12";
  file.lines[2].corners.clear();
  const Recipe recipe = drawingOf(file);
  const auto out = run(recipe);
  ASSERT_FALSE(out.error) << out.error->message;
  std::vector<std::string> names;
  for (const TracedCurve& curve : out.faired->curves) {
    names.push_back(nameOfCurve(out, recipe, curve));
    EXPECT_EQ(names.back(), "Curve " + std::to_string(curveNumber(out, curve)));
  }
  EXPECT_EQ(names, (std::vector<std::string>{"Curve 7", "Curve 3", "Curve 13", "Curve 12"}));
}

TEST(ImportedCurves, ACsvOfThemComesBackAtItsPlace) {
  const Recipe recipe = drawingOf(roof());
  const auto out = run(recipe);
  const auto document = exportDocument(out, recipe, blankScan(16, 16, 96.0));
  ExportSettings settings;
  settings.format = ExportFormat::Csv;
  const auto path = std::filesystem::temp_directory_path() / ("batten-csv" + std::to_string(getpid()) + ".csv");
  ASSERT_TRUE(exportToFile(document, settings, path));
  std::ifstream in(path);
  std::string first;
  std::getline(in, first);
  EXPECT_THAT(first, HasSubstr("from the origin of the file that was imported"));
  const auto back = readImportFile(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->file.lines.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const ImportedLine& line = back->file.lines[i];
    const NurbsCurve& from = document.curves[i].pieces[0].curve;
    EXPECT_LT((line.points.front() - from.point(from.start())).norm(), 1e-9) << i;
    EXPECT_EQ(line.name, recipe.imports[0].lines[i].name);
    EXPECT_EQ(line.closed, recipe.imports[0].lines[i].closed) << i;
  }
  // The corner between the pieces is where it was.
  ASSERT_EQ(back->file.lines[0].corners.size(), 1u);
  EXPECT_LT((back->file.lines[0].points[back->file.lines[0].corners[0]] - Vec2(-2100.25 + 40, 850.5 + 6)).norm(), 1e-9);
}

TEST(ImportedCurves, DamagedImportsInARecipeAreRefusedWithAReason) {
  const std::string whole = recipeToJson(drawingOf(roof()));
  const auto with = [&](const std::string& what, const std::string& instead) {
    std::string text = whole;
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), instead);
    const auto recipe = recipeFromJson(text);
    return recipe ? std::string("read") : recipe.error().message;
  };
  EXPECT_THAT(with("\"degree\": 3", "\"degree\": 3000000000"), HasSubstr("degree"));
  EXPECT_THAT(with("\"degree\": 3", "\"degree\": 4"), HasSubstr("Not a valid curve"));
  EXPECT_THAT(with("\"source\"", "\"sauce\""), HasSubstr("sauce"));
  EXPECT_THAT(with("-2100.25", "-2100250000.0"), HasSubstr("100 m"));
  EXPECT_THAT(with("\"closed\": false", "\"closed\": true"), HasSubstr("end to end"));
  EXPECT_THAT(with("40\n", "400\n"), HasSubstr("corner"));
}

TEST(ImportedCurves, AMarkCutsACurveWithoutChangingIt) {
  Recipe recipe = drawingOf(roof());
  const auto before = run(recipe);
  const NurbsCurve whole = recipe.imports[0].lines[0].curves[0].curve;
  const NurbsCurve wheel = recipe.imports[0].lines[1].curves[0].curve;
  recipe.cornerMarks = {{before.frame.pointToImage(whole.point(25.0))},
                        {before.frame.pointToImage(wheel.point(0.7))},
                        {before.frame.pointToImage(wheel.point(2.6))}};
  const auto out = run(recipe);
  ASSERT_FALSE(out.error) << out.error->message;
  ASSERT_EQ(out.faired->curves.size(), 7u);
  for (const std::size_t i : {0u, 1u}) {
    const NurbsCurve& part = out.faired->curves[i].faired;
    for (int k = 0; k <= 50; ++k) {
      const Vec2 p = part.point(part.start() + (part.end() - part.start()) * k / 50);
      EXPECT_LT(closestPoint(whole, p).distance, 1e-9) << i;
    }
  }
  // Of the circle one part goes over its seam.
  double length = 0.0;
  for (const std::size_t i : {3u, 4u}) {
    const TracedCurve& part = out.faired->curves[i];
    EXPECT_FALSE(part.closed);
    length += part.fairedFigures.lengthMm;
    for (int k = 0; k <= 50; ++k) {
      const Vec2 p = part.faired.point(part.faired.start() + (part.faired.end() - part.faired.start()) * k / 50);
      EXPECT_NEAR((p - Vec2(-2070.25, 830.5)).norm(), 12.0, 1e-9) << i;
    }
  }
  EXPECT_NEAR(length, 24.0 * std::numbers::pi, 1e-6);
}

TEST(ImportedCurves, CanBeMadeFairAndBuiltAnew) {
  ImportedFile file{"bump.igs", "mm", {}};
  // An arch with a bump that no tool would leave, of degree 3.
  std::vector<Vec2> points;
  std::vector<double> knots(4, 0.0);
  for (int i = 0; i < 12; ++i) points.emplace_back(9.0 * i, 20.0 * std::sin(0.285 * i) + (i == 5 ? 0.8 : 0.0));
  for (int i = 1; i < 9; ++i) knots.push_back(11.0 * i);
  knots.insert(knots.end(), 4, 99.0);
  file.lines.push_back({"arch", {}, {{NurbsCurve::make(3, knots, points).value()}}, {}, {}, false});
  Recipe recipe = drawingOf(file);
  const auto plain = run(recipe);
  ASSERT_FALSE(plain.error);
  recipe.fairing.mode = FairingMode::Tolerance;
  recipe.fairing.toleranceMm = 1.0;
  const auto faired = run(recipe);
  ASSERT_FALSE(faired.error) << faired.error->message;
  const TracedCurve& curve = faired.faired->curves[0];
  EXPECT_TRUE(curve.sketched == file.lines[0].curves[0].curve) << "what was imported stays";
  EXPECT_FALSE(curve.faired == curve.sketched) << curve.fairing.note;
  EXPECT_LT(curve.fairedFigures.extrema, plain.faired->curves[0].fairedFigures.extrema);
  EXPECT_LE(curve.fairing.maxDeviationMm, 1.0 + 1e-9);
  EXPECT_EQ(curve.faired.degree(), 5);
  // A method chosen for the curve builds it from its points.
  Recipe anew = drawingOf(file);
  anew.construct.light = false;
  PieceChoice choice;
  choice.method = ConstructMethod::Fair;
  choice.anchorsPx = {plain.frame.pointToImage(file.lines[0].curves[0].curve.point(50.0))};
  anew.choices.push_back(choice);
  const auto built = run(anew);
  ASSERT_FALSE(built.error);
  EXPECT_EQ(built.faired->curves[0].sketched.degree(), 5);
  EXPECT_LT(built.faired->curves[0].sketchedFigures.fromPoints.max, 0.2);
}

TEST(ImportedCurves, LieOnTheScanThatIsBelow) {
  const PageFrame frame{1000, 500, 0.1};  // 100 x 50 mm
  ImportedFile near{"a.csv", "mm", {{"", {}, {}, {{10, 10}, {50, 20}, {90, 10}}, {}, false}}};
  const auto kept = withImport({}, near, frame);
  EXPECT_FALSE(kept.moved);
  EXPECT_TRUE(kept.recipe.imports[0] == near);
  ImportedFile far{"b.csv", "mm", {{"", {}, {}, {{1010, 10}, {1050, 20}}, {}, false}}};
  const auto moved = withImport(kept.recipe, far, frame);
  EXPECT_TRUE(moved.moved);
  ASSERT_EQ(moved.recipe.imports.size(), 2u);
  EXPECT_LT((moved.recipe.imports[1].lines[0].points[0] - Vec2(30, 20)).norm(), 1e-9);
  EXPECT_FALSE(moved.recipe.page) << "the page is the scan's";
}

TEST(ImportedCurves, AnotherResolutionLeavesThemWhereTheyAre) {
  Recipe recipe = drawingOf(roof());
  const auto coarse = run(recipe);
  recipe.dpi = *recipe.dpi * 1.5;
  const auto fine = run(recipe);
  ASSERT_FALSE(fine.error);
  EXPECT_TRUE(coarse.faired->curves[0].faired == fine.faired->curves[0].faired);
}

TEST(ImportedCurves, TheirUnitCanBeChosenLater) {
  ImportedFile file = roof();
  for (ImportedLine& line : file.lines) {
    for (Vec2& p : line.points) p += Vec2(2100, -850);
    for (auto& [curve, name] : line.curves) curve = curve.mapped(Eigen::Matrix2d::Identity(), Vec2(2100, -850));
  }
  file.unit = "mm?";
  const Recipe assumed = drawingOf(file);
  const auto before = run(assumed);
  const auto inches = withImportUnit(assumed, 0, "in", before.frame);
  ASSERT_TRUE(inches) << inches.error().message;
  EXPECT_EQ(inches->imports[0].unit, "in");
  const auto out = run(*inches);
  ASSERT_EQ(out.faired->curves.size(), before.faired->curves.size());
  EXPECT_NEAR(out.faired->curves[2].fairedFigures.lengthMm, 25.4 * before.faired->curves[2].fairedFigures.lengthMm,
              1e-6);
  const Vec2 px = before.frame.pointToImage(assumed.imports[0].lines[0].curves[0].curve.point(7.0));
  EXPECT_LT((out.frame.pointToImage(inches->imports[0].lines[0].curves[0].curve.point(7.0)) - px).norm(), 1e-6)
      << "marks stay where they are";
  const auto back = withImportUnit(*inches, 0, "mm", out.frame);
  ASSERT_TRUE(back);
  EXPECT_NEAR(*back->dpi, *assumed.dpi, 1e-9);
  EXPECT_FALSE(withImportUnit(assumed, 0, "ell", before.frame));
  EXPECT_THAT(withImportUnit(drawingOf(roof()), 0, "m", before.frame).error().message, HasSubstr("100 m"));
  // On another page the order of the imports stays.
  Recipe two = assumed;
  two.imports.push_back(roof());
  const auto second = withImportUnit(two, 0, "cm", before.frame);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->imports[0].unit, "cm");
  EXPECT_EQ(second->imports[1].source, "roof.dxf");
  ImportedFile feet = roof();
  feet.unit = "304.8 mm";
  EXPECT_EQ(millimetresOfImport(feet), 304.8);
}

// A line may come through one place several times, as the petals of a flower do: its joints there are as many.
TEST(ImportedCurves, ThatMeetInOnePlaceStayExact) {
  constexpr int kPetals = 5;
  ImportedLine flower{"flower", {}, {}, {}, {}, true};
  for (int i = 0; i < kPetals; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPetals;
    const Vec2 out(60.0 * std::cos(angle), 60.0 * std::sin(angle)), across(-0.4 * out.y(), 0.4 * out.x());
    flower.curves.push_back(
        {NurbsCurve::make(3, {0, 0, 0, 0, 1, 1, 1, 1}, {Vec2::Zero(), out - across, out + across, Vec2::Zero()})
             .value()});
  }
  ImportedFile file{"flower.svg", "mm", {flower}};
  const auto out = run(drawingOf(file));
  ASSERT_FALSE(out.error) << out.error->message;
  ASSERT_EQ(out.faired->curves.size(), std::size_t{kPetals});
  for (std::size_t i = 0; i < flower.curves.size(); ++i)
    EXPECT_TRUE(out.faired->curves[i].sketched == flower.curves[i].curve) << i;
}

}  // namespace
}  // namespace batten
