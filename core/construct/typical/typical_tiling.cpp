// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_tiling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/construct/typical/typical_path_geometry.h"
#include "core/curve/arc_length.h"
#include "core/curve/foot_step.h"

namespace batten {
namespace {

/// Places of the fair curve at which pieces may meet [units apart], and how many at most.
constexpr double kStep = 3.0;
constexpr int kFewest = 60, kMost = 2500;  // places
/// In sharp turns they lie closer: up to this many in one step, one whenever the line has turned by so much [rad].
constexpr std::size_t kFiner = 12;
constexpr double kTurnOfStep = 0.08;  // [rad]
/// How far a piece may lie from the fair curve [units]: the fit that follows moves it less than that.
constexpr double kTypicalMiss = 0.12, kHermiteMiss = 0.005;
/// Turn of one piece, and of the shortest typical curve that is worth it [rad]; its length [units].
constexpr double kMostTurn = 0.8, kLeastTurn = 0.04, kLeastLength = 20.0;
/// A Hermite piece that gives way to a typical curve is at least this long [units]: a sliver would take up what both
/// neighbours leave.
constexpr double kLeastHermite = 45.0;
/// No piece is shorter [units], however sharply the line turns: room for the fit above kShortestSegment.
constexpr double kShortestTile = 2.0 * kShortestSegment;
constexpr double kMostLogRatio = 1.2;  // of a tile: room below the largest of an element
/// [rad] Half the change of direction of a tile: a straight one has a logarithm, too.
constexpr double kLeastTileTurn = 1e-6;
/// Room on the border of monotone curvature, so that the fit begins inside.
constexpr double kBorderRoom = 1.02;
/// Newton steps from a guess that is off by a few per cent.
constexpr int kTileFootSteps = 4;
/// The end of a piece is sought in steps of this part of its length.
constexpr int kStepsAlong = 12;
/// Places of a rest at the end of the line that is shared out with the piece before.
constexpr int kShortRest = 4;

struct Place {
  PathState state;
  double s = 0.0;
};

class Tiling {
 public:
  explicit Tiling(const TypicalLine& line) : closed_(line.closed) {
    const double length = ArcLength(*line.fair).total();
    const double step = length / std::clamp(static_cast<int>(length / kStep), kFewest, kMost);
    const int fine = static_cast<int>(std::lround(length / step)) * static_cast<int>(kFiner) + 1;
    double angle = 0.0;
    const auto samples = sampleByArcLength(*line.fair, fine);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const CurveSample& sample = samples[i];
      angle += std::remainder(std::atan2(sample.tangent.y(), sample.tangent.x()) - angle, 2.0 * std::numbers::pi);
      const bool regular = i % kFiner == 0;
      const bool turns = !regular && std::abs(angle - places_.back().state.angleRad) > kTurnOfStep;
      if (!regular && !turns) continue;
      places_.push_back({{line.toLine(sample.point), angle, sample.kappa}, sample.s});
    }
    findTurns();
  }

  std::optional<TypicalPath> build() const {
    TypicalPath path;
    path.closed = closed_;
    path.states.push_back(places_.front().state);
    const int last = static_cast<int>(places_.size()) - 1;
    for (int i = 0; i < last;) {
      const int typical = withoutSliver(i, farthestTypical(i));
      if (isWorthIt(i, typical)) {
        append(path, i, typical, true);
        i = typical;
        continue;
      }
      // As far as a Hermite piece goes, or to where a typical curve can take over.
      int next = farthestHermite(i);
      for (int k = i + 1; k < next; ++k) {
        if (at(k).s - at(i).s < kLeastHermite || !isWorthIt(k, farthestTypical(k))) continue;
        next = k;
        break;
      }
      append(path, i, next, false);
      i = next;
    }
    if (closed_) path.states.back() = path.states.front();
    return path.update() ? std::optional(std::move(path)) : std::nullopt;
  }

 private:
  const Place& at(int i) const { return places_[i]; }
  double kappa(int i) const { return at(i).state.kappa; }

  /// Where the curvature next turns back or changes sign, per place.
  void findTurns() {
    const int last = static_cast<int>(places_.size()) - 1;
    turn_.assign(places_.size(), last);
    for (int i = last - 2; i >= 0; --i) {
      const double first = kappa(i + 1) - kappa(i), second = kappa(i + 2) - kappa(i + 1);
      const bool turns = first * second < 0.0 || !(kappa(i) * kappa(i + 1) > 0.0);
      turn_[i] = turns ? i + 1 : turn_[i + 1];
    }
  }

  PathElement elementFor(int i, int j) const {
    PathElement element;
    const double turned = at(j).state.angleRad - at(i).state.angleRad;
    element.side = turned > 0.0 ? 1.0 : -1.0;
    element.logTurn = std::log(std::max(0.5 * std::abs(turned), kLeastTileTurn));
    element.shape = 0.25 * std::log(kappa(i) / kappa(j));
    return element;
  }

