// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_suggestions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <span>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/contour/corner/corner_certainty.h"
#include "core/contour/corner/corner_finder.h"
#include "core/contour/corner/corner_geometry.h"
#include "core/contour/corner/corner_marks.h"
#include "core/polyline/point_grid.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kSure = 5.0;          // standard deviations
constexpr double kBristleReach = 3.0;  // standard deviations: as far as neighbours are averaged

struct Candidate {
  int index = 0;
  double angle = 0.0, score = 0.0, s = 0.0;
  double scale = 0.0;   // [px] looked at on either side
  bool isTurn = false;  // given as one
  double rough = 0.0;   // [px] of the line there
};

// The angle between the chords on either side, signed as Turning: cheap, and never much smaller than that of a corner.
double chordAngle(const Contour& contour, int i, int reach) {
  const int n = static_cast<int>(contour.points.size());
  const int a = contour.closed ? wrapIndex(i - reach, n) : i - reach;
  const int b = contour.closed ? wrapIndex(i + reach, n) : i + reach;
  if (a < 0 || b >= n) return 0.0;
  const Vec2 in = contour.points[i].at - contour.points[a].at;
  const Vec2 out = contour.points[b].at - contour.points[i].at;
  return -std::atan2(cross(in, out), in.dot(out));
}

// [px] How rough the line is about every point: the median over 300 px of what parabolas of one scale leave over.
// Not complete when cancelled.
std::vector<double> roughnessOf(const Contour& contour, double scale, const RunContext& context) {
  constexpr int kStride = 6, kWindow = 25;  // points; fits to either side
  constexpr double kLeastFitReach = 0.5;    // of the scale
  const int n = static_cast<int>(contour.points.size());
  std::vector<double> residual;
  for (int i = 0; i < n; i += kStride) {
    if (context.isCancelled()) return {};
    const auto fit = fitOneSide(contour, i, 1, 0.0, scale);
    residual.push_back(fit && fit->reach > kLeastFitReach * scale ? fit->fit.residualRms : 0.0);
  }
  std::vector<double> rough(n), window;
  const int count = static_cast<int>(residual.size());
  for (int k = 0; k < count; ++k) {
    if (context.isCancelled()) return {};
    window.clear();
    for (int j = -kWindow; j <= kWindow; ++j) {
      if (!contour.closed && (k + j < 0 || k + j >= count)) continue;
      window.push_back(residual[wrapIndex(k + j, count)]);
    }
    const auto middle = upperMedian(window);
    for (int i = k * kStride; i < std::min(n, (k + 1) * kStride); ++i) rough[i] = middle;
  }
  return rough;
}

// [rad] Standard deviation of the angle between two parabolas of length `scale` on such a line, whose dents are about
// `kDentPx` long: the slope at the end of a parabola has variance 192 S / L^3 for noise of density S.
double angleNoise(double roughPx, double scale) {
  constexpr double kDentPx = 8.0, kSlopeVariance = 192.0;  // how long dents are; see above
  return roughPx * std::sqrt(2.0 * kSlopeVariance * kDentPx / (scale * scale * scale));
}

// On a clean line a corner is one however short its sides are. On a rough one it may be a dent, which has gone once
// more of the line is looked at; a corner has not.
bool isMoreThanADent(const Contour& contour, int i, const Turning& turning, double rough, double inner, double scale) {
  constexpr double kCleanScore = 0.75;            // of the angle: the sides are smooth
  constexpr double kCoarser = 3.5, kStays = 0.7;  // of the scale; of the angle that is left there
  const double angle = std::abs(turning.angleRad);
  if (turning.score >= kCleanScore * angle && angle >= kSure * angleNoise(rough, scale)) return true;
  const auto coarse = turningAt(contour, i, inner, inner + kCoarser * scale);
  return coarse && coarse->angleRad * turning.angleRad > 0.0 && std::abs(coarse->angleRad) >= kStays * angle &&
         std::abs(coarse->angleRad) >= kSure * angleNoise(rough, kCoarser * scale);
}

