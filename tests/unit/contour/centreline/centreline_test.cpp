// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/centreline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/contour/centreline/pencil/stroke_split.h"
#include "core/contour/centreline/skeleton/skeleton.h"
#include "tests/support/ink_page.h"
#include "tests/support/render_page.h"
#include "tests/support/truth_shapes.h"

namespace batten {
namespace {

using test::InkPage;
using Polyline = std::vector<Vec2>;

Polyline strokeLine(const Vec2& a, const Vec2& b) {
  Polyline p;
  const int n = static_cast<int>((b - a).norm() * 10.0);
  for (int i = 0; i <= n; ++i) p.push_back(a + (b - a) * (static_cast<double>(i) / n));
  return p;
}

Polyline strokeArc(const Vec2& centre, double radius, double from, double to) {
  Polyline p;
  const int n = static_cast<int>(std::abs(to - from) * radius * 10.0);
  for (int i = 0; i <= n; ++i) {
    const double t = from + (to - from) * i / n;
    p.push_back(centre + radius * Vec2(std::cos(t), std::sin(t)));
  }
  return p;
}

// Strokes inked over one another, scanned with noise 6.
InkPage page(const std::vector<Polyline>& strokes, bool closed, double width, int w, int h, unsigned seed = 5) {
  std::vector<std::vector<float>> inks;
  for (const Polyline& s : strokes) inks.push_back(test::strokeCoverage(s, closed, width, w, h));
  return test::scannedInks(inks, w, h, 6.0, seed);
}

std::vector<Contour> centrelinesOf(const InkPage& p, const EdgeParams& params = {}) {
  Result<ContourSet> set = centrelines(p.ink, p.grey, params, {});
  EXPECT_TRUE(set);
  std::vector<Contour> found = set ? set->contours : std::vector<Contour>{};
  std::sort(found.begin(), found.end(), [](const Contour& a, const Contour& b) { return a.lengthPx > b.lengthPx; });
  return found;
}

void expectSound(const Contour& c) {
  const std::size_t n = c.points.size();
  ASSERT_GE(n, 3u);
  EXPECT_EQ(c.kind, ContourKind::Centreline);
  EXPECT_EQ(strokeWidthsOf(c.points).size(), n);
  for (std::size_t i = 1; i < n; ++i) {
    const double step = (c.points[i].at - c.points[i - 1].at).norm();
    EXPECT_GT(step, 0.3) << "at " << i;
    EXPECT_LT(step, 2.0) << "at " << i;
    const Vec2 ahead =
        i + 1 < n ? Vec2(c.points[i + 1].at - c.points[i].at) : Vec2(c.points[i].at - c.points[i - 1].at);
    EXPECT_GT(ahead.dot(c.points[i].at - c.points[i - 1].at), 0.0) << "at " << i;
  }
}

struct Fit {
  double bias = 0.0, rms = 0.0, worst = 0.0, allWorst = 0.0, share = 0.0;
};

// Signed distance of the refined points from a dense polyline (left positive), by the nearest segment.
Fit fitTo(const Contour& c, const Polyline& truth, bool closed, double skipEnds = 0.0) {
  Fit f;
  int n = 0;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    double best = 1e9, sign = 1.0;
    const std::size_t count = truth.size();
    for (std::size_t k = 0; k < (closed ? count : count - 1); ++k) {
      const Vec2 a = truth[k], d = truth[(k + 1) % count] - a;
      if ((a - c.points[i].at).squaredNorm() > 100.0 || d.squaredNorm() <= 0.0) continue;
      const double t = std::clamp((c.points[i].at - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
      const Vec2 miss = c.points[i].at - a - t * d;
      if (miss.norm() < best) {
        best = miss.norm();
        sign = cross(d, miss) >= 0.0 ? 1.0 : -1.0;
      }
    }
    if (!closed && std::min((c.points[i].at - truth.front()).norm(), (c.points[i].at - truth.back()).norm()) < skipEnds)
      continue;
    f.allWorst = std::max(f.allWorst, best);
    if (!c.points[i].refined) continue;
    f.bias += sign * best;
    f.rms += best * best;
    f.worst = std::max(f.worst, best);
    ++n;
  }
  f.bias /= std::max(1, n);
  f.rms = std::sqrt(f.rms / std::max(1, n));
  f.share = static_cast<double>(n) / static_cast<double>(c.points.size());
  return f;
}

TEST(Skeleton, KeepsTheTopologyAndIsThin) {
  std::mt19937 random(3);
  BitImage ink(150, 90);
  for (int blob = 0; blob < 14; ++blob) {
    const double cx = 150.0 * (random() % 1000) / 1000.0, cy = 90.0 * (random() % 1000) / 1000.0, r = 3 + random() % 12;
    for (int y = 0; y < 90; ++y) {
      for (int x = 0; x < 150; ++x) {
        const double d = std::hypot(x - cx, y - cy);
        if (d < r && d > 0.4 * r) ink.set(x, y, true);
      }
    }
  }
  // Naive reference: the same rule pixel by pixel.
  BitImage naive = ink;
  const auto removable = [](const BitImage& im, int x, int y, bool odd) {
    const int dx[8] = {0, 1, 1, 1, 0, -1, -1, -1}, dy[8] = {-1, -1, 0, 1, 1, 1, 0, -1};
    bool p[10];
    for (int k = 0; k < 8; ++k) p[k] = im.at(x + dx[k], y + dy[k]);
    p[8] = p[0];
    p[9] = p[1];
    int branches = 0, a = 0, b = 0;
    for (int k = 0; k < 8; k += 2) {
      branches += !p[k] && (p[k + 1] || p[k + 2]);
      a += p[(k + 7) % 8] || p[k];
      b += p[k] || p[k + 1];
    }
    const bool side = odd ? (p[0] || p[1] || !p[3]) && p[2] : (p[4] || p[5] || !p[7]) && p[6];
    return branches == 1 && std::min(a, b) >= 2 && std::min(a, b) <= 3 && !side;
  };
  for (int quiet = 0, time = 1; quiet < 2; ++time) {
    BitImage next = naive;
    for (int y = 0; y < 90; ++y) {
      for (int x = 0; x < 150; ++x) {
        if (naive.at(x, y) && removable(naive, x, y, (time & 1) != 0)) next.set(x, y, false);
      }
    }
    quiet = next == naive ? quiet + 1 : 0;
    naive = next;
  }
  BitImage fast = ink;
  ASSERT_TRUE(thinToSkeleton(fast, {}));
  EXPECT_TRUE(fast == naive);
  EXPECT_LT(fast.count(), ink.count() / 2);
}

TEST(Skeleton, InkRadiusIsTheDistanceToPaper) {
  std::mt19937 random(9);
  BitImage ink(200, 70);
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 200; ++x) ink.set(x, y, random() % 60 != 0 || (x > 100 && x < 190));
  }
  for (int trial = 0; trial < 300; ++trial) {
    const int x = static_cast<int>(random() % 200), y = static_cast<int>(random() % 70);
    double best = 1e9;
    for (int yy = -1; yy <= 70; ++yy) {
      for (int xx = -1; xx <= 200; ++xx) {
        if (!ink.at(xx, yy)) best = std::min(best, std::hypot(xx - x, yy - y));
      }
    }
    EXPECT_NEAR(inkRadius(ink, x, y), best, 1e-9) << x << " " << y;
  }
}

TEST(Centreline, StrokesOfAllShapesAreOneLineOnTheirMiddle) {
  for (const test::TruthShape& shape : test::truthShapes(900, 600)) {
    const Polyline truth = shape.outline();
    const bool closed = shape.closed;
    const auto found = centrelinesOf(page({truth}, closed, 5.0, 900, 600));
    ASSERT_EQ(found.size(), 1u) << shape.name;
    EXPECT_EQ(found[0].closed, closed) << shape.name;
    expectSound(found[0]);
    const Fit f = fitTo(found[0], truth, closed);
    printf("%-10s bias %+.4f rms %.4f worst %.3f all %.3f refined %.3f\n", shape.name.c_str(), f.bias, f.rms, f.worst,
           f.allWorst, f.share);
    EXPECT_LE(std::abs(f.bias), 0.02) << shape.name;
    EXPECT_LE(f.rms, shape.corners.empty() ? 0.04 : 0.08) << shape.name;
    EXPECT_GE(f.share, 0.9) << shape.name;
    EXPECT_NEAR(found[0].points[found[0].points.size() / 2].widthPx.value(), 5.0f, 0.4f) << shape.name;
  }
}

TEST(Centreline, OpenEndsLieWhereThePenStopped) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Polyline truth = strokeArc({200, 220}, 150.0, -2.6, -0.4);
    const auto found = centrelinesOf(page({truth}, false, 5.0, 400, 300, seed));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_FALSE(found[0].closed);
    const double forward = std::max((found[0].points.front().at - truth.front()).norm(),
                                    (found[0].points.back().at - truth.back()).norm());
    const double backward = std::max((found[0].points.front().at - truth.back()).norm(),
                                     (found[0].points.back().at - truth.front()).norm());
    EXPECT_LE(std::min(forward, backward), 0.6);
  }
}

