// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/growing_stretch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/angle.h"
#include "core/construct/typical/typical_feet.h"
#include "core/solve/dense_solve.h"
#include "core/solve/residual_blocks.h"

namespace batten {

namespace {

/// How far a curve is run on; the shorter way where the longer one fails.
constexpr std::array<double, 2> kExtrapolations = {1.35, 1.12};
/// Segments shorter than this [px] mean that the growing has come to an end of its own.
constexpr double kShortestPx = 6.0;
constexpr double kLargestGrownTurn = 0.7;  // [rad] from edge to edge: beyond, a fit is not good enough
constexpr double kMostSeedTurnRad = 1.2;   // of a curve that goes on from one before: the fit may let it turn more
/// A fit whose points lie this far [px] to one side in the mean has lost the line, whatever its normals say.
constexpr double kLostPx = 0.25;
/// Half of the stretch [px] from whose points a normal is taken.
constexpr double kNormalReachPx = 16.0;
constexpr std::size_t kBesideNearest = 3;  // points to either side at least, where they are sparse
constexpr std::size_t kFewestNear = 8;     // points of a first curve that can tell its direction and curvature too
constexpr int kMostSteps = 400;            // curves of a stretch: ends what does not come to its end
/// Points behind a curve's start that are looked at, and the line [of the curve's size, and px] in which its own lie.
constexpr std::size_t kBehind = 2;
constexpr double kReachOfSize = 1.5, kReachPx = 10.0;  // the line
// Unknowns of the first curve of a chain, by which they are held where the points say nothing.
constexpr double kFirstPointPx = 0.3;                         ///< [px] standard deviation of a point
constexpr double kFirstAngleRad = 0.1, kFirstLogKappa = 0.4;  ///< as the seed is known, from a few directions
constexpr double kFirstLogTurn = 0.4;                         // of its change of direction
// A fit of the change of direction.
constexpr int kTurnFits = 12;
constexpr double kTurnDifference = 1e-5;                    ///< Relative, of its derivative.
constexpr double kMostTurnLess = 0.3, kMostTurnMore = 0.5;  ///< Of the turn, in one step.
constexpr double kTurnSettled = 1e-7;                       ///< [rad]
constexpr double kAtEnd = 1e-6;                             ///< [parameter] so far beyond an end is at it.
// The last curve ends at the foot of the end of the line, by its parameter; others are kept to their middle, where
// the points beyond their end have not bent them (002 keeps all, and starts the next with this part of their size).
constexpr double kShortestLast = 0.05, kLongestLast = 1.3, kKeptPart = 0.5, kNextSeed = 0.4;
constexpr double kPassedShareOfSize = 0.5, kPassedPx = 10.0;  ///< Of a curve, from which the end lies away at most.
/// Points whose mean distance is looked at: at least so many, and a quarter of those of the curve.
constexpr std::size_t kFewestGrouped = 10, kQuarters = 4;
constexpr int kMostGrowths = 60;                             ///< Of one curve.
constexpr double kSmallestRatio = 0.3, kLargestRatio = 3.0;  ///< Of a grown curve's edges: beyond, it is a spiral.

class Grower {
 public:
  Grower(const TypicalLine& line, const ConstructParams& params, StepRecord steps)
      : line_(line), params_(params), keepsSteps_(steps == StepRecord::Kept) {}

  GrownCurves grow(const GrowingStart& start, const GrowingStretch& stretch, const RunContext& context) {
    points_ = stretch.points;
    passed_ = 0;
    isFree_ = start.isFree;
    kept_ = {};
    kept_.end = start.state;
    kept_.segment = start.segment;
    // Nothing to grow along: what the joints know of this stretch is better than a curve that follows nothing.
    if (points_.empty()) return std::move(kept_);
    const Vec2 end = line_.joints[stretch.lastJoint].point;
    if (stretch.isOne) {
      growAtOnce(start, stretch, end);
    } else {
      growOn(start, stretch, end, context);
    }
    return std::move(kept_);
  }

