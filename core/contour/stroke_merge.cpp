// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/stroke_merge.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>

#include "core/base/parallel.h"
#include "core/contour/merged_contour.h"
#include "core/contour/polyline_tools.h"
#include "core/contour/stroke_mean.h"

namespace batten {
namespace {

constexpr double kOnLinePx = 1.6;        // a point this near to another line lies on it, or this part of
constexpr double kOnLine = 0.15;         // the distance within which strokes are one
constexpr double kSameWay = 0.8;         // cosine between lines that are one
constexpr int kShortestRun = 12;         // points: lying on a line for less is crossing it
constexpr double kJointSmoothing = 3.0;  // points
constexpr int kJointReach = 12;          // points on either side

struct Place {
  int line = 0, index = 0;
};

// Points of the lines kept so far, by cells.
class PlaceIndex {
 public:
  void add(const std::vector<Vec2>& points, int line, int from = 0) {
    for (int i = from; i < static_cast<int>(points.size()); ++i)
      cells_[key(cellOf(points[static_cast<std::size_t>(i)].x()), cellOf(points[static_cast<std::size_t>(i)].y()))]
          .push_back({line, i});
  }
  template <class Visit>
  void around(const Vec2& at, const Visit& visit) const {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto found = cells_.find(key(cellOf(at.x()) + dx, cellOf(at.y()) + dy));
        if (found == cells_.end()) continue;
        for (const Place& place : found->second) visit(place);
      }
  }
  void clear() { cells_.clear(); }

 private:
  static constexpr double kCellPx = 8.0;
  static int cellOf(double v) { return static_cast<int>(std::floor(v / kCellPx)); }
  static std::int64_t key(int x, int y) { return (static_cast<std::int64_t>(y) << 32) ^ (x & 0xffffffffLL); }
  std::unordered_map<std::int64_t, std::vector<Place>> cells_;
};

void reverse(MeanLine& line) {
  std::reverse(line.points.begin(), line.points.end());
  std::reverse(line.tangent.begin(), line.tangent.end());
  for (Vec2& t : line.tangent) t = -t;
  std::reverse(line.source.begin(), line.source.end());
}

MeanLine part(const MeanLine& line, int from, int to) {
  const auto cut = [&](const auto& v) { return std::decay_t<decltype(v)>(v.begin() + from, v.begin() + to + 1); };
  MeanLine p;
  p.points = cut(line.points);
  p.tangent = cut(line.tangent);
  p.source = cut(line.source);
  return p;
}

// The two parts of a line meet before `joint` to within a few pixels: a little smoothing there.
void smoothJoint(std::vector<Vec2>& points, int joint) {
  const auto from = points.begin() + std::max(0, joint - kJointReach),
             to = points.begin() + std::min(static_cast<int>(points.size()), joint + kJointReach);
  std::ranges::copy(smoothPolyline(std::vector<Vec2>(from, to), false, kJointSmoothing), from);
}

void append(MeanLine& line, const MeanLine& more) {
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  const int joint = static_cast<int>(line.points.size());
  add(line.points, more.points);
  add(line.tangent, more.tangent);
  add(line.source, more.source);
  smoothJoint(line.points, joint);
}

// The end goes on at the beginning.
void close(MeanLine& line) {
  line.closed = true;
  // Half a turn brings the seam where there are points on both sides.
  const auto half = static_cast<std::ptrdiff_t>(line.points.size() / 2);
  const auto turn = [half](auto& v) { std::rotate(v.begin(), v.begin() + half, v.end()); };
  turn(line.points);
  turn(line.tangent);
  turn(line.source);
  smoothJoint(line.points, static_cast<int>(line.points.size()) - static_cast<int>(half));
}

class Consolidation {
 public:
  explicit Consolidation(double distancePx)
      : distance_(distancePx), onLine_(std::clamp(kOnLine * distancePx, kOnLinePx, 4.0)) {}

