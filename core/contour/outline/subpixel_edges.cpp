// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/subpixel_edges.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/contour/subpixel/curvature_shift.h"
#include "core/contour/subpixel/edge_profile.h"
#include "core/contour/subpixel/matched_edges.h"
#include "core/contour/subpixel/pixel_edge.h"
#include "core/contour/subpixel/point_noise.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kSmallestRing = 12;       // points; below that no direction can be trusted
constexpr double kChainSigma = 3.0;     // points: takes the staircase out of the crack chain
constexpr double kBaseSigma = 2.0;      // points: the base of the second pass keeps more of the corners
constexpr double kLargestMovePx = 2.0;  // from the base of the second pass

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
  const std::vector<Vec2> base = smoothPolyline(unrefinedPositionsOf(contour.points), contour.closed, kChainSigma);
  const std::vector<Vec2> normal = normalsOf(base, contour.closed);
  const ProfileBand band =
      averageAlong(sampleProfiles(grey, base, normal, false, context), contour.closed, 1.0, context);
  std::vector<Vec2> points = base;
  forEdgePoints(context, base.size(), [&](std::size_t i) {
    const float* profile = band.row(static_cast<int>(i));
    const EdgeSpan span = findEdgeSpan(profile);
    const Vec2& crack = contour.points[i].unrefined;
    if (span.contrast < kLeastEdgeContrast || onPageBorder(crack, grey)) return;
    const Vec2 found = base[i] + halfLevelCrossing(profile, span) * normal[i];
    if ((found - crack).norm() <= kEdgeGatePx + 0.5) points[i] = found;
  });
  return points;
}

constexpr int kPixelBlurPoints = 300;  // that vote for the blur of the pixel pass

PixelEdge pixelEdge(const MatchedEdges& m, std::size_t i, const PixelResponse& response, const Vec2& normal) {
  return {m.paper[i], static_cast<double>(m.paper[i]) - m.ink[i], m.span[i].inkTwin, m.span[i].paperTwin,
          response.direction(normal)};
}

bool readWindow(const GreyImage& grey, const Vec2& base, const Vec2& normal, const MatchedEdges& m, std::size_t i,
                double reach, PixelWindow& window) {
  const EdgeSpan& span = m.span[i];
  if (span.contrast <= 0.0 || m.paper[i] - m.ink[i] < kLeastEdgeContrast) return false;
  window.read(grey, base, normal, std::max(span.lo - 0.25, m.position[i] - reach),
              std::min(span.hi + 0.25, m.position[i] + reach));
  return !window.pixels.empty();
}

// The blur of the light, without that of the pixels themselves, which explains a sample of the points best.
int pixelBlur(const GreyImage& grey, const std::vector<Vec2>& base, const std::vector<Vec2>& normal,
              const MatchedEdges& m) {
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
double pixelPass(const GreyImage& grey, const std::vector<Vec2>& base, const std::vector<Vec2>& normal, MatchedEdges& m,
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
  const auto index = [&](int i) { return contour.closed ? wrapIndex(i, n) : std::clamp(i, 0, n - 1); };
  const auto point = [&](int i) -> ContourPoint& { return contour.points[index(i)]; };
  for (int round = 0; round < 3; ++round) {
    bool clean = true;
    for (int i = 0; i < n; ++i) {
      const Vec2 tangent = -leftNormal(normal[index(i)]);  // turned back by 90 degrees
      if ((point(i + 1).at - point(i).at).dot(tangent) > 0.0) continue;
      const Vec2 from = point(i - 1).at, to = point(i + 2).at;
      point(i).at = from + (to - from) / 3.0;
      point(i + 1).at = from + (to - from) * (2.0 / 3.0);
      point(i).refined = point(i + 1).refined = false;
      clean = false;
    }
    if (clean) return;
  }
}

}  // namespace

void refineOutline(Contour& contour, const GreyImage& grey, const RunContext& context) {
  const auto n = contour.points.size();
  for (ContourPoint& p : contour.points) {
    p.at = p.unrefined;
    p.refined = false;
  }
  if (n < kSmallestRing || grey.width < 4 || grey.height < 4) return;
  const std::vector<Vec2> base = smoothPolyline(halfLevelPass(contour, grey, context), contour.closed, kBaseSigma);
  const std::vector<Vec2> normal = normalsOf(base, contour.closed);
  if (context.isCancelled()) return;
  const ProfileBand band = sampleProfiles(grey, base, normal, true, context);
  if (context.isCancelled()) return;
  MatchedEdges m = matchEdges(band, contour.closed, context);
  if (context.isCancelled()) return;
  const double blur = pixelPass(grey, base, normal, m, context);
  std::vector<Vec2> found(n);
  for (std::size_t i = 0; i < n; ++i) found[i] = base[i] + m.position[i] * normal[i];
  undoCurvatureShift(found, normal, contour.closed, blur);
  const std::vector<Vec2> fallback = smoothPolyline(unrefinedPositionsOf(contour.points), contour.closed, 1.5);
  for (std::size_t i = 0; i < n; ++i) {
    ContourPoint& p = contour.points[i];
    if (onPageBorder(p.unrefined, grey)) continue;
    const double contrast = m.paper[i] - m.ink[i];
    const bool edge = m.span[i].contrast > 0.0 && contrast >= std::max(kLeastEdgeContrast, m.noise) &&
                      std::abs(m.position[i]) <= kLargestMovePx && (found[i] - p.unrefined).norm() <= kEdgeGatePx;
    p.at = edge ? found[i] : fallback[i];
    p.refined = edge;
  }
  removeReversals(contour, normal);
  contour.blurPx = std::sqrt(std::max(1e-6, blur * blur - kPixelVariance - PixelWindow::kVariance));
  std::vector<std::uint8_t> placed(n);
  for (std::size_t i = 0; i < n; ++i) placed[i] = contour.points[i].refined ? 1 : 0;
  const std::vector<float> sigma = pointSigmas(m.information, placed, contour.closed);
  for (std::size_t i = 0; i < n; ++i) contour.points[i].sigmaPx = sigma[i];
  measureContour(contour);
}

}  // namespace batten
