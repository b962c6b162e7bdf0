// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "tests/cli/program.h"

namespace batten {
namespace {

using BadInput = test::Program;

std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char c : bytes) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (0xedb88320u & (0u - (crc & 1u)));
  }
  return ~crc;
}

std::string bigEndian(std::uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8), static_cast<char>(v)};
}

/// A valid PNG head that promises a size, and nothing behind it.
std::string pngHead(std::uint32_t width, std::uint32_t height) {
  const std::string chunk = "IHDR" + bigEndian(width) + bigEndian(height) + std::string("\x08\x00\x00\x00\x00", 5);
  return "\x89PNG\r\n\x1a\n" + bigEndian(13) + chunk + bigEndian(crc32(chunk));
}

TEST_F(BadInput, FilesThatAreNoScanGiveThree) {
  const std::string out = " -o " + file("o.svg");
  const std::string good = test::readFile(scene());
  expectError("trace " + file("missing.png") + out, 3, "missing.png");
  expectError("trace " + folder_.string() + out, 3, "");
  write("empty.png", "");
  expectError("trace " + file("empty.png") + out, 3, "empty");
  write("text.png", "This is a letter, not a picture.\n");
  expectError("trace " + file("text.png") + out, 3, "");
  for (const std::size_t length : {std::size_t{4}, std::size_t{20}, std::size_t{40}, good.size() / 2}) {
    write("cut.png", good.substr(0, length));
    expectError("trace " + file("cut.png") + out, 3, "");
  }
  write("huge.png", pngHead(30000, 30000));
  expectError("trace " + file("huge.png") + out, 3, "");
  write("absurd.png", pngHead(0x7fffffff, 0x7fffffff));
  expectError("trace " + file("absurd.png") + out, 3, "");
  EXPECT_FALSE(std::filesystem::exists(file("o.svg")));
}

TEST_F(BadInput, PicturesWithoutALineGiveFour) {
  const std::string out = " -o " + file("o.svg");
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 7}, {200, 150}}) {
    write("white.png", pngOf(GreyImage(width, height, 65535)));
    expectError("trace " + file("white.png") + out, 4, "");
    write("black.png", pngOf(GreyImage(width, height, 0)));
    expectError("trace " + file("black.png") + out, 4, "");
  }
  EXPECT_FALSE(std::filesystem::exists(file("o.svg")));
}

TEST_F(BadInput, WithoutACurveReportAndDumpsStillShowWhy) {
  write("white.png", pngOf(GreyImage(200, 150, 65535)));
  expectError("trace " + file("white.png") + " -o " + file("o.svg") + " --report " + file("r.json") +
                  " --dump log=" + file("l.png"),
              4, "");
  EXPECT_NE(test::readFile(file("r.json")).find("\"error\""), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(file("l.png")));
}

TEST_F(BadInput, WrongWordsGiveTwo) {
  const std::string start = "trace " + scene() + " -o " + file("o.svg") + " ";
  expectError("", 2, "subcommand");
  expectError("trace", 2, "");
  expectError("paint", 2, "");
  expectError("trace " + file("scan.png"), 2, "-o");
  expectError("trace " + file("scan.png") + " -o " + file("o.dwg"), 2, ".svg");
  expectError("trace " + file("scan.png") + " -o " + file("scan.png"), 2, "");
  expectError(start + "--unknown", 2, "--unknown");
  expectError(start + "-o " + file("o.svg"), 2, "twice");
  expectError(start + "--set filter.coefficient", 2, "value");
  expectError(start + "--set filter.coefficient=9", 2, "filter.coefficient");
  expectError(start + "--set filter.coeficient=2", 2, "filter.coefficient");
  expectError(start + "--corner 12", 2, "X,Y");
  expectError(start + "--corner a,b", 2, "X,Y");
  expectError(start + "--dpi -3", 2, "dpi");
  expectError(start + "--dpi nan", 2, "");
  expectError(start + "--threads -1", 2, "");
  expectError(start + "--dump nothing=" + file("a.png"), 2, "thresholds");
  expectError(start + "--dump log=" + file("a.jpg"), 2, ".png");
  expectError(start + "--recipe " + file("none.json"), 2, "none.json");
  write("broken.json", "{\"format\":\"batten-recipe\",");
  expectError(start + "--recipe " + file("broken.json"), 2, "damaged");
}

TEST_F(BadInput, PlacesThatTakeNoFileGiveFive) {
  const std::string scan = scene();
  expectError("trace " + scan + " -o " + file("no/such/o.svg"), 5, "does not exist");
  std::filesystem::create_directories(file("folder.svg"));
  expectError("trace " + scan + " -o " + file("folder.svg"), 5, "folder");
  expectError("trace " + scan + " -o " + file("o.svg") + " --report " + file("no/r.json"), 5, "does not exist");
}

}  // namespace
}  // namespace batten
