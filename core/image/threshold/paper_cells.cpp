// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/paper_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/bits/neighbourhood_filter.h"
#include "core/image/push_pull.h"
#include "core/image/threshold/half_levels.h"
#include "core/image/threshold/region_surface.h"

namespace batten {
namespace {

constexpr int kRounds = 2;  // each begins with the paper that the one before has found

struct Cells {
  int columns = 0, rows = 0;
  std::vector<float> mean;
  std::vector<std::uint8_t> isFree;
  std::size_t at(int x, int y) const { return std::ptrdiff_t{y} * columns + x; }
};

/// Adds a row to the sums of its cells, pixel by pixel from the left.
template <int Size>
void addCellsOf(const float* row, int cells, float* sums) {
  for (int i = 0; i < cells; ++i) {
    float sum = sums[i];
    for (int k = 0; k < Size; ++k) sum += row[i * Size + k];
    sums[i] = sum;
  }
}

void addCells(const float* row, int width, int size, std::vector<float>& sums) {
  const int whole = size == 4 || size == 8 ? width / size : 0;
  if (size == 4) addCellsOf<4>(row, whole, sums.data());
  if (size == 8) addCellsOf<8>(row, whole, sums.data());
  for (int x = whole * size; x < width; ++x) sums[x / size] += row[x];
}

/// @param size side of a cell on the plane; divides 64.
Cells measureCells(const Plane& grey, const BitImage& edges, int size, const RunContext& context) {
  Cells cells;
  cells.columns = (grey.width + size - 1) / size;
  cells.rows = (grey.height + size - 1) / size;
  const std::size_t count = std::ptrdiff_t{cells.columns} * cells.rows;
  cells.mean.assign(count, 0.0f);
  cells.isFree.assign(count, 1);
  const std::uint64_t mask = (std::uint64_t{1} << size) - 1;
  parallelFor(context, cells.rows, 8, [&](int begin, int end) {
    std::vector<float> sums(cells.columns);
    std::vector<std::uint64_t> touched(edges.wordsPerRow);
    for (int j = begin; j < end; ++j) {
      const int y0 = j * size, y1 = std::min(y0 + size, grey.height);
      std::fill(sums.begin(), sums.end(), 0.0f);
      std::fill(touched.begin(), touched.end(), std::uint64_t{0});
      for (int y = y0; y < y1; ++y) {
        addCells(grey.row(y), grey.width, size, sums);
        for (int i = 0; i < edges.wordsPerRow; ++i) touched[i] |= edges.row(y)[i];
      }
      for (int i = 0; i < cells.columns; ++i) {
        const int x0 = i * size, x1 = std::min(x0 + size, grey.width);
        cells.mean[cells.at(i, j)] = sums[i] / static_cast<float>((x1 - x0) * (y1 - y0));
        cells.isFree[cells.at(i, j)] = ((touched[x0 >> 6] >> (x0 & 63)) & mask) == 0 ? 1 : 0;
      }
    }
  });
  return cells;
}

/// Differences between neighbouring cells, right and down; those at edges are filled from around.
std::vector<float> cellSteps(const Cells& cells, bool down) {
  std::vector<float> value(cells.mean.size(), 0.0f), weight(cells.mean.size(), 0.0f);
  for (int y = 0; y + (down ? 1 : 0) < cells.rows; ++y) {
    for (int x = 0; x + (down ? 0 : 1) < cells.columns; ++x) {
      const std::size_t a = cells.at(x, y), b = down ? cells.at(x, y + 1) : cells.at(x + 1, y);
      if (cells.isFree[a] == 0 || cells.isFree[b] == 0) continue;
      value[a] = cells.mean[b] - cells.mean[a];
      weight[a] = 1.0f;
    }
  }
  return pushPull(value, weight, cells.columns, cells.rows);
}

/// The surface whose steps come nearest to the given ones in the least-squares sense (Neumann Poisson equation), by the
/// cosine transform. Uniform weights on purpose: a missed edge then pulls by its share only.
std::vector<float> integrateSteps(const Cells& cells, const std::vector<float>& right, const std::vector<float>& down) {
  const int width = 2 * cv::getOptimalDFTSize((cells.columns + 1) / 2);
  const int height = 2 * cv::getOptimalDFTSize((cells.rows + 1) / 2);
  cv::Mat_<double> divergence(height, width, 0.0);
  // Page border the surface is continued flat across its border, which pulls at nothing inside.
  for (int y = 0; y < height; ++y) {
    const int cy = std::min(y, cells.rows - 1);
    for (int x = 0; x < width; ++x) {
      const int cx = std::min(x, cells.columns - 1);
      const double toRight = x + 1 < cells.columns ? right[cells.at(x, cy)] : 0.0;
      const double toBelow = y + 1 < cells.rows ? down[cells.at(cx, y)] : 0.0;
      divergence(y, x) -= toRight;
      divergence(y, std::min(x + 1, width - 1)) += toRight;
      divergence(y, x) -= toBelow;
      divergence(std::min(y + 1, height - 1), x) += toBelow;
    }
  }
  cv::dct(divergence, divergence);
  std::vector<double> cosX(width);
  for (int x = 0; x < width; ++x) cosX[x] = 2.0 - 2.0 * std::cos(std::numbers::pi * x / width);
  for (int y = 0; y < height; ++y) {
    const double cosY = 2.0 - 2.0 * std::cos(std::numbers::pi * y / height);
    for (int x = 0; x < width; ++x) {
      const double eigenvalue = cosX[x] + cosY;
      divergence(y, x) = eigenvalue > 0.0 ? divergence(y, x) / eigenvalue : 0.0;
    }
  }
  cv::idct(divergence, divergence);
  std::vector<float> surface(cells.mean.size());
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.columns; ++x) surface[cells.at(x, y)] = static_cast<float>(divergence(y, x));
  }
  return surface;
}

