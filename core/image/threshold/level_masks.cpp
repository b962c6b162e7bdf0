// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/level_masks.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/image/plane.h"
#include "core/image/threshold/darkest_cells.h"
#include "core/image/threshold/level_block.h"
#include "core/image/threshold/region_surface.h"

namespace batten {
namespace {

constexpr float kRounding = 0.01f;       // [grey] more than floats lose on the way to a level or a smoothed pixel

constexpr int kBlockAcross = LevelBlock::kAcross, kBlockDown = LevelBlock::kDown;  // [px]

/// The paper without its folds, which are taken out of the picture itself, in a group of rows.
class PaperRows {
 public:
  PaperRows(const PaperBackground& paper, int width) : paper_(paper), width_(width) {}

  void setRows(int y0, int y1) {
    if (paper_.isEmpty()) return;
    for (int y = y0; y < y1; ++y) {
      const auto [top, share] = rowAt(y);
      rows_[y - y0] = {cells(top), cells(std::min(top + 1, paper_.rows - 1)), static_cast<float>(share)};
    }
    const int first = rowAt(y0).first, last = std::min(rowAt(y1 - 1).first + 1, paper_.rows - 1);
    highest_.assign(cells(first), cells(first) + paper_.columns);
    for (int row = first + 1; row <= last; ++row)
      std::transform(highest_.begin(), highest_.end(), cells(row), highest_.begin(),
                     [](float a, float b) { return std::max(a, b); });
  }

  /// At the centres of pixels [x0, x1) of a row of the group. @pre a block
  void fill(int row, int x0, int x1, LevelBlock::Row& block) const {
    float* out = block.data();
    if (paper_.isEmpty()) {
      std::fill_n(out, x1 - x0, 255.0f);
      return;
    }
    const int before = x0 / paper_.cellPx - 1;
    const bool isInside = before >= 0 && before + kBlockAcross / paper_.cellPx + 1 < paper_.columns;
    if (isInside && (paper_.cellPx == 8 || paper_.cellPx == 16)) {
      const BetweenCells& between = rows_[row];
      return fillBetweenCells(between.above + before, between.below + before, between.share, paper_.cellPx, block);
    }
    const int cell = paper_.cellPx, half = cell / 2, last = paper_.columns - 1;
    const auto column = [&, r = rows_[row]](int c) { return r.above[c] + r.share * (r.below[c] - r.above[c]); };
    int x = x0;
    for (const float first = column(0); x < std::min(half, x1); ++x) out[x - x0] = first;
    const float step = 1.0f / static_cast<float>(cell);
    while (x < x1) {
      const int c = std::min((x - half) / cell, last), begin = c * cell + half;
      const int end = std::min(c == last ? width_ : begin + cell, x1);
      const float left = column(c), right = column(std::min(c + 1, last)), slope = (right - left) * step;
      float* to = out + (begin - x0);
      for (int k = x - begin; k < end - begin; ++k) to[k] = left + slope * (static_cast<float>(k) + 0.5f);
      x = end;
    }
  }

  /// A level that the paper exceeds nowhere in pixels [x0, x1) of the group.
  float bound(int x0, int x1) const {
    if (paper_.isEmpty()) return 255.0f;
    const auto cellOf = [&](int x) {
      return std::clamp((x - paper_.cellPx / 2) / paper_.cellPx, 0, paper_.columns - 1);
    };
    const int c0 = cellOf(x0), c1 = std::min(cellOf(x1 - 1) + 1, paper_.columns - 1);
    return *std::max_element(highest_.data() + c0, highest_.data() + c1 + 1);
  }

 private:
  std::pair<int, double> rowAt(int y) const {
    const double v = std::clamp((y + 0.5) / paper_.cellPx - 0.5, 0.0, paper_.rows - 1.0);
    return {static_cast<int>(v), v - static_cast<int>(v)};
  }
  const float* cells(int row) const { return paper_.grey.data() + std::ptrdiff_t{row} * paper_.columns; }

