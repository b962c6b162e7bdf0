// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/nurbs/quintic_nurbs.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/construct/nurbs/quintic_directions.h"
#include "core/construct/stations/adaptive_stations.h"
#include "core/construct/stations/piece_stations.h"
#include "core/curve/knot_operations.h"
#include "core/curve/spline_space.h"
#include "core/solve/banded_least_squares.h"
#include "core/solve/gauss_legendre.h"

namespace batten {

namespace {

constexpr int kQuintic = 5;  // degree
/// Of the distances, of which 000 takes a third.
constexpr double kPaperDivisor = 3.0;
/// Weight of a pinned end against the other equations: what is left of the misfit is its square smaller, 1e-14.
constexpr double kPinnedPlaceWeight = 1e7;
/// Stations whose distances differ by more than this get knots at their distances instead of uniform ones.
constexpr double kUneven = 1.05;

struct SystemInput {
  std::span<const Vec2> points, derivatives;  ///< Derivatives with respect to the parameter of the space.
  GradientUse use = GradientUse::All;
  bool pinStart = false, pinEnd = false;
};

bool usesGradient(const SystemInput& in, bool closed, std::size_t i) {
  if (in.use == GradientUse::All || in.use == GradientUse::Directions) return true;
  if (in.use == GradientUse::NaturalEnds || closed) return false;
  return i < 2 || i + 2 >= in.points.size();
}

/// Four or more points: as many equations as unknowns or more.
std::optional<std::vector<Vec2>> solveLeastSquares(const SplineSpace& space, const SystemInput& in) {
  BandedLeastSquares system(space.unknowns, kQuintic + 1, space.closed);
  const std::size_t m = in.points.size();
  std::array<double, kQuintic + 1> row{};
  const auto add = [&](double u, int order, const Vec2& right, double weight) {
    const BasisRow values = space.row(u, order);
    for (std::size_t j = 0; j < row.size(); ++j) row[j] = weight * values.values[order][j];
    system.add(values.first, row, weight * right);
  };
  for (std::size_t i = 0; i < m; ++i) {
    const bool pinned = (i == 0 && in.pinStart) || (i + 1 == m && in.pinEnd);
    add(space.places[i], 0, in.points[i], pinned ? kPinnedPlaceWeight : 1.0);
    if (usesGradient(in, space.closed, i)) add(space.places[i], 1, in.derivatives[i], 1.0);
  }
  if (in.use == GradientUse::NaturalEnds && !space.closed) {
    for (const double u : {space.places.front(), space.places.back()}) {
      add(u, 2, Vec2::Zero(), 1.0);
      add(u, 4, Vec2::Zero(), 1.0);
    }
  }
  return system.solve();
}

/// Fewer than four points: the smallest integral of |R'''|^2 among all curves that fulfil the equations (Lagrange
/// multipliers). Independent of the origin, unlike the smallest control points.
std::optional<std::vector<Vec2>> solveSmallestEnergy(const SplineSpace& space, const SystemInput& in) {
  const int n = space.unknowns, m = static_cast<int>(in.points.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 2 * m, n + 2 * m);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n + 2 * m, 2);
  // |R'''|^2 is of degree 4: three Gauss points per span are exact.
  static constexpr auto kRule = gaussLegendre<3>();
  for (std::size_t i = 0; i + 1 < space.places.size(); ++i) {
    const double half = 0.5 * (space.places[i + 1] - space.places[i]);
    for (std::size_t g = 0; g < kRule.node.size(); ++g) {
      const BasisRow row = space.row(space.places[i] + half * (1.0 + kRule.node[g]), 3);
      const Eigen::Map<const Eigen::Matrix<double, 6, 1>> third(row.values[3].data());
      system.block<6, 6>(row.first, row.first) += kRule.weight[g] * half * third * third.transpose();
    }
  }
  // About the first point: large coordinates would cost digits.
  const Vec2 origin = in.points[0];
  for (int i = 0; i < m; ++i) {
    const BasisRow row = space.row(space.places[i], 1);
    for (int j = 0; j <= kQuintic; ++j) {
      for (int order = 0; order < 2; ++order) {
        const double value = row.values[order][j];
        system(n + 2 * i + order, row.first + j) = system(row.first + j, n + 2 * i + order) = value;
      }
    }
    right.row(n + 2 * i) = (in.points[i] - origin).transpose();
    right.row(n + 2 * i + 1) = in.derivatives[i].transpose();
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(system);
  if (!lu.isInvertible()) return std::nullopt;
  const Eigen::MatrixXd x = lu.solve(right);
  if (!x.allFinite()) return std::nullopt;
  std::vector<Vec2> result;
  result.reserve(n);
  for (int i = 0; i < n; ++i) result.emplace_back(x.row(i).transpose() + origin);
  return result;
}

std::optional<std::vector<Vec2>> solveSystem(const SplineSpace& space, const SystemInput& in) {
  const bool few = !space.closed && in.points.size() < 4 && in.use != GradientUse::NaturalEnds;
  return few ? solveSmallestEnergy(space, in) : solveLeastSquares(space, in);
}

/// Parameters of the stations, mean spacing 1, and what one unit of them is in px.
struct Places {
  std::vector<double> at;
  double unit = 1.0;
  bool uniform = true;
};

Places placesOf(const std::vector<double>& distances, std::size_t m, bool closed, bool forceUniform) {
  const auto [low, high] = std::minmax_element(distances.begin(), distances.end());
  Places places;
  double total = 0.0;
  for (const double d : distances) total += d;
  places.unit = total / static_cast<double>(distances.size());
  places.uniform = forceUniform || *high <= kUneven * *low;
  if (places.uniform) {
    places.at = uniformPlaces(m, closed);
    return places;
  }
  places.at = {0.0};
  for (const double d : distances) places.at.push_back(places.at.back() + d / places.unit);
  return places;
}

/// Derivative vectors with respect to the places: along the stations' directions, as long as the rule says.
std::vector<Vec2> derivativesFor(std::span<const Station> stations, const ConstructParams& params, bool closed,
                                 const Places& places) {
  const auto magnitudes = derivativeMagnitudes(stations, closed, params.derivativeMagnitude, params.magnitudeAsInPaper);
  const std::size_t m = stations.size(), spans = places.at.size() - 1;
  std::vector<Vec2> derivatives;
  for (std::size_t i = 0; i < m; ++i) {
    // The rule is for knots one apart; the mean of the two spacings takes their place.
    const auto width = [&](std::size_t k) { return places.at[k + 1] - places.at[k]; };
    const bool first = i == 0 && !closed, last = i + 1 == m && !closed;
    const double before = first ? width(0) : width((i + spans - 1) % spans);
    const double after = last ? before : width(i);
    derivatives.push_back(stations[i].direction * (magnitudes[i] / (0.5 * (before + after))));
  }
  return derivatives;
}

/// Even knots whatever the distances; what that costs is taken from the lengths of the derivatives.
Result<ConstructedPiece> constructFromDirections(std::span<const Station> stations, const ConstructParams& params) {
  const auto magnitudes = derivativeMagnitudes(stations, false, params.derivativeMagnitude, params.magnitudeAsInPaper);
  std::vector<Vec2> points, directions;
  double total = 0.0;
  for (const double d : arcCorrectedDistances(stations, false)) total += d;
  for (const Station& s : stations) {
    points.push_back(s.point);
    directions.push_back(s.direction);
  }
  DirectionWeights weights;
  weights.pinEnds = params.ends == ConstructEnds::Line;
  auto solution = solveQuinticDirections(points, directions, magnitudes, weights);
  if (!solution) return fail(solution.error());
  const SplineSpace space = splineSpace(kQuintic, uniformPlaces(stations.size(), false), false);
  std::vector<double> knots = space.knots;
  for (double& k : knots) k *= total / static_cast<double>(stations.size() - 1);
  auto open = NurbsCurve::make(kQuintic, std::move(knots), std::move(*solution));
  if (!open) return fail(open.error());
  auto curve =
      params.ends == ConstructEnds::Line ? clampedWithEnds(*open, points.front(), points.back()) : clamped(*open);
  if (!curve) return fail(curve.error());
  ConstructedPiece result{std::move(*curve), {}};
  result.report.why = Termination::Exact;
  return result;
}

/// A clamped curve and the parameters of its stations.
struct CurveOnStations {
  NurbsCurve curve;
  std::vector<double> places;
};

std::optional<CurveOnStations> curveThrough(std::span<const Station> stations, bool closed,
                                            const ConstructParams& params) {
  const auto distances = arcCorrectedDistances(stations, closed);
  const Places places = placesOf(distances, stations.size(), closed, params.magnitudeAsInPaper);
  const auto derivatives = derivativesFor(stations, params, closed, places);
  std::vector<Vec2> points;
  for (const Station& s : stations) points.push_back(s.point);
  const SplineSpace space = splineSpace(kQuintic, places.at, closed);
  const bool isPinned = !closed && params.ends == ConstructEnds::Line;
  const auto solution = solveSystem(space, {points, derivatives, params.gradients, isPinned, isPinned});
  if (!solution) return std::nullopt;
  std::vector<double> knots = space.knots, at = places.at;
  for (std::vector<double>* values : {&knots, &at}) {
    for (double& k : *values) k *= places.unit;
  }
  auto open = NurbsCurve::make(kQuintic, std::move(knots), space.unrolled(*solution));
  if (!open) return std::nullopt;
  const Vec2 start = isPinned ? points.front() : open->point(open->start());
  auto curve = clampedWithEnds(*open, start, closed ? start : isPinned ? points.back() : open->point(open->end()));
  if (!curve) return std::nullopt;
  return CurveOnStations{std::move(*curve), std::move(at)};
}

/// From station to station.
std::vector<std::vector<Vec2>> polylinesOf(const CurveOnStations& made) {
  constexpr int kSteps = 16;  // from station to station: a chord leaves the curve by 1/256 of what it bends out there
  std::vector<std::vector<Vec2>> lines;
  for (std::size_t i = 0; i + 1 < made.places.size(); ++i) {
    auto& line = lines.emplace_back();
    for (int k = 0; k <= kSteps; ++k) {
      const double t = static_cast<double>(k) / kSteps;
      line.push_back(made.curve.point((1.0 - t) * made.places[i] + t * made.places[i + 1]));
    }
  }
  return lines;
}

}  // namespace

std::vector<double> derivativeMagnitudes(std::span<const Station> stations, bool closed, double factor,
                                         bool asInPaper) {
  const std::size_t m = stations.size();
  if (m < 2) return std::vector<double>(m, 0.0);
  std::vector<double> distances = arcCorrectedDistances(stations, closed);
  if (asInPaper) {
    for (std::size_t i = 0; i < distances.size(); ++i) {
      distances[i] = (stations[(i + 1) % m].point - stations[i].point).norm();
    }
    factor /= kPaperDivisor;
  }
  std::vector<double> magnitudes;
  for (std::size_t i = 0; i < m; ++i) {
    const bool first = i == 0 && !closed, last = i + 1 == m && !closed;
    const double before = first ? distances[0] : distances[(i + distances.size() - 1) % distances.size()];
    const double after = last ? before : distances[i];
    magnitudes.push_back(factor * 0.5 * (before + after));
  }
  return magnitudes;
}

Result<QuinticSystemResult> solveQuintic(std::span<const Vec2> points, std::span<const Vec2> derivatives, bool closed,
                                         GradientUse use) {
  const std::size_t m = points.size();
  if (derivatives.size() != m || m < (closed ? 6u : 2u)) {
    return fail(ErrorCode::Numerical, "There are too few stations for a quintic curve: choose more segments.");
  }
  const SplineSpace space = splineSpace(kQuintic, uniformPlaces(m, closed), closed);
  const SystemInput input{points, derivatives, use, false, false};
  const auto solution = solveSystem(space, input);
  if (!solution) return fail(ErrorCode::Numerical, "The equations of the curve have no single solution.");
  QuinticSystemResult result;
  result.controlPoints = *solution;
  double position = 0.0, derivative = 0.0;
  for (std::size_t i = 0; i < m; ++i) {
    const BasisRow row = space.row(space.places[i], 1);
    Vec2 r = -points[i], d = -derivatives[i];
    for (std::size_t j = 0; j <= kQuintic; ++j) {
      const auto index = (row.first + j) % space.unknowns;
      r += row.values[0][j] * result.controlPoints[index];
      d += row.values[1][j] * result.controlPoints[index];
    }
    position += r.squaredNorm();
    derivative += d.squaredNorm();
  }
  result.residualRmsPosition = std::sqrt(position / static_cast<double>(m));
  result.residualRmsDerivative = std::sqrt(derivative / static_cast<double>(m));
  return result;
}

Result<ConstructedPiece> constructQuinticNurbs(const ConstructPiece& piece, const ConstructParams& params,
                                               const RunContext& context) {
  if (context.isCancelled()) return cancelled();
  StationSet set = givenStations(usableStations(piece, kFewestClosedStations, params.ends));
  const bool closed = piece.closed;
  if (set.stations.size() < (closed ? 6u : 2u)) {
    return straightPiece(piece, "Too few stations for a curve; a straight line was used.");
  }
  if (params.gradients == GradientUse::Directions && !closed && set.stations.size() >= 4) {
    return constructFromDirections(set.plain(), params);
  }
  if (!params.magnitudeAsInPaper) {
    const auto through = [&](const StationSet& now) {
      const auto made = curveThrough(now.plain(), closed, params);
      return made ? polylinesOf(*made) : std::vector<std::vector<Vec2>>{};
    };
    set = adaptiveStations(piece, std::move(set), params.maxDeviationPx, through, context);
    if (context.isCancelled()) return cancelled();
  }
  auto made = curveThrough(set.plain(), closed, params);
  if (!made && set.added > 0) {
    set = givenStations(usableStations(piece, kFewestClosedStations, params.ends));
    made = curveThrough(set.plain(), closed, params);
  }
  if (!made) return straightPiece(piece, "The equations of the curve have no solution; a straight line was used.");
  ConstructedPiece result{std::move(made->curve), {}};
  result.report.why = Termination::Exact;
  result.report.stationsAdded = set.added;
  result.report.note = maxDeviationNote(set);
  return result;
}

}  // namespace batten