/// Per region, the half level at its edges: mean of grey less paper over the crests, weighted by their strength.
struct HalfLevels {
  std::vector<float> ofRegion;
  bool areMixed = false;  ///< Ink and highlights: see SignedDepths.
};
HalfLevels halfLevels(const Plane& grey, const InkEdges& edges, const PaperBackground& paper, int shrink) {
  HalfLevels found;
  SignedDepths bySign;
  std::vector<double> depths;
  depths.reserve(edges.crests.size());
  for (const EdgePoint& p : edges.crests) {
    depths.push_back(static_cast<double>(grey.row(p.y)[p.x]) - paper.at((p.x + 0.5) * shrink, (p.y + 0.5) * shrink));
    bySign.add(static_cast<double>(p.strength), depths.back());
  }
  found.areMixed = bySign.areMixed();
  RegionHalfLevels regions;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const EdgePoint& p = edges.crests[i];
    if (found.areMixed && depths[i] > 0.0) continue;
    const auto strength = static_cast<double>(p.strength);
    regions.add(regionOf(p.x, p.y, grey.width, grey.height), strength * depths[i], strength);
  }
  found.ofRegion = regions.filled();
  return found;
}

std::vector<float> levelsOf(const RegionSurface& surface, const Cells& cells) {
  std::vector<float> levels(cells.mean.size());
  for (int y = 0; y < cells.rows; ++y) surface.fillRow(y, levels.data() + cells.at(0, y));
  return levels;
}

/// [grey] Mean absolute deviation within a cell.
float unevennessOf(const Plane& grey, const Cells& cells, int size, std::size_t cell) {
  const int x0 = static_cast<int>(cell % cells.columns) * size, y0 = static_cast<int>(cell / cells.columns) * size;
  const int x1 = std::min(x0 + size, grey.width), y1 = std::min(y0 + size, grey.height);
  float sum = 0.0f;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) sum += std::fabs(grey.row(y)[x] - cells.mean[cell]);
  return sum / static_cast<float>((x1 - x0) * (y1 - y0));
}

/// Takes cells that are brighter than the paper by more than ink is darker from the free ones: white chalk on toned
/// paper, paint. None where they may be the paper themselves: where there are many, and where they are much more even
/// than what was taken for paper, which is hatching then.
void dropHighlights(const Plane& grey, int size, Cells& cells, const PaperBackground& paper,
                    const std::vector<float>& halfLevels) {
  constexpr double kMostHighlights = 0.15;  // of the free cells
  constexpr float kBrighterHalves = 2.0f;   // of the half level: the whole contrast
  constexpr float kEvenShare = 0.5f;        // of the unevenness of paper: neither chalk nor paint is so even
  std::vector<std::size_t> highlights;
  std::vector<float> ofPaper, ofHighlights;
  for (std::size_t i = 0; i < cells.mean.size(); ++i) {
    if (cells.isFree[i] == 0) continue;
    const bool isHighlight = cells.mean[i] - paper.grey[i] >= -kBrighterHalves * halfLevels[i];
    (isHighlight ? ofHighlights : ofPaper).push_back(unevennessOf(grey, cells, size, i));
    if (isHighlight) highlights.push_back(i);
  }
  const double free = static_cast<double>(ofPaper.size() + ofHighlights.size());
  if (highlights.empty() || static_cast<double>(highlights.size()) > kMostHighlights * free) return;
  if (upperMedian(ofHighlights) < kEvenShare * upperMedian(ofPaper)) return;
  for (const std::size_t i : highlights) cells.isFree[i] = 0;
}

