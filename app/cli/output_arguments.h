// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "app/cli/trace_plan.h"

namespace batten::cli {

/// What is to be written, from the words: outputs, reports, dumps, preset and options.
/// @return BadParameter with what to do: an unknown word, an option or a preset without effect on any output, an output
///         over an input or over another output.
Result<OutputPlan> planOutputs(const TraceArguments&);

/// The words --preset takes, in one line.
std::string presetNames();

}  // namespace batten::cli
