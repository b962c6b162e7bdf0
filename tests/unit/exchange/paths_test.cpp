// SPDX-License-Identifier: GPL-3.0-or-later
// What SVG and PDF draw: cubics that keep place, direction and curvature; measured on the text of the files.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/exchange/export_file.h"
#include "core/exchange/model/cubic_outline.h"
#include "core/exchange/model/cubic_path.h"
#include "core/exchange/pdf_writer.h"
#include "core/exchange/svg/svg_writer.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

using Cubic = std::array<Vec2, 4>;

double startCurvature(const Cubic& c) {
  const Vec2 d1 = 3 * (c[1] - c[0]), d2 = 6 * (c[0] - 2 * c[1] + c[2]);
  return cross(d1, d2) / std::pow(d1.norm(), 3);
}
double endCurvature(const Cubic& c) { return -startCurvature({c[3], c[2], c[1], c[0]}); }
Vec2 at(const Cubic& c, double t) {
  const double s = 1 - t;
  return s * s * s * c[0] + 3 * s * s * t * c[1] + 3 * s * t * t * c[2] + t * t * t * c[3];
}

/// The cubics of "x y m", "x y x y x y c" (PDF) or "M x,y", "C …" (SVG).
std::vector<std::vector<Cubic>> cubicsOf(const std::string& file, bool isPdf) {
  std::vector<std::vector<Cubic>> paths;
  std::vector<double> numbers;
  Vec2 pen = Vec2::Zero();
  const auto take = [&](char command) {
    if ((command == 'm' || command == 'M') && numbers.size() == 2) {
      pen = {numbers[0], numbers[1]};
    } else if ((command == 'c' || command == 'C') && numbers.size() == 6) {
      const Cubic c = {pen, {numbers[0], numbers[1]}, {numbers[2], numbers[3]}, {numbers[4], numbers[5]}};
      paths.back().push_back(c);
      pen = c[3];
    }
    numbers.clear();
  };
  if (isPdf) {
    const auto begin = file.find("stream\n") + 7;
    std::istringstream words(file.substr(begin, file.find("\nendstream") - begin));
    bool fresh = true;
    for (std::string word; words >> word;) {
      if (std::isalpha(static_cast<unsigned char>(word[0])) == 0 && word[0] != '/') {
        numbers.push_back(std::stod(word));
        continue;
      }
      if (word == "m" && fresh) paths.emplace_back();
      fresh = word == "S" || (fresh && word != "m");
      take(word.size() == 1 ? word[0] : ' ');
    }
    return paths;
  }
  for (auto d = file.find(" d=\""); d != std::string::npos; d = file.find(" d=\"", d + 1)) {
    paths.emplace_back();
    std::string data = file.substr(d + 4, file.find('"', d + 4) - d - 4), word;
    char command = ' ';
    for (char& c : data)
      if (c == ',') c = ' ';
    std::istringstream words(data);
    while (words >> word) {
      if (std::isalpha(static_cast<unsigned char>(word[0])) != 0) {
        take(command);
        command = word[0];
        word.erase(0, 1);
        if (word.empty()) continue;
      }
      numbers.push_back(std::stod(word));
    }
    take(command);
  }
  return paths;
}

/// A line of the drawing with smooth joints only, and its cubics with y up.
void expectCurvatureKept(const std::vector<Cubic>& cubics, const ExportCurve& line) {
  const NurbsCurve& curve = line.pieces[0].curve;
  const double least = 0.05 / ArcLength(curve).total();
  for (std::size_t i = line.closed ? 0 : 1; i < cubics.size(); ++i) {
    const Cubic &before = cubics[(i + cubics.size() - 1) % cubics.size()], &behind = cubics[i];
    const auto exact = curvature(curve, closestPoint(curve, behind[0]).u);
    ASSERT_TRUE(exact);
    const double jump = std::abs(endCurvature(before) - startCurvature(behind));
    EXPECT_LE(jump, 0.02 * std::max(std::abs(*exact), least)) << line.id << ", joint " << i;
    EXPECT_LE(std::abs(startCurvature(behind) - *exact), 0.02 * std::max(std::abs(*exact), least)) << line.id;
  }
}

/// A clothoid-like S, an even arc and a nearly straight line: where curvatures are hard to match.
ExportDocument hardCurves() {
  ExportDocument document = test::exportOfAllKinds();
  document.curves.erase(document.curves.begin() + 4, document.curves.end());
  document.curves.erase(document.curves.begin() + 2);
  document.curves.push_back({"s",
                             false,
                             {{test::made(5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1},
                                          {{0, 0}, {20, 0}, {40, 12}, {60, -12}, {80, 0}, {100, 0}})}}});
  document.curves.push_back({"arc", false, {{elevated(curveOf(CadArc{{50, 50}, 30, 0.2, 1.4}).value(), 5).value()}}});
  document.curves.push_back({"flat",
                             false,
                             {{test::made(5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1},
                                          {{0, 0}, {20, 0.1}, {40, 0.3}, {60, 0.2}, {80, 0.4}, {100, 0.3}})}}});
  return document;
}

