// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/run_context.h"
#include "core/image/grey_image.h"

namespace batten {

/// The darkest pixel of every cell of a page.
class DarkestCells {
 public:
  static constexpr int kAcross = 8, kDown = 4;  ///< [px] of a cell; those at the right and below may be cut off.

  DarkestCells(const GreyImage&, const RunContext&);
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  const std::uint16_t* row(int y) const { return lowest_.data() + std::ptrdiff_t{y} * columns_; }

 private:
  int columns_, rows_;
  std::vector<std::uint16_t> lowest_;
};

/// out[i] = the lesser of it and in[i].
void takeLesser(const std::uint16_t* in, std::uint16_t* out, int count);

}  // namespace batten
