// SPDX-License-Identifier: GPL-3.0-or-later
// Prints which corners of strokes are found without a mark, and how far off, on rendered pages with default settings.
//
//   bench_stroke_corners [--radii] [--smooth]
//
// Zigzags drawn with round pens of 2 to 9 px, blurred by .8 and 1.5 px, noise 6; legs and, with --radii, what rounds
// the corners, in widths of the pen. For every turn in degrees: corners found within 1 px / found / drawn, F: corners 4
// px and more from every true one. --smooth: what is found on circles, ellipses and waves, by their smallest radius.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "core/base/angle.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/corner_page.h"

using namespace batten;
using namespace batten::test;

namespace {

constexpr double kNoise = 6.0, kNearPx = 1.0, kFalsePx = 4.0;

struct Score {
  int drawn = 0, found = 0, near = 0, wrong = 0;
  double square = 0.0;
};

Score scoreOf(const CornerPage& page, const Scan& scan) {
  StageCache cache;
  PipelineRequest request;
  request.upTo = StageId::Pieces;
  const PipelineOutput output = runPipeline(scan, Recipe{}, cache, request, {});
  Score score;
  score.drawn = static_cast<int>(page.corners.size());
  if (!output.pieces) return score;
  std::vector<double> nearest(page.corners.size(), std::numeric_limits<double>::infinity());
  for (const Corner& corner : output.pieces->corners) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < page.corners.size(); ++i) {
      const double d = (page.corners[i] - corner.positionPx).norm();
      nearest[i] = std::min(nearest[i], d);
      least = std::min(least, d);
    }
    if (least >= kFalsePx) ++score.wrong;
  }
  for (const double d : nearest) {
    if (!(d < kFalsePx)) continue;
    ++score.found;
    if (d < kNearPx) ++score.near;
    score.square += d * d;
  }
  return score;
}

void add(Score& all, const Score& one) {
  all.drawn += one.drawn, all.found += one.found, all.near += one.near, all.wrong += one.wrong;
  all.square += one.square;
}

void printSmooth(double blur, double width, Score& all) {
  for (const Smooth kind : {Smooth::Circle, Smooth::Ellipse, Smooth::Wave}) {
    std::printf("blur %.1f pen %.1f %-8s", blur, width,
                kind == Smooth::Circle    ? "circles"
                : kind == Smooth::Ellipse ? "ellipses"
                                          : "waves");
    for (const double radius : {1.0, 1.5, 2.0, 3.0, 5.0, 10.0}) {
      const CornerPage page = smoothPage(kind, radius * width, 1);
      const Score s = scoreOf(page, scanOfCorners(page, kind != Smooth::Wave, width, blur, kNoise, 1));
      std::printf("  r %g: %d", radius, s.wrong);
      add(all, s);
    }
    std::printf("\n");
  }
}

void printZigzags(double blur, double width, double leg, double radius, Score& all) {
  std::printf("blur %.1f pen %.1f legs %2.0f r %.1f", blur, width, leg, radius);
  for (const double turn : {30.0, 45.0, 60.0, 75.0, 90.0, 110.0, 130.0, 150.0}) {
    const CornerPage page = zigzagPage({turn * kRadPerDeg, leg * width, radius * width}, 1);
    const Score s = scoreOf(page, scanOfCorners(page, false, width, blur, kNoise, 1));
    std::printf("  %3.0f: %2d/%2d/%2d", turn, s.near, s.found, s.drawn);
    if (s.wrong > 0) std::printf(" F%d", s.wrong);
    add(all, s);
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  bool radii = false, smooth = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    radii = radii || word == "--radii";
    smooth = smooth || word == "--smooth";
  }
  Score all;
  for (const double blur : {0.8, 1.5}) {
    for (const double width : {2.0, 3.0, 4.5, 6.0, 9.0}) {
      if (smooth) {
        printSmooth(blur, width, all);
      } else if (radii) {
        for (const double radius : {0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0}) printZigzags(blur, width, 10.0, radius, all);
      } else {
        for (const double leg : {4.0, 6.0, 10.0, 20.0}) printZigzags(blur, width, leg, 0.0, all);
      }
    }
  }
  std::printf("all: %d within %.0f px, %d found, of %d; rms %.3f px; %d false\n", all.near, kNearPx, all.found,
              all.drawn, std::sqrt(all.square / std::max(1, all.found)), all.wrong);
  return 0;
}
