// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace batten {

// What Batten calls the lines of its files and their layers, and knows its own files by.

inline constexpr std::string_view kLineIdBegin = "curve-", kSketchedIdEnd = "-sketched";
inline constexpr const char* kFairedLayer = "Faired";
inline constexpr const char* kSketchedLayer = "Sketched";

/// "curve-3", "curve-3-sketched"
inline std::string lineId(int number, bool isSketched) {
  return std::string(kLineIdBegin) + std::to_string(number) + std::string(isSketched ? kSketchedIdEnd : "");
}

}  // namespace batten
