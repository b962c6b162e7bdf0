// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/level_masks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"
#include "core/image/plane.h"
#include "core/image/threshold/region_surface.h"

namespace batten {
namespace {

constexpr double kAutomaticReach = 0.4;  // of the region's contrast; never into the noise of the paper
constexpr int kRowsPerGroup = 8;         // rows whose darkest pixels are kept together, by words of 64
constexpr float kRounding = 0.01f;       // [grey] more than floats lose on the way to a level or a smoothed pixel

/// The least of eight rows, pixel by pixel.
BATTEN_HOT_LOOP void lowestOfRows(const std::uint16_t* const* rows, std::uint16_t* __restrict out, int count) {
  const std::uint16_t *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
  const std::uint16_t *e = rows[4], *f = rows[5], *g = rows[6], *h = rows[7];
  const auto less = [](std::uint16_t u, std::uint16_t v) { return u < v ? u : v; };
  for (int i = 0; i < count; ++i)
    out[i] = less(less(less(a[i], b[i]), less(c[i], d[i])), less(less(e[i], f[i]), less(g[i], h[i])));
}

/// The least of every 64 values. @pre `in` holds whole words.
BATTEN_HOT_LOOP void lowestOfWords(const std::uint16_t* in, std::uint16_t* __restrict out, int words) {
  for (int w = 0; w < words; ++w) {
    std::uint16_t low = in[w * 64];
    for (int i = 1; i < 64; ++i) low = in[w * 64 + i] < low ? in[w * 64 + i] : low;
    out[w] = low;
  }
}

BATTEN_HOT_LOOP void flagBelow(const float* grey, const float* paper, const float* contrast,
                               std::uint8_t* __restrict flags, int count) {
  for (int i = 0; i < count; ++i) flags[i] = grey[i] < paper[i] + contrast[i] ? 1 : 0;
}

/// What the weaker level asks for.
struct FaintContrast {
  float reach, limit;
  float of(float contrast) const {
    const float share = reach * contrast;  // by itself: else the loop below is not vectorised
    const float weaker = contrast < 0.0f ? share : contrast;
    const float capped = weaker < limit ? weaker : limit;
    return contrast > capped ? contrast : capped;
  }
};

BATTEN_HOT_LOOP void weakenRow(const float* contrast, float reach, float limit, float* __restrict out, int count) {
  for (int i = 0; i < count; ++i) out[i] = FaintContrast{reach, limit}.of(contrast[i]);
}

/// Eight flags of 0 or 1 become eight bits by one multiplication. @pre flags holds whole words of 64.
void packWords(const std::uint8_t* flags, int words, std::uint64_t* out) {
  for (int w = 0; w < words; ++w) {
    std::uint64_t word = 0;
    for (int k = 0; k < 8; ++k) {
      std::uint64_t eight;
      std::memcpy(&eight, flags + w * 64 + k * 8, 8);
      word |= ((eight * 0x0102040810204080ull) >> 56) << (8 * k);
    }
    out[w] = word;
  }
}

/// Pixels [x0, x1) of rows.
struct RowStretch {
  int x0, x1;
  int count() const { return x1 - x0; }
};

/// The paper without its folds, which are taken out of the picture itself.
class PaperRows {
 public:
  PaperRows(const PaperBackground& paper, int width) : paper_(paper), width_(width) {}

  /// At the pixel centres of a stretch of row y.
  void fill(int y, RowStretch at, float* out) {
    if (paper_.isEmpty()) {
      std::fill_n(out, at.count(), 255.0f);
      return;
    }
    const auto [top, share] = rowAt(y);
    const float* above = cells(top);
    const float* below = cells(std::min(top + 1, paper_.rows - 1));
    const int cell = paper_.cellPx, half = cell / 2, last = paper_.columns - 1;
    const auto column = [&, part = static_cast<float>(share)](int c) {
      return above[c] + part * (below[c] - above[c]);
    };
    int x = at.x0;
    const float first = column(0);
    for (; x < std::min(half, at.x1); ++x) out[x - at.x0] = first;
    const float step = 1.0f / static_cast<float>(cell);
    while (x < at.x1) {
      const int c = std::min((x - half) / cell, last), begin = c * cell + half;
      const int end = std::min(c == last ? width_ : begin + cell, at.x1);
      const float left = column(c), right = column(std::min(c + 1, last)), slope = (right - left) * step;
      float* to = out + (begin - at.x0);
      for (int k = x - begin; k < end - begin; ++k) to[k] = left + slope * (static_cast<float>(k) + 0.5f);
      x = end;
    }
  }