// Without the bristles of a ragged border: every point the mean of its neighbours. Kept point for point. At an open end
// the window is cut off and not mirrored as by smoothPolyline(), which holds the end itself, though it may be that of a
// bristle. Not complete when cancelled.
Contour smoothed(const Contour& contour, double sigmaPx, double step, const RunContext& context) {
  Contour out = contour;
  const int n = static_cast<int>(contour.points.size());
  const double sigma = sigmaPx / step;
  const int reach = std::min(static_cast<int>(kBristleReach * sigma), n / 2);
  std::vector<double> weights;
  for (int k = 0; k <= reach; ++k) weights.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
  for (int i = 0; i < n && !context.isCancelled(); ++i) {
    Vec2 sum = Vec2::Zero();
    double total = 0.0;
    for (int k = -reach; k <= reach; ++k) {
      const int j = contour.closed ? wrapIndex(i + k, n) : i + k;
      if (j < 0 || j >= n) continue;
      const double weight = weights[std::abs(k)];
      sum += weight * contour.points[j].at;
      total += weight;
    }
    out.points[i].at = sum / total;
  }
  return out;
}

// Looks for the corners of one contour.
class CornerDetector {
 public:
  CornerDetector(const Contour& contour, double minAngle, double scale, const RunContext& context)
      : contour_(contour), minAngle_(minAngle), scale_(scale), s_(cumulativeLength(positionsOf(contour.points))) {
    if (s_.size() < kFewestLinePoints) return;
    step_ = std::max(kLeastScaleStepPx, s_.back() / (static_cast<double>(s_.size()) - 1.0));
    rough_ = roughnessOf(contour, scale, context);
    for (int i = 0; i < std::ssize(rough_); ++i) {
      if (!isRagged(i)) continue;
      smooth_ = smoothed(contour, kSmoothing * scale, step_, context);
      break;
    }
  }

  /// [px] The longest stretch that is looked at on either side of a point.
  static double widestScale(double scale) { return std::max(1.0, kRaggedScale) * scale; }

  std::vector<Candidate> candidates(const RunContext& context) const {
    std::vector<Candidate> found;
    for (int i = 0; i < std::ssize(rough_) && !context.isCancelled(); ++i) {
      const auto candidate = isRagged(i) ? onRagged(i) : onClean(i);
      if (candidate) found.push_back(*candidate);
    }
    return found;
  }

  // The sharpest point of a sharp feature, unless it is one of the many of a ragged line.
  std::optional<Candidate> sharpest(const SharpFeature& feature) const {
    constexpr double kArmPx = 6.0;       // of the chords
    constexpr double kChordShare = 0.9;  // of the smallest angle: chords see less of a turn
    Candidate best;
    const int n = static_cast<int>(rough_.size());
    for (int k = feature.first; k <= feature.last && n > 0; ++k) {
      const int i = wrapIndex(k, n);
      const double angle = chordAngle(contour_, i, std::max(2, static_cast<int>(std::lround(kArmPx / step_))));
      if (std::abs(angle) > std::abs(best.angle)) best = {i, angle, std::abs(angle), s_[i], scale_, true, rough_[i]};
    }
    if (!best.isTurn || std::abs(best.angle) < kChordShare * minAngle_) return std::nullopt;
    if (isRagged(best.index)) return std::nullopt;
    return best;
  }

 private:
  // Of `scale_`: what dents and bristles are smoothed over, and what is left out and looked at beside a corner then.
  static constexpr double kSmoothing = 0.6, kRaggedInner = 0.7, kRaggedScale = 2.0;
  static constexpr std::size_t kFewestLinePoints = 8;  // shorter lines have no two sides
  static constexpr double kLeastScaleStepPx = 0.1;     // keeps reaches in points finite where points coincide

  // Whether dents look like corners here.
  bool isRagged(int i) const {
    constexpr double kRagged = 1.5;  // of the smallest angle: noise of the angle as large passes for corners
    return kSure * angleNoise(rough_[i], scale_) > kRagged * minAngle_;
  }

