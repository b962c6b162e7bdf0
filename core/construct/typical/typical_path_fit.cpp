// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_path_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/construct/typical/typical_path.h"
#include "core/construct/typical/typical_path_feet.h"
#include "core/construct/typical/typical_path_geometry.h"
#include "core/construct/typical/typical_path_unknowns.h"

namespace batten {

namespace {

/// What a gap at the end costs while a path is on its way, in standard deviations of points.
constexpr double kGapWeight = 10.0;
/// A step closes at most this much of a gap [units]: the linear model does not reach farther.
constexpr double kLargestClosing = 30.0;
/// Places along the line that the user set are met within about a tenth of a unit.
constexpr double kPlaceWeight = 10.0;
/// How firmly a segment keeps its share of the turn, and a free state its place along the line.
constexpr double kTurnWeight = 0.5;
constexpr double kAlongWeight = 0.02;
/// Share of the hold of a free state by which those behind typical curves are held.
constexpr double kBehindTypical = 0.3;
constexpr double kHermiteFairness = 0.5;
constexpr double kHermiteChange = 0.2;

/// Sum of squares of everything, as normal equations when asked.
class Problem {
 public:
  Problem(const TypicalPath& start, const PathData& data)
      : data_(data), unknowns_(start, true), before_(start), unit_(std::max(data.noise, 1e-6)) {}
  const PathUnknowns& unknowns() const { return unknowns_; }

  struct System {
    Eigen::MatrixXd squared;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd gapRows;  ///< Derivatives of the gap; no rows where nothing has to vanish.
    std::vector<Row> priors;  ///< Rows that are not yet in `squared`: all at once is several times as fast.

    void takePriors() {
      Eigen::MatrixXd rows(gradient.size(), static_cast<Eigen::Index>(priors.size()));
      for (std::size_t i = 0; i < priors.size(); ++i) rows.col(static_cast<Eigen::Index>(i)) = priors[i].transpose();
      squared.selfadjointView<Eigen::Lower>().rankUpdate(rows);
      priors.clear();
    }
  };

  /// @param feet warm start and result. Infinity where there is no path.
  double cost(TypicalPath& path, std::vector<PathFoot>& feet, System* system) const {
    constexpr double kImpossible = std::numeric_limits<double>::infinity();
    if (!path.update()) return kImpossible;
    const auto geometry = geometryOf(path);
    followFeet(geometry, data_.points, feet);
    std::vector<StateRows> rows;
    if (system) {
      rows = unknowns_.stateRows(path);
      system->squared = Eigen::MatrixXd::Zero(unknowns_.count(), unknowns_.count());
      system->gradient = Eigen::VectorXd::Zero(unknowns_.count());
    }
    double sum = addPoints(path, geometry, feet, rows, system);
    sum += addPriors(path, rows, system);
    if (system) system->takePriors();
    const Eigen::VectorXd open = gap(path);
    if (system && open.size() > 0) system->gapRows = gapRows(path, rows);
    if (open.size() > 0) sum += (kGapWeight / unit_ * levers(open)).squaredNorm();
    return std::isfinite(sum) ? sum : kImpossible;
  }

  /// What has to vanish: the gap at the end of the path.
  Eigen::VectorXd gap(const TypicalPath& path) const {
    if (!path.endsTypical()) return {};
    const PathState &last = path.states.back(), &first = path.states.front();
    if (!path.closed) return last.point - data_.end;
    return Eigen::Vector4d(last.point.x() - first.point.x(), last.point.y() - first.point.y(),
                           std::remainder(last.angleRad - first.angleRad, 2.0 * std::numbers::pi),
                           std::log(last.kappa / first.kappa));
  }
  Eigen::MatrixXd gapRows(const TypicalPath& path, const std::vector<StateRows>& rows) const {
    const PathState &last = path.states.back(), &first = path.states.front();
    if (!path.closed) return rows.back().topRows(2);
    Eigen::MatrixXd result = rows.back() - rows.front();
    result.row(3) = rows.back().row(3) / last.kappa - rows.front().row(3) / first.kappa;
    return result;
  }
  /// A radian of gap weighs like this many units of length, so that all gaps are about as near to none.
  static Eigen::VectorXd levers(Eigen::VectorXd open) {
    if (open.size() == 4) open.tail(2) *= 100.0;
    return open;
  }

