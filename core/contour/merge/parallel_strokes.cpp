// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/parallel_strokes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/polyline/point_grid.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kAlikeCos = 0.906;    // 25 degrees: lines at a larger angle do not run side by side
constexpr double kOnNormalPx = 0.8;    // points of a line are about one pixel apart
constexpr double kAheadWidths = 5.0;   // from where lines touch: ink goes on there, or it was a tip
constexpr double kSlopeWidths = 3.0;   // over which it is measured how fast lines come together
constexpr double kMeetShare = 0.25;    // of the stretch: lines that would meet within so much more do meet
constexpr double kNarrowed = 0.5;      // of the widest: if they are as near by then,
constexpr double kNearWidths = 3.0;    // or so near
constexpr double kFoldBack = 2.0;      // times the way about a turn
constexpr double kGapWidths = 3.0;     // along a line: so short a gap beside it is none
constexpr double kLevelDistances = 2;  // distances between two lines: ends as near along them are level
constexpr double kLeastCellPx = 3.0;   // of the grid of points
// Distances and widths along a line before it can lie beside itself.
constexpr double kItselfApart = 3.0, kItselfWidths = 4.0;
constexpr double kLeastApart = 0.1;   // widths: nearer is the same line
constexpr double kAsideWidths = 3.0;  // to either side of the place ahead
constexpr double kAheadPx = 1.0;      // along the direction: points of a line are about one pixel apart
constexpr int kSideTangentReach = 3;  // points to either side
constexpr int kSidesPerBlock = 128;   // worked on together; the result does not depend on it
constexpr int kSidesPerLook = 16;     // between two looks at the cancel token

struct LinePoint {
  Vec2 at = Vec2::Zero(), tangent = Vec2::Zero();
};

struct DirectedLine {
  std::vector<LinePoint> points;
  bool closed = false;
  std::array<bool, 2> isFree = {false, false};  // the start, the end touches nothing
  int count() const { return static_cast<int>(points.size()); }
};

// A point of one of the lines.
struct LinePlace {
  int line = 0, index = 0;
  auto operator<=>(const LinePlace&) const = default;  // NOLINT(modernize-use-nullptr): a false alarm
};

// The nearest line beside a place.
struct Neighbour {
  LinePlace place;
  double apart = 0.0;  // [px]
};

class SideFinder {
 public:
  SideFinder(const std::vector<Contour>& lines, double widthPx, double reachPx, const RunContext& context)
      : width_(widthPx),
        reach_(reachPx),
        cell_(std::max(kLeastCellPx, touchingPx(widthPx))),
        stride_(std::max(1, static_cast<int>(std::lround(0.5 * widthPx)))),
        cells_(cell_) {
    for (int l = 0; l < std::ssize(lines); ++l) {
      if (context.isCancelled()) return;
      addLine(lines[l], l);
    }
    for (int l = 0; l < std::ssize(lines_) && !context.isCancelled(); ++l) {
      if (lines_[l].closed || lines_[l].points.empty()) continue;
      for (const int side : {0, 1}) lines_[l].isFree[side] = touchesNothing(l, side);
    }
  }

