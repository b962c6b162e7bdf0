// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace batten::cli {

/// Names of files are bytes, and JSON is text: a byte that is no UTF-8 is written as \udc80 … \udcff, as Python does
/// (PEP 383), and read back as that byte. In between, in a JSON value, it stands as U+0000, which no name holds, and
/// U+0080 … U+00FF.

/// A name as the text of a JSON value, and back.
std::string jsonText(std::string_view name);
std::string nameOf(std::string_view jsonText);

/// One line of JSON without a line break that holds names as jsonText gives them.
std::string lineWithNames(const nlohmann::ordered_json&);
/// The line as a JSON parser takes it; bytes of names that stand there as they are count, too.
std::string parsableLine(std::string_view line);

}  // namespace batten::cli
