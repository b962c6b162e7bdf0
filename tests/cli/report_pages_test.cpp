// SPDX-License-Identifier: GPL-3.0-or-later
// The report to print, read back by tools that have no part in it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/exchange/text/curve_json.h"
#include "tests/cli/program.h"

namespace batten {
namespace {

using nlohmann::json;
using Report = test::Program;

/// What a shell command prints.
std::string printed(const std::string& command) {
  std::string text;
  if (FILE* pipe = popen(command.c_str(), "r")) {
    char buffer[4096];
    for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, n);
    pclose(pipe);
  }
  return text;
}

struct Matrix {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
  Matrix times(const Matrix& m) const {  // this is applied first
    return {a * m.a + b * m.c, a * m.b + b * m.d,       c * m.a + d * m.c,
            c * m.b + d * m.d, e * m.a + f * m.c + m.e, e * m.b + f * m.d + m.f};
  }
  Vec2 operator()(double x, double y) const { return {a * x + c * y + e, b * x + d * y + f}; }
};

/// Lengths in points, on the page, of the straight two-point paths and ends of all cubics of an uncompressed PDF.
struct Paths {
  std::vector<double> chords;
  std::vector<Vec2> cubicEnds;
};
Paths pathsOf(const std::string& qdf) {
  Paths paths;
  std::istringstream words(qdf);
  std::vector<double> numbers;
  std::vector<Matrix> stack = {Matrix{}};
  Vec2 pen(0, 0);
  for (std::string word; words >> word;) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (*end == '\0') {
      numbers.push_back(value);
      continue;
    }
    const std::size_t n = numbers.size();
    const auto at = [&](std::size_t i) { return stack.back()(numbers[n - i], numbers[n - i + 1]); };
    if (word == "q") {
      stack.push_back(stack.back());
    } else if (word == "Q" && stack.size() > 1) {
      stack.pop_back();
    } else if (word == "stream") {
      stack = {Matrix{}};
    } else if (word == "cm" && n >= 6) {
      stack.back() =
          Matrix{numbers[n - 6], numbers[n - 5], numbers[n - 4], numbers[n - 3], numbers[n - 2], numbers[n - 1]}.times(
              stack.back());
    } else if (word == "m" && n >= 2) {
      pen = at(2);
    } else if (word == "l" && n >= 2) {
      paths.chords.push_back((at(2) - pen).norm());
      pen = at(2);
    } else if (word == "c" && n >= 6) {
      pen = at(2);
      paths.cubicEnds.push_back(pen);
    }
    numbers.clear();
  }
  return paths;
}

constexpr double kPointsPerMillimetre = 72.0 / 25.4;