  /// A level that the paper exceeds nowhere in rows [y0, y1) of every word of 64 pixels.
  void boundWords(int y0, int y1, std::vector<float>& out) {
    if (paper_.isEmpty()) {
      std::fill(out.begin(), out.end(), 255.0f);
      return;
    }
    const int first = rowAt(y0).first, last = std::min(rowAt(y1 - 1).first + 1, paper_.rows - 1);
    highest_.assign(cells(first), cells(first) + paper_.columns);
    for (int row = first + 1; row <= last; ++row)
      std::transform(highest_.begin(), highest_.end(), cells(row), highest_.begin(),
                     [](float a, float b) { return std::max(a, b); });
    const auto cellOf = [&](int x) {
      return std::clamp((x - paper_.cellPx / 2) / paper_.cellPx, 0, paper_.columns - 1);
    };
    for (int w = 0; w < std::ssize(out); ++w) {
      const int c0 = cellOf(64 * w), c1 = std::min(cellOf(64 * w + 63) + 1, paper_.columns - 1);
      out[w] = *std::max_element(highest_.begin() + c0, highest_.begin() + c1 + 1);
    }
  }

 private:
  std::pair<int, double> rowAt(int y) const {
    const double v = std::clamp((y + 0.5) / paper_.cellPx - 0.5, 0.0, paper_.rows - 1.0);
    return {static_cast<int>(v), v - static_cast<int>(v)};
  }
  const float* cells(int row) const { return paper_.grey.data() + std::ptrdiff_t{row} * paper_.columns; }

  const PaperBackground& paper_;
  int width_;
  std::vector<float> highest_;
};

/// What all blocks of rows share.
struct Comparison {
  const GreyImage& image;
  const PaperBackground& paper;
  RegionSurface contrast, certain;
  FaintContrast faint;
  std::vector<float> kernel;
  LevelMasks& masks;
  int radius() const { return static_cast<int>(kernel.size()) - 1; }
  int words() const { return masks.ink.wordsPerRow; }
};

/// The darkest pixels of bands of rows, by words of 64.
class DarkestWords {
 public:
  explicit DarkestWords(const Comparison& c)
      : image_(c.image), words_(c.words()), lowest_(static_cast<std::size_t>(c.words()) * 64, 0xffff) {}

  /// @param first group, and how many: what lies beyond the page is white.
  void measure(int first, int count) {
    first_ = first;
    groups_.assign(static_cast<std::size_t>(words_) * static_cast<std::size_t>(count), 0xffff);
    for (int group = first; group < first + count; ++group) {
      const int y0 = group * kRowsPerGroup;
      if (y0 < 0 || y0 >= image_.height) continue;
      std::array<const std::uint16_t*, kRowsPerGroup> rows;
      for (int i = 0; i < kRowsPerGroup; ++i) rows[i] = image_.row(std::min(y0 + i, image_.height - 1));
      lowestOfRows(rows.data(), lowest_.data(), image_.width);
      lowestOfWords(lowest_.data(), groups_.data() + std::ptrdiff_t{group - first} * words_, words_);
    }
  }

  /// The darkest pixel of a word of a group and of the eight around it. [grey]
  float around(int group, int word) const {
    std::uint16_t low = 0xffff;
    for (int b = group - 1; b <= group + 1; ++b) {
      const std::uint16_t* row = groups_.data() + std::ptrdiff_t{b - first_} * words_;
      for (int w = std::max(0, word - 1); w <= std::min(words_ - 1, word + 1); ++w) low = std::min(low, row[w]);
    }
    return static_cast<float>(low / GreyImage::kGreyUnit);
  }

 private:
  const GreyImage& image_;
  int words_, first_ = 0;
  std::vector<std::uint16_t> lowest_, groups_;
};

/// One block of rows, group by group.
class BlockOfRows {
 public:
  explicit BlockOfRows(const Comparison& c)
      : c_(c), paper_(c.paper, c.image.width), darkest_(c), bound_(c.words()), rows_(kRowsPerGroup + 2 * c.radius()) {}

  /// @pre begin is a multiple of kRowsPerGroup.
  void run(int begin, int end) {
    const int first = begin / kRowsPerGroup, last = (end - 1) / kRowsPerGroup;
    darkest_.measure(first - 1, last - first + 3);
    for (int group = first; group <= last; ++group) {
      const int y0 = group * kRowsPerGroup, y1 = std::min(y0 + kRowsPerGroup, end);
      boundLevels(y0, y1);
      const int words = c_.words();
      for (int w = 0; w < words; ++w) {
        int past = w;
        while (past < words && mayHoldInk(group, past)) ++past;
        if (past > w) compare(y0, y1, w, past);
        w = past;
      }
    }
  }

 private:
  bool mayHoldInk(int group, int word) const {
    return c_.radius() > kRowsPerGroup || darkest_.around(group, word) - kRounding <= bound_[word];
  }

