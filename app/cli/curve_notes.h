// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/pipeline/run/pipeline.h"

namespace batten::cli {

/// What construction and fairing have to say of the curves: one line for each kind of note, those of the construction
/// first. Curves are counted from 1, in the order of the report; those left out of the export are passed over.
std::vector<std::string> curveNotes(std::span<const TracedCurve> curves);

}  // namespace batten::cli
