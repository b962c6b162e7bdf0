// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/faint_marks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/image/bits/bit_disc.h"

namespace batten {
namespace {

constexpr int kMarksWidth = 900, kMarksHeight = 500;
constexpr double kMarksPenPx = 6.0, kMarkRadius = 4.0;
constexpr double kLineContrast = 0.4;  // at the left; at the right the light is half, the contrast is not

double lightAt(double x) { return 230.0 * (1.0 - 0.5 * x / kMarksWidth); }

struct Mark {
  Vec2 at;
  double contrast;
};

/// A page with lines across it at y = 100 and y = 400, and marks.
struct MarkedPage {
  GreyImage grey{kMarksWidth, kMarksHeight};
  BitImage marks{kMarksWidth, kMarksHeight}, ink{kMarksWidth, kMarksHeight};
  ContourSet lines;

  explicit MarkedPage(const std::vector<Mark>& drawn) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 2.0);
    for (const Mark& mark : drawn) {
      setDisc(marks, mark.at, kMarkRadius);
      setDisc(ink, mark.at, kMarkRadius);
    }
    for (int y = 0; y < kMarksHeight; ++y) {
      for (int x = 0; x < kMarksWidth; ++x) {
        double contrast = 0.0;
        for (const Mark& mark : drawn) {
          const double inside = std::clamp(kMarkRadius + 0.5 - (Vec2(x + 0.5, y + 0.5) - mark.at).norm(), 0.0, 1.0);
          contrast = std::max(contrast, mark.contrast * inside);
        }
        const double toLine = std::min(std::fabs(y + 0.5 - 100.0), std::fabs(y + 0.5 - 400.0));
        if (toLine < 0.5 * kMarksPenPx) {
          contrast = kLineContrast;
          ink.set(x, y, true);
        }
        const double level = lightAt(x) * (1.0 - contrast) + noise(random);
        grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 255.0) * 257.0));
      }
    }
    for (const double y : {100.0, 400.0}) {
      Contour line;
      line.kind = ContourKind::Centreline;
      for (int x = 10; x < kMarksWidth - 10; ++x) {
        ContourPoint point;
        point.at = point.unrefined = Vec2(x, y);
        point.widthPx = static_cast<float>(kMarksPenPx);
        line.points.push_back(point);
      }
      measureContour(line);
      lines.contours.push_back(std::move(line));
    }
  }
};

bool isFaint(const FaintMarks& faint, const Vec2& at) {
  return faint.ink.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
}

TEST(FaintMarks, AreTheSpecksAndNotTheDots) {
  const std::vector<Mark> dots = {{{100, 250}, 0.4}, {{800, 250}, 0.4}, {{450, 130}, 0.25}};
  const std::vector<Mark> specks = {{{200, 300}, 0.1}, {{700, 200}, 0.1}, {{450, 370}, 0.08}};
  std::vector<Mark> all = dots;
  all.insert(all.end(), specks.begin(), specks.end());
  const MarkedPage page(all);
  const FaintMarks faint = faintMarks(page.marks, page.ink, page.lines, page.grey, kMarksPenPx, {});
  EXPECT_EQ(faint.count, 3);
  for (const Mark& dot : dots) EXPECT_FALSE(isFaint(faint, dot.at)) << dot.at.transpose();
  for (const Mark& speck : specks) EXPECT_TRUE(isFaint(faint, speck.at)) << speck.at.transpose();
}

TEST(FaintMarks, NothingIsFaintWithoutLinesOrWhereItIsLong) {
  MarkedPage page({{{200, 300}, 0.1}});
  EXPECT_EQ(faintMarks(page.marks, page.ink, {}, page.grey, kMarksPenPx, {}).count, 0);
  EXPECT_EQ(faintMarks(page.marks, page.ink, page.lines, page.grey, 0.25 * kMarksPenPx, {}).count, 0)
      << "longer than three pens";
}

}  // namespace
}  // namespace batten
