// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <set>
#include <utility>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/exchange/model/export_model.h"

namespace batten {

/// Line and piece, as indices.
using PiecesOnTop = std::set<std::pair<std::size_t, std::size_t>>;

/// The pieces that lie on top of another one of their layer, all along: of two alike the later one, otherwise the
/// shorter one. Cancelled.
Result<PiecesOnTop> piecesOnTop(const ExportDocument&, const RunContext& = {});

}  // namespace batten
