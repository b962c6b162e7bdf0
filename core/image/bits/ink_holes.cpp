// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/ink_holes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/image/bits/bit_steps.h"
#include "core/image/bits/mask_distance.h"

namespace batten {
namespace {

constexpr int kRunsPerLook = 256;  // between two looks at the cancel token

bool isAtBorder(const InkRun& run, const BitImage& page) {
  return run.y == 0 || run.y == page.height - 1 || run.x0 == 0 || run.x1 == page.width;
}

}  // namespace

std::vector<InkHole> findInkHoles(const BitImage& ink, const RunContext& context) {
  std::vector<InkHole> holes;
  if (ink.width <= 0 || ink.height <= 0) return holes;
  const RunPieces paper = findPieces(paperOf(ink), Connectivity::Four, context);
  if (context.isCancelled()) return holes;
  struct Region {
    bool isOutside = false;
    std::optional<std::size_t> hole;
  };
  std::vector<Region> regions(paper.runs.size());  // by their first runs
  for (std::size_t i = 0; i < paper.runs.size(); ++i)
    if (isAtBorder(paper.runs[i], ink)) regions[paper.piece[i]].isOutside = true;
  for (std::size_t i = 0; i < paper.runs.size(); ++i) {
    Region& region = regions[paper.piece[i]];
    if (region.isOutside) continue;
    if (!region.hole) {
      region.hole = holes.size();
      holes.emplace_back();
    }
    holes[*region.hole].runs.push_back(paper.runs[i]);
  }
  return holes;
}

void measureWidths(const BitImage& ink, std::vector<InkHole>& holes, const RunContext& context) {
  struct Place {
    InkRun run;
    InkHole* hole;
  };
  std::vector<Place> places;
  BitImage inside(ink.width, ink.height);
  for (InkHole& hole : holes) {
    for (const InkRun& run : hole.runs) {
      setBits(inside, run);
      places.push_back({run, &hole});
    }
  }
  // By the rows of the page, as the distances come.
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.run.y != b.run.y ? a.run.y < b.run.y : a.run.x0 < b.run.x0;
  });
  // The nearest pixel outside a hole is its own ink, whatever else lies beyond.
  MaskDistance toInk(inside);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i % kRunsPerLook == 0 && context.isCancelled()) return;
    const InkRun& run = places[i].run;
    InkHole& hole = *places[i].hole;
    for (int x = run.x0; x < run.x1; ++x) {
      const double width = 2.0 * std::sqrt(toInk.squared(x, run.y)) - 1.0;
      if (width <= hole.widthPx) continue;
      hole.widthPx = width;
      hole.middleX = x;
      hole.middleY = run.y;
    }
  }
}

}  // namespace batten
