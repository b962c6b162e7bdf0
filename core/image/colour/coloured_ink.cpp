// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/colour/coloured_ink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/colour/paper_colour.h"

namespace batten {
namespace {

constexpr double kLeastGain = 0.06;       // of the paper's grey
constexpr double kGainPerNoise = 5.0;     // standard deviations of the paper's own gain
constexpr float kPaperBrightness = 0.8f;  // of the paper around: what the noise is measured on
constexpr float kDarkInk = 0.7f;          // of the paper around: darker is ink that the grey sees
constexpr int kGainSamples = 20000;       // pixels that the noise is measured on
constexpr double kMostTint = 0.8;  // of what ink must gain: a place of the paper of another colour; more is a wash
constexpr int kLeastArea = 12, kLeastSide = 8;  // [px] smaller pieces of colour are dust or noise
constexpr double kMostDarkBorder = 0.25;        // of its border lies at dark ink: more is a rim of that
constexpr double kLeastRise = 0.25;             // of the contrast in grey
constexpr int kRimPx = 2;                       // of the ink's edge, where the gain falls below the limit

/// Grey less the darkest channel, each divided by its paper, per pixel of a row. [grey, may be negative]
void gainsOfRow(const GreyImage& grey, const ColourImage& colour, const PaperColour& paper, int y,
                std::array<std::vector<float>, 3>& ratios, std::vector<float>& out) {
  paper.ratiosOfRow(y, grey.width, grey.height, ratios);
  out.resize(grey.width);
  const Rgb8* in = colour.row(y);
  const std::uint16_t* levels = grey.row(y);
  constexpr float kStep = 1.0f / static_cast<float>(GreyImage::kGreyUnit);  // to grey levels 0..255
  for (int x = 0; x < grey.width; ++x) {
    const float red = static_cast<float>(in[x].red) / ratios[0][x],
                green = static_cast<float>(in[x].green) / ratios[1][x],
                blue = static_cast<float>(in[x].blue) / ratios[2][x];
    out[x] = static_cast<float>(levels[x]) * kStep - std::min(red, std::min(green, blue));
  }
}

cv::Mat1b gainPicture(const GreyImage& grey, const ColourImage& colour, const PaperColour& paper,
                      const RunContext& context) {
  cv::Mat1b gains(grey.height, grey.width);
  parallelFor(context, grey.height, kRowsPerBlock, [&](int begin, int end) {
    std::array<std::vector<float>, 3> ratios;
    std::vector<float> row;
    for (int y = begin; y < end; ++y) {
      gainsOfRow(grey, colour, paper, y, ratios, row);
      std::uint8_t* out = gains.ptr(y);
      for (int x = 0; x < grey.width; ++x) out[x] = static_cast<std::uint8_t>(std::clamp(row[x] + 0.5f, 0.0f, 255.0f));
    }
  });
  return gains;
}

/// The spread of what paper gains, whatever else lies there: on the side that is calmer. Coloured ink gains more than
/// paper, so that it lies on one side of the values of a place, or where it covers most, paper on the other.
double calmerSigma(std::vector<float>& values) {
  constexpr double kOuter = 0.1, kInner = 0.4;  // of the ranks
  // Between them, of a normal variable: above. Below, noise of the darkest of three channels has a shorter tail.
  constexpr double kSigmasAbove = 1.03, kSigmasBelow = 0.6;
  const auto at = [&](double share) { return static_cast<double>(lowerQuantile(values, share)); };
  return std::min((at(kInner) - at(kOuter)) / kSigmasBelow, (at(1.0 - kOuter) - at(1.0 - kInner)) / kSigmasAbove);
}

/// What coloured ink must gain to stand out of the noise of the colours around it, on the picture of smoothed gains.
class GainLimits {
 public:
  GainLimits(const GreyImage& grey, const cv::Mat1b& gains, const PaperColour& paper)
      : width_(grey.width), height_(grey.height), least_(kLeastGain * paper.paperLevel) {
    const std::int64_t count = static_cast<std::int64_t>(grey.width) * grey.height;
    const std::int64_t stride = std::max<std::int64_t>(1, count / kGainSamples) | 1;  // in step with no even pattern
    std::vector<float> samples;
    std::array<std::vector<float>, kPlaces * kPlaces> ofPlace;
    for (std::int64_t i = 0; i < count; i += stride) {
      const int x = static_cast<int>(i % grey.width), y = static_cast<int>(i / grey.width);
      if (static_cast<float>(grey.level(x, y)) < kPaperBrightness * paper.paperAt(x, y)) continue;
      samples.push_back(static_cast<float>(gains(y, x)));
      ofPlace[rowOf(y) * kPlaces + columnOf(x)].push_back(static_cast<float>(gains(y, x)));
    }
    limits_.fill(least_);
    if (samples.empty()) return;
    const float middle = upperMedian(samples);
    for (float& sample : samples) sample -= middle;
    const double sigma = robustSigma(samples);
    for (int i = 0; i < kPlaces * kPlaces; ++i) {
      const bool isKnown = std::ssize(ofPlace[i]) >= kFewestSamples;
      const double own = isKnown ? calmerSigma(ofPlace[i]) : 0.0;
      const double limit = std::max(least_, static_cast<double>(middle) + kGainPerNoise * std::max(sigma, own));
      const double tint = isKnown ? static_cast<double>(upperMedian(ofPlace[i]) - middle) : 0.0;
      limits_[i] = limit + std::clamp(tint, 0.0, kMostTint * limit);
    }
  }

