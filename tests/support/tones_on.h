// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/image/tones/tone_areas.h"

namespace batten::test {

/// What one of the searches for tones finds on a page; nothing on a page that has no copy for it.
template <auto search>
std::optional<ToneAreas> tonesOn(const GreyImage& page, const RunContext& context) {
  const std::optional<ToneCopy> copy = toneCopyOf(page, context);
  return copy ? search(*copy, context) : std::nullopt;
}

}  // namespace batten::test