  bool isStraight(const Contour& contour, int i, double scale) const {
    constexpr double kChordScale = 0.6, kChordShare = 0.6;  // chords see less of a turn than tangents
    const int n = static_cast<int>(contour.points.size());
    const int reach = std::clamp(static_cast<int>(kChordScale * scale / step_), 2, std::max(2, n / 3));
    return std::abs(chordAngle(contour, i, reach)) < kChordShare * minAngle_;
  }

  std::optional<Candidate> onClean(int i) const {
    // The score is the angle discounted by misfit; half of it lost means that the sides are no sides.
    constexpr double kLeastScore = 0.5;
    constexpr double kBlurredPx = 3.0, kMostBlurred = 0.25;  // left out beside a corner; of the scale
    if (isStraight(contour_, i, scale_)) return std::nullopt;
    const double inner = contour_.kind == ContourKind::Outline ? std::min(kBlurredPx, kMostBlurred * scale_)
                                                               : roundedZonePx(contour_, i);
    const auto turning = turningAt(contour_, i, inner, inner + scale_);
    if (!turning || std::abs(turning->angleRad) < minAngle_) return std::nullopt;
    if (turning->score < kLeastScore * std::abs(turning->angleRad)) return std::nullopt;
    if (!isMoreThanADent(contour_, i, *turning, rough_[i], inner, scale_)) return std::nullopt;
    return Candidate{i, turning->angleRad, turning->score, s_[i], scale_, false, rough_[i]};
  }

  // More of the line is looked at, without its bristles, and the sides are straight: what bends them counts as noise.
  std::optional<Candidate> onRagged(int i) const {
    constexpr double kLeastScore = 0.25;  // of the angle: half of onClean(), as straight sides fit less well
    const double scale = kRaggedScale * scale_;
    if (isStraight(smooth_, i, scale)) return std::nullopt;
    const double inner =
        std::max(kRaggedInner * scale_, contour_.kind == ContourKind::Outline ? 0.0 : roundedZonePx(contour_, i));
    const auto turning = turningAt(smooth_, i, inner, inner + scale, 1);
    if (!turning || std::abs(turning->angleRad) < minAngle_) return std::nullopt;
    if (turning->score < kLeastScore * std::abs(turning->angleRad)) return std::nullopt;
    return Candidate{i, turning->angleRad, turning->score, s_[i], scale, false, rough_[i]};
  }

  const Contour& contour_;
  double minAngle_, scale_, step_ = 1.0;
  std::vector<double> s_, rough_;
  Contour smooth_;
};

// Corners along one contour, by arc length: a candidate too near to one of them is part of it.
class KeptCorners {
 public:
  KeptCorners(double length, bool closed, double widest) : length_(length), closed_(closed), widest_(widest) {}
  void add(const Candidate& c) { byArc_.emplace(c.s, c); }
  bool isNear(const Candidate& c) const {
    return isNearFrom(c, c.s) || (closed_ && (isNearFrom(c, c.s - length_) || isNearFrom(c, c.s + length_)));
  }
  /// In the order of travel.
  std::vector<Candidate> sorted() const {
    std::vector<Candidate> all;
    for (const auto& [s, candidate] : byArc_) all.push_back(candidate);
    std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.index < b.index; });
    return all;
  }

 private:
  // As if the candidate lay at `s`.
  bool isNearFrom(const Candidate& c, double s) const {
    for (auto other = byArc_.lower_bound(s - widest_); other != byArc_.end() && other->first <= s + widest_; ++other)
      if (std::abs(other->first - s) < std::max(c.scale, other->second.scale)) return true;
    return false;
  }

  double length_;
  bool closed_;
  double widest_;  // [px] of all scales
  std::multimap<double, Candidate> byArc_;
};