  /// The rows of cells above and below a row of pixels, and the share of the latter.
  struct BetweenCells {
    const float *above, *below;
    float share;
  };
  const PaperBackground& paper_;
  int width_;
  std::array<BetweenCells, kBlockDown> rows_{};
  std::vector<float> highest_;
};

/// What all blocks of rows share.
struct Comparison {
  const GreyImage& image;
  const PaperBackground& paper;
  RegionSurface contrast, certain;
  FaintContrast faint;
  std::vector<float> kernel;
  const DarkestCells& darkest;
  LevelMasks& masks;
  int radius() const { return std::min(static_cast<int>(kernel.size()) - 1, LevelBlock::kMostRadius); }
};

/// Some rows of the page, block by block.
class GroupOfRows {
 public:
  explicit GroupOfRows(const Comparison& c)
      : c_(c),
        paper_(c.paper, c.image.width),
        lowest_(c.darkest.columns()),
        border_(kBlockDown + 2 * c.radius(), std::vector<std::uint16_t>(LevelBlock::pastRow(c.radius()))),
        rows_(border_.size()) {
    for (int x = 0; x < c.image.width; x += kBlockAcross) stretches_.push_back(c.contrast.stretchAt(x));
  }

  /// @param y0 of the first of kBlockDown rows, or fewer at the end of the page.
  void run(int y0) {
    y0_ = y0;
    y1_ = std::min(y0 + kBlockDown, c_.image.height);
    lookAtCells();
    paper_.setRows(y0_, y1_);
    contrastBound_ = c_.contrast.highestByStretch(y0_, y1_);
    certainBound_ = c_.certain.highestByStretch(y0_, y1_);
    blocks_.clear();
    for (int block = 0; block < std::ssize(stretches_); ++block) {
      const int x0 = block * kBlockAcross, x1 = std::min(x0 + kBlockAcross, c_.image.width);
      if (darkestNear(x0, x1) - kRounding <= highestLevel(block, x0, x1)) blocks_.push_back(block);
    }
    if (blocks_.empty()) return;
    for (int y = y0_; y < y1_; ++y) {
      contrastLines_[y - y0_] = c_.contrast.linesOfRow(y);
      certainLines_[y - y0_] = c_.certain.linesOfRow(y);
    }
    for (const int block : blocks_) compare(block);
  }

 private:
  /// The darkest of the cells that the smoothed pixels of the rows are made of.
  void lookAtCells() {
    const DarkestCells& cells = c_.darkest;
    const int first = std::max(0, y0_ - c_.radius()) / DarkestCells::kDown;
    const int last = std::min((y1_ - 1 + c_.radius()) / DarkestCells::kDown, cells.rows() - 1);
    std::copy_n(cells.row(first), cells.columns(), lowest_.data());
    for (int row = first + 1; row <= last; ++row) takeLesser(cells.row(row), lowest_.data(), cells.columns());
  }

  /// [grey]
  float darkestNear(int x0, int x1) const {
    const int first = std::max(0, x0 - c_.radius()) / DarkestCells::kAcross;
    const int past = std::min((x1 - 1 + c_.radius()) / DarkestCells::kAcross + 1, c_.darkest.columns());
    return static_cast<float>(*std::min_element(lowest_.data() + first, lowest_.data() + past) / GreyImage::kGreyUnit);
  }

  /// A level that none of the three exceeds in a block.
  float highestLevel(int block, int x0, int x1) const {
    float most = contrastBound_[stretches_[block]], deep = certainBound_[stretches_[block]];
    for (int stretch = stretches_[block]; stretch < kRegionsPerSide && c_.contrast.isBefore(stretch, x1 - 1);) {
      ++stretch;
      most = std::max(most, contrastBound_[stretch]);
      deep = std::max(deep, certainBound_[stretch]);
    }
    return paper_.bound(x0, x1) + std::max({most, deep, c_.faint.of(most)}) + kRounding;
  }

