// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/import_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include "core/exchange/export_file.h"
#include "core/exchange/iges_reader.h"
#include "core/exchange/occt/open_cascade.h"
#include "core/exchange/point_file.h"
#include "core/exchange/step_reader.h"
#include "core/exchange/svg_path_data.h"
#include "core/exchange/svg_shapes.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Import : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("batten Süße 漢字 " + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  ImportReport read(const std::string& name, const std::string& bytes, std::optional<double> unit = {}) const {
    auto report = readImportFile(write(name, bytes), unit);
    EXPECT_TRUE(report) << report.error().message;
    return report ? *report : ImportReport{};
  }
  std::string refusal(const std::string& name, const std::string& bytes) const {
    const auto report = readImportFile(write(name, bytes));
    if (report) return "read";
    EXPECT_EQ(report.error().message.find('\n'), std::string::npos);
    return report.error().message;
  }
  fs::path folder_;
};

std::vector<NurbsCurve> curvesOf(const ImportReport& report) {
  std::vector<NurbsCurve> curves;
  for (const ImportedLine& line : report.file.lines)
    for (const ImportedCurve& curve : line.curves) curves.push_back(curve.curve);
  return curves;
}

/// Largest distance at 200 equal fractions of the parameters, whichever way round.
double apart(const NurbsCurve& a, const NurbsCurve& b) {
  double same = 0.0, turned = 0.0;
  for (int i = 0; i <= 200; ++i) {
    const double f = i / 200.0;
    const Vec2 p = a.point(a.start() + f * (a.end() - a.start()));
    same = std::max(same, (p - b.point(b.start() + f * (b.end() - b.start()))).norm());
    turned = std::max(turned, (p - b.point(b.end() - f * (b.end() - b.start()))).norm());
  }
  return std::min(same, turned);
}

TEST_F(Import, WhatBattenWritesComesBackExactlyInEveryFormatAndUnit) {
  for (const ExportDocument& document : {test::exportOfAllKinds(), test::exportOfAllDegrees()}) {
    std::vector<NurbsCurve> written;
    for (const ExportCurve& line : document.curves) {
      for (const ExportPiece& piece : line.pieces) written.push_back(piece.curve);
    }
    for (const char* ending : {".dxf", ".igs", ".step", ".svg", ".json"}) {
      if (!hasOpenCascade() && (std::string(ending) == ".igs" || std::string(ending) == ".step")) continue;
      for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Inch}) {
        const fs::path path = folder_ / (std::string("a") + ending);
        ExportSettings settings;
        settings.format = *formatOf(path);
        settings.unit = unit;
        settings.splinesOnly = true;
        const auto report = exportToFile(document, settings, path);
        ASSERT_TRUE(report) << ending << " " << report.error().message;
        const auto back = readImportFile(path);
        ASSERT_TRUE(back) << ending << " " << back.error().message;
        const auto curves = curvesOf(*back);
        ASSERT_EQ(curves.size(), written.size()) << ending;
        for (std::size_t i = 0; i < curves.size(); ++i) EXPECT_LE(apart(curves[i], written[i]), 1e-9) << ending << i;
        EXPECT_TRUE(back->notes.empty()) << ending << back->notes.front();
      }
    }
  }
}

const char* const kDxfHead = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
const char* const kDxfEnd = "0\nENDSEC\n0\nEOF\n";

TEST_F(Import, EntitiesThatMeetBecomeOneLineWithCorners) {
  // A line, a quarter of a circle that goes on from it, whichever way it is written, and a line back: closed.
  const std::string text = std::string(kDxfHead) + "0\nLINE\n8\nA\n10\n0\n20\n0\n11\n10\n21\n0\n" +
                           "0\nARC\n8\nA\n10\n0\n20\n0\n40\n10\n50\n0\n51\n90\n" +
                           "0\nLINE\n8\nA\n10\n0\n20\n10\n11\n0\n21\n0\n" + "0\nCIRCLE\n8\nA\n10\n50\n20\n0\n40\n5\n" +
                           kDxfEnd;
  const ImportReport report = read("a.dxf", text);
  ASSERT_EQ(report.file.lines.size(), 2u);
  EXPECT_EQ(report.file.lines[0].curves.size(), 3u);
  EXPECT_TRUE(report.file.lines[0].closed);
  EXPECT_TRUE(report.file.lines[1].closed) << "the circle";
  EXPECT_EQ(report.file.unit, "mm");
  EXPECT_EQ(report.file.source, "a.dxf");
}

