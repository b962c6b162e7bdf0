// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/exchange/svg/svg_check.h"
#include "core/exchange/svg/svg_reader.h"
#include "core/exchange/svg/svg_writer.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(SvgCheck, FindsWhatWasWrittenWithItsStatedError) {
  const ExportDocument document = test::exportOfAllKinds();
  for (const double tolerance : {0.05, 0.002}) {
    const auto svg = writeSvg(document, {tolerance, 0.1});
    ASSERT_TRUE(svg);
    const auto check = checkSvg(svg->text, document);
    ASSERT_TRUE(check) << check.error().message << check.error().detail;
    EXPECT_EQ(check->curves, static_cast<int>(document.curves.size()));
    EXPECT_EQ(check->cubics, svg->cubics);
    // The writer measures at other points, both ways.
    EXPECT_LE(check->largestErrorMm, 1.02 * svg->largestErrorMm + 1e-7);
    EXPECT_GT(check->largestErrorMm, 0.1 * svg->largestErrorMm);
  }
}

TEST(SvgCheck, UserUnitsMayBeOthersAndTheSizeStays) {
  const ExportDocument document = test::exportOfAllKinds();
  SvgOptions pixels;
  pixels.unitsPerMm = 96 / 25.4;
  const auto svg = writeSvg(document, pixels);
  ASSERT_TRUE(svg);
  EXPECT_NE(svg->text.find("width=\"120mm\" height=\"100mm\" viewBox=\"0 0 453.543307087 377.952755906\""),
            std::string::npos)
      << svg->text.substr(0, 400);
  // The first curve begins at (10, 10) mm, y up.
  EXPECT_NE(svg->text.find("d=\"M37.795275590551,340.157480314961 C"), std::string::npos);
  EXPECT_LE(svg->largestErrorMm, 0.002);
  const auto check = checkSvg(svg->text, document);
  ASSERT_TRUE(check) << check.error().message << check.error().detail;
  EXPECT_LE(check->largestErrorMm, 0.00201);
  const auto again = readSvg(svg->text);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->frame.widthPx, document.frame.widthPx);
  EXPECT_EQ(again->frame.heightPx, document.frame.heightPx);
  pixels.unitsPerMm = 0.0;
  EXPECT_FALSE(writeSvg(document, pixels));
}

TEST(SvgCheck, RefusesWhatIsCutOffOrChanged) {
  const ExportDocument document = test::exportOfAllKinds();
  const std::string text = writeSvg(document, {}).value().text;
  EXPECT_FALSE(checkSvg("", document));
  EXPECT_FALSE(checkSvg(text.substr(0, text.size() / 2), document));
  EXPECT_FALSE(checkSvg(text.substr(0, text.size() - 20), document));
  EXPECT_FALSE(checkSvg(replaced(text, "degree=\"5\"", "degree=\"4\""), document));
  EXPECT_FALSE(checkSvg(replaced(text, "control-points=\"10,10", "control-points=\"10,11"), document));
  EXPECT_FALSE(checkSvg(replaced(text, "<path id=\"curve-2\"", "<rect id=\"curve-2\""), document));
  ExportDocument fewer = document;
  fewer.curves.pop_back();
  EXPECT_FALSE(checkSvg(text, fewer));
}

TEST(SvgCheck, FindsABridgeOverAGapAndAPathClosedOtherwise) {
  ExportDocument document = test::exportOfAllKinds();
  const auto line = [](const Vec2& a, const Vec2& b) { return test::made(1, {0, 0, 30, 30}, {a, b}); };
  document.curves.push_back({"curve-7", false, {{line({10, 10}, {40, 10})}, {line({43, 10}, {43, 40})}}});
  const std::string text = writeSvg(document, {}).value().text;
  ASSERT_TRUE(checkSvg(text, document));
  const auto bridged = checkSvg(replaced(text, " M43,90", ""), document);
  ASSERT_TRUE(bridged);
  EXPECT_GE(bridged->largestErrorMm, 3.0 - 1e-6);
  EXPECT_FALSE(checkSvg(replaced(text, " Z\"", "\""), document));
  EXPECT_FALSE(checkSvg(replaced(text, "\"/>\n  </g>", " Z\"/>\n  </g>"), document));
}

TEST(SvgCheck, AHookAtTheEndOfAPieceBelongsToIt) {
  // Smaller than a thousandth of the piece, whose end is where the hook ends.
  const NurbsCurve hooked =
      test::made(3, {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2},
                 {{5, 50}, {30, 60}, {60, 40}, {90, 50}, {90.06, 50.04}, {90.06, 50.06}, {90, 50.05}});
  const NurbsCurve next = test::made(3, {0, 0, 0, 0, 1, 1, 1, 1}, {{90, 50.05}, {80, 60}, {60, 90}, {50, 95}});
  ExportDocument document = test::exportOfAllKinds();
  document.curves = {{"hooked", false, {{hooked}, {next}}}};
  const auto svg = writeSvg(document, {});
  ASSERT_TRUE(svg);
  const auto check = checkSvg(svg->text, document);
  ASSERT_TRUE(check) << check.error().message;
  EXPECT_LE(check->largestErrorMm, 1.02 * svg->largestErrorMm + 1e-7);
}

TEST(SvgCheck, MeasuresAPathThatLeavesItsCurve) {
  const ExportDocument document = test::exportOfAllKinds();
  const std::string text = writeSvg(document, {}).value().text;
  const auto start = text.find("<path id=\"curve-1\" d=\"M10,90");
  ASSERT_NE(start, std::string::npos) << "the first curve starts at (10, 10) mm on a page of 100 mm";
  std::string moved = text;
  moved.replace(text.find("M10,90", start), 6, "M10,93");
  const auto check = checkSvg(moved, document);
  ASSERT_TRUE(check);
  EXPECT_GT(check->largestErrorMm, 1.0);
}

}  // namespace
}  // namespace batten
