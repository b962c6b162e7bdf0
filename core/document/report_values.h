// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/vec2.h"
#include "core/contour/contour_set.h"

namespace batten {

/// The report keeps the order in which its entries are added.
using ReportJson = nlohmann::ordered_json;

/// A number, or null where there is none: JSON knows no NaN.
inline ReportJson numberToJson(double value) { return std::isfinite(value) ? ReportJson(value) : ReportJson(nullptr); }

/// [x, y]
inline ReportJson pointToJson(const Vec2& p) { return {numberToJson(p.x()), numberToJson(p.y())}; }

/// As reports call it.
inline const char* kindName(ContourKind kind) {
  if (kind == ContourKind::Pen) return "pen";
  if (kind == ContourKind::Imported) return "imported";
  return kind == ContourKind::Centreline ? "centreline" : "outline";
}

}  // namespace batten
