// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/cad/step_data.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace batten {
namespace {

Eigen::Vector3d vectorOf(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

bool StepPlacement::isUpright() const {
  constexpr double kSame = 1e-12;  // of directions: rounding
  return axes.determinant() > 0.0 && (axes.transpose() * axes).isIdentity(kSame);
}

std::optional<StepPlacement> placementOf(const StepData& data, const StepValue& reference) {
  const bool isFlat = data.record(reference, "AXIS2_PLACEMENT_2D").has_value();
  const auto values = data.record(reference, isFlat ? "AXIS2_PLACEMENT_2D" : "AXIS2_PLACEMENT_3D");
  if (!values || values->size() < (isFlat ? 3 : 4)) return std::nullopt;
  const auto origin = data.point((*values)[1]);
  if (!origin) return std::nullopt;
  Eigen::Vector3d z(0.0, 0.0, 1.0), x(1.0, 0.0, 0.0);
  const StepValue& along = (*values)[isFlat ? 2 : 3];
  if (!isFlat && (*values)[2].kind == StepValue::Kind::Reference) {
    const auto axis = data.triple((*values)[2], "DIRECTION");
    if (!axis || !(vectorOf(*axis).norm() > 0.0)) return std::nullopt;
    z = vectorOf(*axis).normalized();
  }
  if (along.kind == StepValue::Kind::Reference) {
    const auto axis = data.triple(along, "DIRECTION");
    if (!axis) return std::nullopt;
    x = vectorOf(*axis);
  }
  x -= x.dot(z) * z;  // the file's may lean
  if (!(x.norm() > 0.0)) return std::nullopt;
  x.normalize();
  const Eigen::Vector3d y = z.cross(x);
  StepPlacement placed;
  placed.origin = *origin;
  placed.axes << x.x(), y.x(), x.y(), y.y();
  return placed;
}

std::optional<CadShape> conicShape(const StepPlacement& placed, const Vec2& half, double from, double sweep) {
  if (!(half.x() > 0.0) || !(half.y() > 0.0)) return std::nullopt;
  if (half.x() == half.y() && placed.isUpright()) {
    const double rotation = std::atan2(placed.axes(1, 0), placed.axes(0, 0));
    return CadArc{placed.origin, half.x(), from + rotation, sweep};
  }
  const auto unit = curveOf(CadArc{Vec2::Zero(), 1.0, from, sweep});
  const Eigen::Matrix2d linear = placed.axes * half.asDiagonal();
  if (!unit || !(std::abs(linear.determinant()) > 0.0)) return std::nullopt;
  return unit->mapped(linear, placed.origin);
}

}  // namespace batten
