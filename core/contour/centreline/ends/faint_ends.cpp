// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/ends/faint_ends.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/base/angle.h"
#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/contour/centreline/profile/stroke_profile.h"
#include "core/image/bits/bit_disc.h"
#include "core/image/push_pull.h"
#include "core/image/threshold/region_surface.h"

namespace batten {
namespace {

constexpr double kLeastTrailStepPx = 6.0;        // of a search: shorter ones have no direction among the grain
constexpr double kStepWidths = 1.5;              // [stroke widths]
constexpr double kTurnDeg = 10.0;                // to either side: a hand turns less on so short a way
constexpr double kAsidePx = 1.0;                 // to either side: a weak line sways, and coarse compression shifts it
constexpr double kBesideWidths = 0.75;           // [stroke widths] from the middle to the paper at the sides,
constexpr double kBesidePx[] = {1.5, 2.5, 3.5};  // and so much more
constexpr double kMostRecentring = 1.0 / 3;      // of the way to the paper at the sides: beyond it is other ink
constexpr double kTrailCoreWidths = 0.25;        // [stroke widths] to both sides of the middle, where all is ink,
constexpr double kMostTrailCorePx = 1.0;         // and of wide ones: three lanes see what there is
constexpr int kMostHook = 3;  // part of the stretch that gives the direction: what is left out at its end is no more
constexpr double kAheadStepPx = 0.5;      // of the search for the end of the ink
constexpr double kSoftEndPx = 2.0;        // beyond its mask a stroke fades by the blur of the scan
constexpr double kLeastEndWidths = 3.0;   // [stroke widths] a shorter stroke has no direction
constexpr double kMostAheadWidths = 1.5;  // [stroke widths] of ink before a free end: more is others'
// [standard deviations of a step on paper] The darkest of nine ways, most of which share their pixels, is 1.2 darker
// than one on an average; what is not clearly more speaks against the line.
constexpr double kNoEvidence = 2.0;
constexpr double kMostEvidence = 4.0;         // [the same] of one step: a dark speck is no line
constexpr double kClearTrail = 4.0;           // [the same] of all steps: two clear ones at least
constexpr double kLeastTrailShare = 1.0 / 6;  // of the stroke's own depth: a third of the half level that tells ink,
constexpr double kMostTrailShare = 1.5;       // and what is darker than the stroke is not its weak end
constexpr double kLeastTrailDepth = 1.5;      // [grey] as of all ink
constexpr double kMostTrailLengths = 3.0;     // of the stroke's own: a short one says little about its direction
constexpr double kLeastAheadShare = 0.8;      // of a step that is ink, where other ink continues the trail
constexpr double kLeastSigma = 0.3;      // [grey] of a step: whole greys, where the scanner clipped the paper to white
constexpr int kSamplesPerSide = 12;      // of the paper, along each side of a region
constexpr int kFewestPaperSamples = 12;  // that tell the paper of a region

// How much darker than both its sides a place is on paper, by region.
struct PaperDepth {
  std::vector<float> mean, sigma;  // apart, since pushPull() and the lookup take plain numbers
};

// Looks along strokes of one width.
class StepMeter {
 public:
  StepMeter(const GreyImage& grey, double widthPx, double pixelsPerPx)
      : grey_(grey),
        pixelsPerPx_(pixelsPerPx),
        beside_(kBesideWidths * widthPx),
        core_(std::min(kMostTrailCorePx * pixelsPerPx, kTrailCoreWidths * widthPx)),
        step_(std::max(kLeastTrailStepPx * pixelsPerPx, kStepWidths * widthPx)) {}

  double stepPx() const { return step_; }
  double softEndPx() const { return kSoftEndPx * pixelsPerPx_; }
  double asidePx() const { return kAsidePx * pixelsPerPx_; }
  // [px] round the middle of a step that it looks at.
  double reachPx() const { return std::hypot(0.5 * step_, beside_ + kBesidePx[2] * pixelsPerPx_) + 1.0; }

