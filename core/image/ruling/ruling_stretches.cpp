// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/ruling_stretches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"
#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr int kStrips = 8;                     // across the page, each looked at by itself
constexpr int kLeastStretchSide = 160;         // [grid] smaller pictures hold no ruled page
constexpr double kSteepest = 0.2;              // of the lines
constexpr double kShiftPerStep = 1.5;          // [grid] of the end of a strip, from one slope that is tried to the next
constexpr double kLeastOfStrip = 0.35;         // of the columns of a strip that must hold the line
constexpr std::array<int, 2> kSides = {2, 5};  // [grid] where the paper beside a thin line is looked for
constexpr int kAlong = 2;                      // [grid] half the length over which grey is averaged along the lines
constexpr float kLeastDepth = 2.0f;            // [grey]
constexpr double kDepthPerNoise = 2.5;         // standard deviations of the grey across lines
constexpr int kBelts = 8;                      // across the lines of a strip, each with a slope of its own in a fan
constexpr double kClearlyBetter = 1.1;         // than the common direction: a fan that is no accident of noise
constexpr int kNoiseStride = 7;                // [px] between two samples of the page

struct LinePixel {
  float x, y;
};

BATTEN_HOT_LOOP void meansOfFive(const float* in, float* __restrict out, int count) {
  for (int i = 0; i < count; ++i) out[i] = (in[i] + in[i + 1] + in[i + 2] + in[i + 3] + in[i + 4]) / 5.0f;
}

BATTEN_HOT_LOOP void meansOfFiveRows(const float* const* rows, float* __restrict out, int count) {
  const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4];
  for (int i = 0; i < count; ++i) out[i] = (a[i] + b[i] + c[i] + d[i] + e[i]) / 5.0f;
}

/// Rows [first, past) of a plane averaged along x over 2 kAlong + 1 pixels. Made where they are needed: a whole plane
/// of them would be fresh memory, which costs more than the sums.
class AveragedRows {
 public:
  explicit AveragedRows(const Plane& grey) : grey_(grey), padded_(grey.width + 2 * kAlong) {}

  void make(int first, int past) {
    static_assert(kAlong == 2);
    first_ = first;
    rows_.resize(std::ptrdiff_t{grey_.width} * (past - first));
    for (int y = first; y < past; ++y) {
      const float* row = grey_.row(y);
      std::copy_n(row, grey_.width, padded_.data() + kAlong);
      std::fill_n(padded_.data(), kAlong, row[0]);
      std::fill_n(padded_.data() + kAlong + grey_.width, kAlong, row[grey_.width - 1]);
      meansOfFive(padded_.data(), rows_.data() + std::ptrdiff_t{y - first} * grey_.width, grey_.width);
    }
  }
  const float* row(int y) const { return rows_.data() + std::ptrdiff_t{y - first_} * grey_.width; }
  int height() const { return grey_.height; }  ///< Of the plane.

 private:
  const Plane& grey_;
  int first_ = 0;
  std::vector<float> padded_, rows_;
};

/// Of the steps between rows averaged along x, at some places.
double noiseAcross(const PlaneView& grey) {
  const auto averaged = [&](int x, int y) {
    const auto at = [&](int i) { return grey.at(std::clamp(i, 0, grey.width() - 1), y); };
    return (at(x - 2) + at(x - 1) + at(x) + at(x + 1) + at(x + 2)) / 5.0f;
  };
  static_assert(kAlong == 2);
  std::vector<float> steps;
  const auto take = [&](int x, int y) { steps.push_back(averaged(x, y + 1) - averaged(x, y)); };
  // As the plane lies in memory.
  if (grey.isMirrored) {
    for (int x = 0; x < grey.width(); x += kNoiseStride)
      for (int y = 0; y + 1 < grey.height(); y += kNoiseStride) take(x, y);
  } else {
    for (int y = 0; y + 1 < grey.height(); y += kNoiseStride)
      for (int x = 0; x < grey.width(); x += kNoiseStride) take(x, y);
  }
  return robustSigma(steps) / std::sqrt(2.0);
}

