// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/paper_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>

#include "tests/support/photo_page.h"

namespace batten {
namespace {

constexpr int kDeskWidth = 960, kDeskHeight = 720;

/// A ring, and a line that runs off the sheet on the right.
double drawn(const Vec2& mm) {
  const bool isRing = std::fabs(std::hypot(mm.x() - 100.0, mm.y() - 140.0) - 60.0) < 1.5;
  const bool isLine = std::fabs(mm.y() - 240.0) < 1.5 && mm.x() > 90.0;
  return isRing || isLine ? 1.0 : 0.0;
}

test::PhotoCamera smallSheet() { return {{.tiltDeg = 10.0, .rollDeg = 14.0, .fill = 0.55}, kDeskWidth, kDeskHeight}; }

void paintGrey(Scan& scan, const std::function<std::optional<double>(double, double)>& greyAt) {
  for (int y = 0; y < kDeskHeight; ++y) {
    for (int x = 0; x < kDeskWidth; ++x) {
      if (const auto grey = greyAt(x + 0.5, y + 0.5))
        scan.grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(*grey * GreyImage::kGreyUnit));
    }
  }
}

/// A pen across the upper left corner of the sheet, and a printed pattern of the table.
Scan desk() {
  const test::PhotoCamera camera = smallSheet();
  Scan scan = renderPhoto(camera, drawn, {.table = 150.0, .tableRough = 4.0});
  const Vec2 corner = camera.corners()[0];
  paintGrey(scan, [&](double x, double y) -> std::optional<double> {
    const double along = (x - corner.x()) * 0.6 - (y - corner.y()) * 0.8;
    const double across = (x - corner.x()) * 0.8 + (y - corner.y()) * 0.6;
    if (std::fabs(along) < 130.0 && std::fabs(across - 12.0) < 20.0) return 40.0;
    const Vec2 mm = camera.toSheet({x, y});
    const bool isOnSheet = mm.x() > -2.0 && mm.y() > -2.0 && mm.x() < 212.0 && mm.y() < 299.0;
    if (!isOnSheet && std::fabs(std::hypot(std::fmod(x, 120.0) - 60.0, std::fmod(y, 120.0) - 60.0) - 40.0) < 2.0)
      return 90.0;
    return {};
  });
  return scan;
}

std::optional<PaperSheet> freeSheetOf(const Scan& scan) { return findPaperSheet(scan.grey, scan.colour, {}); }
bool isInside(const PaperSheet& sheet, const Vec2& px) {
  return sheet.inside.at(static_cast<int>(px.x()) / sheet.cellPx, static_cast<int>(px.y()) / sheet.cellPx);
}

// Less than a third of the picture, with the drawing and the line that runs off it; what lies beside it is cut off.
TEST(StraightSidedSheet, ASmallSheetOnADeskIsFound) {
  const test::PhotoCamera camera = smallSheet();
  const auto sheet = freeSheetOf(desk());
  ASSERT_TRUE(sheet.has_value());
  for (double y = -40.0; y < 340.0; y += 6.0) {
    for (double x = -60.0; x < 270.0; x += 6.0) {
      const Vec2 px = camera.toPicture({x, y});
      if (px.x() < 0.0 || px.y() < 0.0 || px.x() >= kDeskWidth || px.y() >= kDeskHeight) continue;
      const double depth = std::min({x, y, 210.0 - x, 297.0 - y});
      if (x + y < 80.0 || (depth > -2.0 && depth < 8.0)) continue;
      ASSERT_EQ(isInside(*sheet, px), depth > 0.0) << x << ' ' << y;
    }
  }
}

TEST(StraightSidedSheet, AThingThatReachesOntoItIsCutOff) {
  const auto sheet = freeSheetOf(desk());
  ASSERT_TRUE(sheet.has_value());
  EXPECT_FALSE(isInside(*sheet, smallSheet().toPicture({16.0, 6.0})));
}

/// Turned by 8 degrees, as if photographed.
bool isInBox(double x, double y, double halfWidth, double halfHeight) {
  const double u = std::cos(0.14) * (x - 480.0) + std::sin(0.14) * (y - 360.0);
  const double v = -std::sin(0.14) * (x - 480.0) + std::cos(0.14) * (y - 360.0);
  return std::fabs(u) < halfWidth && std::fabs(v) < halfHeight;
}

Scan tonedPage(const std::function<double(double, double)>& greyAt, double noise = 1.5) {
  Scan scan;
  scan.grey = GreyImage(kDeskWidth, kDeskHeight);
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, noise);
  paintGrey(scan, [&](double x, double y) { return std::clamp(greyAt(x, y) + normal(random), 0.0, 255.0); });
  return scan;
}
bool isCircleDrawn(double x, double y) { return std::fabs(std::hypot(x - 480.0, y - 360.0) - 90.0) < 3.0; }

