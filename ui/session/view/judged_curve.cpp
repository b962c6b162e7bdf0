// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/view/judged_curve.h"

namespace batten {

const NurbsCurve& judgedCurve(const TracedCurve& curve, Judged judged) {
  return judged == Judged::Result && isChanged(curve) ? curve.faired : curve.sketched;
}

const CurveFigures& judgedFigures(const TracedCurve& curve, Judged judged) {
  return judged == Judged::Result && isChanged(curve) && curve.fairedFigures.lengthMm > 0.0 ? curve.fairedFigures
                                                                                            : curve.sketchedFigures;
}

QString whyLeftAsDrawn(const TracedCurve& curve) { return QString::fromStdString(leftAsDrawnReason(curve)); }

}  // namespace batten
