// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_grower.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "core/curve/closest_point.h"
#include "core/solve/residual_blocks.h"
#include "core/solve/dense_solve.h"

namespace batten {

namespace {

/// How far a curve is run on; the shorter way where the longer one fails.
constexpr std::array<double, 2> kExtrapolations = {1.35, 1.12};
/// Segments shorter than this [px] mean that the growing has come to an end of its own.
constexpr double kShortestPx = 6.0;
constexpr double kLargestGrownTurn = 0.7;
/// A fit whose points lie this far [px] to one side in the mean has lost the line, whatever its normals say.
constexpr double kLostPx = 0.25;
/// Half of the stretch [px] from whose points a normal is taken.
constexpr double kNormalReachPx = 16.0;
constexpr int kMostSteps = 400;

double sizeOf(const TypicalCurve& c) { return c.edge * (1.0 + c.ratio * std::cos(c.turnRad) + c.ratio * c.ratio); }

std::complex<double> asComplex(const Vec2& v) { return {v.x(), v.y()}; }

/// Signed distances of points from a curve and where their feet are.
struct Feet {
  std::vector<double> distance, t;
};
Feet feetOn(const TypicalCurve& c, std::span<const Vec2> points) {
  const std::complex<double> z = std::polar(c.ratio, c.turnRad), edge = std::polar(c.edge, c.angleRad);
  Feet feet;
  double t = 0.0;
  for (const Vec2& p : points) {
    std::complex<double> d1, away;
    for (int i = 0; i < 15; ++i) {
      const std::complex<double> w = 1.0 + t * (z - 1.0);
      away = asComplex(c.start) + edge * t * (w * w + w + 1.0) - asComplex(p);
      d1 = 3.0 * edge * w * w;
      const double speed = std::norm(d1);
      if (!(speed > 0.0)) break;
      const double bend = std::max(speed + (std::conj(away) * 6.0 * edge * w * (z - 1.0)).real(), 0.2 * speed);
      const double step = std::clamp(-(std::conj(away) * d1).real() / bend, -0.5, 0.5);
      t = std::clamp(t + step, -0.3, 1.5);
      if (std::abs(step) < 1e-8) break;
    }
    feet.distance.push_back(-(std::conj(d1) * away).imag() / std::max(std::abs(d1), 1e-300));
    feet.t.push_back(t);
  }
  return feet;
}

class Grower {
 public:
  Grower(const TypicalLine& line, const ConstructParams& params, GrowingRecord& record)
      : line_(line), params_(params), record_(record) {}

  /// Segments from the state over the stretch; the state becomes where they end.
  std::vector<TypicalCurve> grow(PathState& from, const GrowingStretch& stretch, bool freeStart,
                                 const RunContext& context) {
    points_ = stretch.points;
    isFree_ = freeStart;
    std::vector<TypicalCurve> kept;
    // Nothing to grow along: what the joints know of this stretch is better than a curve that follows nothing.
    if (points_.empty()) return kept;
    auto curve = seed(from, stretch, freeStart);
    const Vec2 end = line_.joints[stretch.lastJoint].point;
    for (int i = 0; i < kMostSteps && curve && !context.isCancelled(); ++i) {
      bool reachesEnd = false;
      const auto grown = growOne(*curve, end, reachesEnd, context);
      if (!grown) break;
      TypicalCurve stays = *grown;
      if (reachesEnd) {
        const auto foot = feetOn(*grown, std::array{end});
        stays = grown->toParameter(std::clamp(foot.t[0], 0.05, 1.3));
      } else if (!params_.growingAsInPaper) {
        stays = grown->toParameter(0.5);
      }
      if (sizeOf(stays) < kShortestPx) break;
      record_.rested = record_.rested && rested_;
      record(GrowingStep::Kind::Kept, stays, false);
      kept.push_back(stays);
      isFree_ = false;
      if (reachesEnd) break;
      ++record_.segment;
      curve = continued(stays, params_.growingAsInPaper ? 0.4 * sizeOf(stays) : sizeOf(*grown) - sizeOf(stays));
      if (curve) {
        rested_ = refit(*curve);
        record(GrowingStep::Kind::Seed, *curve, false);
      }
    }
    if (!kept.empty()) {
      const Joint joint = kept.back().endJoint();
      from = {joint.point, kept.back().angleRad + 2.0 * kept.back().turnRad, joint.kappa};
    }
    return kept;
  }

