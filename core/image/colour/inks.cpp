// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/colour/inks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/parallel.h"
#include "core/image/colour/ink_look.h"
#include "core/image/colour/paper_colour.h"

namespace batten {
namespace {

constexpr double kLeastShareOfInk = 0.02;      // of the ink of the page: less is no ink of its own
constexpr int kHueBins = 72;                   // 5 degrees each
constexpr double kApartDeg = 40.0;             // of two inks
constexpr std::int64_t kListSamples = 400000;  // pixels that are looked at: bounds the time
constexpr double kLeastInkOfPage = 2e-4;       // of its pixels: less holds no ink to be listed
constexpr int kInkRimPx = 2;                   // of a stroke, fainter than ink
constexpr int kLeastPiecePx = 8;               // [px] area; smaller pieces are noise

double apartDeg(double a, double b) {
  const double away = std::fabs(std::fmod(a - b, 360.0));
  return std::min(away, 360.0 - away);
}

struct InkSums {
  double count = 0.0, red = 0.0, green = 0.0, blue = 0.0;
  void add(const Rgb8& c) {
    count += 1.0;
    red += c.red;
    green += c.green;
    blue += c.blue;
  }
  void add(const InkSums& o) {
    count += o.count;
    red += o.red;
    green += o.green;
    blue += o.blue;
  }
  Rgb8 mean() const {
    const auto level = [&](double sum) { return static_cast<std::uint8_t>(count > 0.0 ? sum / count : 255.0); };
    return {level(red), level(green), level(blue)};
  }
};

/// The tallest hues of the page, at least kApartDeg from one another, each with what lies nearer to it than to others.
std::vector<FoundInk> tallestHues(const std::array<InkSums, kHueBins>& bins, double all) {
  const auto around = [&](int bin) {
    double sum = 0.0;
    for (int i = -2; i <= 2; ++i) sum += bins[(bin + i + kHueBins) % kHueBins].count;
    return sum;
  };
  const double width = 360.0 / kHueBins;
  std::vector<int> order(kHueBins);
  for (int i = 0; i < kHueBins; ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return around(a) > around(b); });
  std::vector<double> hues;
  for (const int bin : order) {
    const double hue = (bin + 0.5) * width;
    const bool isNew = std::none_of(hues.begin(), hues.end(), [&](double h) { return apartDeg(h, hue) < kApartDeg; });
    if (isNew && around(bin) >= 0.5 * kLeastShareOfInk * all) hues.push_back(hue);
  }
  std::vector<FoundInk> inks;
  for (const double hue : hues) {
    InkSums sums;
    double offset = 0.0;
    for (int i = 0; i < kHueBins; ++i) {
      const double here = (i + 0.5) * width;
      const bool isNearest = std::all_of(hues.begin(), hues.end(),
                                         [&](double h) { return h == hue || apartDeg(h, here) > apartDeg(hue, here); });
      if (!isNearest || apartDeg(hue, here) > 0.5 * kApartDeg) continue;
      sums.add(bins[i]);
      offset += bins[i].count * (std::fmod(here - hue + 540.0, 360.0) - 180.0);
    }
    if (sums.count < kLeastShareOfInk * all) continue;
    const double mean = std::fmod(hue + offset / sums.count + 360.0, 360.0);
    inks.push_back({{std::round(mean)}, sums.mean(), sums.count / all});
  }
  std::sort(inks.begin(), inks.end(),
            [](const FoundInk& a, const FoundInk& b) { return *a.colour.hueDeg < *b.colour.hueDeg; });
  return inks;
}

}  // namespace

std::optional<Error> validate(const InkChoice& choice) {
  for (const auto* list : {&choice.keep, &choice.drop}) {
    for (const InkColour& c : *list) {
      if (c.hueDeg && !(*c.hueDeg >= 0.0 && *c.hueDeg <= 360.0))
        return Error{ErrorCode::BadParameter, "The hue of an ink must lie between 0 and 360 degrees.", {}};
    }
  }
  if (!(choice.rangeDeg >= 5.0 && choice.rangeDeg <= 90.0))
    return Error{ErrorCode::BadParameter, "The range of hues must lie between 5 and 90 degrees.", {}};
  return std::nullopt;
}

bool isSameInk(const InkColour& a, const InkColour& b, double rangeDeg) {
  if (!a.hueDeg || !b.hueDeg) return !a.hueDeg && !b.hueDeg;
  return apartDeg(*a.hueDeg, *b.hueDeg) <= rangeDeg;
}

double hueApartDeg(const InkColour& a, const InkColour& b) {
  return a.hueDeg && b.hueDeg ? apartDeg(*a.hueDeg, *b.hueDeg) : 0.0;
}

bool isTraced(const InkColour& ink, const InkChoice& choice) {
  const auto holds = [&](const std::vector<InkColour>& list) {
    return std::any_of(list.begin(), list.end(),
                       [&](const InkColour& c) { return isSameInk(c, ink, choice.rangeDeg); });
  };
  return (choice.keep.empty() || holds(choice.keep)) && !holds(choice.drop);
}

