// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/pencil/oriented_line_filter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/contour/centreline/pencil/step_folds.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

constexpr int kTile = 64;            // [px]
constexpr double kFlankFrom = 0.75;  // [widths] from a gap's middle to the lines at its sides
constexpr double kRidgeTo = 1.5;     // [widths] from a line's middle to the paper at its sides
constexpr double kFlankTo = 2.0;     // [widths]
constexpr double kHalfWidths = 2.0, kShortestHalfPx = 8.0, kLongestHalfPx = 16.0;  // half the length of the means
constexpr double kDirectionsPerPx = 2.5;  // of half a line: the ends of neighbouring directions are a pixel apart
constexpr double kSideStepWidths = 0.1, kLeastSideStepPx = 0.5;  // between the places at a side
constexpr double kAbsoluteToSigma = 1.25;  // standard deviation over mean absolute value, of a normal variable
constexpr double kLineDepth = 0.5;         // of the strokes' depth: a fainter ridge is no line
constexpr double kPaperRank = 0.8;         // of the greys of a tile: brighter ones are so by noise
constexpr double kGrainLengthPx = 3.0;     // [px] along which grain is alike
constexpr double kClear = 2.0;             // [standard deviations]
constexpr float kHalf = 1.4142135f;        // half as long a line tells less
constexpr double kLeastShare = 0.1;        // of the strokes' depth
constexpr double kWidestPx = 24.0;         // between wider strokes there is paper enough to be seen

struct Step {
  int x = 0, y = 0;
};

// One direction in which lines are followed.
template <class Place>
struct PlacesOfLine {
  std::vector<Place> ahead, back;  // of a line through 0
  std::vector<Place> left, right;  // at either side, where the next line may be
};
using DirectionSteps = PlacesOfLine<Step>;
using Direction = PlacesOfLine<int>;  // where they stand in a tile, from the pixel of the line on

struct LineFilter {
  std::vector<Direction> directions;
  std::size_t ridgeSides = 1;                     // of the places at the sides: up to 1.5 widths
  int halfPx = 8, reachPx = 0, ridgeReachPx = 0;  // of a line, of the places at its sides, of those of a ridge
  double grains = 1.0;                            // along a line
  int margin() const { return halfPx + reachPx; }
  int side() const { return kTile + 2 * margin(); }  // of a tile and what lies round it
};

std::vector<int> offsetsOf(const std::vector<Step>& steps, int side) {
  std::vector<int> offsets;
  offsets.reserve(steps.size());
  for (const Step& s : steps) offsets.push_back(s.y * side + s.x);
  return offsets;
}

LineFilter filterFor(double widthPx, int pixelsPerPx) {
  LineFilter filter;
  const double half = std::clamp(kHalfWidths * widthPx / pixelsPerPx, kShortestHalfPx, kLongestHalfPx);
  const int steps = static_cast<int>(std::lround(half));
  filter.halfPx = pixelsPerPx * steps;
  filter.grains = std::max(1.0, (2.0 * steps + 1.0) / kGrainLengthPx);
  const int count = static_cast<int>(kDirectionsPerPx * steps);
  const double stepPx = std::max(kLeastSideStepPx * pixelsPerPx, kSideStepWidths * widthPx);
  std::vector<DirectionSteps> directions;
  for (int k = 0; k < count; ++k) {
    const double a = std::numbers::pi * k / count;
    const Vec2 t(std::cos(a), std::sin(a)), n(-t.y(), t.x());
    DirectionSteps d;
    const auto step = [](const Vec2& v) {
      return Step{static_cast<int>(std::lround(v.x())), static_cast<int>(std::lround(v.y()))};
    };
    for (int i = pixelsPerPx; i <= filter.halfPx; i += pixelsPerPx) {
      d.ahead.push_back(step(i * t));
      d.back.push_back(step(-i * t));
    }
    for (double off = kFlankFrom * widthPx; off <= kFlankTo * widthPx + 0.5 * stepPx; off += stepPx) {
      for (const double side : {1.0, -1.0}) {
        std::vector<Step>& places = side > 0.0 ? d.left : d.right;
        const Step s = step(side * off * n);
        if (!places.empty() && places.back().x == s.x && places.back().y == s.y) continue;
        places.push_back(s);
        if (off <= kRidgeTo * widthPx) filter.ridgeSides = std::max(filter.ridgeSides, places.size());
        filter.reachPx = std::max({filter.reachPx, std::abs(s.x), std::abs(s.y)});
      }
    }
    directions.push_back(std::move(d));
  }
  for (const DirectionSteps& d : directions) {
    for (const std::vector<Step>* places : {&d.left, &d.right}) {
      for (std::size_t k = 0; k < std::min(filter.ridgeSides, places->size()); ++k)
        filter.ridgeReachPx = std::max({filter.ridgeReachPx, std::abs((*places)[k].x), std::abs((*places)[k].y)});
    }
  }
  const int side = filter.side();
  for (const DirectionSteps& d : directions) {
    filter.directions.push_back(
        {offsetsOf(d.ahead, side), offsetsOf(d.back, side), offsetsOf(d.left, side), offsetsOf(d.right, side)});
  }
  return filter;
}

