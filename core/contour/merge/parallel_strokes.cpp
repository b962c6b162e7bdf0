// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/parallel_strokes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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
constexpr int kSidesPerBlock = 128;

struct LineSide {
  std::vector<Vec2> points, tangent;
  bool closed = false;
  bool isFree[2] = {false, false};  // the start, the end touches nothing
};

struct LinePlace {
  int line = -1, index = 0;
  double apart = 0.0;
  bool exists() const { return line >= 0; }
};

class SideFinder {
 public:
  SideFinder(const std::vector<Contour>& lines, double widthPx, double reachPx, const RunContext& context)
      : width_(widthPx),
        reach_(reachPx),
        cell_(std::max(3.0, touchingPx(widthPx))),
        stride_(std::max(1, static_cast<int>(std::lround(0.5 * widthPx)))),
        cells_(cell_) {
    for (int l = 0; l < static_cast<int>(lines.size()); ++l) {
      if (context.isCancelled()) return;
      const Contour& c = lines[l];
      const std::vector<Vec2> points = positionsOf(c.points);
      lines_.push_back({points, directions(points, c.closed, 3), c.closed, {false, false}});
      for (int i = 0; i < static_cast<int>(points.size()); ++i) cells_.add(points[i], {l, i, 0.0});
    }
    for (int l = 0; l < static_cast<int>(lines_.size()) && !context.isCancelled(); ++l) {
      if (at(l).closed || at(l).points.empty()) continue;
      for (const int side : {0, 1}) at(l).isFree[side] = touchesNothing(l, side);
    }
  }