  /// Levels that none of the three exceeds.
  void boundLevels(int y0, int y1) {
    paper_.boundWords(y0, y1, bound_);
    const auto contrast = c_.contrast.highestByColumn(y0, y1), certain = c_.certain.highestByColumn(y0, y1);
    for (int w = 0; w < c_.words(); ++w) {
      const auto [from, to] = c_.contrast.columnsOf(64 * w, std::min(64 * w + 64, c_.image.width));
      const auto most = static_cast<float>(*std::max_element(contrast.begin() + from, contrast.begin() + to + 1));
      const auto deep = static_cast<float>(*std::max_element(certain.begin() + from, certain.begin() + to + 1));
      bound_[w] += std::max({most, deep, c_.faint.of(most)}) + kRounding;
    }
  }

  void compare(int y0, int y1, int firstWord, int pastWord) {
    const RowStretch at{64 * firstWord, std::min(64 * pastWord, c_.image.width)};
    const int radius = c_.radius(), words = pastWord - firstWord;
    makeRoom(static_cast<std::size_t>(words) * 64);
    for (int i = 0; i < y1 - y0 + 2 * radius; ++i) {
      float* line = strip_.data() + std::ptrdiff_t{i} * at.count();
      const std::uint16_t* in = c_.image.row(std::clamp(y0 - radius + i, 0, c_.image.height - 1));
      loadGrey(in, at);
      smoothAlong(padded_.data() + radius, line, at.count(), c_.kernel);
      rows_[i] = line;
    }
    for (int y = y0; y < y1; ++y) {
      smoothAcross(rows_.data() + (y - y0), grey_.data(), at.count(), c_.kernel);
      paper_.fill(y, at, paperRow_.data());
      c_.contrast.fillRow(y, at.x0, at.x1, contrastRow_.data());
      const auto pack = [&](const std::vector<float>& contrast, BitImage& mask) {
        flagBelow(grey_.data(), paperRow_.data(), contrast.data(), flags_.data(), at.count());
        std::fill(flags_.begin() + at.count(), flags_.begin() + std::ptrdiff_t{words} * 64, std::uint8_t{0});
        packWords(flags_.data(), words, mask.row(y) + firstWord);
      };
      pack(contrastRow_, c_.masks.ink);
      if (c_.masks.faint) {
        weakenRow(contrastRow_.data(), c_.faint.reach, c_.faint.limit, levelRow_.data(), at.count());
        pack(levelRow_, *c_.masks.faint);
      }
      if (c_.masks.certain) {
        c_.certain.fillRow(y, at.x0, at.x1, levelRow_.data());
        pack(levelRow_, *c_.masks.certain);
      }
    }
  }

  /// Most stretches are short: the buffers grow with the longest.
  void makeRoom(std::size_t pixels) {
    if (pixels <= flags_.size()) return;
    padded_.resize(pixels + 2 * static_cast<std::size_t>(c_.radius()));
    strip_.resize(pixels * rows_.size());
    for (auto* row : {&paperRow_, &contrastRow_, &levelRow_, &grey_}) row->resize(pixels);
    flags_.resize(pixels);
  }

  /// The row as grey levels, with `radius` pixels at either side; beyond the page its ends are repeated.
  void loadGrey(const std::uint16_t* in, RowStretch at) {
    const int radius = c_.radius(), width = c_.image.width;
    const int left = std::max(0, radius - at.x0), right = std::max(0, at.x1 + radius - width);
    const int begin = at.x0 - radius + left, end = at.x1 + radius - right;
    float* out = padded_.data();
    scaleGrey(in + begin, out + left, end - begin);
    std::fill_n(out, left, out[left]);
    std::fill_n(out + left + (end - begin), right, out[left + (end - begin) - 1]);
  }

  const Comparison& c_;
  PaperRows paper_;
  DarkestWords darkest_;
  std::vector<float> bound_;
  std::vector<float> padded_, strip_, paperRow_, contrastRow_, levelRow_, grey_;
  std::vector<const float*> rows_;
  std::vector<std::uint8_t> flags_;
};

}  // namespace

LevelMasks compareWithLevels(const GreyImage& image, const RegionThresholds& t, const ThresholdParams& params,
                             const RunContext& context) {
  const bool wantFaint = params.reach < 1.0, wantCertain = wantFaint || params.speckArea > 0;
  const BitImage blank(image.width, image.height);
  LevelMasks masks{blank, std::nullopt, std::nullopt};
  if (wantCertain) masks.certain = blank;
  if (wantFaint) masks.faint = blank;
  const double variance = params.smooth ? t.smoothingPx * t.smoothingPx : 0.0;
  const Comparison comparison{
      image,
      t.paper,
      RegionSurface(t.contrast, image.width, image.height, params.interpolate),
      RegionSurface(t.certain, image.width, image.height, params.interpolate),
      {static_cast<float>(params.reach > 0.0 ? params.reach : kAutomaticReach), static_cast<float>(t.faintLimit)},
      gaussianKernel(variance > 0.0 ? std::max(variance, 0.51) : 0.0),
      masks};
  parallelFor(context, image.height, kRowsPerBlock,
              [&](int begin, int end) { BlockOfRows(comparison).run(begin, end); });
  return masks;
}

}  // namespace batten