  static constexpr int kPlaces = 8;  // across and down the page

  double at(int x, int y) const { return limits_[rowOf(y) * kPlaces + columnOf(x)]; }
  /// The first pixel of a column of places; that of kPlaces is the width.
  int startOf(int column) const { return static_cast<int>((std::int64_t{column} * width_ + kPlaces - 1) / kPlaces); }

 private:
  static constexpr int kFewestSamples = 60;  // of a place: its noise within a fifth

  int columnOf(int x) const { return static_cast<int>(std::int64_t{x} * kPlaces / width_); }
  int rowOf(int y) const { return static_cast<int>(std::int64_t{y} * kPlaces / height_); }

  int width_, height_;
  double least_;
  std::array<double, kPlaces * kPlaces> limits_{};
};

cv::Mat1b gainingPixels(const cv::Mat1b& gains, const GainLimits& limits, const RunContext& context) {
  cv::Mat1b mask(gains.size());
  parallelFor(context, gains.rows, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int column = 0; column < GainLimits::kPlaces; ++column) {
        const int from = limits.startOf(column), to = limits.startOf(column + 1);
        if (from == to) continue;  // a page of few pixels
        // Gains are whole numbers.
        const auto most = static_cast<std::uint8_t>(std::min(255.0, std::floor(limits.at(from, y))));
        const std::uint8_t* in = gains.ptr(y);
        std::uint8_t* out = mask.ptr(y);
        for (int x = from; x < to; ++x) out[x] = in[x] > most ? 255 : 0;
      }
    }
  });
  return mask;
}

constexpr int kEdgePx = 5;           // within which ink ends
constexpr double kMostBeyond = 0.6;  // of the least gain, that far from the ink: a tint that fades in has no edge

struct ColouredPiece {
  int border = 0, darkBorder = 0;  ///< [px]
  int beyond = 0;                  ///< [px] kEdgePx away.
  double gainBeyond = 0.0;         ///< Sum of what they gain, in parts of the least gain of ink there.
  double gain = 0.0, depth = 0.0;  ///< [grey] sums: what is gained, and what the grey has already.
};

/// Adds to a piece what is gained kEdgePx beside one of its border pixels, outside all pieces.
void addBeyond(const cv::Mat1b& gains, const cv::Mat1b& mask, const cv::Point& at, const GainLimits& limits,
               ColouredPiece& piece) {
  const cv::Rect page(0, 0, mask.cols, mask.rows);
  for (const cv::Point step :
       {cv::Point(kEdgePx, 0), cv::Point(-kEdgePx, 0), cv::Point(0, kEdgePx), cv::Point(0, -kEdgePx)}) {
    const cv::Point to = at + step;
    if (!page.contains(to) || mask(to) != 0) continue;
    ++piece.beyond;
    piece.gainBeyond += gains(to) / limits.at(to.x, to.y);
  }
}

