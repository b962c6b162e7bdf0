// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace batten {

// Order statistics of ranges with random access. All reorder the range that they are given (hand them a copy or a
// temporary where the order matters) and return one of its elements, never a mean of two: linear cost, and no value
// that was not measured.

/// The element that has `rank` smaller ones before it when sorted. @pre 0 <= rank < number of values.
template <class Range>
auto elementOfRank(Range&& values, std::ptrdiff_t rank) {
  const auto at = std::begin(values) + rank;
  std::nth_element(std::begin(values), at, std::end(values));
  return *at;
}

/// Median; of an even number of values the upper one of the two in the middle. @pre not empty.
template <class Range>
auto upperMedian(Range&& values) {
  return elementOfRank(values, static_cast<std::ptrdiff_t>(std::size(values) / 2));
}

/// The value that a share 0..1 of the distances between neighbours lies below: rank floor(share (n - 1)). @pre not
/// empty.
template <class Range>
auto lowerQuantile(Range&& values, double share) {
  return elementOfRank(values, static_cast<std::ptrdiff_t>(share * static_cast<double>(std::size(values) - 1)));
}

/// Standard deviation over median absolute deviation, of a normal variable: 1 / quantile(3/4).
inline constexpr double kSigmaPerMad = 1.4826;

/// Robust standard deviation of values about zero: kSigmaPerMad times the upper median of their sizes, which the values
/// become; 0 for none.
template <class Range>
double robustSigma(Range&& values) {
  if (std::size(values) == 0) return 0.0;
  for (auto& value : values) value = std::abs(value);
  return kSigmaPerMad * static_cast<double>(upperMedian(values));
}

}  // namespace batten
