// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/stroke_mean.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "core/base/parallel.h"
#include "core/contour/polyline_tools.h"

namespace batten {
namespace {

constexpr int kMeanRounds = 3;
constexpr int kMeansPerBlock = 256;
constexpr double kParallelCos = 0.985;  // 10 degrees: fully one line
constexpr double kCrossingCos = 0.906;  // 25 degrees: another line
constexpr double kLeastWeight = 0.02;   // at the very end of a stroke: alone it still is the line

double smoothStep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// All points in cells as wide as the distance.
class Cells {
 public:
  Cells(const std::vector<MeanLine>& lines, double size) : size_(size) {
    for (std::size_t l = 0; l < lines.size(); ++l)
      for (std::size_t i = 0; i < lines[l].points.size(); ++i)
        cells_[key(cellOf(lines[l].points[i].x()), cellOf(lines[l].points[i].y()))].push_back(
            {static_cast<int>(l), static_cast<int>(i)});
  }
  template <class Visit>
  void around(const Vec2& at, const Visit& visit) const {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto found = cells_.find(key(cellOf(at.x()) + dx, cellOf(at.y()) + dy));
        if (found == cells_.end()) continue;
        for (const auto& place : found->second) visit(place);
      }
  }

 private:
  int cellOf(double v) const { return static_cast<int>(std::floor(v / size_)); }
  static std::int64_t key(int x, int y) { return (static_cast<std::int64_t>(y) << 32) ^ (x & 0xffffffffLL); }
  double size_;
  std::unordered_map<std::int64_t, std::vector<MeanLine::Source>> cells_;
};

// A stroke that crosses the normal of a point.
struct Crossing {
  int line = 0;
  double offset = 0.0, weight = 0.0;
};

class MeanRound {
 public:
  MeanRound(const std::vector<MeanLine>& lines, double distance)
      : lines_(lines), distance_(distance), cells_(lines, distance) {}

  // How far the point moves along its left normal.
  void measure(std::size_t line, std::size_t index, std::vector<Crossing>& crossings, float& shift) const {
    const MeanLine& here = lines_[line];
    const Vec2 &at = here.points[index], &t = here.tangent[index];
    const Vec2 n = leftNormal(t);
    crossings.clear();
    cells_.around(at, [&](const MeanLine::Source& place) {
      const MeanLine& other = lines_[static_cast<std::size_t>(place.line)];
      const auto k = static_cast<std::size_t>(place.index);
      const Vec2 d = other.points[k] - at;
      const double along = d.dot(t);
      if (std::abs(along) > 0.8) return;
      if (place.line == static_cast<int>(line) && isNear(here, index, k)) return;
      const Vec2& to = other.tangent[k];
      const double cosine = std::abs(to.dot(t));
      if (cosine < kCrossingCos) return;
      const double offset = d.dot(n) - along * to.dot(n) / to.dot(t);
      if (std::abs(offset) >= distance_) return;
      const double weight = endWeight(other, k) * smoothStep((cosine - kCrossingCos) / (kParallelCos - kCrossingCos)) *
                            smoothStep((1.0 - std::abs(offset) / distance_) / 0.3);
      for (Crossing& c : crossings) {
        if (c.line != place.line) continue;
        if (std::abs(offset) < std::abs(c.offset)) c = {place.line, offset, weight};
        return;
      }
      crossings.push_back({place.line, offset, weight});
    });
    // In a fixed order, so that sums come out the same whatever the order of the cells.
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.line < b.line; });
    double sum = 0.0, weights = std::max(kLeastWeight, endWeight(here, index));
    for (const Crossing& c : crossings) {
      sum += c.weight * c.offset;
      weights += c.weight;
    }
    shift = static_cast<float>(sum / weights);
  }

 private:
  bool isNear(const MeanLine& line, std::size_t a, std::size_t b) const {
    const auto n = line.points.size();
    std::size_t apart = a > b ? a - b : b - a;
    if (line.closed) apart = std::min(apart, n - apart);
    return static_cast<double>(apart) < 4.0 * distance_ + 10.0;
  }

  // 0 at an open end, 1 from two distances (or a third of the stroke) on.
  double endWeight(const MeanLine& line, std::size_t index) const {
    if (line.closed) return 1.0;
    const auto n = line.points.size();
    const double toEnd = static_cast<double>(std::min(index, n - 1 - index));
    return smoothStep(toEnd / std::max(1.0, std::min(2.0 * distance_, static_cast<double>(n) / 3.0)));
  }

  const std::vector<MeanLine>& lines_;
  double distance_;
  Cells cells_;
};

}  // namespace

