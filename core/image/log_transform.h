// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/base/result.h"
#include "core/image/grey_image.h"

namespace batten {

/// 255 / ln 256: the factor that maps 0..255 onto itself.
inline constexpr double kNeutralLogFactor = 45.98590442833571;

struct LogParams {
  bool enabled = true;                ///< Off: the picture is shown as scanned.
  double factor = kNeutralLogFactor;  ///< [-] 10..150. Slope a of y = a log(1 + x). Larger lifts the dark tones and
                                      ///< clips the bright.
  bool operator==(const LogParams&) const = default;
};
/// First invalid field, with its range, if any.
std::optional<Error> validate(const LogParams&);

/// y = a log(1 + x), clipped to 0..255, for x in 0..255 (000 Eq 1 with the singularity at 0 mended; algorithms: the
/// transform is monotone, so it changes only what is shown and on which scale thresholds are given).
double logTone(double grey, const LogParams&);
/// Inverse of logTone before clipping: the grey level whose tone is `tone`.
double greyOfTone(double tone, const LogParams&);

/// The tone of every 8-bit grey level, for display. The full log picture is never stored.
std::array<std::uint8_t, 256> toneTable(const LogParams&);

}  // namespace batten
