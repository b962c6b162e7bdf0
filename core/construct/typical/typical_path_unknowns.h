// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "core/construct/typical/typical_path.h"
#include "core/construct/typical/typical_path_geometry.h"

namespace batten {

/// Derivatives of one number by all unknowns.
using Row = Eigen::RowVectorXd;
/// Derivatives of a state's x, y, angle and curvature by all unknowns.
using StateRows = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// A step changes a curvature by a factor of e^3 at the most: the linear model does not reach farther.
inline constexpr double kLongestPathLogStep = 3.0;

/// The unknowns of a path by column, and how a step changes it.
class PathUnknowns {
 public:
  /// @param held the path is laid along its line: only what lies near a typical curve has to give way.
  PathUnknowns(const TypicalPath& path, bool pinned, bool held) {
    for (std::size_t s = 0; s < path.states.size(); ++s) {
      Columns c;
      if (path.isFree(s) && (!held || isNearTypical(path, s))) {
        const bool atEnd = s == 0 || s + 1 == path.states.size();
        if (!(atEnd && pinned && !path.closed)) c.place = take(2);
        c.angle = take(1);
        c.kappa = take(1);
        c.isLog = s < path.elements.size() && path.elements[s].typical;
      }
      states_.push_back(c);
    }
    for (const PathElement& e : path.elements) shapes_.push_back(e.typical ? std::optional(take(2)) : std::nullopt);
  }
  int count() const { return count_; }
  /// Whether a state has unknowns of its own.
  bool isUnknown(std::size_t s) const { return states_[s].kappa.has_value(); }
  /// Where the two unknowns of a typical element begin. @pre it is one.
  int shape(std::size_t e) const { return shapes_[e].value(); }

  TypicalPath moved(const TypicalPath& path, const Eigen::VectorXd& step) const {
    TypicalPath result = path;
    for (std::size_t s = 0; s < states_.size(); ++s) {
      const Columns& c = states_[s];
      if (c.place) result.states[s].point += Vec2(step(*c.place), step(*c.place + 1));
      if (c.angle) result.states[s].angleRad += step(*c.angle);
      if (!c.kappa) continue;
      result.states[s].kappa =
          c.isLog
              ? path.states[s].kappa * std::exp(std::clamp(step(*c.kappa), -kLongestPathLogStep, kLongestPathLogStep))
              : path.states[s].kappa + step(*c.kappa);
    }
    for (std::size_t e = 0; e < shapes_.size(); ++e) {
      if (!shapes_[e]) continue;
      result.elements[e].logTurn += step(shape(e));
      result.elements[e].shape += step(shape(e) + 1);
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
        if (c.place) rows[s](0, *c.place) = rows[s](1, *c.place + 1) = 1.0;
        if (c.angle) rows[s](2, *c.angle) = 1.0;
        if (c.kappa) rows[s](3, *c.kappa) = c.isLog ? path.states[s].kappa : 1.0;
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

  /// A place on an element, and the direction along which its derivatives are wanted.
  struct Foot {
    double t = 0.0;  ///< 0..1
    Vec2 along = Vec2::Zero();
  };
  /// Where an element ends, and its derivatives.
  struct ElementEnd {
    const PathState& state;
    const StateRows& rows;
  };

  /// Adds the derivatives of a place on typical element `e`, without the foot's own movement, to `row`.
  /// @param start derivatives of the state where the element starts
  void addTypical(Row& row, const TypicalPath& path, const PathGeometry& g, std::size_t e, const StateRows& start,
                  const Foot& foot) const {
    const double t = foot.t;
    const Vec2& n = foot.along;
    const std::complex<double> z = g.ratio(), w = 1.0 + t * (z - 1.0), v = g.edge() * t * (w * w + w + 1.0);
    const std::complex<double> u = g.edge() * t * t * (2.0 * w + 1.0) * z;
    const auto along = [&](const std::complex<double>& c) { return n.x() * c.real() + n.y() * c.imag(); };
    const std::complex<double> i(0.0, 1.0);
    const Eigen::RowVector4d byState(n.x(), n.y(), along(i * v), -along(v) / path.states[e].kappa);
    row.noalias() += byState * start;
    const ShapeSlopes s = slopes(path.elements[e]);
    const double byRatio = along(v + u),
                 byPhi = along(v) / std::tan(path.elements[e].side * path.elements[e].turn()) + along(i * u);
    row(shape(e)) += byRatio * s.ratioByTurn + byPhi * s.phiByTurn;
    row(shape(e) + 1) += byRatio * s.ratioByShape;
  }

  /// The same for a Hermite element.
  static void addHermite(Row& row, const ElementEnd& start, const ElementEnd& end, const Foot& foot) {
    const PathState &a = start.state, &b = end.state;
    const Vec2& n = foot.along;
    const double t = foot.t, s = 1.0 - t;
    const std::array<double, 6> basis = {s * s * s * s * s,      5 * t * s * s * s * s, 10 * t * t * s * s * s,
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
      byStart(k) += byLength * length.fromStart[k];
      byEnd(k) += byLength * length.fromEnd[k];
    }
    row.noalias() += byStart * start.rows + byEnd * end.rows;
  }

 private:
  struct Columns {
    std::optional<int> place;         ///< Of x; y follows. Absent: pinned, or what comes before decides.
    std::optional<int> angle, kappa;  ///< Absent: what comes before decides.
    bool isLog = false;
  };
  int take(int n) {
    const int first = count_;
    count_ += n;
    return first;
  }

  /// Within so many elements that what a typical curve takes up has gone.
  static bool isNearTypical(const TypicalPath& path, std::size_t s) {
    constexpr std::size_t kGivesWay = 3;  // elements
    const std::size_t count = path.elements.size();
    for (std::size_t k = 0; k < kGivesWay; ++k) {
      const bool isBefore = s > k || path.closed, isAfter = s + k < count || path.closed;
      if (isBefore && path.elements[(s + count - 1 - k % count) % count].typical) return true;
      if (isAfter && path.elements[(s + k) % count].typical) return true;
    }
    return false;
  }

  StateRows behindTypical(const TypicalPath& path, std::size_t e, const StateRows& start) const {
    StateRows rows = start;
    const PathGeometry g(path, e);
    for (const Eigen::Index k : {0, 1}) {
      Row row = Row::Zero(count_);
      addTypical(row, path, g, e, start, {1.0, k == 0 ? Vec2::UnitX() : Vec2::UnitY()});
      rows.row(k) = row;
    }
    const ShapeSlopes s = slopes(path.elements[e]);
    rows(2, shape(e)) += 2.0 * s.phiByTurn;
    const double kappa = path.states[e + 1].kappa;
    rows.row(3) *= kappa / path.states[e].kappa;
    rows(3, shape(e)) -= 4.0 * kappa * s.ratioByTurn;
    rows(3, shape(e) + 1) -= 4.0 * kappa * s.ratioByShape;
    return rows;
  }

  std::vector<Columns> states_;
  std::vector<std::optional<int>> shapes_;
  int count_ = 0;
};

}  // namespace batten