BATTEN_HOT_LOOP void darkestOf(const float* values, int count, float* __restrict darkest) {
  for (int i = 0; i < count; ++i) darkest[i] = values[i] < darkest[i] ? values[i] : darkest[i];
}

struct Pixel {
  int x, y;
};

// The part of a tile that is looked at.
struct TilePart {
  int x0 = kTile, y0 = kTile, x1 = 0, y1 = 0;
};

TilePart partWith(const std::vector<Pixel>& pixels) {
  TilePart part;
  for (const Pixel& p : pixels) {
    part.x0 = std::min(part.x0, p.x);
    part.y0 = std::min(part.y0, p.y);
    part.x1 = std::max(part.x1, p.x + 1);
    part.y1 = std::max(part.y1, p.y + 1);
  }
  return part;
}

// Brightness of one tile and what lies round it, and its means along lines.
class Tile {
 public:
  Tile(const GreyImage& grey, int x0, int y0, const LineFilter& filter)
      : margin_(filter.margin()),
        side_(filter.side()),
        grey_(area()),
        mean_(area()),
        best_(area()),
        ahead_(area()),
        back_(area()),
        noted_(area()) {
    for (int y = 0; y < side_; ++y) {
      const std::uint16_t* row = grey.row(std::clamp(y0 - margin_ + y, 0, grey.height - 1));
      for (int x = 0; x < side_; ++x) {
        grey_[index(x, y)] = static_cast<float>(row[std::clamp(x0 - margin_ + x, 0, grey.width - 1)]) *
                             static_cast<float>(1.0 / GreyImage::kGreyUnit);
      }
    }
    std::fill(best_.begin(), best_.end(), 255.0f);
  }

  // Nothing counts as darker than `depth` [grey] below the paper, which most of a tile is.
  void limitDarkness(float depth) {
    std::vector<float> sorted = grey_;
    const auto paper = static_cast<std::ptrdiff_t>(kPaperRank * static_cast<double>(sorted.size()));
    const float darkest = elementOfRank(sorted, paper) - depth;
    for (float& grey : grey_) grey = std::max(grey, darkest);
  }

  // Of a part of the tile, and as far round it as `reach`.
  void meanAlong(const Direction& d, int reach, const TilePart& part) {
    const int from = margin_ + part.x0 - reach, count = part.x1 - part.x0 + 2 * reach;
    const auto weight = 1.0f / static_cast<float>(d.ahead.size());
    for (int y = margin_ + part.y0 - reach; y < margin_ + part.y1 + reach; ++y) {
      const float* grey = grey_.data() + index(from, y);
      float *ahead = ahead_.data() + index(from, y), *back = back_.data() + index(from, y);
      folds_.sum(grey, d.ahead.data(), static_cast<int>(d.ahead.size()), count, ahead);
      folds_.sum(grey, d.back.data(), static_cast<int>(d.back.size()), count, back);
      float* mean = mean_.data() + index(from, y);
      for (int i = 0; i < count; ++i) {
        mean[i] = 0.5f * weight * (ahead[i] + back[i]);
        ahead[i] = weight * std::max(ahead[i], back[i]);
      }
    }
  }

