// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace batten {

/// A SHA-256 digest: names an image file in an export, and keys the outputs of stages.
struct ContentHash {
  std::array<std::uint8_t, 32> bytes{};
  bool operator==(const ContentHash&) const = default;
  auto operator<=>(const ContentHash&) const = default;  // NOLINT(modernize-use-nullptr): a false alarm
  /// 64 lower-case hexadecimal digits.
  std::string hex() const;
};

/// Feeds values into one digest. Numbers are hashed by their bytes, strings with their length, so that neighbours
/// cannot run into each other.
class HashBuilder {
 public:
  HashBuilder();
  ~HashBuilder();
  HashBuilder(const HashBuilder&) = delete;
  HashBuilder& operator=(const HashBuilder&) = delete;

  HashBuilder& bytes(std::span<const std::byte> data);
  HashBuilder& text(std::string_view value);
  HashBuilder& number(double value);
  HashBuilder& integer(std::int64_t value);
  HashBuilder& hash(const ContentHash& value);
  /// Ends the digest; the builder is spent afterwards.
  ContentHash finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The digest of a block of bytes, equal to what `sha256sum` prints for a file with these bytes.
ContentHash sha256(std::span<const std::byte> data);

}  // namespace batten
