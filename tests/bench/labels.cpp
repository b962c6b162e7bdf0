// SPDX-License-Identifier: GPL-3.0-or-later
// Rendered pages of which every pixel is known to be of a stroke or of a shape: how much of the ink gets the right
// label, how many objects do, and how long it takes.
//
//   bench_labels [SEEDS] [FIRST_SEED] [FOLDER_FOR_PICTURES]
//   bench_labels DRAWINGS FOLDER_FOR_PICTURES
//
// The second form paints the labels of the drawings of a folder (strokes blue, shapes orange), to be looked at.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "core/contour/label/ink_labels.h"
#include "core/image/file/scan_reader.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/label_page.h"

using namespace batten;

namespace {

// Strokes blue, shapes orange.
void savePicture(const std::string& path, const InkLabels& labels) {
  cv::Mat picture(labels.strokes.height, labels.strokes.width, CV_8UC3, cv::Scalar(255, 255, 255));
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      if (labels.strokes.at(x, y)) picture.at<cv::Vec3b>(y, x) = {200, 80, 20};
      if (labels.shapes.at(x, y)) picture.at<cv::Vec3b>(y, x) = {20, 120, 250};
    }
  }
  cv::imwrite(path, picture);
}

int paintDrawings(const std::filesystem::path& folder, const std::filesystem::path& pictures) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".png" || ending == ".jpg" || ending == ".tif" || ending == ".pgm") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::filesystem::create_directories(pictures);
  for (const auto& file : files) {
    const auto scan = readScan(file, {}, {});
    if (!scan) continue;
    StageCache cache;
    PipelineRequest request;
    request.upTo = StageId::Filtered;
    const PipelineOutput out = runPipeline(*scan, {}, cache, request, {});
    if (!out.filtered) continue;
    const auto begin = std::chrono::steady_clock::now();
    const auto labels = labelInk(out.filtered->ink, {});
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    if (!labels) continue;
    const double shapes = static_cast<double>(labels->shapes.count()),
                 strokes = static_cast<double>(labels->strokes.count());
    std::printf("%-30s pen %5.2f px  shapes %5.1f %%  %7.0f ms\n", file.filename().c_str(), labels->penPx.value_or(0.0),
                100.0 * shapes / std::max(1.0, shapes + strokes), ms);
    savePicture((pictures / (file.stem().string() + "-labels.png")).string(), *labels);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2 && std::filesystem::is_directory(argv[1])) return paintDrawings(argv[1], argv[2]);
  const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 3;
  const unsigned first = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 10u;
  std::printf("%-8s %9s %9s %9s %9s %9s\n", "page", "balanced", "strokes", "shapes", "objects", "ms");
  double mean = 0.0;
  const auto scenes = test::labelScenes();
  for (const test::LabelScene& scene : scenes) {
    double balanced = 0.0, strokes = 0.0, shapes = 0.0, objects = 0.0, ms = 0.0;
    for (unsigned seed = first; seed < first + static_cast<unsigned>(seeds); ++seed) {
      const test::LabelPage page = scene.make(seed);
      const BitImage ink = page.ink(seed);
      const auto begin = std::chrono::steady_clock::now();
      const auto labels = labelInk(ink, {});
      ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
      if (!labels) {
        std::printf("%s: %s\n", scene.name.c_str(), labels.error().message.c_str());
        return 1;
      }
      const test::LabelPage::Score score = page.score(ink, labels->shapes);
      balanced += score.balanced() / seeds;
      strokes += score.strokes / seeds;
      shapes += score.shapes / seeds;
      objects += score.objects / seeds;
      if (argc > 3) savePicture(std::string(argv[3]) + "/" + scene.name + "-" + std::to_string(seed) + ".png", *labels);
    }
    mean += balanced / static_cast<double>(scenes.size());
    std::printf("%-8s %9.3f %9.3f %9.3f %9.3f %9.1f\n", scene.name.c_str(), balanced, strokes, shapes, objects,
                ms / seeds);
  }
  std::printf("%-8s %9.3f\n", "mean", mean);
  return 0;
}
