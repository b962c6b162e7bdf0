// SPDX-License-Identifier: GPL-3.0-or-later
// Prints how far the ends of curves lie from the ends of strokes that are known, default settings.
//
//   bench_ends [--seeds N]
//
// Twelve strokes a page (24 ends), cut off square or skewed by 25 degrees, with round caps, or thinning to nothing over
// eight widths (24 to 72 px). Short: along the stroke, positive where the curve leaves off too early; median, and the
// 5 and 95 % of all ends. Aside: across the stroke, 95 %. An end without a curve end within 40 px is lost.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/pipeline/run/pipeline.h"
#include "tests/support/end_page.h"
#include "tests/support/render_page.h"

using namespace batten;
using namespace batten::test;

namespace {

constexpr double kLostPx = 40.0;

struct EndErrors {
  std::vector<double> shortPx, asidePx;
  int lost = 0, curves = 0, pages = 0;
};

std::vector<Vec2> curveEnds(const PipelineOutput& output) {
  std::vector<Vec2> ends;
  if (!output.faired) return ends;
  for (const TracedCurve& curve : output.faired->curves) {
    if (curve.closed) continue;
    ends.push_back(output.frame.pointToImage(curve.sketched.point(curve.sketched.start())));
    ends.push_back(output.frame.pointToImage(curve.sketched.point(curve.sketched.end())));
  }
  return ends;
}

void add(EndErrors& errors, const EndPage& page, const PageStyle& style) {
  const Scan scan = renderPage(page.coverage, page.width, page.height, style);
  StageCache cache;
  const PipelineOutput output = runPipeline(scan, Recipe{}, cache, {}, {});
  const std::vector<Vec2> found = curveEnds(output);
  errors.curves += static_cast<int>(found.size() / 2);
  ++errors.pages;
  for (const EndTruth& truth : page.ends) {
    Vec2 off = Vec2::Constant(std::numeric_limits<double>::infinity());
    for (const Vec2& at : found) {
      if ((truth.at - at).norm() < off.norm()) off = truth.at - at;
    }
    if (!(off.norm() < kLostPx)) {
      ++errors.lost;
      continue;
    }
    errors.shortPx.push_back(off.dot(truth.out));
    errors.asidePx.push_back(std::abs(off.x() * truth.out.y() - off.y() * truth.out.x()));
  }
}

double ranked(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::lround(share * static_cast<double>(values.size() - 1))];
}

}  // namespace

int main(int argc, char** argv) {
  int seeds = 2;
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::string(argv[i]) == "--seeds") seeds = std::max(1, std::atoi(argv[i + 1]));
  }
  const std::pair<StrokeEnd, const char*> kinds[] = {{StrokeEnd::Butt, "square"},
                                                     {StrokeEnd::Skewed, "skewed"},
                                                     {StrokeEnd::Round, "round"},
                                                     {StrokeEnd::Taper, "taper"}};
  std::printf("%-8s %5s %-6s %8s %8s %8s %8s %5s %7s\n", "end", "width", "page", "short", "5 %", "95 %", "aside",
              "lost", "curves");
  for (const auto& [kind, name] : kinds) {
    for (const double width : {2.0, 3.0, 5.0, 8.0, 12.0}) {
      const EndPage page = endPage(kind, width);
      for (const std::string style : {"clean", "scan", "blurred"}) {
        EndErrors errors;
        for (int seed = 1; seed <= (style == "clean" ? 1 : seeds); ++seed) {
          const auto number = static_cast<std::uint32_t>(seed);
          add(errors, page,
              style == "clean"  ? cleanPage()
              : style == "scan" ? scannedPage(number)
                                : gradatedPage(number));
        }
        std::printf("%-8s %5.0f %-8s %6.2f %8.2f %8.2f %8.2f %5d %4d/%d\n", name, width, style.c_str(),
                    ranked(errors.shortPx, 0.5), ranked(errors.shortPx, 0.05), ranked(errors.shortPx, 0.95),
                    ranked(errors.asidePx, 0.95), errors.lost, errors.curves, 12 * errors.pages);
        std::fflush(stdout);
      }
    }
  }
  return 0;
}