  bool fitsTypical(int i, int j) const {
    const double turned = at(j).state.angleRad - at(i).state.angleRad;
    if (!(kappa(i) * turned > 0.0) || !(kappa(i) * kappa(j) > 0.0)) return false;
    const PathElement element = elementFor(i, j);
    const double border = -std::log(std::cos(element.turn()));
    if (std::abs(element.shape) > kMostLogRatio || std::abs(element.shape) < kBorderRoom * border) return false;
    TypicalPath one;
    one.elements = {element};
    one.states = {at(i).state, at(j).state};
    if (!one.update()) return false;
    if ((one.states[1].point - at(j).state.point).norm() > kTypicalMiss) return false;
    const PathGeometry geometry(one, 0);
    return nearMiddle(geometry, i, j, kTypicalMiss);
  }

  /// Distance of the fair curve's middle from the piece.
  bool nearMiddle(const PathGeometry& geometry, int i, int j, double most) const {
    for (const int k : {(3 * i + j) / 4, (i + j) / 2, (i + 3 * j) / 4}) {
      const Vec2 p = at(k).state.point;
      double t = (at(k).s - at(i).s) / (at(j).s - at(i).s);
      for (int round = 0; round < kTileFootSteps; ++round) {
        const auto d = geometry.at(t, 2);
        if (!(d[1].squaredNorm() > 0.0)) return false;
        t = std::clamp(t + footStep(d[0] - p, d[1], d[2]), 0.0, 1.0);
      }
      if ((geometry.at(t, 0)[0] - p).norm() > most) return false;
    }
    return true;
  }

  /// The farthest place that one typical curve reaches; the place itself if there is none.
  int farthestTypical(int i) const {
    const int end = turn_[i];
    int far = i;
    while (far < end && std::abs(at(far + 1).state.angleRad - at(i).state.angleRad) < kMostTurn) ++far;
    for (int j = far; j > i; j -= std::max(1, (j - i) / kStepsAlong)) {
      if (fitsTypical(i, j)) return j;
    }
    return i;
  }

  bool isWorthIt(int i, int j) const {
    return at(j).s - at(i).s >= kLeastLength && std::abs(at(j).state.angleRad - at(i).state.angleRad) >= kLeastTurn;
  }

  /// A typical curve that would leave too little for a Hermite piece at the end of the line stops earlier. A closed
  /// line ends with one, which meets the start exactly.
  int withoutSliver(int i, int j) const {
    const int last = static_cast<int>(places_.size()) - 1;
    const bool mayEnd = !closed_ && (j == last || isWorthIt(j, farthestTypical(j)));
    if (mayEnd || at(last).s - at(j).s >= kLeastHermite) return j;
    while (j > i && at(last).s - at(j).s < kLeastHermite) --j;
    while (j > i && !fitsTypical(i, j)) --j;
    return j;
  }

  double between(int i, int j) const { return (at(j).state.point - at(i).state.point).norm(); }
  bool isAtEnd(int i) const { return places_.back().s - at(i).s < kShortestTile; }

  /// The first place that leaves room for a segment; the last one if there is none.
  int nextPlace(int i) const {
    const int last = static_cast<int>(places_.size()) - 1;
    int next = std::min(i + 1, last);
    while (next < last && between(i, next) < kShortestTile) ++next;
    return isAtEnd(next) ? last : next;
  }

  int farthestHermite(int i) const {
    const int last = static_cast<int>(places_.size()) - 1;
    int best = nextPlace(i);
    for (int j = best + 1; j <= last; j += std::max(1, (j - i) / kStepsAlong)) {
      if (std::abs(at(j).state.angleRad - at(i).state.angleRad) > kMostTurn) break;
      TypicalPath one;
      one.elements.resize(1);
      one.elements[0].typical = false;
      one.states = {at(i).state, at(j).state};
      if (!nearMiddle(PathGeometry(one, 0), i, j, kHermiteMiss)) break;
      best = j;
    }
    if (isAtEnd(best)) return last;
    // A short piece at the end is shared out.
    const int half = (i + last + 1) / 2;
    const bool isShared = last - best < best - i && best < last && last - best < kShortRest &&
                          std::min(between(i, half), between(half, last)) >= kShortestTile;
    return isShared ? half : best;
  }

  void append(TypicalPath& path, int i, int j, bool typical) const {
    PathElement element = elementFor(i, j);
    element.typical = typical;
    if (typical) element.setTrend(element.shape < 0.0 ? Trend::Rising : Trend::Falling);
    if (!typical) element = PathElement{.typical = false};
    path.elements.push_back(element);
    path.states.push_back(at(j).state);
  }

  bool closed_;
  std::vector<Place> places_;
  std::vector<int> turn_;
};

}  // namespace

std::optional<TypicalPath> tiledPath(const TypicalLine& line) {
  if (!line.fair || line.fair->isEmpty()) return std::nullopt;
  return Tiling(line).build();
}

}  // namespace batten