TEST(CubicPaths, KeepTheCurvatureAtEveryJoint) {
  const ExportDocument document = hardCurves();
  for (const double tolerance : {0.05, 0.002, 0.0001}) {
    const auto svg = writeSvg(document, {tolerance, 0.1});
    ASSERT_TRUE(svg);
    EXPECT_LE(svg->largestJump, 0.02);
    EXPECT_LE(svg->largestErrorMm, tolerance);
    auto paths = cubicsOf(svg->text, false);
    ASSERT_EQ(paths.size(), document.curves.size());
    for (std::size_t i = 0; i < paths.size(); ++i) {
      for (Cubic& c : paths[i])
        for (Vec2& p : c) p.y() = 100.0 - p.y();
      expectCurvatureKept(paths[i], document.curves[i]);
    }
  }
}

/// A tight bend that runs out into a long straight line; only the slope of the curvature jumps between them.
NurbsCurve bendAndLine(double knotGap) {
  constexpr double kBend = 0.1, kLine = 100.0;
  std::vector<Vec2> points = {{0, 0.3 * kBend}, {0.2 * kBend, 0.09 * kBend}, {0.4 * kBend, 0.015 * kBend}};
  points.emplace_back(0.6 * kBend, 0.0);
  for (int i = 1; i <= 5; ++i) points.emplace_back(kBend + 0.2 * i * kLine, 0.0);
  Eigen::Matrix2d turn;  // off the axes, so that no place of the line has round numbers
  turn << 0.9, -std::sqrt(0.19), std::sqrt(0.19), 0.9;
  const double end = kBend + kLine;
  return test::made(5, {0, 0, 0, 0, 0, 0, kBend, kBend + knotGap, kBend + 2 * knotGap, end, end, end, end, end, end},
                    points)
      .mapped(turn, Vec2::Zero());
}

TEST(CubicPaths, AKnotWhereOnlyTheSlopeOfTheCurvatureJumpsTakesFewCubics) {
  ExportDocument document = test::exportOfAllKinds();
  // Knots that nearly coincide are no better.
  for (const double knotGap : {0.0, 1e-9}) {
    document.curves = {{"bend", false, {{bendAndLine(knotGap)}}}};
    const auto svg = writeSvg(document, {});
    ASSERT_TRUE(svg);
    EXPECT_LE(svg->cubics, knotGap > 0.0 ? 80 : 20);
    EXPECT_LE(svg->largestJump, 0.02);
    EXPECT_LE(svg->largestErrorMm, 0.002);
  }
}

TEST(CubicPaths, StateTheErrorsThatTheyHave) {
  const auto svg = writeSvg(hardCurves(), {});
  ASSERT_TRUE(svg);
  EXPECT_NE(svg->text.find("where cubics meet, the curvature jumps by at most "), std::string::npos);
  const auto path = cubicPath(test::smoothLoop(), {0.01, 1e-9});
  ASSERT_TRUE(path);
  std::vector<Cubic> cubics;
  Vec2 pen = path->runs[0].start;
  for (const auto& c : path->runs[0].cubics) {
    cubics.push_back({pen, c[0], c[1], c[2]});
    pen = c[2];
  }
  double worst = 0.0, jump = 0.0;
  const double least = 0.05 / ArcLength(test::smoothLoop()).total();
  for (std::size_t i = 0; i < cubics.size(); ++i) {
    for (int k = 0; k <= 100; ++k)
      worst = std::max(worst, closestPoint(test::smoothLoop(), at(cubics[i], k / 100.0)).distance);
    if (i == 0) continue;
    const double exact = std::abs(*curvature(test::smoothLoop(), closestPoint(test::smoothLoop(), cubics[i][0]).u));
    jump = std::max(jump, std::abs(endCurvature(cubics[i - 1]) - startCurvature(cubics[i])) / std::max(exact, least));
  }
  EXPECT_NEAR(worst, path->largestError, 0.03 * path->largestError);
  EXPECT_NEAR(jump, path->largestJump, 1e-6);
}

