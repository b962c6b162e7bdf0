// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/json_text.h"

#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

namespace batten {
namespace {

using Json = nlohmann::ordered_json;

std::string nested(int depth, const std::string& inner = "") {
  return std::string(depth, '[') + inner + std::string(depth, ']');
}

std::string withKeys(int count) {
  std::string text = "{";
  for (int i = 0; i < count; ++i) text += (i == 0 ? "\"k" : ",\"k") + std::to_string(i) + "\":" + std::to_string(i);
  return text + "}";
}

std::string problemOf(const std::string& text) {
  const auto json = parseJson(text);
  return json ? "" : json.error().message;
}

TEST(JsonText, ReadsWhatTheLibraryReads) {
  for (const std::string text :
       {"null", "true", "-7", "18446744073709551615", "0.1", "1e300", "\"ä\\n\\u20ac\"", "[]", "{}",
        R"({"z":1,"a":[1,2.5,{"x":[[]],"":null}],"m":{"n":{}}})", " [ 1 , [ 2 , 3 ] , { \"b\" : false } ] "}) {
    const auto json = parseJson(text);
    ASSERT_TRUE(json) << text << json.error().message;
    EXPECT_EQ(*json, Json::parse(text)) << text;
    EXPECT_EQ(json->dump(), Json::parse(text).dump()) << text;  // in the same order
  }
  for (const std::string text :
       {"", "[", "{\"a\":}", "[1,]", "{\"a\" 1}", "nul", "[1] 2", "\"\xff\"", "1e999", "{1:2}"})
    EXPECT_FALSE(parseJson(text)) << text;
}

TEST(JsonText, DepthIsLimited) {
  EXPECT_EQ(problemOf(nested(64)), "");
  EXPECT_NE(problemOf(nested(65)).find("64 levels"), std::string::npos);
  // Refused on the way down: neither the time nor the stack knows how deep it goes on.
  for (const int depth : {80'000, 5'000'000}) EXPECT_NE(problemOf(nested(depth)).find("64 levels"), std::string::npos);
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
  EXPECT_NE(problemOf(objects).find("64 levels"), std::string::npos);
}

TEST(JsonText, SizeAndNamesAreLimited) {
  EXPECT_EQ(problemOf(withKeys(1000)), "");
  EXPECT_NE(problemOf(withKeys(1001)).find("more than 1000 names"), std::string::npos);
  EXPECT_NE(problemOf(R"({"a":1,"b":2,"a":3})").find("\"a\" twice"), std::string::npos);
  EXPECT_EQ(problemOf(R"([{"a":1},{"a":2},{"a":{"a":3}}])"), "");
  EXPECT_EQ(problemOf("{\"" + std::string(1000, 'n') + "\":1}"), "");
  for (const std::size_t bytes : {1001, 10'000'000}) {
    const std::string problem = problemOf("{\"" + std::string(bytes, 'n') + "\":1}");
    EXPECT_NE(problem.find("a name of more than 1000 bytes"), std::string::npos);
    EXPECT_LT(problem.size(), 200u);
  }
  const std::string bent = std::string(900, 'n') + "\\u0007";
  EXPECT_LT(problemOf("{\"" + bent + "\":1,\"" + bent + "\":2}").size(), 200u);
  const auto broken = parseJson("[\"" + std::string(1'000'000, 'n') + "\\x\"]");
  ASSERT_FALSE(broken);
  EXPECT_LT(broken.error().message.size() + broken.error().detail.size(), 1000u);
  const auto tooLong = parseJson("[1,2,3,4,5]", {}, {.bytes = 10});
  ASSERT_FALSE(tooLong);
  EXPECT_EQ(tooLong.error().code, ErrorCode::BadParameter);
}

// A reader whose time went with the square of the text, or with the names before a name, would not come to its end
// before the tests' time limit.
TEST(JsonText, TakesTimeInProportionToTheText) {
  constexpr int kNames = 1'000'000, kInAnObject = 5;
  std::string text = "[";
  const std::string one = withKeys(kInAnObject);
  for (int i = 0; i < kNames / kInAnObject; ++i) text += (i == 0 ? "" : ",") + one;
  const auto many = parseJson(text + "]", {}, {.bytes = 100'000'000});
  ASSERT_TRUE(many) << many.error().message;
  EXPECT_EQ(std::ssize(*many), kNames / kInAnObject);
  const auto wide = parseJson(withKeys(kNames), {}, {.bytes = 100'000'000, .keys = kNames});
  ASSERT_TRUE(wide) << wide.error().message;
  EXPECT_EQ(std::ssize(*wide), kNames);
}

TEST(JsonText, HearsACancel) {
  constexpr int kValues = 8'000'000;
  std::string text = "[0";
  for (int i = 0; i < kValues; ++i) text += ",0";
  text += "?";  // whoever asks the token at the end alone has met this before
  RunContext context;
  std::jthread canceller([token = context.cancel] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    token.cancel();
  });
  const auto json = parseJson(text, context, {.values = 2 * kValues});
  ASSERT_FALSE(json);
  EXPECT_EQ(json.error().code, ErrorCode::Cancelled) << json.error().message;
}

}  // namespace
}  // namespace batten