  // Darkest mean of all directions at every pixel of a part.
  void noteDarkest(const TilePart& part) {
    const int from = margin_ + part.x0, count = part.x1 - part.x0;
    for (int y = margin_ + part.y0; y < margin_ + part.y1; ++y)
      darkestOf(mean_.data() + index(from, y), count, best_.data() + index(from, y));
  }

  // At every pixel of a part the brighter of its sides: of each the darkest mean.
  void noteFlanks(const Direction& d, const TilePart& part) {
    noteSides(d, part, std::max(d.left.size(), d.right.size()), folds_.least,
              [](float left, float right, float) { return std::max(left, right); });
  }
  // At every pixel of a part, how much darker than both its sides a line is where it is fainter: ahead or behind.
  void noteRidges(const Direction& d, std::size_t sides, const TilePart& part) {
    noteSides(d, part, sides, folds_.most,
              [](float left, float right, float ahead) { return std::min(left, right) - ahead; });
  }
  // [grey] What was noted at pixel (x, y) of the tile.
  float noted(int x, int y) const { return noted_[index(margin_ + x, margin_ + y)]; }
  float best(int x, int y) const { return best_[index(margin_ + x, margin_ + y)]; }

 private:
  int area() const { return side_ * side_; }  // a tile and what lies round it: some 10^4 pixels
  int index(int x, int y) const { return y * side_ + x; }

  template <class Note>
  void noteSides(const Direction& d, const TilePart& part, std::size_t most, StepFold ofPlaces, const Note& note) {
    const int count = part.x1 - part.x0;
    std::array<float, kTile> left, right;
    for (int y = part.y0; y < part.y1; ++y) {
      const int from = index(margin_ + part.x0, margin_ + y);
      const float *mean = mean_.data() + from, *ahead = ahead_.data() + from;
      ofPlaces(mean, d.left.data(), static_cast<int>(std::min(most, d.left.size())), count, left.data());
      ofPlaces(mean, d.right.data(), static_cast<int>(std::min(most, d.right.size())), count, right.data());
      for (int i = 0; i < count; ++i) noted_[from + i] = note(left[i], right[i], ahead[i]);
    }
  }

  StepFolds folds_ = stepFolds();
  int margin_, side_;
  std::vector<float> grey_, mean_, best_, ahead_, back_, noted_;
};

std::vector<Pixel> bodyPixels(const BitImage& body, int x0, int y0) {
  std::vector<Pixel> pixels;
  for (int y = y0; y < std::min(body.height, y0 + kTile); ++y) {
    for (std::uint64_t bits = body.row(y)[x0 / kTile]; bits != 0; bits &= bits - 1) {
      pixels.push_back({std::countr_zero(bits), y - y0});
    }
  }
  return pixels;
}

// [grey] What is clear in a tile. The deviation is a mean of absolute values; over a line it shrinks with the number of
// grains.
float clearAt(const GraininessMap& grain, const LineFilter& filter, const Vec2& middle) {
  const double share =
      std::max(kLeastShare, kClear * kAbsoluteToSigma * grain.deviationAt(middle) / std::sqrt(filter.grains));
  return static_cast<float>(share * grain.depthAt(middle));
}

// Looks for gaps and lines, tile by tile: the pixels of the tile that are some.
struct LineSearch {
  const GreyImage& grey;
  const GraininessMap& grain;
  const LineFilter& filter;