  // [grey] By which the way from a place along a direction is darker than both its sides, where that is the least.
  double depth(const Vec2& from, const Vec2& along) const { return depth(from, along, static_cast<int>(step_)); }
  double depth(const Vec2& from, const Vec2& along, int count) const {
    const Vec2 across = leftNormal(along);
    double ink = 0.0, left = 0.0, right = 0.0;
    for (int k = 0; k < count; ++k) {
      const Vec2 at = from + (k + 0.5) * along;
      for (const double off : {-core_, 0.0, core_}) ink += level(at + off * across);
      for (const double off : kBesidePx) {
        left += level(at + (beside_ + off * pixelsPerPx_) * across);
        right += level(at - (beside_ + off * pixelsPerPx_) * across);
      }
    }
    return (std::min(left, right) - ink) / (3.0 * count);
  }

  // [px] To the left of the way from a place along a direction: the middle of what is dark there. The lanes of ink are
  // as far apart as strokes are wide, so that a narrower line would let the way sway within them.
  double middle(const Vec2& from, const Vec2& along) const {
    const Vec2 across = leftNormal(along);
    const int count = static_cast<int>(step_), reach = static_cast<int>(beside_ + kBesidePx[0] * pixelsPerPx_);
    std::vector<double> sums;
    for (int off = -reach; off <= reach; ++off) {
      double sum = 0.0;
      for (int k = 0; k < count; ++k) sum += level(from + (k + 0.5) * along + off * across);
      sums.push_back(sum);
    }
    const double paper = std::min(sums.front(), sums.back());
    const double half = 0.5 * (paper + *std::min_element(sums.begin(), sums.end()));
    double weight = 0.0, moment = 0.0;
    for (int i = 0; i < std::ssize(sums); ++i) {
      const double dark = std::max(0.0, half - sums[i]);
      weight += dark;
      moment += dark * (i - reach);
    }
    const double most = std::max(asidePx(), kMostRecentring * beside_);
    return weight > 0.0 ? std::clamp(moment / weight, -most, most) : 0.0;
  }

 private:
  double level(const Vec2& at) const { return static_cast<double>(sampleGrey(grey_, at.x(), at.y())); }

  const GreyImage& grey_;
  double pixelsPerPx_, beside_, core_, step_;
};

// The depth of steps laid on paper, in four directions by turns.
PaperDepth measurePaper(const StepMeter& meter, const BitImage& ink, const RunContext& context) {
  const double reach = meter.reachPx();
  std::vector<float> mean(kRegions, 0.0f), sigma(kRegions, 0.0f), weight(kRegions, 0.0f);
  parallelFor(context, kRegions, 1, [&](int begin, int end) {
    for (int region = begin; region < end && !context.isCancelled(); ++region) {
      std::vector<double> depths;
      for (int i = 0; i < kSamplesPerSide * kSamplesPerSide; ++i) {
        const int column = region % kRegionsPerSide, row = region / kRegionsPerSide;
        const int across = i % kSamplesPerSide, down = i / kSamplesPerSide;
        const double u = (column + (across + 0.5) / kSamplesPerSide) / kRegionsPerSide;
        const double v = (row + (down + 0.5) / kSamplesPerSide) / kRegionsPerSide;
        const Vec2 at(u * ink.width, v * ink.height);
        const bool isInside =
            at.x() > reach && at.y() > reach && at.x() + reach < ink.width && at.y() + reach < ink.height;
        if (!isInside || anyInDisc(ink, at, reach)) continue;
        const double angle = 0.25 * std::numbers::pi * ((i + i / kSamplesPerSide) % 4);
        const Vec2 along(std::cos(angle), std::sin(angle));
        depths.push_back(meter.depth(at - 0.5 * meter.stepPx() * along, along));
      }
      if (std::ssize(depths) < kFewestPaperSamples) continue;
      const double middle = upperMedian(depths);
      for (double& d : depths) d -= middle;
      mean[region] = static_cast<float>(middle);
      sigma[region] = static_cast<float>(robustSigma(depths));
      weight[region] = 1.0f;
    }
  });
  if (std::none_of(weight.begin(), weight.end(), [](float w) { return w > 0.0f; })) return {};
  return {pushPull(mean, weight, kRegionsPerSide, kRegionsPerSide),
          pushPull(sigma, weight, kRegionsPerSide, kRegionsPerSide)};
}

struct FaintEnd {
  Vec2 at = Vec2::Zero(), out = Vec2::Zero();
  double depth = 0.0;   // [grey] of its stroke
  double mostPx = 0.0;  // to be followed
};

class EndFollower {
 public:
  EndFollower(const StepMeter& meter, const PaperDepth& paper, const BitImage& ink)
      : meter_(meter), paper_(paper), ink_(ink) {}

