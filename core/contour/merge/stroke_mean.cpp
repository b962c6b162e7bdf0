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

constexpr int kMeanRounds = 3;          // beside a place that moved lie other strokes
constexpr int kMeansPerBlock = 256;     // worked on together; the result does not depend on it
constexpr int kPointsPerCheck = 1024;   // looked at between two looks at the cancel token
constexpr double kParallelCos = 0.985;  // 10 degrees: fully one line
constexpr double kCrossingCos = 0.906;  // 25 degrees: another line
constexpr double kLeastWeight = 0.02;   // at the very end of a stroke: alone it still is the line

constexpr double kSameNormalPx = 0.8;  // along a line, whose points are about 1 px apart: so near lies on the normal
constexpr double kFadingShare = 0.3;   // of the distance, in which the weight of a stroke falls to nothing
constexpr double kEndDistances = 2.0;  // distances before the end of a stroke from which on its weight falls …
constexpr double kEndParts = 3.0;      // … or a stroke's length over this, so that the middle of a short one keeps it
constexpr double kOwnWayDistances = 4.0, kOwnWayPoints = 10.0;  // along a line before it can lie beside itself
constexpr int kMeanTangentReach = 3;                            // points to either side
constexpr double kMeanSmoothing = 0.5;                          // of the distance: a mean changes over about as much
constexpr double kLeastMeanSigma = 3.0, kMostMeanSigma = 8.0;   // points

constexpr double kNearContactGap = 2.0;  // distances: nearer stretches beside a stroke are one
constexpr double kSameShare = 0.5;       // of the shorter stroke: beside each other for longer they are one line

double smoothStep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// All points in cells as wide as the distance.
using Cells = PointGrid<MeanPoint::Source>;

Cells cellsOf(const std::vector<MeanLine>& lines, double sizePx) {
  Cells cells(sizePx);
  for (int l = 0; l < static_cast<int>(lines.size()); ++l) {
    for (int i = 0; i < lines[l].count(); ++i) cells.add(lines[l].points[i].at, {l, i});
  }
  return cells;
}

// Stretches of two strokes that come near each other and part again.
struct NearContact {
  int from = 0, to = 0, other = 0;
};
using NearContacts = std::vector<std::vector<NearContact>>;  // by line

// A stroke that crosses the normal of a point.
struct CrossedStroke {
  int line = 0, index = 0;
  double offset = 0.0, weight = 0.0;
};

// How far a point moves, and the weight of all strokes there.
struct MeanShift {
  float shift = 0.0f, weight = 0.0f;
};

// Points of one line that are so near along it that they are no neighbours beside it.
bool isSamePlace(const MeanLine& line, int a, int b, double distance) {
  int apart = std::abs(a - b);
  if (line.closed) apart = std::min(apart, line.count() - apart);
  return apart < kOwnWayDistances * distance + kOwnWayPoints;
}

class MeanRound {
 public:
  MeanRound(const std::vector<MeanLine>& lines, double distance, const NearContacts& contacts)
      : lines_(lines), distance_(distance), cells_(cellsOf(lines, distance)), contacts_(contacts) {}

  // The strokes beside a point, in a fixed order, so that sums come out the same whatever the order of the cells.
  void find(int line, int index, std::vector<CrossedStroke>& crossings) const {
    const MeanLine& here = lines_[line];
    const Vec2 &at = here.points[index].at, &t = here.points[index].tangent;
    const Vec2 n = leftNormal(t);
    crossings.clear();
    cells_.around(at, [&](const MeanPoint::Source& place) {
      const MeanLine& other = lines_[place.line];
      const MeanPoint& there = other.points[place.index];
      const Vec2 d = there.at - at;
      const double along = d.dot(t);
      if (std::abs(along) > kSameNormalPx) return;
      if (place.line == line && isNear(here, index, place.index)) return;
      const Vec2& to = there.tangent;
      const double cosine = std::abs(to.dot(t));
      if (cosine < kCrossingCos) return;
      const double offset = d.dot(n) - along * to.dot(n) / to.dot(t);
      if (std::abs(offset) >= distance_ || isNearContact(line, index, place.line)) return;
      const double weight = static_cast<double>(there.weight) * endWeight(other, place.index) *
                            smoothStep((cosine - kCrossingCos) / (kParallelCos - kCrossingCos)) *
                            smoothStep((1.0 - std::abs(offset) / distance_) / kFadingShare);
      const CrossedStroke found{place.line, place.index, offset, weight};
      for (CrossedStroke& c : crossings) {
        if (c.line != place.line) continue;
        if (std::abs(offset) < std::abs(c.offset)) c = found;
        return;
      }
      crossings.push_back(found);
    });
    std::sort(crossings.begin(), crossings.end(),
              [](const CrossedStroke& a, const CrossedStroke& b) { return a.line < b.line; });
  }

