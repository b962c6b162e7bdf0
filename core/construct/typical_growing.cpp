// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical_growing.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "core/construct/block_levenberg.h"
#include "core/construct/typical_structure.h"

namespace batten {

namespace {

/// How far a curve is run on; the shorter way where the longer one fails.
constexpr std::array<double, 2> kExtrapolations = {1.35, 1.12};
/// Segments shorter than this [px] mean that the growing has come to an end of its own.
constexpr double kShortestPx = 6.0;
constexpr double kLargestTurn = 0.7;
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

/// The stretch of a line that one growing chain covers.
struct Stretch {
  std::size_t firstJoint = 0, lastJoint = 0;
  std::vector<Vec2> points;
};

class Grower {
 public:
  Grower(const TypicalLine& line, const ConstructParams& params, std::vector<GrowingStep>* steps)
      : line_(line), params_(params), steps_(steps) {}

  /// Segments from the state over the stretch; the state becomes where they end.
  std::vector<TypicalCurve> grow(PathState& from, const Stretch& stretch, bool freeStart, const RunContext& context) {
    points_ = stretch.points;
    isFree_ = freeStart;
    std::vector<TypicalCurve> kept;
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
      record(GrowingStep::Kind::Kept, stays, false);
      kept.push_back(stays);
      isFree_ = false;
      if (reachesEnd) break;
      ++segment_;
      curve = continued(stays, params_.growingAsInPaper ? 0.4 * sizeOf(stays) : sizeOf(*grown) - sizeOf(stays));
      if (curve) {
        refit(*curve);
        record(GrowingStep::Kind::Seed, *curve, false);
      }
    }
    if (!kept.empty()) {
      const Joint joint = kept.back().endJoint();
      from = {joint.point, kept.back().angleRad + 2.0 * kept.back().turnRad, joint.kappa};
    }
    return kept;
  }

  int segment_ = 0;

 private:
  std::span<const Vec2> pointsOn(const TypicalCurve& c) const {
    const Feet feet = feetOn(c, points_);
    std::size_t first = 0, last = points_.size();
    while (first < last && feet.t[first] < 0.0) ++first;
    // A closed line comes back: what lies beyond the first point past the end is another stretch.
    const auto past = std::find_if(feet.t.begin() + static_cast<std::ptrdiff_t>(first), feet.t.end(), [](double t) { return t > 1.0; });
    last = static_cast<std::size_t>(past - feet.t.begin());
    return std::span(points_).subspan(first, last - first);
  }

  /// A small curve fitted to the first points: direction, curvature and change of direction.
  std::optional<TypicalCurve> seed(const PathState& from, const Stretch& stretch, bool freeStart) {
    const std::size_t reach = std::min(stretch.firstJoint + 2, stretch.lastJoint);
    double size = 0.0, turn = 0.0;
    for (std::size_t i = stretch.firstJoint; i < reach; ++i) {
      const Joint &a = line_.joints[i], &b = line_.joints[i + 1];
      size += (b.point - a.point).norm();
      turn += std::atan2(cross(a.tangent, b.tangent), a.tangent.dot(b.tangent));
    }
    auto first = typicalFromForm(from.point, from.angleRad, from.kappa, size, turn);
    if (first && std::abs(first->turnRad) < kLargestTurn && freeStart) refitWhole(*first);
    if (first) record(GrowingStep::Kind::Seed, *first, false);
    return first;
  }