TEST(Pdf, HoldsTheSameCubicsOnAPageOfTrueSize) {
  const ExportDocument document = hardCurves();
  ExportSettings settings;
  settings.format = ExportFormat::Pdf;
  const auto file = exportedFile(document, settings);
  ASSERT_TRUE(file) << file.error().message << file.error().detail;
  // 120 x 100 mm.
  EXPECT_NE(file->bytes.find("/MediaBox [ 0 0 340.157480315 283.464566929 ]"), std::string::npos);
  const auto paths = cubicsOf(file->bytes, true);
  ASSERT_EQ(paths.size(), document.curves.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    expectCurvatureKept(paths[i], document.curves[i]);
    for (const Cubic& c : paths[i])
      for (int k = 0; k <= 20; ++k)
        EXPECT_LE(closestPoint(document.curves[i].pieces[0].curve, at(c, k / 20.0)).distance, 0.002001);
  }
  ASSERT_TRUE(file->report.largestErrorMm && file->report.largestJump);
  EXPECT_LE(*file->report.largestErrorMm, 0.002);
}

TEST(Pdf, IsCleanForOtherPrograms) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "batten-pdf-test";
  std::filesystem::create_directories(folder);
  ExportSettings settings;
  settings.format = ExportFormat::Pdf;
  ExportDocument document = hardCurves();
  document.curves[1].layer = "Süße 漢字";
  const auto path = folder / "Süße Skizze 漢字.pdf";
  ASSERT_TRUE(exportToFile(document, settings, path));
  const auto run = [&](const std::string& command) {
    const std::string out = (folder / "out.txt").string();
    const int status = std::system((command + " '" + path.string() + "' >'" + out + "' 2>&1").c_str());
    std::ifstream in(out);
    return std::pair(status, std::string{std::istreambuf_iterator<char>(in), {}});
  };
  const auto [qpdf, said] = run("qpdf --check");
  EXPECT_EQ(qpdf, 0) << said;
  const auto [pdfinfo, info] = run("pdfinfo");
  EXPECT_EQ(pdfinfo, 0) << info;
  EXPECT_NE(info.find("340.157 x 283.465 pts"), std::string::npos) << info;
  std::filesystem::remove_all(folder);
}

TEST(Pdf, TellsAFileThatHoldsSomethingElse) {
  const ExportDocument document = hardCurves();
  ExportSettings settings;
  settings.format = ExportFormat::Pdf;
  auto pdf = writePdf(document, settings);
  ASSERT_TRUE(pdf);
  EXPECT_LE(checkPdf(pdf->bytes, document).value(), 0.0021);
  ExportDocument moved = document;
  moved.curves[0].pieces[0].curve = moved.curves[0].pieces[0].curve.mapped(Eigen::Matrix2d::Identity(), {0, 0.5});
  EXPECT_GT(checkPdf(pdf->bytes, moved).value(), 0.4);
  EXPECT_FALSE(checkPdf(pdf->bytes.substr(0, pdf->bytes.size() / 3), document));
  moved.curves.pop_back();
  EXPECT_FALSE(checkPdf(pdf->bytes, moved));
}

TEST(CubicPaths, AreTheSameWithAnyNumberOfThreads) {
  for (const NurbsCurve& curve : {test::severalSpans(), test::bezierChain(), test::smoothLoop()}) {
    RunContext one, four;
    one.threads = 1;
    four.threads = 4;
    const auto a = cubicPath(curve, {0.001, 1e-9}, one), b = cubicPath(curve, {0.001, 1e-9}, four);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->largestJump, b->largestJump);
    EXPECT_EQ(a->largestError, b->largestError);
    ASSERT_EQ(a->runs.size(), b->runs.size());
    for (std::size_t i = 0; i < a->runs.size(); ++i) EXPECT_EQ(a->runs[i].cubics, b->runs[i].cubics);
  }
}

// Once a curve that runs close by its own end before it comes there was refused as a damaged file.
TEST(CubicPaths, MayComeByTheEndOfTheirPiece) {
  const std::vector<std::array<Vec2, 4>> cubics{
      {Vec2(0, 0), Vec2(30, 20), Vec2(70, 20), Vec2(100.05, 0)},
      {Vec2(100.05, 0), Vec2(130, -20), Vec2(170, 30), Vec2(150, 80)},
      {Vec2(150, 80), Vec2(130, 130), Vec2(90, 60), Vec2(100, 0)},
      {Vec2(100, 0), Vec2(130, 10), Vec2(170, -10), Vec2(200, 0)},
  };
  ExportCurve line;
  std::vector<Vec2> points{cubics[0][0]};
  for (std::size_t i = 0; i < 3; ++i) points.insert(points.end(), cubics[i].begin() + 1, cubics[i].end());
  line.pieces.emplace_back().curve = test::made(3, {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 3}, points);
  line.pieces.emplace_back().curve = test::made(3, {0, 0, 0, 0, 1, 1, 1, 1}, {cubics[3].begin(), cubics[3].end()});
  EXPECT_LT(distanceFromLine(cubics, line), 1e-9);
}

}  // namespace
}  // namespace batten