 private:
  std::span<const Vec2> pointsOn(const TypicalCurve& c) const {
    const Feet feet = feetOn(c, points_);
    std::size_t first = 0, last = points_.size();
    while (first < last && feet.t[first] < 0.0) ++first;
    // A closed line comes back: what lies beyond the first point past the end is another stretch.
    const auto past = std::find_if(feet.t.begin() + static_cast<std::ptrdiff_t>(first), feet.t.end(),
                                   [](double t) { return t > 1.0; });
    last = static_cast<std::size_t>(past - feet.t.begin());
    return std::span(points_).subspan(first, last - first);
  }

  /// A small curve fitted to the first points: direction, curvature and change of direction.
  std::optional<TypicalCurve> seed(const PathState& from, const GrowingStretch& stretch, bool freeStart) {
    const std::size_t reach = std::min(stretch.firstJoint + 2, stretch.lastJoint);
    double size = 0.0, turn = 0.0;
    for (std::size_t i = stretch.firstJoint; i < reach; ++i) {
      const Joint &a = line_.joints[i], &b = line_.joints[i + 1];
      size += (b.point - a.point).norm();
      turn += std::atan2(cross(a.tangent, b.tangent), a.tangent.dot(b.tangent));
    }
    auto first = typicalFromForm(from.point, from.angleRad, from.kappa, size, turn);
    if (first && std::abs(first->turnRad) < kLargestGrownTurn && freeStart) rested_ = refitWhole(*first);
    if (first) record(GrowingStep::Kind::Seed, *first, false);
    return first;
  }

  /// While nothing comes before it, a curve also finds its direction and curvature at the start.
  /// @return whether the fit came to rest.
  bool refitWhole(TypicalCurve& c) const {
    const auto near = pointsOn(c);
    if (near.size() < 8) return true;
    const double size = sizeOf(c), kappa = c.startCurvature();
    const auto curveOf = [&](std::span<const double> x) {
      return typicalFromForm(c.start, c.angleRad + x[0], kappa * std::exp(x[1]), size,
                             2.0 * c.turnRad * std::exp(x[2]));
    };
    ResidualBlock block{
        {0, 1, 2}, static_cast<int>(near.size()) + 3, [&](std::span<const double> x, std::span<double> r) {
          const auto moved = curveOf(x);
          const Feet feet = moved ? feetOn(*moved, near) : Feet{};
          for (std::size_t i = 0; i < near.size(); ++i) {
            r[i] = moved ? feet.distance[i] / 0.3 : std::numeric_limits<double>::quiet_NaN();
          }
          r[near.size()] = x[0] / 0.1;
          r[near.size() + 1] = x[1] / 0.4;
          r[near.size() + 2] = x[2] / 0.4;
        }};
    const auto solved = minimiseBlocks(Eigen::Vector3d::Zero(), Eigen::Vector3d(0.1, 1.0, 1.0), std::array{block}, {});
    if (const auto better = curveOf(std::span(solved.x.data(), 3))) c = *better;
    return solved.run.why != Termination::IterationLimit;
  }

  static std::optional<TypicalCurve> continued(const TypicalCurve& before, double size) {
    const Joint joint = before.endJoint();
    const double turn = joint.kappa * size;
    return typicalFromForm(joint.point, before.angleRad + 2.0 * before.turnRad, joint.kappa, size,
                           std::copysign(std::clamp(std::abs(turn), 1e-4, 1.2), turn));
  }

  /// Bends the curve until it meets the points: only the change of direction moves (002 section 5).
  /// @return whether it came to rest; also true where there is nothing to meet.
  bool refit(TypicalCurve& c) const {
    const double size = sizeOf(c), kappa = c.startCurvature();
    for (int i = 0; i < 12; ++i) {
      const auto near = pointsOn(c);
      if (near.size() < 3) return true;
      double step = 0.0;
      const FormGradient gradient = formGradient(c);
      if (params_.growingAsInPaper) {
        // Where the way of the end point crosses the line of the points.
        const double c0 = std::cos(c.angleRad), s0 = std::sin(c.angleRad);
        const Vec2 way(c0 * gradient.endByTurn.x() - s0 * gradient.endByTurn.y(),
                       s0 * gradient.endByTurn.x() + c0 * gradient.endByTurn.y());
        const Joint end = c.endJoint();
        const auto local = lineNear(end.point);
        const Vec2 normal = leftNormal(local.direction);
        const double across = way.dot(normal);
        if (!(std::abs(across) > 1e-9)) return true;
        step = (local.point - end.point).dot(normal) / across;
      } else {
        // Least squares over all points: the influence of the turn grows with the third power along the curve.
        const auto moved = typicalFromForm(c.start, c.angleRad, kappa, size, 2.0 * (c.turnRad * (1.0 + 1e-5)));
        if (!moved) return false;
        const Feet here = feetOn(c, near), there = feetOn(*moved, near);
        double top = 0.0, bottom = 0.0;
        for (std::size_t k = 0; k < near.size(); ++k) {
          const double slope = (there.distance[k] - here.distance[k]) / (1e-5 * c.turnRad);
          top += slope * here.distance[k];
          bottom += slope * slope;
        }
        if (!(bottom > 0.0)) return true;
        step = -top / bottom;
      }
      const double next = c.turnRad + std::clamp(step, -0.3 * std::abs(c.turnRad), 0.5 * std::abs(c.turnRad));
      const auto better = typicalFromForm(c.start, c.angleRad, kappa, size, 2.0 * next);
      if (!better) return false;
      const double change = std::abs(next - c.turnRad);
      c = *better;
      if (change < 1e-7) return true;
    }
    return false;
  }

