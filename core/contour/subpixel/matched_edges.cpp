// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/matched_edges.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "core/contour/subpixel/pixel_edge.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kLevelSigma = 6.0;  // points: ink and paper change slowly along an edge
constexpr double kSpanSigma = 2.0;   // points
constexpr int kProfileNewtonSteps = 4;
constexpr int kBlurRounds = 4;
constexpr int kTwinRounds = 4;
constexpr int kBlurSamples = 1500;  // points that vote for the blur

// Model of the profile of an edge at 0 and of its twins: 0 = paper, 1 = ink.
struct EdgeModel {
  double value, slope;  // slope = -d value / d position * blur
};
EdgeModel edgeModel(const NormalTable& table, double x, double inkTwin, double paperTwin) {
  double cdf, pdf;
  table.eval(x, cdf, pdf);
  EdgeModel m{cdf, pdf};
  if (inkTwin > 0.0) {
    table.eval(x - inkTwin, cdf, pdf);
    m.value -= cdf;
  }
  if (paperTwin > 0.0) {
    table.eval(-x - paperTwin, cdf, pdf);
    m.value += cdf;
  }
  return m;
}

// Sums of one side of a profile: its grey and what the model says there.
struct SideSums {
  double grey = 0.0, model = 0.0;
  int count = 0;
};

void sideSums(const float* profile, const EdgeSpan& span, double position, double blur, SideSums& ink,
              SideSums& paper) {
  const NormalTable& table = NormalTable::instance();
  const double inkFrom = position + std::min(kSideFromPx, 0.6 * (span.hi - position));
  const double paperTo = position - std::min(kSideFromPx, 0.6 * (position - span.lo));
  for (int k = 0; k < kProfileSamples; ++k) {
    const double u = profileU(k);
    SideSums* side = nullptr;
    if (u >= inkFrom && u <= span.hi + 0.25)
      side = &ink;
    else if (u <= paperTo && u >= span.lo - 0.25)
      side = &paper;
    if (side == nullptr) continue;
    side->grey += profile[k];
    side->model += edgeModel(table, (u - position) / blur, span.inkTwin / blur, span.paperTwin / blur).value;
    ++side->count;
  }
}

// Smoothing in which points that know little count little.
std::vector<float> weightedSmooth(const std::vector<float>& values, const std::vector<float>& weight,
                                  const std::vector<float>& smoothWeight, bool closed) {
  std::vector<float> product(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) product[i] = values[i] * weight[i];
  product = smoothValues(product, closed, kLevelSigma);
  for (std::size_t i = 0; i < values.size(); ++i) {
    product[i] = smoothWeight[i] > 0.0f ? product[i] / smoothWeight[i] : values[i];
  }
  return product;
}

// Ink and paper of every point: the two side means freed of what the blur carries over from the other side, everything
// smoothed along the line first because a single profile is noisy. Weight: contrast squared, so that places without an
// edge (the page border, tips) say nothing about the levels of their neighbours.
void measureLevels(const ProfileBand& band, bool closed, MatchedEdges& m, const RunContext& context) {
  const auto n = m.span.size();
  std::vector<float> inkGrey(n), inkModel(n, 1.0f), paperGrey(n), paperModel(n), weight(n);
  forEdgePoints(context, n, [&](std::size_t i) {
    SideSums ink, paper;
    sideSums(band.row(static_cast<int>(i)), m.span[i], m.position[i], m.blur, ink, paper);
    if (m.span[i].contrast <= 0.0 || ink.count == 0 || paper.count == 0) return;
    weight[i] = static_cast<float>(m.span[i].contrast * m.span[i].contrast);
    inkGrey[i] = static_cast<float>(ink.grey / ink.count);
    inkModel[i] = static_cast<float>(ink.model / ink.count);
    paperGrey[i] = static_cast<float>(paper.grey / paper.count);
    paperModel[i] = static_cast<float>(paper.model / paper.count);
  });
  const std::vector<float> smoothWeight = smoothValues(weight, closed, kLevelSigma);
  inkGrey = weightedSmooth(inkGrey, weight, smoothWeight, closed);
  inkModel = weightedSmooth(inkModel, weight, smoothWeight, closed);
  paperGrey = weightedSmooth(paperGrey, weight, smoothWeight, closed);
  paperModel = weightedSmooth(paperModel, weight, smoothWeight, closed);
  m.ink.resize(n);
  m.paper.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const float spread = std::max(0.2f, inkModel[i] - paperModel[i]);
    const float contrast = (paperGrey[i] - inkGrey[i]) / spread;
    m.paper[i] = paperGrey[i] + contrast * paperModel[i];
    m.ink[i] = m.paper[i] - contrast;
  }
}

// Newton steps for the position of one edge (maximum likelihood under white noise).
double fitPosition(const float* profile, const EdgeSpan& span, double start, double paper, double contrast,
                   double blur) {
  const NormalTable& table = NormalTable::instance();
  const double reach = 3.0 * blur;  // beyond, the slope is below 1 % of its peak
  double position = start;
  for (int step = 0; step < kProfileNewtonSteps; ++step) {
    double top = 0.0, bottom = 0.0;
    for (int k = 0; k < kProfileSamples; ++k) {
      const double u = profileU(k);
      if (u < span.lo - 0.25 || u > span.hi + 0.25 || std::abs(u - position) > reach) continue;
      const EdgeModel m = edgeModel(table, (u - position) / blur, span.inkTwin / blur, span.paperTwin / blur);
      const double gradient = contrast * m.slope / blur;  // of the grey with respect to the position
      top += gradient * (profile[k] - (paper - contrast * m.value));
      bottom += gradient * gradient;
    }
    if (!(bottom > 0.0)) return start;
    const double move = std::clamp(top / bottom, -0.5, 0.5);
    position = std::clamp(position + move, start - kEdgeGatePx, start + kEdgeGatePx);
    if (std::abs(move) < 1e-3) break;
  }
  return position;
}

