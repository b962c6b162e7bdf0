// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/subpixel_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/contour/subpixel/blur_search.h"
#include "core/contour/subpixel/curvature_shift.h"
#include "core/contour/subpixel/edge_profile.h"
#include "core/contour/subpixel/matched_edges.h"
#include "core/contour/subpixel/pixel_edge.h"
#include "core/contour/subpixel/point_noise.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kSmallestSide = 4;                 // px of a page: a cubic interpolation takes as many
constexpr int kSmallestRing = 12;                // points; below that no direction can be trusted
constexpr double kChainSigma = 3.0;              // points: takes the staircase out of the crack chain
constexpr double kBaseSigma = 2.0;               // points: the base of the second pass keeps more of the corners
constexpr double kLargestMovePx = 2.0;           // from the base of the second pass
constexpr double kFallbackSigma = 1.5;           // points: of points without an edge, which stay near their crack
constexpr int kNormalReachPoints = 2;            // to either side
constexpr int kPixelBlurPoints = 300;            // that vote for the blur of the pixel pass
constexpr std::array kOutlineBlurStrides = {1};  // of its search, which begins near the end
constexpr double kPixelGatePx = 0.5;             // as far as the pixels may move what the profiles found
constexpr double kMostSquares = 1e9;             // [grey^2] of one point: no vote counts for more
constexpr int kReversalRounds = 3;               // mending one step may reverse the next
constexpr double kLeastVariance = 1e-6;          // [px^2] of the light's blur

bool onPageBorder(const Vec2& crack, const GreyImage& grey) {
  return crack.x() <= 0.0 || crack.y() <= 0.0 || crack.x() >= grey.width || crack.y() >= grey.height;
}

std::vector<Vec2> normalsOf(const std::vector<Vec2>& points, bool closed) {
  std::vector<Vec2> normal = directions(points, closed, kNormalReachPoints);
  // Ink lies on the right of travel on the screen, which with y down is the "left" normal of conventions with y up.
  for (Vec2& d : normal) d = leftNormal(d);
  return normal;
}

// First pass: half level on lightly averaged profiles, good to about 0.1 px.
std::vector<Vec2> halfLevelPass(const Contour& contour, const GreyImage& grey, const RunContext& context) {
  const std::vector<Vec2> base = smoothPolyline(unrefinedPositionsOf(contour.points), contour.closed, kChainSigma);
  const std::vector<Vec2> normal = normalsOf(base, contour.closed);
  const EdgeProfiles profiles =
      averageAlong(sampleProfiles(grey, base, normal, false, context), contour.closed, 1.0, context);
  std::vector<Vec2> points = base;
  forEdgePoints(context, static_cast<int>(base.size()), [&](int i) {
    const float* profile = profiles.row(i);
    const EdgeSpan span = findEdgeSpan(profile);
    const Vec2& crack = contour.points[i].unrefined;
    if (span.contrast < kLeastEdgeContrast || onPageBorder(crack, grey)) return;
    const Vec2 found = base[i] + halfLevelCrossing(profile, span) * normal[i];
    if ((found - crack).norm() <= kEdgeGatePx + 0.5) points[i] = found;
  });
  return points;
}

// Where the profiles of an outline stand: unit normals towards the ink.
struct OutlineFrame {
  std::vector<Vec2> base, normal;
  int count() const { return static_cast<int>(base.size()); }
};

PixelEdge pixelEdge(const MatchedEdge& edge, const PixelResponse& response, const Vec2& normal) {
  return {edge.paper,
          static_cast<double>(edge.paper) - edge.ink,
          {edge.span.inkTwin, edge.span.paperTwin},
          response.direction(normal)};
}

// The pixels about the place of an edge, up to `reach` px before and behind it; false where there is none.
bool readWindow(const GreyImage& grey, const OutlineFrame& frame, int i, const MatchedEdge& edge, double reach,
                PixelWindow& window) {
  const EdgeSpan& span = edge.span;
  if (!span.hasEdge() || edge.contrast() < kLeastEdgeContrast) return false;
  window.read(grey, frame.base[i], frame.normal[i], std::max(span.lo - kHalfStepPx, edge.position - reach),
              std::min(span.hi + kHalfStepPx, edge.position + reach));
  return window.count() > 0;
}

