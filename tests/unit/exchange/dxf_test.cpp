// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include "core/curve/closest_point.h"
#include "core/exchange/cad/dxf_reader.h"
#include "core/exchange/cad/dxf_writer.h"
#include "core/exchange/export_file.h"
#include "core/exchange/model/cad_drawing.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

using test::exportOfAllDegrees;
using test::exportOfAllKinds;

ExportSettings dxf(DxfProfile profile, LengthUnit unit = LengthUnit::Millimetre) {
  ExportSettings settings;
  settings.format = ExportFormat::Dxf;
  settings.dxf = profile;
  settings.unit = unit;
  return settings;
}
struct Written {
  CadExport made;
  std::string text;
};
Written written(const ExportDocument& document, const ExportSettings& settings) {
  auto made = cadExport(document, settings);
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  auto text = writeDxf(made->drawing, settings.dxf);
  EXPECT_TRUE(text) << (text ? "" : text.error().message);
  return {std::move(*made), std::move(*text)};
}
int countOf(const std::string& text, const std::string& what) {
  int count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}
TEST(Dxf, CadProfileHoldsEveryDegreeExactly) {
  for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Inch}) {
    const ExportDocument document = exportOfAllDegrees();
    const Written file = written(document, dxf(DxfProfile::Cad, unit));
    const auto back = readDxf(file.text);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->mmPerUnit, millimetresPer(unit));
    ASSERT_EQ(back->entities.size(), 17u);  // six lines of the drawing, one in three pieces; seven degrees, arc, circle
    std::size_t next = 0;
    for (const ExportCurve& line : document.curves) {
      for (const ExportPiece& piece : line.pieces) {
        const CadEntity& entity = back->entities[next++];
        const bool exactParameter = std::holds_alternative<NurbsCurve>(entity.shape);
        for (int i = 0; i <= 200; ++i) {
          const Vec2 mm = millimetresPer(unit) * pointAt(entity.shape, i / 200.0);
          const Vec2 same =
              piece.curve.point(piece.curve.start() + (piece.curve.end() - piece.curve.start()) * i / 200);
          EXPECT_LE(exactParameter ? (mm - same).norm() : closestPoint(piece.curve, mm).distance, 1e-9) << line.id;
        }
      }
    }
  }
}

TEST(Dxf, WritesLinesArcsAndCirclesAsSuchUnlessOneKindIsAskedFor) {
  ExportSettings settings = dxf(DxfProfile::Cad);
  const std::string text = written(exportOfAllDegrees(), settings).text;
  EXPECT_EQ(countOf(text, "\nLINE\n"), 1);
  EXPECT_EQ(countOf(text, "\nARC\n"), 1);
  EXPECT_EQ(countOf(text, "\nCIRCLE\n"), 1);
  EXPECT_EQ(countOf(text, "\nSPLINE\n"), 14);
  settings.splinesOnly = true;
  const std::string splines = written(exportOfAllDegrees(), settings).text;
  EXPECT_EQ(countOf(splines, "\nSPLINE\n"), 17);
  EXPECT_EQ(countOf(splines, "\nLINE\n") + countOf(splines, "\nARC\n") + countOf(splines, "\nCIRCLE\n"), 0);
}

TEST(Dxf, SplinesArePlanarAndNothingElse) {
  const std::string text = written(exportOfAllKinds(), dxf(DxfProfile::Cad)).text;
  EXPECT_EQ(countOf(text, "AcDbSpline\n 70\n8\n"), countOf(text, "AcDbSpline\n")) << "flag 8, loops too";
  EXPECT_EQ(countOf(text, "$INSUNITS\n 70\n4\n"), 1);
  EXPECT_EQ(countOf(text, "nan") + countOf(text, "inf"), 0);
  const std::string inch = written(exportOfAllKinds(), dxf(DxfProfile::Cad, LengthUnit::Inch)).text;
  EXPECT_EQ(countOf(inch, "$INSUNITS\n 70\n1\n"), 1);
}