TEST_F(Import, PolylinesBecomePointsWithTheirCorners) {
  std::string text = std::string(kDxfHead) + "0\nLWPOLYLINE\n8\nA\n90\n4\n70\n1\n";
  for (const char* p : {"10\n0\n20\n0\n", "10\n30\n20\n0\n", "10\n30\n20\n20\n", "10\n0\n20\n20\n"}) text += p;
  // A dense arch with one sharp tip.
  text += "0\nLWPOLYLINE\n8\nA\n90\n41\n70\n0\n";
  for (int i = 0; i <= 40; ++i) {
    const double x = i, y = 20.0 - std::abs(i - 20);
    text += "10\n" + std::to_string(x) + "\n20\n" + std::to_string(y) + "\n";
  }
  const ImportReport report = read("p.dxf", text + kDxfEnd);
  ASSERT_EQ(report.file.lines.size(), 2u);
  EXPECT_EQ(report.file.lines[0].points.size(), 4u);
  EXPECT_TRUE(report.file.lines[0].closed);
  EXPECT_EQ(report.file.lines[0].corners, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(report.file.lines[1].points.size(), 41u);
  EXPECT_EQ(report.file.lines[1].corners, (std::vector<int>{20}));
}

TEST_F(Import, TheUnitIsThatOfTheFileElseMillimetresElseWhatTheUserSays) {
  const std::string line = "0\nLINE\n8\nA\n10\n0\n20\n0\n11\n1\n21\n0\n";
  const std::string bare = "0\nSECTION\n2\nENTITIES\n" + line + kDxfEnd;
  const ImportReport assumed = read("bare.dxf", bare);
  EXPECT_EQ(assumed.file.unit, "mm?");
  ASSERT_EQ(assumed.notes.size(), 1u);
  EXPECT_THAT(assumed.notes[0], HasSubstr("no unit"));
  const ImportReport told = read("bare.dxf", bare, 25.4);
  EXPECT_EQ(told.file.unit, "in");
  EXPECT_NEAR(curvesOf(told)[0].controlPoints()[1].x(), 25.4, 1e-12);
}

TEST_F(Import, TheUsersUnitGoesBeforeThatOfSvgAndOwnFiles) {
  const std::string sized =
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 200 100">)"
      R"(<path d="M0,100 L40,100"/></svg>)";
  EXPECT_NEAR(curvesOf(read("a.svg", sized))[0].controlPoints().back().x(), 20.0, 1e-12);
  const ImportReport inches = read("a.svg", sized, 25.4);
  EXPECT_EQ(inches.file.unit, "in");
  EXPECT_NEAR(curvesOf(inches)[0].controlPoints().back().x(), 1016.0, 1e-9);
  const ImportReport bare = read("b.svg", R"(<svg xmlns="http://www.w3.org/2000/svg"><line x2="3"/></svg>)", 10.0);
  EXPECT_TRUE(bare.notes.empty()) << "nothing was assumed";
  EXPECT_NEAR(curvesOf(bare)[0].controlPoints().back().x(), 30.0, 1e-9);
  for (const char* ending : {".svg", ".json"}) {
    ExportSettings settings;
    const fs::path path = folder_ / (std::string("own") + ending);
    settings.format = *formatOf(path);
    ASSERT_TRUE(exportToFile(test::exportOfAllKinds(), settings, path));
    const auto plain = readImportFile(path), scaled = readImportFile(path, 10.0);
    ASSERT_TRUE(plain && scaled);
    EXPECT_EQ(scaled->file.unit, "cm");
    EXPECT_LE((10.0 * curvesOf(*plain)[0].controlPoints()[1] - curvesOf(*scaled)[0].controlPoints()[1]).norm(), 1e-9);
  }
}

/// An SVG of ours with the second curve's path changed by what `edit` does to its data.
std::string editedSvg(const std::function<std::string(std::string)>& edit) {
  ExportDocument document = test::exportOfAllKinds();
  document.frame.leftMm = -20.0;
  document.frame.bottomMm = 5.0;
  std::string svg = exportedFile(document, {})->bytes;
  const auto at = svg.find("<path id=\"curve-2\""), begin = svg.find(" d=\"", at) + 4, end = svg.find('"', begin);
  return svg.replace(begin, end - begin, edit(svg.substr(begin, end - begin)));
}

TEST_F(Import, OwnSvgKeepsItsExactCurvesWhereThePathsStillShowThem) {
  const ImportReport same = read("own.svg", editedSvg([](std::string data) { return data; }));
  ASSERT_EQ(same.file.lines.size(), 6u);
  EXPECT_TRUE(same.notes.empty());
  EXPECT_TRUE(same.file.lines[1].curves[0].curve == test::severalSpans());
  // Another program writes fewer digits; the handles stay within a thousandth of a millimetre.
  const ImportReport rounded = read("own.svg", editedSvg([](std::string data) {
                                      std::string result;
                                      for (std::size_t i = 0, behind = 0; i < data.size(); ++i) {
                                        behind = data[i] == '.' ? 1
                                                 : behind > 0 && std::isdigit(static_cast<unsigned char>(data[i]))
                                                     ? behind + 1
                                                     : 0;
                                        if (behind <= 5) result += data[i];
                                      }
                                      return result;
                                    }));
  EXPECT_TRUE(rounded.notes.empty());
  EXPECT_TRUE(rounded.file.lines[1].curves[0].curve == test::severalSpans());
}

TEST_F(Import, AnEditedPathOfAnOwnSvgIsReadAsItIsDrawn) {
  // The last place is drawn 3 mm farther to the right.
  const std::string svg = editedSvg([](std::string data) {
    const auto end = data.rfind(','), begin = data.rfind(' ', end) + 1;
    return data.replace(begin, end - begin, std::to_string(std::stod(data.substr(begin, end - begin)) + 3.0));
  });
  const ImportReport report = read("own.svg", svg);
  ASSERT_EQ(report.file.lines.size(), 6u);
  const NurbsCurve& drawn = report.file.lines[1].curves.back().curve;
  EXPECT_LT((drawn.point(drawn.end()) - Vec2(73, 40)).norm(), 1e-5);
  EXPECT_TRUE(report.file.lines[0].curves[0].curve == test::oneSpan()) << "the others stay exact";
  ASSERT_EQ(report.notes.size(), 2u);
  EXPECT_THAT(report.notes[0], HasSubstr("1 path was changed by another program"));
  EXPECT_THAT(report.notes[1], HasSubstr("1 curve written by Batten is no longer drawn"));
}

TEST_F(Import, PathsAddedToAnOwnSvgOrTakenFromItCount) {
  std::string svg = editedSvg([](std::string data) { return data; });
  const auto at = svg.find("<path id=\"curve-2\""), end = svg.find("/>", at) + 2;
  const ImportReport without = read("own.svg", std::string(svg).erase(at, end - at));
  EXPECT_EQ(without.file.lines.size(), 5u);
  ASSERT_EQ(without.notes.size(), 1u);
  EXPECT_THAT(without.notes[0], HasSubstr("1 curve written by Batten is no longer drawn"));
  const ImportReport more = read("own.svg", svg.insert(at, "<path d=\"M1,1 L20,7\"/>"));
  EXPECT_EQ(more.file.lines.size(), 7u);
  ASSERT_EQ(more.notes.size(), 1u);
  EXPECT_THAT(more.notes[0], HasSubstr("1 path was changed by another program"));
  // Moved as a whole by the other program.
  const auto group = svg.find("<g id=");
  const ImportReport moved = read("own.svg", svg.insert(group + 2, " transform=\"translate(2,0)\""));
  EXPECT_THAT(moved.notes[0], HasSubstr("7 paths were changed"));
  EXPECT_NEAR(moved.file.lines[0].curves[0].curve.controlPoints()[0].x(), 12.0, 1e-6);
}

TEST_F(Import, AnOwnSvgWithoutItsExactCurvesIsReadAsItIsDrawn) {
  std::string svg = editedSvg([](std::string data) { return data; });
  const auto at = svg.find("<metadata>"), end = svg.find("</metadata>") + 11;
  const ImportReport report = read("own.svg", svg.erase(at, end - at));
  EXPECT_EQ(report.file.lines.size(), 6u);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_THAT(report.notes[0], HasSubstr("read as drawn"));
}

TEST_F(Import, SvgKeepsTheNamesOfItsCurves) {
  ExportDocument document = test::exportOfAllKinds();
  document.curves[0].name = "Schürze <a>";
  std::string svg = exportedFile(document, {})->bytes;
  EXPECT_THAT(svg, HasSubstr("<path id=\"curve-1\" inkscape:label=\"Schürze &lt;a&gt;\" d="));
  const auto at = svg.find("<metadata>"), end = svg.find("</metadata>") + 11;
  EXPECT_EQ(read("own.svg", svg.erase(at, end - at)).file.lines[0].name, "Schürze <a>");
}

TEST_F(Import, NamesAndLayersComeBackFromOwnFiles) {
  ExportDocument document = test::exportOfAllKinds();
  std::vector<std::string> names, layers;
  for (ExportCurve& line : document.curves) {
    line.layer = layers.size() % 2 == 0 ? "Body side" : "Glass";
    layers.push_back(line.layer);
    for (ExportPiece& piece : line.pieces) {
      piece.name = "Character line " + std::to_string(names.size() + 1);
      names.push_back(piece.name);
    }
  }
  for (const std::string ending : {".dxf", ".igs", ".step", ".svg", ".json"}) {
    if (!hasOpenCascade() && (ending == ".igs" || ending == ".step")) continue;
    const fs::path path = folder_ / ("named" + ending);
    ExportSettings settings;
    settings.format = *formatOf(path);
    ASSERT_TRUE(exportToFile(document, settings, path)) << ending;
    const auto back = readImportFile(path);
    ASSERT_TRUE(back) << ending << back.error().message;
    // STEP holds its curves layer by layer.
    std::multiset<std::string> namesBack, layersBack;
    std::map<std::string, std::string> layerOf;
    for (const ImportedLine& line : back->file.lines) {
      layersBack.insert(line.layer);
      for (const ImportedCurve& curve : line.curves) {
        namesBack.insert(curve.name);
        layerOf[curve.name] = line.layer;
      }
    }
    EXPECT_EQ(namesBack, std::multiset<std::string>(names.begin(), names.end())) << ending;
    if (ending == ".igs") continue;  // levels have numbers
    EXPECT_EQ(layersBack, std::multiset<std::string>(layers.begin(), layers.end())) << ending;
    EXPECT_EQ(layerOf[names[0]], "Body side") << ending;
    EXPECT_EQ(layerOf[names[1]], "Glass") << ending;
  }
}

TEST_F(Import, NamesOfOtherBytesAreShownAndTextsOfOthersAreNone) {
  const std::string line = "10\n0\n20\n0\n11\n10\n21\n0\n";
  const ImportReport report =
      read("a.dxf", std::string(kDxfHead) + "0\nLINE\n8\nDach \xe4\n" + line + "1001\nACME\n1000\nsecret\n" +
                        "0\nLINE\n8\n0\n10\n0\n20\n9\n11\n10\n21\n9\n1001\nBATTEN\n1000\nroof\x01line\n" + kDxfEnd);
  ASSERT_EQ(report.file.lines.size(), 2u);
  EXPECT_EQ(report.file.lines[0].name, "");
  EXPECT_EQ(report.file.lines[0].layer, "Dach \xEF\xBF\xBD");
  EXPECT_EQ(report.file.lines[1].name, "roof?line");
  EXPECT_EQ(report.file.lines[1].layer, "") << "layer 0 is none";
}

TEST_F(Import, AnAssignedLayerOfAStepCounts) {
  if (!hasOpenCascade()) GTEST_SKIP() << "built without Open CASCADE";
  ExportDocument document = test::exportOfAllKinds();
  document.curves.resize(1);
  document.curves[0].pieces[0].name = "sill";
  ExportSettings settings;
  settings.format = ExportFormat::Step;
  std::string step = exportedFile(document, settings)->bytes;
  const auto name = step.find("B_SPLINE_CURVE_WITH_KNOTS('sill'");
  ASSERT_NE(name, std::string::npos);
  const auto hash = step.rfind('#', name);
  const std::string id = step.substr(hash, step.find_first_of(" =", hash) - hash);
  step.insert(step.rfind("ENDSEC;"), "#99999=PRESENTATION_LAYER_ASSIGNMENT('Glass','',(" + id + "));\n");
  const ImportReport report = read("layer.step", step);
  EXPECT_EQ(report.file.lines.at(0).layer, "Glass");
  EXPECT_EQ(report.file.lines[0].curves.at(0).name, "sill");
}

TEST_F(Import, TheUnitsOfADxfAreKnown) {
  const auto length = [&](const char* unit) {
    const ImportReport report =
        read("u.dxf", std::string("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n") + unit +
                          "\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n0\n20\n0\n11\n0.01\n21\n0\n"
                          "0\nENDSEC\n0\nEOF\n");
    EXPECT_TRUE(report.notes.empty()) << unit;
    const NurbsCurve& line = report.file.lines.at(0).curves.at(0).curve;
    return line.point(line.end()).x();
  };
  EXPECT_NEAR(length("3"), 16093.44, 1e-9);
  EXPECT_NEAR(length("7"), 10000.0, 1e-9);
  EXPECT_NEAR(length("10"), 9.144, 1e-12);
  EXPECT_NEAR(length("2"), 3.048, 1e-12);
}

TEST_F(Import, APolylineWithBulgesBecomesLinesAndArcs) {
  // 10 mm to the right, half a circle to the left over (15, 5), 10 mm back, closed by a chord.
  const std::string dxf =
      "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n10\n0\n20\n0\n10\n10\n20\n0\n42\n1\n"
      "10\n10\n20\n10\n10\n0\n20\n10\n0\nENDSEC\n0\nEOF\n";
  const ImportReport report = read("slot.dxf", dxf, 1.0);
  ASSERT_EQ(report.file.lines.size(), 1u);
  const ImportedLine& line = report.file.lines[0];
  EXPECT_TRUE(line.closed);
  ASSERT_EQ(line.curves.size(), 4u);
  EXPECT_EQ(line.curves[0].curve.degree(), 1);
  EXPECT_EQ(line.curves[2].curve.degree(), 1);
  const NurbsCurve& arc = line.curves[1].curve;
  EXPECT_LT((arc.point(0.5 * (arc.start() + arc.end())) - Vec2(15, 5)).norm(), 1e-12);
  EXPECT_LT((arc.point(arc.start()) - Vec2(10, 0)).norm(), 1e-12);
}

TEST_F(Import, ReadsTablesOfPointsAsPeopleWriteThem) {
  struct Case {
    const char* text;
    double x, y;  // of the second point, mm
    std::size_t lines, points;
  };
  for (const Case& c :
       {Case{"0,0\n1.5,2\n3,1\n", 1.5, 2.0, 1, 3}, Case{"x_in,y_in\r\n0,0\r\n1,2\r\n", 25.4, 50.8, 1, 2},
        Case{"# a comment\nx;y\n0;0\n1,5;2,25\n", 1.5, 2.25, 1, 2},
        Case{"0\t0\n1\t2\n\n5\t5\n6\t6\n7\t5\n", 1.0, 2.0, 2, 2}, Case{"  0   0\n  1   2 9 9\n", 1.0, 2.0, 1, 2},
        Case{"curve,s_mm,x_mm,y_mm\nA,0,0,0\nA,1,3,4\nB,0,9,9\nB,1,8,8\n", 3.0, 4.0, 2, 2},
        Case{"1,5 2\n2,25 3,5\n", 2.25, 3.5, 1, 2}, Case{"x y\n0 0\n1,5 2,5\n", 1.5, 2.5, 1, 2},
        Case{"0, 0\n1, 2\n", 1.0, 2.0, 1, 2}, Case{"\xef\xbb\xbfx [cm],y [cm]\n0,0\n1,2\n", 10.0, 20.0, 1, 2}}) {
    const ImportReport report = read("p.csv", c.text);
    ASSERT_EQ(report.file.lines.size(), c.lines) << c.text;
    ASSERT_EQ(report.file.lines[0].points.size(), c.points) << c.text;
    EXPECT_NEAR((report.file.lines[0].points[1] - Vec2(c.x, c.y)).norm(), 0.0, 1e-12) << c.text;
  }
  EXPECT_TRUE(read("loop.csv", "0,0\n1,0\n1,1\n0,0\n").file.lines[0].closed);
  EXPECT_THAT(refusal("bad.csv", "0,0\n1,1\nx,2\n"), HasSubstr("row 3"));
  EXPECT_THAT(refusal("nan.csv", "0,0\nnan,1\n"), HasSubstr("row 2"));
  EXPECT_THAT(refusal("own.poly.csv", "curve,piece,span,u_start,u_end,x0,x1,y0,y1\na,b,1,0,1,0,1,0,1\n"),
              HasSubstr("coefficients"));
  EXPECT_THAT(refusal("one.csv", "0,0\n"), HasSubstr("no line"));
  EXPECT_THAT(refusal("empty.csv", ""), HasSubstr("the file is empty"));
  EXPECT_THAT(refusal("far.csv", "0,0\n1e9,1\n"), HasSubstr("unit"));
}

TEST_F(Import, ReadsPointsOfJson) {
  EXPECT_EQ(read("a.json", "[[0,0],[1,2],[3,1]]").file.lines[0].points.size(), 3u);
  EXPECT_EQ(read("b.json", "[[[0,0],[1,2]],[[3,1],[4,4]]]").file.lines.size(), 2u);
  const ImportReport named =
      read("c.json", R"({"unit":"in","lines":[{"name":"Dach 漢","closed":true,"points":[[0,0],[1,0],[1,1],[0,0]]}]})");
  ASSERT_EQ(named.file.lines.size(), 1u);
  EXPECT_EQ(named.file.lines[0].name, "Dach 漢");
  EXPECT_EQ(named.file.lines[0].points.size(), 3u);
  EXPECT_NEAR(named.file.lines[0].points[1].x(), 25.4, 1e-12);
  for (const char* text : {"", "{", "[1,2]", "{\"lines\":3}", "[[0,0],[1]]", "[[0,0],\"x\"]",
                           "{\"unit\":\"ell\",\"lines\":[]}", "[]", "null", "[[0,0],[1e999,0]]"}) {
    EXPECT_NE(refusal("d.json", text), "read") << text;
  }
  EXPECT_NE(refusal("deep.json", std::string(100000, '[')), "read");
}

/// The place of a path's part that begins at `from`, half way of its parameters.
TEST(SvgPath, FollowsEveryCommand) {
  const auto parts = readSvgPath("m10,10 5 0v5h-5z M0 0C1 2 3 2 4 0S7-2 8 0 Q9 2 10 0T12,0a2 1 0 01 4,0l1 1");
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 2u);
  EXPECT_TRUE((*parts)[0].closed);
  EXPECT_EQ((*parts)[0].segments.size(), 4u);
  const auto& second = (*parts)[1];
  ASSERT_EQ(second.segments.size(), 6u);
  EXPECT_LT((second.segments[0].point(0.5 * second.segments[0].end()) - Vec2(2.0, 1.5)).norm(), 1e-12);
  EXPECT_LT((second.segments[1].controlPoints()[1] - Vec2(5.0, -2.0)).norm(), 1e-12) << "the handle mirrored";
  EXPECT_LT((second.segments[2].point(0.5 * second.segments[2].end()) - Vec2(9.0, 1.0)).norm(), 1e-12);
  EXPECT_LT((second.segments[3].point(0.5 * second.segments[3].end()) - Vec2(11.0, -1.0)).norm(), 1e-12);
  const NurbsCurve& arc = second.segments[4];
  EXPECT_LT((arc.point(0.5 * (arc.start() + arc.end())) - Vec2(14.0, -1.0)).norm(), 1e-12) << "clockwise on the page";
  for (const char* wrong : {"10 10", "M10", "M0 0 L", "M0 0 X1 1", "M0 0 A1 1 0 2 0 1 1", "M0 0 L1 nan", "M0 0Z5 5"}) {
    EXPECT_FALSE(readSvgPath(wrong)) << wrong;
  }
  ASSERT_TRUE(readSvgPath(""));
}

TEST(SvgPath, ArcsLieOnTheirEllipse) {
  for (const bool large : {false, true}) {
    for (const bool clockwise : {false, true}) {
      const SvgArc asked{{1.0, 2.0}, {4.0, 3.0}, {5.0, 3.0}, 0.4, large, clockwise};
      const auto arc = svgArc(asked);
      ASSERT_TRUE(arc);
      EXPECT_LT((arc->point(arc->start()) - asked.from).norm(), 1e-12);
      EXPECT_LT((arc->point(arc->end()) - asked.to).norm(), 1e-12);
      // Turned back and drawn out to a circle, all places are one radius from one centre, and the turn has its sense.
      const auto own = [&](const Vec2& p) {
        const double c = std::cos(-asked.turnedRad), s = std::sin(-asked.turnedRad);
        return Vec2((c * p.x() - s * p.y()) / 5.0, (s * p.x() + c * p.y()) / 3.0);
      };
      std::vector<Vec2> places;
      for (int i = 0; i <= 64; ++i)
        places.push_back(own(arc->point(arc->start() + (arc->end() - arc->start()) * i / 64)));
      const Vec2 a = places[20] - places[0], b = places[50] - places[0];
      const double twice = 2.0 * cross(a, b);
      const Vec2 w = (a.squaredNorm() * b - b.squaredNorm() * a) / twice;
      const Vec2 centre = places[0] + Vec2(w.y(), -w.x());
      double turn = 0.0;
      for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_NEAR((places[i] - centre).norm(), 1.0, 1e-9);
        if (i > 0)
          turn += std::atan2(cross(places[i - 1] - centre, places[i] - centre),
                             (places[i - 1] - centre).dot(places[i] - centre));
      }
      EXPECT_EQ(turn > 0.0, clockwise);
      EXPECT_EQ(std::abs(turn) > std::numbers::pi, large);
    }
  }
}

