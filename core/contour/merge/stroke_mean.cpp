// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/stroke_mean.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/polyline/point_grid.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kMeanRounds = 3;
constexpr int kMeansPerBlock = 256;
constexpr double kParallelCos = 0.985;  // 10 degrees: fully one line
constexpr double kCrossingCos = 0.906;  // 25 degrees: another line
constexpr double kLeastWeight = 0.02;   // at the very end of a stroke: alone it still is the line

constexpr double kNearContactGap = 2.0;  // distances: nearer stretches beside a stroke are one
constexpr double kSameShare = 0.5;       // of the shorter stroke: beside each other for longer they are one line

double smoothStep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// All points in cells as wide as the distance.
using Cells = PointGrid<MeanLine::Source>;

Cells cellsOf(const std::vector<MeanLine>& lines, double sizePx) {
  Cells cells(sizePx);
  for (int l = 0; l < static_cast<int>(lines.size()); ++l) {
    const auto& points = lines[l].points;
    for (std::size_t i = 0; i < points.size(); ++i) cells.add(points[i], {l, static_cast<int>(i)});
  }
  return cells;
}

// Stretches of two strokes that come near each other and part again.
struct NearContact {
  int from = 0, to = 0, other = 0;
};
using NearContacts = std::vector<std::vector<NearContact>>;  // by line

// A stroke that crosses the normal of a point.
struct Crossing {
  int line = 0, index = 0;
  double offset = 0.0, weight = 0.0;
};

class MeanRound {
 public:
  MeanRound(const std::vector<MeanLine>& lines, double distance, const NearContacts& kisses)
      : lines_(lines), distance_(distance), cells_(cellsOf(lines, distance)), kisses_(kisses) {}

  // The strokes beside a point, in a fixed order, so that sums come out the same whatever the order of the cells.
  void find(std::size_t line, std::size_t index, std::vector<Crossing>& crossings) const {
    const MeanLine& here = lines_[line];
    const Vec2 &at = here.points[index], &t = here.tangent[index];
    const Vec2 n = leftNormal(t);
    crossings.clear();
    cells_.around(at, [&](const MeanLine::Source& place) {
      const MeanLine& other = lines_[place.line];
      const auto k = static_cast<std::size_t>(place.index);
      const Vec2 d = other.points[k] - at;
      const double along = d.dot(t);
      if (std::abs(along) > 0.8) return;
      if (place.line == static_cast<int>(line) && isNear(here, index, k)) return;
      const Vec2& to = other.tangent[k];
      const double cosine = std::abs(to.dot(t));
      if (cosine < kCrossingCos) return;
      const double offset = d.dot(n) - along * to.dot(n) / to.dot(t);
      if (std::abs(offset) >= distance_ || isNearContact(line, index, place.line)) return;
      const double weight = static_cast<double>(other.weight[k]) * endWeight(other, k) *
                            smoothStep((cosine - kCrossingCos) / (kParallelCos - kCrossingCos)) *
                            smoothStep((1.0 - std::abs(offset) / distance_) / 0.3);
      const Crossing found{place.line, place.index, offset, weight};
      for (Crossing& c : crossings) {
        if (c.line != place.line) continue;
        if (std::abs(offset) < std::abs(c.offset)) c = found;
        return;
      }
      crossings.push_back(found);
    });
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.line < b.line; });
  }

  // How far the point moves along its left normal, and the weight of all strokes there.
  std::pair<float, float> shift(std::size_t line, std::size_t index, std::vector<Crossing>& crossings) const {
    find(line, index, crossings);
    const double own = static_cast<double>(lines_[line].weight[index]);
    double sum = 0.0, weights = own * std::max(kLeastWeight, endWeight(lines_[line], index)), all = own;
    for (const Crossing& c : crossings) {
      sum += c.weight * c.offset;
      weights += c.weight;
      all += c.weight;
    }
    return {static_cast<float>(sum / weights), static_cast<float>(all)};
  }

 private:
  bool isNear(const MeanLine& line, std::size_t a, std::size_t b) const {
    const auto n = line.points.size();
    std::size_t apart = a > b ? a - b : b - a;
    if (line.closed) apart = std::min(apart, n - apart);
    return static_cast<double>(apart) < 4.0 * distance_ + 10.0;
  }

  bool isNearContact(std::size_t line, std::size_t index, int other) const {
    if (kisses_.empty()) return false;
    const auto i = static_cast<int>(index);
    return std::any_of(kisses_[line].begin(), kisses_[line].end(),
                       [&](const NearContact& k) { return k.other == other && i >= k.from && i <= k.to; });
  }

  // 0 at an open end, 1 from two distances (or a third of the stroke) on.
  double endWeight(const MeanLine& line, std::size_t index) const {
    if (line.closed) return 1.0;
    const auto n = line.points.size();
    std::size_t points = n;
    if (!line.continues[0]) points = std::min(points, index);
    if (!line.continues[1]) points = std::min(points, n - 1 - index);
    const auto toEnd = static_cast<double>(points);
    return smoothStep(toEnd / std::max(1.0, std::min(2.0 * distance_, static_cast<double>(n) / 3.0)));
  }

  const std::vector<MeanLine>& lines_;
  double distance_;
  Cells cells_;
  const NearContacts& kisses_;
};

