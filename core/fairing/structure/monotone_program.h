// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/fairing/structure/monotone_search.h"
#include "core/solve/banded_program.h"

namespace batten {

/// One quadratic program of the search: squares and bounds over the free coordinates of the control points.
class MonotoneSearch::Program {
 public:
  Program(const FairingSetup& setup, const std::vector<SpanPlace>& places, const std::vector<Sample>& samples,
          const RunContext& context);

  /// A row over the unknowns of one or two spans. Refers to the program: holds until the next call of the function that
  /// made it.
  struct Row {
    std::span<const int> index;  ///< Ascending.
    std::span<const double> value;
  };
  Row localRow(int span, const LocalRow& local);
  /// Change of dkappa/ds at a place, and of its difference between two.
  Row slope(int place) const;
  Row difference(int from, int to);
  /// weight * (value + row . x)^2.
  void addSquare(const Row& row, double value, double weight);
  /// factor * row . x >= bound.
  void addBound(const Row& row, double factor, double bound);
  struct Solution {
    Eigen::VectorXd step;
    bool isStuck = false;  ///< The solver made no progress: the step is that without bounds.
  };
  /// Absent when there is no solution or it could not be found.
  std::optional<Solution> solve(bool mayBeInfeasible);

 private:
  const FairingSetup& setup_;
  const RunContext& context_;
  std::vector<int> spans_;        ///< Of the places.
  std::vector<double> slopes_;    ///< Per place, as many numbers as a span has unknowns at most.
  std::vector<double> local_;     ///< The last localRow.
  std::vector<int> eitherIndex_;  ///< The last difference across a knot.
  std::vector<double> difference_;
  RowGroups squares_;
  std::vector<double> weights_;  ///< Of the squares.
  GroupedProgram program_;       ///< `a` is made when all squares are known.
  double constant_ = 0.0;
};

}  // namespace batten
