// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/turn_cuts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/angle.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

// In samples, one stroke width apart.
constexpr int kCutChord = 5, kCutBeyond = 15;       // chords end there; what lies beyond says how the line bends
constexpr int kLeastPart = 3;                       // a shorter part has no direction
constexpr int kShortCutChord = 3, kPlaceReach = 2;  // of the shorter chords; from where a corner is seen to where it is
constexpr double kShortShare = 0.75;  // of the turn: chords as short see as much of a corner, but two thirds of an arc
constexpr double kArcSamples = 6.0;   // as much of the bend beyond counts as no corner
constexpr double kMostArc = 120.0 * kRadPerDeg;        // a line that curls beyond a corner must not hide it
constexpr double kLeastTurn = 40.0 * kRadPerDeg;       // of a corner,
constexpr double kLeastBeyondArc = 24.0 * kRadPerDeg;  // by more than an arc's

// A line in steps of about one stroke width.
class TurnSearch {
 public:
  TurnSearch(const Contour& line, double widthPx) : closed_(line.closed) {
    const std::vector<Vec2> points = positionsOf(line.points);
    const std::vector<double> arc = cumulativeLength(points);
    const double length = polylineLength(points, line.closed);
    const int steps = static_cast<int>(std::lround(length / widthPx));
    const int samples = line.closed ? steps : steps + 1;
    if (points.size() < 2 || steps < 2 * kLeastPart) return;
    int at = 0;
    for (int k = 0; k < samples; ++k) {
      const double along = length * k / steps;
      while (at + 1 < std::ssize(arc) && arc[at + 1] <= along) ++at;
      const double end = at + 1 < std::ssize(arc) ? arc[at + 1] : length;
      const Vec2& next = points[wrapIndex(at + 1, static_cast<int>(points.size()))];
      const double f = end > arc[at] ? std::clamp((along - arc[at]) / (end - arc[at]), 0.0, 1.0) : 0.0;
      const bool isLast = at + 1 == std::ssize(arc) && !line.closed;
      samples_.push_back({isLast ? points[at] : Vec2(points[at] + f * (next - points[at])),
                          wrapIndex(f < 0.5 || isLast ? at : at + 1, static_cast<int>(points.size()))});
    }
  }

