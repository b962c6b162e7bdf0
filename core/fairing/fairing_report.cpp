// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/fairing_report.h"

#include <algorithm>
#include <utility>

#include "core/curve/curvature.h"

namespace batten {

FairedCurve unchanged(const NurbsCurve& curve, bool closed, Termination why, std::string note, CancelCheck check) {
  FairedCurve result;
  result.curve = curve;
  result.report.why = why;
  result.report.note = std::move(note);
  if (!curve.isEmpty()) result.report.extremaBefore = result.report.extremaAfter = countedExtrema(curve, closed, check);
  return result;
}

void addSentence(std::string& notes, const std::string& note) {
  if (note.empty() || notes.find(note) != std::string::npos) return;
  notes.append(notes.empty() ? "" : " ").append(note);
}

void addPart(FairingReport& sum, const FairingReport& part) {
  const auto isOutOfReach = [](const FairingReport& r) { return !r.withinTolerance && !r.neededMm; };
  const bool isReached = !isOutOfReach(sum) && !isOutOfReach(part);
  if (sum.why == Termination::NotRun || part.why != Termination::Converged) sum.why = part.why;
  addSentence(sum.note, part.note);
  sum.iterations += part.iterations;
  sum.objectiveBefore = std::max(sum.objectiveBefore, part.objectiveBefore);
  sum.objectiveAfter = std::max(sum.objectiveAfter, part.objectiveAfter);
  sum.maxDeviationMm = std::max(sum.maxDeviationMm, part.maxDeviationMm);
  sum.neededMm = isReached ? std::max(sum.neededMm, part.neededMm) : std::nullopt;
  if (part.similarityAfter) sum.similarityAfter = std::min(sum.similarityAfter.value_or(1.0), *part.similarityAfter);
  sum.withinTolerance = sum.withinTolerance && part.withinTolerance;
  sum.noiseMm = std::max(sum.noiseMm, part.noiseMm);
}

}  // namespace batten
