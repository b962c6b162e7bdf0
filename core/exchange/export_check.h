// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/exchange/export_model.h"

namespace batten {

/// Why a document must not be written: nothing in it, a curve without pieces, a number that is not finite, a frame
/// without size. Every writer asks this first, so that no file ever holds a NaN.
std::optional<Error> exportProblem(const ExportDocument&);

}  // namespace batten
