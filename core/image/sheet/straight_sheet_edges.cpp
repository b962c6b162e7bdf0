// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/straight_sheet_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "core/base/parallel.h"
#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kDeepestEdge = 0.15;                     // of the picture: edges lie no farther from its side
constexpr double kFirstPlace = 0.12, kLastPlace = 0.88;   // of the side: beyond them the next edge may cross it
constexpr double kMostLean = 0.1;                         // tangent of the angle to the side
constexpr int kAlongStep = 3;                             // cells between two places that are looked at
constexpr int kNoneOf = 2;                                // cells to either side: the edge, its shadow, a line along it
constexpr int kPaperCells = 7;                            // beyond them: what lies on this side of the edge
constexpr int kFewestPaperCells = 2;                      // of them, at the border of the picture
constexpr int kNextDepth = kNoneOf + kPaperCells + 3;     // cells: where the paper goes on without a step
constexpr float kMostStepSeen = 12.0f;                    // [grey] ink and things on the table do not count for more
constexpr float kGreatestStep = 30.0f;                    // [grey] a darker table is told by its cells
constexpr float kLeastStep = 2.5f;                        // [grey] in brightness or tint
constexpr double kLeastShowing = 0.75;                    // of the places show the step
constexpr float kLeastOfStep = 0.4f, kMostOfStep = 2.5f;  // of the step: a place that shows it
constexpr float kLeastOwn = 0.5f;                         // of the step: the rest may be shading
constexpr float kLeastSharp = 0.6f;                       // of the step, within the edge
constexpr int kChannels = 3;                              // brightness and two of tint

// The cells as seen from one side of the picture: `along` it, `deep` into the picture.
struct FromSide {
  const SheetCells& cells;
  int side = 0;  // top, right, bottom, left
  int along() const { return side % 2 == 0 ? cells.columns : cells.rows; }
  int deep() const { return side % 2 == 0 ? cells.rows : cells.columns; }
  cv::Point at(int i, int depth) const {
    switch (side) {
      case 0:
        return {i, depth};
      case 1:
        return {cells.columns - 1 - depth, i};
      case 2:
        return {i, cells.rows - 1 - depth};
      default:
        return {depth, i};
    }
  }
};

// [grey] Steps of brightness and tint across lines parallel to a side, outside less inside, by place along the side,
// then by depth.
struct SideSteps {
  std::vector<int> places;
  int least = kNoneOf + kFewestPaperCells, most = 0;  // depths
  std::vector<cv::Vec3f> steps;                       // of the papers on both sides
  std::vector<cv::Vec3f> brinks;                      // at the very edge
  std::ptrdiff_t index(int place, int depth) const {
    return std::ptrdiff_t{place} * (most - least + 1) + depth - least;
  }
};

// A grey picture has no tint.
int channelsOf(const SheetCells& cells) { return cells.hasTint ? kChannels : 1; }

// Of the cells from one depth to another: lines and things that take less than half of them do not count.
cv::Vec3f medianOf(const FromSide& from, int place, int first, int last) {
  std::array<std::array<float, kPaperCells>, kChannels> values{};
  const int count = std::min(last - first, kPaperCells), channels = channelsOf(from.cells);
  for (int c = 0; c < count; ++c) {
    const cv::Vec3f& cell = from.cells.colour(from.at(place, first + c));
    for (int k = 0; k < channels; ++k) values[k][c] = cell[k];
  }
  cv::Vec3f median(0.0f, 0.0f, 0.0f);
  for (int k = 0; k < channels; ++k) median[k] = upperMedian(std::span(values[k]).first(count));
  return median;
}