  // The end of a path beyond its ink; nothing where it has none.
  std::optional<FaintEnd> endOf(const StrokePath& path, int side, double widthPx) const {
    const int n = static_cast<int>(path.points.size());
    const auto at = [&](int k) -> const Vec2& { return path.points[side == 0 ? k : n - 1 - k].at; };
    const int back = std::min(n - 1, static_cast<int>(meter_.stepPx() + widthPx));
    const int hook = std::min(back / kMostHook, static_cast<int>(0.5 * widthPx + 1.0));
    const Vec2 d = at(hook) - at(back);
    if (!(d.norm() > 0.0)) return std::nullopt;
    FaintEnd end{at(0), d.normalized(), 0.0, kMostTrailLengths * path.length()};
    end.depth = depthOf(path);
    for (double ahead = 0.0; ink_.at(static_cast<int>(end.at.x()), static_cast<int>(end.at.y()));
         ahead += kAheadStepPx) {
      if (ahead > kMostAheadWidths * widthPx + 1.0) return std::nullopt;
      end.at += kAheadStepPx * end.out;
    }
    end.at += meter_.softEndPx() * end.out;
    return end;
  }

  std::vector<Vec2> follow(const FaintEnd& end) const {
    std::vector<Vec2> trail;
    std::ptrdiff_t kept = 0;
    Vec2 at = end.at, along = end.out;
    double score = 0.0, best = 0.0;
    while (static_cast<double>(std::ssize(trail)) < end.mostPx && isInside(at)) {
      const Step step = darkestFrom(at, along);
      const int toInk = pxToInk(step.from, step.along);
      if (toInk < wholeStep()) {
        const bool isClear = best >= kClearTrail && kept == std::ssize(trail);
        if (!(isClear && isSoftSide(toInk)) && !continues(step, toInk, score, end)) break;
        append(trail, at, step, toInk);
        return trail;
      }
      score += evidence(step, wholeStep(), end);
      append(trail, at, step, wholeStep());
      along = step.along;
      if (score > best) {
        best = score;
        kept = std::ssize(trail);
      }
      if (score < best - kClearTrail) break;
    }
    if (best < kClearTrail) return {};
    trail.resize(kept);
    return trail;
  }

 private:
  struct Step {
    Vec2 from = Vec2::Zero(), along = Vec2::Zero();
    double depth = 0.0;
  };

  int wholeStep() const { return static_cast<int>(meter_.stepPx()); }

  // What the first px of a step speak for a line, less what speaks for any.
  double evidence(const Step& step, int count, const FaintEnd& end) const {
    const Vec2& at = step.from;
    const int region = regionOf(static_cast<int>(at.x()), static_cast<int>(at.y()), ink_.width, ink_.height);
    const double depth = count == wholeStep() ? step.depth : meter_.depth(at, step.along, count);
    const double surplus = depth - static_cast<double>(paper_.mean[region]);
    const bool isInk =
        depth > std::max(kLeastTrailShare * end.depth, kLeastTrailDepth) && depth < kMostTrailShare * end.depth;
    const double sigma =
        std::max(static_cast<double>(paper_.sigma[region]), kLeastSigma) * std::sqrt(meter_.stepPx() / count);
    return (isInk ? std::min(surplus / sigma, kMostEvidence) : 0.0) - kNoEvidence;
  }

  // Ink as near as this is reached: between it and the step is only its own soft side.
  bool isSoftSide(int toInk) const { return static_cast<double>(toInk) <= meter_.softEndPx(); }

  // Whether the ink that a step reaches runs on in its direction, the other side of a gap in one line. Then half as
  // much evidence is enough; the part of the step before that ink counts, too.
  bool continues(const Step& step, int toInk, double score, const FaintEnd& end) const {
    const int clearOfInk = toInk - static_cast<int>(meter_.softEndPx());
    if (clearOfInk > 0) score += evidence(step, clearOfInk, end);
    if (score < 0.5 * kClearTrail) return false;
    const int count = wholeStep();
    const Vec2 across = leftNormal(step.along);
    int inked = 0;
    for (int k = 0; k < count; ++k) {
      const Vec2 at = step.from + (toInk + k) * step.along;
      const bool isInk = std::ranges::any_of(std::array{-1.0, 0.0, 1.0}, [&](double aside) {
        const Vec2 beside = at + aside * meter_.asidePx() * across;
        return ink_.at(static_cast<int>(beside.x()), static_cast<int>(beside.y()));
      });
      if (isInk) ++inked;
    }
    return inked >= kLeastAheadShare * count;
  }

