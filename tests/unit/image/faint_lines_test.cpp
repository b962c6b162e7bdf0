// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "core/image/bits/bit_steps.h"
#include "core/image/threshold/binarize.h"

namespace batten {
namespace {

/// Darkness of one stroke: a pen of `width` px along a distance function, blurred as a scanner does.
double stroke(double distance, double width, double dark) {
  const double edge = std::fabs(distance) - 0.5 * width;
  return dark * 0.5 * std::erfc(edge / std::sqrt(2.0));
}

/// Distance to the straight stroke from (x0, y0) to (x1, y1).
double distanceTo(double x, double y, double x0, double y0, double x1, double y1) {
  const double dx = x1 - x0, dy = y1 - y0;
  const double t = std::clamp(((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(x - x0 - t * dx, y - y0 - t * dy);
}

/// A page of 800 x 600 px whose darkness is given, with the noise of a scanner.
GreyImage page(const std::function<double(double, double)>& dark, double noise) {
  GreyImage image(800, 600);
  std::mt19937 random(7);
  std::normal_distribution<double> grain(0.0, noise);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double level = 235.0 - dark(x + 0.5, y + 0.5) + grain(random);
      image.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 255.0) * 257.0));
    }
  }
  return image;
}

BitImage mask(const GreyImage& grey, double reach = 0.0) {
  ThresholdParams params;
  params.reach = reach;
  return *binarize(grey, *findThresholds(grey, {}, params, {}), params, {});
}

double strongOutline(double x, double y) { return stroke(std::hypot(x - 400.0, y - 300.0) - 250.0, 6.0, 170.0); }

TEST(FaintLines, AreFoundNextToStrongOnes) {
  const auto faintRing = [](double x, double y) { return std::hypot(x - 400.0, y - 300.0) - 232.0; };
  const GreyImage grey =
      page([&](double x, double y) { return strongOutline(x, y) + stroke(faintRing(x, y), 4.0, 50.0); }, 2.0);
  int missedByInk = 0, missed = 0, stray = 0;
  const BitImage found = mask(grey), inkOnly = mask(grey, 1.0);
  for (int k = 0; k < 720; ++k) {
    const double angle = k * std::acos(-1.0) / 360.0;
    const int x = static_cast<int>(400.0 + 232.0 * std::cos(angle)),
              y = static_cast<int>(300.0 + 232.0 * std::sin(angle));
    missed += found.at(x, y) ? 0 : 1;
    missedByInk += inkOnly.at(x, y) ? 0 : 1;
  }
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      const double ring = std::fabs(faintRing(x + 0.5, y + 0.5));
      const double outline = std::fabs(std::hypot(x + 0.5 - 400.0, y + 0.5 - 300.0) - 250.0);
      stray += found.at(x, y) && ring > 5.0 && outline > 5.0 ? 1 : 0;
    }
  }
  EXPECT_GT(missedByInk, 100);  // else there is nothing to find
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(stray, 0);
}

TEST(FaintLines, AreFoundAloneInARegion) {
  const GreyImage grey = page(
      [](double x, double y) {
        return stroke(distanceTo(x, y, 40.0, 60.0, 40.0, 540.0), 6.0, 170.0) +
               stroke(distanceTo(x, y, 320.0, 330.0, 760.0, 270.0), 3.0, 60.0);
      },
      2.0);
  const BitImage found = mask(grey);
  for (int x = 325; x < 755; x += 5)
    EXPECT_TRUE(found.at(x, static_cast<int>(330.0 - (x - 320.0) * 60.0 / 440.0))) << x;
}

TEST(FaintLines, DoNotWidenInkNorMergeParallelLines) {
  const GreyImage grey = page(
      [](double x, double y) {
        return stroke(distanceTo(x, y, 100.0, 200.0, 700.0, 260.0), 5.0, 170.0) +
               stroke(distanceTo(x, y, 100.0, 209.0, 700.0, 269.0), 5.0, 170.0);
      },
      2.0);
  EXPECT_EQ(mask(grey), mask(grey, 1.0));
}

/// Of the pixels within `reachPx` of a curve, the share that the mask holds.
double shareAlong(const BitImage& found, const std::function<double(double, double)>& distance, double reachPx) {
  int all = 0, held = 0;
  for (int y = 0; y < found.height; ++y) {
    for (int x = 0; x < found.width; ++x) {
      if (std::fabs(distance(x + 0.5, y + 0.5)) > reachPx) continue;
      ++all;
      held += found.at(x, y) ? 1 : 0;
    }
  }
  return all > 0 ? static_cast<double>(held) / all : 0.0;
}

/// Lines of a black pen near the sides of all 64 regions: the thresholds follow it.
double penLines(double along, double regionPx) {
  const double at = std::fmod(along, regionPx);
  return stroke(at - 6.0, 4.0, 190.0) + stroke(at - regionPx + 6.0, 4.0, 190.0);
}

