// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

#include "core/exchange/picture.h"
#include "core/pipeline/run/pipeline.h"

namespace batten::cli {

/// Names that --dump takes: "log", "page" (as it is traced, without printed lines) and "paper" (the same, flattened),
/// then the stages.
std::vector<std::string> dumpNames();

/// A stage's output as a picture of the scan's size: masks as they are, lines and curves over the lightened scan.
/// @return NoCurve if the run ended before that stage.
Result<Picture> dumpStage(std::string_view dumpName, const Scan&, const Recipe&, const PipelineOutput&);

}  // namespace batten::cli
