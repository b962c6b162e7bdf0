// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/width_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/segment_foot.h"
#include "core/curve/cubic.h"
#include "core/curve/foot_step.h"
#include "core/exchange/model/stroke_middle.h"

namespace batten {
namespace {

/// Follows a border along the middle of its stroke.
class MiddleWalk {
 public:
  explicit MiddleWalk(const std::vector<StrokeMiddle>& middles) : middles_(middles) {}

  /// How far a place is from the border of the stroke: 0 on it.
  double off(const Vec2& p) {
    double least = kFar;
    if (isBegun_) least = offNear(p, middle_, at_ - kNear, at_ + kNear, kFar);
    // A larger distance than any before is not taken on trust: the border may have left its stretch.
    if (!(least <= largest_)) {
      // Stretch by stretch: where a stroke crosses itself, the other branch's ink does not count.
      for (std::size_t m = 0; m < middles_.size(); ++m)
        for (std::ptrdiff_t i = 0; i < std::ssize(middles_[m].places); i += kNear)
          least = std::min(least, offNear(p, m, i - kNear, i + kNear, least));
    }
    largest_ = std::max(largest_, least);
    isBegun_ = true;
    return least;
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();  // mm
  static constexpr std::ptrdiff_t kNear = 64;                              ///< [places] to either side of the last one
  /// Of the width: deeper in the ink a place is no border; of a stroke that grows by g the sides lie g^2 / 16 deep.
  static constexpr double kDeepShare = 0.01, kDeepPerGrowth = 0.125;

  struct Foot {
    double t = 0.0;  ///< 0..1 from one place to the next.
    double distance = 0.0, half = 0.0;
  };

  /// The arc between two places, by its directions: the chord alone is off by a hundredth of the width.
  static Foot footOn(const MiddlePlace& a, const MiddlePlace& b, const Vec2& p) {
    const double length = std::max((b.at - a.at).norm(), std::numeric_limits<double>::min());
    Foot foot{footOnSegment(p, a.at, b.at).share};
    Vec2 at = a.at;
    constexpr int kLoopRounds = 4;  // of Newton, from a near start
    for (int round = 0; round <= kLoopRounds; ++round) {
      const double t = foot.t, r = 1.0 - t;
      at = r * r * (1.0 + 2.0 * t) * a.at + t * t * (1.0 + 2.0 * r) * b.at +
           length * t * r * (r * a.along - t * b.along);
      if (round == kLoopRounds) break;
      const Vec2 along = (r * a.along + t * b.along).normalized();
      const double bend = std::max(kFootTrust, 1.0 - std::lerp(a.kappa, b.kappa, t) * (p - at).dot(leftNormal(along)));
      foot.t = std::clamp(t + (p - at).dot(along) / (length * bend), 0.0, 1.0);
    }
    foot.distance = (p - at).norm();
    foot.half = 0.5 * std::lerp(a.width, b.width, foot.t);
    return foot;
  }

  /// Over the feet of a place on a stretch of the middle: how far it is from half the width at one of them, or, in the
  /// ink, how deep.
  /// @param best where it is known to be nearer to a border: a stretch with a better one becomes the present one.
  double offNear(const Vec2& p, std::size_t middle, std::ptrdiff_t from, std::ptrdiff_t to, double best) {
    const auto& places = middles_[middle].places;
    const std::ptrdiff_t n = std::ssize(places), end = std::min(to, n - 1);
    double least = kFar, depth = 0.0, slack = 0.0, before = 0.0;
    std::optional<std::ptrdiff_t> place;
    for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, from); i < end; ++i) {
      const MiddlePlace &a = places[i], &b = places[i + 1];
      const double away = (a.at - p).norm(), step = (b.at - a.at).norm();
      if (0.5 * a.width - away > depth) {
        depth = 0.5 * a.width - away;
        slack = a.width * std::max(kDeepShare, kDeepPerGrowth * a.growth * a.growth);
      }
      const double reach = (2.0 + std::abs(a.growth)) * step;
      if (std::abs(away - 0.5 * a.width) - reach > least || !(step > 0.0)) {
        if (step > 0.0) before = 0.5;
        continue;
      }
      const Foot foot = footOn(a, b, p);
      // The middle passes p between two of its places, at one of them, or ends.
      const bool isFoot = foot.t > 0.0 ? foot.t < 1.0 || i + 2 == n : before == 1.0 || i == 0;
      before = foot.t;
      if (!isFoot || std::abs(foot.distance - foot.half) >= least) continue;
      least = std::abs(foot.distance - foot.half);
      place = i;
    }
    const double off = depth > slack ? std::max(least, depth) : least;
    if (place && off < best) {
      middle_ = middle;
      at_ = *place;
    }
    return off;
  }

  const std::vector<StrokeMiddle>& middles_;
  std::size_t middle_ = 0;
  std::ptrdiff_t at_ = 0;
  bool isBegun_ = false;
  double largest_ = 0.0;
};

}  // namespace

double distanceFromWidth(const std::vector<std::array<Vec2, 4>>& border, const ExportCurve& line, CancelCheck check) {
  const std::vector<StrokeMiddle> middles = strokeMiddles(line, check);
  if (middles.empty() || border.empty()) return std::numeric_limits<double>::infinity();
  constexpr int kPlacesPerCubic = 4;  // where the border is compared
  MiddleWalk walk(middles);
  double worst = 0.0;
  for (const auto& c : border) {
    if (check.isCancelled()) break;
    for (int k = 0; k < kPlacesPerCubic; ++k) {
      worst = std::max(worst, walk.off(cubicPoint(c, static_cast<double>(k) / kPlacesPerCubic)));
    }
  }
  return worst;
}

}  // namespace batten
