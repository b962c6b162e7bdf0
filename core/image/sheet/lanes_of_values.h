// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace batten {

/// As many values of 16 bits of each of several things: those of one make a lane, so that all lanes are sorted at once.
class LanesOfValues {
 public:
  static constexpr int kMiddle = 32768;  // values are stored signed, around the middle of their 16 bits

  explicit LanesOfValues(int lanes) : lanes_(lanes) {}
  void clear() { values_.clear(); }
  /// Room for one more value of every lane; each is to be stored less kMiddle.
  std::int16_t* add();
  int count() const { return static_cast<int>(values_.size()) / lanes_; }  ///< Of a lane.
  int value(int k, int lane) const { return values_[std::ptrdiff_t{k} * lanes_ + lane] + kMiddle; }
  /// The least value of every lane, less kMiddle.
  std::vector<std::int16_t> leastOf() const;
  /// From here on value `rank` of every lane is the one that has so many smaller ones before it when sorted.
  void sortTo(int rank);

 private:
  int lanes_;
  std::vector<std::int16_t> values_;  ///< The first of all lanes, then the second.
};

}  // namespace batten