// One step for the blur common to the contour from a spread sample of its points; also measures the noise.
void updateBlur(const ProfileBand& band, MatchedEdges& m) {
  const NormalTable& table = NormalTable::instance();
  const std::size_t stride = std::max<std::size_t>(1, m.span.size() / kBlurSamples);
  double top = 0.0, bottom = 0.0;
  std::vector<float> residuals;
  for (std::size_t i = 0; i < m.span.size(); i += stride) {
    const EdgeSpan& span = m.span[i];
    const double contrast = m.paper[i] - m.ink[i];
    if (contrast < kLeastEdgeContrast || span.contrast <= 0.0) continue;
    const float* profile = band.row(static_cast<int>(i));
    for (int k = 0; k < kProfileSamples; ++k) {
      const double u = profileU(k);
      if (u < span.lo - 0.25 || u > span.hi + 0.25) continue;
      const auto modelAt = [&](double blur) {
        return edgeModel(table, (u - m.position[i]) / blur, span.inkTwin / blur, span.paperTwin / blur).value;
      };
      constexpr double kStep = 0.02;  // relative, for the derivative with respect to the blur
      const double residual = profile[k] - (m.paper[i] - contrast * modelAt(m.blur));
      const double gradient =
          -contrast * (modelAt(m.blur * (1 + kStep)) - modelAt(m.blur * (1 - kStep))) / (2 * kStep * m.blur);
      top += gradient * residual;
      bottom += gradient * gradient;
      residuals.push_back(static_cast<float>(std::abs(residual)));
    }
  }
  if (residuals.empty()) return;
  if (bottom > 0.0) m.blur = std::clamp(m.blur + std::clamp(top / bottom, -0.4, 0.4), 0.45, 2.5);
  m.noise = robustSigma(residuals);
}

void fitAll(const ProfileBand& band, const std::vector<double>& start, MatchedEdges& m, std::size_t stride,
            bool twinsOnly, const RunContext& context) {
  forEdgePoints(context, (m.span.size() + stride - 1) / stride, [&](std::size_t k) {
    const std::size_t i = k * stride;
    if (twinsOnly && m.span[i].inkTwin <= 0.0 && m.span[i].paperTwin <= 0.0) return;
    const double contrast = m.paper[i] - m.ink[i];
    if (m.span[i].contrast <= 0.0 || contrast < kLeastEdgeContrast) return;
    m.position[i] = fitPosition(band.row(static_cast<int>(i)), m.span[i], start[i], m.paper[i], contrast, m.blur);
  });
}

// A border seen twice lies as far beyond the turn of the grey as this edge lies before it. The turn is found to a
// fraction of a sample; the edge moves while it is fitted, so the widths follow it (smoothed along the line).
bool updateTwins(bool closed, MatchedEdges& m) {
  bool any = false;
  std::vector<float> position(m.position.begin(), m.position.end());
  position = smoothValues(position, closed, kSpanSigma);
  for (std::size_t i = 0; i < m.span.size(); ++i) {
    EdgeSpan& span = m.span[i];
    if (span.inkTwin > 0.0) span.inkTwin = std::max(0.5, 2.0 * (span.hi - position[i]));
    if (span.paperTwin > 0.0) span.paperTwin = std::max(0.5, 2.0 * (position[i] - span.lo));
    any = any || span.inkTwin > 0.0 || span.paperTwin > 0.0;
  }
  return any;
}

}  // namespace

MatchedEdges matchEdges(const ProfileBand& band, bool closed, const RunContext& context) {
  MatchedEdges m;
  const auto n = static_cast<std::size_t>(band.count());
  m.span.resize(n);
  m.position.resize(n);
  {
    const ProfileBand average = averageAlong(band, closed, kSpanSigma, context);
    forEdgePoints(context, n, [&](std::size_t i) {
      m.span[i] = findEdgeSpan(average.row(static_cast<int>(i)));
      m.position[i] = halfLevelCrossing(average.row(static_cast<int>(i)), m.span[i]);
    });
  }
  const std::vector<double> start = m.position;
  updateTwins(closed, m);
  const std::size_t stride = std::max<std::size_t>(1, n / kBlurSamples);
  for (int round = 0; round < kBlurRounds && !context.isCancelled(); ++round) {
    measureLevels(band, closed, m, context);
    fitAll(band, start, m, stride, false, context);
    if (stride == 1) updateTwins(closed, m);
    const double before = m.blur;
    updateBlur(band, m);
    if (std::abs(m.blur - before) < 0.005) break;
  }
  for (int round = 0; round < kTwinRounds && !context.isCancelled(); ++round) {
    measureLevels(band, closed, m, context);
    fitAll(band, start, m, 1, round > 0, context);
    if (!updateTwins(closed, m)) break;
  }
  return m;
}

}  // namespace batten
