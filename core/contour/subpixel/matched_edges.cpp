// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/matched_edges.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "core/contour/subpixel/pixel_edge.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kLevelSigma = 6.0;     // points: ink and paper change slowly along an edge
constexpr double kSpanSigma = 2.0;      // points
constexpr int kProfileNewtonSteps = 4;  // from the half level; fewer once settled
constexpr int kBlurRounds = 4;          // of levels, positions and blur in turn; fewer once the blur is settled
constexpr int kTwinRounds = 4;          // of positions and twins in turn; fewer once no twin moves
constexpr int kBlurSamples = 1500;      // points that vote for the blur

constexpr float kLeastModelSpread = 0.2f;  // of full contrast, between the two sides: less says nothing of the levels
constexpr double kSlopeBlurs = 3.0;        // of blur: beyond, the slope is below 1 % of its peak
constexpr double kLargestProfileStepPx = 0.5, kSettledProfilePx = 1e-3;  // of one step; a smaller one changes nothing
constexpr double kLargestBlurStepPx = 0.4, kSettledBlurPx = 0.005;       // the same of a round
// [px] What profiles of 4 px to each side can tell: .45 is the blur of the pixels and of the sampling alone.
constexpr double kLeastBlurOfEdgePx = 0.45, kMostBlurOfEdgePx = 2.5;
constexpr double kLeastTwinPx = 0.5;  // of ink or paper that is seen at all

// Model of the profile of an edge at 0 and of its twins: 0 = paper, 1 = ink.
struct EdgeModel {
  double value, slope;  // slope = -d value / d position * blur
};
inline EdgeModel edgeModel(const NormalTable& table, double x, const EdgeTwins& twins) {
  const NormalTable::Value own = table.at(x);
  EdgeModel m{own.cdf, own.pdf};
  if (twins.ink) m.value -= table.at(x - *twins.ink).cdf;
  if (twins.paper) m.value += table.at(-x - *twins.paper).cdf;
  return m;
}

// Sums of one side of a profile: its grey and what the model says there.
struct SideSums {
  double grey = 0.0, model = 0.0;
  int count = 0;
};
struct BothSides {
  SideSums ink, paper;
};

BothSides sumSides(const float* profile, const MatchedEdge& edge, double blur) {
  const NormalTable& table = NormalTable::instance();
  const EdgeSpan& span = edge.span;
  const double inkFrom = edge.position + std::min(kSideFromPx, kSideShare * (span.hi - edge.position));
  const double paperTo = edge.position - std::min(kSideFromPx, kSideShare * (edge.position - span.lo));
  BothSides sums;
  const EdgeTwins twins = span.twinsIn(blur);
  for (int k = 0; k < kProfileSamples; ++k) {
    const double u = profileU(k);
    SideSums* side = nullptr;
    if (u >= inkFrom && u <= span.hi + kHalfStepPx)
      side = &sums.ink;
    else if (u <= paperTo && u >= span.lo - kHalfStepPx)
      side = &sums.paper;
    if (side == nullptr) continue;
    side->grey += profile[k];
    side->model += edgeModel(table, (u - edge.position) / blur, twins).value;
    ++side->count;
  }
  return sums;
}

// What the two sides of a profile say of the levels there.
struct SideLevels {
  float weight = 0.0f;
  float inkGrey = 0.0f, inkModel = 1.0f, paperGrey = 0.0f, paperModel = 0.0f;
};

// Smoothing of one of the values, in which points that know little count little.
void smoothLevel(std::vector<SideLevels>& levels, float SideLevels::*value, const std::vector<float>& smoothWeight,
                 bool closed) {
  std::vector<float> product;
  product.reserve(levels.size());
  for (const SideLevels& side : levels) product.push_back(side.*value * side.weight);
  product = smoothValues(product, closed, kLevelSigma);
  for (int i = 0; i < std::ssize(levels); ++i)
    if (smoothWeight[i] > 0.0f) levels[i].*value = product[i] / smoothWeight[i];
}

