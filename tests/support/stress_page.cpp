// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/stress_page.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>

#include "tests/support/angles.h"
#include "tests/support/truth_shapes.h"

namespace batten::test {
namespace {

constexpr double kNearPx = 3.0, kFoundPx = 2.0, kMarginPx = 6.0;

std::vector<Vec2> blob(double cx, double cy, double rx, double ry, double tiltDeg, double wobble = 0.0) {
  std::vector<Vec2> points;
  const int n = static_cast<int>(3.0 * kPi * std::max(rx, ry));
  const double c = std::cos(tiltDeg * kDeg), s = std::sin(tiltDeg * kDeg);
  for (int i = 0; i <= n; ++i) {
    const double t = 2.0 * kPi * i / n, r = 1.0 + wobble * std::cos(3.0 * t);
    const double x = rx * r * std::cos(t), y = ry * r * std::sin(t);
    points.emplace_back(cx + c * x - s * y, cy + s * x + c * y);
  }
  return points;
}

StressScene filled(std::string name, std::vector<std::vector<Vec2>> lines, int width, int height) {
  StressScene scene{std::move(name), {}, std::move(lines)};
  scene.coverage.assign(std::ptrdiff_t{width} * height, 0.0f);
  for (const auto& line : scene.lines) {
    const std::vector<float> one = fillCoverage(line, width, height);
    // Even-odd: a shape inside another is a hole, one inside that an island.
    for (std::size_t i = 0; i < one.size(); ++i) scene.coverage[i] = std::fabs(scene.coverage[i] - one[i]);
  }
  return scene;
}

StressScene drawn(std::string name, std::vector<std::vector<Vec2>> lines, double pen, int width, int height) {
  StressScene scene{std::move(name), {}, std::move(lines)};
  scene.coverage.assign(std::ptrdiff_t{width} * height, 0.0f);
  for (const auto& line : scene.lines) {
    const std::vector<float> one = strokeCoverage(line, false, pen, width, height);
    for (std::size_t i = 0; i < one.size(); ++i) scene.coverage[i] = std::max(scene.coverage[i], one[i]);
  }
  return scene;
}

/// Closest squared distance to a set of points, by a grid of cells.
class NearestPoint {
 public:
  NearestPoint(const std::vector<std::vector<Vec2>>& lines, int width, int height)
      : columns_(width / kCell + 3), rows_(height / kCell + 3) {
    cells_.resize(std::ptrdiff_t{columns_} * rows_);
    for (const auto& line : lines)
      for (std::size_t i = 0; i + 1 < line.size(); ++i) at(line[i])->push_back({line[i], line[i + 1]});
  }
  double distance(const Vec2& p) {
    double best = std::numeric_limits<double>::infinity();
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const auto* cell = at(p + Vec2(dx * kCell, dy * kCell));
        for (const auto& [a, b] : *cell) {
          const Vec2 d = b - a;
          const double t = std::clamp((p - a).dot(d) / std::max(1e-12, d.squaredNorm()), 0.0, 1.0);
          best = std::min(best, (p - a - t * d).norm());
        }
      }
    }
    return best;
  }

 private:
  static constexpr int kCell = 8;
  std::vector<std::pair<Vec2, Vec2>>* at(const Vec2& p) {
    const int x = std::clamp(static_cast<int>(std::floor(p.x() / kCell)) + 1, 0, columns_ - 1);
    const int y = std::clamp(static_cast<int>(std::floor(p.y() / kCell)) + 1, 0, rows_ - 1);
    return &cells_[y * columns_ + x];
  }
  int columns_, rows_;
  std::vector<std::vector<std::pair<Vec2, Vec2>>> cells_;
};

}  // namespace

std::vector<StressScene> stressScenes(int width, int height) {
  const double w = width, h = height;
  std::vector<StressScene> scenes;
  scenes.push_back(filled("ellipse", {blob(0.5 * w, 0.5 * h, 0.469 * w, 0.4 * h, 4)}, width, height));
  scenes.push_back(filled("cut", {blob(0.95 * w, 0.55 * h, 0.35 * w, 0.33 * h, 10)}, width, height));
  scenes.push_back(filled("ring",
                          {blob(0.5 * w, 0.5 * h, 0.38 * h, 0.38 * h, 0), blob(0.5 * w, 0.5 * h, 0.27 * h, 0.27 * h, 0),
                           blob(0.52 * w, 0.48 * h, 0.1 * h, 0.12 * h, 20)},
                          width, height));
  scenes.push_back(
      filled("three",
             {blob(0.23 * w, 0.3 * h, 0.15 * w, 0.16 * h, 15, 0.1), blob(0.62 * w, 0.62 * h, 0.2 * w, 0.22 * h, -20),
              blob(0.8 * w, 0.2 * h, 0.1 * w, 0.1 * h, 0)},
             width, height));
  std::vector<Vec2> s;
  for (int i = 0; i <= 1600; ++i) {
    const double f = i / 1600.0;
    s.emplace_back((0.08 + 0.84 * f) * w, (0.5 + 0.3 * std::sin(2.0 * kPi * f)) * h);
  }
  scenes.push_back(drawn("S stroke", {s}, 5.0, width, height));
  std::vector<Vec2> k = truthShape("K", width, height).outline();
  k.push_back(k.front());
  scenes.push_back(drawn("K strokes", {k}, 4.0, width, height));
  return scenes;
}

