// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/json_text.h"

#include <nlohmann/json.hpp>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/base/shown_text.h"

namespace batten {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kEventsPerLook = 1024;  // between two looks at the cancel token: well under a millisecond

/// Builds the value as its parts are met. Every event answers whether to go on.
class Builder {
 public:
  Builder(const RunContext& context, const JsonLimits& limits) : context_(context), limits_(limits) {}

  bool null() { return add(nullptr) != nullptr; }
  bool boolean(bool value) { return add(value) != nullptr; }
  bool number_integer(Json::number_integer_t value) { return add(value) != nullptr; }
  bool number_unsigned(Json::number_unsigned_t value) { return add(value) != nullptr; }
  bool number_float(Json::number_float_t value, const std::string&) { return add(value) != nullptr; }
  bool string(std::string& value) { return add(std::move(value)) != nullptr; }
  bool binary(Json::binary_t&) { return refuse("it is not text"); }
  bool start_object(std::size_t) { return begin(Json::object()); }
  bool start_array(std::size_t) { return begin(Json::array()); }
  bool end_object() { return end(); }
  bool end_array() { return end(); }

  bool key(std::string& name) {
    Level& level = levels_.back();
    if (name.size() > limits_.nameBytes)
      return refuse("it holds " + quotedText(name) + ", a name of more than " + std::to_string(limits_.nameBytes) +
                    " bytes");
    if (level.keys.size() >= limits_.keys)
      return refuse("one of its objects holds more than " + std::to_string(limits_.keys) + " names");
    if (!level.keys.insert(name).second) return refuse("it holds " + quotedText(name) + " twice");
    level.key = std::move(name);
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) {
    // What the library says quotes all of the word at which it stopped.
    problem_ = {ErrorCode::BadParameter, "it is incomplete or was not written by Batten",
                std::string(error.what()).substr(0, kDetailBytes)};
    return false;
  }

  Result<Json> result() {
    if (!problem_.message.empty()) return fail(std::move(problem_));
    return std::move(root_);
  }

 private:
  static constexpr std::size_t kDetailBytes = 300;

  struct Level {
    Json* value;
    std::string key;  ///< Of the entry that is read.
    std::unordered_set<std::string> keys;
  };

  bool refuse(std::string why) {
    problem_ = {ErrorCode::BadParameter, std::move(why), {}};
    return false;
  }

  /// @return where the value lies now, until its holder grows; null once the text is refused.
  Json* add(Json value) {
    if (++events_ % kEventsPerLook == 0 && context_.isCancelled()) {
      problem_ = cancelled().value();
      return nullptr;
    }
    if (events_ > limits_.values) {
      refuse("it holds more than " + std::to_string(limits_.values) + " values");
      return nullptr;
    }
    if (levels_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Level& level = levels_.back();
    if (level.value->is_array()) return &level.value->get_ref<Json::array_t&>().emplace_back(std::move(value));
    // Behind the others without a search: key() saw that it is new.
    auto& object = level.value->get_ref<Json::object_t&>();
    object.emplace_back(std::move(level.key), std::move(value));
    return &object.back().second;
  }

  bool begin(Json empty) {
    if (levels_.size() >= limits_.depth)
      return refuse("it is nested more than " + std::to_string(limits_.depth) + " levels deep");
    Json* const place = add(std::move(empty));
    if (place == nullptr) return false;
    levels_.push_back({place, {}, {}});
    return true;
  }

  bool end() {
    levels_.pop_back();
    return true;
  }

  const RunContext& context_;
  const JsonLimits& limits_;
  Json root_;
  std::vector<Level> levels_;
  Error problem_;
  std::size_t events_ = 0;
};

}  // namespace

Result<Json> parseJson(std::string_view text, const RunContext& context, const JsonLimits& limits) {
  if (text.size() > limits.bytes)
    return fail(ErrorCode::BadParameter, "it is larger than " + std::to_string(limits.bytes >> 20) + " MB");
  Builder builder(context, limits);
  Json::sax_parse(text, &builder);
  return builder.result();
}

std::string jsonLine(const Json& json) { return shownJson(json.dump(-1, ' ', false, Json::error_handler_t::replace)); }

}  // namespace batten