  // How far the point moves along its left normal, and the weight of all strokes there.
  MeanShift shift(int line, int index, std::vector<CrossedStroke>& crossings) const {
    find(line, index, crossings);
    const double own = static_cast<double>(lines_[line].points[index].weight);
    double sum = 0.0, weights = own * std::max(kLeastWeight, endWeight(lines_[line], index)), all = own;
    for (const CrossedStroke& c : crossings) {
      sum += c.weight * c.offset;
      weights += c.weight;
      all += c.weight;
    }
    return {static_cast<float>(sum / weights), static_cast<float>(all)};
  }

 private:
  bool isNear(const MeanLine& line, int a, int b) const { return isSamePlace(line, a, b, distance_); }

  bool isNearContact(int line, int index, int other) const {
    if (contacts_.empty()) return false;
    return std::any_of(contacts_[line].begin(), contacts_[line].end(),
                       [&](const NearContact& k) { return k.other == other && index >= k.from && index <= k.to; });
  }

  // 0 at an open end, 1 from kEndDistances (or a third of the stroke) on.
  double endWeight(const MeanLine& line, int index) const {
    if (line.closed) return 1.0;
    const int n = line.count();
    int toEnd = n;
    if (!line.continues[0]) toEnd = std::min(toEnd, index);
    if (!line.continues[1]) toEnd = std::min(toEnd, n - 1 - index);
    return smoothStep(toEnd / std::max(1.0, std::min(kEndDistances * distance_, n / kEndParts)));
  }

