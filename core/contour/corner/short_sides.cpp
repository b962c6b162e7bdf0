// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/short_sides.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/angle.h"
#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/contour/corner/corner_certainty.h"
#include "core/contour/corner/corner_geometry.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kSideUnits = 1.5;           // of line on either side, beyond what its corner rounds
constexpr double kApartUnits = 2.0;          // along the line: nearer places are one turn
constexpr double kStraightScore = 0.5;       // of the turn: what the score of two straight sides keeps
constexpr double kParallelSine = 0.08;       // of the angle between two sides that meet nowhere near
constexpr double kNoiseLengthPx = 8.0;       // as long are the dents of a line,
constexpr double kLineSlopeVariance = 12.0;  // and so the slope of a straight line of length L varies, S / L^3
constexpr std::size_t kFewestStrokePoints = 8;

struct ShortCandidate {
  int index = 0;
  double s = 0.0;  // [px] along the line
  double angle = 0.0, score = 0.0;
  bool isKnown = false;  // a certain corner already
  std::optional<Vec2> meet = {};
  double rough = 0.0;
};

// Where two straight sides meet.
std::optional<Vec2> meetOf(const LocalQuadratic& before, const LocalQuadratic& after) {
  const double sine = cross(before.r1, after.r1), sizes = before.r1.norm() * after.r1.norm();
  if (std::abs(sine) < kParallelSine * sizes || !(sizes > 0.0)) return std::nullopt;
  const double t = cross(Vec2(after.r0 - before.r0), after.r1) / sine;
  return Vec2(before.r0 + t * before.r1);
}

class ShortSideSearch {
 public:
  ShortSideSearch(const Contour& stroke, double unit)
      : stroke_(stroke),
        unit_(unit),
        s_(cumulativeLength(positionsOf(stroke.points))),
        length_(polylineLength(positionsOf(stroke.points), stroke.closed)) {}

  void addKnown(const CornerSuggestion& corner) {
    kept_.push_back(
        {.index = corner.pointIndex, .s = s_[corner.pointIndex], .angle = corner.turningAngleRad, .isKnown = true});
  }

  std::vector<CornerSuggestion> find(const RunContext& context) {
    std::vector<ShortCandidate> candidates;
    for (int i = 0; i < std::ssize(s_) && !context.isCancelled(); ++i)
      if (const auto candidate = at(i)) candidates.push_back(*candidate);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const ShortCandidate& a, const ShortCandidate& b) { return a.score > b.score; });
    for (const ShortCandidate& c : candidates) {
      if (context.isCancelled()) return {};
      const auto isBeside = [&](const ShortCandidate& other) { return along(c, other) < kApartUnits * unit_; };
      if (std::ranges::none_of(kept_, isBeside)) kept_.push_back(c);
    }
    std::ranges::sort(kept_, {}, &ShortCandidate::index);
    std::vector<CornerSuggestion> certain;
    const CornerJudge judge(stroke_);
    for (int k = 0; k < std::ssize(kept_); ++k) {
      if (kept_[k].isKnown) continue;
      const CornerEvidence e = evidenceOf(k);
      const double certainty = judge.certainty(e);
      if (certainty >= kCertainCorner)
        certain.push_back({0, e.pointIndex, e.positionPx, e.angleRad, certainty, e.isLocated});
    }
    return certain;
  }

 private:
  double along(const ShortCandidate& a, const ShortCandidate& b) const {
    const double apart = std::abs(a.s - b.s);
    return stroke_.closed ? std::min(apart, length_ - apart) : apart;
  }

  std::optional<ShortCandidate> at(int i) const {
    if (!stroke_.points[i].sigmaPx) return std::nullopt;  // the grain of a pencil bends what is short
    const double inner = roundedZonePx(stroke_, i), outer = inner + kSideUnits * unit_;
    const auto turning = turningAt(stroke_, i, inner, outer, 1);
    if (!turning || std::abs(turning->angleRad) < kLeastPennedTurn ||
        turning->score < kStraightScore * std::abs(turning->angleRad))
      return std::nullopt;
    const auto before = fitOneSide(stroke_, i, -1, inner, outer, 1), after = fitOneSide(stroke_, i, 1, inner, outer, 1);
    return ShortCandidate{i,
                          s_[i],
                          turning->angleRad,
                          turning->score,
                          false,
                          meetOf(before->fit, after->fit),
                          std::max(before->fit.residualRms, after->fit.residualRms)};
  }

  CornerEvidence evidenceOf(int k) const {
    const ShortCandidate& here = kept_[k];
    const int count = static_cast<int>(kept_.size());
    CornerEvidence e;
    e.pointIndex = here.index;
    e.angleRad = here.angle;
    e.positionPx = here.meet.value_or(stroke_.points[here.index].at);
    e.isLocated = here.meet.has_value();
    e.roughPx = here.rough;
    e.angleNoiseRad =
        here.rough * std::sqrt(2.0 * kLineSlopeVariance * kNoiseLengthPx / std::pow(kSideUnits * unit_, 3));
    e.freeBefore = k > 0 ? here.s - kept_[k - 1].s : here.s;
    e.freeAfter = k + 1 < count ? kept_[k + 1].s - here.s : length_ - here.s;
    if (stroke_.closed && count == 1) {
      e.freeBefore = e.freeAfter = 0.5 * length_;
    } else if (stroke_.closed) {
      if (k == 0) e.freeBefore += length_ - kept_[count - 1].s;
      if (k + 1 == count) e.freeAfter += kept_[0].s;
    }
    if (stroke_.closed ? count > 1 : k > 0) e.angleBefore = kept_[wrapIndex(k - 1, count)].angle;
    if (stroke_.closed ? count > 1 : k + 1 < count) e.angleAfter = kept_[wrapIndex(k + 1, count)].angle;
    return e;
  }

  const Contour& stroke_;
  double unit_;
  std::vector<double> s_;
  double length_;
  std::vector<ShortCandidate> kept_;  // by place, once found
};

}  // namespace

std::vector<CornerSuggestion> cornersOfShortSides(const ContourSet& set, std::span<const CornerSuggestion> known,
                                                  const RunContext& context) {
  std::vector<std::vector<CornerSuggestion>> found(set.contours.size());
  parallelFor(context, static_cast<int>(found.size()), 1, [&](int begin, int end) {
    for (int c = begin; c < end && !context.isCancelled(); ++c) {
      const Contour& stroke = set.contours[c];
      const std::vector<float> widths = strokeWidthsOf(stroke.points);
      if (stroke.kind != ContourKind::Centreline || widths.empty() || stroke.points.size() < kFewestStrokePoints)
        continue;
      const double width = upperMedian(std::vector<double>(widths.begin(), widths.end()));
      ShortSideSearch search(stroke, std::max(kLeastUnitPx, width));
      for (const CornerSuggestion& corner : known)
        if (corner.contour == c && corner.certainty >= kCertainCorner) search.addKnown(corner);
      found[c] = search.find(context);
      for (CornerSuggestion& corner : found[c]) corner.contour = c;
    }
  });
  std::vector<CornerSuggestion> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace batten