// Ink and paper of every point: the two side means freed of what the blur carries over from the other side, everything
// smoothed along the line first because a single profile is noisy. Weight: contrast squared, so that places without an
// edge (the page border, tips) say nothing about the levels of their neighbours.
void measureLevels(const EdgeProfiles& profiles, bool closed, MatchedEdges& m, const RunContext& context) {
  std::vector<SideLevels> levels(m.edges.size());
  forEdgePoints(context, m.count(), [&](int i) {
    const EdgeSpan& span = m.edges[i].span;
    const BothSides sums = sumSides(profiles.row(i), m.edges[i], m.blur);
    if (!span.hasEdge() || sums.ink.count == 0 || sums.paper.count == 0) return;
    levels[i] = {static_cast<float>(span.contrast * span.contrast), static_cast<float>(sums.ink.grey / sums.ink.count),
                 static_cast<float>(sums.ink.model / sums.ink.count),
                 static_cast<float>(sums.paper.grey / sums.paper.count),
                 static_cast<float>(sums.paper.model / sums.paper.count)};
  });
  std::vector<float> smoothWeight;
  smoothWeight.reserve(levels.size());
  for (const SideLevels& side : levels) smoothWeight.push_back(side.weight);
  smoothWeight = smoothValues(smoothWeight, closed, kLevelSigma);
  for (float SideLevels::*value :
       {&SideLevels::inkGrey, &SideLevels::inkModel, &SideLevels::paperGrey, &SideLevels::paperModel})
    smoothLevel(levels, value, smoothWeight, closed);
  for (int i = 0; i < m.count(); ++i) {
    const SideLevels& side = levels[i];
    const float spread = std::max(kLeastModelSpread, side.inkModel - side.paperModel);
    const float contrast = (side.paperGrey - side.inkGrey) / spread;
    m.edges[i].paper = side.paperGrey + contrast * side.paperModel;
    m.edges[i].ink = m.edges[i].paper - contrast;
  }
}

// Newton steps for the position of one edge (maximum likelihood under white noise).
double fitPosition(const float* profile, const MatchedEdge& edge, double start, double blur) {
  const NormalTable& table = NormalTable::instance();
  const EdgeSpan& span = edge.span;
  const double paper = edge.paper, contrast = edge.contrast();
  const double reach = kSlopeBlurs * blur;
  const EdgeTwins twins = span.twinsIn(blur);
  double position = start;
  for (int step = 0; step < kProfileNewtonSteps; ++step) {
    double top = 0.0, bottom = 0.0;
    for (int k = 0; k < kProfileSamples; ++k) {
      const double u = profileU(k);
      if (!span.holds(u) || std::abs(u - position) > reach) continue;
      const EdgeModel m = edgeModel(table, (u - position) / blur, twins);
      const double gradient = contrast * m.slope / blur;  // of the grey with respect to the position
      top += gradient * (profile[k] - (paper - contrast * m.value));
      bottom += gradient * gradient;
    }
    if (!(bottom > 0.0)) return start;
    const double move = std::clamp(top / bottom, -kLargestProfileStepPx, kLargestProfileStepPx);
    position = std::clamp(position + move, start - kEdgeGatePx, start + kEdgeGatePx);
    if (std::abs(move) < kSettledProfilePx) break;
  }
  return position;
}

// One step for the blur common to the contour from a spread sample of its points. @return what the model leaves of
// them, without sign; nothing where none of them shows an edge.
std::vector<float> updateBlur(const EdgeProfiles& profiles, MatchedEdges& m) {
  const NormalTable& table = NormalTable::instance();
  const int stride = std::max(1, m.count() / kBlurSamples);
  constexpr double kStep = 0.02;  // relative, for the derivative with respect to the blur
  const double more = m.blur * (1 + kStep), less = m.blur * (1 - kStep);
  double top = 0.0, bottom = 0.0;
  std::vector<float> residuals;
  for (int i = 0; i < m.count(); i += stride) {
    const MatchedEdge& edge = m.edges[i];
    const double contrast = edge.contrast();
    if (contrast < kLeastEdgeContrast || !edge.span.hasEdge()) continue;
    const float* profile = profiles.row(i);
    const EdgeTwins twins = edge.span.twinsIn(m.blur), twinsOfMore = edge.span.twinsIn(more),
                    twinsOfLess = edge.span.twinsIn(less);
    for (int k = 0; k < kProfileSamples; ++k) {
      const double u = profileU(k);
      if (!edge.span.holds(u)) continue;
      const auto modelAt = [&](double blur, const EdgeTwins& inBlurs) {
        return edgeModel(table, (u - edge.position) / blur, inBlurs).value;
      };
      const double residual = profile[k] - (edge.paper - contrast * modelAt(m.blur, twins));
      const double gradient =
          -contrast * (modelAt(more, twinsOfMore) - modelAt(less, twinsOfLess)) / (2 * kStep * m.blur);
      top += gradient * residual;
      bottom += gradient * gradient;
      residuals.push_back(static_cast<float>(std::abs(residual)));
    }
  }
  if (residuals.empty()) return residuals;
  if (bottom > 0.0)
    m.blur = std::clamp(m.blur + std::clamp(top / bottom, -kLargestBlurStepPx, kLargestBlurStepPx), kLeastBlurOfEdgePx,
                        kMostBlurOfEdgePx);
  return residuals;
}

