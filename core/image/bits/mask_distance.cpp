// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/mask_distance.h"

#include <algorithm>
#include <utility>

namespace batten {

MaskDistance::MaskDistance(const BitImage& mask) : mask_(mask) {
  const int strips = (mask.height + kStripRows - 1) / kStripRows;
  above_.resize(strips);
  below_.resize(strips);
  Row distance(mask.width, 0);
  for (int y = 0; y < mask.height; ++y) {
    if (y % kStripRows == 0) above_[y / kStripRows] = distance;
    count(y, distance);
  }
  std::fill(distance.begin(), distance.end(), 0);
  for (int y = mask.height - 1; y >= 0; --y) {
    if (y % kStripRows == kStripRows - 1 || y == mask.height - 1) below_[y / kStripRows] = distance;
    count(y, distance);
  }
}

void MaskDistance::count(int y, Row& distance) const {
  for (int i = 0; i < mask_.wordsPerRow; ++i) {
    const std::uint64_t word = mask_.row(y)[i];
    const int x0 = i * 64, x1 = std::min(mask_.width, x0 + 64);
    if (word == 0) {
      std::fill(distance.begin() + x0, distance.begin() + x1, 0);
      continue;
    }
    for (int x = x0; x < x1; ++x) distance[x] = ((word >> (x - x0)) & 1u) != 0 ? distance[x] + 1 : 0;
  }
}

std::int32_t MaskDistance::squared(int x, int y) {
  if (!mask_.at(x, y)) return 0;
  return strip(y / kStripRows).squared[std::ptrdiff_t{y % kStripRows} * mask_.width + x];
}

const MaskDistance::RowStrip& MaskDistance::strip(int number) {
  if (last_ < strips_.size() && strips_[last_].number == number) return strips_[last_];
  const auto known =
      std::find_if(strips_.begin(), strips_.end(), [&](const RowStrip& b) { return b.number == number; });
  if (known != strips_.end()) {
    last_ = known - strips_.begin();
    return *known;
  }
  if (strips_.size() < kStripsKept) {
    strips_.emplace_back();
    last_ = strips_.size() - 1;
  } else {
    last_ = std::exchange(oldest_, (oldest_ + 1) % kStripsKept);
  }
  computeStrip(number, strips_[last_]);
  return strips_[last_];
}

std::vector<MaskDistance::Row> MaskDistance::columnDistances(int number) const {
  const int first = number * kStripRows, rows = std::min(kStripRows, mask_.height - first);
  std::vector<Row> column(rows);
  Row distance = above_[number];
  for (int k = 0; k < rows; ++k) {
    count(first + k, distance);
    column[k] = distance;
  }
  distance = below_[number];
  for (int k = rows - 1; k >= 0; --k) {
    count(first + k, distance);
    for (int x = 0; x < mask_.width; ++x) column[k][x] = std::min(column[k][x], distance[x]);
  }
  return column;
}

void MaskDistance::computeStrip(int number, RowStrip& to) const {
  const std::vector<Row> column = columnDistances(number);
  to.number = number;
  to.squared.assign(std::ssize(column) * mask_.width, 0);
  for (int k = 0; k < std::ssize(column); ++k)
    squareAlongRow(number * kStripRows + k, column[k], to.squared.data() + std::ptrdiff_t{k} * mask_.width);
}

// Run by run: whatever lies beyond the pixels at both ends of a run, which are outside, lies farther away than they.
void MaskDistance::squareAlongRow(int y, const Row& column, std::int32_t* to) const {
  for (int x0 = 0; x0 < mask_.width; ++x0) {
    if (!mask_.at(x0, y)) continue;
    int x1 = x0;
    while (x1 < mask_.width && mask_.at(x1, y)) ++x1;
    squareAlongRun(x1 - x0, column.data() + x0, to + x0);
    x0 = x1;
  }
}

// Places count from the pixel before the run. @param to the pixels of the run, as many as `column`.
void MaskDistance::squareAlongRun(std::int64_t length, const std::int32_t* column, std::int32_t* to) {
  struct Part {
    std::int64_t from, begin;  // the parabola of column `from` is the lowest from `begin` on
  };
  const auto squareAt = [&](std::int64_t x, std::int64_t from) {
    const std::int64_t g = from == 0 || from > length ? 0 : column[from - 1];
    return (x - from) * (x - from) + g * g;
  };
  std::vector<Part> lowest = {{0, 0}};
  for (std::int64_t u = 1; u <= length + 1; ++u) {
    while (!lowest.empty() && squareAt(lowest.back().begin, lowest.back().from) > squareAt(lowest.back().begin, u))
      lowest.pop_back();
    if (lowest.empty()) {
      lowest.push_back({u, 0});
      continue;
    }
    const std::int64_t from = lowest.back().from;
    // Where the two parabolas meet, rounded down: the difference of their heights at 0 over twice that of their
    // columns.
    const std::int64_t begin = 1 + (squareAt(0, u) - squareAt(0, from)) / (2 * (u - from));
    if (begin <= length) lowest.push_back({u, begin});
  }
  for (std::int64_t x = length; x >= 1; --x) {
    while (lowest.back().begin > x) lowest.pop_back();
    to[x - 1] = static_cast<std::int32_t>(squareAt(x, lowest.back().from));
  }
}

}  // namespace batten