/// Brings the paper to the cells that turn out to be paper. The first round takes highlights from the free cells.
void correctPaper(const Plane& grey, const InkEdges& edges, int shrink, int round, Cells& cells,
                  PaperEstimate& estimate) {
  PaperBackground& paper = estimate.paper;
  const auto [half, areMixed] = halfLevels(grey, edges, paper, shrink);
  RegionValues values{};
  std::copy(half.begin(), half.end(), values.begin());
  const bool noEdges = std::all_of(half.begin(), half.end(), [](float v) { return v == 0.0f; });
  const std::vector<float> limits = levelsOf(RegionSurface(values, cells.columns, cells.rows, true), cells);
  const std::size_t count = cells.mean.size();
  if (round == 0 && areMixed) dropHighlights(grey, paper.cellPx / shrink, cells, paper, limits);
  std::vector<float> offset(count), weight(count);
  std::vector<std::size_t> darker;  // free cells
  for (std::size_t i = 0; i < count; ++i) {
    offset[i] = cells.mean[i] - paper.grey[i];
    const bool isFree = cells.isFree[i] != 0, isBright = noEdges || offset[i] > limits[i];
    if (isFree && !isBright) darker.push_back(i);
    estimate.isPaper[i] = isFree && isBright ? 1 : 0;
    weight[i] = isFree && isBright ? 1.0f : 0.0f;
  }
  // Where highlights led the sum of the slopes astray: what is as bright as the paper around it is paper.
  if (areMixed && !darker.empty()) {
    const std::vector<float> around = pushPull(cells.mean, weight, cells.columns, cells.rows);
    for (const std::size_t i : darker) {
      if (cells.mean[i] - around[i] <= limits[i]) continue;
      estimate.isPaper[i] = 1;
      weight[i] = 1.0f;
    }
  }
  const std::vector<float> correction = pushPull(offset, weight, cells.columns, cells.rows);
  for (std::size_t i = 0; i < count; ++i) paper.grey[i] += correction[i];
}

}  // namespace

PaperEstimate estimatePaper(const Plane& grey, const InkEdges& edges, int shrink, int cellPx,
                            const RunContext& context) {
  const BitImage touched = dilate(edges.area, 0, FilterBorder::Paper, context);
  Cells cells = measureCells(grey, touched, cellPx / shrink, context);
  PaperEstimate estimate;
  PaperBackground& paper = estimate.paper;
  paper.cellPx = cellPx;
  paper.columns = cells.columns;
  paper.rows = cells.rows;
  estimate.isPaper = cells.isFree;
  std::array<std::vector<float>, 2> steps;  // right, down
  steps.fill(std::vector<float>(cells.mean.size(), 0.0f));
  parallelFor(context, 2, 1, [&](int i, int) { steps[i] = cellSteps(cells, i == 1); });
  paper.grey = integrateSteps(cells, steps[0], steps[1]);
  // The integration leaves the height open: a high quantile of the free cells (large silhouettes are free too), later
  // the paper cells, settle it.
  std::vector<float> gaps;
  for (std::size_t i = 0; i < cells.mean.size(); ++i) {
    if (cells.isFree[i] != 0) gaps.push_back(cells.mean[i] - paper.grey[i]);
  }
  float height = cells.mean.empty() ? 255.0f : *std::max_element(cells.mean.begin(), cells.mean.end());
  if (!gaps.empty()) {
    height = elementOfRank(gaps, static_cast<std::ptrdiff_t>(gaps.size() * 7 / 10));
  }
  for (float& value : paper.grey) value += height;

  for (int round = 0; round < kRounds && !context.isCancelled(); ++round)
    correctPaper(grey, edges, shrink, round, cells, estimate);
  return estimate;
}

}  // namespace batten