 private:
  /// Curve after curve, until the last one reaches the end of the stretch.
  void growOn(const GrowingStart& start, const GrowingStretch& stretch, const Vec2& end, const RunContext& context) {
    auto curve = seed(start.state, stretch, start.isFree);
    for (int i = 0; i < kMostSteps && curve && !context.isCancelled(); ++i) {
      const auto [grown, reachesEnd] = growOne(*curve, end, context);
      TypicalCurve stays = grown;
      if (reachesEnd) {
        const auto foot = feetOn(grown, std::array{end});
        stays = grown.toParameter(std::clamp(foot[0].t, kShortestLast, kLongestLast));
      } else if (!params_.growingAsInPaper) {
        stays = grown.toParameter(kKeptPart);
      }
      if (stays.size() < kShortestPx) break;
      keep(stays);
      passed_ = nearestTo(stays.endJoint().point);
      passed_ = passed_ > kBehind ? passed_ - kBehind : 0;
      isFree_ = false;
      if (reachesEnd) break;
      ++kept_.segment;
      curve = continued(stays, params_.growingAsInPaper ? kNextSeed * stays.size() : grown.size() - stays.size());
      if (curve) {
        rested_ = refit(*curve);
        record(GrowingStep::Kind::Seed, *curve, false);
      }
    }
  }

  void keep(const TypicalCurve& curve) {
    kept_.rested = kept_.rested && rested_;
    record(GrowingStep::Kind::Kept, curve, false);
    kept_.curves.push_back(curve);
    kept_.end = endOf(curve);
  }

  static PathState endOf(const TypicalCurve& last) {
    const Joint joint = last.endJoint();
    return {joint.point, last.angleRad + 2.0 * last.turnRad, joint.kappa};
  }

  /// One curve from end to end, bent until it meets the points.
  void growAtOnce(const GrowingStart& start, const GrowingStretch& stretch, const Vec2& end) {
    auto curve = spanning(start.state, stretch.firstJoint, stretch.lastJoint);
    if (!curve) return;
    rested_ = start.isFree ? refitWhole(*curve) : refit(*curve);
    record(GrowingStep::Kind::Seed, *curve, false);
    const auto foot = feetOn(*curve, std::array{end});
    keep(curve->toParameter(std::clamp(foot[0].t, kShortestLast, kLongestLast)));
  }

  /// The end of the stretch lies on the curve, and not behind its start, where the end of a closed line is, nor across
  /// a turn of it.
  static bool isPassed(const TypicalCurve& c, const Vec2& end) {
    const CurveFoot foot = feetOn(c, std::array{end}).front();
    const double away = std::abs(foot.distance);
    return foot.t > 0.0 && foot.t <= 1.0 + kAtEnd && away <= kPassedShareOfSize * c.size() + kPassedPx;
  }

  /// A curve over joints: their length and change of direction.
  std::optional<TypicalCurve> spanning(const PathState& from, std::size_t first, std::size_t last) const {
    double size = 0.0, turn = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      const Joint &a = line_.joints[i], &b = line_.joints[i + 1];
      size += (b.point - a.point).norm();
      turn += std::atan2(cross(a.tangent, b.tangent), a.tangent.dot(b.tangent));
    }
    return typicalFromForm(from.point, from.angleRad, from.kappa, size, turn);
  }

  /// The points beside a curve. Only those near its start and as far along the line as it can reach are looked at: a
  /// closed line has others on its far side, which lie beyond its end as well.
  std::span<const Vec2> pointsOn(const TypicalCurve& c) const {
    const std::size_t near = nearestTo(c.start), begin = near > kBehind ? near - kBehind : 0;
    std::size_t end = begin + 1;
    for (double length = 0.0; end < points_.size() && length < kReachOfSize * c.size() + kReachPx; ++end)
      length += (points_[end] - points_[end - 1]).norm();
    const std::span<const Vec2> beside = std::span(points_).subspan(begin, end - begin);
    const std::vector<CurveFoot> feet = feetOn(c, beside);
    std::size_t first = 0;
    while (first < beside.size() && feet[first].t < 0.0) ++first;
    const auto past = std::find_if(feet.begin() + static_cast<std::ptrdiff_t>(first), feet.end(),
                                   [](const CurveFoot& foot) { return foot.t > 1.0; });
    return beside.subspan(first, past - feet.begin() - first);
  }

  /// The point nearest to a place that lies ahead of what has grown; a closed line's last points are not its first.
  std::size_t nearestTo(const Vec2& place) const {
    std::size_t best = passed_;
    for (std::size_t i = passed_; i < points_.size() && i - passed_ <= points_.size() / 2; ++i)
      if ((points_[i] - place).squaredNorm() < (points_[best] - place).squaredNorm()) best = i;
    return best;
  }

  /// A small curve fitted to the first points: direction, curvature and change of direction.
  std::optional<TypicalCurve> seed(const PathState& from, const GrowingStretch& stretch, bool freeStart) {
    auto first = spanning(from, stretch.firstJoint, std::min(stretch.firstJoint + 2, stretch.lastJoint));
    if (first && std::abs(first->turnRad) < kLargestGrownTurn && freeStart) rested_ = refitWhole(*first);
    if (first) record(GrowingStep::Kind::Seed, *first, false);
    return first;
  }

