// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel_edges.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/contour/curvature_shift.h"
#include "core/contour/edge_profile.h"
#include "core/contour/pixel_edge.h"
#include "core/contour/point_noise.h"
#include "core/contour/polyline_tools.h"

namespace batten {
namespace {

constexpr int kSmallestRing = 12;          // points; below that no direction can be trusted
constexpr double kChainSigma = 3.0;        // points: takes the staircase out of the crack chain
constexpr double kBaseSigma = 2.0;         // points: the base of the second pass keeps more of the corners
constexpr double kLevelSigma = 6.0;        // points: ink and paper change slowly along an edge
constexpr double kSpanSigma = 2.0;         // points
constexpr double kGatePx = 1.5;            // farthest that an edge may lie from its crack
constexpr double kLargestMovePx = 2.0;     // from the base of the second pass
constexpr double kSideFromPx = 1.9;        // side levels are taken beyond this distance
constexpr double kSmallestContrast = 2.0;  // [grey]
constexpr int kProfileNewtonSteps = 4;
constexpr int kBlurRounds = 4;
constexpr int kTwinRounds = 4;
constexpr int kBlurSamples = 1500;   // points that vote for the blur
constexpr int kEdgesPerBlock = 512;  // worked on together; the result does not depend on it

// The state of the matched pass, one entry per point.
struct Matched {
  std::vector<EdgeSpan> span;
  std::vector<double> position;   // [px] along the normal from the base
  std::vector<float> ink, paper;  // [grey] side levels, smoothed along the line
  double blur = 1.1;              // [px] standard deviation of the edge's own blur
  double noise = 0.0;             // [grey] robust standard deviation of the residuals
  std::vector<PointInformation> information;
};

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

// Calls body(i) for all points, in parallel; it writes only what belongs to its own point.
template <class Body>
void forPoints(const RunContext& context, std::size_t count, const Body& body) {
  parallelFor(context, static_cast<int>(count), kEdgesPerBlock, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) body(static_cast<std::size_t>(i));
  });
}

bool onPageBorder(const Vec2& crack, const GreyImage& grey) {
  return crack.x() <= 0.0 || crack.y() <= 0.0 || crack.x() >= grey.width || crack.y() >= grey.height;
}

std::vector<Vec2> normalsOf(const std::vector<Vec2>& points, bool closed) {
  std::vector<Vec2> normal = directions(points, closed, 2);
  // Ink lies on the right of travel on the screen, which with y down is the "left" normal of conventions with y up.
  for (Vec2& d : normal) d = leftNormal(d);
  return normal;
}

