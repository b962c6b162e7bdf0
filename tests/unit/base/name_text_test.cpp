// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/name_text.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/shown_text.h"

namespace batten {
namespace {

TEST(NameText, TextStaysAsItIs) {
  for (const std::string name : {"", "plain.svg", "höhe 漢 😀", "C:\\new\\x", "a\\x4", "a\\x41", "tail\\"}) {
    EXPECT_EQ(nameText(name), name);
    EXPECT_EQ(nameOfText(name), name);
  }
}

TEST(NameText, StrayBytesHaveAForm) {
  EXPECT_EQ(nameText("Entw\xfcrfe"), "Entw\\xfcrfe");
  EXPECT_EQ(nameText("\xe6\xbc"), "\\xe6\\xbc");   // cut short
  EXPECT_EQ(nameText("\\xff"), "\\x5cxff");        // a name that looks like the form
  EXPECT_EQ(nameText("\\x5cxff"), "\\x5cx5cxff");  // and one that looks like that
  EXPECT_EQ(nameOfText("Entw\\xfcrfe"), "Entw\xfcrfe");
  EXPECT_EQ(nameOfText("\\x5cxff"), "\\xff");
  EXPECT_EQ(nameOfText("\\xFF"), "\\xFF");  // small digits alone
}

/// All names of up to five of the bytes that matter: none is lost, no two become one, all are text.
TEST(NameText, NamesStayApart) {
  const std::string bytes = "\\x5cf\xff\xc3\xbc";
  std::set<std::string> texts;
  std::vector<std::string> names{""};
  for (std::size_t at = 0; at < names.size(); ++at) {
    const std::string name = names[at], text = nameText(name);
    EXPECT_EQ(nameOfText(text), name);
    EXPECT_TRUE(texts.insert(text).second) << text;
    for (std::string_view rest = text; !rest.empty(); rest.remove_prefix(characterBytes(rest)))
      ASSERT_GT(characterBytes(rest), 0u) << text;
    if (name.size() == 5) continue;
    for (const char byte : bytes) names.push_back(name + byte);
  }
  EXPECT_EQ(texts.size(), names.size());
}

}  // namespace
}  // namespace batten
