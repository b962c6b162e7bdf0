// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/construct/typical_path.h"
#include "core/construct/typical_path_geometry.h"

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
constexpr double kHermiteFairness = 0.5;
constexpr double kHermiteChange = 0.2;

using Row = Eigen::RowVectorXd;
/// Derivatives of a state's x, y, angle and curvature by all unknowns.
using StateRows = Eigen::Matrix<double, 4, Eigen::Dynamic>;

std::vector<PathGeometry> geometryOf(const TypicalPath& path) {
  std::vector<PathGeometry> all;
  all.reserve(path.elements.size());
  for (std::size_t e = 0; e < path.elements.size(); ++e) all.emplace_back(path, e);
  return all;
}

/// Newton on the distance, from where the foot is; passes from element to element.
PathFoot refined(const std::vector<PathGeometry>& geometry, const Vec2& p, PathFoot foot) {
  for (int i = 0; i < 25; ++i) {
    const auto d = geometry[foot.element].at(foot.t, 2);
    const Vec2 away = d[0] - p;
    const double speed = d[1].squaredNorm();
    foot.distance = speed > 0.0 ? cross(d[1], p - d[0]) / std::sqrt(speed) : away.norm();
    if (!(speed > 0.0)) break;
    const double bend = std::max(speed + away.dot(d[2]), 0.2 * speed);
    const double next = foot.t - std::clamp(away.dot(d[1]) / bend, -0.7, 0.7);
    const bool forward = next > 1.0 && foot.element + 1 < geometry.size(), back = next < 0.0 && foot.element > 0;
    if ((forward || back) && i < 20) {
      foot.element += forward ? 1 : static_cast<std::size_t>(-1);
      foot.t = forward ? 0.0 : 1.0;
      continue;
    }
    const double t = std::clamp(next, foot.element > 0 ? 0.0 : -0.4, foot.element + 1 < geometry.size() ? 1.0 : 1.4);
    const bool done = std::abs(t - foot.t) < 1e-9;
    foot.t = t;
    if (done) break;
  }
  return foot;
}

void follow(const std::vector<PathGeometry>& geometry, const std::vector<Vec2>& points, std::vector<PathFoot>& feet) {
  const bool fresh = feet.size() != points.size();
  if (fresh) feet.assign(points.size(), {});
  for (std::size_t i = 0; i < points.size(); ++i) {
    feet[i] = refined(geometry, points[i], fresh && i > 0 ? feet[i - 1] : feet[i]);
  }
}

/// The unknowns of a path by column, and how a step changes it.
class Unknowns {
 public:
  Unknowns(const TypicalPath& path, bool pinned) {
    for (std::size_t s = 0; s < path.states.size(); ++s) {
      Columns c;
      if (path.isFree(s)) {
        const bool atEnd = s == 0 || s + 1 == path.states.size();
        if (!(atEnd && pinned && !path.closed)) c.place = take(2);
        c.angle = take(1);
        c.kappa = take(1);
        c.isLog = s < path.elements.size() && path.elements[s].typical;
      }
      states_.push_back(c);
    }
    for (const PathElement& e : path.elements) shapes_.push_back(e.typical ? take(2) : -1);
  }
  int count() const { return count_; }
  int shape(std::size_t e) const { return shapes_[e]; }

  TypicalPath moved(const TypicalPath& path, const Eigen::VectorXd& step) const {
    TypicalPath result = path;
    for (std::size_t s = 0; s < states_.size(); ++s) {
      const Columns& c = states_[s];
      if (c.place >= 0) result.states[s].point += Vec2(step(c.place), step(c.place + 1));
      if (c.angle >= 0) result.states[s].angleRad += step(c.angle);
      if (c.kappa < 0) continue;
      result.states[s].kappa = c.isLog ? path.states[s].kappa * std::exp(std::clamp(step(c.kappa), -3.0, 3.0))
                                       : path.states[s].kappa + step(c.kappa);
    }
    for (std::size_t e = 0; e < shapes_.size(); ++e) {
      if (shapes_[e] < 0) continue;
      result.elements[e].logTurn += step(shapes_[e]);
      result.elements[e].shape += step(shapes_[e] + 1);
    }
    return result;
  }

