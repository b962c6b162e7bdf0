// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/scene/compare_overlay.h"

#include "core/construct/polygon/control_polygon.h"
#include "ui/canvas/scene/curve_shapes.h"
#include "ui/session/view/judged_view.h"

namespace batten {

OverlaySource overlaySource(const EditorSession& session, const ViewSettings& view, double zoomBracket) {
  const PipelineOutput& output = session.output();
  OverlaySource source;
  source.pinned = session.pinned();
  source.frame = output.frame;
  source.zoom = zoomBracket;
  source.judged = judgedIn(view);
  const ConstructParams& params = session.recipe().construct;
  if (!view.showsUniformKnots() || params.method != ConstructMethod::ControlPolygon) return source;
  source.contours = output.contours;
  source.pieces = output.pieces;
  source.segments = output.segments;
  source.params = params;
  return source;
}

std::shared_ptr<const CompareOverlay> buildOverlay(const OverlaySource& source, const RunContext& context) {
  auto overlay = std::make_shared<CompareOverlay>();
  const double tolerance = 0.15 / source.zoom;
  if (source.pinned) {
    for (const TracedCurve& curve : source.pinned->faired->curves) {
      if (context.isCancelled()) return nullptr;
      if (curve.included)
        overlay->pinned.addPath(sampledPath(judgedCurve(curve, source.judged), source.pinned->frame, tolerance));
    }
  }
  if (!source.contours || !source.pieces || !source.segments) return overlay;
  PipelineOutput output;
  output.contours = source.contours;
  output.pieces = source.pieces;
  output.segments = source.segments;
  output.frame = source.frame;
  for (std::size_t i = 0; i < source.contours->contours.size(); ++i) {
    if (context.isCancelled()) return nullptr;
    const LinePolygon line = linePolygon(lineInput(output, static_cast<int>(i)), source.params);
    if (const auto made = polygonCurve(line, source.params.degree, SharpKnots::Uniform)) {
      overlay->uniform.addPath(sampledPath(made->curve, source.frame, tolerance));
    }
  }
  return overlay;
}

}  // namespace batten
