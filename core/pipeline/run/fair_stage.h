// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fairing/model/fairing_line.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// Fairs every included curve by the recipe or its own choice. A curve that cannot be faired keeps its sketched shape
/// and its report says why.
Result<FairedSet> fairAll(const ConstructedSet&, const ContourSet&, const PieceSet&, const Recipe&, const PageFrame&,
                          const RunContext&);

/// One curve faired as the parameters ask, before it is made light.
/// @param line the points that it stands for, where they are known.
Result<FairedCurve> fairedAs(const TracedCurve&, const FairingParams&, const RunContext&, const FairingLine& line = {});

}  // namespace batten