TEST_F(Import, ReadsTheShapesOfAnySvgInMillimetres) {
  const std::string svg =
      "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='50mm' viewBox='0 0 200 100'>"
      "<defs><path d='M0 0L1 1'/></defs><g transform='translate(20,10)'><g transform='scale(2)'>"
      "<path id='one' d='M0 0 C10 0 10 10 20 10 S30 20 40 20 L50 20'/></g></g>"
      "<rect x='0' y='0' width='20' height='10'/><circle cx='100' cy='50' r='10'/>"
      "<polyline points='0,0 10,0 10,10' transform='rotate(90 5 5)'/><text>no</text>"
      "<line x1='1cm' y1='0' x2='0' y2='0'/></svg>";
  const ImportReport report = read("a.svg", svg);
  ASSERT_EQ(report.file.lines.size(), 5u);
  const ImportedLine& path = report.file.lines[0];
  EXPECT_EQ(path.name, "one");
  ASSERT_EQ(path.curves.size(), 2u) << "two cubics that go on are one curve, the line is another";
  EXPECT_LT((path.curves[0].curve.point(path.curves[0].curve.start()) - Vec2(10.0, 45.0)).norm(), 1e-12);
  EXPECT_LT((path.curves[0].curve.point(path.curves[0].curve.end()) - Vec2(50.0, 25.0)).norm(), 1e-12);
  EXPECT_EQ(report.file.lines[1].curves.size(), 4u);
  EXPECT_TRUE(report.file.lines[1].closed);
  const NurbsCurve& circle = report.file.lines[2].curves[0].curve;
  for (int i = 0; i <= 20; ++i)
    EXPECT_NEAR((circle.point(circle.start() + (circle.end() - circle.start()) * i / 20) - Vec2(50.0, 25.0)).norm(),
                5.0, 1e-12);
  EXPECT_LT((report.file.lines[3].curves[0].curve.controlPoints()[0] - Vec2(5.0, 50.0)).norm(), 1e-12)
      << "turned about 5, 5";
  // A centimetre is 37.8 units of 1/96 inch, each of which is half a millimetre here.
  EXPECT_NEAR(report.file.lines[4].curves[0].curve.controlPoints()[0].x(), 0.5 * 96.0 / 2.54, 1e-9);
  ASSERT_EQ(report.notes.size(), 1u) << "the text";
  EXPECT_EQ(read("px.svg", "<svg><path d='M0 0L96 0'/></svg>").file.unit, "px?");
}

