// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/occt/cad_module_call.h"

#include <type_traits>
#include <variant>

namespace batten {
namespace {

PlainShape plainShape(const CadShape& shape) {
  const auto plain = [](const auto& one) -> PlainShape {
    if constexpr (std::is_same_v<decltype(one), const NurbsCurve&>) {
      const auto knots = one.knots(), weights = one.weights();
      const auto points = one.controlPoints();
      return PlainSpline{
          one.degree(), {knots.begin(), knots.end()}, {points.begin(), points.end()}, {weights.begin(), weights.end()}};
    } else {
      return one;
    }
  };
  return std::visit(plain, shape);
}

/// Absent: no valid curve.
std::optional<CadShape> cadShape(PlainShape shape) {
  const auto made = [](auto&& one) -> std::optional<CadShape> {
    if constexpr (std::is_same_v<decltype(one), PlainSpline&&>) {
      auto curve = NurbsCurve::make(one.degree, std::move(one.knots), std::move(one.points), std::move(one.weights));
      return curve ? std::optional<CadShape>(std::move(*curve)) : std::nullopt;
    } else {
      return std::forward<decltype(one)>(one);
    }
  };
  return std::visit(made, std::move(shape));
}

}  // namespace

Error cadModuleMissing() {
  return {ErrorCode::CannotWrite,
          "IGES and STEP need the program's file libbatten-cad, which is missing or cannot be loaded. Install Batten "
          "again, or export to DXF or 3DM.",
          {}};
}

PlainDrawing plainDrawing(const CadDrawing& drawing) {
  PlainDrawing plain{{}, drawing.mmPerUnit, drawing.left};
  for (const CadEntity& entity : drawing.entities)
    plain.entities.push_back({entity.name, entity.layer, plainShape(entity.shape)});
  return plain;
}

CadDrawing drawingOf(PlainDrawing plain) {
  CadDrawing drawing{{}, plain.mmPerUnit, plain.left};
  for (PlainEntity& entity : plain.entities) {
    if (auto shape = cadShape(std::move(entity.shape)))
      drawing.entities.push_back({std::move(entity.name), std::move(entity.layer), std::move(*shape)});
    else
      ++drawing.left;
  }
  return drawing;
}

}  // namespace batten
