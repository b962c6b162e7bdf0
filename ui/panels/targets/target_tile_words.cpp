// SPDX-License-Identifier: GPL-3.0-or-later
// What a target's tile says: to a screen reader, in its tool tip, and in place of figures.
#include <algorithm>

#include "core/fairing/fairing.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/target_advice.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/targets/target_tile.h"
#include "ui/session/edits/fairing_edits.h"
#include "ui/session/edits/piece_choice.h"

namespace batten {

QString TargetTile::problem() const {
  if (!outcomes_) return {};
  const int index = degree_ - 1;
  const TargetProfile& profile = outcomes_->targets.profiles[index];
  if (!profile.valid)
    return profile.problem.empty() ? tr("does not fit this curve") : QString::fromStdString(profile.problem);
  if (!outcomes_->faired[index])
    return outcomes_->problems[index].empty() ? tr("could not be reached")
                                              : QString::fromStdString(outcomes_->problems[index]);
  return {};
}

TargetTile::Advice TargetTile::advice() const {
  if (!outcomes_ || outcomes_->recommendedDegree != degree_) return Advice::None;
  // The shape nearest to the sketch is only advice where the tolerance allows it.
  const bool fits = isWithinTolerance(*outcomes_, degree_, toleranceMm_) && !addsExtrema(*outcomes_, degree_);
  if (!fits) return Advice::None;
  return isAdvisable(*outcomes_, degree_, toleranceMm_) ? Advice::Recommended : Advice::SimplestFit;
}

QString TargetTile::nameText() const { return tr("Target %1, %2").arg(degree_).arg(degreeName(degree_)); }

QString TargetTile::spokenText() const {
  QString spoken = nameText();
  if (const QString why = problem(); !why.isEmpty()) {
    spoken += QStringLiteral(": ") + why;
  } else if (outcomes_) {
    const FairingReport& report = outcomes_->faired[degree_ - 1]->report;
    spoken +=
        tr(", moves the curve by %1, %2 extrema").arg(millimetres(report.maxDeviationMm)).arg(report.extremaAfter);
  }
  if (advice() == Advice::Recommended) spoken += tr(", recommended");
  if (advice() == Advice::SimplestFit) spoken += tr(", simplest fit");
  if (!outcomes_ && !waiting_.isEmpty()) spoken += QStringLiteral(", ") + waiting_;
  if (chosen_) spoken += tr(", chosen");
  return spoken;
}

/// What the figures mean, and which target they are of.
QString TargetTile::figuresTip() const {
  const FairingReport& report = outcomes_->faired[degree_ - 1]->report;
  const TargetProfile& profile = outcomes_->targets.profiles[degree_ - 1];
  QString tip =
      tr("\nS %1: similarity of this profile to that of the sketched curve; 1 is the same.\nMoves the curve by at "
         "most %2; left: %3.")
          .arg(similarityText(profile.similarity), millimetres(report.maxDeviationMm),
               counted(report.extremaAfter, tr("1 curvature extremum"), tr("%1 curvature extrema")));
  if (report.similarityAfter)
    tip += tr("\nS of the faired curve against the sketched curve: %1.").arg(similarityText(*report.similarityAfter));
  if (const int more = report.extremaAfter - report.extremaBefore; more > 0)
    tip += counted(more, tr("\nThat is 1 more than the sketched curve has."),
                   tr("\nThat is %1 more than the sketched curve has."));
  if (const double needed = report.neededMm.value_or(0.0); !report.withinTolerance && needed > toleranceMm_)
    tip += tr("\nReaching it needs a tolerance of %1.").arg(millimetres(needed));
  else if (!report.withinTolerance)
    tip += report.maxDeviationMm > 0.0
               ? tr("\nThe curve follows it in part: all of it would take more curvature extrema than are left here.")
               : tr("\nThe curve is unchanged: any part of it would take more curvature extrema.");
  if (!profile.isMonotone) tip += tr("\nThis profile is not monotone within a span.");
  if (outcomes_->span)
    tip += tr("\nFor the span you clicked; the rest of the curve is unchanged.");
  else if (!outcomes_->splits.empty())
    tip += tr("\nOne polynomial for each of %1 spans.").arg(outcomes_->splits.size() + 1);
  if (outcomes_->targets.comparesCurvature) tip += tr("\nS compares curvatures, because the line has inflections.");
  if (!isFlat())
    tip += tr("\nGrey: curvature of the sketched curve; dark: of the target, over the arc length, as the plot runs.");
  return tip;
}

QString TargetTile::tipText(bool oneCurve) const {
  QString tip = nameText();
  if (const QString why = problem(); !why.isEmpty())
    tip += QStringLiteral(": ") + why;
  else if (outcomes_)
    tip += figuresTip();
  tip += QLatin1Char('\n') + (oneCurve ? tr("Click or press %1: for the selected curve.").arg(degree_)
                                       : tr("Click or press %1: for all curves.").arg(degree_));
  if (advice() == Advice::Recommended)
    tip += tr(
        "\n✓ recommended: the simplest profile that is reached within the tolerance without an extremum more. S rises "
        "with the degree, so it does not choose.");
  return tip;
}

}  // namespace batten