TEST(Dxf, SimpleKnotsNeverRepeatInside) {
  ExportSettings settings = dxf(DxfProfile::Cad);
  settings.simpleKnots = true;
  const Written file = written(exportOfAllKinds(), settings);
  const auto back = readDxf(file.text);
  ASSERT_TRUE(back);
  int splines = 0;
  for (const CadEntity& entity : back->entities) {
    const auto* curve = std::get_if<NurbsCurve>(&entity.shape);
    if (curve == nullptr) continue;
    ++splines;
    EXPECT_EQ(std::ssize(curve->knots()), std::ssize(curve->breaks()) + 2 * curve->degree());
  }
  EXPECT_GT(splines, 8) << "cut at the repeated knots";
}

TEST(Dxf, LaserProfileIsOneCubicPerBezierWithinTheTolerance) {
  for (const double tolerance : {0.05, 0.005}) {
    ExportSettings settings = dxf(DxfProfile::Laser);
    settings.toleranceMm = tolerance;
    const ExportDocument document = exportOfAllKinds();
    const Written file = written(document, settings);
    EXPECT_LE(file.made.largestErrorMm, tolerance);
    EXPECT_LE(file.made.largestJump, 0.02);
    const auto back = readDxf(file.text);
    ASSERT_TRUE(back);
    double worst = 0.0;
    for (const CadEntity& entity : back->entities) {
      if (const auto* curve = std::get_if<NurbsCurve>(&entity.shape)) {
        EXPECT_EQ(curve->degree(), 3);
        EXPECT_EQ(curve->controlPointCount(), 4);
      }
      for (int i = 0; i <= 40; ++i) {
        double nearest = 1e9;
        for (const ExportCurve& line : document.curves)
          for (const ExportPiece& piece : line.pieces)
            nearest = std::min(nearest, closestPoint(piece.curve, pointAt(entity.shape, i / 40.0)).distance);
        worst = std::max(worst, nearest);
      }
    }
    EXPECT_LE(worst, 1.02 * tolerance);
    EXPECT_LE(worst, 1.1 * file.made.largestErrorMm + 1e-9) << "what is stated was measured";
  }
}

TEST(Dxf, CncPolylinesKeepTheChordTolerance) {
  const ExportDocument document = exportOfAllKinds();
  std::size_t chords = 0;
  for (const bool arcs : {false, true}) {
    ExportSettings settings = dxf(DxfProfile::Cnc);
    settings.arcs = arcs;
    settings.joined = true;
    const Written file = written(document, settings);
    const std::string& text = file.text;
    EXPECT_NE(text.find("AC1009"), std::string::npos);
    EXPECT_EQ(text.find("SPLINE"), std::string::npos);
    const auto back = readDxf(file.text);
    ASSERT_TRUE(back);
    ASSERT_EQ(back->entities.size(), document.curves.size()) << "a polyline a line of the drawing";
    std::size_t vertices = 0;
    for (std::size_t i = 0; i < back->entities.size(); ++i) {
      const auto& line = std::get<CadPolyline>(back->entities[i].shape);
      vertices += line.vertices.size();
      EXPECT_EQ(line.closed, document.curves[i].closed);
      const auto polyline = curveOf(line);
      ASSERT_TRUE(polyline);
      for (const ExportPiece& piece : document.curves[i].pieces)
        for (int k = 0; k <= 200; ++k) {
          const Vec2 p = piece.curve.point(piece.curve.start() + (piece.curve.end() - piece.curve.start()) * k / 200);
          EXPECT_LE(closestPoint(*polyline, p).distance, 0.0101) << document.curves[i].id;
        }
    }
    if (arcs) {
      EXPECT_LT(vertices, chords / 2) << "arcs save vertices";
    }
    chords = vertices;
  }
}

TEST(Dxf, NamesAndLayersSurviveWhateverTheirLetters) {
  ExportDocument document = exportOfAllKinds();
  document.curves.resize(1);
  document.curves[0].name = "Süße Linie \"漢字\" 😀 \\U+";
  document.curves[0].layer = "Gefällig 漢字";
  const auto back = readDxf(written(document, dxf(DxfProfile::Cad)).text);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->entities[0].name, document.curves[0].name);
  EXPECT_EQ(back->entities[0].layer, document.curves[0].layer);
  document.curves[0].layer = "a/b:c*d";  // characters that AutoCAD refuses
  EXPECT_EQ(readDxf(written(document, dxf(DxfProfile::Cad)).text)->entities[0].layer, "a-b-c-d");
}

