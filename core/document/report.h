// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/document/explain/explanation.h"
#include "core/fairing/fairing.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// What a report holds beside the outputs of the run.
struct ReportExtras {
  double readMilliseconds = 0.0;                ///< Reading the scan.
  std::vector<Result<TargetOutcomes>> targets;  ///< One per faired curve; empty = not asked for.
  bool series = false;  ///< Knots, polynomials and series along every curve (curveSeriesToJson), sketched and faired.
  std::optional<Explanation> explanation;        ///< Absent = not asked for.
  std::optional<std::uint64_t> peakMemoryBytes;  ///< Absent = unknown.
};

/// The report as JSON, "batten-report" version 1: image; per stage milliseconds and counts; per contour length, area,
/// stroke width, spread of merged strokes, bridged gaps and where it was not placed; per curve its name and number (as
/// in the window and in files; `index` and `piece` count from 0), length, control points, corners, deviations (px and
/// mm), extrema, inflections, the six targets, the choice, and why each solver stopped; how well the
/// curves explain the ink, where asked; what failed; peak memory. Works on the outputs of a run that ended early, too.
std::string reportToJson(const Scan&, const Recipe&, const PipelineOutput&, const ReportExtras&);

}  // namespace batten
