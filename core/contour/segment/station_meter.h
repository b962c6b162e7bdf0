// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/segment/regression_segments.h"
#include "core/polyline/polyline_tools.h"

namespace batten {

/// A piece with its arc length; a closed one can be read beyond its ends. @pre it outlives this, and has points.
class MeasuredPiece {
 public:
  explicit MeasuredPiece(const PieceLine& piece);
  double length() const { return length_; }
  bool closed() const { return piece_.closed; }
  int count() const { return static_cast<int>(s_.size()); }
  const PieceLine& piece() const { return piece_; }
  /// Arc length of point `i`; of a closed piece any integer, growing by the length with every round.
  double s(int i) const;
  const Vec2& point(int i) const { return piece_.points[slot(i)].at; }
  double weight(int i) const;
  /// First index with s >= value.
  int lowerBound(double value) const;

 private:
  int slot(int i) const { return closed() ? wrapIndex(i, count()) : i; }

  const PieceLine& piece_;
  std::vector<double> s_;
  double length_ = 0.0;
};

/// A station, and the local parabola that it was read from.
struct FittedStation {
  Station station;
  LocalQuadratic fit;
  double s = 0.0;  ///< [px] Arc length from the start of the piece.
};

/// The station at arc length `s` among others `spacing` apart: from the local parabola over 1.5 spacings, one-sided at
/// an open end.
FittedStation makeStation(const MeasuredPiece& piece, double s, double spacing);

}  // namespace batten