/// Which pieces of `mask` are ink that gains, as a mask.
cv::Mat1b gainingPieces(const GreyImage& grey, const cv::Mat1b& gains, const cv::Mat1b& mask, const GainLimits& limits,
                        const PaperColour& paper) {
  cv::Mat1b dark(mask.size());
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      const bool isDark = mask(y, x) == 0 && static_cast<float>(grey.level(x, y)) < kDarkInk * paper.paperAt(x, y);
      dark(y, x) = isDark ? 255 : 0;
    }
  }
  cv::dilate(dark, dark, cv::Mat(), {-1, -1}, kRimPx);
  cv::Mat1i labels, stats;
  cv::Mat1d centres;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8, CV_32S);
  std::vector<ColouredPiece> pieces(count);
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      const int label = labels(y, x);
      if (label == 0) continue;
      ColouredPiece& piece = pieces[label];
      piece.gain += gains(y, x);
      piece.depth += std::max(0.0, static_cast<double>(paper.paperAt(x, y)) - grey.level(x, y));
      const bool isBorder = (x > 0 && mask(y, x - 1) == 0) || (x + 1 < grey.width && mask(y, x + 1) == 0) ||
                            (y > 0 && mask(y - 1, x) == 0) || (y + 1 < grey.height && mask(y + 1, x) == 0);
      if (!isBorder) continue;
      ++piece.border;
      addBeyond(gains, mask, {x, y}, limits, piece);
      if (dark(y, x) != 0) ++piece.darkBorder;
    }
  }
  std::vector<std::uint8_t> isTaken(pieces.size(), 0);
  for (int i = 1; i < count; ++i) {
    const ColouredPiece& piece = pieces[i];
    const bool isInk = stats(i, cv::CC_STAT_AREA) >= kLeastArea &&
                       std::max(stats(i, cv::CC_STAT_WIDTH), stats(i, cv::CC_STAT_HEIGHT)) >= kLeastSide;
    const bool hasEdge = piece.gainBeyond <= kMostBeyond * piece.beyond;
    isTaken[i] = isInk && hasEdge && piece.darkBorder <= kMostDarkBorder * piece.border &&
                 piece.gain >= kLeastRise * piece.depth;
  }
  cv::Mat1b taken = std::move(dark);  // its memory: a large page holds no mask more than it needs
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) taken(y, x) = isTaken[labels(y, x)] != 0 ? 255 : 0;
  }
  return taken;
}

}  // namespace

std::optional<ColouredInk> darkenColouredInk(const GreyImage& grey, const ColourImage& colour,
                                             const RunContext& context) {
  if (colour.isEmpty()) return std::nullopt;
  const PaperColour paper = measurePaperColour(grey, colour, context);
  if (context.isCancelled()) return std::nullopt;
  cv::Mat1b smoothed;
  cv::blur(gainPicture(grey, colour, paper, context), smoothed, {3, 3});
  if (context.isCancelled()) return std::nullopt;
  const GainLimits limits(grey, smoothed, paper);
  const cv::Mat1b mask = gainingPixels(smoothed, limits, context);
  if (context.isCancelled() || cv::countNonZero(mask) == 0) return std::nullopt;
  cv::Mat1b taken = gainingPieces(grey, smoothed, mask, limits, paper);
  if (context.isCancelled() || cv::countNonZero(taken) == 0) return std::nullopt;
  cv::dilate(taken, taken, cv::Mat(), {-1, -1}, kRimPx);
  ColouredInk result;
  result.pixels = cv::countNonZero(taken);
  result.grey = grey;
  parallelFor(context, grey.height, kRowsPerBlock, [&](int begin, int end) {
    std::array<std::vector<float>, 3> ratios;
    std::vector<float> row;
    for (int y = begin; y < end; ++y) {
      const std::uint8_t* take = taken.ptr(y);
      if (std::none_of(take, take + grey.width, [](std::uint8_t t) { return t != 0; })) continue;
      gainsOfRow(grey, colour, paper, y, ratios, row);
      std::uint16_t* out = result.grey.row(y);
      for (int x = 0; x < grey.width; ++x) {
        if (take[x] == 0 || row[x] <= 0.0f) continue;
        const float level = static_cast<float>(out[x]) - row[x] * static_cast<float>(GreyImage::kGreyUnit);
        out[x] = static_cast<std::uint16_t>(std::max(0.0f, std::round(level)));
      }
    }
  });
  return result;
}

}  // namespace batten
