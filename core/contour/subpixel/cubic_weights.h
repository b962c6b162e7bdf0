// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace batten {

/// Weights of four values at equal steps for a place between the middle two, `f` 0..1 of a step behind the second:
/// cubic convolution (Catmull-Rom; Keys 1981), which reproduces parabolas.
struct CubicWeights {
  double before, here, next, after;
};
inline CubicWeights cubicWeights(double f) {
  return {f * (-0.5 + f * (1.0 - 0.5 * f)), 1.0 + f * f * (-2.5 + 1.5 * f), f * (0.5 + f * (2.0 - 1.5 * f)),
          f * f * (-0.5 + 0.5 * f)};
}

}  // namespace batten
