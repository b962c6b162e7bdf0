// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Closing by a disc of this diameter [px], then holes whose largest disc is less than 2 px wider are filled: the
/// specks of a pencil stroke become one body. Unfinished when cancelled. May throw std::bad_alloc or cv::Exception.
BitImage closeInk(const BitImage& ink, double diameterPx, const RunContext& context);

/// [px] Diameter that closes the grain of pencil strokes of this width [px].
double grainClosing(double widthPx);

/// Ink of a pencil with its grain closed, given the width [px] of its strokes. On a fine page (fine_page.h) ink that
/// the grain does not tear stays as it is, with the counters of small letters. Throws as closeInk().
BitImage closeGrain(const BitImage& ink, double widthPx, bool isFinePage, const RunContext& context);

/// The pieces of `closed` of which at least `share` (0..1) is `ink`.
BitImage mostlyInk(const BitImage& closed, const BitImage& ink, double share, const RunContext& context);

}  // namespace batten
