// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/shown_text.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace batten {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  ///< 0: none begins here.
};

/// The character at the start of non-empty `text`, if its bytes are well-formed UTF-8 (RFC 3629).
Character firstOf(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return {};
  std::uint32_t code = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0u) != 0x80u) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  // code of so many bytes: a smaller one is written too long
  constexpr std::array<std::uint32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  const bool isSurrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < kLeast[length] || code > 0x10ffff || isSurrogate) return {};
  return {code, length};
}

bool isControl(std::uint32_t code) { return code < 0x20 || (code >= 0x7f && code <= 0x9f); }

bool isShown(std::uint32_t code) {
  const bool isLineMark = code == 0x2028 || code == 0x2029;
  const bool setsDirection = code == 0x061c || code == 0x200e || code == 0x200f || (code >= 0x202a && code <= 0x202e) ||
                             (code >= 0x2066 && code <= 0x2069);
  const bool hasNoWidth = code == 0x200b || code == 0x2060 || code == 0xfeff;  // but for joiners, which scripts need
  const bool isNoCharacter = (code & 0xfffeu) == 0xfffe || (code >= 0xfdd0 && code <= 0xfdef);
  return !isControl(code) && !isLineMark && !setsDirection && !hasNoWidth && !isNoCharacter;
}

/// JSON spells a character beyond U+FFFF as two halves.
void addEscape(std::string& json, std::uint32_t code) {
  constexpr std::string_view kHex = "0123456789abcdef";
  constexpr std::uint32_t kPairFrom = 0x10000, kHigh = 0xd800, kLow = 0xdc00;
  if (code >= kPairFrom) {
    addEscape(json, kHigh + ((code - kPairFrom) >> 10u));
    addEscape(json, kLow + ((code - kPairFrom) & 0x3ffu));
    return;
  }
  json.append("\\u");
  for (const unsigned shift : {12u, 8u, 4u, 0u}) json.push_back(kHex[(code >> shift) & 0xfu]);
}

}  // namespace

std::string shownText(std::string_view bytes) {
  std::string shown;
  shown.reserve(bytes.size());
  while (!bytes.empty()) {
    const Character c = firstOf(bytes);
    const std::size_t length = c.bytes == 0 ? 1 : c.bytes;
    if (c.bytes != 0 && isShown(c.code))
      shown.append(bytes.substr(0, length));
    else
      shown.push_back('?');
    bytes.remove_prefix(length);
  }
  return shown;
}

std::string quotedText(std::string_view bytes) {
  std::size_t end = 0;
  while (end < bytes.size()) {
    const std::size_t next = end + std::max<std::size_t>(firstOf(bytes.substr(end)).bytes, 1);
    if (next > kQuotedBytes) break;
    end = next;
  }
  std::string quoted = shownText(bytes.substr(0, end));
  quoted.insert(quoted.begin(), '"');
  quoted.append(end < bytes.size() ? "…\"" : "\"");
  return quoted;
}

std::size_t characterBytes(std::string_view text) { return firstOf(text).bytes; }

std::string shownJson(std::string_view json) {
  std::string safe;
  safe.reserve(json.size());
  while (!json.empty()) {
    const Character c = firstOf(json);
    const std::size_t length = c.bytes == 0 ? 1 : c.bytes;
    constexpr std::uint32_t kFirst = 0x7f;  // below it only the layout of the text itself has controls
    if (c.bytes != 0 && c.code >= kFirst && !isShown(c.code))
      addEscape(safe, c.code);
    else
      safe.append(json.substr(0, length));
    json.remove_prefix(length);
  }
  return safe;
}

}  // namespace batten
