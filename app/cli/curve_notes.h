// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/pipeline/run/pipeline.h"

namespace batten::cli {

/// What construction and fairing have to say of the curves: one line for each kind of note, those of the construction
/// first. Curves by their numbers; those left out of the export are passed over. @pre output.faired
std::vector<std::string> curveNotes(const PipelineOutput& output);

}  // namespace batten::cli