// In order along the contour: the sharp features, and the best of every other turn. Not complete when
// cancelled.
std::vector<Candidate> cornersOf(const Contour& contour, std::span<const SharpFeature> features, double minAngle,
                                 double scale, const RunContext& context) {
  const CornerDetector detector(contour, minAngle, scale, context);
  std::vector<Candidate> candidates = detector.candidates(context);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  const double length = polylineLength(positionsOf(contour.points), contour.closed);
  KeptCorners kept(length, contour.closed, CornerDetector::widestScale(scale));
  for (const SharpFeature& feature : features) {
    if (context.isCancelled()) break;
    if (const auto sharpest = detector.sharpest(feature)) kept.add(*sharpest);
  }
  for (const Candidate& candidate : candidates)
    if (!kept.isNear(candidate)) kept.add(candidate);
  return kept.sorted();
}

// Sides that lead elsewhere, past a neighbour that is none, locate nothing.
bool isLocated(const CornerFix& fix, double seenRad) {
  constexpr double kLeastShare = 0.5;  // of the turn that was seen
  return fix.exact && fix.angleRad * seenRad > 0.0 && std::abs(fix.angleRad) >= kLeastShare * std::abs(seenRad);
}

// What is known of every place from the line alone.
std::vector<CornerEvidence> evidenceAt(const Contour& contour, const std::vector<Candidate>& kept) {
  const double length = polylineLength(positionsOf(contour.points), contour.closed);
  std::vector<CornerEvidence> all;
  const int count = static_cast<int>(kept.size());
  for (int i = 0; i < count; ++i) {
    const Candidate& here = kept[i];
    CornerEvidence e;
    e.pointIndex = here.index;
    e.angleRad = here.angle;
    e.positionPx = contour.points[here.index].at;
    e.roughPx = here.rough;
    e.angleNoiseRad = angleNoise(here.rough, here.scale);
    e.freeBefore = i > 0 ? here.s - kept[i - 1].s : here.s;
    e.freeAfter = i + 1 < count ? kept[i + 1].s - here.s : length - here.s;
    if (contour.closed && i == 0) e.freeBefore += length - kept[count - 1].s;
    if (contour.closed && i + 1 == count) e.freeAfter += kept[0].s;
    if (contour.closed && count == 1) e.freeBefore = e.freeAfter = 0.5 * length;
    if (contour.closed ? count > 1 : i > 0) e.angleBefore = kept[wrapIndex(i - 1, count)].angle;
    if (contour.closed ? count > 1 : i + 1 < count) e.angleAfter = kept[wrapIndex(i + 1, count)].angle;
    all.push_back(e);
  }
  return all;
}

// Who draws several like corners on one line means the next like one too: what is likely, turns the same way, about as
// far as they do, and has its tip in the ink is taken for granted with them. Of strokes: ink fills their corners, while
// a border shows its own.
void judgeAlike(const Contour& stroke, const std::vector<CornerEvidence>& evidence,
                std::vector<CornerSuggestion>& all) {
  constexpr int kFewestCertain = 3;   // of a line: two may be alike by chance
  constexpr int kManyCertain = 5;     // among so many a place counts though its sides do not tell where they meet
  constexpr double kTipWidths = 0.6;  // from the line: the ink of a corner and what its filling takes
  constexpr double kLikely = 0.5, kLeastTurnShare = 0.6;  // of the certain ones' in the middle
  const std::vector<float> widths = strokeWidthsOf(stroke.points);
  if (stroke.kind != ContourKind::Centreline || widths.empty()) return;
  const double farthest = kTipWidths * upperMedian(std::vector<double>(widths.begin(), widths.end()));
  for (const double sign : {-1.0, 1.0}) {
    std::vector<double> turns;
    for (const CornerSuggestion& s : all)
      if (s.certainty >= kCertainCorner && sign * s.turningAngleRad > 0.0) turns.push_back(sign * s.turningAngleRad);
    if (std::ssize(turns) < kFewestCertain) continue;
    const double least = kLeastTurnShare * upperMedian(turns);
    for (std::size_t i = 0; i < all.size(); ++i) {
      CornerSuggestion& s = all[i];
      const bool isPlaced = evidence[i].isLocated || std::ssize(turns) >= kManyCertain;
      const bool isLike = isPlaced && s.certainty >= kLikely && sign * s.turningAngleRad >= least;
      if (isLike && (s.positionPx - stroke.points[s.pointIndex].at).norm() <= farthest)
        s.certainty = std::max(s.certainty, kCertainCorner);
    }
  }
}