// Which points a round fits.
struct FittedPoints {
  int stride = 1;
  bool twinsOnly = false;  // those that another border is in sight of
};

void fitAll(const EdgeProfiles& profiles, const std::vector<double>& start, MatchedEdges& m, const FittedPoints& which,
            const RunContext& context) {
  forEdgePoints(context, (m.count() + which.stride - 1) / which.stride, [&](int k) {
    const int i = k * which.stride;
    MatchedEdge& edge = m.edges[i];
    if (which.twinsOnly && !edge.span.inkTwin && !edge.span.paperTwin) return;
    if (!edge.span.hasEdge() || edge.contrast() < kLeastEdgeContrast) return;
    edge.position = fitPosition(profiles.row(i), edge, start[i], m.blur);
  });
}

// A border seen twice lies as far beyond the turn of the grey as this edge lies before it. The turn is found to a
// fraction of a sample; the edge moves while it is fitted, so the widths follow it (smoothed along the line). True
// where there are such borders.
bool updateTwins(bool closed, MatchedEdges& m) {
  bool any = false;
  std::vector<float> position;
  for (const MatchedEdge& edge : m.edges) position.push_back(static_cast<float>(edge.position));
  position = smoothValues(position, closed, kSpanSigma);
  for (int i = 0; i < m.count(); ++i) {
    EdgeSpan& span = m.edges[i].span;
    if (span.inkTwin) span.inkTwin = std::max(kLeastTwinPx, 2.0 * (span.hi - position[i]));
    if (span.paperTwin) span.paperTwin = std::max(kLeastTwinPx, 2.0 * (position[i] - span.lo));
    any = any || span.inkTwin || span.paperTwin;
  }
  return any;
}

}  // namespace

MatchedEdges matchEdges(const EdgeProfiles& profiles, bool closed, const RunContext& context) {
  MatchedEdges m;
  const int n = profiles.count();
  m.edges.resize(n);
  {
    const EdgeProfiles average = averageAlong(profiles, closed, kSpanSigma, context);
    forEdgePoints(context, n, [&](int i) {
      m.edges[i].span = findEdgeSpan(average.row(i));
      m.edges[i].position = halfLevelCrossing(average.row(i), m.edges[i].span);
    });
  }
  std::vector<double> start;
  for (const MatchedEdge& edge : m.edges) start.push_back(edge.position);
  updateTwins(closed, m);
  const int stride = std::max(1, n / kBlurSamples);
  std::vector<float> left;
  for (int round = 0; round < kBlurRounds && !context.isCancelled(); ++round) {
    measureLevels(profiles, closed, m, context);
    fitAll(profiles, start, m, {.stride = stride}, context);
    if (stride == 1) updateTwins(closed, m);
    const double before = m.blur;
    if (std::vector<float> residuals = updateBlur(profiles, m); !residuals.empty()) left = std::move(residuals);
    if (std::abs(m.blur - before) < kSettledBlurPx) break;
  }
  m.noise = robustSigma(std::move(left));
  for (int round = 0; round < kTwinRounds && !context.isCancelled(); ++round) {
    measureLevels(profiles, closed, m, context);
    fitAll(profiles, start, m, {.twinsOnly = round > 0}, context);
    if (!updateTwins(closed, m)) break;
  }
  return m;
}

}  // namespace batten
