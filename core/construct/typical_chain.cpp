// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "core/construct/bezier_chain.h"
#include "core/construct/block_levenberg.h"
#include "core/construct/piece_stations.h"
#include "core/construct/typical_curve.h"

namespace batten {

namespace {

/// A joint bends clearly if its curvature is above this share of the largest and above this sagitta [px] over its
/// segment.
constexpr double kClearShare = 0.08;
constexpr double kClearSagittaPx = 0.05;
constexpr double kLargestTurnPerSegment = 1.2;
/// Weight of the second differences of log kappa against px of misfit.
constexpr double kFairness = 0.1;
/// A chain is good enough when its joints lie within this [px, rms].
constexpr double kGoodRmsPx = 0.1;
constexpr std::array<int, 8> kSegmentCounts = {1, 2, 3, 4, 6, 8, 12, 16};

/// A run of joints that bend one way; a chain of typical curves takes their place.
struct Run {
  std::size_t first = 0, last = 0;  ///< Joint indices, inclusive.
};

/// One piece of the path: a quintic with the lengths of its first derivative at both ends.
struct PathPiece {
  Quintic q;
  double startSpeed, endSpeed;
};

double angleOf(const Vec2& v) { return std::atan2(v.y(), v.x()); }
double angleBetween(const Vec2& a, const Vec2& b) { return std::atan2(cross(a, b), a.dot(b)); }

std::vector<Run> runsOf(const FairedJoints& faired, double pixelMm) {
  const auto& joints = faired.joints;
  double largest = 0.0;
  for (const Joint& j : joints) largest = std::max(largest, std::abs(j.kappa));
  const auto sign = [&](std::size_t i) {
    const double reach = faired.lengths[std::min(i, faired.lengths.size() - 1)];
    const double least = std::max(kClearShare * largest, 8.0 * kClearSagittaPx * pixelMm / (reach * reach));
    return joints[i].kappa > least ? 1 : joints[i].kappa < -least ? -1 : 0;
  };
  std::vector<Run> runs;
  for (std::size_t i = 0; i < joints.size();) {
    std::size_t end = i;
    while (end + 1 < joints.size() && sign(end + 1) == sign(i) &&
           angleBetween(joints[end].tangent, joints[end + 1].tangent) * sign(i) > 0.0) {
      ++end;
    }
    if (sign(i) != 0 && end >= i + 2) runs.push_back({i, end});
    i = std::max(end, i + 1);
    if (i == end && (i + 1 >= joints.size() || sign(i) == 0)) ++i;
  }
  return runs;
}

/// The chain that takes the place of the joints of a run, as a function of its unknowns: start (2, px), direction, then
/// log |kappa| at n + 1 joints and log |change of angle| of n segments.
class TypicalChain {
 public:
  TypicalChain(std::span<const Joint> data, int segments, double pixelMm)
      : data_(data), n_(segments), pixelMm_(pixelMm), side_(data.front().kappa > 0.0 ? 1.0 : -1.0) {}

  Eigen::Index unknowns() const { return 4 + 2 * n_; }

  Eigen::VectorXd start() const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns());
    const auto joint = [&](int k) {
      return static_cast<std::size_t>(k) * (data_.size() - 1) / static_cast<std::size_t>(n_);
    };
    for (int k = 0; k <= n_; ++k) {
      x(3 + k) = std::log(std::abs(data_[joint(k)].kappa));
      if (k == n_) break;
      double turn = 0.0;
      for (std::size_t i = joint(k); i < joint(k + 1); ++i) {
        turn += angleBetween(data_[i].tangent, data_[i + 1].tangent);
      }
      x(4 + n_ + k) = std::log(std::max(1e-6, turn * side_));
    }
    return x;
  }

  /// Empty where the unknowns make no typical curves.
  std::vector<TypicalCurve> segments(std::span<const double> x) const {
    std::vector<TypicalCurve> result;
    Vec2 at = data_.front().point + pixelMm_ * Vec2(x[0], x[1]);
    double angle = angleOf(data_.front().tangent) + x[2];
    for (int k = 0; k < n_; ++k) {
      const auto i = static_cast<std::size_t>(k), turns = static_cast<std::size_t>(4 + n_ + k);
      const auto segment = typicalFromCurvatures(at, angle, side_ * std::exp(x[3 + i]), side_ * std::exp(x[4 + i]),
                                                 side_ * std::exp(x[turns]));
      if (!segment || !(segment->ratio > 0.2 && segment->ratio < 5.0)) return {};
      result.push_back(*segment);
      at = segment->controlPoints()[3];
      angle += 2.0 * segment->turnRad;
    }
    return result;
  }

