// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/ends/end_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/hot_loop.h"
#include "core/base/statistics.h"
#include "core/contour/centreline/profile/stroke_profile.h"

namespace batten {
namespace {

constexpr double kMiddleHalf = 0.25;                    // of the width to either side: the middle half of a stroke
constexpr float kEndContrast = 4.0f;                    // [grey]
constexpr double kBesideEndPx = 2.5;                    // [px] of paper looked at round an end
constexpr double kEndStepPx = 0.5;                      // [px] between the places at which an end is compared
constexpr double kTipStepPx = 0.25;                     // [px] between the places at which its tip may lie,
constexpr int kTipSteps = 5;                            // and how many of them to either side
constexpr double kSamplesPerPx = 4.0;                   // at half a pixel's step each pixel is seen so often
constexpr double kLessSkewed = 0.5, kMostSkewed = 1.0;  // [-] slopes of a cut: as far as 45 degrees from square
constexpr double kCutSlopes[] = {-kMostSkewed, -kLessSkewed, 0.0, kLessSkewed, kMostSkewed};  // all that are tried
constexpr double kLeastEndBlurPx = 0.4, kMostEndBlurPx = 2.4, kBlurStepPx = 0.1;              // standard deviations
constexpr double kThinnerPx = 0.75, kThickerPx = 0.25, kRadiusStepPx = 0.1;  // than half the width at half level

// [stroke widths] and [px] beyond the end of a skeleton in which the end of the ink is looked for: the skeleton stops
// up to a width before it, a worn mask up to another, and half the profile of the end lies behind it.
constexpr double kBeyondEndWidths = 2.0, kBeyondEndPx = 3.0;

constexpr double kLeastRadiusPx = 0.3;      // of a strip that can be told from its blur
constexpr double kRuledOut = 6.0;           // [nats] less likely than the best: not tried
constexpr double kLeastEndVariance = 0.25;  // [grey^2] of the rounding to whole levels and of the model

// Share of a blurred edge's darkness, x standard deviations inside it.
double edgeShare(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// A stroke as a strip of even darkness, blurred.
struct PenModel {
  double radius = 1.0, blur = 1.0;                          // [px]
  double dark = 0.0, paper = 0.0;                           // [grey]
  double misfit = std::numeric_limits<double>::infinity();  // [grey^2] sum over the pixels across the stroke
  double across(double u) const { return edgeShare((u + radius) / blur) - edgeShare((u - radius) / blur); }
};

// The levels across a stroke, the mean of both its sides, by the distance from its middle, every kEndStepPx.
struct Flank {
  std::vector<double> level;  // [grey]
  int columns = 0;            // of which it is the mean
};

Flank flankOf(const EndCourse& end, double toPx, double halfPx, const GreyImage& grey) {
  Flank flank;
  const int count = static_cast<int>(std::lround(halfPx / kEndStepPx)) + 1;
  flank.level.assign(count, 0.0);
  for (double s = 0.0; s <= toPx; s += kEndStepPx, ++flank.columns) {
    const Vec2 at = end.position(s), normal = end.normal(s);
    for (int k = 0; k < count; ++k) {
      const Vec2 beside = k * kEndStepPx * normal, left = at + beside, right = at - beside;
      flank.level[k] +=
          0.5 * static_cast<double>(sampleGrey(grey, left.x(), left.y()) + sampleGrey(grey, right.x(), right.y()));
    }
  }
  for (double& level : flank.level) level /= flank.columns;
  return flank;
}

// The strips that may have left a flank, one for every blur, least misfit first.
std::vector<PenModel> pensFor(const Flank& flank, double widthPx) {
  std::vector<PenModel> pens;
  const double from = std::max(kLeastRadiusPx, 0.5 * widthPx - kThinnerPx), to = 0.5 * widthPx + kThickerPx;
  const auto count = static_cast<double>(flank.level.size());
  for (double blur = kLeastEndBlurPx; blur <= kMostEndBlurPx; blur += kBlurStepPx) {
    PenModel best;
    for (double radius = from; radius <= to; radius += kRadiusStepPx) {
      PenModel pen{.radius = radius, .blur = blur};
      // Level = paper - dark * share, by least squares.
      double share = 0.0, level = 0.0, shareShare = 0.0, shareLevel = 0.0, levelLevel = 0.0;
      for (int k = 0; k < std::ssize(flank.level); ++k) {
        const double a = pen.across(k * kEndStepPx), b = flank.level[k];
        share += a;
        level += b;
        shareShare += a * a;
        shareLevel += a * b;
        levelLevel += b * b;
      }
      const double spread = shareShare - share * share / count, both = shareLevel - share * level / count;
      if (!(spread > 0.0)) continue;
      pen.dark = -both / spread;
      pen.paper = (level + pen.dark * share) / count;
      pen.misfit = 2.0 * flank.columns * std::max(0.0, levelLevel - level * level / count - both * both / spread);
      if (pen.misfit < best.misfit) best = pen;
    }
    if (best.dark > static_cast<double>(kEndContrast)) pens.push_back(best);
  }
  std::sort(pens.begin(), pens.end(), [](const PenModel& x, const PenModel& y) { return x.misfit < y.misfit; });
  return pens;
}

// The pixels round an end, row by row along the stroke: `columns` of them across, from the middle of the outermost on.
struct EndPatch {
  int rows = 0, columns = 0;
  double firstPx = 0.0;       // along the stroke, from the tip that was first thought
  std::vector<double> level;  // [grey]
  double across(int k) const {
    const int middle = columns / 2;
    return (k - middle) * kEndStepPx;
  }
};

EndPatch patchAt(const EndCourse& end, double tipPx, double radius, const GreyImage& grey) {
  EndPatch patch;
  const int before = static_cast<int>(std::ceil((radius + 1.0) / kEndStepPx));
  patch.rows = before + static_cast<int>(kBesideEndPx / kEndStepPx) + 1;
  patch.columns = 2 * static_cast<int>(std::lround((radius + kBesideEndPx) / kEndStepPx)) + 1;
  patch.firstPx = -before * kEndStepPx;
  for (int i = 0; i < patch.rows; ++i) {
    const double s = tipPx + patch.firstPx + i * kEndStepPx;
    const Vec2 middle = end.position(s), normal = end.normal(s);
    for (int k = 0; k < patch.columns; ++k) {
      const Vec2 at = middle + patch.across(k) * normal;
      patch.level.push_back(static_cast<double>(sampleGrey(grey, at.x(), at.y())));
    }
  }
  return patch;
}

// The places at which the model of an end is evaluated: those of a patch, for every tip that is tried.
class EndPlaces {
 public:
  explicit EndPlaces(const EndPatch& patch)
      : patch_(patch), rows_((patch.rows - 1) * kStepsPerRow + 2 * kTipSteps + 1), columns_(patch.columns) {}
  static constexpr int kStepsPerRow = static_cast<int>(kEndStepPx / kTipStepPx);  // places of the tip from row to row
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  double along(int i) const { return patch_.firstPx + (i - kTipSteps) * kTipStepPx; }
  double across(int k) const { return patch_.across(k); }

 private:
  const EndPatch& patch_;
  int rows_, columns_;
};

// The darkness of an end at its places, column by column. [grey]
using EndModel = std::vector<double>;

// Shares of the darkness inside a cut, by the depth below it. Depths are multiples of kTipStepPx over the same number,
// as all places and the way that a slope makes over a column are: few of them differ.
class CutShares {
 public:
  CutShares(const PenModel& pen, const EndPlaces& places, double slope) {
    const double steepness = std::hypot(1.0, slope);
    const double side = std::abs(slope * places.across(0));
    first_ = stepsOf(-side - places.along(places.rows() - 1));
    const int last = stepsOf(side - places.along(0));
    for (int n = first_; n <= last; ++n) share_.push_back(edgeShare(n * kTipStepPx / steepness / pen.blur));
  }
  double at(double depthPx) const { return share_[stepsOf(depthPx) - first_]; }

 private:
  static_assert(kLessSkewed * kEndStepPx == kTipStepPx);
  static int stepsOf(double px) { return static_cast<int>(px / kTipStepPx); }  // exact
  std::vector<double> share_;
  int first_ = 0;
};

EndModel darkOfCut(const PenModel& pen, const EndPlaces& places, const CutShares& shares, double slope) {
  std::vector<double> whole(places.columns());
  for (int k = 0; k < places.columns(); ++k) whole[k] = pen.dark * pen.across(places.across(k));
  EndModel dark;
  dark.reserve(std::ptrdiff_t{places.rows()} * places.columns());
  for (int k = 0; k < places.columns(); ++k) {
    for (int i = 0; i < places.rows(); ++i)
      dark.push_back(whole[k] * shares.at(slope * places.across(k) - places.along(i)));
  }
  return dark;
}

// sums[k] += the sum of seen[j * columns + k] * reached[j], lane after lane.
BATTEN_HOT_LOOP void addLanes(const double* seen, const double* reached, int lanes, int columns,
                              double* __restrict sums) {
  for (int j = 0; j < lanes; ++j, seen += columns) {
    const double share = reached[j];
    for (int k = 0; k < columns; ++k) sums[k] += seen[k] * share;
  }
}

// A round end is made of lanes along the stroke: what of each is seen depends on the column, and how far it reaches on
// the row.
class RoundLanes {
 public:
  RoundLanes(const PenModel& pen, const EndPlaces& places)
      : pen_(pen), count_(std::max(kFewestLanes, static_cast<int>(std::ceil(kLanesPerBlur * pen.radius / pen.blur)))) {
    lane_ = 2.0 * pen.radius / count_;
    for (int j = 0; j < count_; ++j) {
      for (int k = 0; k < places.columns(); ++k) {
        const double off = (places.across(k) - middleOf(j)) / pen.blur;
        seen_.push_back(std::abs(off) > kFar ? 0.0 : std::exp(-0.5 * off * off));
      }
    }
  }
  EndModel dark(const EndPlaces& places) const {
    const int rows = places.rows(), columns = places.columns();
    EndModel all(std::ptrdiff_t{rows} * columns);
    std::vector<double> reached(count_), sums(columns);
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < count_; ++j) reached[j] = edgeShare((tipOf(j) - places.along(i)) / pen_.blur);
      std::fill(sums.begin(), sums.end(), 0.0);
      addLanes(seen_.data(), reached.data(), count_, columns, sums.data());
      for (int k = 0; k < columns; ++k)
        all[k * rows + i] = pen_.dark * sums[k] * lane_ / (pen_.blur * std::sqrt(2.0 * std::numbers::pi));
    }
    return all;
  }

