// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/bezier_spans.h"

namespace batten {

PlaceTable::Place bernsteinPlace(int degree, double at) {
  PlaceTable::Place place;
  place.at = at;
  double factor = 1.0;
  for (int order = 0; order <= 3 && order <= degree; ++order) {
    // The derivative of order m is degree!/(degree - m)! times the m-th difference of the polynomials m degrees lower.
    std::array<double, kSpanPoints> row = bernsteinPolynomials(degree - order, at);
    for (int times = 0; times < order; ++times) {
      for (int k = degree; k >= 0; --k) row[k] = (k > 0 ? row[k - 1] : 0.0) - row[k];
    }
    for (double& value : row) value *= factor;
    place.rows[order] = row;
    for (std::size_t k = 0; k < kSpanPoints; ++k) {
      place.pairs[order][2 * k] = place.pairs[order][2 * k + 1] = row[k];
      place.columns[k][2 * order] = place.columns[k][2 * order + 1] = row[k];
    }
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
