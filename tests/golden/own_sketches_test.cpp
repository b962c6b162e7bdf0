// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/curve/arc_length.h"
#include "core/image/file/scan_reader.h"
#include "core/pipeline/run/pipeline.h"

/// \file
/// Traces every .png and .jpg in the folder BATTEN_SKETCHES as it is: no truth is known of a sketch of one's own, but
/// its curves must lie on its ink.

namespace batten {
namespace {

constexpr double kNearPx = 2.0, kLeastShare = 0.95;

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

bool isNearInk(const BitImage& ink, const Vec2& at) {
  const int reach = static_cast<int>(std::ceil(kNearPx)) + 1;
  const int cx = static_cast<int>(std::floor(at.x())), cy = static_cast<int>(std::floor(at.y()));
  for (int y = std::max(0, cy - reach); y <= std::min(ink.height - 1, cy + reach); ++y) {
    for (int x = std::max(0, cx - reach); x <= std::min(ink.width - 1, cx + reach); ++x) {
      if (ink.at(x, y) && (Vec2(x + 0.5, y + 0.5) - at).norm() <= kNearPx + 0.5) return true;
    }
  }
  return false;
}

/// Part of a curve that lies within 2 px of the ink before any filter has thinned or filled it.
double shareOnInk(const PipelineOutput& out, const NurbsCurve& curve) {
  const double length = out.frame.lengthToImage(ArcLength(curve).total());
  const auto samples = sampleByArcLength(curve, std::max(20, static_cast<int>(length)));
  const auto near = std::count_if(samples.begin(), samples.end(), [&](const CurveSample& s) {
    return isNearInk(*out.binary, out.frame.pointToImage(s.point));
  });
  return static_cast<double>(near) / static_cast<double>(samples.size());
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
    for (std::size_t i = 0; i < out.faired->curves.size(); ++i)
      EXPECT_GT(shareOnInk(out, out.faired->curves[i].faired), kLeastShare) << file << ", curve " << i + 1;
  }
}

}  // namespace
}  // namespace batten
