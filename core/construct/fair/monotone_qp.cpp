// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/monotone_qp.h"

#include "core/solve/interior_point.h"

namespace batten {
namespace {

/// A MonotoneQp as the interior point method sees it.
struct BandProgram {
  using Factor = BandCholesky;
  const MonotoneQp& qp;

  Eigen::Index size() const { return qp.b.size(); }
  Eigen::Index rowCount() const { return static_cast<Eigen::Index>(qp.rows.size()); }
  const Eigen::VectorXd& linear() const { return qp.b; }
  Eigen::VectorXd multiply(const Eigen::VectorXd& v) const { return qp.a * v; }
  double bound(Eigen::Index i) const { return qp.bounds[i]; }
  double dotRow(Eigen::Index i, const Eigen::VectorXd& v) const { return dot(qp.rows[i], v); }
  void addRow(Eigen::Index i, double factor, Eigen::VectorXd& out) const { addTo(out, qp.rows[i], factor); }
  /// With a tiny ridge relative to the diagonal when the plain factors fail.
  bool factorise(const Eigen::VectorXd& weights, Factor& factor) const {
    BandMatrix m = qp.a;
    for (Eigen::Index i = 0; i < weights.size(); ++i) m.addOuter(qp.rows[i], weights[i]);
    if (factor.factor(m)) return true;
    for (int i = 0; i < m.size(); ++i) m.entry(i, 0) *= 1.0 + 1e-13;
    return factor.factor(m);
  }
};

}  // namespace

MonotoneQpResult solveMonotoneQp(const MonotoneQp& qp, double abortAbove) {
  const BandProgram program{qp};
  InteriorPointLimits limits;
  limits.abortAbove = abortAbove;
  return InteriorPoint(program, limits).solve();
}

}  // namespace batten
