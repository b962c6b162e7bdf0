// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/base/vec2.h"
#include "core/exchange/cad/iges_records.h"
#include "core/exchange/model/cad_shape.h"

namespace batten {

constexpr int kMostIgesPoints = 1 << 20;  ///< Control points or places of one entity.

/// The numbers of an entity behind its type.
class IgesNumbers {
 public:
  explicit IgesNumbers(const std::vector<std::string>& fields) {
    for (std::size_t i = 1; i < fields.size(); ++i) {
      const auto value = igesNumber(fields[i]);
      if (!value) break;  // properties and names may follow; what is asked for lies before
      values_.push_back(*value);
    }
  }
  bool has(std::size_t count) const { return values_.size() >= count; }
  double at(std::size_t i) const { return values_[i]; }
  Vec2 point(std::size_t i) const { return {values_[i], values_[i + 1]}; }
  /// A count in a sensible range, else nothing.
  std::optional<int> count(std::size_t i, int least, int most) const {
    if (!has(i + 1) || values_[i] != std::floor(values_[i]) || values_[i] < least || values_[i] > most)
      return std::nullopt;
    return static_cast<int>(values_[i]);
  }
  std::vector<double> range(std::size_t begin, std::size_t count) const {
    const auto first = values_.begin() + static_cast<std::ptrdiff_t>(begin);
    return {first, first + static_cast<std::ptrdiff_t>(count)};
  }

 private:
  std::vector<double> values_;
};

/// The shape of an entity of types 100, 104, 106, 110, 112 or 126; nothing for another one or where the numbers do not
/// make one.
std::optional<CadShape> igesShape(const IgesDirectoryEntry&, const IgesNumbers&);

/// How many numbers a curve has behind its type, before the pointers to what belongs to it; nothing if that is open.
std::optional<std::size_t> igesOwnNumbers(const IgesDirectoryEntry&, const IgesNumbers&);

}  // namespace batten