/// Cut off, with bits turned, and made of nothing: never a crash, and a message where it is refused.
template <class Read>
void damage(const std::string& whole, const Read& read, std::size_t step) {
  for (std::size_t length = 0; length < whole.size(); length += step) (void)read(whole.substr(0, length));
  std::mt19937 random(11);
  for (int round = 0; round < 300; ++round) {
    std::string text = whole;
    for (int flips = 0; flips < 1 + round % 20; ++flips) {
      char& byte = text[random() % text.size()];
      byte = static_cast<char>(byte ^ (1 << (random() % 8)));
    }
    const auto result = read(text);
    if (!result) {
      EXPECT_FALSE(result.error().message.empty());
    }
  }
}

std::string exported(const char* ending) {
  ExportSettings settings;
  settings.format = *formatOf(std::string("a") + ending);
  const auto file = exportedFile(test::exportOfAllDegrees(), settings);
  EXPECT_TRUE(file) << file.error().message;
  return file ? file->bytes : "";
}

TEST(IgesReader, SurvivesDamage) {
  if (!hasOpenCascade()) return;  // nothing to damage; what others write is read below
  const std::string whole = exported(".igs");
  for (std::size_t length = 0; length + 160 < whole.size(); length += 97)
    EXPECT_FALSE(parseIges(whole.substr(0, length))) << length;
  damage(
      whole, [](const std::string& text) { return parseIges(text); }, 331);
}

