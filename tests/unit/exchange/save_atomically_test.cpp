// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/save_atomically.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/exchange/model/scratch_file.h"
#include "core/exchange/picture.h"

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
  std::size_t filesInFolder() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }
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

TEST_F(SaveAtomically, ANameIsItsBytes) {
  // Three names that a program which takes them for UTF-8 cannot tell apart.
  for (const char* name : {"\xff.svg", "\xfe.svg", "\xef\xbf\xbd.svg"})
    ASSERT_TRUE(saveAtomically(folder_ / name, name));
  for (const char* name : {"\xff.svg", "\xfe.svg", "\xef\xbf\xbd.svg"}) EXPECT_EQ(read(folder_ / name), name);
  EXPECT_EQ(filesInFolder(), 3u);
  fs::create_directory(folder_ / "Entw\xfcrfe");
  ASSERT_TRUE(saveAtomically(folder_ / "Entw\xfcrfe" / "a.svg", "x"));
  EXPECT_EQ(read(folder_ / "Entw\xfcrfe" / "a.svg"), "x");
  const auto wrong = saveAtomically(folder_ / "\x1b[31m\xff" / "a.svg", "x");
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find("/?[31m?/a.svg"), std::string::npos) << wrong.error().message;
}

TEST_F(SaveAtomically, FollowsLinksButNotRoundInACircle) {
  const fs::path file = folder_ / "real.svg";
  ASSERT_TRUE(saveAtomically(file, "old"));
  fs::create_directory(folder_ / "sub");
  fs::create_symlink("../real.svg", folder_ / "sub" / "near");
  fs::create_symlink(folder_ / "sub" / "near", folder_ / "far");
  ASSERT_TRUE(saveAtomically(folder_ / "far", "new"));
  EXPECT_EQ(read(file), "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "far"));
  EXPECT_EQ(saveTarget(folder_ / "far")->lexically_normal(), file);
  fs::create_symlink("not yet", folder_ / "dangling");
  ASSERT_TRUE(saveAtomically(folder_ / "dangling", "made"));
  EXPECT_EQ(read(folder_ / "not yet"), "made");
  fs::create_symlink("b", folder_ / "a");
  fs::create_symlink("a", folder_ / "b");
  EXPECT_FALSE(saveTarget(folder_ / "a"));
  const auto round = saveAtomically(folder_ / "a", "x");
  ASSERT_FALSE(round);
  EXPECT_NE(round.error().message.find("form a loop"), std::string::npos) << round.error().message;
  EXPECT_TRUE(fs::is_symlink(folder_ / "a"));
}

TEST_F(SaveAtomically, KeepsThePermissionsOfWhatItReplaces) {
  const fs::path file = folder_ / "a.svg";
  ASSERT_TRUE(saveAtomically(file, "old"));
  ASSERT_EQ(chmod(file.c_str(), 0640), 0);
  ASSERT_TRUE(saveAtomically(file, "new"));
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0640));
}

TEST_F(SaveAtomically, WhatAnEndedProgramLeftGoesAndWhatARunningOneWritesStays) {
  // A child that is killed while it saves leaves its file; the next save in that folder removes it.
  const fs::path target = folder_ / "a.svg";
  const auto handler = std::signal(SIGXFSZ, SIG_DFL);
  const pid_t child = fork();
  if (child == 0) {
    const rlimit none{0, 0};  // no core file either
    setrlimit(RLIMIT_CORE, &none);
    const rlimit small{4096, 4096};
    setrlimit(RLIMIT_FSIZE, &small);
    static_cast<void>(saveAtomically(target, std::string(100000, 'x')));  // the signal ends the program within
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  std::signal(SIGXFSZ, handler);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_EQ(filesInFolder(), 1u);
  const fs::path left = fs::directory_iterator(folder_)->path(), foreign = folder_ / ".batten-notes.saving";
  std::ofstream(foreign) << "half";
  const int running = open(left.c_str(), O_RDONLY);
  ASSERT_EQ(flock(running, LOCK_EX), 0);
  ASSERT_TRUE(saveAtomically(target, "x"));
  ASSERT_TRUE(saveAtomically(folder_ / "other.svg", "x"));
  EXPECT_TRUE(fs::exists(left)) << "a program writes it";
  close(running);
  ASSERT_TRUE(saveAtomically(folder_ / "other.svg", "x"));
  EXPECT_TRUE(fs::exists(left)) << "another machine may be saving it, whose locks are not seen here";
  fs::last_write_time(left, fs::file_time_type::clock::now() - std::chrono::hours(25));
  ASSERT_TRUE(saveAtomically(folder_ / "other.svg", "x"));
  EXPECT_FALSE(fs::exists(left)) << "also where another file is saved";
  std::ofstream(left) << "half";
  ASSERT_TRUE(saveAtomically(target, "x"));
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(foreign));
  std::ofstream(left) << "half";
  removeLeftoversOf(target);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_EQ(read(target), "x");
}

TEST_F(SaveAtomically, AWindowDoesNotWaitForALookThroughTheFolder) {
  const fs::path other = folder_ / ".batten-0123456789abcdef.saving";
  std::ofstream(other) << "half";
  fs::last_write_time(other, fs::file_time_type::clock::now() - std::chrono::hours(48));
  ASSERT_TRUE(saveAtomically(folder_ / "a.json", "x", Leftovers::OfThisFile));
  EXPECT_TRUE(fs::exists(other)) << "of another file";
  ASSERT_TRUE(saveAtomically(folder_ / "a.json", "x"));
  EXPECT_FALSE(fs::exists(other));
}

TEST_F(SaveAtomically, AFolderThatTakesNoFileIsKnownBeforehand) {
  const fs::path target = folder_ / "a.svg";
  ASSERT_TRUE(checkSaving(target));
  EXPECT_EQ(filesInFolder(), 0u) << "nothing is left of the check";
  std::ofstream(target) << "kept";
  ASSERT_TRUE(checkSaving(target));
  EXPECT_EQ(read(target), "kept");
  // A folder without permission; for the administrator, who may write anywhere else, one of the system.
  const fs::path locked = folder_ / "locked";
  fs::create_directory(locked);
  fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec);
  const bool isAdministrator = std::ofstream(locked / "probe").is_open();
  const auto checked = checkSaving((isAdministrator ? fs::path("/sys/kernel") : locked) / "a.svg");
  fs::permissions(locked, fs::perms::owner_all);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().code, ErrorCode::CannotWrite);
  EXPECT_NE(checked.error().message.find("Choose another place"), std::string::npos) << checked.error().message;
}

TEST_F(SaveAtomically, AScratchFileGoesWithItsObject) {
  std::string path;
  {
    const auto scratch = ScratchFile::create("abc");
    ASSERT_TRUE(scratch);
    path = scratch->path();
    EXPECT_EQ(read(path), "abc");
    std::ofstream(path) << "written by name";
    EXPECT_EQ(scratch->read(), "written by name");
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(Picture, DrawsLinesAndEncodesPng) {
  Picture picture(40, 20);
  const PictureLine line{{{2.5, 10.5}, {37.5, 10.5}}, false, {255, 0, 0}, 1.0};
  drawLines(picture, {&line, 1});
  const auto pixel = [&](int x, int y) { return picture.rgb[3 * (40 * y + x) + 1]; };
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
