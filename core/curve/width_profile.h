// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace batten {

/// A stroke's width at a place of the curve in its middle. In the unit of the curve.
struct WidthSample {
  double s = 0.0;      ///< Arc length from the start of the curve.
  double width = 0.0;  ///< >= 0; 0 at the tip of a stroke that thins to nothing.
  bool operator==(const WidthSample&) const = default;
};

/// Width along a curve: straight from sample to sample, as few of them as the noise of the widths allows.
struct WidthProfile {
  /// Ascending in s, the first at the start of the curve, the last at its end. At least two.
  std::vector<WidthSample> samples;
  double tolerance = 0.0;  ///< Rms distance of the measured widths, averaged over a few pixels, from the profile.

  bool operator==(const WidthProfile&) const = default;
  double length() const { return samples.back().s; }
  double at(double s) const;  ///< Held beyond either end.
};

/// The least, the largest, and the mean over arc length.
struct WidthFigures {
  double least = 0.0, mean = 0.0, largest = 0.0;
};
WidthFigures figuresOf(const WidthProfile&);

/// Of the same curve run the other way.
WidthProfile reversed(const WidthProfile&);
/// Of the same closed curve, begun at arc length s instead.
WidthProfile startedAt(const WidthProfile&, double s);
/// Of the curve at another size, its stroke as well.
WidthProfile scaled(const WidthProfile&, double scale);
/// Whether it is one: numbers that are finite, widths not negative, places ascending from 0.
bool isValid(const WidthProfile&);

}  // namespace batten
