// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/curves_on_top.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/base/segment_foot.h"
#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/sample_tree.h"
#include "core/curve/span_curve.h"

namespace batten {
namespace {

constexpr double kOnTop = 1e-7;  ///< Of the size of a curve: how near it lies to one that it lies on top of.
constexpr int kTopSamples = 17;  // along a curve
constexpr double kSteps = 1e6;   ///< Lengths that differ by less than a millionth are alike.
/// Stretches that a curve is looked at by: enough that few of a page full of curves have one near a place.
constexpr int kMostStretches = 32;

/// One curve of the document, to be compared with the others.
struct TopCandidate {
  std::size_t line = 0, piece = 0;
  const NurbsCurve* curve = nullptr;
  long size = 0;  ///< Logarithm of the length, rounded, so that the last digits put no curve before its like.
};

TopCandidate candidateOf(const NurbsCurve& curve, std::size_t line, std::size_t piece, CancelCheck check) {
  TopCandidate candidate{.line = line, .piece = piece, .curve = &curve};
  candidate.size = std::lround(kSteps * std::log(std::max(ArcLength(curve, check).total(), kOnTop)));
  return candidate;
}

/// No part of a stretch of a curve lies farther from its chord than `reach`.
struct CurveStretch {
  Vec2 from, to;
  double reach = 0.0;

  bool mayHold(const Vec2& place) const { return footOnSegment(place, from, to).away.norm() <= reach; }
};

/// Every span in equal parts of its parameter: a part of the share h lies within h^2 / 8 of the largest second
/// derivative of its chord.
std::vector<CurveStretch> partsOfSpans(const NurbsCurve& curve, double near) {
  const SpanBasis basis(curve.degree(), curve.knots(), curve.controlPointCount(), 0);
  const SpanCurve spans(basis, curve.controlPoints());
  const int most = kMostStretches / basis.spanCount();
  std::vector<CurveStretch> stretches;
  for (int span = 0; span < basis.spanCount(); ++span) {
    const int parts = spans.bendBound(span) <= near ? 1 : most;  // a straight span is one chord
    const double reach = spans.bendBound(span) / (8.0 * parts * parts) + near;
    Vec2 from = spans.at({span, 0.0}, 0)[0];
    for (int k = 1; k <= parts; ++k) {
      const Vec2 to = spans.at({span, static_cast<double>(k) / parts}, 0)[0];
      stretches.push_back({from, to, reach});
      from = to;
    }
  }
  return stretches;
}

std::vector<CurveStretch> stretchesOf(const NurbsCurve& curve, CancelCheck check) {
  const double near = 2.0 * kOnTop * extent(curve);  // what lies on a curve is no larger than it
  if (!curve.isRational() && 2 * std::ssize(curve.breaks()) <= kMostStretches) return partsOfSpans(curve, near);
  const ClosestPointFinder finder(curve, check);
  const std::vector<CurvePlace>& places = finder.places();
  const std::size_t last = places.size() - 1, step = last / kMostStretches + 1;
  std::vector<CurveStretch> stretches;
  for (std::size_t first = 0; first < last; first += step) {
    const std::size_t end = std::min(first + step, last);
    CurveStretch stretch{places[first].point, places[end].point};
    for (std::size_t i = first; i <= end; ++i) {
      const double away = footOnSegment(places[i].point, stretch.from, stretch.to).away.norm();
      stretch.reach = std::max(stretch.reach, away + places[i].bulge);
    }
    stretch.reach += near;
    stretches.push_back(stretch);
  }
  return stretches;
}

/// A curve that stays, with what is needed to ask it for distances.
struct KeptCurve {
  KeptCurve(const TopCandidate& one, CancelCheck check)
      : candidate(one), stretches(stretchesOf(*one.curve, check)), check_(check) {}
  bool mayHold(const Vec2& place) const {
    return std::any_of(stretches.begin(), stretches.end(),
                       [&](const CurveStretch& stretch) { return stretch.mayHold(place); });
  }
  double distanceTo(const Vec2& place) {
    if (!finder_) finder_.emplace(*candidate.curve, check_);
    return finder_->closestTo(place).distance;
  }
  const TopCandidate& candidate;
  std::vector<CurveStretch> stretches;

