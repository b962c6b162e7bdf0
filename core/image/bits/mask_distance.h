// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image/bits/bit_image.h"

namespace batten {

/// How far the pixels of a mask lie from the nearest pixel outside it, exactly; beyond the page is outside. Computed by
/// strips of rows where it is asked for: a plane of the page's size, at 4 bytes a pixel, is never held. Ask by rows.
/// (Meijster, Roerdink and Hesselink, "A general algorithm for computing distance transforms in linear time", 2000)
class MaskDistance {
 public:
  /// Keeps a reference to the mask.
  explicit MaskDistance(const BitImage& mask);
  /// [px²] Between centres of pixels; 0 outside the mask and beyond the page.
  std::int32_t squared(int x, int y);

 private:
  static constexpr int kStripRows = 64;          // computed at once
  static constexpr std::size_t kStripsKept = 8;  // for who goes up and down from a place, as far as 250 rows

  using Row = std::vector<std::int32_t>;
  struct RowStrip {
    int number = 0;
    std::vector<std::int32_t> squared;  // row by row
  };
  const RowStrip& strip(int number);
  void computeStrip(int number, RowStrip& to) const;
  std::vector<Row> columnDistances(int number) const;
  void squareAlongRow(int y, const Row& column, std::int32_t* to) const;
  static void squareAlongRun(std::int64_t length, const std::int32_t* column, std::int32_t* to);
  void count(int y, Row& distance) const;

  const BitImage& mask_;
  // By strip: how many pixels of the mask follow each other in a column up to the row before the strip and from the row
  // after it on.
  std::vector<Row> above_, below_;
  std::vector<RowStrip> strips_;
  std::size_t last_ = 0, oldest_ = 0;
};

}  // namespace batten