/// A file of lines for the sections; the data of every entity begin in a line of their own.
std::string igesOf(const std::vector<std::pair<std::string, std::string>>& entities,
                   const std::string& unit = "2,2HMM") {
  const auto line = [](std::string text, char section, std::size_t number) {
    text.resize(72, ' ');
    std::string digits = std::to_string(number);
    return text + section + std::string(7 - std::min<std::size_t>(7, digits.size()), ' ') + digits + "\n";
  };
  const auto field = [](const std::string& text) {
    return std::string(8 - std::min<std::size_t>(8, text.size()), ' ') + text;
  };
  std::string file = line("made by hand", 'S', 1);
  file += line("1H,,1H;,4Hself,5Ha.igs,4Htest,4Htest,32,38,6,308,15,4Hself,1.," + unit + ",1,0.01,", 'G', 1);
  file += line("15H20260101.000000,1E-6,1000.,2Hme,2Hme,11,0,15H20260101.000000;", 'G', 2);
  constexpr std::size_t kColumns = 64;  // of data in a line
  std::string data;
  std::size_t next = 1;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const std::string& parameters = entities[i].second;
    const std::size_t lines = (parameters.size() + kColumns - 1) / kColumns;
    const std::string type = entities[i].first.substr(0, entities[i].first.find(' '));
    const std::string matrix = entities[i].first.find(' ') == std::string::npos
                                   ? "0"
                                   : entities[i].first.substr(entities[i].first.find(' ') + 1);
    file += line(field(type) + field(std::to_string(next)) + field("0") + field("0") + field("0") + field("0") +
                     field(matrix) + field("0") + field("00000000"),
                 'D', 2 * i + 1);
    file += line(field(type) + field("0") + field("0") + field(std::to_string(lines)) + field("0") + field("") +
                     field("") + field("") + field("0"),
                 'D', 2 * i + 2);
    for (std::size_t k = 0; k < lines; ++k) data += line(parameters.substr(k * kColumns, kColumns), 'P', next + k);
    next += lines;
  }
  return file + data + line("S      1G      2D      2P      1", 'T', 1);
}