 private:
  CancelCheck check_;
  std::optional<ClosestPointFinder> finder_;  ///< Few curves are ever asked; it takes far more memory than they do.
};

/// Stretches of curves by the squares of the page that they run through, so that the curves that may lie under a place
/// are known without looking at all of them. A long straight curve runs through few of the squares within its box.
class StretchSquares {
 public:
  void add(KeptCurve& curve) {
    double length = 0.0, reach = 0.0;
    for (const CurveStretch& stretch : curve.stretches) {
      length += (stretch.to - stretch.from).norm();
      reach = std::max(reach, stretch.reach);
    }
    const int level = std::ilogb(std::max({length / kSquaresAlong, 2.0 * reach, kLeastSquareMm})) + 1;
    levels_.insert(level);
    for (const CurveStretch& stretch : curve.stretches) add(stretch, level, curve);
  }
  /// Whether `isIt(curve)` holds for one that may hold the place.
  template <class IsIt>
  bool anyAt(const Vec2& place, const IsIt& isIt) const {
    return std::any_of(levels_.begin(), levels_.end(), [&](int level) {
      const auto found = squares_.find(keyOf(level, place));
      if (found == squares_.end()) return false;
      return std::any_of(found->second.begin(), found->second.end(),
                         [&](const Entry& one) { return one.stretch->mayHold(place) && isIt(*one.curve); });
    });
  }

 private:
  using Key = std::array<std::int64_t, 3>;
  static constexpr double kLeastSquareMm = 1e-6;
  static constexpr double kRoom = 1.01;          ///< For rounding at the border of a box.
  static constexpr double kSquaresAlong = 32.0;  ///< Of a curve: more take more memory, fewer hold more curves each.

  struct Entry {
    const CurveStretch* stretch = nullptr;
    KeptCurve* curve = nullptr;
  };

  /// The squares around each part of the chord that is no longer than a square.
  void add(const CurveStretch& stretch, int level, KeptCurve& curve) {
    const Vec2 reach = Vec2::Constant(kRoom * stretch.reach), along = stretch.to - stretch.from;
    const int parts = static_cast<int>(along.norm() / std::ldexp(1.0, level)) + 1;
    std::vector<Key> keys;
    for (int k = 0; k < parts; ++k) {
      const Vec2 a = stretch.from + along * k / parts, b = stretch.from + along * (k + 1) / parts;
      const Key low = keyOf(level, a.cwiseMin(b) - reach), high = keyOf(level, a.cwiseMax(b) + reach);
      for (std::int64_t x = low[1]; x <= high[1]; ++x)
        for (std::int64_t y = low[2]; y <= high[2]; ++y) keys.push_back({level, x, y});
    }
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    for (const Key& key : keys) squares_[key].push_back({&stretch, &curve});
  }
  static Key keyOf(int level, const Vec2& place) {
    const double side = std::ldexp(1.0, level);
    constexpr double kFarthest = 1e15;  // squares from the origin; a 64 bit number holds it
    const auto numberOf = [&](double v) {
      return static_cast<std::int64_t>(std::clamp(std::floor(v / side), -kFarthest, kFarthest));
    };
    return {level, numberOf(place.x()), numberOf(place.y())};
  }

  std::set<int> levels_;
  std::map<Key, std::vector<Entry>> squares_;
};

bool liesOn(const std::vector<CurveSample>& samples, KeptCurve& longer, double near) {
  return longer.mayHold(samples[kTopSamples / 2].point) && longer.mayHold(samples.back().point) &&
         std::all_of(samples.begin(), samples.end(),
                     [&](const CurveSample& sample) { return longer.distanceTo(sample.point) <= near; });
}

}  // namespace

Result<PiecesOnTop> piecesOnTop(const ExportDocument& document, const RunContext& context) {
  std::vector<TopCandidate> all;
  for (std::size_t i = 0; i < document.curves.size() && !context.isCancelled(); ++i)
    for (std::size_t k = 0; k < document.curves[i].pieces.size(); ++k)
      all.push_back(candidateOf(document.curves[i].pieces[k].curve, i, k, context));
  PiecesOnTop found;
  if (all.size() < 2) return found;
  // Of two alike the earlier one stays, so it comes first; a longer one comes before what lies on it.
  std::stable_sort(all.begin(), all.end(),
                   [](const TopCandidate& a, const TopCandidate& b) { return a.size > b.size; });
  std::deque<KeptCurve> kept;
  StretchSquares squares;
  for (const TopCandidate& one : all) {
    if (context.isCancelled()) return cancelled();
    const double near = kOnTop * extent(*one.curve);
    const auto samples = sampleByArcLength(*one.curve, kTopSamples, context);
    const std::string& layer = document.curves[one.line].layer;
    const bool isOnTop = squares.anyAt(samples.front().point, [&](KeptCurve& other) {
      return document.curves[other.candidate.line].layer == layer && liesOn(samples, other, near);
    });
    if (isOnTop) {
      found.insert({one.line, one.piece});
      continue;
    }
    kept.emplace_back(one, context);
    squares.add(kept.back());
  }
  if (context.isCancelled()) return cancelled();
  return found;
}

}  // namespace batten
