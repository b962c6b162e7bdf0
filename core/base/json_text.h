// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/run_context.h"

namespace batten {

/// What a JSON text may ask of its reader; files of ours stay far below. Beyond these a text is damage, or an attack on
/// the stack (depth), the memory (bytes, values) or the time (keys: an object is searched from its start).
struct JsonLimits {
  std::size_t bytes = std::size_t{64} << 20;  ///< of the whole text
  std::size_t depth = 64;                     ///< arrays and objects within one another
  std::size_t keys = 1000;                    ///< of one object
  std::size_t nameBytes = 1000;               ///< of the name of one value
  std::size_t values = 4'000'000;             ///< of the whole text; each takes some fifty bytes once it is read
};

/// The one door through which JSON comes in, whatever file or place it lies in. Takes time in proportion to the text;
/// can be cancelled while parsing. Objects with duplicate keys are rejected as ambiguous.
/// @return BadParameter; its message is the end of a sentence: "it is nested more than 64 levels deep". Cancelled.
Result<nlohmann::ordered_json> parseJson(std::string_view text, const RunContext& context = {},
                                         const JsonLimits& limits = {});

/// The value as one line without its line break, for stdout and for files of lines: whatever its names hold, a terminal
/// shows it (shownJson).
std::string jsonLine(const nlohmann::ordered_json&);

}  // namespace batten