 private:
  static constexpr int kFewestLanes = 8;        // of a round end, however blurred
  static constexpr double kLanesPerBlur = 4.0;  // of the radius: a lane is half a standard deviation wide
  static constexpr double kFar = 3.5;           // standard deviations: nothing is seen of lanes farther off
  double middleOf(int j) const { return (j + 0.5) * lane_ - pen_.radius; }
  double tipOf(int j) const {
    const double v = middleOf(j);
    return std::sqrt(std::max(0.0, pen_.radius * pen_.radius - v * v)) - pen_.radius;
  }
  const PenModel& pen_;
  int count_;
  double lane_ = 0.0;
  std::vector<double> seen_;  // by lane and column
};

struct FittedEnd {
  double stopPx = 0.0;  // where the pen stopped, from the tip that was first thought
  double misfit = std::numeric_limits<double>::infinity();
};

constexpr int kTips = 2 * kTipSteps + 1, kTipLanes = kTips + 1;  // an even number fills the vectors

// The misfit of every tip, the last first; behind them one that is none. `model` runs on by one number.
BATTEN_HOT_LOOP void addMisfits(const EndPatch& patch, const double* model, int modelRows, double* __restrict misfit) {
  double sums[kTipLanes] = {};
  for (int i = 0; i < patch.rows; ++i) {
    const double* levels = patch.level.data() + std::ptrdiff_t{i} * patch.columns;
    for (int k = 0; k < patch.columns; ++k) {
      const double level = levels[k];
      const double* at = model + std::ptrdiff_t{k} * modelRows + i * EndPlaces::kStepsPerRow;
      for (int tip = 0; tip < kTipLanes; ++tip) sums[tip] += (level - at[tip]) * (level - at[tip]);
    }
  }
  for (int tip = 0; tip < kTipLanes; ++tip) misfit[tip] = sums[tip];
}

// Where an end of this shape fits best.
FittedEnd fittedEnd(const EndPatch& patch, const PenModel& pen, EndModel model) {
  for (double& level : model) level = pen.paper - level;
  const int modelRows = static_cast<int>(std::ssize(model)) / patch.columns;
  model.push_back(0.0);
  std::array<double, kTipLanes> lanes{};
  addMisfits(patch, model.data(), modelRows, lanes.data());
  std::array<double, kTips> misfit{};
  std::reverse_copy(lanes.begin(), lanes.begin() + kTips, misfit.begin());
  const auto best = static_cast<int>(std::min_element(misfit.begin(), misfit.end()) - misfit.begin());
  FittedEnd end{(best - kTipSteps) * kTipStepPx, misfit[best] + pen.misfit};
  if (best == 0 || best == 2 * kTipSteps) return end;
  // The lowest point of the parabola through the best and its neighbours.
  const double fall = misfit[best - 1] - misfit[best], rise = misfit[best + 1] - misfit[best];
  end.stopPx += 0.5 * kTipStepPx * (fall - rise) / (fall + rise);
  end.misfit -= 0.125 * (fall - rise) * (fall - rise) / (fall + rise);
  return end;
}

}  // namespace