TEST(IgesReader, ReadsWhatOthersWrite) {
  const auto drawing =
      parseIges(igesOf({{"110", "110,0.,0.,0.,10.,5.,0.;"},
                        {"100", "100,0.,1.,1.,3.,1.,1.,3.;"},
                        {"110 7", "110,0.,0.,0.,1.D0,0.,0.;"},
                        {"124", "124,0.,-1.,0.,5.,1.,0.,0.,7.,0.,0.,1.,0.;"},
                        {"106", "106,1,3,0.,0.,0.,1.,1.,2.,0.;"},
                        {"104", "104,.25,0.,1.,0.,0.,-1.,0.,2.,0.,0.,1.;"},
                        {"112", "112,3,1,2,1,0.,2.,1.,3.,0.,0.,5.,0.,1.,0.,0.,0.,0.,0.;"},
                        {"108", "108,1.,0.,0.,0.,0;"},
                        {"126", "126,1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,4.,4.,0.,.25,1.,0.,0.,1.;"},
                        {"406", "406,1,4Hname;"}},
                       "1,2HIN"));
  ASSERT_TRUE(drawing) << drawing.error().message;
  EXPECT_EQ(drawing->mmPerUnit, 25.4);
  EXPECT_EQ(drawing->left, 1) << "the plane";
  ASSERT_EQ(drawing->entities.size(), 7u);
  EXPECT_LT((std::get<CadLine>(drawing->entities[0].shape).to - Vec2(10, 5)).norm(), 1e-12);
  EXPECT_NEAR(std::get<CadArc>(drawing->entities[1].shape).sweepRad, 0.5 * std::numbers::pi, 1e-12);
  EXPECT_LT((pointAt(drawing->entities[2].shape, 1.0) - Vec2(5, 8)).norm(), 1e-12) << "turned and moved";
  EXPECT_EQ(std::get<CadPolyline>(drawing->entities[3].shape).vertices.size(), 3u);
  EXPECT_LT((pointAt(drawing->entities[4].shape, 0.0) - Vec2(2, 0)).norm(), 1e-12);
  EXPECT_LT((pointAt(drawing->entities[4].shape, 1.0) - Vec2(0, 1)).norm(), 1e-12);
  EXPECT_LT((pointAt(drawing->entities[5].shape, 0.5) - Vec2(4, 6)).norm(), 1e-12) << "1 + 3 t, 5 + t^2 at 1";
  EXPECT_LT((pointAt(drawing->entities[6].shape, 0.0) - Vec2(1, 1)).norm(), 1e-12) << "cut to its parameters";
}

