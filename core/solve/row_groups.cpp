// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/row_groups.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace batten {
namespace {

/// The unknowns of a knot span of a quintic curve, a number that the compiler knows; else Eigen::Dynamic.
constexpr int kQuinticSpan = 12;

template <class Body>
void withSize(std::size_t size, const Body& body) {
  if (size == kQuinticSpan) return body(std::integral_constant<int, kQuinticSpan>());
  body(std::integral_constant<int, Eigen::Dynamic>());
}

template <int kSize>
using GroupVector = Eigen::Matrix<double, kSize, 1>;
template <int kSize>
using GroupRow = Eigen::Map<const GroupVector<kSize>>;

/// The columns kColumn and kColumn + 1 of the sum of w[i] row i' row i, from the diagonal down.
template <int kSize, int kColumn>
void twoColumns(const double* values, const double* w, Eigen::Index rows, Eigen::Matrix<double, kSize, kSize>& sum) {
  constexpr int kRest = kSize - kColumn;
  using Rest = Eigen::Array<double, kRest, 1>;
  Rest left = Rest::Zero(), right = Rest::Zero();
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double* row = values + i * kSize + kColumn;
    const Eigen::Map<const Rest> rest(row);
    left += (w[i] * row[0]) * rest;
    right += (w[i] * row[1]) * rest;
  }
  sum.template block<kRest, 1>(kColumn, kColumn) = left.matrix();
  sum.template block<kRest - 1, 1>(kColumn + 1, kColumn + 1) = right.template tail<kRest - 1>().matrix();
}

template <int kSize, int... kPairs>
void outerOf(const double* values, const double* w, Eigen::Index rows, Eigen::Matrix<double, kSize, kSize>& sum,
             std::integer_sequence<int, kPairs...>) {
  (twoColumns<kSize, 2 * kPairs>(values, w, rows, sum), ...);
}

}  // namespace

void RowGroups::add(std::span<const int> index, std::span<const double> values, double factor) {
  const bool joins = !groups_.empty() && std::ranges::equal(indexOf(groups_.back()), index);
  if (!joins) {
    groups_.push_back({std::ssize(index_), std::ssize(values_), count_, 0, index.size()});
    index_.insert(index_.end(), index.begin(), index.end());
    if (!index.empty()) width_ = std::max(width_, index.back() - index.front());
  }
  ++groups_.back().rows;
  ++count_;
  for (const double v : values) values_.push_back(factor * v);
}

const RowGroups::Group& RowGroups::groupOf(Eigen::Index row) const {
  const auto after = std::upper_bound(groups_.begin(), groups_.end(), row,
                                      [](Eigen::Index at, const Group& group) { return at < group.firstRow; });
  return *(after - 1);
}

double RowGroups::dot(Eigen::Index row, const Eigen::VectorXd& x) const {
  const Group& group = groupOf(row);
  const double* values = values_.data() + group.firstValue + (row - group.firstRow) * std::ssize(indexOf(group));
  double sum = 0.0;
  for (const int i : indexOf(group)) sum += *values++ * x[i];
  return sum;
}

void RowGroups::addTo(Eigen::VectorXd& x, Eigen::Index row, double factor) const {
  const Group& group = groupOf(row);
  const double* values = values_.data() + group.firstValue + (row - group.firstRow) * std::ssize(indexOf(group));
  for (const int i : indexOf(group)) x[i] += factor * *values++;
}

Eigen::VectorXd RowGroups::times(const Eigen::VectorXd& x) const {
  Eigen::VectorXd result(count_), gathered;
  for (const Group& group : groups_) {
    withSize(group.size, [&](auto known) {
      constexpr int kSize = known();
      const auto index = indexOf(group);
      const auto size = std::ssize(index);
      GroupVector<kSize> near(size);
      for (std::ptrdiff_t k = 0; k < size; ++k) near[k] = x[index[k]];
      const double* values = values_.data() + group.firstValue;
      for (Eigen::Index i = 0; i < group.rows; ++i, values += size)
        result[group.firstRow + i] = GroupRow<kSize>(values, size).dot(near);
    });
  }
  return result;
}

void RowGroups::addTransposed(const Eigen::VectorXd& weight, Eigen::VectorXd& x) const {
  for (const Group& group : groups_) {
    withSize(group.size, [&](auto known) {
      constexpr int kSize = known();
      const auto index = indexOf(group);
      const auto size = std::ssize(index);
      GroupVector<kSize> sum = GroupVector<kSize>::Zero(size);
      const double* values = values_.data() + group.firstValue;
      for (Eigen::Index i = 0; i < group.rows; ++i, values += size)
        sum += weight[group.firstRow + i] * GroupRow<kSize>(values, size);
      for (std::ptrdiff_t k = 0; k < size; ++k) x[index[k]] += sum[k];
    });
  }
}

void RowGroups::addOuter(const Eigen::VectorXd& weight, BandedMatrix& m) const {
  Eigen::Matrix<double, kQuinticSpan, kQuinticSpan> sum;
  for (const Group& group : groups_) {
    const auto index = indexOf(group);
    const auto size = std::ssize(index);
    const double* values = values_.data() + group.firstValue;
    if (size == kQuinticSpan) {
      outerOf(values, weight.data() + group.firstRow, group.rows, sum,
              std::make_integer_sequence<int, kQuinticSpan / 2>());
      for (int b = 0; b < kQuinticSpan; ++b) {
        double* column = &m.entry(index[b], 0);
        for (int a = b; a < kQuinticSpan; ++a) column[index[a] - index[b]] += sum(a, b);
      }
      continue;
    }
    for (Eigen::Index i = 0; i < group.rows; ++i, values += size) {
      for (std::ptrdiff_t b = 0; b < size; ++b) {
        const double value = weight[group.firstRow + i] * values[b];
        double* column = &m.entry(index[b], 0);
        for (std::ptrdiff_t a = b; a < size; ++a) column[index[a] - index[b]] += value * values[a];
      }
    }
  }
}

}  // namespace batten
