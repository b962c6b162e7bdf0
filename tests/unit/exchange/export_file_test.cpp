// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/export_file.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/number_text.h"
#include "core/curve/arc_length.h"
#include "core/exchange/cad/dxf_reader.h"
#include "core/exchange/cad/dxf_writer.h"
#include "core/exchange/model/cad_drawing.h"
#include "core/exchange/model/file_text.h"
#include "core/exchange/text/csv_writer.h"
#include "core/exchange/text/polynomial_writer.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

namespace fs = std::filesystem;
using test::exportOfAllDegrees;
using test::exportOfAllKinds;

class ExportFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("batten export süß 漢字 " + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  static std::string contentOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder_;
};

ExportSettings settingsOf(ExportFormat format) {
  ExportSettings settings;
  settings.format = format;
  return settings;
}

TEST_F(ExportFile, WritesEveryFormatAndStatesTheDifference) {
  for (const ExportFormat format :
       {ExportFormat::Svg, ExportFormat::Json, ExportFormat::Dxf, ExportFormat::Iges, ExportFormat::Step,
        ExportFormat::Pdf, ExportFormat::Csv, ExportFormat::Polynomials, ExportFormat::Rhino}) {
    const fs::path path = folder_ / ("süße kurve" + std::string(endingsOf(format)[0]));
    EXPECT_EQ(formatOf(path), format);
    const auto report = exportToFile(exportOfAllKinds(), settingsOf(format), path);
    ASSERT_TRUE(report) << path << report.error().message << report.error().detail;
    EXPECT_EQ(report->curves, 6);
    EXPECT_EQ(report->pieces, 8);
    EXPECT_LE(report->largestDifferenceMm, format == ExportFormat::Svg || format == ExportFormat::Pdf ? 0.0021 : 1e-9);
    EXPECT_GT(fs::file_size(path), 500u);
    const std::string sentence = sentenceOf(*report);
    EXPECT_TRUE(sentence.starts_with("6 curves in 8 pieces")) << sentence;
    EXPECT_TRUE(sentenceByNumbers(*report).starts_with("8 curves")) << "as the window counts";
    EXPECT_NE(sentence.find("read back, largest difference "), std::string::npos) << sentence;
  }
}

TEST_F(ExportFile, WhatRoundingLeavesIsNoJump) {
  ExportReport report;
  report.curves = 1;
  report.largestJump = 4.1e-10;
  EXPECT_NE(sentenceOf(report).find("no jumps of curvature"), std::string::npos) << sentenceOf(report);
  report.largestJump = 0.02;
  EXPECT_NE(sentenceOf(report).find("curvature jumps by 2 % at most"), std::string::npos) << sentenceOf(report);
}

TEST_F(ExportFile, WritesRationalCurvesAsPolynomials) {
  const ExportDocument document = exportOfAllDegrees();
  const auto isRational = [](const ExportCurve& line) { return line.pieces.front().curve.isRational(); };
  ASSERT_TRUE(std::any_of(document.curves.begin(), document.curves.end(), isRational));
  const auto report = exportToFile(document, settingsOf(ExportFormat::Polynomials), folder_ / "arcs.poly.csv");
  ASSERT_TRUE(report) << report.error().message << report.error().detail;
  EXPECT_LE(report->largestDifferenceMm, 1e-9);
}

TEST_F(ExportFile, EveryPresetWritesWhatItSays) {
  for (const ExportPreset& preset : exportPresets()) {
    const fs::path path = folder_ / (std::string(preset.id) + endingsOf(preset.settings.format)[0]);
    const auto report = exportToFile(exportOfAllKinds(), preset.settings, path);
    ASSERT_TRUE(report) << preset.id << report.error().message;
    EXPECT_EQ(findPreset(preset.id), &preset);
  }
  EXPECT_EQ(findPreset("paper"), nullptr);
}

TEST_F(ExportFile, RefusesAndLeavesTheOldFileWhole) {
  const fs::path path = folder_ / "kept.poly.csv";
  std::ofstream(path) << "old";
  ExportDocument empty = exportOfAllKinds();
  empty.curves.clear();
  for (const ExportFormat format : {ExportFormat::Svg, ExportFormat::Dxf, ExportFormat::Step, ExportFormat::Csv}) {
    const auto nothing = exportToFile(empty, settingsOf(format), path);
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().code, ErrorCode::NoCurve);
  }
  ExportSettings wrong = settingsOf(ExportFormat::Dxf);
  wrong.scale = 0.0;
  EXPECT_EQ(exportToFile(exportOfAllKinds(), wrong, path).error().code, ErrorCode::BadParameter);
  wrong.scale = 1.0;
  wrong.toleranceMm = -1.0;
  EXPECT_FALSE(exportToFile(exportOfAllKinds(), wrong, path));
  RunContext stopped;
  stopped.cancel.cancel();
  EXPECT_EQ(exportToFile(exportOfAllKinds(), settingsOf(ExportFormat::Dxf), path, stopped).error().code,
            ErrorCode::Cancelled);
  EXPECT_EQ(contentOf(path), "old");
}