  void add(MeanLine line) {
    const std::vector<bool> covered = coverage(line);
    const int n = static_cast<int>(line.points.size());
    if (std::none_of(covered.begin(), covered.end(), [](bool c) { return c; })) return keep(std::move(line));
    if (line.closed) line = openAtCoverage(std::move(line), covered);
    const std::vector<bool> again = coverage(line);
    for (int i = 0; i < n; ++i) {
      if (again[static_cast<std::size_t>(i)]) continue;
      int end = i;
      while (end + 1 < n && !again[static_cast<std::size_t>(end) + 1]) ++end;
      addTail(part(line, i, end), i > 0, end + 1 < n);
      i = end;
    }
  }

  std::vector<MeanLine> finish() {
    for (MeanLine& line : lines_)
      if (!line.points.empty()) closeOverlap(line);
    std::erase_if(lines_, [](const MeanLine& l) { return l.points.size() < 3; });
    return std::move(lines_);
  }

 private:
  void keep(MeanLine line) {
    index_.add(line.points, static_cast<int>(lines_.size()));
    lines_.push_back(std::move(line));
  }

  std::vector<bool> coverage(const MeanLine& line) const {
    const auto n = line.points.size();
    std::vector<bool> on(n, false);
    for (std::size_t i = 0; i < n; ++i) {
      index_.around(line.points[i], [&](const Place& place) {
        const MeanLine& other = lines_[static_cast<std::size_t>(place.line)];
        const auto k = static_cast<std::size_t>(place.index);
        if ((other.points[k] - line.points[i]).norm() <= onLine_ &&
            std::abs(other.tangent[k].dot(line.tangent[i])) >= kSameWay)
          on[i] = true;
      });
    }
    // Short gaps are noise; short stretches inside are crossings.
    flipRuns(on, false, 4, false);
    flipRuns(on, true, kShortestRun, true);
    return on;
  }

  static void flipRuns(std::vector<bool>& values, bool what, int shorter, bool onlyInside) {
    const int n = static_cast<int>(values.size());
    for (int i = 0; i < n; ++i) {
      if (values[static_cast<std::size_t>(i)] != what) continue;
      int end = i;
      while (end + 1 < n && values[static_cast<std::size_t>(end) + 1] == what) ++end;
      const bool inside = i > 0 && end + 1 < n;
      if (end - i + 1 < shorter && (inside || !onlyInside))
        for (int k = i; k <= end; ++k) values[static_cast<std::size_t>(k)] = !what;
      i = end;
    }
  }

  // A ring that partly lies on other lines becomes an open line that begins there.
  static MeanLine openAtCoverage(MeanLine line, const std::vector<bool>& covered) {
    const auto first = std::find(covered.begin(), covered.end(), true) - covered.begin();
    const auto turn = [&](auto& v) { std::rotate(v.begin(), v.begin() + first, v.end()); };
    turn(line.points);
    turn(line.tangent);
    turn(line.source);
    line.closed = false;
    return line;
  }

  // Unit direction from an end into the line, over about the distance: the last few points may be a hook.
  Vec2 inwards(const MeanLine& line, int side) const {
    const std::size_t n = line.points.size(), reach = std::min(n - 1, static_cast<std::size_t>(std::ceil(distance_)));
    const Vec2 chord =
        side == 0 ? line.points[reach] - line.points.front() : line.points[n - 1 - reach] - line.points.back();
    if (chord.norm() > 0.0) return chord.normalized();
    return side == 0 ? line.tangent.front() : Vec2(-line.tangent.back());
  }

  // The kept line whose open end a tail that begins at `at` in direction `out` goes on from: 2 * line + side, or -1.
  int endAt(const Vec2& at, const Vec2& out) const {
    int best = -1;
    double nearest = std::max(8.0, 0.75 * distance_);
    for (int l = 0; l < static_cast<int>(lines_.size()); ++l) {
      const MeanLine& line = lines_[static_cast<std::size_t>(l)];
      if (line.closed || line.points.empty()) continue;
      for (const int side : {0, 1}) {
        const Vec2& end = side == 0 ? line.points.front() : line.points.back();
        const Vec2 away = -inwards(line, side);
        const double d = (end - at).norm();
        if (d >= nearest || away.dot(out) < 0.7) continue;
        nearest = d;
        best = 2 * l + side;
      }
    }
    return best;
  }