  /// Misfit of the data joints [px]: the ends fully, the inner ones across the line and in direction.
  void misfit(std::span<const double> x, std::span<double> r) const {
    const auto chain = segments(x);
    if (chain.empty()) {
      std::fill(r.begin(), r.end(), std::numeric_limits<double>::quiet_NaN());
      return;
    }
    const Vec2 atStart = (chain.front().start - data_.front().point) / pixelMm_;
    const Vec2 atEnd = (chain.back().controlPoints()[3] - data_.back().point) / pixelMm_;
    const std::array<double, 4> ends = {atStart.x(), atStart.y(), atEnd.x(), atEnd.y()};
    for (std::size_t k = 0; k < 4; ++k) r[k] = 1e3 * ends[k];
    std::vector<std::array<Vec2, 4>> cubics;
    for (const TypicalCurve& segment : chain) cubics.push_back(segment.controlPoints());
    std::size_t segment = 0;
    double t = 0.0;
    for (std::size_t i = 0; i < data_.size(); ++i) {
      const auto d = follow(cubics, data_[i], segment, t);
      const double reach = (data_[i + 1 < data_.size() ? i + 1 : i].point - data_[i > 0 ? i - 1 : i].point).norm();
      r[4 + 2 * i] = (d[0] - data_[i].point).dot(leftNormal(data_[i].tangent)) / pixelMm_;
      r[5 + 2 * i] = 0.1 * reach / pixelMm_ * angleBetween(data_[i].tangent, d[1]);
    }
  }
  int misfitCount() const { return 4 + 2 * static_cast<int>(data_.size()); }

  double rmsPx(const Eigen::VectorXd& x) const {
    std::vector<double> r(static_cast<std::size_t>(misfitCount()));
    misfit({x.data(), static_cast<std::size_t>(x.size())}, r);
    double sum = 0.0;
    for (std::size_t i = 4; i < r.size(); i += 2) sum += r[i] * r[i];
    return std::sqrt(sum / static_cast<double>(data_.size()));
  }

 private:
  /// Point and derivative of the chain where it crosses the normal of a joint, from where the last one was found.
  static std::array<Vec2, 2> follow(const std::vector<std::array<Vec2, 4>>& chain, const Joint& joint,
                                    std::size_t& segment, double& t) {
    std::array<Vec2, 2> d;
    for (int i = 0; i < 30; ++i) {
      const auto& q = chain[segment];
      const double s = 1.0 - t;
      d[0] = s * s * s * q[0] + 3 * s * s * t * q[1] + 3 * s * t * t * q[2] + t * t * t * q[3];
      d[1] = 3.0 * (s * s * (q[1] - q[0]) + 2 * s * t * (q[2] - q[1]) + t * t * (q[3] - q[2]));
      const double ahead = (joint.point - d[0]).dot(joint.tangent);
      const double speed = std::max(d[1].dot(joint.tangent), 0.2 * d[1].norm());
      if (!(speed > 0.0)) break;
      const double next = t + ahead / speed;
      const bool forward = next > 1.0 && segment + 1 < chain.size(), back = next < 0.0 && segment > 0;
      if (forward || back) {
        segment += forward ? 1 : static_cast<std::size_t>(-1);
        t = forward ? 0.0 : 1.0;
        continue;
      }
      const double step = std::clamp(next, -0.5, 1.5) - t;
      t += step;
      if (std::abs(step) < 1e-10) break;
    }
    return d;
  }

  std::span<const Joint> data_;
  int n_;
  double pixelMm_, side_;
};

/// The shortest chain that follows the joints well; empty if none does.
std::vector<TypicalCurve> fitChain(std::span<const Joint> data, double pixelMm, const RunContext& context) {
  double turn = 0.0;
  for (std::size_t i = 0; i + 1 < data.size(); ++i)
    turn += std::abs(angleBetween(data[i].tangent, data[i + 1].tangent));
  std::vector<TypicalCurve> best;
  double bestRms = 0.0;
  for (const int n : kSegmentCounts) {
    const bool tooFew = turn / n > kLargestTurnPerSegment, tooMany = n >= static_cast<int>(data.size());
    if (tooMany || context.isCancelled()) break;
    if (tooFew) continue;
    const TypicalChain chain(data, n, pixelMm);
    ResidualBlock fit;
    for (int i = 0; i < chain.unknowns(); ++i) fit.columns.push_back(i);
    fit.size = chain.misfitCount();
    fit.evaluate = [&](std::span<const double> x, std::span<double> r) { chain.misfit(x, r); };
    std::vector<ResidualBlock> blocks = {fit};
    for (int k = 1; k < n; ++k) {
      blocks.push_back({{2 + k, 3 + k, 4 + k}, 1, [](std::span<const double> x, std::span<double> r) {
                          r[0] = kFairness * (x[0] - 2.0 * x[1] + x[2]);
                        }});
    }
    const auto solved = minimiseBlocks(chain.start(), Eigen::VectorXd::Ones(chain.unknowns()), blocks, context);
    auto segments = chain.segments({solved.x.data(), static_cast<std::size_t>(solved.x.size())});
    const double rms = chain.rmsPx(solved.x);
    if (segments.empty() || !std::isfinite(rms)) continue;
    // More segments must be worth it: the fewer, the fairer.
    if (!best.empty() && rms > 0.8 * bestRms && bestRms < 0.3) break;
    if (best.empty() || rms < bestRms) {
      best = std::move(segments);
      bestRms = rms;
    }
    if (bestRms <= kGoodRmsPx) break;
  }
  return best;
}

