// SPDX-License-Identifier: GPL-3.0-or-later
// Files of Open CASCADE, read by parsers of the tests' own and evaluated by definition.
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "core/curve/closest_point.h"
#include "core/exchange/export_file.h"
#include "core/exchange/model/cad_drawing.h"
#include "core/exchange/model/drawing_figures.h"
#include "core/exchange/occt/iges.h"
#include "core/exchange/occt/open_cascade.h"
#include "core/exchange/occt/step_reader.h"
#include "core/exchange/occt/step_writer.h"
#include "tests/unit/exchange/cad_files.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

using test::exportOfAllDegrees;
using test::FoundCurve;
using test::FoundFile;

ExportSettings cad(ExportFormat format, LengthUnit unit, CurveFlavour flavour = CurveFlavour::Exact) {
  ExportSettings settings;
  settings.format = format;
  settings.unit = unit;
  settings.flavour = flavour;
  return settings;
}

std::string fileOf(const ExportDocument& document, const ExportSettings& settings) {
  const auto file = exportedFile(document, settings);
  EXPECT_TRUE(file) << (file ? "" : file.error().message + file.error().detail);
  return file ? file->bytes : std::string();
}
FoundFile parsed(const std::string& text, ExportFormat format) {
  return format == ExportFormat::Iges ? test::parseIges(text) : test::parseStep(text);
}

Vec2 placeOf(const FoundCurve& curve, double t) {
  if (curve.kind == FoundCurve::Kind::Line) return curve.points[0] + t * (curve.points[1] - curve.points[0]);
  if (curve.kind == FoundCurve::Kind::Spline)
    return test::splineByDefinition(curve.degree, curve.knots, curve.points, curve.weights, t);
  const Vec2 a = curve.points[1] - curve.points[0], b = curve.points[2] - curve.points[0];
  double sweep = std::atan2(cross(a, b), a.dot(b));
  if (sweep <= 1e-9) sweep += 2 * M_PI;
  const double at = std::atan2(a.y(), a.x()) + t * sweep;
  return curve.points[0] + a.norm() * Vec2(std::cos(at), std::sin(at));
}

class IgesAndStep : public testing::TestWithParam<std::tuple<ExportFormat, LengthUnit>> {
 protected:
  void SetUp() override { ASSERT_TRUE(hasOpenCascade()) << "install libocct-data-exchange-dev"; }
  ExportFormat format() const { return std::get<0>(GetParam()); }
  LengthUnit unit() const { return std::get<1>(GetParam()); }
};

TEST_P(IgesAndStep, TakeAnyNameOfAScan) {
  ExportDocument document = exportOfAllDegrees();
  document.title = "a\nb\x1b\xff.png";
  const auto file = exportedFile(document, cad(format(), unit()));
  EXPECT_TRUE(file) << file.error().message;
}

TEST_P(IgesAndStep, HoldEveryDegreeExactly) {
  const ExportDocument document = exportOfAllDegrees();
  const FoundFile file = parsed(fileOf(document, cad(format(), unit())), format());
  EXPECT_EQ(file.unit, unit() == LengthUnit::Inch ? (format() == ExportFormat::Iges ? "4HINCH" : "INCH")
                                                  : (format() == ExportFormat::Iges ? "2HMM" : "MM"));
  ASSERT_EQ(file.curves.size(), 17u);
  std::size_t next = 0;
  for (const ExportCurve& line : document.curves) {
    for (const ExportPiece& piece : line.pieces) {
      const FoundCurve& found = file.curves[next++];
      EXPECT_FALSE(found.periodicFlag);
      if (format() == ExportFormat::Step) {
        EXPECT_FALSE(found.closedFlag) << "receivers would make it periodic";
      }
      if (line.pieces.size() == 1) {
        EXPECT_EQ(found.name, line.id);
      }
      const bool sameParameter = found.kind == FoundCurve::Kind::Spline;
      if (sameParameter) {
        EXPECT_EQ(found.degree, piece.curve.degree()) << line.id;
      }
      for (int i = 0; i <= 200; ++i) {
        const Vec2 mm = millimetresPer(unit()) * placeOf(found, i / 200.0);
        const Vec2 same = piece.curve.point(piece.curve.start() + (piece.curve.end() - piece.curve.start()) * i / 200);
        EXPECT_LE(sameParameter ? (mm - same).norm() : closestPoint(piece.curve, mm).distance, 1e-9) << line.id;
      }
    }
  }
  EXPECT_EQ(file.curves[4].kind, FoundCurve::Kind::Line);
  EXPECT_EQ(file.curves[15].kind, FoundCurve::Kind::Arc);
  EXPECT_EQ(file.curves[16].kind, FoundCurve::Kind::Arc);
}

TEST_P(IgesAndStep, BezierSegmentsHaveNoKnotInside) {
  ExportSettings settings = cad(format(), unit(), CurveFlavour::BezierSegments);
  settings.splinesOnly = true;
  ExportDocument document = test::exportOfAllKinds();
  const FoundFile file = parsed(fileOf(document, settings), format());
  EXPECT_GT(file.curves.size(), 8u);
  for (const FoundCurve& curve : file.curves) EXPECT_EQ(std::ssize(curve.knots), 2 * (curve.degree + 1)) << curve.name;
}