std::vector<MeanLine> moveToMean(const std::vector<Contour>& lines, double distancePx, const RunContext& context) {
  std::vector<MeanLine> means(lines.size());
  for (std::size_t l = 0; l < lines.size(); ++l) {
    means[l].points = lines[l].points;
    means[l].closed = lines[l].closed;
    means[l].tangent = directions(lines[l].points, lines[l].closed, 3);
    for (std::size_t i = 0; i < lines[l].points.size(); ++i)
      means[l].source.push_back({static_cast<int>(l), static_cast<int>(i)});
  }
  std::vector<MeanLine::Source> all;
  for (const MeanLine& m : means) all.insert(all.end(), m.source.begin(), m.source.end());
  // [points] A mean changes over about the distance of the strokes.
  const double smoothing = std::clamp(0.5 * distancePx, 3.0, 8.0);
  for (int round = 0; round < kMeanRounds && !context.isCancelled(); ++round) {
    const MeanRound measure(means, std::max(1.0, distancePx));
    std::vector<float> shift(all.size());
    parallelFor(context, static_cast<int>(all.size()), kMeansPerBlock, [&](int begin, int end) {
      std::vector<Crossing> crossings;
      for (int i = begin; i < end; ++i) {
        const auto at = static_cast<std::size_t>(i);
        measure.measure(static_cast<std::size_t>(all[at].line), static_cast<std::size_t>(all[at].index), crossings,
                        shift[at]);
      }
    });
    if (context.isCancelled()) break;
    std::size_t first = 0;
    for (MeanLine& m : means) {
      const auto n = m.points.size();
      const std::vector<float> own(shift.begin() + static_cast<std::ptrdiff_t>(first),
                                   shift.begin() + static_cast<std::ptrdiff_t>(first + n));
      const std::vector<float> smooth = smoothValues(own, m.closed, smoothing);
      for (std::size_t i = 0; i < n; ++i) {
        m.points[i] += static_cast<double>(smooth[i]) * leftNormal(m.tangent[i]);
      }
      m.tangent = directions(m.points, m.closed, 3);
      first += n;
    }
  }
  return means;
}

struct StrokesBeside::Parts {
  std::vector<MeanLine> lines;
  double distance = 0.0;
  std::optional<Cells> cells;
};

StrokesBeside::StrokesBeside(const std::vector<Contour>& lines, double distancePx) : parts_(std::make_unique<Parts>()) {
  for (const Contour& line : lines) {
    MeanLine stroke;
    stroke.points = line.points;
    stroke.tangent = directions(line.points, line.closed, 3);
    parts_->lines.push_back(std::move(stroke));
  }
  parts_->distance = std::max(1.0, distancePx);
  parts_->cells.emplace(parts_->lines, parts_->distance);
}

StrokesBeside::~StrokesBeside() = default;

StrokeBand StrokesBeside::band(const std::vector<Vec2>& points, bool closed, const RunContext& context) const {
  constexpr double kAlongPx = 1.5, kOneStrokePx = 1.0;
  const std::vector<Vec2> tangent = directions(points, closed, 3);
  StrokeBand band{std::vector<float>(points.size()), std::vector<float>(points.size())};
  const auto measure = [&](std::size_t i) {
    const Vec2 n = leftNormal(tangent[i]);
    double low = 0.0, high = 0.0;
    parts_->cells->around(points[i], [&](const MeanLine::Source& place) {
      const MeanLine& other = parts_->lines[static_cast<std::size_t>(place.line)];
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
    band.left[i] = static_cast<float>(high);
    band.right[i] = static_cast<float>(-low);
  };
  parallelFor(context, static_cast<int>(points.size()), kMeansPerBlock, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) measure(static_cast<std::size_t>(i));
  });
  return band;
}

}  // namespace batten