std::optional<double> inkEnd(const EndCourse& end, double widthPx, double inside, const GreyImage& grey) {
  const double farthest = inside + kBeyondEndWidths * widthPx + kBeyondEndPx;
  const int samples = static_cast<int>(farthest / kStrokeStepPx) + 1;
  const int lanes = std::max(1, static_cast<int>(std::lround(0.5 * widthPx)));
  std::vector<float> level(samples, 0.0f);
  for (int k = 0; k < samples; ++k) {
    const double s = k * kStrokeStepPx;
    const Vec2 normal = end.normal(s);
    for (int j = -lanes; j <= lanes; ++j) {
      const Vec2 at = end.position(s) + (kMiddleHalf * widthPx * j / lanes) * normal;
      level[k] += sampleGrey(grey, at.x(), at.y()) / static_cast<float>(2 * lanes + 1);
    }
  }
  std::vector<float> inner(level.begin(),
                           level.begin() + std::clamp(static_cast<int>(0.5 * inside / kStrokeStepPx), 1, samples));
  const float ink = upperMedian(inner);
  const float paper = *std::max_element(level.begin(), level.end());
  const float middle = 0.5f * (ink + paper);
  if (!(paper - ink > kEndContrast)) return std::nullopt;
  for (int k = 0; k + 1 < samples; ++k) {
    const float a = level[k], b = level[k + 1];
    if (a < middle && b >= middle) return (k + (middle - a) / (b - a)) * kStrokeStepPx;
  }
  return std::nullopt;
}

