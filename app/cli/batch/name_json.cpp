// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/name_json.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "core/base/name_text.h"
#include "core/base/shown_text.h"

namespace batten::cli {
namespace {

constexpr std::string_view kHexDigits = "0123456789abcdef";  // in the order of their values
constexpr std::size_t kEscape = 6;                           // bytes of \uXXXX

/// XXXX of the \uXXXX at the start of `text`.
std::optional<unsigned> escapeOf(std::string_view text) {
  if (text.size() < kEscape || text[0] != '\\' || text[1] != 'u') return std::nullopt;
  unsigned code = 0;
  for (const char c : text.substr(2, 4)) {
    const auto digit = kHexDigits.find(static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
    if (digit == std::string_view::npos) return std::nullopt;
    code = code << 4u | static_cast<unsigned>(digit);
  }
  return code;
}

}  // namespace

std::string parsableLine(std::string_view line) {
  constexpr unsigned kByteFrom = 0xdc80, kByteTo = 0xdcff;  // code units that stand for bytes that are no UTF-8
  std::string text;
  const auto addByte = [&](char byte) { text.append("\\").append(byteText(byte)); };  // a backslash of JSON is two
  while (!line.empty()) {
    std::size_t length = characterBytes(line);
    const auto code = escapeOf(line);
    if (length == 0) {
      addByte(line.front());
      length = 1;
    } else if (code && *code >= kByteFrom && *code <= kByteTo) {
      addByte(static_cast<char>(*code & 0xffu));
      length = kEscape;
    } else {
      const bool isPair = code && *code >= 0xd800 && *code < 0xdc00;  // of one character beyond U+FFFF
      if (line.front() == '\\') length = std::min<std::size_t>(line.size(), isPair ? 2 * kEscape : 2);
      text.append(line.substr(0, length));
    }
    line.remove_prefix(length);
  }
  return text;
}

}  // namespace batten::cli
