// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/detail_line.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>

#include "core/base/angle.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kSmoothing = 0.5;                       // scales, standard deviation
constexpr double kHalfTurn = 2.0;                        // scales to either side, over which a corner turns
constexpr double kFlank = 3.0;                           // scales beyond, that bend less
constexpr double kLeastCornerTurn = 25.0 * kRadPerDeg;   // of a corner at the scale
constexpr double kFlankShare = 0.45;                     // of the corner's turn per length
constexpr double kVertexNear = 1.0, kVertexReach = 1.6;  // scales from the line
constexpr double kTip = 110.0 * kRadPerDeg;              // turns beyond have no vertex near the line
constexpr double kApart = 3.4;                           // scales between two corners of one sense
// of a corner without rounding: at the scale, and of chords
constexpr double kHardTurn = 40.0 * kRadPerDeg, kHardChords = 48.0 * kRadPerDeg;
constexpr double kChordFrom = 1.2, kChordTo = 7.2;  // scales
constexpr int kFewestLinePlaces = 24;               // steps of a line; shorter ones have no corners at a scale
constexpr double kMouth = 0.8, kShortestNeck = 2.0, kLongestNeck = 16.0;  // scales
constexpr double kNeckDepth = 3.0;  // mouths: the line leaves and comes back, and does not only bend

class CornerSearch {
 public:
  CornerSearch(const EvenLine& line, double scale)
      : line_(line), scale_(scale), smooth_(smoothPolyline(line.points, line.closed, kSmoothing * scale / line.step)) {
    const int n = line.size(), loop = line.closed ? n + 1 : n;
    double before = 0.0;
    for (int i = 0; i < loop; ++i) {
      const Vec2 chord = at(i + 1) - at(i - 1);
      double angle = std::atan2(chord.y(), chord.x());
      if (i > 0) angle += 2.0 * std::numbers::pi * std::round((before - angle) / (2.0 * std::numbers::pi));
      direction_.push_back(angle);
      before = angle;
    }
    round_ = line.closed ? direction_.back() - direction_.front() : 0.0;
  }

  std::vector<ScaleCorner> find() const {
    const int n = line_.size(), half = places(kHalfTurn);
    std::vector<ScaleCorner> candidates;
    for (int i = 0; i < n; ++i) {
      if (!line_.closed && (i < half / 2 || n - 1 - i < half / 2)) continue;
      const double turn = turnAt(i);
      if (std::abs(turn) < kLeastCornerTurn) continue;
      if (std::abs(turnAt(i - 1)) > std::abs(turn) || std::abs(turnAt(i + 1)) >= std::abs(turn)) continue;
      if (auto corner = cornerAt(i, turn)) candidates.push_back(*corner);
    }
    // Hard ones first, then by turn.
    std::stable_sort(candidates.begin(), candidates.end(), [](const ScaleCorner& a, const ScaleCorner& b) {
      return a.hard != b.hard ? a.hard : std::abs(a.turnRad) > std::abs(b.turnRad);
    });
    std::vector<ScaleCorner> kept;
    for (const ScaleCorner& corner : candidates) {
      const bool isTaken = std::any_of(kept.begin(), kept.end(), [&](const ScaleCorner& other) {
        return other.turnRad * corner.turnRad > 0.0 && apart(other.sample, corner.sample) < places(kApart);
      });
      if (!isTaken) kept.push_back(corner);
    }
    std::sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) { return a.sample < b.sample; });
    return kept;
  }

 private:
  int places(double scales) const { return std::max(1, static_cast<int>(std::lround(scales * scale_ / line_.step))); }
  int wrapped(int i) const {
    const int n = line_.size();
    return line_.closed ? (i % n + n) % n : std::clamp(i, 0, n - 1);
  }
  const Vec2& at(int i) const { return smooth_[wrapped(i)]; }
  double directionAt(int i) const {
    const int n = line_.size();
    if (!line_.closed) return direction_[wrapped(i)];
    const int laps = static_cast<int>(std::floor(static_cast<double>(i) / n));
    return direction_[i - laps * n] + laps * round_;
  }
  double turnAt(int i) const { return directionAt(i + places(kHalfTurn)) - directionAt(i - places(kHalfTurn)); }
  int apart(int a, int b) const {
    const int direct = std::abs(a - b);
    return line_.closed ? std::min(direct, line_.size() - direct) : direct;
  }

  std::optional<ScaleCorner> cornerAt(int i, double turn) const {
    const int half = places(kHalfTurn), flank = places(kFlank);
    const double before = directionAt(i - half) - directionAt(i - half - flank);
    const double after = directionAt(i + half + flank) - directionAt(i + half);
    const double flankTurn = std::copysign(1.0, turn) * 0.5 * (before + after) / kFlank;
    if (flankTurn > kFlankShare * std::abs(turn) / (2.0 * kHalfTurn)) return std::nullopt;
    ScaleCorner corner;
    corner.sample = i;
    corner.turnRad = turn;
    const auto vertex = vertexAt(i, turn);
    if (!vertex) return std::nullopt;
    corner.vertex = *vertex;
    corner.hard = std::abs(turn) >= kHardTurn && std::abs(chordTurn(i)) >= kHardChords;
    return corner;
  }

  double chordTurn(int i) const {
    const Vec2 in = at(i - places(kChordFrom)) - at(i - places(kChordTo));
    const Vec2 out = at(i + places(kChordTo)) - at(i + places(kChordFrom));
    return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
  }

  /// Where the tangents at both ends of the turn meet, if that is near the line; for tips the tip itself.
  std::optional<Vec2> vertexAt(int i, double turn) const {
    const Vec2& tip = line_.points[wrapped(i)];
    if (std::abs(turn) >= kTip) return tip;
    const int half = places(kHalfTurn);
    const double a = directionAt(i - half), b = directionAt(i + half);
    const Vec2 in(std::cos(a), std::sin(a)), out(std::cos(b), std::sin(b));
    const double across = in.x() * out.y() - in.y() * out.x();
    if (std::abs(across) < 1e-6) return tip;
    const Vec2 between = at(i + half) - at(i - half);
    const Vec2 meet = at(i - half) + (between.x() * out.y() - between.y() * out.x()) / across * in;
    double nearest = std::numeric_limits<double>::infinity();
    Vec2 place = tip;
    for (int k = -half; k <= half; ++k) {
      const Vec2& p = line_.points[wrapped(i + k)];
      const double distance = (p - meet).norm();
      if (distance < nearest) {
        nearest = distance;
        place = p;
      }
    }
    if (nearest <= kVertexNear * scale_) return meet;
    return nearest <= kVertexReach * scale_ ? std::optional(place) : std::nullopt;
  }

  const EvenLine& line_;
  const double scale_;
  const std::vector<Vec2> smooth_;
  std::vector<double> direction_;  // unwrapped
  double round_ = 0.0;             // turn of a closed line
};

