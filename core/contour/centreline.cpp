// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <opencv2/imgproc.hpp>

#include "core/contour/centreline_skeleton.h"
#include "core/contour/edge_profile.h"
#include "core/contour/polyline_tools.h"

namespace batten {
namespace {

cv::Mat toMat(const BitImage& image) {
  cv::Mat mat(image.height, image.width, CV_8U, cv::Scalar(0));
  for (int y = 0; y < image.height; ++y) {
    std::uint8_t* row = mat.ptr<std::uint8_t>(y);
    for (int x = 0; x < image.width; ++x) row[x] = static_cast<std::uint8_t>((image.row(y)[x >> 6] >> (x & 63)) & 1u);
  }
  return mat;
}

// Distance of ink pixel centres from the nearest paper pixel centre; outside the page is paper.
cv::Mat inkDistance(const cv::Mat& ink) {
  cv::Mat padded, distance;
  cv::copyMakeBorder(ink, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::distanceTransform(padded, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance(cv::Rect(1, 1, ink.cols, ink.rows)).clone();
}

StrokeSplit split(const BitImage& ink, double limitPx) {
  StrokeSplit result{BitImage(ink.width, ink.height), BitImage(ink.width, ink.height)};
  const cv::Mat mat = toMat(ink);
  // Opening by a disc of diameter `limitPx`: what survives is not thinner than the disc.
  const cv::Mat core = inkDistance(mat) > 0.5 * limitPx;
  cv::Mat labels, toCore;
  const int count = cv::connectedComponents(mat, labels, 8, CV_32S);
  const bool anyCore = cv::countNonZero(core) > 0;
  if (anyCore) cv::distanceTransform(core == 0, toCore, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  std::vector<std::int64_t> area(static_cast<std::size_t>(count), 0), fat(static_cast<std::size_t>(count), 0);
  for (int y = 0; y < mat.rows; ++y) {
    for (int x = 0; x < mat.cols; ++x) {
      const auto label = static_cast<std::size_t>(labels.at<int>(y, x));
      if (label == 0) continue;
      ++area[label];
      if (anyCore && toCore.at<float>(y, x) <= 0.5 * limitPx) ++fat[label];
    }
  }
  for (int y = 0; y < mat.rows; ++y) {
    for (int x = 0; x < mat.cols; ++x) {
      const auto label = static_cast<std::size_t>(labels.at<int>(y, x));
      if (label == 0) continue;
      (2 * fat[label] > area[label] ? result.shapes : result.strokes).set(x, y, true);
    }
  }
  return result;
}

// Side branches no longer than the stroke is wide come from bumps of its border; the shortest go first, since their
// going may turn a junction into a plain point of a longer line.
bool pruneSpurs(BitImage& skeleton, const cv::Mat& distance, double factor, const RunContext& context) {
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    if (context.isCancelled()) return false;
    bool changed = false;
    std::vector<SkeletonChain> chains = skeletonChains(skeleton);
    std::stable_sort(chains.begin(), chains.end(),
                     [](const SkeletonChain& a, const SkeletonChain& b) { return a.length() < b.length(); });
    BitImage touched(skeleton.width, skeleton.height);
    for (SkeletonChain& chain : chains) {
      if (chain.closed || chain.freeStart == chain.freeEnd) continue;
      if (chain.freeStart) std::reverse(chain.pixels.begin(), chain.pixels.end());
      const SkeletonPixel junction = chain.pixels.front();
      const double radius = distance.at<float>(junction.y, junction.x);
      if (chain.length() > factor * 2.0 * radius + 1.0 || touched.at(junction.x, junction.y)) continue;
      touched.set(junction.x, junction.y, true);
      for (std::size_t i = 1; i < chain.pixels.size(); ++i) skeleton.set(chain.pixels[i].x, chain.pixels[i].y, false);
      changed = true;
    }
    if (!changed) return true;
    if (!thinToSkeleton(skeleton, context)) return false;
  }
  return true;
}

struct StrokeCentre {
  double centre = 0.0, width = 0.0;
  bool ok = false;
};

// Midpoint of the half levels of a dark ridge. `p` holds 2 * half + 1 samples, `step` px apart.
StrokeCentre centreOfProfile(const std::vector<double>& p, double step) {
  StrokeCentre result;
  const int n = static_cast<int>(p.size()), half = n / 2;
  const auto at = [&](int k) { return p[static_cast<std::size_t>(k)]; };
  double paper = 0.5 * (at(0) + at(n - 1)), ink = at(half);
  const int outer = std::max(1, static_cast<int>(1.2 / step));
  for (int k = 1; k < outer; ++k) paper += 0.5 * (at(k) + at(n - 1 - k));
  paper /= outer;
  for (int k = half - half / 5; k <= half + half / 5; ++k) ink = std::min(ink, at(k));
  if (!(paper - ink > 2.0)) return result;
  const double level = 0.5 * (paper + ink);
  double edge[2] = {0.0, 0.0};
  for (int side = 0; side < 2; ++side) {
    const int d = side == 0 ? -1 : 1;
    int k = half;
    while (k + d >= 0 && k + d < n && at(k + d) < level) k += d;
    if (k + d < 0 || k + d >= n || at(k) >= level) return result;
    edge[side] = (k - half + d * (level - at(k)) / (at(k + d) - at(k))) * step;
  }
  result = {0.5 * (edge[0] + edge[1]), edge[1] - edge[0], true};
  return result;
}

void refineCentre(Contour& contour, const GreyImage& grey, double radius) {
  constexpr double kStep = 0.25;
  const double halfLength = kStep * std::ceil((1.6 * radius + 3.0) / kStep);
  const int half = static_cast<int>(std::lround(halfLength / kStep));
  const std::vector<Vec2> base = smoothPolyline(contour.chain, contour.closed, std::max(2.0, 0.5 * radius));
  const std::vector<Vec2> tangent = directions(base, contour.closed, 2);
  std::vector<double> profile(static_cast<std::size_t>(2 * half + 1));
  for (std::size_t i = 0; i < base.size(); ++i) {
    const Vec2 normal = leftNormal(tangent[i]);
    for (int k = -half; k <= half; ++k) {
      profile[static_cast<std::size_t>(k + half)] = sampleLinear(grey, base[i] + k * kStep * normal);
    }
    const StrokeCentre centre = centreOfProfile(profile, kStep);
    const bool good =
        centre.ok && std::abs(centre.centre) <= 1.5 && std::abs(centre.width - 2.0 * radius) <= 0.8 * radius + 1.0;
    contour.points[i] = base[i] + (good ? centre.centre : 0.0) * normal;
    contour.refined[i] = good ? 1 : 0;
    if (good) contour.widthPx[i] = static_cast<float>(centre.width);
  }
}

Contour toContour(const SkeletonChain& chain, const cv::Mat& distance, const GreyImage& grey, bool subpixel) {
  Contour contour;
  contour.kind = ContourKind::Centreline;
  contour.closed = chain.closed;
  std::vector<float> radii;
  for (const SkeletonPixel& p : chain.pixels) {
    contour.chain.emplace_back(p.x + 0.5, p.y + 0.5);
    const float radius = distance.at<float>(p.y, p.x);
    radii.push_back(radius);
    contour.widthPx.push_back(std::max(1.0f, 2.0f * radius - 1.0f));
  }
  contour.points = contour.chain;
  contour.refined.assign(contour.chain.size(), 0);
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  if (subpixel && contour.chain.size() >= 8) refineCentre(contour, grey, std::max(0.5, *middle - 0.5));
  contour.lengthPx = polylineLength(contour.points, contour.closed);
  contour.areaPx = contour.closed ? polygonArea(contour.points) : 0.0;
  return contour;
}

Result<ContourSet> traceStrokes(const BitImage& strokes, const GreyImage& grey, const EdgeParams& params,
                                const RunContext& context) {
  ContourSet set;
  BitImage skeleton = strokes;
  if (!thinToSkeleton(skeleton, context)) return cancelled();
  const cv::Mat distance = inkDistance(toMat(strokes));
  if (!pruneSpurs(skeleton, distance, params.spurFactor, context)) return cancelled();
  for (const SkeletonChain& chain : skeletonChains(skeleton)) {
    if (context.isCancelled()) return cancelled();
    ++set.report.found;
    if (chain.pixels.size() < 2) {
      ++set.report.droppedShort;
      continue;
    }
    set.contours.push_back(toContour(chain, distance, grey, params.subpixel));
  }
  return set;
}

}  // namespace

Result<StrokeSplit> splitStrokes(const BitImage& ink, const EdgeParams& params, const RunContext& context) {
  if (ink.width <= 0 || ink.height <= 0) return StrokeSplit{ink, ink};
  if (context.isCancelled()) return cancelled();
  try {
    return split(ink, params.strokeWidth * std::sqrt(static_cast<double>(ink.width) * ink.height));
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to tell strokes from shapes.", e.what());
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to tell strokes from shapes.");
  }
}

Result<ContourSet> centrelines(const BitImage& strokes, const GreyImage& grey, const EdgeParams& params,
                               const RunContext& context) {
  if (strokes.width <= 0 || strokes.height <= 0) return ContourSet{};
  try {
    return traceStrokes(strokes, grey, params, context);
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to find the centre lines.", e.what());
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to find the centre lines.");
  }
}

}  // namespace batten
