// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_pixels.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <vector>

#include "core/base/statistics.h"
#include "core/contour/subpixel/pixel_edge.h"
#include "core/solve/gauss_legendre.h"

namespace batten {
namespace {

using Sides = Eigen::Matrix<double, 8, 1>;  // what to add to both sides: value and derivatives 1 to 3 at `from`
using SidesSpread = Eigen::Matrix<double, 8, 8>;

constexpr double kNearSigmas = 3.5;        // of blur: an edge farther away says nothing
constexpr double kSeenPx = 1.2;            // the points of a side have seen the pixels this far before the first block
constexpr double kBeyondSidesPx = 2.0;     // beyond where both sides begin, whose first points have seen these
constexpr double kTonesPx = 12.0;          // beyond the wedge, where the tones are taken
constexpr double kFarthestWedgePx = 40.0;  // of pixels from the corner
constexpr int kFewestTones = 12, kFewestPixels = 12;  // for a median of either tone; for the eight unknowns
constexpr double kLeastCornerContrast = 4.0;          // [grey]
constexpr double kWedgeError = 0.015;      // [contrast] what the model leaves: pixels taken for round spots, bends
constexpr double kSpotError = 0.05;        // [contrast] and more where there is no blur to hide that
constexpr double kMostCorrelation = 0.99;  // as far as bothBelow() is good
constexpr int kCornerRounds = 4;           // each linear about the sides of the one before
constexpr double kMostSurprise = 2.0;      // mean square of what is left, in units of the noise

double below(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// One side seen from a pixel.
struct SideView {
  double x = 0.0, distance = 0.0;                 // [px] along its axis; into the ink
  Eigen::Vector4d row = Eigen::Vector4d::Zero();  // of the distance with respect to the side's own values
};

class Wedge {
 public:
  Wedge(const CornerSide& before, const CornerSide& after, double blurPx)
      : sides_{&before, &after}, blur_(std::sqrt(blurPx * blurPx + kPixelVariance)) {
    const Vec2 in = -before.derivative(0.0).normalized(), out = after.derivative(0.0).normalized();
    correlation_ = std::clamp(in.dot(out), -kMostCorrelation, kMostCorrelation);  // of the normals
    ink_ = cross(in, out) > 0.0;
  }

  double blur() const { return blur_; }
  double from(int i) const { return sides_[i]->from; }

  SideView view(int i, const Vec2& p, const Sides& change) const {
    const CornerSide& side = *sides_[i];
    const double sign = i == 0 ? -1.0 : 1.0;
    const Vec2 d = p - side.origin;
    SideView v;
    v.x = d.dot(side.along);
    const double h = v.x - side.from;
    const Eigen::Vector4d powers(1.0, h, h * h / 2.0, h * h * h / 6.0);
    const Vec2 slope = side.derivative(v.x);
    const double steep = slope.dot(side.across), length = std::sqrt(1.0 + steep * steep);
    const double height = (side.at(v.x) - side.origin).dot(side.across) + powers.dot(change.segment<4>(4 * i));
    v.distance = sign * (d.dot(side.across) - height) / length;
    v.row = -sign / length * powers;
    return v;
  }

  /// Part of the light that falls on ink, and its slopes with respect to the two distances.
  struct InkPart {
    double part = 0.0, slopeFirst = 0.0, slopeSecond = 0.0;
  };
  InkPart part(double first, double second) const {
    const double sign = ink_ ? 1.0 : -1.0;
    const double a = sign * first / blur_, b = sign * second / blur_;
    const double rest = std::sqrt(1.0 - correlation_ * correlation_);
    const double density = std::sqrt(0.5 / std::numbers::pi) / blur_;
    const double both = bothBelow(a, b, correlation_);
    return {ink_ ? both : 1.0 - both, density * std::exp(-0.5 * a * a) * below((b - correlation_ * a) / rest),
            density * std::exp(-0.5 * b * b) * below((a - correlation_ * b) / rest)};
  }

  enum class Tone { Ink, Paper, Edge };
  /// Deep in the ink, far out on the paper, or near an edge.
  Tone tone(double first, double second) const {
    const double inside = ink_ ? std::min(first, second) : std::max(first, second);
    return inside > kNearSigmas * blur_ ? Tone::Ink : inside < -kNearSigmas * blur_ ? Tone::Paper : Tone::Edge;
  }

 private:
  const CornerSide* sides_[2];
  double blur_, correlation_ = 0.0;
  bool ink_ = true;  // the wedge below 180 degrees is ink
};

struct WedgePixel {
  Vec2 at;
  double grey;
};

struct CornerScene {
  std::vector<WedgePixel> pixels;
  double paper = 255.0, contrast = 0.0, variance = 1.0;  // [grey], [grey^2]
};

/// The pixels that show the corner, the tones beside it and their noise. Nothing when they do not tell.
std::optional<CornerScene> readScene(const GreyImage& grey, const Vec2& corner, const Wedge& wedge) {
  const double radius = std::min(kFarthestWedgePx, std::max(wedge.from(0), wedge.from(1)) + kBeyondSidesPx);
  const double reach = radius + kTonesPx;
  const int left = std::max(0, static_cast<int>(corner.x() - reach)),
            right = std::min(grey.width - 1, static_cast<int>(corner.x() + reach));
  const int top = std::max(0, static_cast<int>(corner.y() - reach)),
            bottom = std::min(grey.height - 1, static_cast<int>(corner.y() + reach));
  CornerScene scene;
  std::vector<double> paper, ink;
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const Vec2 p(x + 0.5, y + 0.5);
      const double away = (p - corner).norm();
      if (away > reach) continue;
      const SideView a = wedge.view(0, p, Sides::Zero()), b = wedge.view(1, p, Sides::Zero());
      const Wedge::Tone tone = wedge.tone(a.distance, b.distance);
      if (tone != Wedge::Tone::Edge) (tone == Wedge::Tone::Ink ? ink : paper).push_back(grey.level(x, y));
      const double far = kNearSigmas * wedge.blur();
      const bool nearA = std::abs(a.distance) < far, nearB = std::abs(b.distance) < far;
      if (tone != Wedge::Tone::Edge || away > radius || (nearA && a.x > wedge.from(0) - kSeenPx) ||
          (nearB && b.x > wedge.from(1) - kSeenPx))
        continue;
      scene.pixels.push_back({p, grey.level(x, y)});
    }
  }
  if (std::ssize(scene.pixels) < kFewestPixels || std::min(std::ssize(paper), std::ssize(ink)) < kFewestTones) {
    return std::nullopt;
  }
  scene.paper = upperMedian(paper);
  const double inkLevel = upperMedian(ink);
  scene.contrast = scene.paper - inkLevel;
  std::vector<double> off;
  off.reserve(paper.size() + ink.size());
  for (const double g : paper) off.push_back(std::abs(g - scene.paper));
  for (const double g : ink) off.push_back(std::abs(g - inkLevel));
  const double noise = robustSigma(off);
  const double error = scene.contrast * (kWedgeError + kSpotError * kPixelVariance / (wedge.blur() * wedge.blur()));
  scene.variance = noise * noise + error * error;
  if (!(scene.contrast > std::max(kLeastCornerContrast, noise))) return std::nullopt;
  return scene;
}

SidesSpread knownBefore(const CornerSide& before, const CornerSide& after) {
  SidesSpread p = SidesSpread::Zero();
  p.topLeftCorner<4, 4>() = Eigen::Map<const Eigen::Matrix4d>(before.spread.data());
  p.bottomRightCorner<4, 4>() = Eigen::Map<const Eigen::Matrix4d>(after.spread.data());
  return p;
}

/// Adds a cubic in x - from, by its derivatives there.
void addCubic(CornerSide& side, const Eigen::Vector4d& d) {
  const double half = 0.5 * (side.to - side.from);
  const double w[4] = {d[0], d[1] * half, d[2] / 2.0 * half * half, d[3] / 6.0 * half * half * half};
  const double add[4] = {w[0] + w[1] + w[2] + w[3], w[1] + 2.0 * w[2] + 3.0 * w[3], w[2] + 3.0 * w[3], w[3]};
  for (int k = 0; k < 4; ++k) side.coefficient[k] += add[k];
}

}  // namespace

