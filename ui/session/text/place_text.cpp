// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/text/place_text.h"

#include <QCoreApplication>
#include <cmath>

#include "core/base/conventions.h"
#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"

namespace batten {

std::optional<double> curvatureAtLength(const NurbsCurve& curve, double sMm) {
  if (curve.isEmpty()) return std::nullopt;
  return curvature(curve, ArcLength(curve).parameter(sMm));
}

QString radiusText(double kappa, const NurbsCurve& of) {
  if (std::abs(kappa) * extent(of) < kStraightCurvature) return QCoreApplication::translate("PlaceText", "straight");
  const double radius = std::abs(1.0 / kappa);
  return QCoreApplication::translate("PlaceText", "R %1 mm")
      .arg(radius, 0, 'f',
           radius < 10.0    ? 2
           : radius < 100.0 ? 1
                            : 0);
}

}  // namespace batten