TEST(Centreline, CrossingStrokesGoStraightThrough) {
  for (const double angle : {90.0, 60.0, 35.0, 20.0}) {
    const double t = angle * std::numbers::pi / 180.0;
    const Vec2 d = 130.0 * Vec2(std::cos(t), std::sin(t)), c(200.3, 200.7);
    const std::vector<Polyline> strokes{strokeLine(c - Vec2(150, 0), c + Vec2(150, 0)), strokeLine(c - d, c + d)};
    const auto found = centrelinesOf(page(strokes, false, 5.0, 400, 400));
    ASSERT_EQ(found.size(), 2u) << angle;
    for (int k = 0; k < 2; ++k) {
      expectSound(found[k]);
      const Fit f = fitTo(found[k], strokes[k], false, 4.0);
      printf("crossing %.0f: rms %.4f worst %.3f all %.3f\n", angle, f.rms, f.worst, f.allWorst);
      EXPECT_LE(f.rms, 0.06) << angle;
      EXPECT_LE(f.allWorst, 0.5) << angle;
    }
  }
}

TEST(Centreline, ATeeIsTwoLinesThatTouch) {
  const std::vector<Polyline> strokes{strokeLine({40, 100.4}, {360, 100.4}), strokeLine({200.6, 100.4}, {200.6, 280})};
  const auto found = centrelinesOf(page(strokes, false, 5.0, 400, 320));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_LE(fitTo(found[0], strokes[0], false).allWorst, 0.3);
  EXPECT_LE(fitTo(found[1], strokes[1], false).allWorst, 0.5);
  const Contour& stem = found[1];
  const double top = std::min(stem.points.front().at.y(), stem.points.back().at.y());
  EXPECT_NEAR(top, 100.4, 2.5);
}

