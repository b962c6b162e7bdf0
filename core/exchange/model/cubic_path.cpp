// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/cubic_path.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/curve/arc_length.h"
#include "core/curve/cubic.h"
#include "core/curve/curvature.h"
#include "core/curve/foot_step.h"
#include "core/curve/knot_operations.h"

namespace batten {
namespace {

constexpr int kSamples = 32;            ///< Places per cubic at which the error is measured and handles are fitted.
constexpr double kSettled = 1e-6;       ///< [share of the piece] A step to the foot point so small is the last one.
constexpr int kRounds = 4;              ///< Fits of the handles, each with better parameters.
constexpr int kFootRounds = 8;          ///< Steps towards a foot point at most.
constexpr double kFootSettled = 1e-12;  ///< [parameter] Steps so short end the search.
constexpr int kMaxDepth = 24;           ///< Halvings; 1/2^24 of a piece is far below any tolerance.
constexpr double kMaxTurn =
    1.75;  ///< [rad] A cubic that turns more than 100 degrees fits badly and looks wrong in editors.

constexpr double kAnyDistance = std::numeric_limits<double>::infinity();  // no limit
constexpr double kLeastHandle = 0.01, kMostHandle = 3.0;  ///< [chord] Others make a loop or a cusp, or nearly.
constexpr double kLeastMatchedHandle = 0.05;  ///< [chord] Curvatures that ask for a shorter one are not matched.
constexpr double kMostCurvatureStep = 0.3;    ///< Of the logarithm of a handle in one round: farther it is not linear.
constexpr int kCurvatureRounds = 12;          ///< Steps towards the curvatures at both ends.
constexpr double kMaxCurvatureError = 0.008;  ///< At the end of a cubic; two that meet may jump by twice as much.
constexpr double kLeastCurvature = 0.05;      ///< [1/length of the curve] What a curvature error is measured against.

/// Parts of a curve that end and start farther apart than this share of its coordinates do so not by rounding.
constexpr double kJump = 1e-11;

/// Curvatures at both ends of a cubic; absent where a handle has no length.
using EndCurvatures = std::array<std::optional<double>, 2>;
EndCurvatures endCurvatures(const CubicBezier& c) {
  const Vec2 first = c[1] - c[0], middle = c[2] - c[1], last = c[3] - c[2];
  const double a = first.norm(), b = last.norm();
  EndCurvatures kappa;
  if (a > 0.0) kappa[0] = cross(first / a, middle) / (1.5 * a * a);
  if (b > 0.0) kappa[1] = cross(middle, last / b) / (1.5 * b * b);
  return kappa;
}

Vec2 onGrid(const Vec2& p, double grid) { return {std::round(p.x() / grid) * grid, std::round(p.y() / grid) * grid}; }

/// The cubics of a part of a curve.
struct PartPath {
  CubicRun run;
  double largestError = 0.0, largestJump = 0.0;  ///< The latter where its own cubics meet.
  std::optional<double> firstCurvature, lastCurvature;
  std::optional<double> firstWeight;  ///< What a difference from the first curvature is measured against.
};

class Approximation {
 public:
  /// @param wholeLength curvatures less than kLeastCurvature / `wholeLength` count as that much.
  Approximation(const NurbsCurve& curve, const CubicTolerance& within, double wholeLength, CancelCheck check)
      : curve_(curve),
        tolerance_(within.tolerance),
        grid_(within.grid),
        check_(check),
        least_(kLeastCurvature / wholeLength) {}

  /// The curve, whose curvature has one slope at every place, begun at `start`.
  PartPath from(const Vec2& start) && {
    path_.run.start = start;
    recurse(curve_.start(), curve_.end(), 0);
    return std::move(path_);
  }

 private:
  Vec2 rounded(const Vec2& p) const { return onGrid(p, grid_); }

  /// Unit direction at u, from the side of the interval [from, to] that u bounds.
  Vec2 direction(double u, double from, double to) const {
    const auto d = curve_.derivatives(u, 1);
    const double speed = d[1].norm();
    const Vec2 chord = curve_.point(to) - curve_.point(from);
    if (speed * (to - from) > 1e-9 * chord.norm() && speed > 0.0) return d[1] / speed;
    // A vanishing derivative: the direction towards (or from) a near point of the interval.
    const double near = u == from ? from + (to - from) * 1e-3 : to - (to - from) * 1e-3;
    const Vec2 step =
        u == from ? Vec2(curve_.point(near) - curve_.point(u)) : Vec2(curve_.point(u) - curve_.point(near));
    return step.norm() > 0.0 ? Vec2(step.normalized()) : Vec2(Vec2::Zero());
  }

