// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/pipeline/run/left_as_drawn.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// Which of its two shapes of a curve is looked at: as constructed, or as fairing leaves it. Comb, marks, plots and
/// figures all show the same one.
enum class Judged { Sketched, Result };

/// The sketched curve where there is no other yet.
const NurbsCurve& judgedCurve(const TracedCurve& curve, Judged judged);
const CurveFigures& judgedFigures(const TracedCurve& curve, Judged judged);
/// Why fairing left a curve as it was drawn, one sentence; empty where it did not.
QString whyLeftAsDrawn(const TracedCurve& curve);

}  // namespace batten