  void addTail(MeanLine tail, bool cutStart, bool cutEnd) {
    const int start = cutStart ? endAt(tail.points.front(), inwards(tail, 0)) : -1;
    const int end = cutEnd ? endAt(tail.points.back(), inwards(tail, 1)) : -1;
    const double length = polylineLength(tail.points, false);
    if (start < 0 && end < 0) {
      // An overshoot, or a way between two lines that nearly touch.
      if (length < 2.0 * distance_ && (cutStart || cutEnd)) return;
      return keep(std::move(tail));
    }
    if (start >= 0) {
      joinTo(start, tail);
      if (end >= 0 && end / 2 == start / 2 && end != start) closeLine(start / 2);
      if (end >= 0 && end / 2 != start / 2) joinLines(start, end);
      return;
    }
    reverse(tail);
    joinTo(end, tail);
  }

  // `tail` goes on from an end of a kept line.
  void joinTo(int end, const MeanLine& tail) {
    MeanLine& line = lines_[static_cast<std::size_t>(end / 2)];
    if (end % 2 == 0) reverse(line);
    const auto from = static_cast<int>(line.points.size());
    append(line, tail);
    if (end % 2 == 0) {
      reverse(line);
      reindex();
    } else {
      index_.add(line.points, end / 2, from);
    }
  }

  // The end `a` of one kept line (a tail has just been joined to it) leads to the end `b` of another.
  void joinLines(int a, int b) {
    MeanLine& first = lines_[static_cast<std::size_t>(a / 2)];
    MeanLine& second = lines_[static_cast<std::size_t>(b / 2)];
    if (a % 2 == 0) reverse(first);
    if (b % 2 == 1) reverse(second);
    append(first, second);
    second = MeanLine{};
    reindex();
  }

  void closeLine(int line) {
    close(lines_[static_cast<std::size_t>(line)]);
    reindex();
  }

  void reindex() {
    index_.clear();
    for (std::size_t l = 0; l < lines_.size(); ++l) index_.add(lines_[l].points, static_cast<int>(l));
  }

  // A loop drawn beyond its start: what runs along the start goes, and the loop is closed.
  void closeOverlap(MeanLine& line) const {
    const int n = static_cast<int>(line.points.size());
    const int apart = static_cast<int>(4.0 * distance_) + 30;
    if (line.closed || n < 2 * apart) return;
    int best = -1;
    double nearest = std::max(4.0, 0.5 * distance_);
    for (int i = n - 1; i >= std::max(apart, n / 2); --i) {
      const auto at = static_cast<std::size_t>(i);
      const double d = (line.points[at] - line.points.front()).norm();
      if (d >= nearest || line.tangent[at].dot(line.tangent.front()) < 0.7) continue;
      nearest = d;
      best = i;
    }
    if (best < 0) return;
    line = part(line, 0, best);
    close(line);
  }

  double distance_, onLine_;
  std::vector<MeanLine> lines_;
  PlaceIndex index_;
};

}  // namespace

std::vector<Contour> mergeStrokes(const std::vector<Contour>& lines, double distancePx, const RunContext& context) {
  std::vector<MeanLine> means = moveToMean(lines, distancePx, context);
  if (context.isCancelled()) return {};
  std::vector<std::size_t> order(means.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return lines[a].lengthPx > lines[b].lengthPx; });
  Consolidation consolidation(distancePx);
  for (const std::size_t i : order) {
    if (context.isCancelled()) return {};
    if (means[i].points.size() >= 3) consolidation.add(std::move(means[i]));
  }
  std::vector<Contour> merged;
  const StrokesBeside strokes(lines, distancePx);
  for (const MeanLine& line : consolidation.finish()) {
    merged.push_back(mergedContour(line, lines, strokes, distancePx, context));
    if (context.isCancelled()) return {};
  }
  std::erase_if(merged, [](const Contour& c) { return c.points.size() < 3; });
  return merged;
}

}  // namespace batten
