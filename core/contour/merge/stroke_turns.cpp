// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/stroke_turns.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "core/contour/merge/stroke_mean.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kSharpTurnRad = 0.87;    // 50 degrees
constexpr double kTurnSeenWidths = 1.5;   // stroke widths over which a turn is seen
constexpr int kFewestReaches = 4;         // of a turn: a shorter line has none beside its ends
constexpr int kLeastTurnReach = 4;        // points
constexpr double kContinuesWidths = 4.0;  // stroke widths to the next line
constexpr double kContinuesCos = 0.8;     // 37 degrees
constexpr double kLeastEndReach = 8.0;    // points over which the direction of an end is taken

// The end of a stroke and the direction in which it would go on.
struct StrokeEnd {
  int line = 0, side = 0;
  Vec2 at = Vec2::Zero(), out = Vec2::Zero();
};

// Where a line turns sharply: the places of largest turn between chords of `reach` points.
std::vector<int> sharpTurnsOf(const Contour& line, int reach) {
  const int n = static_cast<int>(line.points.size());
  std::vector<double> turn(line.points.size(), 0.0);
  const auto p = [&](int i) -> const Vec2& { return line.points[wrapIndex(i, n)].at; };
  for (int i = line.closed ? 0 : reach; i < (line.closed ? n : n - reach); ++i) {
    const Vec2 in = p(i) - p(i - reach), out = p(i + reach) - p(i);
    turn[i] = std::atan2(std::abs(cross(in, out)), in.dot(out));
  }
  std::vector<int> found;
  for (int i = 0; i < n; ++i) {
    const double here = turn[i];
    if (here < kSharpTurnRad) continue;
    bool most = true;
    for (int k = -2 * reach; k <= 2 * reach && most; ++k) {
      if (k == 0 || (!line.closed && (i + k < 0 || i + k >= n))) continue;
      const double there = turn[wrapIndex(i + k, n)];
      most = there < here || (there == here && k > 0);
    }
    if (most) found.push_back(i);
  }
  return found;
}

double widthOf(const Contour& line) {
  std::vector<float> widths = strokeWidthsOf(line.points);
  return widths.empty() ? 1.0 : static_cast<double>(upperMedian(widths));
}

}  // namespace

void findContinuations(std::vector<MeanLine>& strokes, double nearPx) {
  std::vector<StrokeEnd> ends;
  for (int l = 0; l < std::ssize(strokes); ++l) {
    MeanLine& s = strokes[l];
    const int n = s.count();
    s.continues = {false, false};
    if (s.closed || n < 3) continue;
    const int reach = std::min(n - 1, static_cast<int>(std::max(kLeastEndReach, nearPx)));
    const Vec2 first = s.points.front().at, last = s.points.back().at;
    const Vec2 start = first - s.points[reach].at, end = last - s.points[n - 1 - reach].at;
    ends.push_back({l, 0, first, start.norm() > 0.0 ? Vec2(start.normalized()) : Vec2::Zero()});
    ends.push_back({l, 1, last, end.norm() > 0.0 ? Vec2(end.normalized()) : Vec2::Zero()});
  }
  std::stable_sort(ends.begin(), ends.end(),
                   [](const StrokeEnd& a, const StrokeEnd& b) { return a.at.x() < b.at.x(); });
  const auto look = [&](const StrokeEnd& a, const StrokeEnd& b) {
    const Vec2 d = b.at - a.at;
    if (d.norm() <= nearPx && std::abs(cross(a.out, d)) <= 0.5 * nearPx) strokes[a.line].continues[a.side] = true;
  };
  for (int i = 0; i < std::ssize(ends); ++i)
    for (int k = i + 1; k < std::ssize(ends) && ends[k].at.x() - ends[i].at.x() <= nearPx; ++k) {
      if (ends[i].line == ends[k].line || -ends[i].out.dot(ends[k].out) < kContinuesCos) continue;
      look(ends[i], ends[k]);
      look(ends[k], ends[i]);
    }
}

HandStrokes strokesOf(const std::vector<Contour>& lines, double distancePx) {
  const StrokesBeside others(lines, distancePx);
  HandStrokes found;
  double width = 1.0;
  for (int l = 0; l < std::ssize(lines); ++l) {
    const Contour& line = lines[l];
    const int n = static_cast<int>(line.points.size());
    width = std::max(width, widthOf(line));
    const int reach = std::clamp(static_cast<int>(kTurnSeenWidths * widthOf(line)), kLeastTurnReach,
                                 std::max(kLeastTurnReach, static_cast<int>(0.5 * distancePx)));
    std::vector<int> cuts = n > kFewestReaches * reach ? sharpTurnsOf(line, reach) : std::vector<int>{};
    // Where no other stroke is near, it was the hand that turned.
    std::erase_if(cuts, [&](int c) { return !others.isNear(line.points[c].at, l, c); });
    for (const int c : cuts) found.turns.push_back(line.points[c].at);
    const auto add = [&](int from, int to, bool closed) {
      MeanLine stroke;
      stroke.closed = closed;
      std::vector<Vec2> at;
      for (int i = from; i <= to; ++i) {
        const int index = wrapIndex(i, n);
        at.push_back(line.points[index].at);
        stroke.points.push_back({.source = {l, index}});
      }
      setPositions(stroke, at);
      found.strokes.push_back(std::move(stroke));
    };
    if (cuts.empty()) {
      add(0, n - 1, line.closed);
      continue;
    }
    if (!line.closed) add(0, cuts.front(), false);
    for (int c = 0; c + 1 < std::ssize(cuts); ++c) add(cuts[c], cuts[c + 1], false);
    add(cuts.back(), line.closed ? n + cuts.front() : n - 1, false);
  }
  findContinuations(found.strokes, std::min(0.5 * distancePx, kContinuesWidths * width));
  return found;
}

}  // namespace batten
