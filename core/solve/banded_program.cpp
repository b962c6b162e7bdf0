// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/banded_program.h"

#include <type_traits>

#include "core/solve/banded_cholesky.h"
#include "core/solve/column_cholesky.h"

namespace batten {
namespace {

/// The rows of a program one by one, and all at once.
struct BandRows {
  const std::vector<BandRow>& rows;

  double dot(Eigen::Index i, const Eigen::VectorXd& x) const { return batten::dot(rows[i], x); }
  void addTo(Eigen::VectorXd& x, Eigen::Index i, double factor) const { batten::addTo(x, rows[i], factor); }
  Eigen::VectorXd times(const Eigen::VectorXd& x) const {
    Eigen::VectorXd result(std::ssize(rows));
    for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = dot(i, x);
    return result;
  }
  void addTransposed(const Eigen::VectorXd& weight, Eigen::VectorXd& x) const {
    for (Eigen::Index i = 0; i < weight.size(); ++i) addTo(x, i, weight[i]);
  }
  void addOuter(const Eigen::VectorXd& weight, BandedMatrix& m) const {
    for (Eigen::Index i = 0; i < weight.size(); ++i) m.addOuter(rows[i], weight[i]);
  }
};

BandRows rowsOf(const BandedProgram& program) { return {program.rows}; }
const RowGroups& rowsOf(const GroupedProgram& program) { return program.rows; }

/// A program as the interior point method sees it.
template <class Program>
struct ProgramView {
  using Factor = std::conditional_t<std::is_same_v<Program, BandedProgram>, BandedCholesky, ColumnCholesky>;
  const Program& program;

  Eigen::Index size() const { return program.b.size(); }
  Eigen::Index rowCount() const { return std::ssize(program.bounds); }
  const Eigen::VectorXd& linear() const { return program.b; }
  Eigen::VectorXd multiply(const Eigen::VectorXd& v) const { return program.a * v; }
  double bound(Eigen::Index i) const { return program.bounds[i]; }
  double dotRow(Eigen::Index i, const Eigen::VectorXd& v) const { return rowsOf(program).dot(i, v); }
  void addRow(Eigen::Index i, double factor, Eigen::VectorXd& out) const { rowsOf(program).addTo(out, i, factor); }
  Eigen::VectorXd dotRows(const Eigen::VectorXd& v) const { return rowsOf(program).times(v); }
  void addRows(const Eigen::VectorXd& weights, Eigen::VectorXd& out) const {
    rowsOf(program).addTransposed(weights, out);
  }
  bool factorise(const Eigen::VectorXd& weights, Factor& factor) const {
    BandedMatrix m = program.a;
    if (weights.size() > 0) rowsOf(program).addOuter(weights, m);
    if (factor.factor(m, program.leastPivot)) return true;
    for (int i = 0; i < m.size(); ++i) m.entry(i, 0) *= 1.0 + program.ridge;
    return factor.factor(m, program.leastPivot);
  }
};

template <class Program>
InteriorPointResult solved(const Program& program, const InteriorPointLimits& limits, CancelCheck check) {
  const ProgramView<Program> view{program};
  return InteriorPoint(view, limits, check).solve();
}

}  // namespace

InteriorPointResult solveProgram(const BandedProgram& program, const InteriorPointLimits& limits, CancelCheck check) {
  return solved(program, limits, check);
}

InteriorPointResult solveProgram(const GroupedProgram& program, const InteriorPointLimits& limits, CancelCheck check) {
  return solved(program, limits, check);
}

}  // namespace batten