TEST(Dxf, JoinsWhatMeets) {
  const ExportDocument document = exportOfAllKinds();
  ExportSettings settings = dxf(DxfProfile::Cad);
  settings.joined = true;
  EXPECT_EQ(cadExport(document, settings)->drawing.entities.size(), document.curves.size());
}

TEST(Dxf, ScaleAndUnitsMultiply) {
  ExportSettings settings = dxf(DxfProfile::Cad, LengthUnit::Inch);
  settings.scale = 10.0;
  const auto back = readDxf(written(exportOfAllKinds(), settings).text);
  ASSERT_TRUE(back);
  const Vec2 first = pointAt(back->entities[0].shape, 0.0);
  EXPECT_LT((first - Vec2(100.0 / 25.4, 100.0 / 25.4)).norm(), 1e-12);
}

TEST(DxfReader, ReadsWhatOthersWrite) {
  const std::string text =
      "  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n     6\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n"
      "  0\nLWPOLYLINE\n  8\nA\n 90\n3\n 70\n1\n 10\n0.0\n 20\n0.0\n 42\n1.0\n 10\n2.0\n 20\n0.0\n 10\n2.0\n 20\n-1.0\n"
      "  0\nELLIPSE\n  8\nB\n 10\n5.0\n 20\n5.0\n 30\n0.0\n 11\n0.0\n 21\n3.0\n 31\n0.0\n 40\n0.5\n 41\n0.0\n 42\n"
      "1.5707963267948966\n  0\nINSERT\n  2\nX\n  0\nARC\n  8\nC\n 10\n0\n 20\n0\n 40\n2\n 50\n350\n 51\n10\n"
      "  0\nENDSEC\n  0\nEOF\n";
  const auto drawing = readDxf(text);
  ASSERT_TRUE(drawing) << drawing.error().message;
  EXPECT_EQ(drawing->mmPerUnit, 1000.0);
  EXPECT_EQ(drawing->left, 1) << "the block";
  ASSERT_EQ(drawing->entities.size(), 3u);
  EXPECT_LT((pointAt(drawing->entities[0].shape, 1.0 / 6) - Vec2(1, -1)).norm(), 1e-12) << "half circle to the left";
  const auto& quarter = std::get<NurbsCurve>(drawing->entities[1].shape);
  EXPECT_LT((quarter.point(quarter.start()) - Vec2(5, 8)).norm(), 1e-12);
  EXPECT_LT((quarter.point(quarter.end()) - Vec2(3.5, 5)).norm(), 1e-12) << "the minor axis is left of the major";
  EXPECT_NEAR(std::get<CadArc>(drawing->entities[2].shape).sweepRad, M_PI / 9, 1e-12);
}

TEST(DxfReader, SurvivesDamage) {
  const std::string whole = written(exportOfAllDegrees(), dxf(DxfProfile::Cad)).text;
  for (std::size_t length = 0; length < whole.size(); length += 97)
    EXPECT_FALSE(readDxf(whole.substr(0, length))) << "cut at " << length;
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    std::string text = whole;
    for (int flips = 0; flips < 20; ++flips) text[random() % text.size()] ^= static_cast<char>(1 << (random() % 8));
    const auto drawing = readDxf(text);
    if (!drawing) {
      EXPECT_FALSE(drawing.error().message.empty());
    }
  }
  for (const char* text : {"", "0", "hello", "0\nSECTION\n", "0\nEOF\n", "99999999999999999999\nx\n",
                           "0\nSECTION\n2\nENTITIES\n0\nSPLINE\n71\n2000000000\n72\n2000000000\n0\nENDSEC\n",
                           "AutoCAD Binary DXF\r\n\x1a"}) {
    EXPECT_FALSE(readDxf(text)) << text;
  }
  const auto nan = readDxf("0\nSECTION\n2\nENTITIES\n0\nLINE\n10\nnan\n20\n0\n11\n1\n21\n1\n0\nENDSEC\n0\nEOF\n");
  ASSERT_TRUE(nan);
  EXPECT_EQ(nan->left, 1);
}

}  // namespace
}  // namespace batten