// A stretch of a stroke beside another.
struct Beside {
  int other = 0, from = 0, to = 0;  // points of the stroke
  int otherFrom = 0, otherTo = 0;   // and of the other there
};

// Where strokes come near each other and part again on both sides, though both go on.
NearContacts findNearContacts(const std::vector<MeanLine>& strokes, double distance, const RunContext& context) {
  const NearContacts none;
  const MeanRound round(strokes, distance, none);
  const int gap = static_cast<int>(kNearContactGap * distance), nearEnd = static_cast<int>(distance);
  std::vector<std::vector<Beside>> stretches(strokes.size());
  parallelFor(context, static_cast<int>(strokes.size()), 1, [&](int begin, int end) {
    std::vector<Crossing> crossings;
    for (int l = begin; l < end && !context.isCancelled(); ++l) {
      auto& mine = stretches[l];
      for (int i = 0; i < static_cast<int>(strokes[l].points.size()); ++i) {
        if ((i & 1023) == 0 && context.isCancelled()) return;
        round.find(static_cast<std::size_t>(l), static_cast<std::size_t>(i), crossings);
        for (const Crossing& c : crossings) {
          const auto open = std::find_if(mine.rbegin(), mine.rend(), [&](const Beside& b) {
            return b.other == c.line && i - b.to <= gap && std::abs(c.index - b.otherTo) <= 2 * gap;
          });
          if (open == mine.rend()) {
            mine.push_back({c.line, i, i, c.index, c.index});
          } else {
            open->to = i;
            open->otherTo = c.index;
          }
        }
      }
    }
  });
  NearContacts kisses(strokes.size());
  if (context.isCancelled()) return kisses;
  for (std::size_t l = 0; l < strokes.size(); ++l) {
    for (const Beside& b : stretches[l]) {
      const MeanLine &a = strokes[l], &o = strokes[b.other];
      const int n = static_cast<int>(a.points.size()), m = static_cast<int>(o.points.size());
      const auto ends = [&](int i, int k) {
        return (!a.closed && std::min(i, n - 1 - i) <= nearEnd) || (!o.closed && std::min(k, m - 1 - k) <= nearEnd);
      };
      if (ends(b.from, b.otherFrom) || ends(b.to, b.otherTo)) continue;
      if (b.to - b.from >= static_cast<int>(kSameShare * std::min(n, m))) continue;
      kisses[l].push_back({b.from, b.to, b.other});
      kisses[b.other].push_back(
          {std::min(b.otherFrom, b.otherTo), std::max(b.otherFrom, b.otherTo), static_cast<int>(l)});
    }
  }
  return kisses;
}

}  // namespace

