// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/banded_program.h"

#include "core/solve/banded_cholesky.h"
#include "core/solve/column_cholesky.h"
#include "core/solve/packed_rows.h"

namespace batten {
namespace {

void timesRows(const PackedRows& rows, const Eigen::VectorXd& v, Eigen::VectorXd& out) { rows.times(v, out); }
void timesRows(const RowGroups& rows, const Eigen::VectorXd& v, Eigen::VectorXd& out) { out = rows.times(v); }
double timesRow(const BandedProgram& program, Eigen::Index i, const Eigen::VectorXd& v) {
  return dot(program.rows[i], v);
}
double timesRow(const GroupedProgram& program, Eigen::Index i, const Eigen::VectorXd& v) {
  return program.rows.dot(i, v);
}
void addRowOf(const BandedProgram& program, Eigen::Index i, double factor, Eigen::VectorXd& out) {
  addTo(out, program.rows[i], factor);
}
void addRowOf(const GroupedProgram& program, Eigen::Index i, double factor, Eigen::VectorXd& out) {
  program.rows.addTo(out, i, factor);
}

/// A program as the interior point method sees it; `Rows` as products go through all of them.
template <class Program, class Rows, class FactorOfSystem>
struct ProgramView {
  using Factor = FactorOfSystem;
  const Program& program;
  const Rows& rows;
  mutable BandedMatrix system = {};  ///< What factorise() works in.

  Eigen::Index size() const { return program.b.size(); }
  Eigen::Index rowCount() const { return std::ssize(program.bounds); }
  const Eigen::VectorXd& linear() const { return program.b; }
  void multiply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const { program.a.multiply(v, out); }
  double bound(Eigen::Index i) const { return program.bounds[i]; }
  double dotRow(Eigen::Index i, const Eigen::VectorXd& v) const { return timesRow(program, i, v); }
  void addRow(Eigen::Index i, double factor, Eigen::VectorXd& out) const { addRowOf(program, i, factor, out); }
  void dotRows(const Eigen::VectorXd& v, Eigen::VectorXd& out) const { timesRows(rows, v, out); }
  void addRows(const Eigen::VectorXd& weights, Eigen::VectorXd& out) const { rows.addTransposed(weights, out); }
  bool factorise(const Eigen::VectorXd& weights, Factor& factor) const {
    system = program.a;
    if (weights.size() > 0) rows.addOuter(weights, system);
    if (factor.factor(system, program.leastPivot)) return true;
    for (int i = 0; i < system.size(); ++i) system.entry(i, 0) *= 1.0 + program.ridge;
    return factor.factor(system, program.leastPivot);
  }
};

}  // namespace

InteriorPointResult solveProgram(const BandedProgram& program, const InteriorPointLimits& limits, CancelCheck check) {
  const PackedRows rows(program.rows, program.a.size());
  const ProgramView<BandedProgram, PackedRows, BandedCholesky> view{program, rows};
  return InteriorPoint(view, limits, check).solve();
}

InteriorPointResult solveProgram(const GroupedProgram& program, const InteriorPointLimits& limits, CancelCheck check) {
  const ProgramView<GroupedProgram, RowGroups, ColumnCholesky> view{program, program.rows};
  return InteriorPoint(view, limits, check).solve();
}

}  // namespace batten