  int pxToInk(const Vec2& from, const Vec2& along) const {
    const int most = wholeStep();
    for (int k = 1; k <= most; ++k) {
      const Vec2 at = from + k * along;
      if (ink_.at(static_cast<int>(at.x()), static_cast<int>(at.y()))) return k;
    }
    return most + 1;
  }

  // From the end of the last step to the place that this one starts from, and on.
  static void append(std::vector<Vec2>& trail, Vec2& at, const Step& step, int count) {
    const Vec2 aside = step.from - at;
    for (double part = 1.0; part < aside.norm(); part += 1.0) trail.push_back(at + part * aside.normalized());
    at = step.from;
    for (int k = 0; k < count; ++k) trail.push_back(at += step.along);
  }

  bool isInside(const Vec2& at) const {
    const double reach = meter_.reachPx();
    return at.x() > reach && at.y() > reach && at.x() + reach < ink_.width && at.y() + reach < ink_.height;
  }

  Step darkestFrom(const Vec2& at, const Vec2& along) const {
    const Vec2 aside = meter_.asidePx() * leftNormal(along);
    Step best{at, along, -std::numeric_limits<double>::infinity()};
    for (const double side : {0.0, -1.0, 1.0}) {
      const Vec2 from = at + side * aside;
      for (const double turn : {0.0, -kTurnDeg * kRadPerDeg, kTurnDeg * kRadPerDeg}) {
        const Vec2 rotated(std::cos(turn) * along.x() - std::sin(turn) * along.y(),
                           std::sin(turn) * along.x() + std::cos(turn) * along.y());
        const double depth = meter_.depth(from, rotated);
        if (depth > best.depth) best = {from, rotated, depth};
      }
    }
    best.from += meter_.middle(best.from, best.along) * leftNormal(best.along);
    return best;
  }

  // [grey] Of a stroke, the median over steps laid along it.
  double depthOf(const StrokePath& path) const {
    const int n = static_cast<int>(path.points.size()), step = std::min(n - 1, static_cast<int>(meter_.stepPx()));
    std::vector<double> depths;
    for (int i = 0; i + step < n; i += step) {
      const Vec2 d = path.points[i + step].at - path.points[i].at;
      if (d.norm() > 0.0) depths.push_back(meter_.depth(path.points[i].at, d.normalized()));
    }
    return depths.empty() ? 0.0 : upperMedian(depths);
  }

  const StepMeter& meter_;
  const PaperDepth& paper_;
  const BitImage& ink_;
};

}  // namespace

BitImage followFaintEnds(const std::vector<StrokePath>& paths, const std::function<bool(int)>& isChosen,
                         const BitImage& ink, const GreyImage& grey, const RunContext& context, double pixelsPerPx) {
  BitImage trails(ink.width, ink.height);
  const double width = medianWidth(paths, isChosen);
  const StepMeter meter(grey, width, pixelsPerPx);
  const PaperDepth paper = measurePaper(meter, ink, context);
  if (paper.mean.empty() || context.isCancelled()) return trails;
  const EndFollower follower(meter, paper, ink);
  for (int i = 0; i < std::ssize(paths); ++i) {
    const StrokePath& path = paths[i];
    if (context.isCancelled()) return trails;
    if (path.closed || !isChosen(i) || path.length() < kLeastEndWidths * path.widthPx()) continue;
    for (const int side : {0, 1}) {
      if (!path.tip[side]) continue;
      const auto end = follower.endOf(path, side, width);
      if (!end) continue;
      const std::vector<Vec2> trail = follower.follow(*end);
      if (trail.empty()) continue;
      const double radius = std::max(1.0, 0.5 * std::min(width, path.widthPx()));
      const Vec2 tip = side == 0 ? path.points.front().at : path.points.back().at;
      for (double s = 0.0; s < (end->at - tip).norm(); s += 1.0) setDisc(trails, tip + s * end->out, radius);
      for (const Vec2& at : trail) setDisc(trails, at, radius);
    }
  }
  return trails;
}

}  // namespace batten