TEST(IgesReader, RefusesCountsThatCannotBe) {
  for (const char* data :
       {"126,2000000000,5,0,0,1,0,0.;", "126,-1,5,0,0,1,0,0.;", "106,2,999999999,0.;", "112,3,1,2,99999999,0.;",
        "126,1,1,0,0,1,0,nan,0.,1.,1.,1.,1.,0.,0.,0.,4.,4.,0.,0.,1.,0.,0.,1.;", "110,0.,0.;"}) {
    const std::string type = std::string(data).substr(0, 3);
    const auto drawing = parseIges(igesOf({{type, data}}));
    if (drawing) {
      EXPECT_EQ(drawing->left, 1) << data;
    }
  }
  EXPECT_FALSE(parseIges(igesOf({{"102", "102,2000000000,1;"}})));
  EXPECT_FALSE(parseIges(igesOf({{"110 1", "110,0.,0.,0.,1.,1.,0.;"}}))) << "its own matrix";
  EXPECT_FALSE(parseIges(igesOf({{"110 999", "110,0.,0.,0.,1.,1.,0.;"}})));
  EXPECT_FALSE(parseIges(igesOf({{"110", "110,9999H0.,0.;"}})));
  // Matrices in a ring.
  EXPECT_FALSE(
      parseIges(igesOf({{"110 3", "110,0.,0.,0.,1.,1.,0.;"}, {"124 3", "124,1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.;"}})));
  for (const char* text : {"", "hello", "S", "\n\n"}) EXPECT_FALSE(parseIges(text));
}

std::string stepOf(const std::string& data) {
  return "ISO-10303-21;\nHEADER;\nFILE_NAME('a','','','','','','');\nENDSEC;\nDATA;\n" + data +
         "ENDSEC;\nEND-ISO-10303-21;\n";
}

TEST(StepReader, SurvivesDamage) {
  if (!hasOpenCascade()) return;
  const std::string whole = exported(".step");
  for (std::size_t length = 0; length + 60 < whole.size(); length += 97)
    EXPECT_FALSE(parseStep(whole.substr(0, length))) << length;
  damage(
      whole, [](const std::string& text) { return parseStep(text); }, 331);
}

TEST(StepReader, CompositesThatMultiplyComeToAnEnd) {
  constexpr int kDeep = 14, kWide = 12;
  std::string data;
  for (int depth = 0; depth < kDeep; ++depth) {
    const int id = 1000 * (depth + 1);
    std::string parts;
    for (int i = 1; depth + 1 < kDeep && i <= kWide; ++i) {
      data += "#" + std::to_string(id + i) + "=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#" + std::to_string(id + 1000) +
              ");\n";
      parts += (i > 1 ? ",#" : "#") + std::to_string(id + i);
    }
    data += "#" + std::to_string(id) + "=COMPOSITE_CURVE('',(" + parts + "),.F.);\n";
  }
  EXPECT_FALSE(parseStep(stepOf(data)));
}

