// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/base/vec2.h"

namespace batten::test {

/// A stroke whose middle and width are known.
struct WidthStroke {
  struct Place {
    Vec2 at = Vec2::Zero();  ///< [px]
    double s = 0.0;          ///< [px] along the middle.
    double width = 0.0;      ///< [px]
  };
  std::string name;
  bool closed = false;
  std::vector<Place> places;  ///< About 0.2 px apart.

  double length() const;
  /// The border of its ink: the middle, half the width to either side, round ends. A ring has two borders.
  std::vector<std::vector<Vec2>> borders() const;
  /// Of the ink between the borders; round ends count.
  double area() const;
  double widthAt(double s) const;
};

/// Strokes well apart on a page of kWidthPagePx: one that tapers from end to end, a calligraphic one that swells and
/// thins, one with a tip at either end, and a ring whose width varies.
inline constexpr int kWidthPagePx = 900;
std::vector<WidthStroke> widthStrokes();
/// Exact area of ink, pixel by pixel, 0..1.
std::vector<float> widthCoverage(const std::vector<WidthStroke>&);

}  // namespace batten::test