void moveToMean(std::vector<MeanLine>& means, double distancePx, const RunContext& context) {
  std::vector<MeanLine::Source> all;
  for (int l = 0; l < static_cast<int>(means.size()); ++l)
    for (int i = 0; i < static_cast<int>(means[l].points.size()); ++i) all.push_back({l, i});
  const NearContacts kisses = findNearContacts(means, std::max(1.0, distancePx), context);
  // [points] A mean changes over about the distance of the strokes.
  const double smoothing = std::clamp(0.5 * distancePx, 3.0, 8.0);
  for (int round = 0; round < kMeanRounds && !context.isCancelled(); ++round) {
    const MeanRound measure(means, std::max(1.0, distancePx), kisses);
    std::vector<std::pair<float, float>> shift(all.size());
    parallelFor(context, static_cast<int>(all.size()), kMeansPerBlock, [&](int begin, int end) {
      std::vector<Crossing> crossings;
      for (int i = begin; i < end; ++i) {
        const auto at = static_cast<std::size_t>(i);
        shift[at] =
            measure.shift(static_cast<std::size_t>(all[at].line), static_cast<std::size_t>(all[at].index), crossings);
      }
    });
    if (context.isCancelled()) break;
    std::size_t first = 0;
    for (MeanLine& m : means) {
      const auto n = m.points.size();
      std::vector<float> own;
      for (std::size_t i = 0; i < n; ++i) own.push_back(shift[first + i].first);
      const std::vector<float> smooth = smoothValues(own, m.closed, smoothing);
      for (std::size_t i = 0; i < n; ++i) {
        m.points[i] += static_cast<double>(smooth[i]) * leftNormal(m.tangent[i]);
      }
      m.tangent = directions(m.points, m.closed, 3);
      if (round + 1 == kMeanRounds)
        for (std::size_t i = 0; i < n; ++i) m.weight[i] = shift[first + i].second;
      first += n;
    }
  }
}

struct StrokesBeside::Parts {
  std::vector<MeanLine> lines;
  double distance = 0.0;
  std::optional<Cells> cells;
};

StrokesBeside::StrokesBeside(const std::vector<Contour>& lines, double distancePx) : parts_(std::make_unique<Parts>()) {
  for (const Contour& line : lines) {
    MeanLine stroke;
    stroke.points = positionsOf(line.points);
    stroke.tangent = directions(stroke.points, line.closed, 3);
    stroke.closed = line.closed;
    parts_->lines.push_back(std::move(stroke));
  }
  parts_->distance = std::max(1.0, distancePx);
  parts_->cells = cellsOf(parts_->lines, parts_->distance);
}

StrokesBeside::~StrokesBeside() = default;

bool StrokesBeside::isNear(const Vec2& at, int line, int index) const {
  bool near = false;
  parts_->cells->around(at, [&](const MeanLine::Source& place) {
    const MeanLine& other = parts_->lines[place.line];
    const auto n = static_cast<int>(other.points.size());
    int apart = std::abs(place.index - index);
    if (other.closed) apart = std::min(apart, n - apart);
    if (place.line == line && apart < 4.0 * parts_->distance + 10.0) return;
    near = near || (other.points[place.index] - at).norm() <= parts_->distance;
  });
  return near;
}

std::vector<StrokeBand> StrokesBeside::band(const std::vector<Vec2>& points, bool closed,
                                            const RunContext& context) const {
  constexpr double kAlongPx = 1.5, kOneStrokePx = 1.0;
  const std::vector<Vec2> tangent = directions(points, closed, 3);
  std::vector<StrokeBand> band(points.size());
  const auto measure = [&](std::size_t i) {
    const Vec2 n = leftNormal(tangent[i]);
    double low = 0.0, high = 0.0;
    parts_->cells->around(points[i], [&](const MeanLine::Source& place) {
      const MeanLine& other = parts_->lines[place.line];
      const auto k = static_cast<std::size_t>(place.index);
      const Vec2 d = other.points[k] - points[i];
      const double offset = d.dot(n);
      if (std::abs(d.dot(tangent[i])) > kAlongPx || std::abs(offset) >= parts_->distance) return;
      if (std::abs(other.tangent[k].dot(tangent[i])) < kCrossingCos) return;
      low = std::min(low, offset);
      high = std::max(high, offset);
    });
    // The points of one stroke scatter by less.
    if (high - low <= kOneStrokePx) return;
    band[i] = {static_cast<float>(high), static_cast<float>(-low)};
  };
  parallelFor(context, static_cast<int>(points.size()), kMeansPerBlock, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) measure(static_cast<std::size_t>(i));
  });
  return band;
}

}  // namespace batten