/// The file with another first digit after the point in the number that begins at `at`.
std::string withAnotherDigit(std::string text, std::size_t at) {
  const auto point = text.find('.', at);
  EXPECT_NE(point, std::string::npos);
  text[point + 1] = text[point + 1] == '7' ? '2' : '7';
  return text;
}

TEST(ReadBack, ADigitThatChangedInATableIsNoticed) {
  const ExportDocument document = exportOfAllKinds();
  const auto isNoticed = [](const Result<double>& difference) { return !difference || *difference > 1e-9; };
  const std::string csv = *writeCsv(document, settingsOf(ExportFormat::Csv));
  const auto row = csv.find("\ncurve-2,");
  ASSERT_NE(row, std::string::npos);
  EXPECT_TRUE(
      isNoticed(checkCsv(withAnotherDigit(csv, csv.find('\n', row + 1)), document, settingsOf(ExportFormat::Csv))));
  EXPECT_FALSE(checkCsv(csv.substr(0, csv.size() / 2), document, settingsOf(ExportFormat::Csv)));
  const ExportSettings list = settingsOf(ExportFormat::Polynomials);
  const std::string poly = *writePolynomials(document, list);
  EXPECT_TRUE(isNoticed(checkPolynomials(withAnotherDigit(poly, poly.size() / 2), document, list)));
  EXPECT_FALSE(checkPolynomials(poly.substr(0, poly.size() / 2), document, list));
}

TEST(ReadBack, AVertexThatMovedInAnR12PolylineIsNoticed) {
  ExportSettings settings = settingsOf(ExportFormat::Dxf);
  settings.dxf = DxfProfile::Cnc;
  const auto made = cadExport(exportOfAllKinds(), settings);
  ASSERT_TRUE(made);
  const auto text = writeDxf(made->drawing, DxfProfile::Cnc);
  ASSERT_TRUE(text);
  EXPECT_LE(largestDifference(made->drawing, *readDxf(*text)).value(), 1e-9);
  const auto vertex = text->find("VERTEX", text->size() / 2);
  const auto moved = readDxf(withAnotherDigit(*text, text->find("\n 10\n", vertex)));
  ASSERT_TRUE(moved);
  EXPECT_GT(largestDifference(made->drawing, *moved).value(), 1e-3);
}

TEST(ExportSettings, EndingsChooseTheFormatWhateverTheirCase) {
  EXPECT_EQ(formatOf("A.DXF"), ExportFormat::Dxf);
  EXPECT_EQ(formatOf("a.b.Step"), ExportFormat::Step);
  EXPECT_EQ(formatOf("a.iges"), ExportFormat::Iges);
  EXPECT_EQ(formatOf("a.poly.csv"), ExportFormat::Polynomials);
  EXPECT_EQ(formatOf("poly.csv"), ExportFormat::Csv);
  EXPECT_FALSE(formatOf("a.dwg"));
  EXPECT_FALSE(formatOf(".dxf")) << "a name without a name";
  EXPECT_NE(allEndings().find(".stp"), std::string::npos);
}

TEST(ChosenCurves, CountsPiecesAsTheWindowDoes) {
  const ExportDocument document = exportOfAllKinds();  // 5 lines of one piece, a loop of three
  const auto two = chosenCurves(document, "2,5");
  ASSERT_TRUE(two);
  ASSERT_EQ(two->curves.size(), 2u);
  EXPECT_EQ(two->curves[1].id, "curve-5");
  const auto loop = chosenCurves(document, "6-8");
  ASSERT_TRUE(loop);
  EXPECT_TRUE(loop->curves[0].closed);
  const auto part = chosenCurves(document, "6,8");
  ASSERT_TRUE(part);
  ASSERT_EQ(part->curves.size(), 2u) << "a gap parts the line";
  EXPECT_FALSE(part->curves[0].closed);
  EXPECT_NE(part->curves[0].id, part->curves[1].id);
  for (const char* wrong : {"", "0", "1,", "a", "3-1", "9", "1;2", "99999999999999999999"})
    EXPECT_FALSE(chosenCurves(document, wrong)) << wrong;
}