  /// The best fit over as many points as one curve can take. Where not even the first fits, the curve itself.
  std::optional<TypicalCurve> growOne(TypicalCurve c, const Vec2& end, bool& reachesEnd, const RunContext& context) {
    for (std::size_t i = 0, way = 0; i < 60 && way < kExtrapolations.size() && !context.isCancelled(); ++i) {
      reachesEnd = feetOn(c, std::array{end}).t[0] <= 1.0 + 1e-6;
      if (reachesEnd) return c;
      TypicalCurve longer = c.toParameter(kExtrapolations[way]);
      record(GrowingStep::Kind::Extrapolated, longer, false);
      const bool rested = isFree_ ? refitWhole(longer) : refit(longer);
      const bool fits = std::abs(longer.turnRad) < kLargestGrownTurn && longer.ratio > 0.3 && longer.ratio < 3.0 &&
                        deviation(longer) < params_.growingStopDeg * std::numbers::pi / 180.0 &&
                        distance(longer) < kLostPx;
      record(GrowingStep::Kind::Fitted, longer, !fits);
      if (fits) {
        c = longer;
        rested_ = rested;
      } else {
        ++way;
      }
    }
    return c;
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
    first = last - first < 6 ? (first > 3 ? first - 3 : 0) : first;
    last = last - first < 6 ? std::min(points_.size() - 1, last + 3) : last;
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
    const Feet feet = feetOn(c, pointsOn(c));
    const std::size_t group = std::max<std::size_t>(10, feet.distance.size() / 4);
    double most = 0.0;
    for (std::size_t i = 0; i + group <= feet.distance.size(); i += group) {
      double mean = 0.0;
      for (std::size_t k = i; k < i + group; ++k) mean += feet.distance[k] / static_cast<double>(group);
      most = std::max(most, std::abs(mean));
    }
    return most;
  }

  void record(GrowingStep::Kind kind, const TypicalCurve& c, bool stops) {
    if (!record_.steps) return;
    GrowingStep step{kind, record_.segment, c, deviation(c), distance(c) * line_.unitMm, stops};
    step.curve.start = line_.toModel(c.start);
    step.curve.edge *= line_.unitMm;
    record_.steps->push_back(step);
  }

  const TypicalLine& line_;
  const ConstructParams& params_;
  GrowingRecord& record_;
  std::vector<Vec2> points_;
  bool isFree_ = true;
  bool rested_ = true;  ///< The fit that gave the curve in hand came to rest.
};

}  // namespace

FormGradient formGradient(const TypicalCurve& c) {
  // F(l, h, phi) = l (1 + h cos phi + h^2) - dS = 0; h^3 + cos(phi) h^2 + h - 3 dS kappa0 / (2 sin phi) = 0.
  const double h = c.ratio, l = c.edge, cosine = std::cos(c.turnRad), sine = std::sin(c.turnRad);
  const double size = sizeOf(c), k = 1.5 * size * c.startCurvature() / sine;
  FormGradient g;
  g.ratioByTurn = (h * h * sine - k * cosine / sine) / (3.0 * h * h + 2.0 * cosine * h + 1.0);
  const double sum = 1.0 + h * cosine + h * h;
  g.edgeByTurn = -l / sum * ((cosine + 2.0 * h) * g.ratioByTurn - h * sine);
  // C(1) = l (1 + z + z^2), z = h e^(i phi).
  const std::complex<double> z = std::polar(h, c.turnRad), i(0.0, 1.0), dz = z * (g.ratioByTurn / h + i);
  const std::complex<double> end = g.edgeByTurn * (1.0 + z + z * z) + l * (dz + 2.0 * z * dz);
  g.endByTurn = {end.real(), end.imag()};
  return g;
}

std::vector<TypicalCurve> growStretch(const TypicalLine& line, const ConstructParams& params,
                                      const GrowingStretch& stretch, bool freeStart, PathState& from,
                                      GrowingRecord& record, const RunContext& context) {
  return Grower(line, params, record).grow(from, stretch, freeStart, context);
}

}  // namespace batten
