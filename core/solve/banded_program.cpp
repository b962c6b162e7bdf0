// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/banded_program.h"

#include "core/solve/banded_cholesky.h"

namespace batten {
namespace {

/// A BandedProgram as the interior point method sees it.
template <class Row>
struct ProgramView {
  using Factor = BandedCholesky;
  const BandedProgram<Row>& program;

  Eigen::Index size() const { return program.b.size(); }
  Eigen::Index rowCount() const { return static_cast<Eigen::Index>(program.rows.size()); }
  const Eigen::VectorXd& linear() const { return program.b; }
  Eigen::VectorXd multiply(const Eigen::VectorXd& v) const { return program.a * v; }
  double bound(Eigen::Index i) const { return program.bounds[i]; }
  double dotRow(Eigen::Index i, const Eigen::VectorXd& v) const { return dot(program.rows[i], v); }
  void addRow(Eigen::Index i, double factor, Eigen::VectorXd& out) const { addTo(out, program.rows[i], factor); }
  bool factorise(const Eigen::VectorXd& weights, Factor& factor) const {
    BandedMatrix m = program.a;
    for (Eigen::Index i = 0; i < weights.size(); ++i) m.addOuter(program.rows[i], weights[i]);
    if (factor.factor(m, program.leastPivot)) return true;
    for (int i = 0; i < m.size(); ++i) m.entry(i, 0) *= 1.0 + program.ridge;
    return factor.factor(m, program.leastPivot);
  }
};

}  // namespace

template <class Row>
InteriorPointResult solveProgram(const BandedProgram<Row>& program, const InteriorPointLimits& limits,
                                 CancelCheck check) {
  const ProgramView<Row> view{program};
  return InteriorPoint(view, limits, check).solve();
}

template InteriorPointResult solveProgram(const BandedProgram<BandRow>&, const InteriorPointLimits&, CancelCheck);
template InteriorPointResult solveProgram(const BandedProgram<SparseRow>&, const InteriorPointLimits&, CancelCheck);

}  // namespace batten