SideSteps stepsOf(const FromSide& from) {
  SideSteps out;
  out.most =
      std::min(static_cast<int>(kDeepestEdge * from.deep()), from.deep() - 1 - kNoneOf - kPaperCells) + kNextDepth;
  for (int i = static_cast<int>(kFirstPlace * from.along()); i < kLastPlace * from.along(); i += kAlongStep)
    out.places.push_back(i);
  std::vector<cv::Vec3f> medians(out.most + 1 + kNoneOf + 1);  // of kPaperCells cells, by the first of them
  for (const int i : out.places) {
    for (int first = 0; first < std::ssize(medians); ++first)
      medians[first] = medianOf(from, i, first, first + kPaperCells);
    for (int depth = out.least; depth <= out.most; ++depth) {
      const int before = depth - kNoneOf - kPaperCells;
      const cv::Vec3f outside = before >= 0 ? medians[before] : medianOf(from, i, 0, depth - kNoneOf);
      out.steps.push_back(outside - medians[depth + kNoneOf + 1]);
      out.brinks.push_back(from.cells.colour(from.at(i, depth - kNoneOf)) -
                           from.cells.colour(from.at(i, depth + kNoneOf)));
    }
  }
  return out;
}

struct StraightEdge {
  int first = 0, last = 0;  // depths at the first and the last place
  int channel = 0;
};

int depthAt(const StraightEdge& edge, int place, int places) {
  const double t = places > 1 ? static_cast<double>(place) / (places - 1) : 0.0;
  const double depth = std::lerp(edge.first, edge.last, t);  // never negative
  const int whole = static_cast<int>(depth);
  return depth - whole < 0.5 ? whole : whole + 1;
}

// [grey] The median step along a line `farther` cells deeper than the edge. Absent: that is not in the picture.
std::optional<float> medianStep(const StraightEdge& edge, const SideSteps& steps, int farther) {
  const int n = static_cast<int>(steps.places.size());
  std::vector<float> values;
  for (int p = 0; p < n; ++p) {
    const int depth = depthAt(edge, p, n) + farther;
    if (depth < steps.least || depth > steps.most) return std::nullopt;
    values.push_back(steps.steps[steps.index(p, depth)][edge.channel]);
  }
  return upperMedian(values);
}

// Whether most places along the edge show the same step: ink that crosses it or runs along it shows greater ones, or
// none.
bool isAllAlong(const StraightEdge& edge, const SideSteps& steps, float step) {
  const int n = static_cast<int>(steps.places.size());
  int showing = 0;
  for (int p = 0; p < n; ++p) {
    const float share = steps.steps[steps.index(p, depthAt(edge, p, n))][edge.channel] / step;
    showing += share >= kLeastOfStep && share <= kMostOfStep ? 1 : 0;
  }
  return showing >= kLeastShowing * n;
}

// Whether the step is done within the edge itself: shading takes longer.
bool isSharp(const StraightEdge& edge, const SideSteps& steps, float step) {
  const int n = static_cast<int>(steps.places.size());
  std::vector<float> shares;
  for (int p = 0; p < n; ++p) {
    const int depth = depthAt(edge, p, n);
    float best = 0.0f;
    for (int d = std::max(steps.least, depth - 1); d <= std::min(steps.most, depth + 1); ++d)
      best = std::max(best, steps.brinks[steps.index(p, d)][edge.channel] / step);
    shares.push_back(best);
  }
  return upperMedian(shares) >= kLeastSharp;
}

bool isSheetEdge(const StraightEdge& edge, const SideSteps& steps) {
  const float step = medianStep(edge, steps, 0).value_or(0.0f);
  if (std::fabs(step) < kLeastStep || std::fabs(step) > kGreatestStep || !isAllAlong(edge, steps, step) ||
      !isSharp(edge, steps, step))
    return false;
  if (medianStep({edge.first, edge.last, 0}, steps, 0).value_or(0.0f) >= kSolidContrast) return false;
  // Shading goes on a little farther in and out, and changes its slope slowly.
  const std::optional<float> outer = medianStep(edge, steps, -kNextDepth), inner = medianStep(edge, steps, kNextDepth);
  const float beside = outer && inner ? 0.5f * (*outer + *inner) : inner.value_or(0.0f);
  const float own = std::fabs(step) - std::max(0.0f, step > 0.0f ? beside : -beside);
  return own >= std::max(kLeastStep, kLeastOwn * std::fabs(step));
}

