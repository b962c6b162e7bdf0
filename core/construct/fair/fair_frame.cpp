// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_frame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/base/statistics.h"
#include "core/solve/gauss_legendre.h"

namespace batten {
namespace {

constexpr double kPilotCutoffPx = 50.0;  // wavelength: the pilot follows the course of the line, its frame the rest
// standard deviation of the smoothing that the first parameters are measured along
constexpr double kSmoothingSamples = 3.0;
constexpr double kSmoothingReach = 3.0;  // standard deviations: beyond, the weights are below 1 %
constexpr double kGateSigmas = 6.0,
                 kLeastSigmaPx = 0.02;   // points farther off than as many robust sigmas are no points of the line
constexpr double kPointsPerBlock = 1.5;  // at least, where points are sparse
constexpr double kPointsPerKnot = 3.0;   // the same, from knot to knot
constexpr double kFewestInBlock = 2.0, kFewestShare = 0.5,
                 kSparseShare = 0.3;  // points, and of those expected: else no block
constexpr double kFullShare = 0.6;    // of the points expected: from here on a block has its whole weight
constexpr auto kTwoPoints = gaussLegendre<2>(-1.0, 0.0);  // of an interval that ends at 0
constexpr int kSamplesPerSpan = 8;   // of a curve that is fitted anew: an offset is far smoother than its spans
constexpr int kCellsPerSpan = 3;     // in which the penalty is taken
constexpr int kClosedSpansMin = 12;  // so that band entries of periodic inverses are all different places

/// Gaussian smoothing by order; open ends are continued by reflection in the end point, which keeps it in place. As
/// smoothPolyline() but for two things on which the curves of every page depend: lines of few points are smoothed as
/// far as long ones, and the sums are taken in the order of the points.
std::vector<Vec2> smoothedByOrder(std::span<const Vec2> p, bool closed) {
  const int n = static_cast<int>(p.size());
  const int radius = static_cast<int>(kSmoothingReach * kSmoothingSamples);
  std::vector<double> kernel;
  double sum = 0.0;
  for (int k = -radius; k <= radius; ++k) {
    kernel.push_back(std::exp(-0.5 * k * k / (kSmoothingSamples * kSmoothingSamples)));
    sum += kernel.back();
  }
  const auto get = [&](int i) -> Vec2 {
    if (closed) return p[((i % n) + n) % n];
    if (i < 0) return 2.0 * p.front() - p[std::min(-i, n - 1)];
    if (i >= n) return 2.0 * p.back() - p[std::max(2 * (n - 1) - i, 0)];
    return p[i];
  };
  std::vector<Vec2> out(p.size());
  for (int i = 0; i < n; ++i) {
    Vec2 mean = Vec2::Zero();
    for (int k = -radius; k <= radius; ++k) mean += kernel[k + radius] * get(i + k);
    out[i] = mean / sum;
  }
  return out;
}

Vec2 unitNormal(const Vec2& velocity) {
  const double speed = velocity.norm();
  return speed > 0.0 ? Vec2(leftNormal(velocity) / speed) : Vec2(0.0, 1.0);
}

FrameStation makeStation(const UniformQuintic& base, double u, bool bendOnly) {
  const UniformKnots& knots = base.knots();
  std::array<BandRow, 5> rows = knots.rows(u, bendOnly);
  FrameStation s = frameStation(base.at(u, 4), rows);
  s.u = u;
  return s;
}

/// A used point and its signed distance from the curve.
struct PointResidual {
  const FairPoint& point;
  double e = 0.0;  ///< [px]
};

/// @param limit [px] points farther off by their weight are left out.
void averageBlocks(FairFrame& frame, const FairData& data, const FairFitOptions& options,
                   std::span<const PointResidual> residuals, double limit) {
  const double length = frame.base.knots().length;
  const double wanted = std::max(options.blockPx, kPointsPerBlock / data.density);
  const int count = std::max(1, static_cast<int>(std::lround(length / wanted)));
  frame.blockLength = length / count;
  struct Sum {
    double e = 0.0, t = 0.0, w = 0.0;
    int n = 0;
  };
  std::vector<Sum> sums(count);
  for (const auto& [point, e] : residuals) {
    const double w = point.weight;
    if (std::abs(e) * std::sqrt(w) > limit) continue;
    auto& sum = sums[std::clamp(static_cast<int>(point.t / frame.blockLength), 0, count - 1)];
    sum.e += w * e;
    sum.t += w * point.t;
    sum.w += w;
    ++sum.n;
    frame.squares += e * e;
    ++frame.pointCount;
    frame.weightedSquares += w * e * e;
    frame.weights += w;
  }
  const double expected = frame.blockLength * data.density;
  const double least = std::min(kFewestInBlock, kFewestShare * expected);
  for (const Sum& sum : sums) {
    if (sum.n < std::max(least, kSparseShare * expected) || sum.n == 0) continue;
    FairBlock block;
    block.u = sum.t / sum.w;
    block.offset = sum.e / sum.w;
    block.weight = std::min(1.0, sum.n / (kFullShare * expected)) * sum.w / sum.n;
    block.row = frame.base.knots().row(block.u, 0);
    frame.blocks.push_back(block);
  }
}

}  // namespace

double frameCurvature(const PlaneDerivatives& d) {
  const double w = std::max(d[1].squaredNorm(), 1e-12), v = std::sqrt(w);
  return cross(d[1], d[2]) * (1.0 / (w * v));
}

FrameStation frameStation(const PlaneDerivatives& d, const std::array<BandRow, 5>& b) {
  FrameStation s;
  const double w = std::max(d[1].squaredNorm(), 1e-12), v = std::sqrt(w);
  const double w1 = 2.0 * d[1].dot(d[2]), w2 = 2.0 * (d[2].squaredNorm() + d[1].dot(d[3]));
  const double c = cross(d[1], d[2]), c1 = cross(d[1], d[3]), c2 = cross(d[2], d[3]) + cross(d[1], d[4]);
  const double w32 = 1.0 / (w * v);
  s.kappa = c * w32;
  const double kt = w32 * (c1 - 1.5 * c * w1 / w);
  const double ktt = w32 * (c2 - 3.0 * c1 * w1 / w + 3.75 * c * w1 * w1 / (w * w) - 1.5 * c * w2 / w);
  s.slope = kt / v;
  s.bend = (ktt - 0.5 * kt * w1 / w) / w;
  const double k = s.kappa, k1 = s.slope, k2 = s.bend;
  s.bendRow.first = s.kappaRow.first = s.slopeRow.first = b[0].first;
  for (std::size_t i = 0; i < 6; ++i) {
    s.bendRow.v[i] =
        b[4].v[i] + k * k * b[2].v[i] + 4.0 * k * k1 * b[1].v[i] + (2.0 * k1 * k1 + 2.0 * k * k2) * b[0].v[i];
    s.kappaRow.v[i] = b[2].v[i] + k * k * b[0].v[i];
    s.slopeRow.v[i] = b[3].v[i] + k * k * b[1].v[i] + 2.0 * k * k1 * b[0].v[i];
  }
  return s;
}

UniformKnots fairKnots(double length, double spacingPx, bool closed) {
  const int spans = static_cast<int>(std::lround(length / spacingPx));
  return {length, std::max(spans, closed ? kClosedSpansMin : 1), closed};
}

std::optional<UniformQuintic> fitPilot(FairData& data, const FairFitOptions& options, CancelCheck check) {
  std::vector<Vec2> points;
  for (const FairPoint& p : data.points) points.push_back(p.at);
  const std::vector<Vec2> smooth = smoothedByOrder(points, data.closed);
  const int n = static_cast<int>(smooth.size());
  std::vector<double> t(smooth.size(), 0.0);
  for (int i = 1; i < n; ++i) t[i] = t[i - 1] + (smooth[i] - smooth[i - 1]).norm();
  double length = t.back() + (data.closed ? (smooth.front() - smooth.back()).norm() : 0.0);
  const double spacing = std::max(options.knotSpacingPx, kPointsPerKnot / data.density);
  std::vector<double> weights, e(smooth.size());
  for (const FairPoint& p : data.points) weights.push_back(p.use ? p.weight : 0.0);
  std::optional<UniformQuintic> curve;
  for (int pass = 0; pass < 4; ++pass) {
    if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
    const double lambda = cutoffPenalty(data.density, kPilotCutoffPx);
    curve = fitUniformQuintic(fairKnots(length, spacing, data.closed), t, points, weights, lambda);
    if (!curve) return std::nullopt;
    std::vector<double> used;
    for (int i = 0; i < n; ++i) {
      if (check.isCancelled()) return std::nullopt;
      const FairPoint& p = data.points[i];
      t[i] = curve->footPoint(p.at, t[i], spacing);
      const PlaneDerivatives d = curve->at(t[i], 1);
      e[i] = (p.at - d[0]).dot(unitNormal(d[1]));
      if (p.use) used.push_back(e[i] * std::sqrt(p.weight));
    }
    const double reach = kGateSigmas * std::max(robustSigma(used), kLeastSigmaPx);
    for (int i = 0; i < n; ++i) {
      const FairPoint& p = data.points[i];
      const double x = std::min(1.0, std::abs(e[i]) * std::sqrt(p.weight) / reach);
      weights[i] = p.use ? p.weight * (1.0 - x * x) * (1.0 - x * x) : 0.0;
    }
    if (pass == 3) break;
    for (double& u : t) {
      if (check.isCancelled()) return std::nullopt;
      const double laps = data.closed ? std::floor(u / length) : 0.0;
      u = curve->arcLength(u - laps * length) + laps * curve->length();
    }
    const double origin = data.closed ? 0.0 : t.front();
    length = data.closed ? curve->length() : t.back() - origin;
    for (double& u : t) u -= origin;
  }
  for (int i = 0; i < n; ++i) data.points[i].t = t[i];
  return curve;
}

FairFrame assembleFrame(const UniformQuintic& base, FairData& data, const FairFitOptions& options, int checksPerSpan,
                        CancelCheck check) {
  FairFrame frame;
  frame.base = base;
  const UniformKnots& knots = base.knots();
  std::vector<PointResidual> residuals;
  std::vector<double> used;
  for (FairPoint& p : data.points) {
    if (check.isCancelled()) return frame;
    if (!p.use) continue;
    double u = base.footPoint(p.at, p.t, 0.0);
    if (data.closed) u -= knots.length * std::floor(u / knots.length);
    p.t = u;
    const PlaneDerivatives d = base.at(u, 1);
    residuals.push_back({p, (p.at - d[0]).dot(unitNormal(d[1]))});
    used.push_back(residuals.back().e * std::sqrt(p.weight));
  }
  averageBlocks(frame, data, options, residuals, kGateSigmas * std::max(robustSigma(std::move(used)), kLeastSigmaPx));
  frame.h = BandedMatrix(knots.coefficients(), BandRow::kHalfWidth, knots.closed);
  frame.g = Eigen::VectorXd::Zero(knots.coefficients());
  for (const FairBlock& block : frame.blocks) {
    frame.h.addOuter(block.row, frame.blockLength * block.weight);
    addTo(frame.g, block.row, frame.blockLength * block.weight * block.offset);
  }
  frame.cell = knots.spacing() / kCellsPerSpan;
  for (int j = 0; j < kCellsPerSpan * knots.spans && !check.isCancelled(); ++j)
    frame.penalty.push_back(makeStation(base, (j + 0.5) * frame.cell, true));
  if (checksPerSpan > 0) frame.checks = checkStations(base, checksPerSpan, check);
  return frame;
}

std::vector<FrameStation> checkStations(const UniformQuintic& base, int perSpan, CancelCheck check) {
  const UniformKnots& knots = base.knots();
  const int count = perSpan * knots.spans + (knots.closed ? 0 : 1);
  std::vector<FrameStation> stations;
  stations.reserve(count);
  for (int j = 0; j < count && !check.isCancelled(); ++j)
    stations.push_back(makeStation(base, j * knots.length / (perSpan * knots.spans), false));
  return stations;
}

OffsetPoint offsetPoint(const UniformQuintic& base, const Eigen::VectorXd& d, double u) {
  const PlaneDerivatives p = base.at(u, 2);
  const double speed = std::max(p[1].norm(), 1e-12);
  const Vec2 normal = leftNormal(p[1]) / speed;
  const double kappa = cross(p[1], p[2]) / (speed * speed * speed);
  const auto [value, slope] = base.knots().firstRows(u);
  const double offset = dot(value, d), rate = dot(slope, d);
  return {p[0] + offset * normal, p[1] * (1.0 - kappa * offset) + rate * normal};
}

double parameterAfter(const std::vector<ParameterPair>& places, double before) {
  const auto next = std::upper_bound(places.begin() + 1, places.end() - 1, before,
                                     [](double x, const ParameterPair& place) { return x < place.before; });
  const ParameterPair &low = *(next - 1), &high = *next;
  const double width = high.before - low.before;
  const double part = width > 0.0 ? (before - low.before) / width : 0.0;
  return low.after + part * (high.after - low.after);
}

std::optional<Reframed> reframe(const UniformQuintic& base, const Eigen::VectorXd& d, double from, double to,
                                CancelCheck check) {
  const UniformKnots& knots = base.knots();
  const int intervals = kSamplesPerSpan * knots.spans;
  Reframed out;
  std::vector<double> parameters, arcLengths;
  std::vector<Vec2> points;
  const double step = (to - from) / intervals;
  double length = 0.0;
  for (int j = 0; j <= intervals; ++j) {
    if (check.isCancelled()) return std::nullopt;
    if (j > 0) {
      // Two nodes: an interval is a small part of a span.
      for (std::size_t g = 0; g < 2; ++g)
        length +=
            kTwoPoints.weight[g] * step * offsetPoint(base, d, from + (j + kTwoPoints.node[g]) * step).velocity.norm();
    }
    parameters.push_back(from + j * step);
    arcLengths.push_back(length);
    points.push_back(offsetPoint(base, d, from + j * step).point);
  }
  if (knots.closed) points.pop_back();
  for (int pass = 0; pass < 2; ++pass) {
    if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
    const std::span<const double> s(arcLengths.data(), points.size());
    auto curve = fitUniformQuintic({length, knots.spans, knots.closed}, s, points, {}, 0.0);
    if (!curve) return std::nullopt;
    out.curve = std::move(*curve);
    if (pass == 1) break;
    for (double& a : arcLengths) a = out.curve.arcLength(a);
    length = out.curve.length();
  }
  for (int j = 0; j <= intervals; ++j) out.places.push_back({parameters[j], arcLengths[j]});
  return out;
}

std::optional<UniformQuintic> offsetCurve(const UniformQuintic& base, const Eigen::VectorXd& d, CancelCheck check) {
  const UniformKnots& knots = base.knots();
  const int samples = kSamplesPerSpan * knots.spans + (knots.closed ? 0 : 1);
  std::vector<double> parameters;
  std::vector<Vec2> points;
  for (int j = 0; j < samples; ++j) {
    if (check.isCancelled()) return std::nullopt;
    parameters.push_back(j * knots.length / (static_cast<double>(kSamplesPerSpan) * knots.spans));
    points.push_back(offsetPoint(base, d, parameters.back()).point);
  }
  return fitUniformQuintic(knots, parameters, points, {}, 0.0);
}

}  // namespace batten
