// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/corner/piece_line.h"
#include "core/image/grey_image.h"

namespace batten {

/// Measure of the rounding.
enum class RoundingSize {
  Distance,  ///< Along the line, from the corner to where the rounding begins.
  Radius,    ///< The smallest radius of curvature of the rounding.
};

/// How a rounding meets the sides of its corner.
enum class RoundingJoint {
  Tangent,         ///< G1: direction only, by two typical curves (002 figure 6).
  Curvature,       ///< G2.
  CurvatureSlope,  ///< G3: the change of curvature along the line, too.
};

/// A corner set by the user. Stored as a position, so that it survives a change of the threshold.
struct CornerMark {
  Vec2 positionPx = Vec2::Zero();
  double roundMm = 0.0;  ///< [mm] 0..500. Size of the rounding; 0 = sharp.
  RoundingSize roundBy = RoundingSize::Distance;
  RoundingJoint joint = RoundingJoint::Curvature;
  bool operator==(const CornerMark& other) const {
    return positionPx == other.positionPx && roundMm == other.roundMm && roundBy == other.roundBy &&
           joint == other.joint;
  }
};

struct CornerParams {
  bool automatic = true;  ///< Corners that are certain (corner_certainty.h) count without a mark.
  double snapDistancePx =
      16.0;  ///< [px] > 0. A mark farther than this from every line holds no corner (004 section 3.2: distance d).
  bool exact =
      true;  ///< Extend both neighbouring lines and put the corner where they meet; off: the contour point itself.
  bool operator==(const CornerParams&) const = default;
};
/// First invalid field, with its range, if any.
std::optional<Error> validate(const CornerParams&);

/// A corner of a line: of a mark that found its line, or one that is certain without a mark.
struct Corner {
  std::optional<int> mark;         ///< Index into the marks given; absent: found without one.
  int contour = 0;                 ///< Index into the contour set.
  int pointIndex = 0;              ///< Nearest point of the contour.
  Vec2 positionPx = Vec2::Zero();  ///< [px] Where the corner is.
  double turningAngleRad = 0.0;    ///< [rad] -pi..pi, change of direction, positive to the left in the model frame.
  double snapPx = 0.0;             ///< [px] Distance from the mark.
  bool isLocated = false;          ///< Found between short sides: positionPx is where these meet.
};

/// A stretch of one contour from corner to corner (or end), or a whole closed contour without corner. Image frame, px.
struct Piece : PieceLine {
  int contour = 0;
  int index = 0;                      ///< Position within the contour.
  int firstPoint = 0, lastPoint = 0;  ///< Of the contour; of a closed one the last may run past the seam.
  bool isPen = false;                 ///< Of a pen stroke: `refined` tells the drawn points.
  double lengthPx = 0.0;              ///< [px] Along its points.
};

/// A pair of marks that concern the same corner or neighbouring corners, as indices.
struct MarkPair {
  int mark = 0, other = 0;  ///< `other` is the earlier one.
  double apartPx = 0.0;     ///< [px] How far apart their corners lie.
  bool operator==(const MarkPair&) const = default;
};

struct PieceSet {
  std::vector<Piece> pieces;           ///< Contour by contour, in order of travel.
  std::vector<Corner> corners;         ///< Marked and found ones, sorted by contour, then along it.
  std::vector<int> lostMarks;          ///< Indices of marks with no line within the snap distance; kept, shown in red.
  std::vector<MarkPair> sameCorner;    ///< Marks that found the corner of an earlier one, and which: they count once.
  std::vector<MarkPair> closeCorners;  ///< Neighbours so close that the piece between them is a sliver (under 12 px).
};

/// Number of corners without a mark.
int unmarkedCornerCount(const PieceSet&);

/// Cuts the contours at the marks ([004] section 3.2). Marks that snap to the same point count once.
/// @param grey the page that the contours were refined on, if any; its pixels help to place the corners.
/// @param found corners without a mark; those within a sliver (12 px) of a marked one give way to it.
Result<PieceSet> splitAtCorners(const ContourSet&, std::span<const CornerMark>, const CornerParams&, const RunContext&,
                                const GreyImage* grey = nullptr, std::span<const Corner> found = {});

/// Where a click would put a corner: the sharpest turn, else the nearest contour point, within the snap distance;
/// without the exact intersection.
std::optional<Corner> nearestContourPoint(const ContourSet&, const Vec2& positionPx, double snapDistancePx);

}  // namespace batten