  /// While nothing comes before it, a curve also finds its direction and curvature at the start.
  /// @return whether the fit came to rest.
  bool refitWhole(TypicalCurve& c) const {
    const auto near = pointsOn(c);
    if (near.size() < kFewestNear) return true;
    const double size = c.size(), kappa = c.startCurvature();
    const auto curveOf = [&](std::span<const double> x) {
      return typicalFromForm(c.start, c.angleRad + x[0], kappa * std::exp(x[1]), size,
                             2.0 * c.turnRad * std::exp(x[2]));
    };
    ResidualBlock block{
        {0, 1, 2}, static_cast<int>(near.size()) + 3, [&](std::span<const double> x, std::span<double> r) {
          const auto moved = curveOf(x);
          const auto feet = moved ? feetOn(*moved, near) : std::vector<CurveFoot>{};
          for (std::size_t i = 0; i < near.size(); ++i) {
            r[i] = moved ? feet[i].distance / kFirstPointPx : std::numeric_limits<double>::quiet_NaN();
          }
          r[near.size()] = x[0] / kFirstAngleRad;
          r[near.size() + 1] = x[1] / kFirstLogKappa;
          r[near.size() + 2] = x[2] / kFirstLogTurn;
        }};
    const auto solved =
        minimiseBlocks(Eigen::Vector3d::Zero(), Eigen::Vector3d(kFirstAngleRad, 1.0, 1.0), std::array{block}, {});
    if (const auto better = curveOf(std::span(solved.x.data(), 3))) c = *better;
    return solved.run.why != Termination::IterationLimit;
  }

  static std::optional<TypicalCurve> continued(const TypicalCurve& before, double size) {
    const Joint joint = before.endJoint();
    const double turn = joint.kappa * size;
    return typicalFromForm(joint.point, before.angleRad + 2.0 * before.turnRad, joint.kappa, size,
                           std::copysign(std::clamp(std::abs(turn), kLeastStartTurnRad, kMostSeedTurnRad), turn));
  }

  /// Bends the curve until it meets the points: only the change of direction moves (002 section 5).
  /// @return whether it came to rest; also true where there is nothing to meet.
  bool refit(TypicalCurve& c) const {
    const double size = c.size(), kappa = c.startCurvature();
    for (int i = 0; i < kTurnFits; ++i) {
      const auto near = pointsOn(c);
      if (near.size() < 3) return true;
      double step = 0.0;
      const FormGradient gradient = formGradient(c);
      if (params_.growingAsInPaper) {
        // Where the path of the end point crosses the line of the points.
        const double c0 = std::cos(c.angleRad), s0 = std::sin(c.angleRad);
        const Vec2 path(c0 * gradient.endByTurn.x() - s0 * gradient.endByTurn.y(),
                        s0 * gradient.endByTurn.x() + c0 * gradient.endByTurn.y());
        const Joint end = c.endJoint();
        const auto local = lineNear(end.point);
        const Vec2 normal = leftNormal(local.direction);
        const double across = path.dot(normal);
        if (!(std::abs(across) > 1e-9)) return true;
        step = (local.point - end.point).dot(normal) / across;
      } else {
        // Least squares over all points: the influence of the turn grows with the third power along the curve.
        const auto moved =
            typicalFromForm(c.start, c.angleRad, kappa, size, 2.0 * (c.turnRad * (1.0 + kTurnDifference)));
        if (!moved) return false;
        const auto here = feetOn(c, near), there = feetOn(*moved, near);
        double top = 0.0, bottom = 0.0;
        for (std::size_t k = 0; k < near.size(); ++k) {
          const double slope = (there[k].distance - here[k].distance) / (kTurnDifference * c.turnRad);
          top += slope * here[k].distance;
          bottom += slope * slope;
        }
        if (!(bottom > 0.0)) return true;
        step = -top / bottom;
      }
      const double next =
          c.turnRad + std::clamp(step, -kMostTurnLess * std::abs(c.turnRad), kMostTurnMore * std::abs(c.turnRad));
      const auto better = typicalFromForm(c.start, c.angleRad, kappa, size, 2.0 * next);
      if (!better) return false;
      const double change = std::abs(next - c.turnRad);
      c = *better;
      if (change < kTurnSettled) return true;
    }
    return false;
  }