// The same paper lies on both sides of a line, however thick.
TEST(StraightSidedSheet, ADrawnFrameIsNone) {
  const auto framed = [](double x, double y) {
    const bool isFrame = isInBox(x, y, 220.0, 160.0) && !isInBox(x, y, 212.0, 152.0);
    return isFrame || isCircleDrawn(x, y) ? 40.0 : 230.0;
  };
  EXPECT_FALSE(freeSheetOf(tonedPage(framed)).has_value());
}

// Darker than the paper around it.
TEST(StraightSidedSheet, AFilledRectangleIsNone) {
  const auto filled = [](double x, double y) {
    if (isCircleDrawn(x, y)) return 40.0;
    return isInBox(x, y, 220.0, 160.0) ? 170.0 : 230.0;
  };
  EXPECT_FALSE(freeSheetOf(tonedPage(filled)).has_value());
}

// Round the dark rectangle with a bright panel in it lies paper as bright.
TEST(StraightSidedSheet, APanelInADarkRectangleIsNone) {
  const auto panel = [](double x, double y) {
    if (isCircleDrawn(x, y)) return 40.0;
    return isInBox(x, y, 310.0, 250.0) && !isInBox(x, y, 220.0, 160.0) ? 70.0 : 230.0;
  };
  EXPECT_FALSE(freeSheetOf(tonedPage(panel)).has_value());
}

// Two panels of a page with a dark ground: both are drawn.
TEST(StraightSidedSheet, OneOfTwoBrightPanelsIsNone) {
  const auto panels = [](double x, double y) {
    const bool isPanel = isInBox(x + 230.0, y + 30.0, 160.0, 190.0) || isInBox(x - 180.0, y - 30.0, 160.0, 190.0);
    return isPanel && !isCircleDrawn(x + 230.0, y) ? 230.0 : 60.0;
  };
  EXPECT_FALSE(freeSheetOf(tonedPage(panels)).has_value());
}

// A poster: a panel square to the picture, with what is drawn beside it.
TEST(StraightSidedSheet, APanelSquareToThePictureIsNone) {
  const auto poster = [](double x, double y) {
    if (isCircleDrawn(x, y) || std::fabs(std::hypot(x - 120.0, y - 360.0) - 60.0) < 3.0) return 20.0;
    return std::fabs(x - 480.0) < 210.0 && std::fabs(y - 360.0) < 160.0 ? 240.0 : 90.0;
  };
  EXPECT_FALSE(freeSheetOf(tonedPage(poster)).has_value());
}

// Toned paper with dark discs about the panel.
TEST(StraightSidedSheet, ABrightPanelOnTonedPaperThatIsDrawnUponIsNone) {
  const auto toned = [](double x, double y) {
    if (isCircleDrawn(x, y)) return 40.0;
    if (isInBox(x, y, 220.0, 160.0)) return 240.0;
    return std::hypot(std::fmod(x, 80.0) - 40.0, std::fmod(y, 80.0) - 40.0) < 32.0 ? 60.0 : 180.0;
  };
  EXPECT_FALSE(freeSheetOf(tonedPage(toned)).has_value());
}

// A bright shape that a hand drew: a car body, a leaf.
TEST(StraightSidedSheet, ABrightShapeWithoutFourStraightSidesIsNone) {
  const auto shape = [](double x, double y) {
    const double u = (x - 480.0) / 260.0, v = (y - 360.0) / 190.0;
    return u * u + v * v < 1.0 && !isCircleDrawn(x, y) ? 235.0 : 80.0;
  };
  EXPECT_FALSE(freeSheetOf(tonedPage(shape)).has_value());
}

}  // namespace
}  // namespace batten