/// Through points whose last is the end, or of a closed line the first again.
EvenLine evenPolyline(const std::vector<Vec2>& fine, bool closed, double step) {
  const std::vector<double> s = cumulativeLength(fine);
  EvenLine line;
  line.closed = closed;
  const int steps = std::max(kFewestLinePlaces, static_cast<int>(std::lround(s.back() / step)));
  line.step = s.back() / steps;
  std::size_t at = 0;
  for (int k = 0; k < steps + (closed ? 0 : 1); ++k) {
    const double wanted = line.step * k;
    while (at + 2 < s.size() && s[at + 1] < wanted) ++at;
    const double width = s[at + 1] - s[at], f = width > 0.0 ? std::clamp((wanted - s[at]) / width, 0.0, 1.0) : 0.0;
    line.points.push_back(fine[at] + f * (fine[at + 1] - fine[at]));
  }
  return line;
}

}  // namespace

EvenLine evenLine(const NurbsCurve& curve, bool closed, double step) {
  constexpr int kFewestPerSpan = 6;  // chords that a span is measured by, and steps of the line at the least
  std::vector<Vec2> fine;
  const std::vector<double> breaks = curve.breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double width = breaks[i + 1] - breaks[i];
    double rough = 0.0;
    Vec2 last = curve.point(breaks[i]);
    for (int k = 1; k <= kFewestPerSpan; ++k) {
      const Vec2 next = curve.point(breaks[i] + width * k / kFewestPerSpan);
      rough += (next - last).norm();
      last = next;
    }
    const int count = std::max(kFewestPerSpan, static_cast<int>(std::ceil(2.0 * rough / step)));
    for (int k = 0; k < count; ++k) fine.push_back(curve.point(breaks[i] + width * k / count));
  }
  fine.push_back(curve.point(curve.end()));
  return evenPolyline(fine, closed, step);
}

int cutNecks(EvenLine& line, double scale, const RunContext& context) {
  const int n = line.size();
  const int longest = std::min(static_cast<int>(kLongestNeck * scale / line.step), line.closed ? n / 2 : n - 1);
  struct Neck {
    int first, length;
  };
  std::vector<Neck> necks;
  for (int i = 0; i < n; ++i) {
    if (context.isCancelled()) return 0;
    Neck found{i, 0};
    for (int length = static_cast<int>(kShortestNeck * scale / line.step); length <= longest; ++length) {
      if (!line.closed && i + length >= n) break;
      const double mouth = (line.points[(i + length) % n] - line.points[i]).norm();
      if (mouth < kMouth * scale && length * line.step > kNeckDepth * mouth + kShortestNeck * scale)
        found.length = length;
    }
    if (found.length > 0) necks.push_back(found);
  }
  std::stable_sort(necks.begin(), necks.end(), [](const Neck& a, const Neck& b) { return a.length > b.length; });
  std::vector<bool> cut(line.points.size(), false);
  int count = 0;
  for (const Neck& neck : necks) {
    const auto place = [&](int k) { return (neck.first + k) % n; };
    bool isFree = true;
    for (int k = 0; k <= neck.length && isFree; ++k) isFree = !cut[place(k)];
    if (!isFree) continue;
    for (int k = 1; k < neck.length; ++k) cut[place(k)] = true;
    ++count;
  }
  if (count == 0) return 0;
  std::vector<Vec2> left;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    if (!cut[i]) left.push_back(line.points[i]);
  }
  if (line.closed) left.push_back(left.front());
  line = evenPolyline(left, line.closed, line.step);
  return count;
}

std::vector<ScaleCorner> cornersAtScale(const EvenLine& line, double scale) {
  if (line.size() < kFewestLinePlaces || !(scale > 0.0)) return {};
  return CornerSearch(line, scale).find();
}

}  // namespace batten
