// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a scan: refused with a reason, or a picture that the image stages take.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/image/bits/laplacian_edges.h"
#include "core/image/bits/neighbourhood_filter.h"
#include "core/image/file/scan_reader.h"
#include "core/image/threshold/binarize.h"
#include "core/image/threshold/region_thresholds.h"

namespace {

constexpr std::uint64_t kMemoryBytes = std::uint64_t{64} << 20;
constexpr int kSmallSide = 200;  // [px] larger pages would take the time of many inputs

void runStages(const batten::GreyImage& grey) {
  const batten::RunContext context;
  const auto thresholds = batten::findThresholds(grey, {}, {}, context);
  if (!thresholds) return;
  const auto ink = batten::binarize(grey, *thresholds, {}, context);
  if (!ink) return;
  const auto filtered = batten::neighbourhoodFilter(*ink, {}, context);
  if (filtered) (void)batten::laplacianEdges(filtered->ink, context);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int kFile = memfd_create("scan", 0);
  if (kFile < 0 || ftruncate(kFile, 0) != 0) std::abort();
  if (pwrite(kFile, data, size, 0) != static_cast<ssize_t>(size)) std::abort();
  const std::string path = "/proc/self/fd/" + std::to_string(kFile);
  (void)batten::probeScan(path);
  const auto scan = batten::readScan(path, {.memoryBytes = kMemoryBytes}, {});
  if (!scan) {
    if (scan.error().message.empty()) std::abort();
    return 0;
  }
  const batten::GreyImage& grey = scan->grey;
  if (grey.width <= 0 || grey.height <= 0) std::abort();
  if (grey.width <= kSmallSide && grey.height <= kSmallSide) runStages(grey);
  return 0;
}