TEST_F(Report, PdfPagesAreVectorsInTrueSize) {
  const auto done = run("trace " + scene() + " --dpi 254 --set fairing.mode=target -o " + file("a.report.pdf") +
                        " -o " + file("l.report.pdf") + " --paper letter -o " + file("c.json"));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(json::parse(done.out)["files"].size(), 3u);
  const std::string pdf = "'" + file("a.report.pdf") + "'";
  const std::string qdf = printed("qpdf --qdf --object-streams=disable " + pdf + " - 2>/dev/null");
  if (qdf.empty()) GTEST_SKIP() << "qpdf is not installed";
  EXPECT_NE(printed("qpdf --check " + pdf + " 2>&1").find("No syntax or stream encoding errors"), std::string::npos);
  EXPECT_EQ(qdf.find("/Subtype /Image"), std::string::npos) << "vectors only";
  EXPECT_NE(qdf.find("recipe.json"), std::string::npos) << "attached";
  const Paths paths = pathsOf(qdf);
  const double bar = 100.0 * kPointsPerMillimetre;
  EXPECT_TRUE(std::any_of(paths.chords.begin(), paths.chords.end(), [&](double length) {
    return std::abs(length - bar) < 0.001 * kPointsPerMillimetre;
  })) << "the bar of 100 mm";

  // The drawing: ends of its cubics lie within as large a box as the curve does.
  const auto document = readCurveJson(test::readFile(file("c.json")));
  ASSERT_TRUE(document);
  const NurbsCurve& curve = document->curves[0].pieces[0].curve;
  Vec2 low(1e9, 1e9), high(-1e9, -1e9);
  for (int i = 0; i <= 4000; ++i) {
    const Vec2 p = curve.point(curve.start() + (curve.end() - curve.start()) * i / 4000.0);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  ASSERT_GT(paths.cubicEnds.size(), 3u);
  // The start of the curve and the place farthest from it, both joints of cubics up to their spacing.
  double farthest = 0.0;
  for (const Vec2& a : paths.cubicEnds)
    for (const Vec2& b : paths.cubicEnds) farthest = std::max(farthest, (a - b).norm());
  EXPECT_NEAR(farthest / kPointsPerMillimetre, (high - low).maxCoeff(), 0.02 * (high - low).maxCoeff());
  EXPECT_LE(farthest / kPointsPerMillimetre, (high - low).norm() + 0.002);
}

TEST_F(Report, PaperIsChosenAndTextIsThere) {
  ASSERT_EQ(run("trace " + scene() + " --dpi 254 -o '" + file("süß 1.report.pdf") + "' --paper letter").code, 0);
  const std::string info = printed("pdfinfo '" + file("süß 1.report.pdf") + "' 2>/dev/null");
  if (info.empty()) GTEST_SKIP() << "pdfinfo is not installed";
  EXPECT_NE(info.find("612 x 792 pts (letter)"), std::string::npos) << info;
  const std::string text = printed("pdftotext -layout '" + file("süß 1.report.pdf") + "' - 2>/dev/null");
  for (const char* word : {"scan.png", "Drawing, 1:1", "100 mm", "Fairness and deviations", "Curve 1", "Recipe",
                           "254 dpi, set by the user"})
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
}

TEST_F(Report, OfAnImportItNamesTheFileTheUnitAndTheLines) {
  std::ofstream(file("roof.csv")) << "curve,x_in,y_in\nridge,0,0\nridge,2,0.3\nridge,4,0.2\nridge,5,0\n";
  const auto done = run("trace " + file("roof.csv") + " -o " + file("a.report.html"));
  ASSERT_EQ(done.code, 0) << done.err;
  const std::string html = test::readFile(file("a.report.html"));
  EXPECT_NE(html.find("roof.csv, unit in, 1 line: ridge"), std::string::npos) << html.substr(0, 4000);
  EXPECT_NE(html.find("<td>imported curves</td>"), std::string::npos);
  const auto facts = html.substr(0, html.find("<h2>"));
  EXPECT_EQ(facts.find("set by the user"), std::string::npos) << facts;
  EXPECT_EQ(facts.find("drawn with the pen"), std::string::npos);
}

TEST_F(Report, HtmlHoldsTheDrawingInMillimetres) {
  ASSERT_EQ(run("trace " + scene() + " --dpi 254 -o " + file("a.report.html") + " -o " + file("c.svg")).code, 0);
  const std::string html = test::readFile(file("a.report.html"));
  for (const char* part : {"<h2>Drawing, 1:1</h2>", "100 mm</text>", "batten-recipe", "<h3>Curve 1</h3>"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("http://", html.find("</svg>")), html.find("http://www.w3.org", html.find("</svg>")));
  // As wide as the curve with margins of 5 mm, one user unit a mm.
  const auto svg = html.find("<svg ");
  const auto width = html.find("width=\"", svg), box = html.find("viewBox=\"0 0 ", svg);
  EXPECT_EQ(std::stod(html.substr(width + 7)), std::stod(html.substr(box + 13)));
}

TEST_F(Report, ADrawingTooLargeForASheetIsTiled) {
  ASSERT_EQ(run("trace " + scene() + " --dpi 20 -o " + file("a.report.pdf")).code, 0);
  const std::string text = printed("pdftotext -layout '" + file("a.report.pdf") + "' - 2>/dev/null");
  if (text.empty()) GTEST_SKIP() << "pdftotext is not installed";
  EXPECT_NE(text.find("sheet 1 of "), std::string::npos) << text.substr(0, 500);
  // Absurd sizes are reduced, and say so.
  ASSERT_EQ(run("trace " + scene() + " --dpi 1 -o " + file("b.report.pdf")).code, 0);
  EXPECT_NE(printed("pdftotext -layout '" + file("b.report.pdf") + "' - 2>/dev/null").find("reduced to"),
            std::string::npos);
}

TEST_F(Report, WordsAreCheckedFirst) {
  expectError("trace " + scene() + " -o " + file("a.report.pdf") + " --paper a9", 2, "--paper takes a4 or letter");
  expectError("trace " + scene() + " -o " + file("a.svg") + " --curves \"\"", 2, "--curves is empty");
  expectError("trace " + scene() + " -o " + file("a.report.txt"), 2, ".report.pdf");
  expectError("trace " + scene() + " -o " + file("no/a.report.pdf"), 5, "");
  EXPECT_FALSE(std::filesystem::exists(file("no")));
}

TEST_F(Report, TheScaleCanBeMeasured) {
  const auto done = run("trace " + scene() + " --known-length 0,0,480,0,12cm -o " + file("a.svg") + " --save-recipe " +
                        file("r.json"));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(test::readFile(file("a.svg")).find("width=\"120mm\" height=\"80mm\""), std::string::npos);
  const json recipe = json::parse(test::readFile(file("r.json")));
  EXPECT_EQ(recipe["scale"]["mm"], 120.0);
  EXPECT_NEAR(recipe["dpi"].get<double>(), 101.6, 1e-9);
  ASSERT_EQ(run("trace " + scene() + " --recipe " + file("r.json") + " -o " + file("b.svg")).code, 0);
  EXPECT_EQ(test::readFile(file("a.svg")), test::readFile(file("b.svg")));
  expectError("trace " + scene() + " --known-length 0,0,480,0,0mm -o " + file("a.svg"), 2, "--known-length takes");
  expectError("trace " + scene() + " --known-length 0,0,480,0,12 -o " + file("a.svg"), 2, "with its unit");
  expectError("trace " + scene() + " --known-length 0,0,10,0,1in --dpi 3 -o " + file("a.svg"), 2, "Give one of them");
}

TEST_F(Report, DirectionAndStartAreTheUsers) {
  const auto pieceOf = [&](const std::string& words) {
    const auto done = run("trace " + scene() + " --dpi 254 " + words + " -o " + file("o.json"));
    EXPECT_EQ(done.code, 0) << done.err;
    return readCurveJson(test::readFile(file("o.json")))->curves.at(0).pieces.at(0).curve;
  };
  const NurbsCurve plain = pieceOf("");
  const double quarter = 0.75 * plain.start() + 0.25 * plain.end();
  const Vec2 mm = plain.point(quarter);
  const std::string place = std::to_string(mm.x() * 10.0) + "," + std::to_string(320.0 - mm.y() * 10.0);
  const NurbsCurve begun = pieceOf("--start " + place);
  EXPECT_LT((begun.point(begun.start()) - mm).norm(), 0.05);
  // Along the curve nothing changes; against it the curve is turned.
  const Vec2 way = plain.derivatives(quarter, 1)[1].normalized();
  const auto towards = [&](double sign) {
    return "--direction " + place + "," + std::to_string(mm.x() * 10.0 + sign * 40.0 * way.x()) + "," +
           std::to_string(320.0 - mm.y() * 10.0 - sign * 40.0 * way.y());
  };
  EXPECT_TRUE(pieceOf(towards(1.0)) == plain);
  const NurbsCurve turned = pieceOf(towards(-1.0));
  EXPECT_LT((turned.point(turned.start() + 0.1 * (turned.end() - turned.start())) -
             plain.point(plain.end() - 0.1 * (plain.end() - plain.start())))
                .norm(),
            1e-9);
  expectError("trace " + scene() + " --direction 1,2 -o " + file("o.json"), 2, "--direction takes X,Y,X,Y");
  expectError("trace " + scene() + " --start 1 -o " + file("o.json"), 2, "--start takes X,Y");
  const auto missed = run("trace " + scene() + " --dpi 254 --start 1,1 --direction 2,2,9,9 -o " + file("o.json"));
  ASSERT_EQ(missed.code, 0) << missed.err;
  EXPECT_NE(missed.out.find("No curve near 1,1 for --start"), std::string::npos) << missed.out;
  EXPECT_NE(missed.out.find("No curve near 2,2 for --direction"), std::string::npos) << missed.out;
  EXPECT_EQ(run("trace " + scene() + " --start " + place + " -o " + file("o.json")).out.find("No curve near "),
            std::string::npos);
  expectError("trace " + scene() + " --joined --apart -o " + file("o.json"), 2, "exclude each other");
}

}  // namespace
}  // namespace batten
