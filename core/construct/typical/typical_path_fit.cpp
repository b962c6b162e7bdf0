// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_path_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/construct/typical/normal_equations.h"
#include "core/construct/typical/typical_path.h"
#include "core/construct/typical/typical_path_feet.h"
#include "core/construct/typical/typical_path_geometry.h"
#include "core/construct/typical/typical_path_unknowns.h"
#include "core/solve/levenberg_marquardt.h"

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
constexpr double kAlongWeight = 0.02;  // of a free state, per unit
/// Share of the hold of a free state by which those behind typical curves are held.
constexpr double kBehindTypical = 0.3;
constexpr double kHermiteFairness = 0.5;  // of a change of the slope of curvature from Hermite piece to Hermite piece
constexpr double kHermiteChange = 0.2;    // of the change of curvature along one, as sagitta
/// Of the largest diagonal of the normal equations: no unknown goes without damping.
constexpr double kDampingFloor = 1e-9;
// Where ten dampings, each larger than the last, bring no lower cost, none will.
constexpr LevenbergOptions kPathSteps{.attempts = 10, .leastDamping = 1e-9};
/// A radian of gap weighs like this many units of length: 0.01 rad like a px.
constexpr double kUnitsPerRadian = 100.0;
/// The gap is closed by so many Newton steps at most, to so much [units, radians, log of curvature].
constexpr int kClosingSteps = 12;
constexpr double kClosed = 1e-13;         // of the gap
constexpr double kClosingDamping = 1e-6;  ///< Relative: only to keep the metric regular.

/// Places of the user may have to move the path.
bool isHeld(const PathData& data) { return data.hold > 0.0 && data.places.empty(); }

/// Sum of squares of everything, as normal equations when asked.
class PathSquares {
 public:
  PathSquares(const TypicalPath& start, const PathData& data)
      : data_(data), unknowns_(start, true, isHeld(data)), before_(start), unit_(std::max(data.noise, 1e-6)) {}
  const PathUnknowns& unknowns() const { return unknowns_; }

  struct System {
    Eigen::MatrixXd squared;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd gapRows;  ///< Derivatives of the gap; no rows where nothing has to vanish.
    std::vector<Row> priors;  ///< Rows that are not yet in `squared`: all at once is several times as fast.

    void takePriors() {
      if (isSparseSystem(gradient.size())) {
        for (const Row& row : priors) addOuter(squared, row);
        priors.clear();
        return;
      }
      Eigen::MatrixXd rows(gradient.size(), static_cast<Eigen::Index>(priors.size()));
      for (std::size_t i = 0; i < priors.size(); ++i) rows.col(static_cast<Eigen::Index>(i)) = priors[i].transpose();
      squared.selfadjointView<Eigen::Lower>().rankUpdate(rows);
      priors.clear();
    }
  };