TEST(Centreline, AnAcuteCornerKeepsTheRing) {
  const std::vector<Vec2> corners{{60, 200}, {340, 160}, {340, 240}};  // 16 degrees at the left
  Polyline outline;
  for (std::size_t i = 0; i < 3; ++i) {
    const Polyline side = strokeLine(corners[i], corners[(i + 1) % 3]);
    outline.insert(outline.end(), side.begin(), side.end() - 1);
  }
  const auto found = centrelinesOf(page({outline}, true, 5.0, 400, 400));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].closed);
}

// Between two lugs that sit on a line there is that line alone, however the lugs lean: it is not two strokes in one.
TEST(Centreline, ALineWithLugsStaysOnItsInk) {
  const auto ring = [](double x, double y) {
    return Polyline{{x, y}, {x - 12.0, y}, {x - 12.0, y + 12.0}, {x + 3.4, y + 12.0}};
  };
  Polyline whole;
  for (int y = 40; y <= 360; ++y) whole.push_back({200.0 + 0.002 * (y - 40.0) * (y - 120.0), static_cast<double>(y)});
  const auto x = [](double y) { return 200.0 + 0.002 * (y - 40.0) * (y - 120.0); };
  const auto found = centrelinesOf(page({whole, ring(x(125), 125), ring(x(190), 190)}, false, 4.0, 460, 400));
  ASSERT_FALSE(found.empty());
  EXPECT_LE(fitTo(found[0], whole, false).allWorst, 1.0);
  EXPECT_GT(found[0].lengthPx, 330.0);
}