  std::optional<double> exactCurvature(double u) const { return curvature(curve_, u); }
  double weight(double kappa) const { return std::max(std::abs(kappa), least_); }

  /// How much a cubic's curvatures at its ends are off, relative; 0 where the curve has none.
  double curvatureError(const CubicBezier& c, const EndCurvatures& exact) const {
    const EndCurvatures own = endCurvatures(c);
    double worst = 0.0;
    for (std::size_t i = 0; i < 2; ++i)
      if (exact[i]) worst = std::max(worst, own[i] ? std::abs(*own[i] - *exact[i]) / weight(*exact[i]) : 1.0);
    return worst;
  }

  /// Changes the lengths of the handles until the curvatures at the ends are those of the curve: two equations of
  /// second degree for two lengths (de Boor, Hollig, Sabin, High accuracy geometric Hermite interpolation, 1987), which
  /// nearly coincide along an arc, so that a damped step is taken. Leaves the cubic alone if that leads nowhere.
  void matchCurvatures(CubicBezier& c, const EndCurvatures& exact) const {
    if (!exact[0] || !exact[1]) return;
    const double chord = (c[3] - c[0]).norm();
    Eigen::Vector2d length((c[1] - c[0]).norm(), (c[3] - c[2]).norm());
    if (!(chord > 0.0) || !(length.minCoeff() > 0.0)) return;
    const Vec2 d0 = (c[1] - c[0]) / length[0], d1 = (c[3] - c[2]) / length[1], across = c[3] - c[0];
    const double turn = cross(d0, d1), lift0 = cross(d0, across), lift1 = cross(across, d1);
    for (int round = 0; round < kCurvatureRounds; ++round) {
      const double a = length[0], b = length[1];
      const double k0 = (lift0 - b * turn) / (1.5 * a * a), k1 = (lift1 - a * turn) / (1.5 * b * b);
      const double w0 = weight(*exact[0]), w1 = weight(*exact[1]);
      const Eigen::Vector2d off((k0 - *exact[0]) / w0, (k1 - *exact[1]) / w1);
      if (off.cwiseAbs().maxCoeff() < 1e-12) break;
      Eigen::Matrix2d slope;  // per relative change of a length
      slope << -2.0 * k0 / w0, -turn * b / (1.5 * a * a * w0), -turn * a / (1.5 * b * b * w1), -2.0 * k1 / w1;
      const Eigen::Matrix2d normal =
          slope.transpose() * slope + 1e-9 * slope.squaredNorm() * Eigen::Matrix2d::Identity();
      const Eigen::Vector2d step = -(normal.inverse() * (slope.transpose() * off));
      if (!step.allFinite()) return;
      length.array() *= step.array().max(-kMostCurvatureStep).min(kMostCurvatureStep).exp();
    }
    if (!(length.minCoeff() > kLeastMatchedHandle * chord && length.maxCoeff() < kMostHandle * chord)) return;
    c[1] = c[0] + length[0] * d0;
    c[2] = c[3] - length[1] * d1;
  }

  /// Whether rounding a handle turns the curvatures by more than may be: no smaller cubic would be better.
  bool isTooShortForGrid(const CubicBezier& c, const EndCurvatures& exact) const {
    const double handle = std::min((c[1] - c[0]).norm(), (c[3] - c[2]).norm());
    const double least = std::min(weight(exact[0].value_or(0.0)), weight(exact[1].value_or(0.0)));
    return grid_ > kMaxCurvatureError * least * 1.5 * handle * handle;
  }

  double turning() const {
    double sum = 0.0;
    for (std::size_t i = 2; i < points_.size(); ++i) {
      const Vec2 a = points_[i - 1] - points_[i - 2], b = points_[i] - points_[i - 1];
      if (a.squaredNorm() > 0.0 && b.squaredNorm() > 0.0) sum += std::abs(std::atan2(cross(a, b), a.dot(b)));
    }
    return sum;
  }

  void sample(double from, double to) {
    points_.clear();
    for (int i = 0; i <= kSamples; ++i) points_.push_back(curve_.point(from + (to - from) * i / kSamples));
    parameters_.assign(points_.size(), 0.0);
    for (std::size_t i = 1; i < points_.size(); ++i)
      parameters_[i] = parameters_[i - 1] + (points_[i] - points_[i - 1]).norm();
    const double length = parameters_.back();
    for (double& t : parameters_) t = length > 0.0 ? t / length : 0.0;
  }