/// A row and those around it that it is compared with.
struct RowsAround {
  const float *above, *here, *below;
  std::array<const float*, kSides.size()> up, down;
};

/// Strip s holds columns from floor(s * width / kStrips) on.
int stripOf(int x, int width) {
  int strip = std::min(x * kStrips / width, kStrips - 1);
  while (strip + 1 < kStrips && (strip + 1) * width / kStrips <= x) ++strip;
  return strip;
}

/// Marks pixels that are the darkest of a column of three and darker by `least` than the paper on both sides. `up` and
/// `down` of a side that lies beyond the page are the row itself: it is not darker than that.
BATTEN_HOT_LOOP void markThinDark(const RowsAround& rows, float least, std::uint8_t* __restrict marks, int count) {
  const float *above = rows.above, *here = rows.here, *below = rows.below;
  const float *up0 = rows.up[0], *down0 = rows.down[0], *up1 = rows.up[1], *down1 = rows.down[1];
  for (int x = 0; x < count; ++x) {
    const float near = (down0[x] < up0[x] ? down0[x] : up0[x]) - here[x];
    const float far = (down1[x] < up1[x] ? down1[x] : up1[x]) - here[x];
    const float depth = near > far ? near : far;
    marks[x] = (here[x] <= above[x]) & (here[x] < below[x]) & (depth >= least);
  }
}

RowsAround rowsAround(const AveragedRows& averaged, int y) {
  RowsAround rows{averaged.row(y - 1), averaged.row(y), averaged.row(y + 1), {}, {}};
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    const bool isOnPage = y >= kSides[i] && y + kSides[i] < averaged.height();
    rows.up[i] = isOnPage ? averaged.row(y - kSides[i]) : rows.here;
    rows.down[i] = isOnPage ? averaged.row(y + kSides[i]) : rows.here;
  }
  return rows;
}

/// The same along a row of a plane that is averaged across: its columns are the rows of the mirrored plane.
RowsAround columnsAround(const float* row, int width, int x) {
  RowsAround columns{row + x - 1, row + x, row + x + 1, {}, {}};
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    const bool isOnPage = x >= kSides[i] && x + kSides[i] < width;
    columns.up[i] = isOnPage ? columns.here - kSides[i] : columns.here;
    columns.down[i] = isOnPage ? columns.here + kSides[i] : columns.here;
  }
  return columns;
}

/// Calls `take` for every marked pixel. `marks` go on to a multiple of eight.
template <class Take>
void forEachMark(const std::vector<std::uint8_t>& marks, const Take& take) {
  for (int x = 0; x < std::ssize(marks); x += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, marks.data() + x, 8);
    if (eight == 0) continue;
    for (int i = x; i < x + 8; ++i)
      if (marks[i] != 0) take(i);
  }
}

/// How far from the middle of a pixel, that is darker than the ones on both sides, the darkest place lies.
float shiftBetween(float above, float here, float below) {
  const float bend = above - 2.0f * here + below;
  return bend > 0.0f ? 0.5f * (above - below) / bend : 0.0f;
}

using PixelsOfStrips = std::array<std::vector<LinePixel>, kStrips>;

/// Pixels in the middle of thin dark lines on rows [begin, end).
void addLinePixels(const Plane& grey, float least, int begin, int end, PixelsOfStrips& pixels) {
  static_assert(kSides.size() == 2);
  constexpr int kFarSide = kSides.back();  // rows that are needed beyond a block
  std::vector<std::uint8_t> marks((grey.width + 7) / 8 * 8, 0);
  AveragedRows averaged(grey);
  averaged.make(std::max(0, begin - kFarSide), std::min(grey.height, end + kFarSide));
  for (int y = std::max(1, begin); y < std::min(end, grey.height - 1); ++y) {
    const RowsAround rows = rowsAround(averaged, y);
    markThinDark(rows, least, marks.data(), grey.width);
    forEachMark(marks, [&](int x) {
      const float shift = shiftBetween(rows.above[x], rows.here[x], rows.below[x]);
      pixels[stripOf(x, grey.width)].push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f + shift});
    });
  }
}

