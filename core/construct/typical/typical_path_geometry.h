// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "core/construct/typical/typical_path.h"
#include "core/curve/bezier_powers.h"

namespace batten {

/// [rad] -pi..pi from one direction to another.
inline double angleBetween(const Vec2& a, const Vec2& b) { return std::atan2(cross(a, b), a.dot(b)); }

/// One element of a path made ready for many evaluations.
class PathGeometry {
 public:
  PathGeometry(const TypicalPath& path, std::size_t e) : typical_(path.elements[e].typical) {
    if (typical_) {
      const TypicalCurve curve = path.typical(e);
      start_ = {curve.start.x(), curve.start.y()};
      edge_ = std::polar(curve.edge, curve.angleRad);
      ratio_ = std::polar(curve.ratio, curve.turnRad);
      return;
    }
    powers_ = powersOfBezier(path.quintic(e));
  }

  /// Point and derivatives up to `order` <= 2 by t; t may leave 0..1.
  std::array<Vec2, 3> at(double t, int order) const {
    std::array<Vec2, 3> d{Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
    if (typical_) {
      const std::complex<double> w = 1.0 + t * (ratio_ - 1.0);
      const auto p = start_ + edge_ * t * (w * w + w + 1.0), d1 = 3.0 * edge_ * w * w;
      d[0] = {p.real(), p.imag()};
      d[1] = {d1.real(), d1.imag()};
      if (order > 1) {
        const auto d2 = 6.0 * edge_ * w * (ratio_ - 1.0);
        d[2] = {d2.real(), d2.imag()};
      }
      return d;
    }
    for (std::size_t k = 6; k-- > 0;) {
      d[2] = t * d[2] + d[1];
      d[1] = t * d[1] + d[0];
      d[0] = t * d[0] + powers_[k];
    }
    d[2] *= 2.0;
    return d;
  }

  bool isTypical() const { return typical_; }
  std::complex<double> start() const { return start_; }
  std::complex<double> edge() const { return edge_; }    ///< l e^(i angle)
  std::complex<double> ratio() const { return ratio_; }  ///< h e^(i phi)

 private:
  bool typical_;
  std::complex<double> start_, edge_, ratio_;
  std::array<Vec2, 6> powers_;
};

/// All elements of a path, made ready.
std::vector<PathGeometry> geometryOf(const TypicalPath& path);

}  // namespace batten