  /// While nothing comes before it, a curve also finds its direction and curvature at the start.
  void refitWhole(TypicalCurve& c) const {
    const auto near = pointsOn(c);
    if (near.size() < 8) return;
    const double size = sizeOf(c), kappa = c.startCurvature();
    const auto curveOf = [&](std::span<const double> x) {
      return typicalFromForm(c.start, c.angleRad + x[0], kappa * std::exp(x[1]), size, 2.0 * c.turnRad * std::exp(x[2]));
    };
    ResidualBlock block{{0, 1, 2}, static_cast<int>(near.size()) + 3, [&](std::span<const double> x, std::span<double> r) {
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
  }

  static std::optional<TypicalCurve> continued(const TypicalCurve& before, double size) {
    const Joint joint = before.endJoint();
    const double turn = joint.kappa * size;
    return typicalFromForm(joint.point, before.angleRad + 2.0 * before.turnRad, joint.kappa, size,
                           std::copysign(std::clamp(std::abs(turn), 1e-4, 1.2), turn));
  }

  /// Bends the curve until it meets the points: only the change of direction moves (002 section 5).
  void refit(TypicalCurve& c) const {
    const double size = sizeOf(c), kappa = c.startCurvature();
    for (int i = 0; i < 12; ++i) {
      const auto near = pointsOn(c);
      if (near.size() < 3) return;
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
        if (!(std::abs(across) > 1e-9)) return;
        step = (local.point - end.point).dot(normal) / across;
      } else {
        // Least squares over all points: the influence of the turn grows with the third power along the curve.
        const auto moved = typicalFromForm(c.start, c.angleRad, kappa, size, 2.0 * (c.turnRad * (1.0 + 1e-5)));
        if (!moved) return;
        const Feet here = feetOn(c, near), there = feetOn(*moved, near);
        double top = 0.0, bottom = 0.0;
        for (std::size_t k = 0; k < near.size(); ++k) {
          const double slope = (there.distance[k] - here.distance[k]) / (1e-5 * c.turnRad);
          top += slope * here.distance[k];
          bottom += slope * slope;
        }
        if (!(bottom > 0.0)) return;
        step = -top / bottom;
      }
      const double next = c.turnRad + std::clamp(step, -0.3 * std::abs(c.turnRad), 0.5 * std::abs(c.turnRad));
      const auto better = typicalFromForm(c.start, c.angleRad, kappa, size, 2.0 * next);
      if (!better) return;
      const double change = std::abs(next - c.turnRad);
      c = *better;
      if (change < 1e-7) return;
    }
  }

  /// The best fit over as many points as one curve can take. Where not even the first fits, the curve itself.
  std::optional<TypicalCurve> growOne(TypicalCurve c, const Vec2& end, bool& reachesEnd, const RunContext& context) {
    for (std::size_t i = 0, way = 0; i < 60 && way < kExtrapolations.size() && !context.isCancelled(); ++i) {
      reachesEnd = feetOn(c, std::array{end}).t[0] <= 1.0 + 1e-6;
      if (reachesEnd) return c;
      TypicalCurve longer = c.toParameter(kExtrapolations[way]);
      record(GrowingStep::Kind::Extrapolated, longer, false);
      isFree_ ? refitWhole(longer) : refit(longer);
      const bool fits = std::abs(longer.turnRad) < kLargestTurn && longer.ratio > 0.3 && longer.ratio < 3.0 &&
                        deviation(longer) < params_.growingStopDeg * std::numbers::pi / 180.0 && distance(longer) < kLostPx;
      record(GrowingStep::Kind::Fitted, longer, !fits);
      if (fits) {
        c = longer;
      } else {
        ++way;
      }
    }
    return c;
  }

  struct LocalLine {
    Vec2 point, direction;
  };
  /// Place and direction of the points near a place: local parabola.
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
    const Eigen::Vector3d parabola = a.colPivHouseholderQr().solve(b);
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
    if (!steps_) return;
    GrowingStep step{kind, segment_, c, deviation(c), distance(c) * line_.unitMm, stops};
    step.curve.start = line_.toModel(c.start);
    step.curve.edge *= line_.unitMm;
    steps_->push_back(step);
  }

