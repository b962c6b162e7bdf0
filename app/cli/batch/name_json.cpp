// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/name_json.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "core/base/shown_text.h"

namespace batten::cli {
namespace {

constexpr std::string_view kHexDigits = "0123456789abcdef";
constexpr std::size_t kEscape = 6;  // bytes of \uXXXX

std::string twoDigits(unsigned char byte) { return {kHexDigits[byte >> 4u], kHexDigits[byte & 15u]}; }

/// U+0080 … U+00FF in UTF-8.
std::string characterOf(unsigned char byte) {
  return {static_cast<char>(0xc0u | byte >> 6u), static_cast<char>(0x80u | (byte & 0x3fu))};
}

/// The byte that the two bytes of UTF-8 at the start of `text` stand for; nullopt if they are not U+0080 … U+00FF.
std::optional<unsigned char> byteOf(std::string_view text) {
  if (text.size() < 2) return std::nullopt;
  const auto first = static_cast<unsigned char>(text[0]), second = static_cast<unsigned char>(text[1]);
  if ((first != 0xc2 && first != 0xc3) || (second & 0xc0u) != 0x80u) return std::nullopt;
  return static_cast<unsigned char>((first & 0x03u) << 6u | (second & 0x3fu));
}

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

std::string jsonText(std::string_view name) {
  std::string text;
  while (!name.empty()) {
    const std::size_t length = characterBytes(name);
    if (length > 0) {
      text.append(name.substr(0, length));
    } else {
      text.append(1, '\0').append(characterOf(static_cast<unsigned char>(name.front())));
    }
    name.remove_prefix(std::max<std::size_t>(1, length));
  }
  return text;
}

std::string nameOf(std::string_view text) {
  std::string name;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto byte = text[at] == '\0' ? byteOf(text.substr(at + 1)) : std::nullopt;
    name.push_back(byte ? static_cast<char>(*byte) : text[at]);
    if (byte) at += 2;
  }
  return name;
}

std::string lineWithNames(const nlohmann::ordered_json& json) {
  const std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = std::string_view(text).substr(at);
    const auto byte = rest.starts_with("\\u0000") ? byteOf(rest.substr(kEscape)) : std::nullopt;
    if (byte) {
      line.append("\\udc").append(twoDigits(*byte));
      at += kEscape + 2;
      continue;
    }
    const std::size_t length = text[at] == '\\' ? 2 : 1;  // "\\u0000" is a backslash and a word
    line.append(rest.substr(0, length));
    at += length;
  }
  return line;
}

std::string parsableLine(std::string_view line) {
  constexpr unsigned kByteFrom = 0xdc80, kByteTo = 0xdcff;
  std::string text;
  const auto addByte = [&](unsigned char byte) { text.append("\\u0000\\u00").append(twoDigits(byte)); };
  while (!line.empty()) {
    std::size_t length = characterBytes(line);
    const auto code = escapeOf(line);
    if (length == 0) {
      addByte(static_cast<unsigned char>(line.front()));
      length = 1;
    } else if (code && *code >= kByteFrom && *code <= kByteTo) {
      addByte(static_cast<unsigned char>(*code & 0xffu));
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
