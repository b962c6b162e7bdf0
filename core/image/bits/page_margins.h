// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Ink without the pieces that lie along the border of the page over more than half their length: the margin of the
/// scanner, the edge of the sheet.
BitImage withoutMargins(BitImage ink, const RunContext&);

}  // namespace batten