TEST_P(IgesAndStep, CubicsKeepTheTolerance) {
  const ExportDocument document = test::exportOfAllKinds();
  const FoundFile file = parsed(fileOf(document, cad(format(), unit(), CurveFlavour::Cubic)), format());
  ASSERT_EQ(file.curves.size(), 8u) << "one curve a piece, but for the chain's corner";
  for (const FoundCurve& curve : file.curves) {
    if (curve.kind != FoundCurve::Kind::Spline) continue;
    EXPECT_EQ(curve.degree, 3);
    for (int i = 0; i <= 200; ++i) {
      double nearest = 1e9;
      for (const ExportCurve& line : document.curves)
        for (const ExportPiece& piece : line.pieces)
          nearest =
              std::min(nearest, closestPoint(piece.curve, millimetresPer(unit()) * placeOf(curve, i / 200.0)).distance);
      EXPECT_LE(nearest, 0.00501);
    }
  }
}

TEST_P(IgesAndStep, NumbersAreWrittenAsTheStandardsWant) {
  ExportDocument document = test::exportOfAllKinds();
  document.curves.push_back({"tiny", false, {{test::made(1, {0, 0, 1, 1}, {{1e-17, 0}, {1e4, 1e4 + 1e-9}})}}});
  document.curves.push_back(
      {"small", false, {{test::made(2, {0, 0, 0, 1, 1, 1}, {{1e-17, -1e-13}, {5e-7, 3e-7}, {9e3, 12}})}}});
  const std::string text = fileOf(document, cad(format(), unit()));
  EXPECT_FALSE(std::regex_search(text, std::regex("[0-9.]e[-+]?[0-9]"))) << "a lower-case exponent";
  EXPECT_EQ(text.find("nan"), std::string::npos);
  if (format() != ExportFormat::Step) return;
  EXPECT_FALSE(std::regex_search(text, std::regex("[(,][-+]?[0-9]+E[-+]"))) << "a mantissa without a point";
  EXPECT_NE(text.find("AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }"), std::string::npos);
}

TEST_P(IgesAndStep, NamesSurviveWhateverTheirLetters) {
  ExportDocument document = test::exportOfAllKinds();
  document.curves.resize(2);
  document.curves[0].name = "It's süß, 漢字 \\ 😀";
  document.curves[1].name = "a, b; c (d)";
  document.title = "Süße Skizze.png";
  const std::string text = fileOf(document, cad(format(), unit()));
  const auto back = format() == ExportFormat::Iges ? readIges(text) : readStep(text);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->entities[0].name, document.curves[0].name);
  EXPECT_EQ(back->entities[1].name, document.curves[1].name);
  if (format() == ExportFormat::Step) {
    EXPECT_NE(text.find("'It''s s\\X2\\00FC00DF\\X0\\, "), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(Units, IgesAndStep,
                         testing::Combine(testing::Values(ExportFormat::Iges, ExportFormat::Step),
                                          testing::Values(LengthUnit::Millimetre, LengthUnit::Inch)));

TEST(StepFile, StatesLengthCentroidAndPlacesForItsReceiver) {
  ExportDocument document = test::exportOfAllKinds();
  document.curves = {{"line", false, {{test::made(1, {0, 0, 50, 50}, {{10, 20}, {40, 60}})}}},
                     {"circle", true, {{curveOf(CadArc{{90, 80}, 7.25, 1.0, 2 * M_PI}).value()}}}};
  const std::string text = fileOf(document, cad(ExportFormat::Step, LengthUnit::Millimetre));
  const auto count = [&](const std::string& what) {
    int found = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("'geometric_validation_property'"), 3);
  EXPECT_EQ(count("'independent curve length'"), 2) << "property and representation";
  EXPECT_EQ(count("'sampling point'"), 10);
  std::string flat = text;
  std::erase_if(flat, [](char c) { return c == '\n' || c == ' '; });
  std::smatch match;
  ASSERT_TRUE(std::regex_search(flat, match, std::regex("curvelengthmeasure',LENGTH_MEASURE\\(([0-9.E+-]+)\\)")));
  const double circle = 2 * M_PI * 7.25;
  EXPECT_NEAR(std::stod(match[1]), 50.0 + circle, 1e-9);
  ASSERT_TRUE(std::regex_search(flat, match, std::regex("curvecentrepoint',\\(([0-9.E+-]+),([0-9.E+-]+),")));
  EXPECT_NEAR(std::stod(match[1]), (50.0 * 25 + circle * 90) / (50 + circle), 1e-9);
  EXPECT_NEAR(std::stod(match[2]), (50.0 * 40 + circle * 80) / (50 + circle), 1e-9);
}

TEST(StepFile, IsWrittenWhileOthersAreWritten) {
  // Open CASCADE, which is loaded by the first, keeps its unit in one place for all.
  const ExportDocument document = exportOfAllDegrees();
  std::vector<std::thread> writers;
  for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Inch}) {
    for (const ExportFormat format : {ExportFormat::Iges, ExportFormat::Step})
      writers.emplace_back([&document, unit, format] {
        for (int i = 0; i < 3; ++i) {
          const std::string found = parsed(fileOf(document, cad(format, unit)), format).unit;
          EXPECT_EQ(found.find("INCH") != std::string::npos, unit == LengthUnit::Inch) << found;
        }
      });
  }
  for (std::thread& writer : writers) writer.join();
}

}  // namespace
}  // namespace batten
