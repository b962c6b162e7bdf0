// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/margin_lines.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/statistics.h"
#include "core/solve/small_least_squares.h"

namespace batten {
namespace {

constexpr double kFarthestMargin = 0.3;    // of the plane, from its side
constexpr double kMostBend = 0.02;         // of its length: a ruled line on paper that curls
constexpr double kLeastSeenAlong = 0.85;   // of the steps along it
constexpr double kMostMarginMisfit = 2.5;  // [grid] of nine in ten places, off a cubic: paper bends, pens tremble
constexpr int kMarginStep = 4;             // [grid] along the line
constexpr int kLookFor = 3;                // [grid] to either side of where it is expected
constexpr int kPaperBeside = 7;            // [grid] to either side: paper shows within
constexpr float kLeastOfDepth = 0.4f;      // of the line's own depth, where it is seen
constexpr float kMostOfDepth = 2.5f;       // likewise: darker places are strokes over it
constexpr int kMemory = 60;                // steps that say where it goes on
constexpr double kLeastSeenAtEnd = 0.5;    // of the steps beyond the first and the last ruled line

/// Where a margin must be seen.
struct AlongLine {
  double from = 0.0, to = 0.0;  ///< [grid] along it: all the ruled lines.
  double end = 0.0;             ///< [grid] of each end, where it goes on beyond them.
};

/// Across all the ruled lines and half their spacing beyond, or to the border of the plane.
AlongLine alongMargin(const PlaneView& grey, const RulingLattice& ruled, double place) {
  const double half = 0.5 * ruled.spacing, last = grey.width() - kMarginStep;
  return {std::clamp(ruled.at(ruled.first, place) - half, 0.0, last),
          std::clamp(ruled.at(ruled.last, place) + half, 0.0, last), ruled.spacing};
}

/// Follows one line through the plane.
class MarginTrack {
 public:
  MarginTrack(const PlaneView& grey, const AlongLine& between, double seedX, double seedY)
      : grey_(grey), between_(between) {
    if (const auto seed = look(static_cast<int>(seedX), seedY)) {
      depth_ = seed->depth;
      follow(static_cast<int>(seedX), seed->y, 1);
      follow(static_cast<int>(seedX) - kMarginStep, seed->y, -1);
    }
  }

  /// A cubic in 2 x / width - 1; absent if the line is hidden too often, or bends otherwise.
  std::optional<Eigen::Vector4d> course() const {
    if (steps_ == 0 || static_cast<double>(xs_.size()) < kLeastSeenAlong * steps_) return std::nullopt;
    if (!isSeenIn({between_.from, between_.from + between_.end}) ||
        !isSeenIn({between_.to - between_.end, between_.to}))
      return std::nullopt;
    SmallLeastSquares<4> fit;
    for (std::size_t i = 0; i < xs_.size(); ++i) fit.add(termsAt(xs_[i]), ys_[i]);
    const Eigen::Vector4d c = fit.solve();
    std::vector<double> misfits;
    for (std::size_t i = 0; i < xs_.size(); ++i) misfits.push_back(std::fabs(c.dot(termsAt(xs_[i])) - ys_[i]));
    constexpr double kNineInTen = 0.9;  // quantile of the misfits
    if (lowerQuantile(misfits, kNineInTen) > kMostMarginMisfit) return std::nullopt;
    if (std::fabs(c[2]) + std::fabs(c[3]) > kMostBend * grey_.width()) return std::nullopt;
    return c;
  }

 private:
  struct Look {
    double y = 0.0;
    float depth = 0.0f;
  };

  bool isSeenIn(const AlongLine& part) const {
    const auto seen = std::ranges::count_if(xs_, [&](double x) { return x >= part.from && x < part.to; });
    return static_cast<double>(seen) * kMarginStep >= kLeastSeenAtEnd * (part.to - part.from);
  }

  Eigen::Vector4d termsAt(double x) const {
    const double u = 2.0 * x / grey_.width() - 1.0;
    return {1.0, u, u * u, u * u * u};
  }