TEST(Centreline, GapsAreBridgedAndSaid) {
  const Polyline whole = strokeLine({40, 80.2}, {360, 90.2});
  Polyline left, right;
  for (const Vec2& p : whole) {
    if (p.x() < 190.0) left.push_back(p);
    if (p.x() > 207.0) right.push_back(p);
  }
  const InkPage p = page({left, right}, false, 5.0, 400, 160);
  const auto joined = centrelinesOf(p);
  ASSERT_EQ(joined.size(), 1u);
  ASSERT_EQ(joined[0].bridges.size(), 1u);
  const auto [first, last] = joined[0].bridges[0];
  EXPECT_LE(first, last);
  for (int i = first; i <= last; ++i) {
    EXPECT_EQ(joined[0].points[i].refined, 0);
    EXPECT_NEAR(joined[0].points[i].at.x(), 198.5, 14.0);
  }
  EXPECT_LE(fitTo(joined[0], whole, false).allWorst, 0.5);
  EdgeParams none;
  none.gapFactor = 0.0;
  EXPECT_EQ(centrelinesOf(p, none).size(), 2u);
}

TEST(Centreline, OverdrawnStrokesMergeOnlyWhenAsked) {
  std::vector<Polyline> strokes;
  for (const double y : {97.0, 104.0, 110.0}) strokes.push_back(strokeLine({40, y}, {360, y}));
  const InkPage p = page(strokes, false, 3.0, 400, 200);
  EXPECT_EQ(centrelinesOf(p).size(), 3u);
  EdgeParams merge;
  merge.mergeWidths = 4.0;
  const auto found = centrelinesOf(p, merge);
  ASSERT_EQ(found.size(), 1u);
  for (const Vec2& q : positionsOf(found[0].points)) {
    if (q.x() > 60 && q.x() < 340) {
      EXPECT_NEAR(q.y(), 103.67, 0.4);
    }
  }
  // The strokes' middles are 13 px apart.
  for (std::size_t i = 0; i < found[0].points.size(); ++i) {
    if (found[0].points[i].at.x() > 60 && found[0].points[i].at.x() < 340) {
      // Borders are ragged by half a pixel.
      EXPECT_NEAR(0.5f * (found[0].points[i].bundle.value().left + found[0].points[i].bundle.value().right), 6.5f,
                  0.9f);
    }
  }
  for (const Contour& alone : centrelinesOf(p)) EXPECT_FALSE(alone.points.front().bundle);
}

TEST(Centreline, SameResultWithAnyNumberOfThreads) {
  const InkPage p =
      page({strokeArc({200, 200}, 120, 0.0, 5.0), strokeLine({20, 60}, {380, 350})}, false, 5.0, 400, 400);
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  const auto a = centrelines(p.ink, p.grey, {}, one), b = centrelines(p.ink, p.grey, {}, four);
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->contours.size(), b->contours.size());
  for (std::size_t i = 0; i < a->contours.size(); ++i) {
    ASSERT_EQ(a->contours[i].points.size(), b->contours[i].points.size());
    for (std::size_t k = 0; k < a->contours[i].points.size(); ++k) {
      EXPECT_EQ(a->contours[i].points[k].at, b->contours[i].points[k].at);
    }
  }
}

TEST(Centreline, CancelIsObeyed) {
  const InkPage p = page({strokeLine({20, 60}, {380, 350})}, false, 5.0, 400, 400);
  RunContext context;
  context.cancel.cancel();
  const auto set = centrelines(p.ink, p.grey, {}, context);
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().code, ErrorCode::Cancelled);
}

TEST(SplitStrokes, ThinIsAStrokeAndFatIsAShape) {
  BitImage ink(600, 400);
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 600; ++x) {
      const bool disc = std::hypot(x - 150.0, y - 200.0) < 60.0;
      const bool bar = y > 190 && y < 196 && x > 300 && x < 580;
      ink.set(x, y, disc || bar);
    }
  }
  const auto split = splitStrokes(ink, {});
  ASSERT_TRUE(split);
  EXPECT_TRUE(split->shapes.at(150, 200));
  EXPECT_FALSE(split->strokes.at(150, 200));
  EXPECT_TRUE(split->strokes.at(400, 193));
  EXPECT_EQ(split->strokes.count() + split->shapes.count(), ink.count());
}

}  // namespace
}  // namespace batten
