// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/fairing/structure/monotone_search.h"
#include "core/solve/banded_program.h"

namespace batten {

/// One quadratic program of the search: squares and bounds over the free coordinates of the control points.
class MonotoneSearch::Program {
 public:
  Program(const FairingSetup& setup, const std::vector<SpanPlace>& places, const std::vector<Jet>& jets,
          const RunContext& context);

  SparseRow localRow(int span, const LocalRow& local) const;
  /// Change of dkappa/ds at a place, and of its difference between two.
  const SparseRow& slope(int place) const { return slopes_[place]; }
  SparseRow difference(int from, int to) const;
  /// weight * (value + row . x)^2.
  void addSquare(const SparseRow& row, double value, double weight);
  /// factor * row . x >= bound.
  void addBound(const SparseRow& row, double factor, double bound);
  /// Absent when there is no solution or it could not be found.
  std::optional<Eigen::VectorXd> solve(bool mayBeInfeasible);

 private:
  struct Square {
    SparseRow row;
    double weight;
  };
  const FairingSetup& setup_;
  const RunContext& context_;
  std::vector<SparseRow> slopes_;
  std::vector<Square> squares_;
  BandedProgram<SparseRow> program_;  ///< `a` is made when all squares are known.
  double constant_ = 0.0;
};

}  // namespace batten