  const TypicalLine& line_;
  const ConstructParams& params_;
  std::vector<GrowingStep>* steps_;
  std::vector<Vec2> points_;
  bool isFree_ = true;
};

std::vector<Vec2> pointsBetween(const TypicalLine& line, std::size_t firstJoint, std::size_t lastJoint) {
  std::vector<Vec2> result;
  std::size_t joint = 0;
  for (const Vec2& p : line.points) {
    while (joint + 2 < line.joints.size() && (p - line.joints[joint + 1].point).dot(line.joints[joint + 1].tangent) > 0.0) {
      ++joint;
    }
    // A segment more on both sides: what lies beyond the ends is left out by the feet.
    if (joint + 1 >= firstJoint && joint <= lastJoint) result.push_back(p);
  }
  return result;
}

std::vector<Stretch> stretchesOf(const TypicalLine& line, std::span<const Vec2> divisions) {
  std::vector<std::size_t> cuts;
  for (const Vec2& place : divisions) {
    const auto nearest = std::min_element(line.joints.begin(), line.joints.end(), [&](const Joint& a, const Joint& b) {
      return (a.point - place).squaredNorm() < (b.point - place).squaredNorm();
    });
    cuts.push_back(static_cast<std::size_t>(nearest - line.joints.begin()));
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<Stretch> result;
  for (const JointRun& run : bendingRuns(line.joints)) {
    std::size_t first = run.first, last = run.last;
    // A closed line ends with a Hermite piece that meets its start.
    if (line.closed && last + 1 == line.joints.size()) --last;
    for (const std::size_t cut : cuts) {
      if (cut <= first || cut >= last) continue;
      result.push_back({first, cut, pointsBetween(line, first, cut)});
      first = cut;
    }
    if (last > first) result.push_back({first, last, pointsBetween(line, first, last)});
  }
  return result;
}

PathState stateOf(const Joint& joint, double near) {
  const double angle = std::atan2(joint.tangent.y(), joint.tangent.x());
  return {joint.point, near + std::remainder(angle - near, 2.0 * std::numbers::pi), joint.kappa};
}

void appendHermite(TypicalPath& path, const PathState& to) {
  PathElement hermite;
  hermite.typical = false;
  path.elements.push_back(hermite);
  path.states.push_back(to);
}

void appendTypical(TypicalPath& path, const TypicalCurve& curve) {
  PathElement element;
  element.side = curve.turnRad > 0.0 ? 1.0 : -1.0;
  element.logTurn = std::log(std::abs(curve.turnRad));
  element.shape = std::log(curve.ratio);
  path.elements.push_back(element);
  path.states.push_back({curve.endJoint().point, curve.angleRad + 2.0 * curve.turnRad, curve.endCurvature()});
}

/// An extremum inside becomes a joint: exact.
void divideAtMaxima(TypicalPath& path) {
  for (std::size_t e = 0; e < path.elements.size(); ++e) {
    if (!path.elements[e].typical || path.elements[e].isMonotone()) continue;
    const double top = placeOfMaximum(path.elements[e]);
    if (top > 1e-3 && top < 1.0 - 1e-3) {
      path.split(e++, top);
    } else {
      // So near to an end that a hair of shape makes up for it.
      path.elements[e].setTrend(path.elements[e].logRatio() < 0.0 ? Trend::Rising : Trend::Falling);
    }
  }
}

/// Turns and scales the whole path so that it ends where it has to: less than noise.
void settleEnd(TypicalPath& path, const Vec2& end) {
  const Vec2 start = path.states.front().point;
  const std::complex<double> was = asComplex(path.states.back().point - start), wanted = asComplex(end - start);
  if (!(std::abs(was) > 0.0) || !(std::abs(wanted) > 0.0)) return;
  const std::complex<double> turn = wanted / was;
  for (PathState& s : path.states) {
    const std::complex<double> p = asComplex(s.point - start) * turn;
    s.point = start + Vec2(p.real(), p.imag());
    s.angleRad += std::arg(turn);
    s.kappa /= std::abs(turn);
  }
}

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

std::string_view name(GrowingStep::Kind kind) {
  switch (kind) {
    case GrowingStep::Kind::Seed:
      return "seed";
    case GrowingStep::Kind::Extrapolated:
      return "extrapolated";
    case GrowingStep::Kind::Fitted:
      return "fitted";
    case GrowingStep::Kind::Kept:
      return "kept";
  }
  return "unknown";
}

std::optional<TypicalPath> grownPath(const TypicalLine& line, std::span<const Vec2> divisionsMm,
                                     const ConstructParams& params, std::vector<GrowingStep>* steps,
                                     const RunContext& context) {
  std::vector<Vec2> divisions;
  for (const Vec2& p : divisionsMm) divisions.push_back(line.toLine(p));
  Grower grower(line, params, steps);
  TypicalPath path;
  path.closed = line.closed;
  path.states.push_back(stateOf(line.joints.front(), 0.0));
  std::size_t at = 0;
  const auto goTo = [&](std::size_t joint) {
    for (std::size_t i = at + 1; i <= joint; ++i) appendHermite(path, stateOf(line.joints[i], path.states.back().angleRad));
    at = std::max(at, joint);
  };
  for (const Stretch& stretch : stretchesOf(line, divisions)) {
    if (context.isCancelled()) return std::nullopt;
    goTo(stretch.firstJoint);
    PathState from = path.states.back();
    const bool freeStart = path.elements.empty() || !path.elements.back().typical;
    const auto grown = grower.grow(from, stretch, freeStart, context);
    if (grown.empty()) continue;
    ++grower.segment_;
    if (freeStart) {
      path.states.back().angleRad = grown.front().angleRad;
      path.states.back().kappa = grown.front().startCurvature();
    }
    for (const TypicalCurve& curve : grown) appendTypical(path, curve);
    // Where it had to stop early the rest is left to Hermite pieces.
    at = stretch.firstJoint;
    while (at < stretch.lastJoint &&
           (line.joints[at + 1].point - from.point).dot(line.joints[at + 1].tangent) < 0.3 * (line.joints[at + 1].point - line.joints[at].point).norm()) {
      ++at;
    }
  }
  goTo(line.joints.size() - 1);
  if (path.elements.empty()) return std::nullopt;
  if (!path.update()) return std::nullopt;
  divideAtMaxima(path);
  if (!path.update()) return std::nullopt;
  if (!path.closed && path.endsTypical()) settleEnd(path, line.joints.back().point);
  return path;
}

Result<std::vector<GrowingStep>> growingSteps(const ConstructPiece& piece, double pixelMm, const ConstructParams& params,
                                              const RunContext& context) {
  if (context.isCancelled()) return cancelled();
  const TypicalLine line = typicalLine(piece, pixelMm, params, context);
  std::vector<GrowingStep> steps;
  if (!line.joints.empty()) grownPath(line, piece.divisions, params, &steps, context);
  if (context.isCancelled()) return cancelled();
  return steps;
}

}  // namespace batten