// Whether steps of one sign, however they lie, are great enough at as many places as isSheetEdge() asks for: on most
// pages they are not, and no line need be tried.
bool mayShowEdge(const SideSteps& steps, int channel) {
  constexpr float kRounding = 0.99f;  // of what is asked for: more than rounding takes
  const int n = static_cast<int>(steps.places.size()), last = steps.most - kNextDepth;
  for (const float sign : {-1.0f, 1.0f}) {
    int great = 0, showing = 0;
    for (int p = 0; p < n; ++p) {
      float most = 0.0f;
      for (int depth = steps.least; depth <= last; ++depth)
        most = std::max(most, sign * steps.steps[steps.index(p, depth)][channel]);
      great += most >= kRounding * kLeastStep ? 1 : 0;
      showing += most >= kRounding * kLeastOfStep * kLeastStep ? 1 : 0;
    }
    // No fewer than half of all values are as great as their upper median.
    if (2 * great >= n && showing >= kLeastShowing * n) return true;
  }
  return false;
}

std::optional<StraightEdge> straightEdge(const SideSteps& steps, int along, int channels) {
  const int n = static_cast<int>(steps.places.size());
  bool mayShow = false;
  for (int k = 0; k < channels; ++k) mayShow = mayShow || mayShowEdge(steps, k);
  if (!mayShow) return std::nullopt;
  const int lean = static_cast<int>(kMostLean * along), most = steps.most - kNextDepth;
  StraightEdge best;
  float greatest = 0.0f;
  for (int first = steps.least; first <= most; ++first) {
    for (int last = std::max(steps.least, first - lean); last <= std::min(most, first + lean); ++last) {
      const StraightEdge line{first, last, 0};
      cv::Vec3f sum(0.0f, 0.0f, 0.0f);
      for (int p = 0; p < n; ++p) {
        const std::ptrdiff_t at = steps.index(p, depthAt(line, p, n));
        for (int k = 0; k < channels; ++k)
          sum[k] += std::clamp(steps.steps[at][k], -kMostStepSeen, kMostStepSeen) +
                    std::clamp(steps.brinks[at][k], -kMostStepSeen, kMostStepSeen);
      }
      for (int k = 0; k < channels; ++k) {
        if (std::fabs(sum[k]) <= greatest) continue;
        greatest = std::fabs(sum[k]);
        best = {first, last, k};
      }
    }
  }
  if (!(greatest > 0.0f) || !isSheetEdge(best, steps)) return std::nullopt;
  return best;
}

}  // namespace

std::vector<cv::Mat1b> beyondSheetEdges(const SheetCells& cells, const RunContext& context) {
  std::array<std::optional<cv::Mat1b>, 4> sides;
  parallelFor(context, 4, 1, [&](int side, int) {
    const FromSide from{cells, side};
    const SideSteps steps = stepsOf(from);
    const std::optional<StraightEdge> edge = straightEdge(steps, from.along(), channelsOf(cells));
    if (!edge) return;
    const double slope = (edge->last - edge->first) / std::max(1.0, 1.0 * (steps.places.back() - steps.places.front()));
    cv::Mat1b beyond(cells.rows, cells.columns, static_cast<unsigned char>(0));
    for (int i = 0; i < from.along(); ++i) {
      const double end = edge->first + slope * (i - steps.places.front());
      for (int depth = 0; depth <= std::min(end, from.deep() - 1.0); ++depth) beyond(from.at(i, depth)) = 255;
    }
    sides[side] = std::move(beyond);
  });
  std::vector<cv::Mat1b> found;
  for (std::optional<cv::Mat1b>& beyond : sides)
    if (beyond) found.push_back(std::move(*beyond));
  return found;
}

}  // namespace batten
