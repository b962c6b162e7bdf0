// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/fairing_figures.h"

#include <algorithm>
#include <cmath>

#include "core/fairing/fairing_report.h"
#include "core/fairing/target_advice.h"
#include "ui/panels/stages/fairing_panel.h"
#include "ui/session/edits/fairing_edits.h"
#include "ui/session/view/judged_curve.h"

namespace batten {
namespace {

using Cell = FigureTable::Cell;

Cell noFigure() { return {QStringLiteral("–")}; }

QString millimetresOfMove(double value) { return QString::number(value, 'f', value < 0.1 ? 3 : 2); }

/// A tolerance as it is shown and set: never less than what is needed.
double roundedUp(double mm) {
  const double steps = mm < 0.1 ? 1000.0 : 100.0;  // a millimetre: the decimals of millimetres()
  return std::ceil(mm * steps - 1e-9) / steps;
}

/// What to take where a target is too far away.
QString insteadOf(FairingTarget target) {
  if (target == FairingTarget::Drawn) return FairingPanel::tr("choose or draw a profile that is nearer to its own");
  if (target == FairingTarget::LogAesthetic) return FairingPanel::tr("choose another alpha or more spans");
  return FairingPanel::tr("choose a higher degree or more spans");
}

bool wasFaired(const TracedCurve& curve) {
  return !curve.faired.isEmpty() && curve.fairingUsed.mode != FairingMode::None;
}

/// The polynomial target that the curve follows, or that of the span which is pointed at; none while it is not known.
std::optional<int> shownDegree(const EditorSession& session, const TracedCurve& curve) {
  const auto targets = session.targets();
  if (session.pointedSpan()) return chosenSpanTarget(session);
  if (targets && curve.fairingUsed.target == FairingTarget::Recommended && targets->recommendedDegree)
    return targets->recommendedDegree;
  return degreeOf(curve.fairingUsed.target);
}

// The rows stand there in any mode, also while a target is computed: what is below them stays in its place.
void addTargetRows(std::vector<FigureTable::Row>& rows, const EditorSession& session, const TracedCurve& curve) {
  const auto targets = session.targets();
  const bool isFollowed = wasFaired(curve) && curve.fairingUsed.mode == FairingMode::Target;
  const bool hasDegree = isFollowed && isPolynomial(curve.fairingUsed.target);
  const auto degree = hasDegree ? shownDegree(session, curve) : std::nullopt;
  const TargetProfile* profile = targets && degree ? &targets->targets.profiles[*degree - 1] : nullptr;
  const auto& after = curve.fairing.similarityAfter;
  rows.push_back({FairingPanel::tr("Similarity S"),
                  {profile ? Cell{similarityText(profile->similarity)} : noFigure(),
                   hasDegree && after ? Cell{similarityText(*after)} : noFigure()},
                  FairingPanel::tr("Similarity of the sketched profile to the target; 1 is identical. Faired: "
                                   "similarity of the faired to the sketched profile. Of radii, or where the line has "
                                   "inflections, of curvatures.")});
  rows.push_back(
      {FairingPanel::tr("Monotone in each span"),
       {noFigure(),
        profile ? Cell{profile->isMonotone ? FairingPanel::tr("yes") : FairingPanel::tr("no")} : noFigure()},
       FairingPanel::tr("Whether the profile only rises or only falls from each split to the next: then it has no "
                        "curvature extremum but at the splits.")});
}

}  // namespace

std::vector<FigureTable::Row> noFairingRows(const EditorSession& session) {
  std::vector<FigureTable::Row> rows = fairingRows(session, TracedCurve{});
  for (FigureTable::Row& row : rows) row.cells.assign(2, noFigure());
  return rows;
}

std::vector<FigureTable::Row> fairingRows(const EditorSession& session, const TracedCurve& curve) {
  const bool faired = wasFaired(curve);
  const CurveFigures &before = curve.sketchedFigures, &after = curve.fairedFigures;
  const FairingReport& report = curve.fairing;
  const bool over = faired && report.maxDeviationMm > curve.fairingUsed.toleranceMm * (1 + 1e-9);
  const int extrema = report.roundedMm > 0.0 ? report.extremaAfter : after.extrema;
  std::vector<FigureTable::Row> rows = {
      {FairingPanel::tr("Curvature extrema"),
       {{QString::number(before.extrema)}, faired ? Cell{QString::number(extrema)} : noFigure()},
       FairingPanel::tr("Local maxima and minima of the curvature: fewer is fairer. Those of rounded corners are "
                        "counted in the list and in files, not here.")},
      {FairingPanel::tr("Moved at most, mm"),
       {noFigure(), faired ? Cell{millimetresOfMove(report.maxDeviationMm), over} : noFigure()},
       FairingPanel::tr("Largest distance of the faired curve from the sketched one; never above the tolerance.")},
      {FairingPanel::tr("Deviation from line, mm"),
       {{millimetresOfMove(before.fromPoints.max)},
        faired ? Cell{millimetresOfMove(after.fromPoints.max)} : noFigure()},
       FairingPanel::tr("Largest distance of an edge point of the scan from the curve.")}};
  // Of all curves where one has it, so that a click on another leaves the table as long as it is.
  const auto isRounded = [](const TracedCurve& one) { return one.fairing.roundedMm > 0.0; };
  if (std::ranges::any_of(session.curves(), isRounded)) {
    rows.push_back({FairingPanel::tr("Rounded by, mm"),
                    {noFigure(), isRounded(curve) ? Cell{millimetresOfMove(report.roundedMm)} : noFigure()},
                    FairingPanel::tr("Largest move of the curve by corner rounding, not counting fairing.")});
  }
  addTargetRows(rows, session, curve);
  return rows;
}

FairingNote fairingNote(const TracedCurve& curve) {
  const FairingReport& report = curve.fairing;
  FairingNote said{isLeftAsDrawn(curve) ? whyLeftAsDrawn(curve) : QString::fromStdString(report.note), {}};
  if (!wasFaired(curve) || report.withinTolerance) return said;
  if (said.text.isEmpty())
    said.text = curve.fairingUsed.mode == FairingMode::LowPass
                    ? FairingPanel::tr("The tolerance is too small to follow the filtered curvature.")
                    : FairingPanel::tr("The tolerance is too small to reach the target.");
  const double needed = report.neededMm.value_or(0.0);
  const bool isMore = needed > curve.fairingUsed.toleranceMm;
  const bool isSensible = needed <= mostSensibleToleranceMm(curve.sketched);
  if (isMore && isSensible) said.neededMm = roundedUp(needed);
  if (isMore && !isSensible && curve.fairingUsed.mode == FairingMode::Target) {
    const QString far =
        FairingPanel::tr("Reaching the target would move this curve by %1, which changes its shape: %2.")
            .arg(millimetres(needed), insteadOf(curve.fairingUsed.target));
    // A curve that was left as drawn says what to do in general words: one advice is enough.
    said.text = isLeftAsDrawn(curve) ? FairingPanel::tr("Unchanged. %1").arg(far) : said.text + QLatin1Char(' ') + far;
  }
  return said;
}

}  // namespace batten