  /// Points of the line at which it is cut, ascending.
  std::vector<int> cuts() const {
    struct ScoredSample {
      int sample;
      double score;
    };
    std::vector<ScoredSample> turns;
    const int n = static_cast<int>(samples_.size());
    for (int i = 0; i < n; ++i) {
      if (const auto score = scoreAt(i)) turns.push_back({i, *score});
    }
    const auto isBeside = [&](int a, int b) {
      const int apart = std::abs(a - b);
      return (closed_ ? std::min(apart, n - apart) : apart) <= kCutChord;
    };
    std::vector<int> points;
    for (const ScoredSample& turn : turns) {
      // What lies beside a sharper turn sees a part of it.
      const bool isPart = std::ranges::any_of(turns, [&](const ScoredSample& other) {
        return isBeside(other.sample, turn.sample) &&
               (other.score > turn.score || (other.score == turn.score && other.sample < turn.sample));
      });
      if (!isPart) points.push_back(samples_[sharpestBeside(turn.sample)].point);
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  }

 private:
  // How far the line goes on from a sample, up to `most`.
  int room(int i, int side, int most) const {
    const int n = static_cast<int>(samples_.size());
    if (closed_) return std::min(most, n / 2);
    return std::min(most, side < 0 ? i : n - 1 - i);
  }
  Vec2 chord(int from, int to) const {
    const int n = static_cast<int>(samples_.size());
    return samples_[wrapIndex(to, n)].at - samples_[wrapIndex(from, n)].at;
  }
  static double angleBetween(const Vec2& in, const Vec2& out) { return std::atan2(cross(in, out), in.dot(out)); }

  // [rad per sample] By which the line goes on bending on one side, in the direction of travel.
  double bendBeyond(int i, int side) const {
    const int far = room(i, side, kCutBeyond), reach = far - kCutChord, half = reach / 2;
    if (half < 2) return 0.0;
    const int a = i + side * kCutChord, b = a + side * half, c = b + side * half;
    return (side > 0 ? angleBetween(chord(a, b), chord(b, c)) : angleBetween(chord(c, b), chord(b, a))) / half;
  }

  // [rad] By how much the line turns beyond what an arc would; absent: no corner.
  std::optional<double> scoreAt(int i) const {
    const int before = room(i, -1, kCutChord), after = room(i, 1, kCutChord);
    if (before < kLeastPart || after < kLeastPart) return std::nullopt;
    const double turn = angleBetween(chord(i - before, i - 1), chord(i + 1, i + after));
    const double bend = std::copysign(0.5, turn) * (bendBeyond(i, -1) + bendBeyond(i, 1));
    const double arc = std::clamp(kArcSamples * bend, 0.0, kMostArc);
    if (std::abs(turn) <= kLeastTurn || std::abs(turn) - arc <= kLeastBeyondArc) return std::nullopt;
    const int shortBefore = room(i, -1, kShortCutChord), shortAfter = room(i, 1, kShortCutChord);
    const double shortTurn = angleBetween(chord(i - shortBefore, i - 1), chord(i + 1, i + shortAfter));
    if (shortTurn / turn < kShortShare) return std::nullopt;
    return std::abs(turn) - arc;
  }

  // Where chords that meet in a sample turn most.
  int sharpestBeside(int i) const {
    int best = i;
    double most = 0.0;
    for (int k = i - kPlaceReach; k <= i + kPlaceReach; ++k) {
      const int before = room(k, -1, kCutChord), after = room(k, 1, kCutChord);
      if (before < kLeastPart || after < kLeastPart) continue;
      const double turn = std::abs(angleBetween(chord(k - before, k), chord(k, k + after)));
      if (turn > most) most = turn, best = k;
    }
    return wrapIndex(best, static_cast<int>(samples_.size()));
  }

  struct Sample {
    Vec2 at;
    int point;  // of the line, nearest to the sample
  };
  bool closed_;
  std::vector<Sample> samples_;
};

}  // namespace

std::vector<int> sharpPlacesOf(const Contour& line, double widthPx) { return TurnSearch(line, widthPx).cuts(); }

Contour cutPart(const Contour& line, int from, int to) {
  const int n = static_cast<int>(line.points.size());
  Contour part = line;
  part.closed = false;
  part.endsInInk[0] = line.endsInInk[0] && !line.closed && from == 0;
  part.endsInInk[1] = line.endsInInk[1] && !line.closed && to == n - 1;
  part.points.clear();
  part.bridges.clear();
  for (int i = from; i <= to; ++i) part.points.push_back(line.points[wrapIndex(i, n)]);
  for (const auto& [first, last] : line.bridges) {
    for (const int shift : {0, n}) {
      const int a = std::max(first + shift, from), b = std::min(last + shift, to);
      if (a <= b && (shift == 0 || line.closed)) part.bridges.emplace_back(a - from, b - from);
    }
  }
  measureContour(part);
  return part;
}

std::vector<Contour> cutAtTurns(const std::vector<Contour>& lines, double widthPx, CancelCheck check) {
  std::vector<Contour> parts;
  for (const Contour& line : lines) {
    if (check.isCancelled()) return {};
    const std::vector<int> cuts = sharpPlacesOf(line, widthPx);
    const int n = static_cast<int>(line.points.size());
    if (cuts.empty()) {
      parts.push_back(line);
    } else if (line.closed) {
      for (std::size_t i = 0; i < cuts.size(); ++i)
        parts.push_back(cutPart(line, cuts[i], i + 1 < cuts.size() ? cuts[i + 1] : cuts[0] + n));
    } else {
      int from = 0;
      for (const int cut : cuts) parts.push_back(cutPart(line, std::exchange(from, cut), cut));
      parts.push_back(cutPart(line, from, n - 1));
    }
  }
  return parts;
}

}  // namespace batten