  /// Least squares for the two handle lengths at the present parameters; false where they make no sense.
  bool fitHandles(CubicBezier& c, const Vec2& d0, const Vec2& d1) const {
    double a00 = 0, a01 = 0, a11 = 0, b0 = 0, b1 = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double t = parameters_[i], s = 1.0 - t;
      const Vec2 e0 = 3 * s * s * t * d0, e1 = -3 * s * t * t * d1;
      const Vec2 rest = points_[i] - s * s * (s + 3 * t) * c[0] - t * t * (t + 3 * s) * c[3];
      a00 += e0.squaredNorm(), a01 += e0.dot(e1), a11 += e1.squaredNorm();
      b0 += e0.dot(rest), b1 += e1.dot(rest);
    }
    const double det = a00 * a11 - a01 * a01;
    if (!(det > 1e-12 * a00 * a11)) return false;
    const double h0 = (b0 * a11 - b1 * a01) / det, h1 = (b1 * a00 - b0 * a01) / det;
    const double chord = (c[3] - c[0]).norm();
    const double least = kLeastHandle * chord, most = kMostHandle * chord;
    if (!(h0 > least && h1 > least && h0 < most && h1 < most)) return false;
    c[1] = c[0] + h0 * d0;
    c[2] = c[3] - h1 * d1;
    return true;
  }

  CubicBezier fitted(double from, double to, const Vec2& start, const Vec2& end) {
    const Vec2 d0 = direction(from, from, to), d1 = direction(to, from, to);
    CubicBezier c = {start, start, end, end};
    double length = 0.0;
    for (std::size_t i = 1; i < points_.size(); ++i) length += (points_[i] - points_[i - 1]).norm();
    c[1] = start + length / 3.0 * d0;
    c[2] = end - length / 3.0 * d1;
    for (int round = 0; round < kRounds && fitHandles(c, d0, d1); ++round) {
      for (std::size_t i = 0; i < points_.size(); ++i)
        parameters_[i] = cubicFoot(c, points_[i], parameters_[i], kFootRounds, kFootSettled);
    }
    return c;
  }

  /// Largest distance between cubic and curve over [from, to]: from the curve's samples to the cubic, and back; once it
  /// is more than `enough`, any such distance.
  double error(const CubicBezier& c, double from, double to, double enough) {
    double worst = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double t = cubicFoot(c, points_[i], parameters_[i], kFootRounds, kFootSettled);
      worst = std::max(worst, (points_[i] - cubicPoint(c, t)).norm());
      if (worst > enough) return worst;
    }
    for (int i = 1; i < 2 * kSamples; ++i) {
      const Vec2 p = cubicPoint(c, i / (2.0 * kSamples));
      worst = std::max(worst, distanceFromCurve(p, from, to));
      if (worst > enough) return worst;
    }
    return worst;
  }

  double distanceFromCurve(const Vec2& p, double from, double to) const {
    const auto nearest = std::min_element(points_.begin(), points_.end(), [&](const Vec2& a, const Vec2& b) {
      return (a - p).squaredNorm() < (b - p).squaredNorm();
    });
    double u = from + (to - from) * static_cast<double>(nearest - points_.begin()) / kSamples;
    double best = (*nearest - p).norm();
    for (int i = 0; i < 8; ++i) {
      const auto d = curve_.derivatives(u, 1);
      const Vec2 offset = d[0] - p;
      best = std::min(best, offset.norm());
      // Without the second derivative, which would cost more than it saves: what is left is of second order, and the
      // distance changes by the square of that.
      const double next = std::clamp(u + footStep(offset, d[1], Vec2::Zero()), from, to);
      const bool settled = std::abs(next - u) <= kSettled * (to - from);
      u = next;
      if (settled) break;
    }
    return best;
  }

  void recurse(double from, double to, int depth) {
    if (check_.isCancelled()) return;
    const Vec2 start = path_.run.end();
    const Vec2 end = rounded(curve_.point(to));
    const double middle = 0.5 * (from + to);
    sample(from, to);
    const bool mayHalve = depth < kMaxDepth && middle > from && middle < to;
    if (!(mayHalve && turning() > kMaxTurn)) {
      const EndCurvatures exact = {exactCurvature(from), exactCurvature(to)};
      CubicBezier c = fitted(from, to, start, end);
      matchCurvatures(c, exact);
      c[1] = rounded(c[1]);
      c[2] = rounded(c[2]);
      const bool isKept = curvatureError(c, exact) <= kMaxCurvatureError || isTooShortForGrid(c, exact) || !mayHalve;
      const std::optional<double> measured =
          isKept ? std::optional(error(c, from, to, mayHalve ? tolerance_ : kAnyDistance)) : std::nullopt;
      if (measured && (*measured <= tolerance_ || !mayHalve)) {
        take(c, exact[0], *measured);
        return;
      }
    }
    recurse(from, middle, depth + 1);
    recurse(middle, to, depth + 1);
  }

