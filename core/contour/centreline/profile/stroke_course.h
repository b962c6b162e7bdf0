// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/contour/centreline/stroke_path.h"
#include "core/contour/subpixel/point_noise.h"

namespace batten {

/// The grey values across a stroke at one of its points, as the profile of the last round had them.
struct StrokeTone {
  float contrast = 0.0f;               ///< [grey] paper minus the middle of the stroke.
  float paper = 255.0f, slope = 0.0f;  ///< [grey, grey/px] at `base` and along the left normal.
  float reach = 0.0f;                  ///< [px] no other ink nearer than this.
};

/// A sample of a stroke path.
struct CoursePoint {
  Vec2 chain = Vec2::Zero();    ///< [px] skeleton position, evened.
  Vec2 base = Vec2::Zero();     ///< [px] where the profile stands.
  Vec2 tangent = Vec2::Zero();  ///< Unit direction of travel at `base`.
  float radius = 0.0f;          ///< [px] of the ink in the mask.
  StrokePart part = StrokePart::Ink;
  float shift = 0.0f;          ///< [px] from `base` to the middle of the stroke, along the left normal.
  float measuredWidth = 1.0f;  ///< [px]
  bool measured = false;
  std::optional<StrokeTone> tone = {};               ///< Absent where no stroke was seen.
  std::optional<PointInformation> information = {};  ///< Absent where the pixels themselves did not place the point.
};

/// A stroke path resampled at equal steps of about 1 px.
struct StrokeCourse {
  std::vector<CoursePoint> points;
  bool closed = false;
  std::array<bool, 2> tip = {false, false};  ///< The start, the end is a free end of the ink.
  double widthPx = 1.0;                      ///< Median.
  int profileHalf = 0;                       ///< [samples]
  bool wasPlacedOnPixels = false;            ///< placeOnPixels() has run.
  std::vector<Vec2> faint = {};              ///< [px] places where only the grey values show that it goes on.
  int count() const { return static_cast<int>(points.size()); }
};
/// One value of every point, for the functions of core/polyline, and back.
template <class T>
std::vector<T> valuesOf(const StrokeCourse& course, T CoursePoint::*value) {
  std::vector<T> values;
  values.reserve(course.points.size());
  for (const CoursePoint& p : course.points) values.push_back(p.*value);
  return values;
}
template <class T>
void setValues(StrokeCourse& course, T CoursePoint::*value, const std::vector<T>& values) {
  for (int i = 0; i < course.count(); ++i) course.points[i].*value = values[i];
}

/// [stroke widths] So much before its end a skeleton may turn to a corner of the ink.
inline constexpr double kHookWidths = 0.5;
/// At least so many points give the direction of an end.
inline constexpr int kLeastBackPoints = 4;

/// Position, direction of travel and bend (second derivative, 1/px) at point `border` by a parabola through the points
/// from there on to side +1 or -1, at most `reach` px and, where asked, not into a junction.
struct CourseApproach {
  Vec2 at = Vec2::Zero(), direction = Vec2::Zero(), bend = Vec2::Zero();
};
/// Nothing where fewer than three points of the stroke are left there.
std::optional<CourseApproach> approachAt(const StrokeCourse& course, int border, int side, double reach,
                                         bool onlyOutside = true);

/// Even, smooth positions of a stroke path, ready to be measured.
StrokeCourse resample(const StrokePath& path);
/// Rejects implausible shifts (and those in junctions and corners) and interpolates them from their neighbours.
void rejectImplausibleShifts(StrokeCourse& course, bool checkWidth);
/// Moves the points to the middle found; `again`: and prepares the next round.
void moveCourse(StrokeCourse& course, bool again);
/// Keeps the first `keep` points and appends `tail`; what is not known of the new points is as at the last one kept.
/// @pre 0 < keep <= count().
void replaceTail(StrokeCourse& course, int keep, const std::vector<Vec2>& tail);

}  // namespace batten