std::vector<FoundInk> findInks(const GreyImage& grey, const ColourImage& colour, const RunContext& context) {
  std::vector<FoundInk> inks;
  if (colour.isEmpty()) return inks;
  const PaperColour paper = measurePaperColour(grey, colour, context);
  const std::int64_t pixels = static_cast<std::int64_t>(grey.width) * grey.height;
  int stride = 1;
  while (pixels / (static_cast<std::int64_t>(stride) * stride) > kListSamples) ++stride;
  std::array<InkSums, kHueBins> bins{};
  InkSums neutral;
  std::int64_t seen = 0;
  LookReader reader(paper, grey.width, grey.height);
  for (int y = stride / 2; y < grey.height && !context.isCancelled(); y += stride) {
    reader.setRow(y);
    for (int x = stride / 2; x < grey.width; x += stride) {
      ++seen;
      const Rgb8& c = colour.row(y)[x];
      const InkLook look = reader.at(x, c);
      if (look.kind == InkKind::Paper || look.darkness < kSureDarkness) continue;
      if (look.kind == InkKind::Neutral)
        neutral.add(c);
      else
        bins[std::min(kHueBins - 1, static_cast<int>(look.hueDeg * kHueBins / 360.0f))].add(c);
    }
  }
  double all = neutral.count;
  for (const InkSums& bin : bins) all += bin.count;
  if (all < kLeastInkOfPage * static_cast<double>(seen)) return inks;
  inks = tallestHues(bins, all);
  if (neutral.count >= kLeastShareOfInk * all)
    inks.insert(inks.begin(), {InkColour{}, neutral.mean(), neutral.count / all});
  return inks;
}

std::optional<DroppedInk> dropInks(const GreyImage& page, const GreyImage& scan, const ColourImage& colour,
                                   const InkChoice& choice, const RunContext& context) {
  if (colour.isEmpty() || choice.isAll()) return std::nullopt;
  const PaperColour paper = measurePaperColour(scan, colour, context);
  if (context.isCancelled()) return std::nullopt;
  // Noise of the colours is evened out; the header only lends the pixels.
  const cv::Mat3b pixels(colour.height, colour.width,
                         reinterpret_cast<cv::Vec3b*>(const_cast<Rgb8*>(colour.pixels.data())));
  cv::Mat3b even;
  cv::blur(pixels, even, {3, 3});
  cv::Mat1b dropped(colour.height, colour.width), kept(colour.height, colour.width);
  parallelFor(context, colour.height, kRowsPerBlock, [&](int begin, int end) {
    LookReader reader(paper, colour.width, colour.height);
    for (int y = begin; y < end; ++y) {
      reader.setRow(y);
      for (int x = 0; x < colour.width; ++x) {
        const cv::Vec3b& c = even(y, x);
        const InkLook look = reader.at(x, {c[0], c[1], c[2]});
        const bool isInk = look.kind != InkKind::Paper;
        const InkColour ink = look.colour();
        const bool isWanted = !isInk || isTraced(ink, choice);
        dropped(y, x) = isInk && !isWanted ? 255 : 0;
        kept(y, x) = isInk && isWanted && look.darkness >= kSureDarkness ? 255 : 0;
      }
    }
  });
  if (context.isCancelled()) return std::nullopt;
  // Single pixels of the wrong colour along a stroke are noise of the colours.
  cv::Mat1i labels, stats;
  cv::Mat1d centres;
  for (cv::Mat1b* mask : {&dropped, &kept}) {
    cv::connectedComponentsWithStats(*mask, labels, stats, centres, 8, CV_32S);
    if (context.isCancelled()) return std::nullopt;
    for (int y = 0; y < mask->rows; ++y) {
      for (int x = 0; x < mask->cols; ++x) {
        if ((*mask)(y, x) != 0 && stats(labels(y, x), cv::CC_STAT_AREA) < kLeastPiecePx) (*mask)(y, x) = 0;
      }
    }
    if (context.isCancelled()) return std::nullopt;
  }
  cv::dilate(dropped, dropped, cv::Mat(), {-1, -1}, kInkRimPx);
  dropped.setTo(0, kept);
  DroppedInk result;
  result.pixels = cv::countNonZero(dropped);
  if (result.pixels == 0) return std::nullopt;
  result.grey = page;
  parallelFor(context, page.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < page.width; ++x) {
        if (dropped(y, x) == 0) continue;
        const double level = static_cast<double>(paper.levelAt(x, y)) * GreyImage::kGreyUnit;
        std::uint16_t& out = result.grey.row(y)[x];
        out = std::max(out, static_cast<std::uint16_t>(std::clamp(level, 0.0, 65535.0)));
      }
    }
  });
  return result;
}

}  // namespace batten
