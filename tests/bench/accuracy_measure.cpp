// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/accuracy_measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace batten::test {
namespace {

constexpr double kCornerZonePx = 10.0;  ///< "Smooth parts" begin this far from a corner.
constexpr double kFoundWithinPx = 2.0;

/// A sample of a traced curve, back in the image frame.
struct Traced {
  Vec2 point;
  double kappa;
};

struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  double kappa = 0.0;
};

/// Truth outline in a bucket grid: nearest facet by exact projection.
class TruthIndex {
 public:
  explicit TruthIndex(const TruthShape& shape) {
    for (const TruthPiece& piece : shape.pieces) {
      const std::size_t count = piece.points.size();
      const bool wraps = shape.corners.empty();
      for (std::size_t i = 0; i + (wraps ? 0 : 1) < count; ++i)
        facets_.push_back({piece.points[i], piece.points[(i + 1) % count], piece.kappa[i]});
    }
    std::sort(facets_.begin(), facets_.end(), [](const Facet& a, const Facet& b) { return a.a.x() < b.a.x(); });
  }

  Nearest nearest(const Vec2& p) const {
    Nearest best;
    const auto middle =
        std::lower_bound(facets_.begin(), facets_.end(), p.x(), [](const Facet& f, double x) { return f.a.x() < x; });
    const auto look = [&](const Facet& f) {
      const Vec2 d = f.b - f.a;
      const double t = std::clamp((p - f.a).dot(d) / std::max(1e-300, d.squaredNorm()), 0.0, 1.0);
      const double distance = (p - f.a - t * d).norm();
      if (distance < best.distance) best = {distance, f.kappa};
    };
    constexpr double kFacetReach = 2.0;  // facets are far shorter
    for (auto it = middle; it != facets_.end() && it->a.x() - p.x() < best.distance + kFacetReach; ++it) look(*it);
    for (auto it = middle; it != facets_.begin() && p.x() - std::prev(it)->a.x() < best.distance + kFacetReach; --it)
      look(*std::prev(it));
    return best;
  }

 private:
  struct Facet {
    Vec2 a, b;
    double kappa;
  };
  std::vector<Facet> facets_;
};

double distanceToCorners(const TruthShape& shape, const Vec2& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vec2& corner : shape.corners) best = std::min(best, (corner - p).norm());
  return best;
}

std::vector<Traced> samplesOf(const TracedCurve& curve, bool faired, const PageFrame& frame) {
  const NurbsCurve& c = faired ? curve.faired : curve.sketched;
  const int count = std::max(20, static_cast<int>(frame.lengthToImage(curve.sketchedFigures.lengthMm)));
  std::vector<Traced> samples;
  for (const CurveSample& s : sampleByArcLength(c, count))
    samples.push_back({frame.pointToImage(s.point), s.kappa * frame.mmPerPx});
  return samples;
}

int extremaOfTruth(const TruthShape& shape) {
  int sum = 0;
  for (const TruthPiece& piece : shape.pieces)
    sum += countExtrema(piece.kappa, 5e-3 / shape.diagonal(), shape.corners.empty());
  return sum;
}

void measureCorners(const TruthShape& shape, const PieceSet& pieces, Accuracy& result) {
  result.cornersTrue = static_cast<int>(shape.corners.size());
  double sum = 0.0;
  for (const Vec2& truth : shape.corners) {
    double best = std::numeric_limits<double>::infinity();
    for (const Corner& corner : pieces.corners) best = std::min(best, (corner.positionPx - truth).norm());
    if (best > 4.0) continue;
    ++result.cornersFound;
    sum += best * best;
    result.cornerMaxPx = std::max(result.cornerMaxPx, best);
  }
  if (result.cornersFound > 0) result.cornerRmsPx = std::sqrt(sum / result.cornersFound);
}

}  // namespace

Accuracy measureAccuracy(const TruthShape& shape, const Scan& scan, Recipe recipe, const AccuracyCase& options) {
  Accuracy result;
  result.trueExtrema = extremaOfTruth(shape);
  for (std::size_t i = 0; i < shape.corners.size(); ++i) {
    const double angle = 2.4 * static_cast<double>(i);  // clicks miss in every direction
    recipe.cornerMarks.push_back(
        {shape.corners[i] + options.cornerClickOffsetPx * Vec2(std::cos(angle), std::sin(angle))});
  }
  StageCache cache;
  const auto begin = std::chrono::steady_clock::now();
  const PipelineOutput output = runPipeline(scan, recipe, cache, {}, {});
  result.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  if (output.error) result.failure = output.error->message;
  if (!output.faired) return result;

  const TruthIndex index(shape);
  std::vector<Vec2> reached;
  double sum = 0.0, curvatureSum = 0.0;
  std::size_t count = 0;
  for (const TracedCurve& curve : output.faired->curves) {
    const std::vector<Traced> samples = samplesOf(curve, options.faired, output.frame);
    std::vector<double> distances;
    for (const Traced& sample : samples) distances.push_back(index.nearest(sample.point).distance);
    std::vector<double> sorted = distances;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    if (sorted[sorted.size() / 2] > 3.0 * kFoundWithinPx) continue;  // another line of the page, not this shape
    result.controlPoints += (options.faired ? curve.faired : curve.sketched).controlPointCount();
    result.extrema += (options.faired ? curve.fairedFigures : curve.sketchedFigures).extrema;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      reached.push_back(samples[i].point);
      if (distanceToCorners(shape, samples[i].point) < kCornerZonePx) continue;
      const Nearest truth = index.nearest(samples[i].point);
      sum += truth.distance * truth.distance;
      result.maxPx = std::max(result.maxPx, truth.distance);
      const double error = std::abs(samples[i].kappa) - std::abs(truth.kappa);  // travel and y direction may differ
      curvatureSum += error * error;
      ++count;
    }
  }
  if (count == 0) return result;
  result.rmsPx = std::sqrt(sum / static_cast<double>(count));
  result.curvatureError = std::sqrt(curvatureSum / static_cast<double>(count)) * shape.diagonal();
  if (output.pieces) measureCorners(shape, *output.pieces, result);

  std::sort(reached.begin(), reached.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
  std::size_t covered = 0, asked = 0;
  const std::vector<Vec2> outline = shape.outline();
  for (std::size_t i = 0; i < outline.size(); i += 50) {
    ++asked;
    const auto from = std::lower_bound(reached.begin(), reached.end(), outline[i].x() - kFoundWithinPx,
                                       [](const Vec2& p, double x) { return p.x() < x; });
    covered +=
        std::any_of(from, reached.end(),
                    [&](const Vec2& p) {
                      return p.x() <= outline[i].x() + kFoundWithinPx && (p - outline[i]).norm() <= kFoundWithinPx;
                    })
            ? 1
            : 0;
  }
  result.found = static_cast<double>(covered) >= 0.95 * static_cast<double>(asked);
  return result;
}

}  // namespace batten::test
