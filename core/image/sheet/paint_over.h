// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

struct PaperSheet;

/// The page with all that lies beside the sheet painted over: the paper goes on, with its grain. Two pages of an open
/// book are brought to one level of brightness.
GreyImage onlyTheSheet(const GreyImage& page, const PaperSheet&, const RunContext&);

/// The page with the cells outside `inside` painted over: the paper around goes on in them, with its grain.
/// @param inside squares of cellPx pixels.
GreyImage paintedOver(GreyImage page, const BitImage& inside, int cellPx, const RunContext& context);

}  // namespace batten
