// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/pipeline/run/pipeline.h"

namespace batten {

/// Puts the outputs up to `last` of a run over the shown ones; later stages keep what they have.
void mergeOutputs(PipelineOutput& shown, const PipelineOutput& run, StageId last);

}  // namespace batten