TEST(Csv, RowsAreOnTheCurveAndTheirCurvatureIsThatOfThePlaces) {
  for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Inch}) {
    ExportSettings settings = settingsOf(ExportFormat::Csv);
    settings.unit = unit;
    settings.spacingMm = 0.02;
    ExportDocument document = exportOfAllKinds();
    document.curves.erase(document.curves.begin() + 1, document.curves.end());
    const auto text = writeCsv(document, settings);
    ASSERT_TRUE(text);
    std::istringstream lines(*text);
    std::string line;
    std::getline(lines, line);
    EXPECT_TRUE(line.starts_with("# Curvature is positive where the curve turns left"));
    std::getline(lines, line);
    const std::string name = nameOf(unit);
    EXPECT_EQ(line, "curve,piece,s_" + name + ",x_" + name + ",y_" + name + ",tangent_deg,kappa_per_" + name +
                        ",radius_" + name);
    std::vector<std::array<double, 6>> rows;
    while (std::getline(lines, line)) {
      const auto fields = csvFields(line);
      ASSERT_EQ(fields.size(), 8u);
      EXPECT_EQ(fields[0], "curve-1");
      std::array<double, 6> row{};
      for (std::size_t i = 0; i < 6; ++i) row[i] = numberFromText(fields[i + 2]).value_or(0.0);
      rows.push_back(row);
    }
    const double length = ArcLength(document.curves[0].pieces[0].curve).total() / millimetresPer(unit);
    EXPECT_NEAR(rows.back()[0], length, 1e-9);
    for (std::size_t i = 50; i + 50 < rows.size(); i += 17) {
      // Circle through three places: its curvature to second order of their distance.
      const Vec2 a(rows[i - 5][1], rows[i - 5][2]), b(rows[i][1], rows[i][2]), c(rows[i + 5][1], rows[i + 5][2]);
      const double kappa = 2 * cross(b - a, c - b) / ((b - a).norm() * (c - b).norm() * (c - a).norm());
      EXPECT_NEAR(rows[i][4], kappa, 2e-4 * std::abs(kappa) + 1e-5);
      EXPECT_NEAR(rows[i][5] * rows[i][4], 1.0, 1e-12);
      const double turn = std::atan2((c - a).y(), (c - a).x()) * 180 / M_PI;
      EXPECT_NEAR(rows[i][3], turn, 0.02);
    }
  }
}

TEST(Csv, AStraightPlaceHasNoRadiusAndNamesAreQuoted) {
  ExportDocument document = exportOfAllKinds();
  document.curves = {document.curves[4]};
  document.curves[0].name = "roof, \"upper\"";
  const auto text = writeCsv(document, settingsOf(ExportFormat::Csv));
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("\n\"roof, \"\"upper\"\"\",\"roof, \"\"upper\"\"\",0,10,80,"), std::string::npos) << *text;
  EXPECT_NE(text->find(",\n"), std::string::npos) << "an empty radius";
  EXPECT_LE(checkCsv(*text, document, settingsOf(ExportFormat::Csv)).value(), 1e-9);
  EXPECT_FALSE(checkCsv(text->substr(0, text->size() / 2), document, settingsOf(ExportFormat::Csv)));
}

TEST(Polynomials, AreTheCurve) {
  const ExportSettings settings = settingsOf(ExportFormat::Polynomials);
  ExportDocument document = exportOfAllKinds();
  const auto text = writePolynomials(document, settings);
  ASSERT_TRUE(text);
  // The first curve is one Bezier piece: its polynomial by hand at t = 0.3 of its length, by Horner's rule.
  std::istringstream lines(*text);
  std::string line;
  for (int i = 0; i < 3; ++i) std::getline(lines, line);
  const auto fields = csvFields(line);
  ASSERT_EQ(fields.size(), 5u + 12u);
  const double t = 0.3 * numberFromText(fields[4]).value();
  Vec2 value = Vec2::Zero();
  for (std::size_t k = 6; k-- > 0;)
    value = value * t + Vec2(numberFromText(fields[5 + k]).value(), numberFromText(fields[11 + k]).value());
  EXPECT_LT((value - test::oneSpan().point(9.0)).norm(), 1e-12);
  EXPECT_LE(checkPolynomials(*text, document, settings).value(), 1e-10);
  document.curves[0].pieces[0].curve = document.curves[0].pieces[0].curve.mapped(Eigen::Matrix2d::Identity(), {0, 1});
  EXPECT_NEAR(checkPolynomials(*text, document, settings).value(), 1.0, 1e-9);
}

TEST_F(ExportFile, EveryFormatHearsACancelWhileItIsWritten) {
  for (const ExportFormat format : {ExportFormat::Svg, ExportFormat::Json, ExportFormat::Pdf, ExportFormat::Csv,
                                    ExportFormat::Polynomials, ExportFormat::Dxf}) {
    ExportSettings settings;
    settings.format = format;
    double last = 0.0;
    bool falls = false;
    RunContext context;
    context.progress = [&](double fraction) {
      falls = falls || fraction < last;
      last = fraction;
      if (fraction >= 0.25) context.cancel.cancel();
    };
    const auto file = exportedFile(test::exportOfAllKinds(), settings, context);
    ASSERT_FALSE(file) << static_cast<int>(format);
    EXPECT_EQ(file.error().code, ErrorCode::Cancelled);
    EXPECT_FALSE(falls);
    EXPECT_GE(last, 0.25);
    EXPECT_LT(last, 0.9) << "it stops at once";
  }
}

}  // namespace
}  // namespace batten