  std::vector<Pixel> gaps(const BitImage& where, int x0, int y0) const {
    std::vector<Pixel> pixels = bodyPixels(where, x0, y0), found;
    if (pixels.empty()) return found;
    Tile tile(grey, x0, y0, filter);
    const float clear = clearAt(grain, filter, middleOf(x0, y0));
    const TilePart all = partWith(pixels);
    for (const Direction& d : filter.directions) {
      tile.meanAlong(d, 0, all);
      tile.noteDarkest(all);
    }
    for (const Direction& d : filter.directions) {
      if (pixels.empty()) break;
      const TilePart part = partWith(pixels);
      tile.meanAlong(d, filter.reachPx, part);
      tile.noteFlanks(d, part);
      std::erase_if(pixels, [&](const Pixel& p) {
        // Lines that are clearly darker lie at both sides.
        if (!(tile.noted(p.x, p.y) < tile.best(p.x, p.y) - clear)) return false;
        found.push_back(p);
        return true;
      });
    }
    return found;
  }

  std::vector<Pixel> lines(const BitImage& where, int x0, int y0) const {
    std::vector<Pixel> pixels = bodyPixels(where, x0, y0), found;
    if (pixels.empty()) return found;
    Tile tile(grey, x0, y0, filter);
    const Vec2 middle = middleOf(x0, y0);
    // Across darker strokes, as letters beside faint lines, a mean would be as dark as along a line.
    tile.limitDarkness(static_cast<float>(grain.depthAt(middle)));
    const float least =
        std::max(kHalf * clearAt(grain, filter, middle), static_cast<float>(kLineDepth * grain.depthAt(middle)));
    for (const Direction& d : filter.directions) {
      if (pixels.empty()) break;
      const TilePart part = partWith(pixels);
      tile.meanAlong(d, filter.ridgeReachPx, part);
      tile.noteRidges(d, filter.ridgeSides, part);
      std::erase_if(pixels, [&](const Pixel& p) {
        if (!(tile.noted(p.x, p.y) > least)) return false;
        found.push_back(p);
        return true;
      });
    }
    return found;
  }

  static Vec2 middleOf(int x0, int y0) { return {x0 + 0.5 * kTile, y0 + 0.5 * kTile}; }
};

}  // namespace

OrientedLines filterOrientedLines(const BitImage& body, const GreyImage& grey, const GraininessMap& grain,
                                  double widthPx, const RunContext& context, int pixelsPerPx) {
  OrientedLines found{BitImage(body.width, body.height), BitImage(body.width, body.height)};
  if (widthPx > kWidestPx * pixelsPerPx) return found;
  const LineFilter filter = filterFor(widthPx, pixelsPerPx);
  const LineSearch search{grey, grain, filter};
  const int columns = body.wordsPerRow, rows = (body.height + kTile - 1) / kTile;
  // A tile is as wide as a word of the picture: no two write into one.
  const auto overTiles = [&](BitImage& picture, const auto& pixelsOf) {
    parallelFor(context, columns * rows, 1, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const int x0 = i % columns * kTile, y0 = i / columns * kTile;
        for (const Pixel& p : pixelsOf(x0, y0)) picture.set(x0 + p.x, y0 + p.y, true);
      }
    });
  };
  const BitImage near = grown(body, filter.halfPx, context);
  overTiles(found.gaps, [&](int x0, int y0) { return search.gaps(near, x0, y0); });
  if (context.isCancelled()) return found;
  // A gap runs on as far as the lines that it was seen between.
  found.gaps = keepPieces(found.gaps, {.minArea = 0, .minDiagonal = static_cast<double>(filter.halfPx)}, context);
  // Lines alone are mended by closing and by bridging their gaps; it is near other lines that both fail.
  const BitImage beside = both(grown(found.gaps, 2 * filter.halfPx, context), near);
  overTiles(found.lines, [&](int x0, int y0) { return search.lines(beside, x0, y0); });
  found.gaps = without(std::move(found.gaps), found.lines);
  return found;
}

}  // namespace batten