/// Those of the mirrored plane on its columns [begin, end), which are rows of the plane: nothing need be mirrored.
void addMirroredLinePixels(const Plane& grey, float least, int begin, int end, PixelsOfStrips& pixels) {
  constexpr int kFarSide = kSides.back();
  const int width = grey.width;
  std::vector<std::uint8_t> marks((width + 7) / 8 * 8, 0);
  std::vector<float> row(width);
  for (int y = begin; y < end; ++y) {
    std::array<const float*, 2 * kAlong + 1> around{};
    for (int i = -kAlong; i <= kAlong; ++i) around[i + kAlong] = grey.row(std::clamp(y + i, 0, grey.height - 1));
    meansOfFiveRows(around.data(), row.data(), width);
    const auto mark = [&](int x, int count) {
      markThinDark(columnsAround(row.data(), width, x), least, marks.data() + x, count);
    };
    for (int x = 1; x < kFarSide; ++x) mark(x, 1);
    mark(kFarSide, width - 2 * kFarSide);
    for (int x = width - kFarSide; x + 1 < width; ++x) mark(x, 1);
    std::vector<LinePixel>& ofStrip = pixels[stripOf(y, grey.height)];
    forEachMark(marks, [&](int x) {
      const float shift = shiftBetween(row[x - 1], row[x], row[x + 1]);
      ofStrip.push_back({static_cast<float>(y) + 0.5f, static_cast<float>(x) + 0.5f + shift});
    });
  }
}

/// Pixels in the middle of thin dark lines, strip by strip, in no order that tells anything.
/// @pre no side is shorter than kLeastStretchSide
PixelsOfStrips linePixels(const PlaneView& grey, const RunContext& context) {
  const float least = std::max(kLeastDepth, static_cast<float>(kDepthPerNoise * noiseAcross(grey)));
  const int rows = grey.plane.height, blocks = (rows + kRowsPerBlock - 1) / kRowsPerBlock;
  std::vector<PixelsOfStrips> parts(blocks);
  parallelFor(context, rows, kRowsPerBlock, [&](int begin, int end) {
    const auto add = grey.isMirrored ? addMirroredLinePixels : addLinePixels;
    add(grey.plane, least, begin, end, parts[begin / kRowsPerBlock]);
  });
  PixelsOfStrips pixels;
  for (const PixelsOfStrips& part : parts) {
    for (std::size_t s = 0; s < kStrips; ++s) pixels[s].insert(pixels[s].end(), part[s].begin(), part[s].end());
  }
  return pixels;
}

double slopeIn(const RulingFan& fan, double y, double height) {
  return std::clamp(fan.slope + fan.fan * (2.0 * y / height - 1.0), -kSteepest, kSteepest);
}

/// Counts of y - slope (x - middle) in bins of 1, the first at -offset.
void project(std::span<const LinePixel> pixels, double slope, double middle, double offset, std::vector<int>& bins) {
  std::fill(bins.begin(), bins.end(), 0);
  const auto tilt = static_cast<float>(slope), shift = static_cast<float>(offset + slope * middle);
  for (const LinePixel& p : pixels) {
    const auto bin = static_cast<int>(p.y - tilt * p.x + shift);
    if (bin >= 0 && bin < std::ssize(bins)) ++bins[bin];
  }
}

BATTEN_HOT_LOOP int greatestOf(const int* counts, int count) {
  int greatest = 0;
  for (int i = 0; i < count; ++i) greatest = counts[i] > greatest ? counts[i] : greatest;
  return greatest;
}

bool isMuch(int count, float least) { return 2.0f * static_cast<float>(count) > least; }

