// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/vec2.h"
#include "core/exchange/cad/step_records.h"
#include "core/exchange/model/cad_shape.h"

namespace batten {

using StepValues = std::span<const StepValue>;

/// Questions to the records, each with nothing for an answer where the file holds something else.
class StepData {
 public:
  explicit StepData(const StepRecords& records) : records_(records) {}

  StepValues valuesOf(const StepValue& list) const {
    return list.kind == StepValue::Kind::List ? StepValues(records_.lists).subspan(list.first, list.count)
                                              : StepValues();
  }
  /// The values of an instance's record of that type; nothing if it has none.
  std::optional<StepValues> record(std::uint64_t id, std::string_view type) const {
    const auto found = records_.instances.find(id);
    if (found == records_.instances.end()) return std::nullopt;
    for (std::uint32_t i = 0; i < found->second.count; ++i) {
      const StepRecord& one = records_.records[found->second.first + i];
      if (one.type == type) return StepValues(records_.lists).subspan(one.first, one.count);
    }
    return std::nullopt;
  }
  std::optional<StepValues> record(const StepValue& reference, std::string_view type) const {
    const auto id = idOf(reference);
    return id ? record(*id, type) : std::nullopt;
  }
  /// Types of an instance, the only one of a plain entry first.
  std::string_view typeOf(std::uint64_t id) const {
    const auto found = records_.instances.find(id);
    return found == records_.instances.end() || found->second.count == 0 ? std::string_view()
                                                                         : records_.records[found->second.first].type;
  }
  static std::optional<std::uint64_t> idOf(const StepValue& value) {
    if (value.kind != StepValue::Kind::Reference) return std::nullopt;
    return static_cast<std::uint64_t>(value.number);
  }
  static std::optional<double> number(const StepValue& value) {
    return value.kind == StepValue::Kind::Number ? std::optional(value.number) : std::nullopt;
  }
  /// A number, by itself or as PARAMETER_VALUE(1.) and the like.
  std::optional<double> measure(const StepValue& value) const {
    if (value.kind == StepValue::Kind::List && !value.text.empty() && value.count == 1)
      return number(valuesOf(value)[0]);
    return number(value);
  }
  std::optional<std::array<double, 3>> triple(const StepValue& reference, std::string_view type) const {
    const auto values = record(reference, type);
    if (!values || values->size() < 2) return std::nullopt;
    const StepValues numbers = valuesOf((*values)[1]);
    if (numbers.size() < 2 || numbers.size() > 3) return std::nullopt;
    std::array<double, 3> result{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto one = number(numbers[i]);
      if (!one) return std::nullopt;
      result[i] = *one;
    }
    return result;
  }
  std::optional<Vec2> point(const StepValue& reference) const {
    const auto at = triple(reference, "CARTESIAN_POINT");
    return at ? std::optional(Vec2((*at)[0], (*at)[1])) : std::nullopt;
  }
  std::optional<std::vector<Vec2>> points(const StepValue& list) const {
    std::vector<Vec2> result;
    for (const StepValue& one : valuesOf(list)) {
      const auto at = point(one);
      if (!at) return std::nullopt;
      result.push_back(*at);
    }
    return result;
  }
  std::optional<std::vector<double>> numbers(const StepValue& list) const {
    std::vector<double> result;
    for (const StepValue& one : valuesOf(list)) {
      const auto value = number(one);
      if (!value) return std::nullopt;
      result.push_back(*value);
    }
    return result;
  }
  const StepRecords& records() const { return records_; }

 private:
  const StepRecords& records_;
};

/// How a unit circle lies in the plane: its centre and where its own axes come to lie.
struct StepPlacement {
  Vec2 origin = Vec2::Zero();
  Eigen::Matrix2d axes = Eigen::Matrix2d::Identity();
  /// Neither mirrored nor sheared: a circle stays a circle.
  bool isUpright() const;
};

/// The placement that an AXIS2_PLACEMENT_2D or _3D states; nothing if it is none or its axes have no length.
std::optional<StepPlacement> placementOf(const StepData&, const StepValue& reference);

/// A conic of half axes a and b over a sweep of angles [rad], counter-clockwise in its own axes: an arc where it is
/// one.
std::optional<CadShape> conicShape(const StepPlacement&, const Vec2& half, double from, double sweep);

}  // namespace batten
