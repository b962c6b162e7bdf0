// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/chip_layer.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <cmath>

#include "core/base/conventions.h"
#include "ui/canvas/layers/text_box.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/edits/piece_choice.h"
#include "ui/session/text/page_text.h"
#include "ui/session/text/place_text.h"
#include "ui/session/view/judged_view.h"

namespace batten {
namespace {

QString chipText(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

/// How the selected curve came about: its own method if it has one, or what took its place. Nothing is known of a curve
/// that an earlier choice left.
QString methodText(const CanvasScene& scene, const TracedCurve& curve) {
  if (scene.session.isStale(StageId::Curves)) return {};
  const PieceChoice* choice = choiceOf(scene.session, scene.session.selectedCurve());
  const bool own = choice != nullptr && choice->method.has_value();
  switch (own ? *choice->method : scene.session.recipe().construct.method) {
    case ConstructMethod::Fair:
      return chipText("true and fair fit");
    case ConstructMethod::Nurbs:
      return chipText("quintic NURBS");
    case ConstructMethod::Bezier:
      return chipText("quintic Bézier path");
    case ConstructMethod::Typical:
      return curve.construct.segments.empty() ? chipText("Bézier path (typical curves do not fit)")
                                              : chipText("typical curves");
    case ConstructMethod::ControlPolygon:
      return chipText("control polygon");
  }
  return {};
}

QString number(double value, int digits) { return QString::number(value, 'f', digits); }

}  // namespace

QString curveText(const CanvasScene& scene) {
  const TracedCurve* curve = scene.session.selected();
  if (curve == nullptr || curve->sketched.isEmpty()) return {};
  // Of the curve that is drawn.
  const Judged judged = judgedIn(scene.view);
  const NurbsCurve& shown = judgedCurve(*curve, judged);
  const CurveFigures& figures = judgedFigures(*curve, judged);
  QStringList parts{curveName(scene.session, *scene.session.selectedCurve())};
  if (const QString method = methodText(scene, *curve); !method.isEmpty()) parts << method;
  parts << chipText("%1 control points").arg(shown.controlPointCount())
        << chipText("%1 mm").arg(number(figures.lengthMm, 1));
  if (judged == Judged::Result && isLeftAsDrawn(*curve)) parts << chipText("unchanged by fairing");
  return parts.join(QStringLiteral(" · "));
}

QString pageText(const CanvasScene& scene) {
  const auto scan = scene.session.scan();
  if (!scan) return {};
  const Recipe& recipe = scene.session.recipe();
  if (isScaleAssumed(*scan, recipe)) return chipText("no scale: %1 dpi assumed").arg(number(kAssumedDpi, 0));
  const PageFrame frame = frameFor(*scan, recipe);
  const QString size = pageSizeText(frame), value = resolutionText(kMillimetresPerInch / frame.mmPerPx);
  if (scene.session.isBlankPage()) return chipText("empty page, %1 dpi · %2").arg(value, size);
  return (recipe.dpi ? chipText("%1 dpi set by hand · %2") : chipText("%1 dpi from file · %2")).arg(value, size);
}

QString cursorText(const CanvasScene& scene) {
  const auto s = scene.session.cursor();
  const CurveComb* comb = scene.selectedComb();
  if (!s || comb == nullptr) return {};
  const TracedCurve* curve = scene.session.selected();
  if (curve == nullptr) return {};
  const NurbsCurve& shown = judgedCurve(*curve, judgedIn(scene.view));
  QString text = chipText("s %1 mm").arg(number(std::clamp(*s, 0.0, comb->lengthMm), 1));
  if (const auto kappa = curvatureAtLength(shown, *s)) text += QStringLiteral(" · ") + radiusText(*kappa, shown);
  if (!comb->whiskers.empty()) {
    const auto nearest =
        std::min_element(comb->whiskers.begin(), comb->whiskers.end(),
                         [s](const Whisker& a, const Whisker& b) { return std::abs(a.s - *s) < std::abs(b.s - *s); });
    text += QStringLiteral(" · ") + chipText("moved %1 mm").arg(number(nearest->mm, nearest->mm < 0.01 ? 4 : 2));
  }
  return text;
}

QString workText(const CanvasScene& scene) {
  const bool isCoarse =
      (scene.session.coarseInk() && scene.view.isVisible(Layer::Mask)) || scene.session.coarseCurves();
  if (isCoarse && !scene.view.isScanOnly())
    return scene.session.isBusy() ? chipText("coarse result · full result to follow")
                                  : chipText("stopped · coarse result shown");
  if (scene.session.isBusy()) return scene.isLate ? chipText("working…") : QString();
  if (scene.session.hasScan() && scene.session.isStale(StageId::Faired))
    return chipText("stopped · previous result shown");
  return {};
}

void paintChips(QPainter& painter, const CanvasScene& scene) {
  // Nothing is said of a curve that is not drawn, and nothing lies over the regions while they are worked on.
  const bool isCurveDrawn = scene.view.isVisible(Layer::Curve) || scene.view.isVisible(Layer::Faired);
  if (isCurveDrawn) paintChip(painter, scene, curveText(scene), ChipPlace::TopLeft);
  const bool areRegionsWorkedOn = scene.view.tool() == Tool::Thresholds;
  if (areRegionsWorkedOn)
    paintChipBesidePage(painter, scene, workText(scene));
  else
    paintChip(painter, scene, workText(scene), ChipPlace::TopRight);
  if (!areRegionsWorkedOn) paintChip(painter, scene, pageText(scene), ChipPlace::BottomLeft);
  paintChip(painter, scene, cursorText(scene), ChipPlace::BottomRight);
}

}  // namespace batten
