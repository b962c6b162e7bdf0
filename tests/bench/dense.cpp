// SPDX-License-Identifier: GPL-3.0-or-later
// Lines side by side, hatched with pen and pencil, and pages of both: how many are found whole.
//
//   bench_dense [stage.parameter=value …]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/pipeline/recipe/parameter_table.h"
#include "tests/bench/traced_lines.h"
#include "tests/support/dense_page.h"

using namespace batten;
using namespace batten::test;

namespace {

using Lines = std::vector<std::vector<Vec2>>;
constexpr int kWidth = 640, kHeight = 480, kCount = 12;
constexpr double kLengthPx = 300.0;

struct Sum {
  DenseScore all;
  double squares = 0.0;
  int pages = 0;
  void add(const DenseScore& s) {
    all.drawn += s.drawn;
    all.whole += s.whole;
    all.inPieces += s.inPieces;
    all.bridges += s.bridges;
    squares += s.rmsPx * s.rmsPx;
    ++pages;
  }
  void print(const std::string& name) const {
    std::printf("%-34s %4d of %4d %6d %6d %8d %8.3f\n", name.c_str(), all.whole, all.drawn, all.inPieces,
                all.drawn - all.whole - all.inPieces, all.bridges, pages > 0 ? std::sqrt(squares / pages) : 0.0);
    std::fflush(stdout);
  }
};

void hatching(bool pencil, const Recipe& recipe) {
  std::printf("\n%s hatching, %d lines a field, straight and curved\n", pencil ? "Pencil" : "Pen", kCount);
  std::printf("%-34s %12s %6s %6s %8s %8s\n", "", "whole", "pieces", "lost", "bridges", "rms px");
  for (const double width : {2.0, 3.0, 5.0}) {
    for (const double spacing : {1.5, 2.0, 2.5, 3.0, 4.0}) {
      Sum sum;
      for (const std::uint32_t seed : {1u, 2u}) {
        for (const double radius : {0.0, 500.0}) {
          const Lines lines =
              hatchLines({320.0, 240.0}, seed == 1 ? 17.0 : -38.0, kCount, spacing * width, kLengthPx, radius);
          std::vector<float> cover = coverageOf(lines, width, kWidth, kHeight);
          if (pencil)
            grainCoverage(
                cover, kWidth, kHeight, [](double, double) { return 1.0; }, seed);
          const Scan scan = scanOfLines(std::move(cover), kWidth, kHeight, seed);
          sum.add(scoreDense(lines, tracedLines(scan, recipe), 0.5 * spacing * width, 2.0 * width));
        }
      }
      char name[64];
      std::snprintf(name, sizeof name, "width %.0f px, spacing %.1f widths", width, spacing);
      sum.print(name);
    }
  }
}

/// Lines across the whole page, drawn with a pen at the left and a pencil at the right; `soft` px in between.
void halfAndHalf(const Recipe& recipe) {
  std::printf("\nPen at the left, pencil at the right\n");
  for (const double width : {2.0, 3.0, 5.0}) {
    for (const bool through : {false, true}) {
      Sum pen, pencil;
      for (const std::uint32_t seed : {1u, 2u}) {
        const double spacing = 6.0 * width;
        const Lines left = hatchLines({160.0, 240.0}, 7.0, kCount, spacing, through ? 300.0 : 260.0, 0.0);
        const Lines right = hatchLines({480.0, 240.0}, 7.0, kCount, spacing, through ? 300.0 : 260.0, 0.0);
        std::vector<float> cover;
        if (through) {
          const Lines all = hatchLines({320.0, 240.0}, 7.0, kCount, spacing, 600.0, 0.0);
          cover = coverageOf(all, width, kWidth, kHeight);
        } else {
          Lines all = left;
          all.insert(all.end(), right.begin(), right.end());
          cover = coverageOf(all, width, kWidth, kHeight);
        }
        grainCoverage(
            cover, kWidth, kHeight, [](double x, double) { return std::clamp((x - 315.0) / 10.0, 0.0, 1.0); }, seed);
        const Lines found = tracedLines(scanOfLines(std::move(cover), kWidth, kHeight, seed), recipe);
        if (through) {
          const Lines all = hatchLines({320.0, 240.0}, 7.0, kCount, spacing, 600.0, 0.0);
          pen.add(scoreDense(all, found, 0.5 * spacing, 2.0 * width));
        } else {
          pen.add(scoreDense(left, found, 0.5 * spacing, 2.0 * width));
          pencil.add(scoreDense(right, found, 0.5 * spacing, 2.0 * width));
        }
      }
      char name[64];
      std::snprintf(name, sizeof name, "width %.0f px, ", width);
      if (through) {
        pen.print(std::string(name) + "lines through both");
      } else {
        pen.print(std::string(name) + "pen");
        pencil.print(std::string(name) + "pencil");
      }
    }
  }
}

/// One inked curve through pencil hatching, and one pencil curve through pen hatching.
void curveThrough(const Recipe& recipe) {
  std::printf("\nOne curve of 4 px through hatching of the other kind (width 3 px)\n");
  for (const bool penCurve : {true, false}) {
    for (const double spacing : {2.0, 3.0, 6.0}) {
      Sum curve, hatch;
      for (const std::uint32_t seed : {1u, 2u}) {
        const Lines lines = hatchLines({320.0, 240.0}, 62.0, 36, spacing * 3.0, 260.0, 0.0);
        const Lines one = hatchLines({320.0, 240.0}, -9.0, 1, 1.0, 560.0, 420.0);
        std::vector<float> below = coverageOf(lines, 3.0, kWidth, kHeight),
                           above = coverageOf(one, 4.0, kWidth, kHeight);
        grainCoverage(
            penCurve ? below : above, kWidth, kHeight, [](double, double) { return 1.0; }, seed);
        for (std::size_t i = 0; i < below.size(); ++i) below[i] = std::max(below[i], above[i]);
        const Lines found = tracedLines(scanOfLines(std::move(below), kWidth, kHeight, seed), recipe);
        curve.add(scoreDense(one, found, 4.0, 8.0));
        hatch.add(scoreDense(lines, found, 1.5 * spacing, 6.0));
      }
      char name[64];
      std::snprintf(name, sizeof name, "%s curve, spacing %.0f widths", penCurve ? "pen" : "pencil", spacing);
      curve.print(name);
      hatch.print("    its hatching");
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  Recipe recipe;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equals = std::min(word.find('='), word.size() - 1);
    const auto done = setParameter(recipe, word.substr(0, equals), word.substr(equals + 1));
    if (done) continue;
    std::fprintf(stderr, "%s\n", done.error().message.c_str());
    return 2;
  }
  hatching(false, recipe);
  hatching(true, recipe);
  halfAndHalf(recipe);
  curveThrough(recipe);
  return 0;
}