double stepAcross(double x, double y, double x0, double y0, double normalDeg, double soft) {
  const double d = (x - x0) * std::cos(normalDeg * kDeg) + (y - y0) * std::sin(normalDeg * kDeg);
  return 0.5 * std::erfc(-d / (std::sqrt(2.0) * std::max(soft, 1e-3)));
}

std::vector<StressPaper> stressPapers(int width, int height) {
  const double w = width, h = height;
  const auto vignette = [=](double x, double y) {
    return 235.0 - 120.0 * (std::pow(x / w - 0.5, 2) + std::pow(y / h - 0.5, 2));
  };
  const auto base = [=](double x, double) { return 225.0 - 25.0 * x / w; };
  return {
      {"linear", [=](double x, double) { return 255.0 - 115.0 * x / w; }},
      {"vignette", vignette},
      {"spot",
       [=](double x, double y) {
         return 120.0 + 110.0 * std::exp(-0.5 * (std::pow((x - 0.4 * w) / (0.3 * w), 2) +
                                                 std::pow((y - 0.4 * h) / (0.35 * h), 2)));
       }},
      {"exponential", [=](double x, double) { return 60.0 + 170.0 * std::exp(-3.0 * x / w); }},
      {"ripple", [=](double x, double y) { return 190.0 + 0.4 * 50.0 * std::sin((x + 0.5 * y) / 50.0 / 1.118); }},
      {"ripple2", [=](double x, double y) { return 190.0 + 0.8 * 40.0 * std::sin((x + 0.5 * y) / 40.0 / 1.118); }},
      {"fold", [=](double x, double y) { return base(x, y) - 59.0 * stepAcross(x, y, 0.55 * w, 0.5 * h, 12.0, 0.9); }},
      {"fold, crease",
       [=](double x, double y) {
         const double d = (x - 0.5 * w) * std::cos(80.0 * kDeg) + (y - 0.45 * h) * std::sin(80.0 * kDeg);
         return base(x, y) - 30.0 * stepAcross(x, y, 0.5 * w, 0.45 * h, 80.0, 1.2) -
                35.0 * std::exp(-0.5 * d * d / 4.0);
       }},
      {"shadow",
       [=](double x, double y) { return base(x, y) - 59.0 * stepAcross(x, y, 0.45 * w, 0.5 * h, -25.0, 5.0); }},
      {"two folds",
       [=](double x, double y) {
         return base(x, y) - 40.0 * stepAcross(x, y, 0.52 * w, 0.5 * h, 1.0, 0.9) -
                25.0 * stepAcross(x, y, 0.5 * w, 0.53 * h, 91.0, 0.9);
       }},
      {"bent fold",
       [=](double x, double y) {
         const double bend = 6.0 * std::sin(kPi * y / h);
         return base(x, y) - 45.0 * stepAcross(x + bend, y, 0.6 * w, 0.5 * h, 5.0, 1.0);
       }},
  };
}

Scan renderStress(std::vector<float> coverage, int width, int height, const PaperOf& paper, const StressInk& ink,
                  std::uint32_t seed) {
  PageStyle blurOnly;
  blurOnly.paperLeft = blurOnly.paperRight = 255.0;
  blurOnly.contrast = 255.0;
  blurOnly.blurPx = ink.blurPx;
  Scan scan = renderPage(std::move(coverage), width, height, blurOnly);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double share = 1.0 - scan.grey.level(x, y) / 255.0;
      const double value = paper(x + 0.5, y + 0.5) - ink.contrast * share + ink.noise * normal(random);
      scan.grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(std::round(value), 0.0, 255.0)) * 257);
    }
  }
  scan.fileHash = sha256(std::as_bytes(std::span(scan.grey.pixels)));
  return scan;
}

LineScore scoreLines(const std::vector<std::vector<Vec2>>& truth, const std::vector<std::vector<Vec2>>& found,
                     int width, int height) {
  const auto judged = [&](const Vec2& p) {
    return p.x() > kMarginPx && p.y() > kMarginPx && p.x() < width - kMarginPx && p.y() < height - kMarginPx;
  };
  NearestPoint toTruth(truth, width, height), toFound(found, width, height);
  LineScore score;
  double sum = 0.0;
  std::size_t seen = 0, covered = 0, near = 0;
  for (const auto& line : truth) {
    for (const Vec2& p : line) {
      if (!judged(p)) continue;
      ++seen;
      if (toFound.distance(p) <= kFoundPx) ++covered;
    }
  }
  for (const auto& line : found) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      if (!judged(line[i])) continue;
      const double distance = toTruth.distance(line[i]);
      if (distance > kNearPx) {
        score.falsePx += (line[i + 1] - line[i]).norm();
      } else {
        sum += distance * distance;
        ++near;
      }
    }
  }
  score.covered = seen > 0 ? static_cast<double>(covered) / static_cast<double>(seen) : 1.0;
  score.rmsPx = near > 0 ? std::sqrt(sum / static_cast<double>(near)) : 0.0;
  return score;
}

}  // namespace batten::test