  /// The damped step of least squares that closes the gap, or a part of it when it is wide.
  std::optional<Eigen::VectorXd> step(const TypicalPath& path, const System& system,
                                      const Eigen::VectorXd& damping) const {
    Eigen::MatrixXd matrix = system.squared;
    matrix.diagonal() += damping;
    const Eigen::LDLT<Eigen::MatrixXd> solver(matrix);
    if (solver.info() != Eigen::Success) return std::nullopt;
    Eigen::VectorXd result = -solver.solve(system.gradient);
    const Eigen::VectorXd open = gap(path);
    if (open.size() > 0) {
      const double width = levers(open).norm(), share = width > kLargestClosing ? kLargestClosing / width : 1.0;
      const Eigen::MatrixXd away = solver.solve(system.gapRows.transpose());
      result -= away * (system.gapRows * away).ldlt().solve(system.gapRows * result + share * open);
    }
    if (!result.allFinite()) return std::nullopt;
    return result;
  }

 private:
  double addPoints(const TypicalPath& path, const std::vector<PathGeometry>& geometry,
                   const std::vector<PathFoot>& feet, const std::vector<StateRows>& rows, System* system) const {
    double sum = 0.0;
    const double c2 = data_.outlier * data_.outlier;
    const auto count = static_cast<Eigen::Index>(feet.size());
    Eigen::MatrixXd jacobian;
    Eigen::VectorXd residuals;
    if (system) {
      jacobian.setZero(count, unknowns_.count());
      residuals.setZero(count);
    }
    Row row;
    for (std::size_t i = 0; i < feet.size(); ++i) {
      const PathFoot& foot = feet[i];
      const double r = foot.distance / unit_, squared = foot.distance * foot.distance;
      sum += c2 > 0.0 ? c2 / (unit_ * unit_) * std::log1p(squared / c2) : r * r;
      if (!system) continue;
      const double weight = c2 > 0.0 ? 1.0 / std::sqrt(1.0 + squared / c2) : 1.0;
      const auto d = geometry[foot.element].at(foot.t, 1);
      const Vec2 n = leftNormal(d[1].normalized());
      row.setZero(unknowns_.count());
      const std::size_t e = foot.element;
      if (path.elements[e].typical) {
        unknowns_.addTypical(row, path, geometry[e], e, rows[e], foot.t, n);
      } else {
        PathUnknowns::addHermite(row, path.states[e], path.states[e + 1], rows[e], rows[e + 1], foot.t, n);
      }
      // The distance shrinks as the path moves towards the point.
      jacobian.row(static_cast<Eigen::Index>(i)) = -weight / unit_ * row;
      residuals(static_cast<Eigen::Index>(i)) = weight * r;
    }
    if (system) {
      system->squared.selfadjointView<Eigen::Lower>().rankUpdate(jacobian.transpose());
      system->gradient.noalias() += jacobian.transpose() * residuals;
    }
    return sum;
  }

  static double add(System* system, const Row& row, double residual) {
    if (system) {
      system->priors.push_back(row);
      system->gradient.noalias() += residual * row.transpose();
    }
    return residual * residual;
  }

  double addPriors(const TypicalPath& path, const std::vector<StateRows>& rows, System* system) const {
    const int p = unknowns_.count();
    double sum = 0.0;
    for (std::size_t e = 0; e < path.elements.size(); ++e) {
      const PathElement& one = path.elements[e];
      const int column = unknowns_.shape(e);
      if (!one.typical) continue;
      Row row = Row::Zero(p);
      row(column) = kTurnWeight;
      sum += add(system, row, kTurnWeight * (one.logTurn - before_.elements[e].logTurn));
      if (e + 1 == path.elements.size() || !path.elements[e + 1].typical) continue;
      const PathElement& next = path.elements[e + 1];
      if (one.trend != next.trend) continue;
      row.setZero();
      const auto a = one.logRatioSlopes(), b = next.logRatioSlopes();
      const int other = unknowns_.shape(e + 1);
      row(column) -= data_.fairness * a[0];
      row(column + 1) -= data_.fairness * a[1];
      row(other) += data_.fairness * b[0];
      row(other + 1) += data_.fairness * b[1];
      sum += add(system, row, data_.fairness * (next.logRatio() - one.logRatio()));
    }
    sum += data_.hold > 0.0 ? addHolds(path, rows, system) : addHermitePriors(path, rows, system);
    sum += addPlaces(path, rows, system);
    return sum;
  }