  /// Derivatives of all states.
  std::vector<StateRows> stateRows(const TypicalPath& path) const {
    std::vector<StateRows> rows(path.states.size());
    for (StateRows& one : rows) one.setZero(4, count_);
    for (std::size_t s = 0; s < states_.size(); ++s) {
      const Columns& c = states_[s];
      if (path.isFree(s)) {
        if (c.place >= 0) rows[s](0, c.place) = rows[s](1, c.place + 1) = 1.0;
        rows[s](2, c.angle) = 1.0;
        rows[s](3, c.kappa) = c.isLog ? path.states[s].kappa : 1.0;
      } else if (path.elements[s - 1].typical) {
        rows[s] = behindTypical(path, s - 1, rows[s - 1]);
      } else {
        rows[s] = rows[0];
      }
    }
    return rows;
  }

  /// d(log h), d(phi) of an element as its two own columns.
  struct ShapeSlopes {
    double ratioByTurn, ratioByShape, phiByTurn;
  };
  static ShapeSlopes slopes(const PathElement& e) {
    const auto ratio = e.logRatioSlopes();
    return {ratio[0], ratio[1], e.side * e.turn()};
  }

  /// Derivative along `n` of the point at t of a typical element, without the foot's own movement.
  void addTypical(Row& row, const TypicalPath& path, const PathGeometry& g, std::size_t e, const StateRows& start,
                  double t, const Vec2& n) const {
    const std::complex<double> z = g.ratio(), w = 1.0 + t * (z - 1.0), v = g.edge() * t * (w * w + w + 1.0);
    const std::complex<double> u = g.edge() * t * t * (2.0 * w + 1.0) * z;
    const auto along = [&](const std::complex<double>& c) { return n.x() * c.real() + n.y() * c.imag(); };
    const std::complex<double> i(0.0, 1.0);
    const Eigen::RowVector4d byState(n.x(), n.y(), along(i * v), -along(v) / path.states[e].kappa);
    row.noalias() += byState * start;
    const ShapeSlopes s = slopes(path.elements[e]);
    const double byRatio = along(v + u), byPhi = along(v) / std::tan(path.elements[e].side * path.elements[e].turn()) + along(i * u);
    row(shapes_[e]) += byRatio * s.ratioByTurn + byPhi * s.phiByTurn;
    row(shapes_[e] + 1) += byRatio * s.ratioByShape;
  }

  /// The same for a Hermite element.
  static void addHermite(Row& row, const PathState& a, const PathState& b, const StateRows& start, const StateRows& end,
                         double t, const Vec2& n) {
    const double s = 1.0 - t;
    const std::array<double, 6> basis = {s * s * s * s * s,          5 * t * s * s * s * s, 10 * t * t * s * s * s,
                                         10 * t * t * t * s * s, 5 * t * t * t * t * s, t * t * t * t * t};
    const HermiteLength length = hermiteLength(a, b);
    const double l = length.length, place = basis[0] + basis[1] + basis[2];
    const double a1 = basis[1] + 2 * basis[2], b1 = basis[4] + 2 * basis[3];
    const Joint from = a.joint(), to = b.joint();
    const Vec2 na = leftNormal(from.tangent), nb = leftNormal(to.tangent);
    const double byLength = n.dot(a1 / 5 * from.tangent + basis[2] * a.kappa * l / 10 * na - b1 / 5 * to.tangent +
                                  basis[3] * b.kappa * l / 10 * nb);
    Eigen::RowVector4d byStart, byEnd;
    byStart << place * n.x(), place * n.y(), n.dot(a1 * l / 5 * na - basis[2] * a.kappa * l * l / 20 * from.tangent),
        basis[2] * l * l / 20 * n.dot(na);
    byEnd << (1 - place) * n.x(), (1 - place) * n.y(),
        n.dot(-b1 * l / 5 * nb - basis[3] * b.kappa * l * l / 20 * to.tangent), basis[3] * l * l / 20 * n.dot(nb);
    for (Eigen::Index k = 0; k < 4; ++k) {
      byStart(k) += byLength * length.fromStart[static_cast<std::size_t>(k)];
      byEnd(k) += byLength * length.fromEnd[static_cast<std::size_t>(k)];
    }
    row.noalias() += byStart * start + byEnd * end;
  }