double bothBelow(double h, double k, double correlation) {
  // Ten points on either half of the way from no correlation.
  static constexpr auto kRule = gaussLegendre<10>();
  const double end = std::asin(correlation);
  double sum = 0.0;
  for (const double middle : {0.25, 0.75}) {
    for (int i = 0; i < std::ssize(kRule.node); ++i) {
      const double s = std::sin(end * (middle + 0.25 * kRule.node[i])), c2 = 1.0 - s * s;
      sum += kRule.weight[i] * std::exp(-0.5 * (h * h + k * k - 2.0 * h * k * s) / c2);
    }
  }
  return std::clamp(below(h) * below(k) + 0.25 * end * sum / (2.0 * std::numbers::pi), 0.0, 1.0);
}

std::optional<CornerSides> fitCornerToPixels(const GreyImage& grey, const Vec2& corner, double blurPx,
                                             CornerSides sides) {
  const Wedge wedge(sides.before, sides.after, blurPx);
  const std::optional<CornerScene> scene = readScene(grey, corner, wedge);
  if (!scene) return std::nullopt;
  const SidesSpread known = knownBefore(sides.before, sides.after);
  Sides change = Sides::Zero();
  for (int round = 0; round < kCornerRounds; ++round) {
    Sides state = Sides::Zero();
    SidesSpread spread = known;
    double surprise = 0.0;
    for (const WedgePixel& pixel : scene->pixels) {
      const SideView a = wedge.view(0, pixel.at, change), b = wedge.view(1, pixel.at, change);
      const Wedge::InkPart ink = wedge.part(a.distance, b.distance);
      const double left = pixel.grey - (scene->paper - scene->contrast * ink.part);
      surprise += left * left;
      Sides row;
      row << -scene->contrast * ink.slopeFirst * a.row, -scene->contrast * ink.slopeSecond * b.row;
      const Sides gain = spread * row / (row.dot(spread * row) + scene->variance);
      state += gain * (left - row.dot(state - change));
      spread -= gain * (row.transpose() * spread);
    }
    const bool described = surprise < kMostSurprise * scene->variance * static_cast<double>(scene->pixels.size());
    if (!state.allFinite() || (round + 1 == kCornerRounds && !described)) return std::nullopt;
    change = state;
  }
  addCubic(sides.before, change.head<4>());
  addCubic(sides.after, change.tail<4>());
  return sides;
}

}  // namespace batten
