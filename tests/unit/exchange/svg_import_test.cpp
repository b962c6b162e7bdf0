// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/exchange/svg/svg_path_data.h"
#include "core/exchange/svg/svg_shapes.h"
#include "tests/unit/exchange/import_folder.h"

namespace batten {
namespace {

using test::exported;
using test::Import;
using testing::HasSubstr;

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

}  // namespace
}  // namespace batten