  std::vector<ParallelStretch> all(const RunContext& context) const {
    struct Sample {
      int line, index;
    };
    std::vector<Sample> samples;
    std::vector<std::size_t> first;
    for (int l = 0; l < static_cast<int>(lines_.size()); ++l) {
      first.push_back(samples.size());
      for (int i = 0; i < static_cast<int>(at(l).points.size()); i += stride_) samples.push_back({l, i});
    }
    first.push_back(samples.size());
    std::vector<ParallelStretch> found;
    for (const double sign : {1.0, -1.0}) {
      std::vector<LinePlace> nearest(samples.size());
      parallelFor(context, static_cast<int>(samples.size()), kSidesPerBlock, [&](int begin, int end) {
        for (int k = begin; k < end; ++k) {
          if ((k & 15) == 0 && context.isCancelled()) return;
          const auto i = static_cast<std::size_t>(k);
          nearest[i] = beside(samples[i].line, samples[i].index, sign);
        }
      });
      if (context.isCancelled()) return {};
      for (std::size_t l = 0; l + 1 < first.size(); ++l) {
        if (context.isCancelled()) return {};
        stretches(static_cast<int>(l),
                  {nearest.begin() + static_cast<std::ptrdiff_t>(first[l]),
                   nearest.begin() + static_cast<std::ptrdiff_t>(first[l + 1])},
                  found);
      }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const ParallelStretch& a, const ParallelStretch& b) { return a.line < b.line; });
    return found;
  }

 private:
  using Places = std::vector<LinePlace>;
  const LineSide& at(int line) const { return lines_[line]; }
  LineSide& at(int line) { return lines_[line]; }
  static const LinePlace& of(const Places& p, int k) { return p[k]; }

  // Places of one line that are so near along it that they are no neighbours.
  bool isSamePlace(const LineSide& line, int a, int b, double apart) const {
    int along = std::abs(a - b);
    if (line.closed) along = std::min(along, static_cast<int>(line.points.size()) - along);
    return along < 3.0 * apart + 4.0 * width_;
  }

  bool touchesNothing(int l, int side) const {
    const LineSide& line = at(l);
    const int end = side == 0 ? 0 : static_cast<int>(line.points.size()) - 1;
    const Vec2& tip = line.points[end];
    bool touches = false;
    cells_.around(tip, [&](const LinePlace& p) {
      const double d = (at(p.line).points[p.index] - tip).norm();
      if (d >= touchingPx(width_) || (p.line == l && isSamePlace(line, p.index, end, d))) return;
      touches = true;
    });
    return !touches;
  }

  // The nearest line of about the same direction on one side of a point.
  LinePlace beside(int l, int i, double sign) const {
    const LineSide& here = at(l);
    const Vec2 &from = here.points[i], &t = here.tangent[i];
    const Vec2 normal = sign * leftNormal(t);
    LinePlace best{-1, 0, reach_};
    for (double r = 0.0; r <= best.apart + cell_; r += cell_)
      cells_.around(from + r * normal, [&](const LinePlace& p) {
        const LineSide& other = at(p.line);
        const auto k = static_cast<std::size_t>(p.index);
        const Vec2 d = other.points[k] - from;
        const double apart = d.dot(normal);
        if (std::abs(d.dot(t)) > kOnNormalPx || apart <= 0.1 * width_ || apart > best.apart) return;
        if (std::abs(other.tangent[k].dot(t)) < kAlikeCos) return;
        if (p.line == l && isSamePlace(here, p.index, i, apart)) return;
        // The same from any order of the cells.
        if (apart == best.apart && best.exists() && std::pair(p.line, p.index) > std::pair(best.line, best.index))
          return;
        best = {p.line, p.index, apart};
      });
    return best;
  }

  // Ink ahead of a place, about in this direction.
  bool continues(const Vec2& from, const Vec2& direction) const {
    const Vec2 ahead = from + kAheadWidths * width_ * direction, across = leftNormal(direction);
    const double aside = 3.0 * width_;
    bool found = false;
    for (double r = -aside; r <= aside && !found; r += width_)
      cells_.around(ahead + r * across, [&](const LinePlace& p) {
        const auto k = static_cast<std::size_t>(p.index);
        const Vec2 d = at(p.line).points[k] - ahead;
        found = found || (std::abs(d.dot(direction)) <= 1.0 && std::abs(d.dot(across)) <= aside &&
                          std::abs(at(p.line).tangent[k].dot(direction)) >= kAlikeCos);
      });
    return found;
  }

  // How many samples on a stretch goes on, 0: it does not. Short gaps, where lines cross or ink is shared, belong to
  // it; the distance changes by less than a pen's width.
  int continuesBy(const Places& places, bool closed, int k, int direction) const {
    const int count = static_cast<int>(places.size());
    const int most = std::max(1, static_cast<int>(std::lround(kGapWidths * width_ / stride_)));
    for (int by = 1; by <= std::min(most, count - 1); ++by) {
      const int next = closed ? wrapIndex(k + direction * by, count) : k + direction * by;
      if (next < 0 || next >= count) return 0;
      if (of(places, next).exists() && std::abs(of(places, next).apart - of(places, k).apart) <= width_) return by;
    }
    return 0;
  }

  // The stretches on one side of a line.
  void stretches(int l, const Places& places, std::vector<ParallelStretch>& found) const {
    const int count = static_cast<int>(places.size());
    const bool closed = at(l).closed;
    int start = 0;
    if (closed)
      while (start < count && (!of(places, start).exists() || continuesBy(places, true, start, -1) > 0)) ++start;
    const bool isRing = start == count;
    if (isRing) start = 0;
    for (int k = start; k < start + count;) {
      const int first = k;
      if (!of(places, wrapIndex(first, count)).exists()) {
        ++k;
        continue;
      }
      ParallelStretch s;
      s.line = l;
      s.stepPx = stride_;
      s.firstStep = wrapIndex(first, count);
      int last = first;
      while (true) {
        const double apart = of(places, wrapIndex(last, count)).apart;
        const int by = continuesBy(places, closed, wrapIndex(last, count), 1);
        const bool isLast = by == 0 || last + by >= start + count;
        s.apartPx.insert(s.apartPx.end(), static_cast<std::size_t>(isLast ? 1 : by), apart);
        if (isLast) break;
        last += by;
      }
      s.widestPx = *std::max_element(s.apartPx.begin(), s.apartPx.end());
      if (!isRing || last - first < count - 1) {
        s.begin = endOf(l, places, wrapIndex(first, count), -1, s);
        s.end = endOf(l, places, wrapIndex(last, count), 1, s);
      }
      found.push_back(std::move(s));
      k = last + 1;
    }
  }

  // Another line comes between within a short gap.
  bool comesBetween(const Places& places, bool closed, int k, int direction) const {
    const int count = static_cast<int>(places.size());
    const int most = std::max(1, static_cast<int>(std::lround(kGapWidths * width_ / stride_)));
    for (int by = 1; by <= std::min(most, count - 1); ++by) {
      const int next = closed ? wrapIndex(k + direction * by, count) : k + direction * by;
      if (next < 0 || next >= count) return false;
      if (of(places, next).exists()) return of(places, next).apart < of(places, k).apart;
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

  SideEnd endOf(int l, const Places& places, int k, int direction, const ParallelStretch& s) const {
    const int i = k * stride_;
    const LinePlace& here = of(places, k);
    const LineSide &own = at(l), &other = at(here.line);
    const Vec2& tangent = own.tangent[i];
    if (touches(s, direction)) return continues(own.points[i], direction * tangent) ? SideEnd::Meets : SideEnd::Tip;
    // It turns back and runs beside itself.
    if (here.line == l && isSamePlace(own, here.index, i, kFoldBack * here.apart)) return SideEnd::Tip;
    if (comesBetween(places, own.closed, k, direction)) return SideEnd::Between;
    // How far each of them goes on.
    const int points = static_cast<int>(own.points.size()), others = static_cast<int>(other.points.size());
    const bool sameWay = other.tangent[here.index].dot(tangent) > 0.0;
    const bool toEnd = direction > 0, otherToEnd = sameWay == toEnd;
    const double ownLeft = own.closed ? 1e9 : toEnd ? points - 1 - i : i;
    const double otherLeft = other.closed ? 1e9 : otherToEnd ? others - 1 - here.index : here.index;
    const double atEnd = 2.0 * stride_ + width_ + 1.0, level = kLevelDistances * here.apart;
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
  std::vector<LineSide> lines_;
  PointGrid<LinePlace> cells_;
};

}  // namespace

std::vector<ParallelStretch> findParallelStrokes(const std::vector<Contour>& lines, double widthPx, double reachPx,
                                                 const RunContext& context) {
  if (!(widthPx > 0.0) || !(reachPx > 0.0)) return {};
  return SideFinder(lines, widthPx, reachPx, context).all(context);
}

}  // namespace batten