 private:
  struct Columns {
    int place = -1, angle = -1, kappa = -1;
    bool isLog = false;
  };
  int take(int n) {
    const int first = count_;
    count_ += n;
    return first;
  }

  StateRows behindTypical(const TypicalPath& path, std::size_t e, const StateRows& start) const {
    StateRows rows = start;
    const PathGeometry g(path, e);
    for (const Eigen::Index k : {0, 1}) {
      Row row = Row::Zero(count_);
      addTypical(row, path, g, e, start, 1.0, k == 0 ? Vec2::UnitX() : Vec2::UnitY());
      rows.row(k) = row;
    }
    const ShapeSlopes s = slopes(path.elements[e]);
    rows(2, shapes_[e]) += 2.0 * s.phiByTurn;
    const double kappa = path.states[e + 1].kappa;
    rows.row(3) *= kappa / path.states[e].kappa;
    rows(3, shapes_[e]) -= 4.0 * kappa * s.ratioByTurn;
    rows(3, shapes_[e] + 1) -= 4.0 * kappa * s.ratioByShape;
    return rows;
  }

  std::vector<Columns> states_;
  std::vector<int> shapes_;
  int count_ = 0;
};

/// Sum of squares of everything, as normal equations when asked.
class Problem {
 public:
  Problem(const TypicalPath& start, const PathData& data)
      : data_(data), unknowns_(start, true), before_(start), unit_(std::max(data.noise, 1e-6)) {}
  const Unknowns& unknowns() const { return unknowns_; }

  struct System {
    Eigen::MatrixXd squared;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd gapRows;  ///< Derivatives of the gap; no rows where nothing has to vanish.
  };

  /// @param feet warm start and result. Infinity where there is no path.
  double cost(TypicalPath& path, std::vector<PathFoot>& feet, System* system) const {
    constexpr double kImpossible = std::numeric_limits<double>::infinity();
    if (!path.update()) return kImpossible;
    const auto geometry = geometryOf(path);
    follow(geometry, data_.points, feet);
    std::vector<StateRows> rows;
    if (system) {
      rows = unknowns_.stateRows(path);
      system->squared = Eigen::MatrixXd::Zero(unknowns_.count(), unknowns_.count());
      system->gradient = Eigen::VectorXd::Zero(unknowns_.count());
    }
    double sum = addPoints(path, geometry, feet, rows, system);
    sum += addPriors(path, rows, system);
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
  std::optional<Eigen::VectorXd> step(const TypicalPath& path, const System& system, const Eigen::VectorXd& damping) const {
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
  double addPoints(const TypicalPath& path, const std::vector<PathGeometry>& geometry, const std::vector<PathFoot>& feet,
                   const std::vector<StateRows>& rows, System* system) const {
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
        Unknowns::addHermite(row, path.states[e], path.states[e + 1], rows[e], rows[e + 1], foot.t, n);
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
      system->squared.selfadjointView<Eigen::Lower>().rankUpdate(row.transpose());
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
    sum += addHermitePriors(path, rows, system);
    sum += addPlaces(path, rows, system);
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
      sum += add(system, system ? Row(kAlongWeight * along.transpose() * rows[s].topRows(2)) : Row(), kAlongWeight * moved);
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
      sum += add(system, system ? Row(kPlaceWeight * along.transpose() * rows[s].topRows(2)) : Row(), kPlaceWeight * away);
    }
    return sum;
  }

  const PathData& data_;
  Unknowns unknowns_;
  TypicalPath before_;
  double unit_;
};

/// Closes the gap at the end exactly, with the least change of the fit: Newton in the metric of the normal equations.
void closeGap(TypicalPath& path, const Problem& problem, const Problem::System& system, const Eigen::VectorXd& damping) {
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

std::vector<PathFoot> pathFeet(const TypicalPath& path, const std::vector<Vec2>& points) {
  std::vector<PathFoot> feet;
  follow(geometryOf(path), points, feet);
  return feet;
}

std::optional<PathFit> fitPath(TypicalPath& path, const PathData& data, int maxIterations) {
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
  for (; fit.iterations < maxIterations; ++fit.iterations) {
    const Eigen::VectorXd diagonal = damped();
    bool better = false;
    for (int attempt = 0; attempt < 10 && !better; ++attempt) {
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
  follow(geometryOf(path), data.points, fit.feet);
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