  void take(const CubicBezier& c, const std::optional<double>& exactAtStart, double measured) {
    const bool isFirst = path_.run.cubics.empty();
    path_.run.cubics.push_back({c[1], c[2], c[3]});
    path_.largestError = std::max(path_.largestError, measured);
    const EndCurvatures own = endCurvatures(c);
    const std::optional<double> before = std::exchange(path_.lastCurvature, own[1]);
    if (isFirst) {
      path_.firstCurvature = own[0];
      if (exactAtStart) path_.firstWeight = weight(*exactAtStart);
    } else if (before && own[0] && exactAtStart) {
      path_.largestJump = std::max(path_.largestJump, std::abs(*before - *own[0]) / weight(*exactAtStart));
    }
  }

  const NurbsCurve& curve_;
  double tolerance_, grid_;
  CancelCheck check_;
  double least_;  ///< Curvature below which a difference does not count.
  PartPath path_;
  std::vector<Vec2> points_;
  std::vector<double> parameters_;
};

/// A part of a curve between knots where its curvature, or the slope of that, may jump.
struct SmoothPart {
  NurbsCurve curve;
  bool isCurvatureContinuous = false;  ///< From the part before.

  double jump(double grid) const {
    double size = 0.0;
    for (const Vec2& p : curve.controlPoints()) size = std::max(size, p.cwiseAbs().maxCoeff());
    return std::max(4.0 * grid, kJump * size);
  }
};

/// Cut where the slope of the curvature may jump: halving towards such a place never ends well, because a cubic that
/// reaches across it has one slope only.
Result<std::vector<SmoothPart>> smoothParts(const NurbsCurve& curve) {
  std::vector<double> places;
  std::vector<bool> isContinuous{false};  // from the part before
  const std::vector<double> breaks = curve.breaks();
  const auto knots = curve.knots();
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    const auto [first, last] = std::equal_range(knots.begin(), knots.end(), breaks[i]);
    const auto times = last - first;
    if (times < curve.degree() - 2) continue;
    places.push_back(breaks[i]);
    isContinuous.push_back(times == curve.degree() - 2);
  }
  auto cut = splitAtAll(curve, places);
  if (!cut) return fail(cut.error());
  std::vector<SmoothPart> parts;
  for (std::size_t i = 0; i < cut->size(); ++i) parts.push_back({std::move((*cut)[i]), isContinuous[i]});
  return parts;
}

}  // namespace

Result<CubicPath> cubicPath(const NurbsCurve& curve, const CubicTolerance& within, const RunContext& context) {
  const auto parts = smoothParts(curve);
  if (!parts) return fail(parts.error());
  const double length = ArcLength(curve, context).total();
  // A part begins where the one before it ends, which is known without its cubics, or else a new run.
  struct PartStart {
    Vec2 at;
    bool isRun = false;
  };
  std::vector<PartStart> starts;
  std::optional<Vec2> end;
  for (const SmoothPart& part : *parts) {
    const Vec2 own = onGrid(part.curve.point(part.curve.start()), within.grid);
    const bool isRun = !end || (*end - own).norm() > part.jump(within.grid);
    starts.push_back({isRun ? own : *end, isRun});
    end = onGrid(part.curve.point(part.curve.end()), within.grid);
  }
  std::vector<PartPath> made(parts->size());
  parallelFor(context, static_cast<int>(made.size()), 1, [&](int first, int last) {
    for (int i = first; i < last && !context.isCancelled(); ++i)
      made[i] = Approximation((*parts)[i].curve, within, length, context).from(starts[i].at);
  });
  if (context.isCancelled()) return cancelled();
  CubicPath path;
  std::optional<double> behind;
  for (std::size_t i = 0; i < made.size(); ++i) {
    const PartPath& part = made[i];
    if (starts[i].isRun) path.runs.push_back({starts[i].at, {}});
    auto& cubics = path.runs.back().cubics;
    cubics.insert(cubics.end(), part.run.cubics.begin(), part.run.cubics.end());
    path.largestError = std::max(path.largestError, part.largestError);
    path.largestJump = std::max(path.largestJump, part.largestJump);
    if ((*parts)[i].isCurvatureContinuous && behind && part.firstCurvature && part.firstWeight)
      path.largestJump = std::max(path.largestJump, std::abs(*behind - *part.firstCurvature) / *part.firstWeight);
    behind = part.lastCurvature;
  }
  return path;
}

}  // namespace batten
