// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target_splits.h"

#include <algorithm>

#include "core/fairing/corner_sections.h"
#include "core/fairing/target/calm_curve.h"
#include "core/fairing/target/natural_spans.h"

namespace batten {

std::vector<double> targetSplits(const NurbsCurve& curve, bool closed, const FairingParams& params, CancelCheck check) {
  const bool isNatural = hasNaturalSpans(params.targets);
  const auto naturalOf = [&check](const NurbsCurve& one, bool isClosed, const FairingParams& own) {
    return naturalSplits(targetStart(one, isClosed, own, check), isClosed, own.toleranceMm);
  };
  const auto sections = cornerSections(curve, closed);
  if (sections.empty()) return isNatural ? naturalOf(curve, closed, params) : params.targets.splits;
  std::vector<double> splits = isNatural ? std::vector<double>{} : params.targets.splits;
  for (const CornerSection& section : sections) {
    if (section.span.from > 0.0 || closed) splits.push_back(section.span.from);
    if (!isNatural || section.isStraight) continue;
    for (const double f : naturalOf(section.curve, false, paramsOfSection(params, section, closed)))
      splits.push_back(section.span.from + f * (section.span.to - section.span.from));
  }
  std::sort(splits.begin(), splits.end());
  return splits;
}

LogAestheticTarget logAestheticOf(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                  CancelCheck check) {
  return logAestheticTarget(targetStart(curve, closed, params, check), closed,
                            targetSplits(curve, closed, params, check), params.alpha, params.targets.samples);
}

}  // namespace batten
