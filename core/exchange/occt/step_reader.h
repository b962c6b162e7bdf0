// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/exchange/model/cad_shape.h"

namespace batten {

/// What writeStep() wrote: the curves of the geometric sets, z left out; others of the sets are counted in `left`. Not
/// for files of others: the library crashes on damaged ones.
Result<CadDrawing> readStep(std::string_view bytes);

}  // namespace batten
