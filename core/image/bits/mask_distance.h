// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image/bits/bit_image.h"

namespace batten {

/// How far the pixels of a mask lie from the nearest pixel outside it, exactly; beyond the page is outside. Computed by
/// bands of rows where it is asked for: a plane of the page's size, at 4 bytes a pixel, is never held. Ask by rows.
/// (Meijster, Roerdink and Hesselink, "A general algorithm for computing distance transforms in linear time", 2000)
class MaskDistance {
 public:
  /// Keeps a reference to the mask.
  explicit MaskDistance(const BitImage& mask);
  /// [px²] Between centres of pixels; 0 outside the mask and beyond the page.
  std::int32_t squared(int x, int y);

 private:
  static constexpr int kBandRows = 64;
  static constexpr std::size_t kBandsKept = 8;  // for who goes up and down from a place, as far as 250 rows

  using Row = std::vector<std::int32_t>;
  struct Band {
    int number = 0;
    std::vector<std::int32_t> squared;  // row by row
  };
  const Band& band(int number);
  void computeBand(int number, Band& to) const;
  std::vector<Row> columnDistances(int number) const;
  void squareAlongRow(int y, const Row& column, std::int32_t* to) const;
  static void squareAlongRun(std::int64_t length, const std::int32_t* column, std::int32_t* to);
  void count(int y, Row& distance) const;

  const BitImage& mask_;
  // By band: how many pixels of the mask follow each other in a column up to the row before the band and from the row
  // after it on.
  std::vector<Row> above_, below_;
  std::vector<Band> bands_;
  std::size_t last_ = 0, oldest_ = 0;
};

}  // namespace batten