  /// @param feet warm start and result. Infinity where there is no path.
  double cost(TypicalPath& path, std::vector<PathFoot>& feet, System* system) const {
    constexpr double kImpossible = std::numeric_limits<double>::infinity();  // the cost of what is no path
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
  /// So that all gaps are about as near to none.
  static Eigen::VectorXd levers(Eigen::VectorXd open) {
    if (open.size() == 4) open.tail(2) *= kUnitsPerRadian;
    return open;
  }

  /// The damped step of least squares that closes the gap, or a part of it when it is wide.
  std::optional<Eigen::VectorXd> step(const TypicalPath& path, const System& system,
                                      const Eigen::VectorXd& damping) const {
    Eigen::MatrixXd matrix = system.squared;
    matrix.diagonal() += damping;
    const NormalSolver solver(matrix);
    if (!solver.isSolved()) return std::nullopt;
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
    if (system && !isSparseSystem(unknowns_.count())) {
      jacobian.setZero(count, unknowns_.count());
      residuals.setZero(count);
    }
    Row row;
    for (std::size_t i = 0; i < feet.size(); ++i) {
      const PathFoot& foot = feet[i];
      const double r = foot.distance / unit_, squared = foot.distance * foot.distance;
      sum += c2 > 0.0 ? c2 / (unit_ * unit_) * std::log1p(squared / c2) : r * r;
      if (!system || !canMove(path, foot.element)) continue;
      const double weight = c2 > 0.0 ? 1.0 / std::sqrt(1.0 + squared / c2) : 1.0;
      const auto d = geometry[foot.element].at(foot.t, 1);
      const Vec2 n = leftNormal(d[1].normalized());
      row.setZero(unknowns_.count());
      const std::size_t e = foot.element;
      if (path.elements[e].typical) {
        unknowns_.addTypical(row, path, geometry[e], e, rows[e], {foot.t, n});
      } else {
        PathUnknowns::addHermite(row, {path.states[e], rows[e]}, {path.states[e + 1], rows[e + 1]}, {foot.t, n});
      }
      // The distance shrinks as the path moves towards the point.
      if (isSparseSystem(unknowns_.count())) {
        row *= -weight / unit_;
        addOuter(system->squared, row);
        system->gradient.noalias() += weight * r * row.transpose();
        continue;
      }
      jacobian.row(static_cast<Eigen::Index>(i)) = -weight / unit_ * row;
      residuals(static_cast<Eigen::Index>(i)) = weight * r;
    }
    if (system && !isSparseSystem(unknowns_.count())) {
      system->squared.selfadjointView<Eigen::Lower>().rankUpdate(jacobian.transpose());
      system->gradient.noalias() += jacobian.transpose() * residuals;
    }
    return sum;
  }

  /// Whether any unknown moves an element.
  bool canMove(const TypicalPath& path, std::size_t e) const {
    const auto follows = [&](std::size_t s) { return unknowns_.isUnknown(s) || !path.isFree(s); };
    return path.elements[e].typical || follows(e) || follows(e + 1);
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
      if (!one.typical) continue;
      const int column = unknowns_.shape(e);
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
      if (free && !unknowns_.isUnknown(s)) continue;
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

/// The fit of a path, which becomes the best found.
class PathProblem final : public LevenbergProblem {
 public:
  PathProblem(TypicalPath& path, const PathData& data) : squares_(path, data), path_(path) {}
  const PathUnknowns& unknowns() const { return squares_.unknowns(); }

  double linearise() override {
    const double cost = squares_.cost(path_, feet_, &system_);
    if (!std::isfinite(cost) || system_.squared.size() == 0) return std::numeric_limits<double>::infinity();
    damping_ = system_.squared.diagonal();
    damping_ = damping_.cwiseMax(kDampingFloor * std::max(damping_.maxCoeff(), std::numeric_limits<double>::min()));
    return cost;
  }
  double tryStep(double damping) override {
    const auto step = squares_.step(path_, system_, damping * damping_);
    if (!step) return std::numeric_limits<double>::infinity();
    trial_ = unknowns().moved(path_, *step);
    trialFeet_ = feet_;
    return squares_.cost(trial_, trialFeet_, nullptr);
  }
  void accept() override {
    path_ = std::move(trial_);
    feet_ = std::move(trialFeet_);
  }

  /// Closes the gap at the end exactly, with the least change of the fit: Newton in the metric of the normal equations,
  /// made anew where the fit has not come to rest.
  void closeGap(Termination why) {
    if (why == Termination::IterationLimit) linearise();
    Eigen::MatrixXd metric = system_.squared;
    metric.diagonal() += kClosingDamping * damping_;
    const NormalSolver solver(metric);
    if (!solver.isSolved()) return;
    for (int i = 0; i < kClosingSteps; ++i) {
      const Eigen::VectorXd open = squares_.gap(path_);
      if (open.size() == 0 || open.cwiseAbs().maxCoeff() < kClosed) return;
      const Eigen::MatrixXd rows = squares_.gapRows(path_, unknowns().stateRows(path_));
      const Eigen::MatrixXd away = solver.solve(rows.transpose());
      const Eigen::VectorXd step = -away * (rows * away).ldlt().solve(open);
      if (!step.allFinite()) return;
      TypicalPath next = unknowns().moved(path_, step);
      if (!next.update() || !(squares_.gap(next).norm() < open.norm())) return;
      path_ = next;
    }
  }

 private:
  PathSquares squares_;
  TypicalPath& path_;
  TypicalPath trial_;
  std::vector<PathFoot> feet_, trialFeet_;
  PathSquares::System system_;
  Eigen::VectorXd damping_;  ///< What a damping of 1 adds to the diagonal.
};

/// How far the points lie from a path as it is.
PathFit measured(const TypicalPath& path, const PathData& data) {
  PathFit fit;
  fit.noise = data.noise;
  followFeet(geometryOf(path), data.points, fit.feet);
  double squares = 0.0;
  const double c2 = data.outlier * data.outlier;
  for (const PathFoot& f : fit.feet) {
    const double r2 = f.distance * f.distance;
    squares += r2;
    fit.cost += c2 > 0.0 ? c2 * std::log1p(r2 / c2) : r2;
  }
  fit.rms = fit.feet.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(fit.feet.size()));
  return fit;
}

}  // namespace

std::optional<FittedPath> fitPath(TypicalPath path, const PathData& data, int maxIterations,
                                  const RunContext& context) {
  if (path.elements.empty() || path.states.size() != path.elements.size() + 1) return std::nullopt;
  if (!path.closed) {
    path.states.front().point = data.start;
    if (!path.endsTypical()) path.states.back().point = data.end;
  }
  PathProblem problem(path, data);
  if (problem.unknowns().count() == 0) {
    // Hermite pieces laid along their line are that line; else nothing can move.
    if (!isHeld(data) || !path.update()) return std::nullopt;
    PathFit fit = measured(path, data);
    fit.converged = true;
    return FittedPath{std::move(path), std::move(fit)};
  }
  LevenbergOptions options = kPathSteps;
  options.iterations = maxIterations;
  const LevenbergRun run = levenbergMarquardt(problem, options, context);
  if (run.why == Termination::Degenerate) return std::nullopt;
  if (run.iterations == 0 && !std::isfinite(problem.linearise())) return std::nullopt;  // cancelled
  problem.closeGap(run.why);
  PathFit fit = measured(path, data);
  fit.iterations = run.iterations;
  fit.converged = run.why != Termination::IterationLimit;
  fit.unknowns = problem.unknowns().count();
  return FittedPath{std::move(path), std::move(fit)};
}

}  // namespace batten
