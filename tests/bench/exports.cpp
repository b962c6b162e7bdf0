// SPDX-License-Identifier: GPL-3.0-or-later
// Prints how long a thousand curves take to be written and read back in every format, and how well each holds them.
//
//   bench_exports [COUNT]

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/curve/knot_operations.h"
#include "core/exchange/export_file.h"

using namespace batten;

namespace {

/// Quintics of four spans, 40 to 120 mm long, each another one.
ExportDocument drawing(int count) {
  ExportDocument document;
  document.frame = {30000, 20000, 0.1};
  document.title = "bench";
  for (int n = 0; n < count; ++n) {
    std::vector<Vec2> points;
    std::vector<double> knots(6, 0.0);
    for (int i = 0; i < 9; ++i) {
      const double x = 5.0 + 9.0 * i + 0.01 * n;
      points.emplace_back(x + 100.0 * (n % 25), 40.0 * (n / 25) + 8.0 * std::sin(0.07 * x + n) + 0.02 * x * (n % 5));
    }
    knots.insert(knots.end(), {20.0, 40.0, 60.0});
    knots.insert(knots.end(), 6, 80.0);
    auto curve = NurbsCurve::make(5, std::move(knots), std::move(points));
    if (!curve) std::abort();
    document.curves.push_back({"curve-" + std::to_string(n + 1), false, {{std::move(*curve)}}});
  }
  return document;
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::max(1, std::atoi(argv[1])) : 1000;
  const ExportDocument document = drawing(count);
  std::printf("%d curves, written and read back\n%-14s %8s %10s  %s\n", count, "for", "ms", "KiB", "check");
  for (const ExportPreset& preset : exportPresets()) {
    const auto begin = std::chrono::steady_clock::now();
    const auto file = exportedFile(document, preset.settings);
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    if (!file) {
      std::printf("%-14s %8.0f %10s  %s\n", preset.id, ms, "-", file.error().message.c_str());
      continue;
    }
    std::printf("%-14s %8.0f %10zu  %s\n", preset.id, ms, file->bytes.size() / 1024, sentenceOf(file->report).c_str());
  }
  return 0;
}
