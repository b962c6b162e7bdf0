// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/ruling_ink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr int kShortestStretch = 32;      // [grid] along a line
constexpr double kStretchSpacings = 2.0;  // a row of letters has at least two letters and their gaps in as much
constexpr int kOffCourse = 2;             // [grid] how far a line may lie off its lattice
constexpr int kMostGrain = 2;             // [grid] half the most length over which grey is averaged against noise
constexpr double kSigmas = 2.0;           // of the noise: a gap stands out of them
constexpr int kNoiseStep = 7;             // [grid] between the pixels that tell the noise
constexpr double kQuietRank = 0.25;       // of the steps between neighbours: those on paper are among them
constexpr double kQuarterSigma = 0.319;   // the standard deviations that a quarter of a normal variable lies within
constexpr double kPaperRankAround = 0.9;  // of the pixels of a stretch: drawing and line are darker
constexpr double kLineRank = 0.75;        // of the depths along a stretch: the line's, without strokes that cross
constexpr double kInkDepth = 0.5;         // of the line's depth: fainter places are gaps
constexpr double kAbsent = 0.2;           // of a stretch with ink: less, and the line is not there at all

/// [grey] Of pixels on paper, also where most of the page is drawn on.
double paperNoise(const Plane& grey) {
  std::vector<float> steps;
  for (int y = 0; y < grey.height; y += kNoiseStep) {
    for (int x = (y / kNoiseStep) % kNoiseStep; x + 1 < grey.width; x += kNoiseStep)
      steps.push_back(std::fabs(grey.row(y)[x + 1] - grey.row(y)[x]));
  }
  return steps.empty() ? 0.0 : lowerQuantile(steps, kQuietRank) / (kQuarterSigma * std::sqrt(2.0));
}

/// One stretch of one line: columns [begin, end).
struct Stretch {
  int begin = 0, end = 0;
};

class StretchInk {
 public:
  StretchInk(const Plane& grey, double noise, const RulingLattice& lattice, double line, Stretch stretch)
      : grey_(grey), noise_(noise), spacing_(lattice.spacing), stretch_(stretch) {
    for (int x = firstRow(); x < stretch.end + kMostGrain; ++x)
      rows_.push_back(static_cast<int>(std::floor(lattice.at(line, x + 0.5))));
  }

  /// Share of the columns that hold ink; 0 where the stretch leaves the page or has no line.
  double share() const {
    const int half = std::max(kOffCourse, static_cast<int>(0.5 * spacing_));
    const int first = rowAt(stretch_.begin), last = rowAt(stretch_.end - 1);
    if (std::min(first, last) < half || std::max(first, last) + half >= grey_.height) return 0.0;
    std::vector<float> around;
    double darkest = 0.0;
    int off = 0;
    for (int d = -half; d <= half; ++d) {
      double sum = 0.0;
      for (int x = stretch_.begin; x < stretch_.end; ++x) {
        const float level = grey_.row(std::clamp(rowAt(x) + d, 0, grey_.height - 1))[x];
        around.push_back(level);
        sum += static_cast<double>(level);
      }
      if (std::abs(d) > kOffCourse || (d > -kOffCourse && sum >= darkest)) continue;
      darkest = sum;
      off = d;
    }
    const float paper = elementOfRank(around, static_cast<std::ptrdiff_t>(kPaperRankAround * std::ssize(around)));
    const int columns = stretch_.end - stretch_.begin;
    const int grain = grainFor(static_cast<double>(paper) - darkest / columns);
    std::vector<float> depths;
    for (int x = stretch_.begin; x < stretch_.end; ++x) depths.push_back(paper - levelAlong(x, off, grain));
    std::vector<float> ranked = depths;
    const float line = elementOfRank(ranked, static_cast<std::ptrdiff_t>(kLineRank * std::ssize(ranked)));
    if (line <= 0.0f) return 0.0;
    const auto inked = std::count_if(depths.begin(), depths.end(),
                                     [&](float depth) { return depth >= static_cast<float>(kInkDepth) * line; });
    return static_cast<double>(inked) / static_cast<double>(std::ssize(depths));
  }

 private:
  int firstRow() const { return stretch_.begin - kMostGrain; }
  int rowAt(int x) const { return rows_[x - firstRow()]; }

  /// Half the length to average over so that noise alone makes no gap in a line of this depth: letters stand close.
  int grainFor(double depth) const {
    int grain = 0;
    while (grain < kMostGrain && (1.0 - kInkDepth) * depth * std::sqrt(2.0 * grain + 1.0) < kSigmas * noise_) ++grain;
    return grain;
  }

