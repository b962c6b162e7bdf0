// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/vec2.h"

namespace batten {

enum class EdgeMode {
  Automatic,   ///< Region by region: strokes give centre lines, filled shapes give outlines.
  Outline,     ///< The borders between ink and paper (000).
  Centreline,  ///< The middle of every stroke.
};

/// [px] How far from what it holds for a choice of the user may lie.
inline constexpr double kInkReachPx = 24.0;

/// How the user wants one piece of ink traced, whatever the setting for the page. It is tied to a position so that it
/// survives changes of the mask: it applies to the nearest piece of ink within its reach. If several choices apply to
/// one piece, the last one counts.
struct EdgeChoice {
  Vec2 positionPx = Vec2::Zero();  ///< [px] A place on the ink or near it.
  EdgeMode mode = EdgeMode::Outline;
  double reachPx = kInkReachPx;  ///< More where the page is enlarged; no part of a recipe.
  bool operator==(const EdgeChoice& o) const { return positionPx == o.positionPx && mode == o.mode; }
};
/// Its position must be finite.
std::optional<Error> validate(const EdgeChoice&);

/// Ink that the user has painted as strokes or as a shape, whatever it is told to be: all of it within a distance of a
/// course. It is tied to places so that it survives changes of the mask. Where several overlap the last one counts.
struct PaintedInk {
  std::vector<Vec2> coursePx;         ///< At least one place.
  double radiusPx = 12.0;             ///< [px] 0.5..1000
  EdgeMode mode = EdgeMode::Outline;  ///< Automatic: as the page again.
  bool operator==(const PaintedInk& o) const {
    return coursePx == o.coursePx && radiusPx == o.radiusPx && mode == o.mode;
  }
};
/// 1 to 100 000 places, all finite, and a radius within its range.
std::optional<Error> validate(const PaintedInk&);
/// [px] Its radius on a page of another scale, as far as it is allowed.
double scaledRadius(const PaintedInk&, double scale);

/// Two branches of a junction that are one stroke, each by a place on it. [px]
struct BranchPair {
  Vec2 firstPx = Vec2::Zero(), secondPx = Vec2::Zero();
  bool operator==(const BranchPair& o) const { return firstPx == o.firstPx && secondPx == o.secondPx; }
};

/// How the user wants the strokes of one junction led through it. It is tied to places so that it survives changes of
/// the mask: it applies to the nearest junction within its reach, and a place to the branch nearest to it within the
/// same reach. If several choices apply to one junction, the last one counts.
struct JunctionChoice {
  Vec2 positionPx = Vec2::Zero();   ///< [px] A place at the junction.
  std::vector<BranchPair> pairs{};  ///< All that are led through; every other stroke ends there.
  double reachPx = kInkReachPx;     ///< More where the page is enlarged; no part of a recipe.
  bool operator==(const JunctionChoice& o) const { return positionPx == o.positionPx && pairs == o.pairs; }
};
/// All its places must be finite.
std::optional<Error> validate(const JunctionChoice&);

}  // namespace batten