  const std::vector<MeanLine>& lines_;
  double distance_;
  Cells cells_;
  const NearContacts& contacts_;
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
    std::vector<CrossedStroke> crossings;
    for (int l = begin; l < end && !context.isCancelled(); ++l) {
      auto& mine = stretches[l];
      for (int i = 0; i < strokes[l].count(); ++i) {
        if (i % kPointsPerCheck == 0 && context.isCancelled()) return;
        round.find(l, i, crossings);
        for (const CrossedStroke& c : crossings) {
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
  NearContacts contacts(strokes.size());
  if (context.isCancelled()) return contacts;
  for (int l = 0; l < std::ssize(strokes); ++l) {
    for (const Beside& b : stretches[l]) {
      const MeanLine &a = strokes[l], &o = strokes[b.other];
      const int n = a.count(), m = o.count();
      const auto ends = [&](int i, int k) {
        return (!a.closed && std::min(i, n - 1 - i) <= nearEnd) || (!o.closed && std::min(k, m - 1 - k) <= nearEnd);
      };
      if (ends(b.from, b.otherFrom) || ends(b.to, b.otherTo)) continue;
      if (b.to - b.from >= static_cast<int>(kSameShare * std::min(n, m))) continue;
      contacts[l].push_back({b.from, b.to, b.other});
      contacts[b.other].push_back({std::min(b.otherFrom, b.otherTo), std::max(b.otherFrom, b.otherTo), l});
    }
  }
  return contacts;
}

}  // namespace

std::vector<Vec2> positionsOf(const MeanLine& line) {
  std::vector<Vec2> at;
  at.reserve(line.points.size());
  for (const MeanPoint& p : line.points) at.push_back(p.at);
  return at;
}

void setPositions(MeanLine& line, const std::vector<Vec2>& positionsPx) {
  const std::vector<Vec2> tangent = directions(positionsPx, line.closed, kMeanTangentReach);
  for (int i = 0; i < line.count(); ++i) {
    line.points[i].at = positionsPx[i];
    line.points[i].tangent = tangent[i];
  }
}

void moveToMean(std::vector<MeanLine>& means, double distancePx, const RunContext& context) {
  std::vector<MeanPoint::Source> all;
  for (int l = 0; l < std::ssize(means); ++l)
    for (int i = 0; i < means[l].count(); ++i) all.push_back({l, i});
  const NearContacts contacts = findNearContacts(means, std::max(1.0, distancePx), context);
  // [points] A mean changes over about the distance of the strokes.
  const double smoothing = std::clamp(kMeanSmoothing * distancePx, kLeastMeanSigma, kMostMeanSigma);
  for (int round = 0; round < kMeanRounds && !context.isCancelled(); ++round) {
    const MeanRound measure(means, std::max(1.0, distancePx), contacts);
    std::vector<MeanShift> shift(all.size());
    parallelFor(context, static_cast<int>(all.size()), kMeansPerBlock, [&](int begin, int end) {
      std::vector<CrossedStroke> crossings;
      for (int i = begin; i < end; ++i) shift[i] = measure.shift(all[i].line, all[i].index, crossings);
    });
    if (context.isCancelled()) break;
    int first = 0;
    for (MeanLine& m : means) {
      const int n = m.count();
      std::vector<float> own;
      own.reserve(n);
      for (int i = 0; i < n; ++i) own.push_back(shift[first + i].shift);
      const std::vector<float> smooth = smoothValues(own, m.closed, smoothing);
      std::vector<Vec2> moved = positionsOf(m);
      for (int i = 0; i < n; ++i) moved[i] += static_cast<double>(smooth[i]) * leftNormal(m.points[i].tangent);
      setPositions(m, moved);
      if (round + 1 == kMeanRounds)
        for (int i = 0; i < n; ++i) m.points[i].weight = shift[first + i].weight;
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
    stroke.closed = line.closed;
    stroke.points.resize(line.points.size());
    setPositions(stroke, positionsOf(line.points));
    parts_->lines.push_back(std::move(stroke));
  }
  parts_->distance = std::max(1.0, distancePx);
  parts_->cells = cellsOf(parts_->lines, parts_->distance);
}

StrokesBeside::~StrokesBeside() = default;

bool StrokesBeside::isNear(const Vec2& at, int line, int index) const {
  bool near = false;
  parts_->cells->around(at, [&](const MeanPoint::Source& place) {
    const MeanLine& other = parts_->lines[place.line];
    if (place.line == line && isSamePlace(other, place.index, index, parts_->distance)) return;
    near = near || (other.points[place.index].at - at).norm() <= parts_->distance;
  });
  return near;
}

std::vector<BundleWidths> StrokesBeside::bundle(const std::vector<Vec2>& points, bool closed,
                                                const RunContext& context) const {
  constexpr double kAlongPx = 1.5;      // from the normal: points of a line are about one pixel apart
  constexpr double kOneStrokePx = 1.0;  // the points of one stroke scatter by less
  const std::vector<Vec2> tangent = directions(points, closed, kMeanTangentReach);
  std::vector<BundleWidths> bundle(points.size());
  const auto measure = [&](int i) {
    const Vec2 n = leftNormal(tangent[i]);
    double low = 0.0, high = 0.0;
    parts_->cells->around(points[i], [&](const MeanPoint::Source& place) {
      const MeanPoint& there = parts_->lines[place.line].points[place.index];
      const Vec2 d = there.at - points[i];
      const double offset = d.dot(n);
      if (std::abs(d.dot(tangent[i])) > kAlongPx || std::abs(offset) >= parts_->distance) return;
      if (std::abs(there.tangent.dot(tangent[i])) < kCrossingCos) return;
      low = std::min(low, offset);
      high = std::max(high, offset);
    });
    if (high - low <= kOneStrokePx) return;
    bundle[i] = {static_cast<float>(high), static_cast<float>(-low)};
  };
  parallelFor(context, static_cast<int>(points.size()), kMeansPerBlock, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) measure(i);
  });
  return bundle;
}

}  // namespace batten
