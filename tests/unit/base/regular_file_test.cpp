// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/regular_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

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

// Opening alone may do something to a device.
TEST_F(RegularFiles, NothingElseIsEvenOpened) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int watch = inotify_init1(IN_NONBLOCK);
  ASSERT_GE(inotify_add_watch(watch, pipe.c_str(), IN_OPEN), 0);
  const auto isOpened = [&] {
    std::array<char, 4096> events{};
    return ::read(watch, events.data(), events.size()) > 0;
  };
  EXPECT_EQ(readWhole(pipe, 100).error(), FileProblem::NotOrdinary);
  EXPECT_FALSE(isOpened());
  close(open(pipe.c_str(), O_RDONLY | O_NONBLOCK));
  EXPECT_TRUE(isOpened()) << "the watch would have told of it";
  close(watch);
}

TEST_F(RegularFiles, ANameThatBecomesAPipeAfterTheLookAtItIsRefusedOnceItIsOpen) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kHangs = std::chrono::seconds(10), kLong = std::chrono::seconds(1);
  const fs::path file = with("file", "here"), pipe = folder_ / "pipe", name = folder_ / "name", next = folder_ / "next";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  fs::create_hard_link(file, name);
  std::atomic<bool> isOver{false}, hasWaited{false};
  std::atomic<int> reads{0};
  std::thread swapping([&] {
    auto since = Clock::now();
    int seen = 0;
    for (bool isPipe = true; !isOver; isPipe = !isPipe) {
      fs::create_hard_link(isPipe ? pipe : file, next);
      fs::rename(next, name);
      if (seen != reads) {
        seen = reads;
        since = Clock::now();
      } else if (Clock::now() - since > kHangs) {
        hasWaited = true;
        close(open(pipe.c_str(), O_RDWR));  // lets a reader go that waits for a writer
      }
    }
  });
  int wrong = 0;
  for (const auto begin = Clock::now(); Clock::now() - begin < kLong && !hasWaited; ++reads) {
    const auto text = readWhole(name, 100);
    wrong += (text ? *text == "here" : text.error() == FileProblem::NotOrdinary) ? 0 : 1;
  }
  isOver = true;
  swapping.join();
  EXPECT_FALSE(hasWaited);
  EXPECT_EQ(wrong, 0) << "of " << reads << " looks";
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
