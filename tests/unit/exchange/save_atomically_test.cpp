// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/exchange/picture.h"
#include "core/exchange/save_atomically.h"

namespace batten {
namespace {

namespace fs = std::filesystem;

class SaveAtomically : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("batten-save-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  static std::string read(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  std::size_t filesInFolder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  fs::path folder_;
};

TEST_F(SaveAtomically, WritesAndReplacesWithoutLeftovers) {
  const fs::path file = folder_ / "höhe Ä 漢.svg";
  ASSERT_TRUE(saveAtomically(file, "one"));
  ASSERT_TRUE(saveAtomically(file, std::string("tw\0o", 4)));
  EXPECT_EQ(read(file), std::string("tw\0o", 4));
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(SaveAtomically, SaysWhatIsWrongWithThePlace) {
  const auto missing = saveAtomically(folder_ / "no" / "a.svg", "x");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::CannotWrite);
  EXPECT_NE(missing.error().message.find("does not exist"), std::string::npos);
  EXPECT_NE(saveAtomically(folder_, "x").error().message.find("folder"), std::string::npos);
  EXPECT_FALSE(saveAtomically("", "x"));
  EXPECT_FALSE(saveAtomically("/dev/full", "x"));
  EXPECT_NE(saveAtomically(folder_ / std::string(300, 'a'), "x").error().message.find("name is too long"),
            std::string::npos);
}

TEST_F(SaveAtomically, ADiskThatTakesNoMoreKeepsTheOldFile) {
  const fs::path file = folder_ / "a.svg";
  ASSERT_TRUE(saveAtomically(file, "old"));
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{4096, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const auto result = saveAtomically(file, std::string(100000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::CannotWrite);
  EXPECT_EQ(read(file), "old");
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST(Picture, DrawsLinesAndEncodesPng) {
  Picture picture(40, 20);
  const PictureLine line{{{2.5, 10.5}, {37.5, 10.5}}, false, {255, 0, 0}, 1.0};
  drawLines(picture, {&line, 1});
  const auto pixel = [&](int x, int y) { return picture.rgb[3 * static_cast<std::size_t>(40 * y + x) + 1]; };
  EXPECT_EQ(pixel(20, 10), 0);  // a line of one pixel through the pixel's centre covers exactly that row
  EXPECT_EQ(pixel(20, 9), 255);
  EXPECT_EQ(pixel(20, 11), 255);
  const auto png = encodePng(picture);
  ASSERT_TRUE(png);
  EXPECT_EQ(png->substr(1, 3), "PNG");
  EXPECT_FALSE(encodePng(Picture(0, 0)));
}

}  // namespace
}  // namespace batten
