// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/dense_page.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "tests/support/angles.h"
#include "tests/support/ink_page.h"
#include "tests/support/render_page.h"

namespace batten::test {
namespace {

constexpr double kGrainPx = 1.0;  // [px] Gaussian that gives the white noise its size

std::vector<float> unitGrain(int width, int height, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  const std::ptrdiff_t w = width;
  std::vector<float> grain(w * height), rows(grain.size());
  for (float& g : grain) g = normal(random);
  std::vector<float> kernel;
  double squares = 0.0;
  for (int k = -4; k <= 4; ++k) kernel.push_back(static_cast<float>(std::exp(-0.5 * k * k / (kGrainPx * kGrainPx))));
  for (const float k : kernel) squares += static_cast<double>(k) * static_cast<double>(k);
  const auto scale = static_cast<float>(1.0 / squares);  // of both directions together
  const auto pass = [&](const std::vector<float>& from, std::vector<float>& to, int dx, int dy) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        float sum = 0.0f;
        for (int k = -4; k <= 4; ++k) {
          const int xx = (x + k * dx + width) % width, yy = (y + k * dy + height) % height;
          sum += kernel[k + 4] * from[yy * w + xx];
        }
        to[y * w + x] = sum;
      }
    }
  };
  pass(grain, rows, 1, 0);
  pass(rows, grain, 0, 1);
  for (float& g : grain) g *= scale;
  return grain;
}

struct Near {
  int line = -1;
  std::size_t point = 0;
  double distance = 0.0;
};

Vec2 directionAt(const std::vector<Vec2>& line, std::size_t i) {
  const std::size_t a = i > 2 ? i - 2 : 0, b = std::min(line.size() - 1, i + 2);
  const Vec2 d = line[b] - line[a];
  return d.norm() > 0.0 ? Vec2(d / d.norm()) : Vec2::Zero();
}

double distanceToSegment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double t = std::clamp((p - a).dot(d) / std::max(1e-12, d.squaredNorm()), 0.0, 1.0);
  return (p - a - t * d).norm();
}

Near nearestLine(const std::vector<std::vector<Vec2>>& truth, const Vec2& p, const Vec2& direction, double tolerance) {
  Near best;
  best.distance = tolerance;
  const double reach = (tolerance + 2.0) * (tolerance + 2.0);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (std::size_t k = 0; k + 1 < truth[i].size(); ++k) {
      if ((truth[i][k] - p).squaredNorm() > reach) continue;
      const double d = distanceToSegment(p, truth[i][k], truth[i][k + 1]);
      if (d >= best.distance || std::abs(directionAt(truth[i], k).dot(direction)) < std::cos(30.0 * kDeg)) continue;
      best = {static_cast<int>(i), k, d};
    }
  }
  return best;
}

// Changes from one line to another that both hold for a while.
int bridgesOf(const std::vector<int>& lineOf) {
  constexpr int kLeast = 5;
  int settled = -1, candidate = -1, run = 0, bridges = 0;
  for (const int line : lineOf) {
    if (line < 0) continue;
    run = line == candidate ? run + 1 : 1;
    candidate = line;
    if (run < kLeast || candidate == settled) continue;
    if (settled >= 0) ++bridges;
    settled = candidate;
  }
  return bridges;
}

}  // namespace

std::vector<std::vector<Vec2>> hatchLines(const Vec2& middle, double angleDeg, int count, double spacingPx,
                                          double lengthPx, double bendRadiusPx) {
  const Vec2 along(std::cos(angleDeg * kDeg), std::sin(angleDeg * kDeg)), across(-along.y(), along.x());
  std::vector<std::vector<Vec2>> lines;
  const int steps = static_cast<int>(lengthPx);
  for (int k = 0; k < count; ++k) {
    const double off = (k - 0.5 * (count - 1)) * spacingPx;
    std::vector<Vec2> line;
    for (int i = 0; i <= steps; ++i) {
      const double s = lengthPx * (static_cast<double>(i) / steps - 0.5);
      if (bendRadiusPx > 0.0) {
        const double a = s / bendRadiusPx, r = bendRadiusPx + off;
        line.push_back(middle + r * std::sin(a) * along + (r * std::cos(a) - bendRadiusPx) * across);
      } else {
        line.push_back(middle + s * along + off * across);
      }
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<float> coverageOf(const std::vector<std::vector<Vec2>>& lines, double widthPx, int width, int height) {
  std::vector<float> cover(std::ptrdiff_t{width} * height, 0.0f);
  for (const auto& line : lines) inkOver(cover, strokeCoverage(line, false, widthPx, width, height));
  return cover;
}

void grainCoverage(std::vector<float>& coverage, int width, int height,
                   const std::function<double(double x, double y)>& share, std::uint32_t seed) {
  const std::vector<float> grain = unitGrain(width, height, seed);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::ptrdiff_t i = std::ptrdiff_t{y} * width + x;
      const double part = share(x + 0.5, y + 0.5), factor = 0.75 + 0.45 * static_cast<double>(grain[i]);
      coverage[i] *= static_cast<float>(std::clamp(std::lerp(1.0, factor, part), 0.0, 1.0));
    }
  }
}

Scan scanOfLines(std::vector<float> coverage, int width, int height, std::uint32_t seed) {
  PageStyle style;
  style.paperLeft = style.paperRight = 235.0;
  style.contrast = 205.0;
  style.blurPx = 0.8;
  style.noise = 6.0;
  style.seed = seed;
  return renderPage(std::move(coverage), width, height, style);
}

DenseScore scoreDense(const std::vector<std::vector<Vec2>>& truth, const std::vector<std::vector<Vec2>>& found,
                      double tolerancePx, double endsPx) {
  DenseScore score;
  score.drawn = static_cast<int>(truth.size());
  // Per point of a true line the found lines that pass there.
  std::vector<std::vector<std::vector<int>>> passing(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) passing[i].resize(truth[i].size());
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < found.size(); ++f) {
    std::vector<int> lineOf;
    for (std::size_t k = 0; k < found[f].size(); ++k) {
      const Near n = nearestLine(truth, found[f][k], directionAt(found[f], k), tolerancePx);
      lineOf.push_back(n.line);
      if (n.line < 0) continue;
      auto& points = passing[n.line];
      for (std::size_t p = n.point > 1 ? n.point - 1 : 0; p < std::min(points.size(), n.point + 3); ++p)
        if (points[p].empty() || points[p].back() != static_cast<int>(f)) points[p].push_back(static_cast<int>(f));
      squares += n.distance * n.distance;
      ++count;
    }
    score.bridges += bridgesOf(lineOf);
  }
  for (const auto& points : passing) {
    const std::size_t skip = static_cast<int>(endsPx);
    std::size_t judged = 0, covered = 0;
    std::map<int, std::size_t> by;
    for (std::size_t p = skip; p + skip < points.size(); ++p) {
      ++judged;
      covered += points[p].empty() ? 0 : 1;
      for (const int f : points[p]) ++by[f];
    }
    std::size_t most = 0;
    for (const auto& [f, n] : by) most = std::max(most, n);
    if (static_cast<double>(most) >= 0.95 * static_cast<double>(judged)) {
      ++score.whole;
    } else if (2 * covered >= judged) {
      ++score.inPieces;
    }
  }
  score.rmsPx = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
  return score;
}

}  // namespace batten::test
