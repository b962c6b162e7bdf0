// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace batten {

/// Bytes of a name or a file as text that a terminal, a window and XML can show: valid UTF-8, one line. What is neither
/// a character nor visible - broken UTF-8, control characters (C0, DEL, C1), line and direction marks, spaces without
/// width, noncharacters - becomes a question mark, one per byte or character.
std::string shownText(std::string_view bytes);
/// The same of a path, all of it.
inline std::string shownName(const std::filesystem::path& path) { return shownText(path.string()); }

/// A name or value as a message may quote it: in quotation marks, as shownText has it, and where it is longer than
/// kQuotedBytes cut there, with "…" for the rest.
std::string quotedText(std::string_view bytes);
inline constexpr std::size_t kQuotedBytes = 80;  // a line of a terminal

/// How many bytes the character takes with which a text that is not empty begins; 0 if it is no well-formed UTF-8.
std::size_t characterBytes(std::string_view text);

/// JSON text as a terminal may see it: what shownText replaces and JSON allows within strings - DEL, C1, line and
/// direction marks, spaces without width, noncharacters - written as \u and four digits. The value stays the same.
std::string shownJson(std::string_view json);

}  // namespace batten
