// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/content_hash.h"

#include <openssl/evp.h>

#include <new>

namespace batten {

struct HashBuilder::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  ~State() { EVP_MD_CTX_free(context); }
};

HashBuilder::HashBuilder() : state_(std::make_unique<State>()) {
  if (state_->context == nullptr || EVP_DigestInit_ex(state_->context, EVP_sha256(), nullptr) != 1)
    throw std::bad_alloc();
}
HashBuilder::~HashBuilder() = default;

HashBuilder& HashBuilder::bytes(std::span<const std::byte> data) {
  EVP_DigestUpdate(state_->context, data.data(), data.size());
  return *this;
}

HashBuilder& HashBuilder::text(std::string_view value) {
  integer(static_cast<std::int64_t>(value.size()));
  return bytes(std::as_bytes(std::span(value.data(), value.size())));
}

HashBuilder& HashBuilder::number(double value) {
  const double canonical = value == 0.0 ? 0.0 : value;  // -0 and +0 are the same parameter
  return bytes(std::as_bytes(std::span(&canonical, 1)));
}

HashBuilder& HashBuilder::integer(std::int64_t value) { return bytes(std::as_bytes(std::span(&value, 1))); }

HashBuilder& HashBuilder::hash(const ContentHash& value) { return bytes(std::as_bytes(std::span(value.bytes))); }

ContentHash HashBuilder::finish() {
  ContentHash result;
  unsigned int size = 0;
  EVP_DigestFinal_ex(state_->context, result.bytes.data(), &size);
  return result;
}

std::string ContentHash::hex() const {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  text.reserve(bytes.size() * 2);
  for (const std::uint8_t byte : bytes) {
    text.push_back(kDigits[byte >> 4]);
    text.push_back(kDigits[byte & 15]);
  }
  return text;
}

ContentHash sha256(std::span<const std::byte> data) {
  HashBuilder builder;
  builder.bytes(data);
  return builder.finish();
}

}  // namespace batten
