// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/curve_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <random>

#include "core/exchange/export_file.h"
#include "core/exchange/svg/svg_reader.h"
#include "core/exchange/svg/svg_writer.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

namespace fs = std::filesystem;

class CurveFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("batten curves 漢字 " + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path written(const ExportDocument& document, const char* ending, LengthUnit unit) const {
    const fs::path path = folder_ / (std::string("a") + ending);
    ExportSettings settings;
    settings.format = *formatOf(path);
    settings.unit = unit;
    const auto report = exportToFile(document, settings, path);
    EXPECT_TRUE(report) << (report ? "" : report.error().message);
    return path;
  }
  fs::path folder_;
};

TEST_F(CurveFile, ReadsWhatIsExportedInMillimetresWhateverTheUnit) {
  const ExportDocument document = test::exportOfAllKinds();
  for (const char* ending : {".json", ".svg", ".dxf"}) {
    for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Inch}) {
      const auto read = readCurveFile(written(document, ending, unit));
      ASSERT_TRUE(read) << ending << read.error().message;
      std::vector<NurbsCurve> curves;
      for (const ExportCurve& line : read->curves)
        for (const ExportPiece& piece : line.pieces) curves.push_back(piece.curve);
      ASSERT_EQ(curves.size(), 8u) << ending;
      std::size_t next = 0;
      for (const ExportCurve& line : document.curves) {
        for (const ExportPiece& piece : line.pieces) {
          const NurbsCurve& curve = curves[next++];
          for (int i = 0; i <= 100; ++i) {
            const Vec2 p = curve.point(curve.start() + (curve.end() - curve.start()) * i / 100);
            const Vec2 q = piece.curve.point(piece.curve.start() + (piece.curve.end() - piece.curve.start()) * i / 100);
            EXPECT_LE((p - q).norm(), 1e-9) << ending << " " << line.id;
          }
        }
      }
    }
  }
}

TEST_F(CurveFile, AnSvgOpensAgainToTheLastBit) {
  ExportDocument document = test::exportOfAllDegrees();
  document.curves[1].name = "Dach & \"Süße\" <漢字>";
  document.curves[1].layer = "Sketched";
  document.curves[0].pieces[0].name = "Curve 12";
  const auto svg = writeSvg(document, {});
  ASSERT_TRUE(svg);
  const auto read = readSvg(svg->text);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->curves.size(), document.curves.size());
  EXPECT_EQ(read->frame, document.frame);
  EXPECT_EQ(read->title, document.title);
  EXPECT_EQ(read->imageSha256, document.imageSha256);
  for (std::size_t i = 0; i < document.curves.size(); ++i) {
    const ExportCurve &a = document.curves[i], &b = read->curves[i];
    EXPECT_EQ(b.id, a.id);
    EXPECT_EQ(b.name, a.name);
    EXPECT_EQ(b.layer, a.layer);
    EXPECT_EQ(b.closed, a.closed);
    ASSERT_EQ(b.pieces.size(), a.pieces.size());
    for (std::size_t k = 0; k < a.pieces.size(); ++k) {
      EXPECT_EQ(b.pieces[k].curve, a.pieces[k].curve) << a.id;
      EXPECT_EQ(b.pieces[k].name, a.pieces[k].name);
    }
  }
}

TEST_F(CurveFile, DamagedSvgsAreRefusedWithAReason) {
  const std::string whole = writeSvg(test::exportOfAllKinds(), {})->text;
  for (std::size_t length = 0; length + 8 < whole.size(); length += 211) {
    const auto read = readSvg(whole.substr(0, length));
    ASSERT_FALSE(read) << length;
    EXPECT_TRUE(read.error().message.starts_with("The SVG cannot be read: ")) << read.error().message;
  }
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    std::string text = whole;
    for (int flips = 0; flips < 10; ++flips) text[random() % text.size()] ^= static_cast<char>(1 << (random() % 7));
    const auto read = readSvg(text);
    if (!read) {
      EXPECT_FALSE(read.error().message.empty());
    }
  }
  for (const char* text : {"", "<svg", "<svg viewBox=\"0 0 1 1\"/>", "<svg><curves mm-per-px=\"nan\"/></svg>"})
    EXPECT_FALSE(readSvg(text)) << text;
  std::string deep = "<svg viewBox=\"0 0 1 1\">";
  for (int i = 0; i < 100000; ++i) deep += "<g>";
  EXPECT_FALSE(readSvg(deep));
}

TEST_F(CurveFile, SaysWhatItDoesNotRead) {
  EXPECT_NE(readCurveFile(folder_ / "none.dxf").error().message.find("Check the name"), std::string::npos);
  const fs::path pdf = written(test::exportOfAllKinds(), ".pdf", LengthUnit::Millimetre);
  EXPECT_NE(readCurveFile(pdf).error().message.find("Use a .json"), std::string::npos);
  const fs::path empty = folder_ / "empty.dxf";
  std::ofstream(empty) << "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n";
  EXPECT_EQ(readCurveFile(empty).error().code, ErrorCode::NoCurve);
}

TEST(CurveFileText, SaysOnceWhatIsWrong) {
  const auto broken =
      readSvg(R"(<svg xmlns:batten="urn:batten:curves:1" width="9mm" height="9mm"><batten:curves mm-per-px="0.1">)"
              R"(<batten:curve id="a"><batten:piece degree="9"/></batten:curve></batten:curves></svg>)");
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().message, "The SVG cannot be read: a curve of its metadata is no B-spline.");
}

}  // namespace
}  // namespace batten
