// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "core/document/explain/explanation.h"
#include "core/image/file/scan_reader.h"
#include "core/pipeline/run/pipeline.h"

/// \file
/// Traces every .png and .jpg in the folder BATTEN_SKETCHES as it is: no truth is known of a sketch of one's own, but
/// its curves must lie on ink, but for bridges.

namespace batten {
namespace {

std::vector<std::filesystem::path> sketches(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::string extension = entry.path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    if (extension == ".png" || extension == ".jpg") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(OwnSketches, CurvesLieOnTheInk) {
  const char* folder = std::getenv("BATTEN_SKETCHES");
  if (folder == nullptr || *folder == '\0') GTEST_SKIP() << "BATTEN_SKETCHES names no folder of scans";
  ASSERT_TRUE(std::filesystem::is_directory(folder)) << folder;
  const auto files = sketches(folder);
  EXPECT_FALSE(files.empty()) << "no .png or .jpg in " << folder;
  for (const std::filesystem::path& file : files) {
    const auto scan = readScan(file, {}, {});
    if (!scan) {
      ADD_FAILURE() << scan.error().message;
      continue;
    }
    StageCache cache;
    const PipelineOutput out = runPipeline(*scan, {}, cache, {}, {});
    EXPECT_FALSE(out.error) << file << ": " << out.error->message;
    if (!out.faired) continue;
    for (const Error& failure : out.constructed->failures) ADD_FAILURE() << file << ": " << failure.message;
    const auto explanation = explainPage(*scan, {}, out, {});
    ASSERT_TRUE(explanation) << file << ": " << explanation.error().message;
    EXPECT_LE(explanation->invented, kMostInvented) << file;
  }
}

}  // namespace
}  // namespace batten