TEST(StepReader, ReadsWhatOthersWrite) {
  const auto drawing = parseStep(stepOf(
      "#1=(CONVERSION_BASED_UNIT('INCH',#2)LENGTH_UNIT()NAMED_UNIT(#9));\n"
      "#2=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#3);\n#3=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));"
      "\n"
      "#4=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#1))REPRESENTATION_CONTEXT('',''));\n"
      "#10=CARTESIAN_POINT('',(0.,0.,0.));#11=CARTESIAN_POINT('',(4.,0.,0.));/* between "
      "*/#12=CARTESIAN_POINT('',(0.,4.,0.));\n"
      "#13=DIRECTION('',(0.,0.,1.));#14=DIRECTION('',(1.,0.,0.));#15=AXIS2_PLACEMENT_3D('',#10,#13,#14);\n"
      "#16=CIRCLE('a',#15,4.);#17=TRIMMED_CURVE('It''s',#16,(#11),(#12),.T.,.CARTESIAN.);\n"
      "#18=TRIMMED_CURVE('',#16,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);\n"
      "#19=VECTOR('',#14,2.);#20=LINE('',#10,#19);"
      "#21=TRIMMED_CURVE('',#20,(PARAMETER_VALUE(1.)),(PARAMETER_VALUE(3.)),.T.,.PARAMETER.);\n"
      "#22=POLYLINE('\\X2\\6F22\\X0\\',(#10,#11,#12));\n"
      "#23=(BOUNDED_CURVE()B_SPLINE_CURVE(2,(#11,#30,#12),.UNSPECIFIED.,.F.,.F.)B_SPLINE_CURVE_WITH_KNOTS((3,3),(0.,1.)"
      ",.UNSPECIFIED.)"
      "CURVE()GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE((1.,0.70710678118654752,1.))REPRESENTATION_ITEM('"
      "r'));\n"
      "#24=ELLIPSE('',#15,4.,2.);#25=BEZIER_CURVE('',3,(#10,#11,#30,#12),.UNSPECIFIED.,.F.,.F.);\n"
      "#30=CARTESIAN_POINT('',(4.,4.,0.));\n"
      "#40=GEOMETRIC_CURVE_SET('',(#17,#18,#21,#22,#23,#24,#25,#99,#10));\n"));
  ASSERT_TRUE(drawing) << drawing.error().message;
  EXPECT_EQ(drawing->mmPerUnit, 25.4);
  ASSERT_EQ(drawing->entities.size(), 7u);
  EXPECT_EQ(drawing->entities[0].name, "It's");
  EXPECT_NEAR(std::get<CadArc>(drawing->entities[0].shape).sweepRad, 0.5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(std::get<CadArc>(drawing->entities[1].shape).sweepRad, 1.0, 1e-12);
  EXPECT_LT((std::get<CadLine>(drawing->entities[2].shape).from - Vec2(2, 0)).norm(), 1e-12);
  EXPECT_LT((std::get<CadLine>(drawing->entities[2].shape).to - Vec2(6, 0)).norm(), 1e-12);
  EXPECT_EQ(drawing->entities[3].name, "漢");
  for (int i = 0; i <= 10; ++i)
    EXPECT_NEAR(pointAt(drawing->entities[4].shape, 0.1 * i).norm(), 4.0, 1e-12) << "a quarter";
  EXPECT_LT((pointAt(drawing->entities[5].shape, 0.25) - Vec2(0, 2)).norm(), 1e-12);
  EXPECT_LT((pointAt(drawing->entities[6].shape, 1.0) - Vec2(0, 4)).norm(), 1e-12);
}

TEST(StepReader, ReadsTheEdgesOfAWireframe) {
  const auto drawing = parseStep(
      stepOf("#1=CARTESIAN_POINT('',(0.,0.,0.));#2=CARTESIAN_POINT('',(4.,0.,0.));#3=DIRECTION('',(1.,0.,0.));#4="
             "VECTOR('',#3,1.);\n"
             "#5=LINE('',#1,#4);#6=VERTEX_POINT('',#1);#7=VERTEX_POINT('',#2);#8=EDGE_CURVE('',#6,#7,#5,.T.);\n"
             "#9=DIRECTION('',(0.,0.,-1.));#10=AXIS2_PLACEMENT_3D('',#1,#9,#3);#11=CIRCLE('',#10,4.);\n"
             "#12=CARTESIAN_POINT('',(0.,-4.,0.));#13=VERTEX_POINT('',#12);#14=EDGE_CURVE('',#7,#13,#11,.T.);\n"));
  ASSERT_TRUE(drawing) << drawing.error().message;
  EXPECT_FALSE(drawing->mmPerUnit);
  ASSERT_EQ(drawing->entities.size(), 2u);
  // Seen from below the circle turns the other way: the quarter through (2.8, -2.8).
  const Vec2 middle = pointAt(drawing->entities[1].shape, 0.5);
  EXPECT_LT((middle - Vec2(4.0, -4.0) / std::sqrt(2.0)).norm(), 1e-9);
}

TEST(StepReader, RefusesWhatCannotBe) {
  for (const char* data :
       {"#1=LINE('',(", "#1=LINE('','it", "#=LINE();", "#1=LINE('',#2,#3)", "#1=LINE(1e999);", "#1=(A()B(;",
        "#1=A();#1=B();", "#99999999999999999999999=A();", "LINE();", "#1=A(,);", "#1=A(.T);"}) {
    const auto drawing = parseStep(stepOf(data));
    EXPECT_FALSE(drawing) << data;
  }
  EXPECT_FALSE(parseStep(stepOf("#1=A(" + std::string(100000, '(') + ");")));
  // A composite of itself, a curve trimmed of itself, and one that doubles with every level.
  const auto ring =
      parseStep(stepOf("#1=TRIMMED_CURVE('',#1,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);"
                       "#2=GEOMETRIC_CURVE_SET('',(#1));"));
  ASSERT_TRUE(ring);
  EXPECT_EQ(ring->left, 1);
  std::string bomb = "#1=CARTESIAN_POINT('',(0.,0.));#2=CARTESIAN_POINT('',(1.,0.));#100=POLYLINE('',(#1,#2));";
  for (int i = 1; i < 15; ++i) {
    const std::string n = std::to_string(100 + i), segment = std::to_string(200 + i);
    bomb += "#" + segment + "=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#" + std::to_string(99 + i) + ");#" + n +
            "=COMPOSITE_CURVE('',(";
    for (int k = 0; k < 8; ++k) bomb += (k > 0 ? ",#" : "#") + segment;
    bomb += "),.F.);";
  }
  const auto grown = parseStep(stepOf(bomb + "#300=GEOMETRIC_CURVE_SET('',(#114));"));
  if (grown) {
    EXPECT_LE(grown->entities.size(), 200001u);
  }
  for (const char* text : {"", "hello", "ISO-10303-21;", "ISO-10303-21;DATA;"}) EXPECT_FALSE(parseStep(text));
}

TEST_F(Import, DamagedFilesOfEveryKindAreRefusedOrRead) {
  for (const char* ending : {".dxf", ".svg", ".json", ".csv"}) {
    damage(
        exported(ending),
        [&](const std::string& text) { return readImportFile(write(std::string("d") + ending, text)); }, 701);
  }
  const std::string shapes =
      "<svg width='100mm' height='50mm' viewBox='0 0 200 100'><g transform='rotate(10)'><path d='M0 0C1 2 3 2 4 0S7-2 "
      "8 0z'/>"
      "<rect width='5' height='5' rx='1'/><polygon points='1,1 2,2 3,1'/></g></svg>";
  damage(
      shapes, [&](const std::string& text) { return readImportFile(write("s.svg", text)); }, 1);
  std::string deep = "<svg>";
  for (int i = 0; i < 100000; ++i) deep += "<g>";
  EXPECT_THAT(refusal("deep.svg", deep), HasSubstr("256"));
  EXPECT_THAT(refusal("entities.svg",
                      "<!DOCTYPE svg [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;'>"
                      "<!ENTITY c '&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;'><!ENTITY d '&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;'>"
                      "<!ENTITY e '&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;'>]><svg><title>&e;&e;&e;</title></svg>"),
              testing::Not(HasSubstr("read\n")));
  EXPECT_THAT(refusal("empty.svg", "<svg/>"), HasSubstr("no line"));
  EXPECT_THAT(refusal("a.xyz", "x"), HasSubstr(".dxf"));
  EXPECT_THAT(readImportFile(folder_ / "none.dxf").error().message, HasSubstr("does not exist"));
  CancelToken token;
  token.cancel();
  RunContext context;
  context.cancel = token;
  std::string many;
  for (int i = 0; i < 10000; ++i) many += "1,2\n2,1\n";
  EXPECT_EQ(readImportFile(write("many.csv", many), {}, context).error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace batten
