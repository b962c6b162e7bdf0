// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainterPath>
#include <memory>

#include "core/base/run_context.h"
#include "ui/session/editor_session.h"
#include "ui/session/view/judged_curve.h"
#include "ui/session/view/view_settings.h"

namespace batten {

/// What lies under the present curves to compare them with, as lines in image px.
struct CompareOverlay {
  QPainterPath pinned;   ///< All included curves of the pinned result.
  QPainterPath uniform;  ///< Every control polygon with equal knots, without corners (004 Fig. 3).
};

/// What the overlay is made from; equal sources give equal overlays.
struct OverlaySource {
  std::shared_ptr<const PinnedResult> pinned;
  std::shared_ptr<const ContourSet> contours;  ///< Null, as the next two, when the uniform curves are not wanted.
  std::shared_ptr<const PieceSet> pieces;
  std::shared_ptr<const SegmentSet> segments;
  PageFrame frame;
  ConstructParams params;
  Judged judged = Judged::Result;  ///< What of the pinned result is set beside the present one.
  double zoom = 0.0;               ///< Fine enough for zooms up to this.
  bool operator==(const OverlaySource&) const = default;
};

OverlaySource overlaySource(const EditorSession&, const ViewSettings&, double zoomBracket);
/// Null when cancelled.
std::shared_ptr<const CompareOverlay> buildOverlay(const OverlaySource&, const RunContext&);

}  // namespace batten
