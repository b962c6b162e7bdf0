// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/bezier_spans.h"

namespace batten {
namespace {

/// Bernstein polynomials of a degree at a place.
std::array<double, kSpanPoints> bernstein(int degree, double at) {
  std::array<double, kSpanPoints> values{};
  values[0] = 1.0;
  for (int d = 1; d <= degree; ++d) {
    for (int k = d; k >= 0; --k) {
      const auto i = static_cast<std::size_t>(k);
      values[i] = (k < d ? (1.0 - at) * values[i] : 0.0) + (k > 0 ? at * values[i - 1] : 0.0);
    }
  }
  return values;
}

}  // namespace

PlaceTable::Place bernsteinPlace(int degree, double at) {
  PlaceTable::Place place;
  place.at = at;
  double factor = 1.0;
  for (int order = 0; order <= 3 && order <= degree; ++order) {
    // The derivative of order m is degree!/(degree - m)! times the m-th difference of the polynomials m degrees lower.
    std::array<double, kSpanPoints> row = bernstein(degree - order, at);
    for (int times = 0; times < order; ++times) {
      for (int k = degree; k >= 0; --k) {
        const auto i = static_cast<std::size_t>(k);
        row[i] = (k > 0 ? row[i - 1] : 0.0) - row[i];
      }
    }
    for (double& value : row) value *= factor;
    place.rows[order] = row;
    for (std::size_t k = 0; k < kSpanPoints; ++k) place.pairs[order][2 * k] = place.pairs[order][2 * k + 1] = row[k];
    factor *= degree - order;
  }
  return place;
}

PlaceTable placeTable(int degree, int count) {
  PlaceTable table;
  for (int i = 0; i < count; ++i) table.places.push_back(bernsteinPlace(degree, static_cast<double>(i) / (count - 1)));
  return table;
}

}  // namespace batten