double markerLetter(double x, double y) {
  return std::min(distanceTo(x, y, 330, 240, 345, 370), distanceTo(x, y, 345, 370, 368, 240));
}
GreyImage pageWithMarker(double depth) {
  return page([=](double x, double y) { return penLines(x, 100.0) + stroke(markerLetter(x, y), 15.0, depth); }, 2.0);
}

TEST(EvenStrokes, OfAPaleMarkerAreFoundBesideDarkLines) {
  const GreyImage grey = pageWithMarker(55.0);
  EXPECT_GT(shareAlong(mask(grey), markerLetter, 5.0), 0.98);
  EXPECT_LT(shareAlong(mask(grey, 1.0), markerLetter, 5.0), 0.02);
  EXPECT_LT(shareAlong(mask(pageWithMarker(34.0)), markerLetter, 5.0), 0.02) << "less than a quarter as dark as ink";
}

// A pen line across it is no end of it.
TEST(EvenStrokes, GoOnUpToALineThatCrossesThem) {
  const auto marker = [](double x, double y) { return distanceTo(x, y, 335, 120, 365, 480); };
  const auto pen = [](double x, double y) { return distanceTo(x, y, 310, 290, 390, 296); };
  const GreyImage grey = page(
      [&](double x, double y) {
        const double dark = penLines(x, 100.0) + stroke(marker(x, y), 15.0, 55.0);
        return std::max(dark, stroke(pen(x, y), 4.0, 190.0));
      },
      2.0);
  EXPECT_GT(shareAlong(mask(grey), marker, 5.0), 0.99);
}

TEST(EvenStrokes, TonesBetweenLinesShadowsAndWhatLeavesThePictureAreNone) {
  const auto row = [](double at) {
    return [at](double x, double y) { return x > 250.0 && x < 560.0 ? y - at : 1000.0; };
  };
  const auto shadow = [](double x, double y) { return distanceTo(x, y, 200, 412, 620, 412); };
  const GreyImage grey = page(
      [&](double x, double y) {
        // A tone that two lines bound, a shadow, and a band from side to side.
        double dark = penLines(y, 75.0);
        if (x > 180.0 && x < 640.0) {
          dark += std::fabs(y - 338.0) < 11.0 ? 55.0 : 0.0;
          dark = std::max(dark, stroke(y - 325.0, 4.0, 190.0) + stroke(y - 351.0, 4.0, 190.0));
        }
        return dark + 60.0 * std::max(0.0, 1.0 - shadow(x, y) / 20.0) + stroke(y - 188.0, 14.0, 55.0);
      },
      2.0);
  const BitImage found = mask(grey);
  EXPECT_LT(shareAlong(found, row(338.0), 5.0), 0.02);
  EXPECT_LT(shareAlong(found, row(412.0), 6.0), 0.02);
  EXPECT_LT(shareAlong(found, row(188.0), 4.0), 0.02);
}

TEST(FaintLines, LeaveWideHatchingShadingAndNoiseAlone) {
  const auto drawing = [](double x, double y) {
    double dark = strongOutline(x, y);
    for (int k = 0; k < 8; ++k) {
      dark += stroke(distanceTo(x, y, 240.0 + 40.0 * k, 330.0, 290.0 + 40.0 * k, 300.0), 12.0, 18.0);
    }
    return dark + 15.0 * std::exp(-0.5 * std::pow(std::hypot(x - 400.0, y - 180.0) / 40.0, 2.0));
  };
  const GreyImage grey = page(drawing, 3.0);
  const BitImage found = mask(grey);
  int stray = 0;
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      const double outline = std::fabs(std::hypot(x + 0.5 - 400.0, y + 0.5 - 300.0) - 250.0);
      stray += found.at(x, y) && outline > 6.0 ? 1 : 0;
    }
  }
  EXPECT_EQ(stray, 0);
}

TEST(BitSteps, GrowAndShrinkByTheOctagon) {
  std::mt19937 random(5);
  for (const int width : {1, 63, 64, 65, 150}) {
    BitImage image(width, 300);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < width; ++x) image.set(x, y, random() % 40 == 0);
    }
    BitImage inverse(width, 300);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < width; ++x) inverse.set(x, y, !image.at(x, y));
    }
    for (const int steps : {0, 1, 2, 3, 5}) {
      const int square = (steps + 1) / 2;
      const BitImage out = grown(image, steps, {}), opposite = shrunken(inverse, steps, {});
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < width; ++x) {
          bool expected = false;
          for (int v = -steps; v <= steps; ++v) {
            for (int u = -steps; u <= steps; ++u) {
              // Squares of one pixel and crosses of one pixel in turn add up to this.
              const int beyond = std::max(0, std::abs(u) - square) + std::max(0, std::abs(v) - square);
              expected = expected || (beyond <= steps - square && image.at(x + u, y + v));
            }
          }
          ASSERT_EQ(out.at(x, y), expected) << width << ' ' << steps << ": " << x << ", " << y;
          ASSERT_EQ(opposite.at(x, y), !expected);
        }
      }
    }
  }
}

}  // namespace
}  // namespace batten
