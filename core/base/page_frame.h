// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vec2.h"

namespace batten {

/// The one place where the image frame (px, y down) and the model frame (mm, y up) meet; see conventions.h.
struct PageFrame {
  int widthPx = 0;
  int heightPx = 0;
  double mmPerPx = 1.0;  ///< [mm] > 0.
  /// [mm] The lower left corner of the page in the model frame. Scans have it at the origin; a page made for curves of
  /// another program lies where these are.
  double leftMm = 0.0, bottomMm = 0.0;

  Vec2 pointToModel(const Vec2& px) const {
    return {leftMm + px.x() * mmPerPx, bottomMm + (heightPx - px.y()) * mmPerPx};
  }
  Vec2 pointToImage(const Vec2& mm) const {
    return {(mm.x() - leftMm) / mmPerPx, heightPx - (mm.y() - bottomMm) / mmPerPx};
  }
  /// Directions and displacements: the origin plays no part. Unit vectors are to be normalised by the caller.
  Vec2 vectorToModel(const Vec2& px) const { return {px.x() * mmPerPx, -px.y() * mmPerPx}; }
  Vec2 vectorToImage(const Vec2& mm) const { return {mm.x() / mmPerPx, -mm.y() / mmPerPx}; }
  /// [mm] of [px], and back.
  double lengthToModel(double px) const { return px * mmPerPx; }
  double lengthToImage(double mm) const { return mm / mmPerPx; }

  bool operator==(const PageFrame&) const = default;
};

}  // namespace batten
