// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/cli/program.h"

namespace batten::test {

namespace fs = std::filesystem;
using nlohmann::json;

/// Pages of an archive in the test's folder, and the lines that the program says of them.
class Batch : public Program {
 protected:
  /// A rendered shape as NAME.png.
  void drawPage(const std::string& name, const std::string& shape = "ellipse") const {
    const auto truth = truthShape(shape, 480, 320);
    const Scan scan = renderPage(fillCoverage(truth.outline(), 480, 320), 480, 320, scannedPage(3));
    write(name + ".png", pngOf(scan.grey));
  }
  std::string line(const std::string& name, const json& more = json::object()) const {
    json page{{"scan", file(name + ".png")}, {"outputs", {file(name + ".svg"), file(name + ".json")}}, {"dpi", 254}};
    page.update(more);
    return page.dump() + "\n";
  }
  static std::vector<json> linesOf(const std::string& text) {
    std::vector<json> lines;
    for (std::size_t from = 0; from < text.size();) {
      const auto end = text.find('\n', from);
      EXPECT_NE(end, std::string::npos) << "a torn line: " << text.substr(from);
      if (end == std::string::npos) break;
      lines.push_back(json::parse(text.substr(from, end - from)));
      from = end + 1;
    }
    return lines;
  }
  /// "NAME status" of each line, by the order of names.
  static std::multiset<std::string> statusesOf(const std::string& text) {
    std::multiset<std::string> statuses;
    for (const json& one : linesOf(text)) {
      statuses.insert(fs::path(one["scan"].get<std::string>()).stem().string() + " " +
                      one["status"].get<std::string>());
    }
    return statuses;
  }
  std::set<std::string> filesIn(const fs::path& folder) const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
    for (const char* own : {"out.txt", "err.txt"}) names.erase(own);
    return names;
  }
  using Statuses = std::multiset<std::string>;
};

/// Starts the program beside the test.
class Running {
 public:
  explicit Running(const std::vector<std::string>& words) {
    std::vector<char*> pointers;
    words_ = words;
    words_.insert(words_.begin(), BATTEN_CLI);
    for (std::string& word : words_) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    id_ = fork();
    if (id_ == 0) {
      setpgid(0, 0);
      execv(pointers.front(), pointers.data());
      _exit(127);
    }
  }
  void send(int signal) const { kill(id_, signal); }
  /// To the program and all that it has started.
  void sendToGroup(int signal) const { kill(-id_, signal); }
  int wait() const {
    int status = 0;
    waitpid(id_, &status, 0);
    return status;
  }
  /// Of the processors, in all its threads.
  double processorSeconds() const {
    std::istringstream stat(readFile("/proc/" + std::to_string(id_) + "/stat"));
    std::string word;
    for (int field = 1; field < kUserTicksField; ++field) stat >> word;
    double user = 0.0, system = 0.0;
    stat >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }
  /// Whether it has not taken the signal yet.
  bool isPending(int signal) const {
    std::istringstream status(readFile("/proc/" + std::to_string(id_) + "/status"));
    std::string word;
    while (status >> word && word != "ShdPnd:") {
    }
    std::uint64_t pending = 0;
    status >> std::hex >> pending;
    return ((pending >> (signal - 1)) & 1) != 0;
  }

 private:
  static constexpr int kUserTicksField = 14;  // of proc(5), from 1
  std::vector<std::string> words_;
  pid_t id_ = -1;
};

inline bool waitUntil(const std::function<bool()>& done) {
  for (int i = 0; i < 6000; ++i) {
    if (done()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

inline std::ptrdiff_t linesIn(const std::string& file) {
  const std::string text = readFile(file);
  return std::count(text.begin(), text.end(), '\n');
}

}  // namespace batten::test