/// The pieces as one B-spline: intervals such that the first derivatives agree at every joint, so that a joint needs a
/// knot of multiplicity 4 and no control point of its own.
Result<NurbsCurve> joined(const std::vector<PathPiece>& path) {
  std::vector<double> knots(6, 0.0);
  std::vector<Vec2> points = {path.front().q[0]};
  double speed = 1.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double interval = path[i].startSpeed / speed, at = knots.back() + interval;
    speed = path[i].endSpeed / interval;
    const bool last = i + 1 == path.size();
    points.insert(points.end(), path[i].q.begin() + 1, path[i].q.begin() + (last ? 6 : 5));
    knots.insert(knots.end(), last ? 6 : 4, at);
  }
  return NurbsCurve::make(5, std::move(knots), std::move(points));
}

void appendHermite(std::vector<PathPiece>& path, const Joint& from, const Joint& to) {
  const double half = 0.5 * std::abs(angleBetween(from.tangent, to.tangent));
  const double length = (to.point - from.point).norm() * (half > 1e-4 ? half / std::sin(half) : 1.0);
  path.push_back({quinticHermite(from, to, length), length, length});
}

/// Chains where there are runs, Hermite pieces between the joints elsewhere.
std::vector<PathPiece> pathOf(const std::vector<Joint>& joints, const std::vector<Run>& runs, double pixelMm,
                              const RunContext& context) {
  std::vector<PathPiece> path;
  Joint at = joints.front();
  std::size_t next = 1;
  for (const Run& run : runs) {
    const auto chain = fitChain(std::span(joints).subspan(run.first, run.last - run.first + 1), pixelMm, context);
    if (chain.empty()) continue;
    for (; next <= run.first; ++next) {
      const Joint to = next == run.first ? chain.front().startJoint() : joints[next];
      appendHermite(path, at, to);
      at = to;
    }
    for (const TypicalCurve& segment : chain) {
      const auto q = segment.controlPoints();
      path.push_back({elevatedCubic(q[0], q[1], q[2], q[3]), 3.0 * segment.edge,
                      3.0 * segment.ratio * segment.ratio * segment.edge});
    }
    at = chain.back().endJoint();
    next = run.last + 1;
  }
  for (; next < joints.size(); ++next) {
    appendHermite(path, at, joints[next]);
    at = joints[next];
  }
  return path;
}

/// A closed line is opened after the station whose segment bends least; that segment stays a Hermite piece.
void turnToStraightest(std::vector<Station>& stations) {
  std::size_t best = 0;
  double least = 10.0;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const double turn = std::abs(angleBetween(stations[i].direction, stations[(i + 1) % stations.size()].direction));
    if (turn < least) {
      least = turn;
      best = i;
    }
  }
  std::rotate(stations.begin(), stations.begin() + static_cast<std::ptrdiff_t>((best + 1) % stations.size()),
              stations.end());
}

}  // namespace

Result<ConstructedPiece> constructTypical(const ConstructPiece& piece, double pixelMm, const ConstructParams&,
                                          const RunContext& context) {
  if (context.isCancelled()) return cancelled();
  std::vector<Station> stations = usableStations(piece, 6);
  if (stations.size() < (piece.closed ? 3u : 2u)) {
    return straightPiece(piece, "Too few stations for a curve; a straight line was drawn.");
  }
  if (piece.closed) turnToStraightest(stations);
  FairedJoints faired = fairedJoints(stations, piece.closed, pixelMm, context);
  double total = 0.0;
  for (const double length : faired.lengths) total += length;
  const double unit = pixelMm > 0.0 && std::isfinite(pixelMm) ? pixelMm : total / 1000.0;
  std::vector<Joint> joints = faired.joints;
  if (piece.closed) joints.pop_back();
  std::vector<PathPiece> path = pathOf(joints, runsOf({joints, faired.lengths, faired.why}, unit), unit, context);
  if (context.isCancelled()) return cancelled();
  if (piece.closed) {
    const auto& first = path.front().q;
    const auto& last = path.back().q;
    appendHermite(path, {last[5], (last[5] - last[4]).normalized(), batten::endCurvature(last).value_or(0.0)},
                  {first[0], (first[1] - first[0]).normalized(), batten::startCurvature(first).value_or(0.0)});
  }
  auto curve = joined(path);
  if (!curve) return constructBezierChain(piece, pixelMm, {}, context);
  const Vec2 end = piece.closed ? Vec2(curve->controlPoints().front()) : stations.back().point;
  curve = clampedWithEnds(*curve, piece.closed ? end : stations.front().point, end);
  if (!curve) return fail(curve.error());
  ConstructedPiece result{std::move(*curve), {}};
  result.report.why = faired.why;
  return result;
}

}  // namespace batten