// First pass: half level on lightly averaged profiles, good to about 0.1 px.
std::vector<Vec2> halfLevelPass(const Contour& contour, const GreyImage& grey, const RunContext& context) {
  const std::vector<Vec2> base = smoothPolyline(contour.chain, contour.closed, kChainSigma);
  const std::vector<Vec2> normal = normalsOf(base, contour.closed);
  const ProfileBand band =
      averageAlong(sampleProfiles(grey, base, normal, false, context), contour.closed, 1.0, context);
  std::vector<Vec2> points = base;
  forPoints(context, base.size(), [&](std::size_t i) {
    const float* profile = band.row(static_cast<int>(i));
    const EdgeSpan span = findEdgeSpan(profile);
    if (span.contrast < kSmallestContrast || onPageBorder(contour.chain[i], grey)) return;
    const Vec2 found = base[i] + halfLevelCrossing(profile, span) * normal[i];
    if ((found - contour.chain[i]).norm() <= kGatePx + 0.5) points[i] = found;
  });
  return points;
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
void measureLevels(const ProfileBand& band, bool closed, Matched& m, const RunContext& context) {
  const auto n = m.span.size();
  std::vector<float> inkGrey(n), inkModel(n, 1.0f), paperGrey(n), paperModel(n), weight(n);
  forPoints(context, n, [&](std::size_t i) {
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
    position = std::clamp(position + move, start - kGatePx, start + kGatePx);
    if (std::abs(move) < 1e-3) break;
  }
  return position;
}

// One step for the blur common to the contour from a spread sample of its points; also measures the noise.
void updateBlur(const ProfileBand& band, Matched& m) {
  const NormalTable& table = NormalTable::instance();
  const std::size_t stride = std::max<std::size_t>(1, m.span.size() / kBlurSamples);
  double top = 0.0, bottom = 0.0;
  std::vector<float> residuals;
  for (std::size_t i = 0; i < m.span.size(); i += stride) {
    const EdgeSpan& span = m.span[i];
    const double contrast = m.paper[i] - m.ink[i];
    if (contrast < kSmallestContrast || span.contrast <= 0.0) continue;
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
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  m.noise = 1.4826 * *middle;
}

void fitAll(const ProfileBand& band, const std::vector<double>& start, Matched& m, std::size_t stride, bool twinsOnly,
            const RunContext& context) {
  forPoints(context, (m.span.size() + stride - 1) / stride, [&](std::size_t k) {
    const std::size_t i = k * stride;
    if (twinsOnly && m.span[i].inkTwin <= 0.0 && m.span[i].paperTwin <= 0.0) return;
    const double contrast = m.paper[i] - m.ink[i];
    if (m.span[i].contrast <= 0.0 || contrast < kSmallestContrast) return;
    m.position[i] = fitPosition(band.row(static_cast<int>(i)), m.span[i], start[i], m.paper[i], contrast, m.blur);
  });
}

// A border seen twice lies as far beyond the turn of the grey as this edge lies before it. The turn is found to a
// fraction of a sample; the edge moves while it is fitted, so the widths follow it (smoothed along the line).
bool updateTwins(bool closed, Matched& m) {
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

// The matched pass (blurred-edge model, common blur): the position that the raw grey values make most likely.
Matched matchedPass(const ProfileBand& band, bool closed, const RunContext& context) {
  Matched m;
  const auto n = static_cast<std::size_t>(band.count());
  m.span.resize(n);
  m.position.resize(n);
  {
    const ProfileBand average = averageAlong(band, closed, kSpanSigma, context);
    forPoints(context, n, [&](std::size_t i) {
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

constexpr int kPixelBlurPoints = 300;  // that vote for the blur of the pixel pass

PixelEdge pixelEdge(const Matched& m, std::size_t i, const PixelResponse& response, const Vec2& normal) {
  return {m.paper[i], static_cast<double>(m.paper[i]) - m.ink[i], m.span[i].inkTwin, m.span[i].paperTwin,
          response.direction(normal)};
}

bool readWindow(const GreyImage& grey, const Vec2& base, const Vec2& normal, const Matched& m, std::size_t i,
                double reach, PixelWindow& window) {
  const EdgeSpan& span = m.span[i];
  if (span.contrast <= 0.0 || m.paper[i] - m.ink[i] < kSmallestContrast) return false;
  window.read(grey, base, normal, std::max(span.lo - 0.25, m.position[i] - reach),
              std::min(span.hi + 0.25, m.position[i] + reach));
  return !window.pixels.empty();
}

// The blur of the light, without that of the pixels themselves, which explains a sample of the points best.
int pixelBlur(const GreyImage& grey, const std::vector<Vec2>& base, const std::vector<Vec2>& normal, const Matched& m) {
  const std::size_t stride = std::max<std::size_t>(1, base.size() / kPixelBlurPoints);
  const auto left = [&](int index) {
    const PixelResponse& response = PixelResponse::forBlur(index);
    PixelWindow window;
    double sum = 0.0;
    for (std::size_t i = 0; i < base.size(); i += stride) {
      if (!readWindow(grey, base[i], normal[i], m, i, PixelResponse::forBlur(PixelResponse::kBlurs - 1).reach(),
                      window))
        continue;
      const PixelEdge edge = pixelEdge(m, i, response, normal[i]);
      sum += std::min(
          squaresLeft(window, response, edge, mostLikelyPosition(window, response, edge, m.position[i], 0.5)), 1e9);
    }
    return sum;
  };
  const double start = std::sqrt(std::max(0.0, m.blur * m.blur - kPixelVariance));
  int best =
      std::clamp(static_cast<int>(std::lround(start / PixelResponse::kStepPx)) - 1, 0, PixelResponse::kBlurs - 1);
  double least = left(best);
  for (const int step : {-1, 1}) {
    for (int next = best + step; next >= 0 && next < PixelResponse::kBlurs; next += step) {
      const double sum = left(next);
      if (!(sum < least)) break;
      least = sum;
      best = next;
    }
  }
  return best;
}

// Last pass, on the raw pixels, which know nothing of the phase between profile and grid; it also finds how well each
// point is known. Returns the blur used.
double pixelPass(const GreyImage& grey, const std::vector<Vec2>& base, const std::vector<Vec2>& normal, Matched& m,
                 const RunContext& context) {
  const PixelResponse& response = PixelResponse::forBlur(pixelBlur(grey, base, normal, m));
  m.information.resize(base.size());
  parallelFor(context, static_cast<int>(base.size()), kEdgesPerBlock, [&](int begin, int end) {
    PixelWindow window;
    for (int k = begin; k < end; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (!readWindow(grey, base[i], normal[i], m, i, response.reach() + 0.5, window)) continue;
      m.position[i] = mostLikelyPosition(window, response, pixelEdge(m, i, response, normal[i]), m.position[i], 0.5,
                                         &m.information[i]);
    }
  });
  return std::sqrt(response.blur() * response.blur() + kPixelVariance + PixelWindow::kVariance);
}

// Points must advance along the line: a step backwards is replaced by the way between its neighbours.
void removeReversals(Contour& contour, const std::vector<Vec2>& normal) {
  const int n = static_cast<int>(contour.points.size());
  const auto at = [&](int i) {
    return static_cast<std::size_t>(contour.closed ? wrapIndex(i, n) : std::clamp(i, 0, n - 1));
  };
  for (int round = 0; round < 3; ++round) {
    bool clean = true;
    for (int i = 0; i < n; ++i) {
      const Vec2 tangent = -leftNormal(normal[at(i)]);  // turned back by 90 degrees
      if ((contour.points[at(i + 1)] - contour.points[at(i)]).dot(tangent) > 0.0) continue;
      const Vec2 from = contour.points[at(i - 1)], to = contour.points[at(i + 2)];
      contour.points[at(i)] = from + (to - from) / 3.0;
      contour.points[at(i + 1)] = from + (to - from) * (2.0 / 3.0);
      contour.refined[at(i)] = contour.refined[at(i + 1)] = 0;
      clean = false;
    }
    if (clean) return;
  }
}

}  // namespace

void refineOutline(Contour& contour, const GreyImage& grey, const RunContext& context) {
  const auto n = contour.chain.size();
  contour.points = contour.chain;
  contour.refined.assign(n, 0);
  if (n < kSmallestRing || grey.width < 4 || grey.height < 4) return;
  const std::vector<Vec2> base = smoothPolyline(halfLevelPass(contour, grey, context), contour.closed, kBaseSigma);
  const std::vector<Vec2> normal = normalsOf(base, contour.closed);
  if (context.isCancelled()) return;
  const ProfileBand band = sampleProfiles(grey, base, normal, true, context);
  if (context.isCancelled()) return;
  Matched m = matchedPass(band, contour.closed, context);
  if (context.isCancelled()) return;
  const double blur = pixelPass(grey, base, normal, m, context);
  std::vector<Vec2> found(n);
  for (std::size_t i = 0; i < n; ++i) found[i] = base[i] + m.position[i] * normal[i];
  undoCurvatureShift(found, normal, contour.closed, blur);
  const std::vector<Vec2> fallback = smoothPolyline(contour.chain, contour.closed, 1.5);
  for (std::size_t i = 0; i < n; ++i) {
    if (onPageBorder(contour.chain[i], grey)) continue;
    const double contrast = m.paper[i] - m.ink[i];
    const bool edge = m.span[i].contrast > 0.0 && contrast >= std::max(kSmallestContrast, m.noise) &&
                      std::abs(m.position[i]) <= kLargestMovePx && (found[i] - contour.chain[i]).norm() <= kGatePx;
    contour.points[i] = edge ? found[i] : fallback[i];
    contour.refined[i] = edge ? 1 : 0;
  }
  removeReversals(contour, normal);
  contour.blurPx = std::sqrt(std::max(1e-6, blur * blur - kPixelVariance - PixelWindow::kVariance));
  contour.sigmaPx = pointSigmas(m.information, contour.refined, contour.closed);
  contour.lengthPx = polylineLength(contour.points, contour.closed);
  contour.areaPx = contour.closed ? polygonArea(contour.points) : 0.0;
}

}  // namespace batten