// Of one contour, whose index is left at 0.
std::vector<CornerSuggestion> suggestionsAt(const Contour& contour, const std::vector<Candidate>& kept,
                                            const RunContext& context) {
  std::vector<CornerSuggestion> suggestions;
  if (kept.empty()) return suggestions;
  std::vector<int> places(kept.size());
  std::ranges::transform(kept, places.begin(), &Candidate::index);
  const std::vector<CornerFix> fixes = locateCorners(contour, places, context);
  std::vector<CornerEvidence> evidence = evidenceAt(contour, kept);
  const CornerJudge judge(contour);
  for (int i = 0; i < std::ssize(fixes); ++i) {
    CornerEvidence& e = evidence[i];
    e.isLocated = isLocated(fixes[i], kept[i].angle);
    if (e.isLocated) {
      e.positionPx = fixes[i].position;
      e.angleRad = fixes[i].angleRad;
    }
    suggestions.push_back({0, e.pointIndex, e.positionPx, e.angleRad, judge.certainty(e)});
  }
  judgeAlike(contour, evidence, suggestions);
  return suggestions;
}

}  // namespace

std::vector<CornerSuggestion> suggestCorners(const ContourSet& set, double minAngleRad, double scalePx,
                                             const RunContext& context, std::span<const SharpFeature> features) {
  if (!(minAngleRad > 0.0) || !(scalePx > 0.0)) return {};
  std::vector<std::vector<SharpFeature>> own(set.contours.size());
  for (const SharpFeature& feature : features)
    if (feature.contour >= 0 && feature.contour < std::ssize(own)) own[feature.contour].push_back(feature);
  std::vector<std::vector<CornerSuggestion>> found(set.contours.size());
  parallelFor(context, static_cast<int>(found.size()), 1, [&](int begin, int end) {
    for (int c = begin; c < end && !context.isCancelled(); ++c) {
      const Contour& contour = set.contours[c];
      found[c] = suggestionsAt(contour, cornersOf(contour, own[c], minAngleRad, scalePx, context), context);
      for (CornerSuggestion& suggestion : found[c]) suggestion.contour = c;
    }
  });
  std::vector<CornerSuggestion> suggestions;
  for (const auto& some : found) suggestions.insert(suggestions.end(), some.begin(), some.end());
  return suggestions;
}

// A mark finds the sharpest turn within its reach, so that those at two suggestions may find one corner: the suggestion
// nearer to it stays.
std::vector<CornerSuggestion> oncePerCorner(const ContourSet& set, const std::vector<CornerSuggestion>& all,
                                            double snapDistancePx, const RunContext& context) {
  constexpr double kOneCornerPx = 2.0;  // located corners as near are one
  struct Found {
    int suggestion;
    Corner corner;
  };
  std::vector<Found> found;
  CornerFinder finder(set, snapDistancePx);
  finder.sortPoints();
  for (int i = 0; i < std::ssize(all) && !context.isCancelled(); ++i) {
    if (const auto corner = finder.find(all[i].positionPx)) found.push_back({i, *corner});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.corner.snapPx < b.corner.snapPx; });
  PointGrid<const Corner*> taken(kOneCornerPx);
  std::vector<int> kept;
  for (const Found& next : found) {
    const Corner& corner = next.corner;
    bool isTaken = false;
    taken.around(corner.positionPx, [&](const Corner* other) {
      isTaken = isTaken ||
                (other->contour == corner.contour && (other->positionPx - corner.positionPx).norm() <= kOneCornerPx);
    });
    if (isTaken) continue;
    taken.add(corner.positionPx, &corner);
    kept.push_back(next.suggestion);
  }
  std::sort(kept.begin(), kept.end());
  std::vector<CornerSuggestion> result(kept.size());
  std::ranges::transform(kept, result.begin(), [&](int i) { return all[i]; });
  return result;
}

}  // namespace batten