std::optional<PenStop> penStop(const EndCourse& end, double widthPx, double tipPx, const GreyImage& grey) {
  const double evenTo = tipPx - 0.5 * widthPx - 1.0;  // so far inside hardly an end shows
  if (evenTo < 2.0 * kEndStepPx) return std::nullopt;
  const Flank flank = flankOf(end, evenTo, 0.5 * widthPx + kBesideEndPx, grey);
  const EndPatch patch = patchAt(end, tipPx, 0.5 * widthPx, grey);
  const EndPlaces places(patch);
  const double independent =
      static_cast<double>(patch.level.size() + 2 * flank.level.size() * flank.columns) / kSamplesPerPx;
  FittedEnd round, cut;
  std::array<FittedEnd, std::size(kCutSlopes)> cuts;
  double leastFlank = 0.0, variance = 0.0;
  for (const PenModel& pen : pensFor(flank, widthPx)) {
    // Thin strokes do not tell their width from their blur; what the flank itself rules out is not tried.
    if (variance == 0.0) leastFlank = pen.misfit;
    if (variance > 0.0 && pen.misfit - leastFlank > 2.0 * kRuledOut * variance) break;
    FittedEnd one = fittedEnd(patch, pen, RoundLanes(pen, places).dark(places));
    one.stopPx -= pen.radius;
    if (one.misfit < round.misfit) round = one;
    const CutShares square(pen, places, 0.0), skewed(pen, places, kLessSkewed), diagonal(pen, places, kMostSkewed);
    for (int k = 0; k < std::ssize(kCutSlopes); ++k) {
      const double slope = kCutSlopes[k], steep = std::abs(slope);
      const CutShares& shares = steep == 0.0 ? square : steep == kLessSkewed ? skewed : diagonal;
      const FittedEnd other = fittedEnd(patch, pen, darkOfCut(pen, places, shares, slope));
      if (other.misfit < cuts[k].misfit) cuts[k] = other;
      if (other.misfit < cut.misfit) cut = other;
    }
    variance = std::max(kLeastEndVariance, std::min(round.misfit, cut.misfit) / independent);
  }
  if (variance == 0.0) return std::nullopt;
  // A cut may be skewed as it likes: the mean over its slopes, or the freedom to choose would speak for it.
  double likely = 0.0;
  for (const FittedEnd& one : cuts) likely += std::exp(0.5 * (cut.misfit - one.misfit) / variance) / std::ssize(cuts);
  const double forCut = 0.5 * (round.misfit - cut.misfit) / variance + std::log(likely);
  return PenStop{tipPx + round.stopPx, tipPx + cut.stopPx, forCut};
}

double PenStop::at(double cutOdds) const {
  constexpr double kCertainly = 50.0;  // [nats]
  const double isCut = 1.0 / (1.0 + std::exp(-std::clamp(forCut + cutOdds, -kCertainly, kCertainly)));
  return std::lerp(roundPx, cutPx, isCut);
}

}  // namespace batten
