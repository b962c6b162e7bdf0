// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/narrow_paper.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "core/base/parallel.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"
#include "core/image/plane.h"

namespace batten {
namespace {

constexpr double kVariance = 0.6;  // [px^2] of the Gaussian before greys are compared
// Wider paper is brighter than a threshold: blur reaches no farther than a pixel and a half of the page.
constexpr int kReachPx = 6;
constexpr int kBesidePx = 3;  // across the direction, where the paper beside a thin bar begins
// Of the depth of the fainter side. Two lines are told apart from .26 on (Rayleigh); the grain of a pencil that blur
// has smoothed rises by as much.
constexpr float kLeastRise = 0.4f;
constexpr float kLeastRiseGrey = 4.0f;  // [grey] noise of the page rises less
constexpr float kBarShare = 0.5f;       // of the rise: what is so much darker than both its other sides is a bar
constexpr int kLeastArea = 8;           // [px^2] two pixels of the page

struct RayStep {
  int x, y;
  RayStep back() const { return {-x, -y}; }
  RayStep across() const { return {-y, x}; }
};
constexpr std::array<RayStep, 4> kRays{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};

class NarrowPaper {
 public:
  NarrowPaper(const Plane& grey, const PaperBackground& paper) : grey_(grey), paper_(paper) {}

  bool isAt(int x, int y) const {
    const float here = grey_.row(y)[x];
    const auto paper = static_cast<float>(paper_.at(x + 0.5, y + 0.5));
    return std::any_of(kRays.begin(), kRays.end(), [&](RayStep ray) {
      const float ink = std::max(darkest(x, y, ray), darkest(x, y, ray.back()));
      const float rise = here - ink;
      if (rise < std::max(kLeastRiseGrey, kLeastRise * (paper - ink))) return false;
      const RayStep across = ray.across();
      return std::min(brightest(x, y, across), brightest(x, y, across.back())) - here < kBarShare * rise;
    });
  }

 private:
  template <class Choose>
  float alongRay(int x, int y, RayStep ray, int reach, float value, const Choose& choose) const {
    for (int k = 1; k <= reach; ++k) {
      const int atX = x + k * ray.x, atY = y + k * ray.y;
      if (atX < 0 || atY < 0 || atX >= grey_.width || atY >= grey_.height) break;
      value = choose(value, grey_.row(atY)[atX]);
    }
    return value;
  }
  /// Beyond the page lies no ink.
  float darkest(int x, int y, RayStep ray) const {
    return alongRay(x, y, ray, kReachPx, std::numeric_limits<float>::max(),
                    [](float a, float b) { return std::min(a, b); });
  }
  float brightest(int x, int y, RayStep ray) const {
    return alongRay(x, y, ray, kBesidePx, 0.0f, [](float a, float b) { return std::max(a, b); });
  }

  const Plane& grey_;
  const PaperBackground& paper_;
};

}  // namespace

BitImage withoutNarrowPaper(BitImage ink, const GreyImage& image, const PaperBackground& paper,
                            const RunContext& context) {
  const Plane grey = smooth(shrinkGrey(image, 1, context), gaussianKernel(kVariance), context);
  if (context.isCancelled()) return ink;
  const NarrowPaper narrow(grey, paper);
  BitImage opened(ink.width, ink.height);
  parallelFor(context, ink.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int i = 0; i < ink.wordsPerRow; ++i) {
        for (std::uint64_t bits = ink.row(y)[i]; bits != 0; bits &= bits - 1) {
          const int bit = std::countr_zero(bits);
          if (narrow.isAt(i * 64 + bit, y)) opened.row(y)[i] |= std::uint64_t{1} << bit;
        }
      }
    }
  });
  if (context.isCancelled()) return ink;
  return without(std::move(ink), keepPieces(opened, {.minArea = kLeastArea}, context));
}

}  // namespace batten
