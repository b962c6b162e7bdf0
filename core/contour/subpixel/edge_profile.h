// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/image/grey_image.h"

namespace batten {

// Profiles across a line: samples at u = -4..4 px, half a pixel apart, u positive towards the ink.
inline constexpr int kProfileHalf = 8;
inline constexpr int kProfileSamples = 2 * kProfileHalf + 1;  ///< The middle one, and those to both sides.
inline constexpr double kProfileStepPx = 0.5;                 ///< Two samples a pixel.
inline constexpr double kHalfStepPx = 0.5 * kProfileStepPx;   ///< A place nearer to a sample is at it.
inline constexpr double kSideFromPx = 1.9;  ///< The levels of ink and paper are taken beyond this distance,
inline constexpr double kSideShare = 0.6;   ///< or beyond this part of a side that is not as long.
inline constexpr double profileU(int k) { return (k - kProfileHalf) * kProfileStepPx; }  ///< [px] Place of a sample.

/// Grey level 0..255 at an image position, by cubic convolution (Catmull-Rom; reproduces parabolas, so it adds no blur
/// of second order), page border replicated.
double sampleCubic(const GreyImage& grey, const Vec2& at);
/// The same by bilinear interpolation: cheaper, adds about 1/6 px^2 of blur.
double sampleLinear(const GreyImage& grey, const Vec2& at);

/// Profiles across a line, one a point, row by row, kProfileSamples each.
struct EdgeProfiles {
  std::vector<float> grey;
  int count() const { return static_cast<int>(grey.size()) / kProfileSamples; }
  const float* row(std::ptrdiff_t i) const { return grey.data() + i * kProfileSamples; }
  float* row(std::ptrdiff_t i) { return grey.data() + i * kProfileSamples; }
};

/// Samples the profiles at `base` along `normal` (unit, towards the ink).
EdgeProfiles sampleProfiles(const GreyImage& grey, std::span<const Vec2> base, std::span<const Vec2> normal, bool cubic,
                            const RunContext& context);
/// Averages neighbouring profiles along the line (Gaussian, sigma in points), in the frame of the line.
EdgeProfiles averageAlong(const EdgeProfiles& profiles, bool closed, double sigma, const RunContext& context);

/// Other borders in sight of an edge, in any unit of length; absent: none in sight.
struct EdgeTwins {
  std::optional<double> ink = {};    ///< Width of the ink, to its far border.
  std::optional<double> paper = {};  ///< Width of the paper gap, to the next piece of ink.
};

/// What a profile says about its surroundings.
struct EdgeSpan {
  double centre = 0.0;                   ///< [px] where the grey falls steepest towards the ink, to half a sample.
  double lo = 0.0, hi = 0.0;             ///< [px] the profile belongs to this edge within lo..hi.
  std::optional<double> inkTwin = {};    ///< [px] as EdgeTwins.
  std::optional<double> paperTwin = {};  ///< [px]
  double contrast = 0.0;                 ///< [grey] paper minus ink within lo..hi.
  bool hasEdge() const { return contrast > 0.0; }
  /// Whether a sample belongs to this edge.
  bool holds(double u) const { return u >= lo - kHalfStepPx && u <= hi + kHalfStepPx; }
  /// The twins in units of `unitPx`.
  EdgeTwins twinsIn(double unitPx) const {
    EdgeTwins twins;
    if (inkTwin) twins.ink = *inkTwin / unitPx;
    if (paperTwin) twins.paper = *paperTwin / unitPx;
    return twins;
  }
};
/// Finds the edge nearest to u = 0 and how far it reaches until another edge turns the grey back.
EdgeSpan findEdgeSpan(const float* profile);

/// Half-level crossing nearest to the centre of the span; NaN-free, falls back to the centre.
double halfLevelCrossing(const float* profile, const EdgeSpan& span);

/// How much the grey falls from paper to ink between u = -reach and u = reach of each point of an outline, for two
/// reaches [px], averaged along it (sigma in points). An edge that goes on rising further out is soft.
struct EdgeRise {
  float inner = 0.0f, outer = 0.0f;  ///< [grey]
};
std::vector<EdgeRise> edgeRises(std::span<const Vec2> chain, bool closed, const GreyImage& grey,
                                std::array<double, 2> reachPx, double sigma, const RunContext& context);

/// Standard normal distribution and density from a table (error < 2e-5), so that millions of evaluations stay cheap.
class NormalTable {
 public:
  static const NormalTable& instance();
  struct Value {
    double cdf = 0.0, pdf = 0.0;
  };
  /// Phi(x) and phi(x).
  Value at(double x) const {
    if (x <= -kRange || x >= kRange) return {x > 0.0 ? 1.0 : 0.0, 0.0};
    const double position = (x + kRange) * kPerUnit;
    const int i = static_cast<int>(position);
    const double f = position - i;
    return {cdf_[i] + f * (cdf_[i + 1] - cdf_[i]), pdf_[i] + f * (pdf_[i + 1] - pdf_[i])};
  }

 private:
  NormalTable();
  static constexpr int kPerUnit = 64;  // entries a standard deviation: a line between two is wrong by less than 2e-5
  static constexpr int kRange = 6;     // standard deviations: beyond, the tail is 1e-9
  std::array<float, 2 * kRange * kPerUnit + 2> cdf_{};
  std::array<float, 2 * kRange * kPerUnit + 2> pdf_{};
};

}  // namespace batten
