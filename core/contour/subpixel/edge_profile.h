// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/image/grey_image.h"

namespace batten {

// Profiles across a line: samples at u = -4..4 px, half a pixel apart, u positive towards the ink.
inline constexpr int kProfileHalf = 8;
inline constexpr int kProfileSamples = 2 * kProfileHalf + 1;
inline constexpr double kProfileStepPx = 0.5;
inline constexpr double kSideFromPx = 1.9;  ///< The levels of ink and paper are taken beyond this distance.
inline constexpr double profileU(int k) { return (k - kProfileHalf) * kProfileStepPx; }

/// Grey level 0..255 at an image position, by cubic convolution (Catmull-Rom; reproduces parabolas, so it adds no blur
/// of second order), page border replicated.
double sampleCubic(const GreyImage& grey, const Vec2& at);
/// The same by bilinear interpolation: cheaper, adds about 1/6 px^2 of blur.
double sampleLinear(const GreyImage& grey, const Vec2& at);

/// One profile per point, row by row, kProfileSamples each.
struct ProfileBand {
  std::vector<float> grey;
  int count() const { return static_cast<int>(grey.size()) / kProfileSamples; }
  const float* row(int i) const { return grey.data() + static_cast<std::size_t>(i) * kProfileSamples; }
  float* row(int i) { return grey.data() + static_cast<std::size_t>(i) * kProfileSamples; }
};

/// Samples the profiles at `base` along `normal` (unit, towards the ink).
ProfileBand sampleProfiles(const GreyImage& grey, std::span<const Vec2> base, std::span<const Vec2> normal, bool cubic,
                           const RunContext& context);
/// Averages neighbouring profiles along the line (Gaussian, sigma in points), in the frame of the line.
ProfileBand averageAlong(const ProfileBand& band, bool closed, double sigma, const RunContext& context);

/// What a profile says about its surroundings.
struct EdgeSpan {
  double centre = 0.0;        ///< [px] where the grey falls steepest towards the ink, to half a sample.
  double lo = 0.0, hi = 0.0;  ///< [px] the profile belongs to this edge within lo..hi.
  double inkTwin = 0.0;       ///< [px] width of the ink if its far border is in sight, else 0.
  double paperTwin = 0.0;     ///< [px] width of the paper gap if another piece of ink is in sight, else 0.
  double contrast = 0.0;      ///< [grey] paper minus ink within lo..hi; <= 0: no edge.
};
/// Finds the edge nearest to u = 0 and how far it reaches until another edge turns the grey back.
EdgeSpan findEdgeSpan(const float* profile);

/// Half-level crossing nearest to the centre of the span; NaN-free, falls back to the centre.
double halfLevelCrossing(const float* profile, const EdgeSpan& span);

/// How much the grey falls from paper to ink between u = -reach and u = reach of each point of an outline, for two
/// reaches [px], averaged along it (sigma in points). An edge that goes on rising further out is soft.
struct EdgeRises {
  std::vector<float> inner, outer;
};
EdgeRises edgeRises(std::span<const Vec2> chain, bool closed, const GreyImage& grey, std::array<double, 2> reachPx,
                    double sigma, const RunContext& context);

/// Standard normal distribution and density from a table (error < 2e-5), so that millions of evaluations stay cheap.
class NormalTable {
 public:
  static const NormalTable& instance();
  /// Phi(x) and phi(x).
  void eval(double x, double& cdf, double& pdf) const {
    if (x <= -kRange || x >= kRange) {
      cdf = x > 0.0 ? 1.0 : 0.0;
      pdf = 0.0;
      return;
    }
    const double position = (x + kRange) * kPerUnit;
    const auto i = static_cast<std::size_t>(position);
    const double f = position - static_cast<double>(i);
    cdf = cdf_[i] + f * (cdf_[i + 1] - cdf_[i]);
    pdf = pdf_[i] + f * (pdf_[i + 1] - pdf_[i]);
  }

 private:
  NormalTable();
  static constexpr int kPerUnit = 64;
  static constexpr int kRange = 6;
  std::array<float, 2 * kRange * kPerUnit + 2> cdf_{};
  std::array<float, 2 * kRange * kPerUnit + 2> pdf_{};
};

}  // namespace batten
