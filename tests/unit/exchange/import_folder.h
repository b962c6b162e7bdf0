// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <string>

#include "core/exchange/export_file.h"
#include "core/exchange/import_file.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten::test {

/// Files read from a folder of their own, with letters of several scripts in its name.
class Import : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("batten Süße 漢字 " + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  ImportReport read(const std::string& name, const std::string& bytes, std::optional<double> unit = {}) const {
    auto report = readImportFile(write(name, bytes), unit);
    EXPECT_TRUE(report) << report.error().message;
    return report ? *report : ImportReport{};
  }
  std::string refusal(const std::string& name, const std::string& bytes) const {
    const auto report = readImportFile(write(name, bytes));
    if (report) return "read";
    EXPECT_EQ(report.error().message.find('\n'), std::string::npos);
    return report.error().message;
  }
  std::filesystem::path folder_;
};

/// Cut off, with bits turned, and made of nothing: never a crash, and a message where it is refused.
template <class Read>
void damage(const std::string& whole, const Read& read, std::size_t step) {
  for (std::size_t length = 0; length < whole.size(); length += step) (void)read(whole.substr(0, length));
  std::mt19937 random(11);
  for (int round = 0; round < 300; ++round) {
    std::string text = whole;
    for (int flips = 0; flips < 1 + round % 20; ++flips) {
      char& byte = text[random() % text.size()];
      byte = static_cast<char>(byte ^ (1 << (random() % 8)));
    }
    const auto result = read(text);
    if (!result) {
      EXPECT_FALSE(result.error().message.empty());
    }
  }
}

/// What Batten itself writes to a file of this ending.
inline std::string exported(const char* ending) {
  ExportSettings settings;
  settings.format = *formatOf(std::string("a") + ending);
  const auto file = exportedFile(exportOfAllDegrees(), settings);
  EXPECT_TRUE(file) << file.error().message;
  return file ? file->bytes : "";
}

}  // namespace batten::test