  /// The best fit over as many points as one curve can take. Where not even the first fits, the curve itself.
  struct GrownCurve {
    TypicalCurve curve;
    bool reachesEnd = false;
  };
  GrownCurve growOne(TypicalCurve c, const Vec2& end, const RunContext& context) {
    for (std::size_t i = 0, extrapolation = 0;
         i < kMostGrowths && extrapolation < kExtrapolations.size() && !context.isCancelled(); ++i) {
      if (isPassed(c, end)) return {c, true};
      TypicalCurve longer = c.toParameter(kExtrapolations[extrapolation]);
      record(GrowingStep::Kind::Extrapolated, longer, false);
      const bool rested = isFree_ ? refitWhole(longer) : refit(longer);
      const bool fits = std::abs(longer.turnRad) < kLargestGrownTurn && longer.ratio > kSmallestRatio &&
                        longer.ratio < kLargestRatio && deviation(longer) < params_.growingStopDeg * kRadPerDeg &&
                        distance(longer) < kLostPx;
      record(GrowingStep::Kind::Fitted, longer, !fits);
      if (fits) {
        c = longer;
        rested_ = rested;
      } else {
        ++extrapolation;
      }
    }
    return {c, false};
  }

  struct LocalLine {
    Vec2 point, direction;
  };
  /// Place and direction of the points near a place: local parabola. @pre there are points.
  LocalLine lineNear(const Vec2& place) const {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < points_.size(); ++i) {
      if ((points_[i] - place).squaredNorm() < (points_[nearest] - place).squaredNorm()) nearest = i;
    }
    std::size_t first = nearest, last = nearest;
    while (first > 0 && (points_[first - 1] - place).norm() < kNormalReachPx) --first;
    while (last + 1 < points_.size() && (points_[last + 1] - place).norm() < kNormalReachPx) ++last;
    first = last - first < 2 * kBesideNearest ? (first > kBesideNearest ? first - kBesideNearest : 0) : first;
    last = last - first < 2 * kBesideNearest ? std::min(points_.size() - 1, last + kBesideNearest) : last;
    const Vec2 chord = points_[last] - points_[first];
    const Vec2 along = chord.norm() > 0.0 ? Vec2(chord.normalized()) : Vec2::UnitX();
    const Vec2 normal = leftNormal(along);
    Eigen::MatrixXd a(static_cast<Eigen::Index>(last - first + 1), 3);
    Eigen::VectorXd b(a.rows());
    for (std::size_t i = first; i <= last; ++i) {
      const double x = (points_[i] - place).dot(along);
      const auto row = static_cast<Eigen::Index>(i - first);
      a.row(row) << 1.0, x, x * x;
      b(row) = (points_[i] - place).dot(normal);
    }
    const Eigen::Vector3d parabola = leastSquares(a, b);
    return {place + parabola(0) * normal, (along + parabola(1) * normal).normalized()};
  }

  double deviation(const TypicalCurve& c) const {
    const Joint end = c.endJoint();
    const Vec2 direction = lineNear(end.point).direction;
    return std::abs(std::atan2(cross(direction, end.tangent), direction.dot(end.tangent)));
  }
  double distance(const TypicalCurve& c) const {
    const std::vector<CurveFoot> feet = feetOn(c, pointsOn(c));
    const std::size_t group = std::max(kFewestGrouped, feet.size() / kQuarters);
    double most = 0.0;
    for (std::size_t i = 0; i + group <= feet.size(); i += group) {
      double mean = 0.0;
      for (std::size_t k = i; k < i + group; ++k) mean += feet[k].distance / static_cast<double>(group);
      most = std::max(most, std::abs(mean));
    }
    return most;
  }

  void record(GrowingStep::Kind kind, const TypicalCurve& c, bool stops) {
    if (!keepsSteps_) return;
    GrowingStep step{kind, kept_.segment, c, deviation(c), distance(c), stops};
    step.curve.start = line_.toPiece(c.start);
    kept_.steps.push_back(step);
  }

  const TypicalLine& line_;
  const ConstructParams& params_;
  bool keepsSteps_;
  GrownCurves kept_;
  std::vector<Vec2> points_;
  std::size_t passed_ = 0;  ///< About the point to which the kept curves reach.
  bool isFree_ = true;
  bool rested_ = true;  ///< The fit that gave the curve in hand came to rest.
};

}  // namespace

GrownCurves growStretch(const TypicalLine& line, const ConstructParams& params, const GrowingStretch& stretch,
                        const GrowingStart& start, StepRecord steps, const RunContext& context) {
  return Grower(line, params, steps).grow(start, stretch, context);
}

}  // namespace batten