  // The stretches of all lines, on both sides.
  std::vector<ParallelStretch> find(const RunContext& context) const {
    std::vector<LinePlace> samples;
    std::vector<int> first;
    for (int l = 0; l < std::ssize(lines_); ++l) {
      first.push_back(static_cast<int>(samples.size()));
      for (int i = 0; i < lines_[l].count(); i += stride_) samples.push_back({l, i});
    }
    first.push_back(static_cast<int>(samples.size()));
    std::vector<ParallelStretch> found;
    for (const double sign : {1.0, -1.0}) {
      Neighbours nearest(samples.size());
      parallelFor(context, static_cast<int>(samples.size()), kSidesPerBlock, [&](int begin, int end) {
        for (int k = begin; k < end; ++k) {
          if (k % kSidesPerLook == 0 && context.isCancelled()) return;
          nearest[k] = beside(samples[k], sign);
        }
      });
      if (context.isCancelled()) return {};
      for (int l = 0; l + 1 < std::ssize(first); ++l) {
        if (context.isCancelled()) return {};
        for (ParallelStretch& s : stretchesOf(l, {nearest.begin() + first[l], nearest.begin() + first[l + 1]}))
          found.push_back(std::move(s));
      }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const ParallelStretch& a, const ParallelStretch& b) { return a.line < b.line; });
    return found;
  }

 private:
  using Neighbours = std::vector<std::optional<Neighbour>>;  // one a sample

  void addLine(const Contour& line, int number) {
    const std::vector<Vec2> at = positionsOf(line.points), tangent = directions(at, line.closed, kSideTangentReach);
    DirectedLine& made = lines_.emplace_back();
    made.closed = line.closed;
    for (int i = 0; i < std::ssize(at); ++i) {
      made.points.push_back({at[i], tangent[i]});
      cells_.add(at[i], {number, i});
    }
  }

  const LinePoint& pointAt(const LinePlace& p) const { return lines_[p.line].points[p.index]; }

  // Places of one line that are so near along it that they are no neighbours.
  bool isSamePlace(const DirectedLine& line, int a, int b, double apart) const {
    int along = std::abs(a - b);
    if (line.closed) along = std::min(along, line.count() - along);
    return along < kItselfApart * apart + kItselfWidths * width_;
  }

  bool touchesNothing(int l, int side) const {
    const DirectedLine& line = lines_[l];
    const int end = side == 0 ? 0 : line.count() - 1;
    const Vec2& tip = line.points[end].at;
    bool touches = false;
    cells_.around(tip, [&](const LinePlace& p) {
      const double d = (pointAt(p).at - tip).norm();
      if (d >= touchingPx(width_) || (p.line == l && isSamePlace(line, p.index, end, d))) return;
      touches = true;
    });
    return !touches;
  }

  // The nearest line of about the same direction on one side of a point.
  std::optional<Neighbour> beside(const LinePlace& of, double sign) const {
    const Vec2 &from = pointAt(of).at, &t = pointAt(of).tangent;
    const Vec2 normal = sign * leftNormal(t);
    std::optional<Neighbour> best;
    double nearest = reach_;
    for (double r = 0.0; r <= nearest + cell_; r += cell_)
      cells_.around(from + r * normal, [&](const LinePlace& p) {
        const LinePoint& other = pointAt(p);
        const Vec2 d = other.at - from;
        const double apart = d.dot(normal);
        if (std::abs(d.dot(t)) > kOnNormalPx || apart <= kLeastApart * width_ || apart > nearest) return;
        if (std::abs(other.tangent.dot(t)) < kAlikeCos) return;
        if (p.line == of.line && isSamePlace(lines_[of.line], p.index, of.index, apart)) return;
        // The same from any order of the cells.
        if (apart == nearest && best && p > best->place) return;
        nearest = apart;
        best = {p, apart};
      });
    return best;
  }

  // Ink ahead of a place, about in this direction.
  bool continues(const Vec2& from, const Vec2& direction) const {
    const Vec2 ahead = from + kAheadWidths * width_ * direction, across = leftNormal(direction);
    const double aside = kAsideWidths * width_;
    bool found = false;
    for (double r = -aside; r <= aside && !found; r += width_)
      cells_.around(ahead + r * across, [&](const LinePlace& p) {
        const LinePoint& other = pointAt(p);
        const Vec2 d = other.at - ahead;
        found = found || (std::abs(d.dot(direction)) <= kAheadPx && std::abs(d.dot(across)) <= aside &&
                          std::abs(other.tangent.dot(direction)) >= kAlikeCos);
      });
    return found;
  }

  // Samples that a short gap holds at most.
  int gapSamples(int count) const {
    const int most = std::max(1, static_cast<int>(std::lround(kGapWidths * width_ / stride_)));
    return std::min(most, count - 1);
  }

  // How many samples farther on a stretch goes on; nothing where it ends. Short gaps, where lines cross or ink is
  // shared, belong to it; the distance changes by less than a pen's width.
  std::optional<int> continuesBy(const Neighbours& at, bool closed, int k, int direction) const {
    const int count = static_cast<int>(at.size());
    for (int by = 1; by <= gapSamples(count); ++by) {
      const int next = closed ? wrapIndex(k + direction * by, count) : k + direction * by;
      if (next < 0 || next >= count) return std::nullopt;
      if (at[next] && std::abs(at[next]->apart - at[k]->apart) <= width_) return by;
    }
    return std::nullopt;
  }

  // The stretches on one side of a line.
  std::vector<ParallelStretch> stretchesOf(int l, const Neighbours& at) const {
    std::vector<ParallelStretch> found;
    const int count = static_cast<int>(at.size());
    const bool closed = lines_[l].closed;
    int start = 0;
    if (closed)
      while (start < count && (!at[start] || continuesBy(at, true, start, -1))) ++start;
    const bool isRing = start == count;
    if (isRing) start = 0;
    for (int k = start; k < start + count;) {
      const int first = k;
      if (!at[wrapIndex(first, count)]) {
        ++k;
        continue;
      }
      ParallelStretch s;
      s.line = l;
      s.stepPx = stride_;
      s.firstStep = wrapIndex(first, count);
      int last = first;
      while (true) {
        const double apart = at[wrapIndex(last, count)]->apart;
        const auto by = continuesBy(at, closed, wrapIndex(last, count), 1);
        const bool isLast = !by || last + *by >= start + count;
        for (int i = 0; i < (isLast ? 1 : *by); ++i) s.apartPx.push_back(apart);
        if (isLast) break;
        last += *by;
      }
      s.widestPx = *std::max_element(s.apartPx.begin(), s.apartPx.end());
      if (!isRing || last - first < count - 1) {
        s.begin = endOf(l, at, wrapIndex(first, count), -1, s);
        s.end = endOf(l, at, wrapIndex(last, count), 1, s);
      }
      found.push_back(std::move(s));
      k = last + 1;
    }
    return found;
  }

  // Another line comes between within a short gap.
  bool comesBetween(const Neighbours& at, bool closed, int k, int direction) const {
    const int count = static_cast<int>(at.size());
    for (int by = 1; by <= gapSamples(count); ++by) {
      const int next = closed ? wrapIndex(k + direction * by, count) : k + direction * by;
      if (next < 0 || next >= count) return false;
      if (at[next]) return at[next]->apart < at[k]->apart;
    }
    return false;
  }

  // Whether the two come together at the end (1) or the beginning (-1) of a stretch, or are about to.
  bool touches(const ParallelStretch& s, int direction) const {
    const int count = static_cast<int>(s.apartPx.size()), last = direction > 0 ? count - 1 : 0;
    const double apart = s.apartPx[last];
    if (apart <= touchingPx(width_)) return true;
    const int back = std::max(1, static_cast<int>(std::lround(kSlopeWidths * width_ / stride_)));
    const int inside = last - direction * back;
    if (inside < 0 || inside >= count || apart > std::max(kNarrowed * s.widestPx, kNearWidths * width_)) return false;
    const double slope = (s.apartPx[inside] - apart) / (back * stride_);
    return slope > 0.0 && apart <= slope * kMeetShare * s.lengthPx();
  }

  // [points] How much of a line is left from a point on; a ring has no end.
  static double leftOf(const DirectedLine& line, int index, bool toEnd) {
    if (line.closed) return std::numeric_limits<double>::infinity();
    return toEnd ? line.count() - 1 - index : index;
  }

  // How the stretch ends at sample k. @pre a line lies beside it there.
  SideEnd endOf(int l, const Neighbours& at, int k, int direction, const ParallelStretch& s) const {
    const int i = k * stride_;
    const LinePlace& there = at[k]->place;
    const double apart = at[k]->apart;
    const DirectedLine &own = lines_[l], &other = lines_[there.line];
    const Vec2 &position = own.points[i].at, &tangent = own.points[i].tangent;
    if (touches(s, direction)) return continues(position, direction * tangent) ? SideEnd::Meets : SideEnd::Tip;
    // It turns back and runs beside itself.
    if (there.line == l && isSamePlace(own, there.index, i, kFoldBack * apart)) return SideEnd::Tip;
    if (comesBetween(at, own.closed, k, direction)) return SideEnd::Between;
    // How far each of them goes on.
    const bool sameDirection = pointAt(there).tangent.dot(tangent) > 0.0;
    const bool toEnd = direction > 0, otherToEnd = sameDirection == toEnd;
    const double ownLeft = leftOf(own, i, toEnd), otherLeft = leftOf(other, there.index, otherToEnd);
    const double atEnd = 2.0 * stride_ + width_ + 1.0, level = kLevelDistances * apart;
    const bool ownFree = own.isFree[toEnd ? 1 : 0], otherFree = other.isFree[otherToEnd ? 1 : 0];
    if (ownLeft <= atEnd) {
      if (!ownFree || (otherLeft <= level && !otherFree)) return SideEnd::Cut;
      return otherLeft <= level ? SideEnd::LevelEnds : SideEnd::OwnEnd;
    }
    if (otherLeft <= atEnd) {
      if (!otherFree || (ownLeft <= level && !ownFree)) return SideEnd::Cut;
      return ownLeft <= level ? SideEnd::LevelEnds : SideEnd::OtherEnd;
    }
    return SideEnd::Parts;
  }

  double width_, reach_, cell_;
  int stride_;
  std::vector<DirectedLine> lines_;
  PointGrid<LinePlace> cells_;
};

}  // namespace

std::vector<ParallelStretch> findParallelStrokes(const std::vector<Contour>& lines, double widthPx, double reachPx,
                                                 const RunContext& context) {
  if (!(widthPx > 0.0) || !(reachPx > 0.0)) return {};
  return SideFinder(lines, widthPx, reachPx, context).find(context);
}

}  // namespace batten
