// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/exchange/picture.h"
#include "tests/support/render_page.h"

namespace batten::test {

inline std::string readFile(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

struct Outcome {
  int code = -1;  ///< Exit code; -1 if the program crashed.
  std::string out, err;
};

/// A folder of its own for every test, and the program.
class Program : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("batten-cli-" + std::to_string(getpid()) + "-" + std::string(info->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(file(name), std::ios::binary) << bytes;
  }
  /// Runs the program with these words; words with blanks are to be quoted for the shell.
  Outcome run(const std::string& words) const { return runProgram(BATTEN_CLI, words); }
  /// The same of the program in another place.
  Outcome runProgram(const std::string& program, const std::string& words) const {
    const std::string command =
        "'" + program + "' " + words + " >'" + file("out.txt") + "' 2>'" + file("err.txt") + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(file("out.txt")), readFile(file("err.txt"))};
  }
  /// Runs the program with stdout going where `redirection` says, e.g. ">/dev/full".
  Outcome runInto(const std::string& redirection, const std::string& words) const {
    const std::string command =
        std::string("'" BATTEN_CLI "' ") + words + " " + redirection + " 2>'" + file("err.txt") + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", readFile(file("err.txt"))};
  }
  void expectError(const std::string& words, int code, const std::string& says) const {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, code) << words << "\n" << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(says), std::string::npos) << words << "\n" << outcome.err;
    EXPECT_EQ(outcome.out, "") << words;
  }

  static std::string pngOf(const GreyImage& grey) {
    Picture picture(grey.width, grey.height);
    for (int y = 0; y < grey.height; ++y) {
      for (int x = 0; x < grey.width; ++x) {
        const auto v = static_cast<std::uint8_t>(grey.row(y)[x] / 257);
        picture.set(x, y, {v, v, v});
      }
    }
    return encodePng(picture).value();
  }
  /// A rendered shape, filled, as scan.png in the folder. Its truth is truthShape(name, 480, 320).
  std::string scene(const std::string& shape = "ellipse") const {
    const auto truth = truthShape(shape, 480, 320);
    const Scan scan = renderPage(fillCoverage(truth.outline(), 480, 320), 480, 320, scannedPage(3));
    write("scan.png", pngOf(scan.grey));
    return file("scan.png");
  }

  std::filesystem::path folder_;
};

}  // namespace batten::test
