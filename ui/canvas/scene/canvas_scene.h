// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFont>
#include <QPalette>
#include <QPointF>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/contour/corner/corner_marks.h"
#include "ui/canvas/scene/compare_overlay.h"
#include "ui/canvas/scene/curve_shapes.h"
#include "ui/canvas/scene/tile_pyramid.h"
#include "ui/canvas/scene/view_transform.h"
#include "ui/session/curves/extremum_marks.h"
#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"

namespace batten {

/// How near to a line or a mark the mouse has to be [widget px].
inline constexpr double kReachPx = 12.0;
/// The same for a small mark on a line that can be clicked itself.
inline constexpr double kMarkReachPx = 8.0;

/// What layers paint from and tools act on. Plain data of the GUI thread; what was computed behind it is shared and
/// constant.
struct CanvasScene {
  CanvasScene(EditorSession& s, ViewSettings& v) : session(s), view(v) {}
  EditorSession& session;
  ViewSettings& view;
  ViewTransform transform;
  std::shared_ptr<const TilePyramid> pyramid;
  std::shared_ptr<const CurveShapes> shapes;
  std::shared_ptr<const CurveCombs> combs;
  std::shared_ptr<const CompareOverlay> overlay;
  std::vector<ExtremumMark> extrema;  ///< Of the selected curve.
  QPalette palette;
  QFont font;
  std::optional<QPointF> mouse;  ///< [widget px] Over the view.
  bool isLate = false;           ///< Work has been going on long enough to say so.
  std::function<void()> repaint;
  std::function<void(const QString&)> hint;
  /// A short ring where a click had nothing to act on.
  std::function<void(const Vec2& px)> flash;

  double reachImagePx() const { return kReachPx * transform.imagePerWidget(); }
  const CurveComb* selectedComb() const;
  /// Marks of extrema lie on the sketched curve: without it they would hang in the air.
  bool areExtremaShown() const;
  /// Blue is what the drawing comes to: the results where they are shown, the found lines where they are not.
  bool isResultShown() const;
  /// The selected curve is visible, sketched or as its result.
  bool isSelectionShown() const;
  /// A chain that grows is watched alone, without combs and marks.
  bool areCombsShown() const;
  /// The shown curve nearest to a place within reach, or none.
  std::optional<int> curveNear(const Vec2& px) const;
  /// The mark of an extremum under the mouse, or null; none while they are not shown.
  const ExtremumMark* extremumNear(const Vec2& px) const;
};

}  // namespace batten