  void compare(int block) {
    const int x0 = block * kBlockAcross, x1 = std::min(x0 + kBlockAcross, c_.image.width);
    const int radius = c_.radius(), shift = x0 % 64, word = x0 / 64;
    for (int i = 0; i < std::ssize(rows_); ++i) rows_[i] = grey(x0, y0_ - radius + i, i);
    smoothBlock(rows_.data(), c_.kernel, smoothed_);
    for (int y = y0_; y < y1_; ++y) {
      const int row = y - y0_;
      paper_.fill(row, x0, x1, levels_.paper);
      fillContrast(c_.contrast, contrastLines_[row], block, levels_.contrast);
      fillContrast(c_.certain, certainLines_[row], block, levels_.certain);
      const RowBits bits = compareRow(smoothed_[row], levels_, c_.faint);
      const std::uint64_t valid = ~std::uint64_t{0} >> (64 - (x1 - x0));
      const auto put = [&](BitImage& mask, std::uint64_t of) { mask.row(y)[word] |= (of & valid) << shift; };
      put(c_.masks.ink, bits.ink);
      if (c_.masks.certain) put(*c_.masks.certain, bits.certain);
      if (c_.masks.faint) put(*c_.masks.faint, bits.faint);
    }
  }

  void fillContrast(const RegionSurface& surface, const RegionSurface::RowLines& lines, int block,
                    LevelBlock::Row& out) const {
    const int x0 = block * kBlockAcross, x1 = std::min(x0 + kBlockAcross, c_.image.width), stretch = stretches_[block];
    if (stretch < kRegionsPerSide && surface.isBefore(stretch, x1 - 1))
      return surface.fillStretches(lines, stretch, x0, x1, out.data());
    fillStraight(lines[stretch].first, lines[stretch].slope, x0 - surface.startOf(stretch), out);
  }

  /// A row of the page from `radius` pixels before x0 on; beyond the page its border is repeated.
  const std::uint16_t* grey(int x0, int y, int index) {
    const int radius = c_.radius(), width = c_.image.width;
    const std::uint16_t* in = c_.image.row(std::clamp(y, 0, c_.image.height - 1));
    if (x0 >= radius && x0 - radius + LevelBlock::pastRow(radius) <= width) return in + x0 - radius;
    std::vector<std::uint16_t>& out = border_[index];
    for (int i = 0; i < std::ssize(out); ++i) out[i] = in[std::clamp(x0 - radius + i, 0, width - 1)];
    return out.data();
  }

  const Comparison& c_;
  int y0_ = 0, y1_ = 0;
  PaperRows paper_;
  std::vector<std::uint16_t> lowest_;  // of the cells above one another
  std::vector<int> stretches_;         // of the first pixel of every block
  std::vector<int> blocks_;            // that may hold ink
  RegionSurface::RowBounds contrastBound_{}, certainBound_{};
  std::array<RegionSurface::RowLines, kBlockDown> contrastLines_{}, certainLines_{};
  std::vector<std::vector<std::uint16_t>> border_;
  std::vector<const std::uint16_t*> rows_;
  LevelBlock::Rows smoothed_{};
  RowLevels levels_{};
};

}  // namespace

LevelMasks compareWithLevels(const GreyImage& image, const RegionThresholds& t, const ThresholdParams& params,
                             const RunContext& context) {
  const bool wantFaint = params.reach < 1.0, wantCertain = wantFaint || params.speckArea > 0;
  LevelMasks masks{BitImage(image.width, image.height), std::nullopt, std::nullopt};
  if (wantCertain) masks.certain.emplace(image.width, image.height);
  if (wantFaint) masks.faint.emplace(image.width, image.height);
  const DarkestCells darkest(image, context);
  if (context.isCancelled()) return masks;
  const double variance = params.smooth ? t.smoothingPx * t.smoothingPx : 0.0;
  const Comparison comparison{
      image,
      t.paper,
      RegionSurface(t.contrast, image.width, image.height, params.interpolate),
      RegionSurface(t.certain, image.width, image.height, params.interpolate),
      {static_cast<float>(params.reach > 0.0 ? params.reach : kAutomaticReach), static_cast<float>(t.faintLimit)},
      gaussianKernel(variance),
      darkest,
      masks};
  parallelFor(context, image.height, kRowsPerBlock, [&](int begin, int end) {
    GroupOfRows rows(comparison);
    for (int y = begin; y < end; y += kBlockDown) rows.run(y);
  });
  return masks;
}

}  // namespace batten