  float levelAlong(int x, int off, int grain) const {
    const int from = std::max(0, x - grain), to = std::min(grey_.width - 1, x + grain);
    float sum = 0.0f;
    for (int i = from; i <= to; ++i) sum += grey_.row(std::clamp(rowAt(i) + off, 0, grey_.height - 1))[i];
    return sum / static_cast<float>(to - from + 1);
  }

  const Plane& grey_;
  double noise_;
  double spacing_;
  Stretch stretch_;
  std::vector<int> rows_;  ///< Of the line, column by column: each is asked for many times.
};

/// Levels along a course, summed over the columns in which it lies on the page.
class CourseLevels {
 public:
  CourseLevels(const Plane& grey, const RulingLattice& lattice, double line) {
    const int begin = std::max(0, static_cast<int>(std::lround(lattice.fromX))),
              end = std::min(grey.width, static_cast<int>(std::lround(lattice.toX())));
    for (int x = begin; x < end; ++x) {
      const int row = static_cast<int>(std::floor(lattice.at(line, x + 0.5)));
      if (row < kOff || row + kOff >= grey.height) continue;
      std::array<float, 2 * kOff + 1> levels{};
      for (int d = -kOff; d <= kOff; ++d) {
        levels[d + kOff] = grey.row(row + d)[x];
        rows_[d + kOff] += static_cast<double>(levels[d + kOff]);
      }
      const auto [least, most] = std::minmax_element(levels.begin(), levels.end());
      darkest_ += static_cast<double>(*least);
      brightest_ += static_cast<double>(*most);
      ++columns_;
    }
  }
  int columns() const { return columns_; }
  /// Mean of the one row that is darkest, or brightest, on the whole.
  double darkestRow() const { return *std::min_element(rows_.begin(), rows_.end()) / columns_; }
  double brightestRow() const { return *std::max_element(rows_.begin(), rows_.end()) / columns_; }
  /// Mean of the darkest, or brightest, row of each column.
  double darkest() const { return darkest_ / columns_; }
  double brightest() const { return brightest_ / columns_; }

 private:
  static constexpr int kOff = 1;  // rows to both sides of the course
  std::array<double, 2 * kOff + 1> rows_{};
  double darkest_ = 0.0, brightest_ = 0.0;
  int columns_ = 0;
};

}  // namespace

LatticeContrast contrastOf(const Plane& grey, const RulingLattice& lattice) {
  double along = 0.0, columnByColumn = 0.0, between = 0.0;
  for (int i = 0; i < std::ssize(lattice.isSeen); ++i) {
    if (!lattice.isSeen[i]) continue;
    const double number = lattice.first + i;
    const CourseLevels line(grey, lattice, number), middle(grey, lattice, number + 0.5);
    if (line.columns() == 0 || middle.columns() == 0) continue;
    along += middle.brightestRow() - line.darkestRow();
    columnByColumn += middle.brightest() - line.darkest();
    between += middle.brightestRow() - middle.darkestRow();
  }
  if (along <= 0.0 || columnByColumn <= 0.0) return {};
  return {along / columnByColumn, between / along};
}

double inkAlongLines(const Plane& grey, const RulingLattice& lattice, const RunContext& context) {
  const int length = std::max(kShortestStretch, static_cast<int>(std::ceil(kStretchSpacings * lattice.spacing)));
  const int begin = static_cast<int>(std::lround(lattice.fromX)),
            end = std::min(grey.width, static_cast<int>(std::lround(lattice.toX())));
  const int perLine = std::max(1, (end - begin) / length);
  const int lines = static_cast<int>(std::ssize(lattice.isSeen));
  const double noise = paperNoise(grey);
  std::vector<std::vector<double>> ofLine(lines);
  parallelFor(context, lines, 1, [&](int i, int) {
    if (!lattice.isSeen[i]) return;
    for (int s = 0; s < perLine && !context.isCancelled(); ++s) {
      const Stretch stretch{begin + s * length, std::min(end, begin + (s + 1) * length)};
      const double share = StretchInk(grey, noise, lattice, lattice.first + i, stretch).share();
      if (share > kAbsent) ofLine[i].push_back(share);
    }
  });
  std::vector<double> shares;
  for (const auto& line : ofLine) shares.insert(shares.end(), line.begin(), line.end());
  return shares.empty() ? 0.0 : lowerQuantile(shares, 0.5);
}

}  // namespace batten