  /// The darkest place near an expected one, over kMarginStep columns from x on. Absent at the border of the plane.
  std::optional<Look> look(int x, double expected) const {
    const int middle = static_cast<int>(std::lround(expected));
    if (x < 0 || x + kMarginStep > grey_.width() || middle < kPaperBeside || middle + kPaperBeside >= grey_.height())
      return std::nullopt;
    std::array<float, 2 * kPaperBeside + 1> levels{};
    for (int i = 0; i < kMarginStep; ++i) {
      for (int d = -kPaperBeside; d <= kPaperBeside; ++d)
        levels[d + kPaperBeside] += grey_.at(x + i, middle + d) / kMarginStep;
    }
    const auto first = levels.begin() + kPaperBeside - kLookFor;
    const auto darkest = std::min_element(first, first + 2 * kLookFor + 1);
    const float paper = *std::max_element(levels.begin(), levels.end());
    Look found{0.0, paper - *darkest};
    double sum = 0.0, weight = 0.0;
    for (auto it = std::max(levels.begin(), darkest - 1); it <= std::min(levels.end() - 1, darkest + 1); ++it) {
      sum += static_cast<double>(paper - *it) * static_cast<double>(it - levels.begin());
      weight += static_cast<double>(paper - *it);
    }
    found.y = middle - kPaperBeside + (weight > 0.0 ? sum / weight : kPaperBeside) + 0.5;
    return found;
  }

  /// Along the straight line through what was seen of it last: strokes that cross it, or run along it for a while, do
  /// not lead it astray.
  void follow(int x, double y, int direction) {
    double slope = 0.0;  // a step
    int known = 0;
    for (; x >= 0 && x + kMarginStep <= grey_.width(); x += direction * kMarginStep) {
      const bool isCounted = x >= between_.from && x < between_.to;
      steps_ += isCounted ? 1 : 0;
      y += slope;
      const auto found = look(x, y - 0.5);
      if (!found || found->depth < kLeastOfDepth * depth_ || found->depth > kMostOfDepth * depth_) continue;
      known = std::min(known + 1, kMemory);
      // Least squares of all steps so far, which forgets none before there are kMemory.
      const double off = found->y - y, n = known;
      y += off * (2.0 * (2.0 * n - 1.0) / (n * (n + 1.0)));
      slope += known > 1 ? off * (6.0 / (n * (n + 1.0))) : 0.0;
      if (!isCounted) continue;
      xs_.push_back(x + 0.5 * kMarginStep);
      ys_.push_back(found->y);
    }
  }

  const PlaneView& grey_;
  AlongLine between_;
  float depth_ = 0.0f;
  int steps_ = 0;
  std::vector<double> xs_, ys_;
};

/// Whether a line runs where one of the others does.
bool isAmong(const std::vector<RulingLattice>& others, const RulingLattice& line) {
  return std::ranges::any_of(others, [&](const RulingLattice& other) {
    const auto isSame = [&](double x) { return std::fabs(other.at(0.0, x) - line.at(0.0, x)) <= kLookFor; };
    return isSame(0.5 * line.halfWidth) && isSame(1.5 * line.halfWidth);
  });
}

}  // namespace

std::vector<RulingLattice> findMarginLines(const PlaneView& grey, const RulingStretches& found,
                                           const RulingLattice& ruled, const RunContext& context) {
  std::vector<RulingLattice> margins;
  for (std::size_t strip = 0; strip < found.strips.size(); ++strip) {
    const double x = (static_cast<double>(strip) + 0.5) * found.stripWidth;
    for (const RulingStretch& stretch : found.strips[strip]) {
      if (context.isCancelled()) return {};
      const double y = stretch.place + found.slope * x;
      if (std::min(y, found.height - y) > kFarthestMargin * found.height) continue;
      const bool isKnown = std::ranges::any_of(
          margins, [&](const RulingLattice& line) { return std::fabs(line.at(0.0, x) - y) <= kPaperBeside; });
      if (isKnown) continue;
      const auto course = MarginTrack(grey, alongMargin(grey, ruled, y), x, y).course();
      if (!course) continue;
      RulingLattice line;
      line.halfWidth = 0.5 * found.width;
      constexpr std::array<int, 4> kPowersOfX{0, 2, 5, 9};  // of the terms of a lattice
      for (int i = 0; i < 4; ++i) line.coefficients[kPowersOfX[i]] = (*course)[i];
      line.spacing = ruled.spacing;
      line.isSeen = {true};
      const auto isBesideSide = [&](double at) {
        return std::min(at, found.height - at) <= kFarthestMargin * found.height;
      };
      if (isBesideSide(line.at(0.0, 0.0)) && isBesideSide(line.at(0.0, found.width)) && !isAmong(margins, line))
        margins.push_back(line);
    }
  }
  return margins;
}

}  // namespace batten