// Index of the blur of the light, without that of the pixels themselves, which explains a sample of the points best.
int pixelBlur(const GreyImage& grey, const OutlineFrame& frame, const MatchedEdges& m) {
  const int stride = std::max(1, frame.count() / kPixelBlurPoints);
  const double widest = PixelResponse::reachOf(PixelResponse::kBlurs * PixelResponse::kStepPx);
  const auto left = [&](int index) {
    const PixelResponse& response = PixelResponse::forBlur(index);
    PixelWindow window;
    double sum = 0.0;
    for (int i = 0; i < frame.count(); i += stride) {
      if (!readWindow(grey, frame, i, m.edges[i], widest, window)) continue;
      const PixelEdge edge = pixelEdge(m.edges[i], response, frame.normal[i]);
      const EdgePosition found = mostLikelyPosition(window, response, edge, m.edges[i].position, kPixelGatePx);
      sum += std::min(squaresLeft(window, response, edge, found.position), kMostSquares);
    }
    return sum;
  };
  const double start = std::sqrt(std::max(0.0, m.blur * m.blur - kPixelVariance));
  return leastBlur(blurIndex(start), kOutlineBlurStrides, left);
}

// Last pass, on the raw pixels, which know nothing of the phase between profile and grid; it also finds how well each
// point is known. Returns the blur used.
double pixelPass(const GreyImage& grey, const OutlineFrame& frame, MatchedEdges& m, const RunContext& context) {
  const PixelResponse& response = PixelResponse::forBlur(pixelBlur(grey, frame, m));
  parallelFor(context, frame.count(), kEdgesPerBlock, [&](int begin, int end) {
    PixelWindow window;
    for (int i = begin; i < end; ++i) {
      MatchedEdge& edge = m.edges[i];
      if (!readWindow(grey, frame, i, edge, response.reach() + kPixelGatePx, window)) continue;
      const PixelEdge model = pixelEdge(edge, response, frame.normal[i]);
      const EdgePosition found = mostLikelyPosition(window, response, model, edge.position, kPixelGatePx);
      edge.position = found.position;
      edge.information = found.information;
    }
  });
  return std::sqrt(response.blur() * response.blur() + kPixelVariance + PixelWindow::kVariance);
}

// Points must advance along the line: a step backwards is replaced by the way between its neighbours.
void removeReversals(Contour& contour, const std::vector<Vec2>& normal) {
  const int n = static_cast<int>(contour.points.size());
  const auto index = [&](int i) { return contour.closed ? wrapIndex(i, n) : std::clamp(i, 0, n - 1); };
  const auto point = [&](int i) -> ContourPoint& { return contour.points[index(i)]; };
  for (int round = 0; round < kReversalRounds; ++round) {
    bool clean = true;
    for (int i = 0; i < n; ++i) {
      const Vec2 tangent = -leftNormal(normal[index(i)]);  // rotated back by 90 degrees
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
  const int n = static_cast<int>(contour.points.size());
  for (ContourPoint& p : contour.points) {
    p.at = p.unrefined;
    p.refined = false;
  }
  if (n < kSmallestRing || grey.width < kSmallestSide || grey.height < kSmallestSide) return;
  OutlineFrame frame;
  frame.base = smoothPolyline(halfLevelPass(contour, grey, context), contour.closed, kBaseSigma);
  frame.normal = normalsOf(frame.base, contour.closed);
  if (context.isCancelled()) return;
  const EdgeProfiles profiles = sampleProfiles(grey, frame.base, frame.normal, true, context);
  if (context.isCancelled()) return;
  MatchedEdges m = matchEdges(profiles, contour.closed, context);
  if (context.isCancelled()) return;
  const double blur = pixelPass(grey, frame, m, context);
  std::vector<Vec2> found(n);
  for (int i = 0; i < n; ++i) found[i] = frame.base[i] + m.edges[i].position * frame.normal[i];
  undoCurvatureShift(found, frame.normal, contour.closed, blur);
  const std::vector<Vec2> fallback =
      smoothPolyline(unrefinedPositionsOf(contour.points), contour.closed, kFallbackSigma);
  for (int i = 0; i < n; ++i) {
    ContourPoint& p = contour.points[i];
    if (onPageBorder(p.unrefined, grey)) continue;
    const MatchedEdge& edge = m.edges[i];
    p.refined = edge.span.hasEdge() && edge.contrast() >= std::max(kLeastEdgeContrast, m.noise) &&
                std::abs(edge.position) <= kLargestMovePx && (found[i] - p.unrefined).norm() <= kEdgeGatePx;
    p.at = p.refined ? found[i] : fallback[i];
  }
  for (const auto& [first, last] : contour.bridges) {
    for (int i = first; i <= last; ++i) {
      contour.points[i].at = contour.points[i].unrefined;
      contour.points[i].refined = false;
    }
  }
  removeReversals(contour, frame.normal);
  contour.blurPx = std::sqrt(std::max(kLeastVariance, blur * blur - kPixelVariance - PixelWindow::kVariance));
  std::vector<std::optional<PointInformation>> information(n);
  for (int i = 0; i < n; ++i)
    if (contour.points[i].refined) information[i] = m.edges[i].information;
  const std::vector<float> sigma = pointSigmas(information, contour.closed);
  for (int i = 0; i < n; ++i) contour.points[i].sigmaPx = sigma[i];
  measureContour(contour);
}

}  // namespace batten