  double elementLength(const TypicalPath& path, std::size_t e) const {
    return (path.states[e + 1].point - path.states[e].point).norm();
  }

  /// States stay as they were: what a turn or a bend there would move over half of the neighbouring pieces. Behind
  /// typical curves the place is left to these.
  double addHolds(const TypicalPath& path, const std::vector<StateRows>& rows, System* system) const {
    double sum = 0.0;
    const std::size_t last = path.states.size() - 1;
    for (std::size_t s = 0; s <= last; ++s) {
      const bool free = path.isFree(s);
      if (!free && s < last && path.elements[s].typical) continue;
      const double behind = elementLength(path, s < last ? s : s - 1),
                   ahead = s > 0 ? elementLength(path, s - 1) : behind;
      const double reach = 0.25 * (behind + ahead);
      const double weight = (free ? 1.0 : kBehindTypical) / data_.hold;
      const PathState &is = path.states[s], &was = before_.states[s];
      const Vec2 moved = is.point - was.point;
      const std::array<double, 4> miss = {moved.x(), moved.y(), reach * (is.angleRad - was.angleRad),
                                          0.5 * reach * reach * (is.kappa - was.kappa)};
      const std::array<double, 4> factor = {1.0, 1.0, reach, 0.5 * reach * reach};
      for (std::size_t k = 0; k < 4; ++k) {
        sum += add(system, system ? Row(weight * factor[k] * rows[s].row(static_cast<Eigen::Index>(k))) : Row(),
                   weight * miss[k]);
      }
    }
    return sum;
  }

  double addHermitePriors(const TypicalPath& path, const std::vector<StateRows>& rows, System* system) const {
    double sum = 0.0;
    for (std::size_t e = 0; e < path.elements.size(); ++e) {
      if (path.elements[e].typical) continue;
      // Where the points say little the curvature stays as it is.
      const double length = path.hermiteLength(e), weight = kHermiteChange * length * length / 8.0;
      sum += add(system, system ? Row(weight * (rows[e + 1].row(3) - rows[e].row(3))) : Row(),
                 weight * (path.states[e + 1].kappa - path.states[e].kappa));
    }
    for (std::size_t s = 1; s + 1 < path.states.size(); ++s) {
      if (!path.isFree(s)) continue;
      const Vec2 along = before_.states[s].joint().tangent;
      const double moved = along.dot(path.states[s].point - before_.states[s].point);
      sum += add(system, system ? Row(kAlongWeight * along.transpose() * rows[s].topRows(2)) : Row(),
                 kAlongWeight * moved);
      if (path.elements[s].typical) continue;
      // The curvature goes on evenly from Hermite piece to Hermite piece.
      const double before = path.hermiteLength(s - 1), after = path.hermiteLength(s), mean = 0.5 * (before + after);
      const double weight = kHermiteFairness * mean * mean * mean / 64.0;
      const double change = (path.states[s + 1].kappa - path.states[s].kappa) / after -
                            (path.states[s].kappa - path.states[s - 1].kappa) / before;
      Row row;
      if (system) {
        row = weight * ((rows[s + 1].row(3) - rows[s].row(3)) / after - (rows[s].row(3) - rows[s - 1].row(3)) / before);
      }
      sum += add(system, row, weight * change);
    }
    return sum;
  }

