// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/regular_file.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

namespace batten {
namespace {

namespace fs = std::filesystem;

class RegularFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("batten-files-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path with(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  fs::path folder_;
};

TEST_F(RegularFiles, AreReadWhole) {
  const std::string bytes("a\0b\n\xff", 5);
  EXPECT_EQ(readWhole(with("a", bytes), 5).value(), bytes);
  EXPECT_EQ(readWhole(with("empty", ""), 0).value(), "");
  const fs::path odd = with("\xff\x01 odd", "here");  // any bytes but / make a name
  EXPECT_EQ(readWhole(odd, 100).value(), "here");
  fs::create_symlink(odd, folder_ / "link");
  EXPECT_EQ(readWhole(folder_ / "link", 100).value(), "here");
}

TEST_F(RegularFiles, NothingElseIsAndNothingWaits) {
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink(folder_ / "pipe", folder_ / "to-pipe");
  fs::create_symlink("/dev/zero", folder_ / "to-zero");
  fs::create_symlink("round", folder_ / "round");
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  (folder_ / "socket").string().copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  for (const char* name : {"pipe", "to-pipe", "to-zero", "socket"})
    EXPECT_EQ(readWhole(folder_ / name, 100).error(), FileProblem::NotOrdinary) << name;
  EXPECT_EQ(readWhole("/dev/tty", 100).error(), FileProblem::NotOrdinary);
  EXPECT_EQ(readWhole(folder_, 100).error(), FileProblem::Folder);
  for (const char* name : {"none", "none/deeper"})
    EXPECT_EQ(readWhole(folder_ / name, 100).error(), FileProblem::Missing) << name;
  EXPECT_EQ(readWhole(folder_ / "round", 100).error(), FileProblem::LinksInCircle);
  close(socket);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

TEST_F(RegularFiles, AreOfSensibleSize) {
  const fs::path file = with("large", std::string(101, 'x'));
  EXPECT_EQ(readWhole(file, 100).error(), FileProblem::TooLarge);
  fs::resize_file(file, std::uintmax_t{1} << 40);  // a hole of a terabyte
  EXPECT_EQ(readWhole(file, 100).error(), FileProblem::TooLarge);
}

TEST_F(RegularFiles, AFileThatShrinksWhileItIsReadIsBroken) {
  const fs::path path = with("shrinks", "twelve bytes");
  const auto file = RegularFile::open(path);
  ASSERT_TRUE(file);
  fs::resize_file(path, 3);
  std::string bytes(file->size(), ' ');
  const auto read = file->read(std::as_writable_bytes(std::span(bytes)));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error(), FileProblem::Broken);
}

}  // namespace
}  // namespace batten
