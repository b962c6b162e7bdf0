// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/paper_background.h"

#include <cstddef>

#include "core/base/interpolation.h"

namespace batten {

double PaperBackground::at(double xPx, double yPx) const {
  if (isEmpty()) return 255.0;
  const BilinearPlace place(columns, rows, xPx / cellPx - 0.5, yPx / cellPx - 0.5);
  const auto cell = [&](int i, int j) { return static_cast<double>(grey[std::ptrdiff_t{j} * columns + i]); };
  double level = place.of(cell, FastBetween());
  for (const PaperFold& fold : folds) level += fold.at(xPx, yPx);
  return level;
}

}  // namespace batten