  double addPlaces(const TypicalPath& path, const std::vector<StateRows>& rows, System* system) const {
    double sum = 0.0;
    for (std::size_t s = 0; s < data_.places.size() && s < path.states.size(); ++s) {
      if (!data_.places[s]) continue;
      const Vec2 along = before_.states[s].joint().tangent;
      const double away = along.dot(path.states[s].point - *data_.places[s]);
      sum +=
          add(system, system ? Row(kPlaceWeight * along.transpose() * rows[s].topRows(2)) : Row(), kPlaceWeight * away);
    }
    return sum;
  }

  const PathData& data_;
  PathUnknowns unknowns_;
  TypicalPath before_;
  double unit_;
};

/// Closes the gap at the end exactly, with the least change of the fit: Newton in the metric of the normal equations.
void closeGap(TypicalPath& path, const Problem& problem, const Problem::System& system,
              const Eigen::VectorXd& damping) {
  Eigen::MatrixXd metric = system.squared;
  metric.diagonal() += 1e-6 * damping;
  const Eigen::LDLT<Eigen::MatrixXd> solver(metric);
  if (solver.info() != Eigen::Success) return;
  for (int i = 0; i < 12; ++i) {
    const Eigen::VectorXd open = problem.gap(path);
    if (open.size() == 0 || open.cwiseAbs().maxCoeff() < 1e-13) return;
    const Eigen::MatrixXd rows = problem.gapRows(path, problem.unknowns().stateRows(path));
    const Eigen::MatrixXd away = solver.solve(rows.transpose());
    const Eigen::VectorXd step = -away * (rows * away).ldlt().solve(open);
    if (!step.allFinite()) return;
    TypicalPath next = problem.unknowns().moved(path, step);
    if (!next.update() || !(problem.gap(next).norm() < open.norm())) return;
    path = next;
  }
}

}  // namespace

std::optional<PathFit> fitPath(TypicalPath& path, const PathData& data, int maxIterations, const RunContext& context) {
  if (path.elements.empty() || path.states.size() != path.elements.size() + 1) return std::nullopt;
  if (!path.closed) {
    path.states.front().point = data.start;
    if (!path.endsTypical()) path.states.back().point = data.end;
  }
  const Problem problem(path, data);
  PathFit fit;
  Problem::System system;
  double cost = problem.cost(path, fit.feet, &system);
  if (!std::isfinite(cost)) return std::nullopt;
  const auto damped = [&] {
    Eigen::VectorXd d = system.squared.diagonal();
    const double floor = 1e-9 * std::max(d.maxCoeff(), 1e-300);
    return Eigen::VectorXd(d.cwiseMax(floor));
  };
  double lambda = 1e-3;
  int small = 0;
  for (; fit.iterations < maxIterations && !context.isCancelled(); ++fit.iterations) {
    const Eigen::VectorXd diagonal = damped();
    bool better = false;
    for (int attempt = 0; attempt < 10 && !better && !context.isCancelled(); ++attempt) {
      if (const auto step = problem.step(path, system, lambda * diagonal)) {
        TypicalPath trial = problem.unknowns().moved(path, *step);
        std::vector<PathFoot> feet = fit.feet;
        const double reached = problem.cost(trial, feet, nullptr);
        better = reached < cost;
        if (better) {
          small = cost - reached < 1e-4 * cost ? small + 1 : 0;
          cost = reached;
          path = std::move(trial);
          fit.feet = std::move(feet);
        }
      }
      lambda = better ? std::max(lambda / 5.0, 1e-9) : lambda * 4.0;
    }
    if (!better || small >= 2) {
      fit.converged = true;
      break;
    }
    cost = problem.cost(path, fit.feet, &system);
  }
  closeGap(path, problem, system, damped());
  fit.feet.clear();
  followFeet(geometryOf(path), data.points, fit.feet);
  double squares = 0.0;
  const double c2 = data.outlier * data.outlier;
  for (const PathFoot& f : fit.feet) {
    const double r2 = f.distance * f.distance;
    squares += r2;
    fit.cost += c2 > 0.0 ? c2 * std::log1p(r2 / c2) : r2;
  }
  fit.rms = fit.feet.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(fit.feet.size()));
  fit.unknowns = problem.unknowns().count();
  return fit;
}

}  // namespace batten