/// The squares of the counts that make at least half of `least`, added up.
double scoreOf(const std::vector<int>& bins, float least) {
  double score = 0.0;
  if (!isMuch(greatestOf(bins.data(), static_cast<int>(bins.size())), least)) return score;
  for (const int count : bins) {
    if (isMuch(count, least)) score += static_cast<double>(count) * count;
  }
  return score;
}

/// Places where three bins together hold enough pixels, each at their centre of mass, and with their count.
std::vector<RulingStretch> peaksOf(const std::vector<int>& bins, double least, double offset) {
  constexpr double kNearest = 2.5;  // bins: two peaks that are nearer share one
  std::vector<RulingStretch> peaks;
  const auto around = [&](std::size_t i) { return bins[i - 1] + bins[i] + bins[i + 1]; };
  for (std::size_t i = 2; i + 2 < bins.size(); ++i) {
    const double here = around(i);
    if (here < least || here < around(i - 1) || here <= around(i + 1)) continue;
    const double shift = static_cast<float>(bins[i + 1] - bins[i - 1]) / static_cast<float>(here);
    const double place = static_cast<double>(i) + 0.5 + shift - offset;
    if (peaks.empty() || place - peaks.back().place > kNearest) peaks.push_back({place, here});
  }
  return peaks;
}

/// How well each slope suits the lines of each strip and belt of a plane.
class SlopeScores {
 public:
  SlopeScores(const PixelsOfStrips& pixels, const RulingStretches& plane, const RunContext& context)
      : steps_(static_cast<int>(std::ceil(kSteepest * plane.stripWidth / kShiftPerStep))),
        scores_(kStrips * kBelts, std::vector<double>(2 * steps_ + 1, 0.0)) {
    const double least = kLeastOfStrip * plane.stripWidth, beltHeight = plane.height / kBelts;
    const double offset = 0.5 * kSteepest * plane.stripWidth + 2.0;
    parallelFor(context, kStrips, 1, [&](int s, int) {
      std::array<std::vector<LinePixel>, kBelts> belts;
      for (const LinePixel& p : pixels[s])
        belts[std::clamp(static_cast<int>(p.y / beltHeight), 0, kBelts - 1)].push_back(p);
      std::vector<int> bins(static_cast<int>(beltHeight + 2.0 * offset) + 2);
      for (int b = 0; b < kBelts; ++b) {
        if (!isMuch(static_cast<int>(belts[b].size()), static_cast<float>(least))) continue;  // none of its bins either
        for (int i = 0; i <= 2 * steps_ && !context.isCancelled(); ++i) {
          project(belts[b], slopeOf(i), (s + 0.5) * plane.stripWidth, offset - b * beltHeight, bins);
          scores_[s * kBelts + b][i] = scoreOf(bins, static_cast<float>(least));
        }
      }
    });
    for (int i = 1; i <= 2 * steps_; ++i)
      if (sumOf(0, kStrips * kBelts, i) > sumOf(0, kStrips * kBelts, common_)) common_ = i;
  }

  /// Whether there are lines at all.
  bool hasLines() const { return sumOf(0, kStrips * kBelts, common_) > 0.0; }
  /// The slope that suits the whole plane.
  double commonSlope() const { return slopeOf(common_); }

  /// The lines of a strip: in the common direction, unless a fan suits them clearly better.
  RulingFan fanOf(int strip) const {
    RulingFan found{commonSlope(), 0.0};
    const auto first = scores_.begin() + std::ptrdiff_t{strip} * kBelts;
    const auto isEmpty = [](const std::vector<double>& belt) { return std::ranges::max(belt) <= 0.0; };
    if (std::all_of(first, first + kBelts, isEmpty)) return found;
    double top = kClearlyBetter * sumOf(strip * kBelts, (strip + 1) * kBelts, common_);
    const std::vector<std::array<int, kBelts>> away = stepsFromMiddle();
    for (int middle = 0; middle <= 2 * steps_; ++middle) {
      for (int fan = -steps_; fan <= steps_; ++fan) {
        double sum = 0.0;
        for (int b = 0; b < kBelts; ++b) sum += first[b][std::clamp(middle + away[fan + steps_][b], 0, 2 * steps_)];
        if (sum <= top) continue;
        top = sum;
        found = {slopeOf(middle), kSteepest * fan / steps_};
      }
    }
    return found;
  }

