// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/shown_text.h"

#include <gtest/gtest.h>

namespace batten {
namespace {

TEST(ShownText, LeavesWhatIsTextAlone) {
  for (const std::string text : {"", "plain.svg", "höhe Ä 漢 😀",
                                 "a\xc2\xa0"
                                 "b",
                                 "\xed\x9f\xbf", "\xf4\x8f\xbf\xbd"})
    EXPECT_EQ(shownText(text), text);
}

TEST(ShownText, ControlCharactersAndBrokenBytesBecomeQuestionMarks) {
  EXPECT_EQ(shownText("a\x1b[31mb\r\nc\x7f"), "a?[31mb??c?");
  EXPECT_EQ(shownText("\xc2\x9b"
                      "31m"),
            "?31m");                                                        // the one-character escape of C1
  EXPECT_EQ(shownText("\xff.svg"), "?.svg");                                // no UTF-8 at all
  EXPECT_EQ(shownText("Entw\xfcrfe"), "Entw?rfe");                          // Latin-1
  EXPECT_EQ(shownText("\xc0\xaf"), "??");                                   // a slash in too many bytes
  EXPECT_EQ(shownText("\xed\xa0\x80"), "???");                              // half a surrogate pair
  EXPECT_EQ(shownText("\xf4\x90\x80\x80"), "????");                         // beyond the last character
  EXPECT_EQ(shownText("\xe6\xbc"), "??");                                   // cut short
  EXPECT_EQ(shownText("\xe2\x80\xaegnp.scan"), "?gnp.scan");                // would be read from right to left
  EXPECT_EQ(shownText("\xe2\x80\xa8|\xef\xbf\xbf|\xef\xbf\xbe"), "?|?|?");  // no XML allows the last two
  EXPECT_EQ(shownText(std::string_view("a\0b", 3)), "a?b");
}

TEST(ShownText, SpacesWithoutWidthDoNotHide) {
  EXPECT_EQ(shownText("a\xe2\x80\x8b|\xe2\x81\xa0|\xef\xbb\xbf|\xe2\x80\x8f"), "a?|?|?|?");
  EXPECT_EQ(shownText("\xe2\x80\x8d"), "\xe2\x80\x8d") << "a joiner of letters";
}

TEST(ShownText, QuotesAreShort) {
  EXPECT_EQ(quotedText(""), "\"\"");
  EXPECT_EQ(quotedText("a\x1b[31m"), "\"a?[31m\"");
  EXPECT_EQ(quotedText(std::string(80, 'n')), "\"" + std::string(80, 'n') + "\"");
  EXPECT_EQ(quotedText(std::string(81, 'n')), "\"" + std::string(80, 'n') + "…\"");
  EXPECT_EQ(quotedText(std::string(79, 'n') + "ä"), "\"" + std::string(79, 'n') + "…\"") << "no half of a character";
}

TEST(ShownText, JsonKeepsItsValueWithoutControls) {
  EXPECT_EQ(shownJson("{\n\"a\":\"ä\x7f\xc2\x9b\"}"), "{\n\"a\":\"ä\\u007f\\u009b\"}");
  EXPECT_EQ(shownJson("\xc2\xa0"), "\xc2\xa0");
  EXPECT_EQ(shownJson("\xe2\x80\xae|\xf0\x9f\xbf\xbe"), "\\u202e|\\ud83f\\udffe");
}

}  // namespace
}  // namespace batten
