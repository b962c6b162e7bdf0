// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <iterator>
#include <vector>

#include "core/curve/span_curve.h"
#include "core/fairing/model/curvature_rows.h"
#include "core/fairing/model/unknowns.h"
#include "core/solve/banded_matrix.h"

namespace batten {

/// What the unknowns of its span change at each sample: a curvature, and where it lies across and along the curve.
class SampleRows {
 public:
  /// The rows of a sample, one after the other, each as long as the span with the most unknowns needs it; behind fewer
  /// of them are zeros.
  enum Row { Curvature, Across, Along };
  static constexpr int kRows = 3;

  /// Makes room for the samples' rows, all of which are to be set. @param unknowns must outlive it.
  void reset(const Unknowns& unknowns, const EqualArc& arc);
  void set(int sample, Row row, int span, const LocalRow& overPoints);
  /// The numbers of a row, to be set. @pre areOwn() of its span.
  double* own(int sample, Row row) { return &values_[offset(sample, row)]; }
  /// Whether a span has as many unknowns as any, and they are the coordinates of its control points.
  bool areOwn(int span) const { return unknowns_->isInOrder(span) && std::ssize(unknowns_->indices(span)) == stride_; }

  /// Rows times unknowns, one number a sample.
  struct Products {
    Eigen::VectorXd curvature, across, along;
  };
  Products times(const Eigen::VectorXd& v) const;
  Eigen::VectorXd acrossTimes(const Eigen::VectorXd& v) const;
  /// out += factors times rows: of each sample the one row after the other.
  void addTransposed(const Eigen::VectorXd& ofCurvature, const Eigen::VectorXd& ofAcross, Eigen::VectorXd& out) const;
  void addTransposed(const Eigen::VectorXd& ofAcross, Eigen::VectorXd& out) const;
  void addFirstAlong(double factor, Eigen::VectorXd& out) const;
  /// The same of the sum of all three rows.
  void addTransposedSums(const Products& factors, Eigen::VectorXd& out) const;

  /// Weights of the squares of a sample's rows.
  struct SquareWeights {
    double curvature = 0.0, across = 0.0;
  };
  /// stiffness += squares, by their weights, and unit * floor along; mass += unit * (across + slide * along).
  struct Squares {
    std::vector<SquareWeights> weights;  ///< Of each sample.
    double unit = 0.0, floor = 0.0, slide = 0.0;
  };
  void addSquares(const Squares& squares, CancelCheck check, BandedMatrix& stiffness, BandedMatrix& mass) const;

 private:
  /// Consecutive samples of one span.
  struct SampleRun {
    int begin, end, span;
  };
  const double* row(int sample, Row row) const { return &values_[offset(sample, row)]; }
  std::ptrdiff_t offset(int sample, Row row) const { return (std::ptrdiff_t{kRows} * sample + row) * stride_; }
  template <class Body>
  void withStride(const Body& body) const;
  template <class Body>
  void eachRun(const Body& body) const;

  const Unknowns* unknowns_ = nullptr;
  int stride_ = 0, count_ = 0;
  std::vector<double> values_;
  std::vector<SampleRun> runs_;
};

}  // namespace batten