 private:
  double slopeOf(int step) const { return kSteepest * (step - steps_) / steps_; }
  /// How many steps the belts of a strip lie from the middle one, fan by fan.
  std::vector<std::array<int, kBelts>> stepsFromMiddle() const {
    std::vector<std::array<int, kBelts>> away(2 * steps_ + 1);
    for (int fan = -steps_; fan <= steps_; ++fan)
      for (int b = 0; b < kBelts; ++b)
        away[fan + steps_][b] = static_cast<int>(std::floor(fan * ((2.0 * b + 1.0) / kBelts - 1.0) + 0.5));
    return away;
  }
  double sumOf(int from, int to, int step) const {
    double sum = 0.0;
    for (int i = from; i < to; ++i) sum += scores_[i][step];
    return sum;
  }

  int steps_, common_ = 0;
  std::vector<std::vector<double>> scores_;  ///< Per strip and belt, slope by slope.
};

}  // namespace

void PlaneView::copyRows(int first, int past, float* out) const {
  if (!isMirrored) {
    std::copy(plane.row(first), plane.row(first) + std::ptrdiff_t{past - first} * plane.width, out);
    return;
  }
  constexpr int kSquare = 32;  // what is read of 32 rows stays in the cache
  const std::ptrdiff_t size = width();
  for (int x0 = 0; x0 < size; x0 += kSquare) {
    const int x1 = std::min<int>(x0 + kSquare, width());
    for (int y = first; y < past; ++y) {
      float* row = out + (y - first) * size;
      for (int x = x0; x < x1; ++x) row[x] = plane.row(x)[y];
    }
  }
}

double RulingStretches::slopeAt(int strip, double place) const {
  return slopeIn(fans[strip], place + slope * middleOf(strip), height);
}

RulingStretches RulingStretches::inStrips(int first, int count) const {
  RulingStretches out = *this;
  out.fromX += first * stripWidth;
  out.strips.assign(strips.begin() + first, strips.begin() + first + count);
  out.fans.assign(fans.begin() + first, fans.begin() + first + count);
  return out;
}

RulingStretches RulingStretches::inkedAtLeast(double share) const {
  RulingStretches out = *this;
  for (auto& strip : out.strips) std::erase_if(strip, [&](const RulingStretch& s) { return s.inked < share; });
  return out;
}

RulingStretches findRulingStretches(const PlaneView& grey, const RunContext& context) {
  RulingStretches out;
  out.width = grey.width();
  out.height = grey.height();
  out.stripWidth = out.width / kStrips;
  if (std::min(grey.width(), grey.height()) < kLeastStretchSide) return out;
  const auto pixels = linePixels(grey, context);
  if (context.isCancelled()) return out;
  const SlopeScores scores(pixels, out, context);
  if (context.isCancelled() || !scores.hasLines()) return out;
  out.slope = scores.commonSlope();
  const double offset = 0.5 * kSteepest * out.stripWidth + 2.0, least = kLeastOfStrip * out.stripWidth;
  std::vector<int> bins(static_cast<int>(out.height + 2.0 * offset) + 2);
  for (int s = 0; s < kStrips; ++s) {
    const RulingFan& fan = out.fans.emplace_back(scores.fanOf(s));
    const double middle = (s + 0.5) * out.stripWidth;
    std::fill(bins.begin(), bins.end(), 0);
    for (const LinePixel& p : pixels[s])
      ++bins[static_cast<int>(p.y - slopeIn(fan, p.y, out.height) * (p.x - middle) + offset)];
    out.strips.push_back(peaksOf(bins, least, offset));
    for (RulingStretch& stretch : out.strips.back()) {
      stretch.place -= out.slope * middle;
      stretch.inked /= out.stripWidth;
    }
  }
  return out;
}

}  // namespace batten
