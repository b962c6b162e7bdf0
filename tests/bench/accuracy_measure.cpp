// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/accuracy_measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/statistics.h"
#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"
#include "tests/bench/truth_index.h"

namespace batten::test {
namespace {

constexpr double kCornerZonePx = 10.0;
constexpr double kFoundWithinPx = 2.0, kOutlierPx = 6.0, kCornerWithinPx = 4.0;
constexpr double kSamplePx = 0.5;
constexpr int kPointsOfArc = 3;  // an arc or circle counts as what it takes to draw it

double distanceToCorners(const TruthShape& shape, const Vec2& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vec2& corner : shape.corners) best = std::min(best, (corner - p).norm());
  return best;
}

/// An extremum somewhere along a piece of the truth.
struct Placed {
  double s = 0.0;
  bool isMaximum = false;
};

std::vector<Placed> trueExtremaOf(const TruthShape& shape, std::size_t piece) {
  const TruthPiece& t = shape.pieces[piece];
  std::vector<double> kappa, s;
  double arc = 0.0;
  for (std::size_t i = 0; i < t.points.size(); ++i) {
    if (i > 0) arc += (t.points[i] - t.points[i - 1]).norm();
    if (distanceToCorners(shape, t.points[i]) < kCornerZonePx) continue;
    kappa.push_back(t.kappa[i]);
    s.push_back(arc);
  }
  std::vector<Placed> placed;
  for (const ProfileExtremum& e : extremaOf(kappa, kExtremumProminence / shape.diagonal(), shape.corners.empty()))
    placed.push_back({s[e.index], e.isMaximum});
  std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.s < b.s; });
  return placed;
}

/// Largest number of pairs of the same kind, near each other and in the same order.
int pairsOf(const std::vector<Placed>& a, const std::vector<Placed>& b, double within) {
  std::vector<std::vector<int>> best(a.size() + 1, std::vector<int>(b.size() + 1, 0));
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool match = a[i - 1].isMaximum == b[j - 1].isMaximum && std::abs(a[i - 1].s - b[j - 1].s) <= within;
      best[i][j] = std::max({best[i - 1][j], best[i][j - 1], best[i - 1][j - 1] + (match ? 1 : 0)});
    }
  return best[a.size()][b.size()];
}

/// The same on a ring: extrema near the seam may lie on either side of it.
int pairsOnRing(const std::vector<Placed>& a, std::vector<Placed> b, double within, double length) {
  int most = 0;
  for (std::size_t turn = 0; turn <= b.size(); ++turn) {
    most = std::max(most, pairsOf(a, b, within));
    if (b.empty()) break;
    b.insert(b.begin(), Placed{b.back().s - length, b.back().isMaximum});
    b.pop_back();
  }
  return most;
}

constexpr double kFlatShare = 0.05;  // of the mean slope of a stretch
constexpr double kSlopeReachPx = 1.5;

/// How much of a profile lies between extrema, and how much of that is flat.
struct Flatness {
  double monotonePx = 0.0, flatPx = 0.0;
  /// @param s arc length at the samples of `kappa`. Stretches along which it changes by less than the prominence of an
  /// extremum are constant and count as nothing.
  void add(const std::vector<double>& s, const std::vector<double>& kappa, double prominence, bool periodic) {
    std::vector<std::size_t> ends{0};
    auto extrema = extremaOf(kappa, prominence, periodic);
    std::sort(extrema.begin(), extrema.end(),
              [](const ProfileExtremum& a, const ProfileExtremum& b) { return a.index < b.index; });
    for (const ProfileExtremum& e : extrema) ends.push_back(e.index);
    ends.push_back(kappa.size() - 1);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const std::size_t from = ends[i], to = ends[i + 1];
      if (to <= from + 1) continue;
      const double rise = kappa[to] - kappa[from], length = s[to] - s[from];
      if (std::abs(rise) < prominence) continue;
      monotonePx += length;
      for (std::size_t k = from, low = from, high = from; k < to; ++k) {
        const double middle = 0.5 * (s[k] + s[k + 1]);
        while (low < k && s[low + 1] < middle - kSlopeReachPx) ++low;
        while (high < to && s[high] < middle + kSlopeReachPx) ++high;
        const double slope = (kappa[high] - kappa[low]) / (s[high] - s[low]);
        if (std::abs(slope) < kFlatShare * std::abs(rise) / length) flatPx += s[k + 1] - s[k];
      }
    }
  }
};

/// Sums over the smooth parts of all curves.
struct Sums {
  double square = 0.0, max = 0.0, curvatureSquare = 0.0;
  std::size_t count = 0;
};

class Comparison {
 public:
  Comparison(const TruthShape& shape, double borderPx)
      : shape_(shape), index_(shape), border_(borderPx), found_(shape.pieces.size()) {}

  void add(const SampledCurve& curve, Accuracy& result) {
    std::vector<Foot> feet;
    for (const Vec2& p : curve.points) feet.push_back(index_.nearest(p));
    std::vector<double> distances;
    for (const Foot& f : feet) distances.push_back(f.distance);
    if (upperMedian(distances) > kOutlierPx + border_) {  // another line of the page, not this shape
      result.outlierPx += kSamplePx * static_cast<double>(curve.points.size());
      return;
    }
    double along = 0.0;
    for (std::size_t i = 1; i < feet.size(); ++i)
      along += (curve.points[i] - curve.points[i - 1]).dot(feet[i].tangent) > 0.0 ? 1.0 : -1.0;
    const double sign = along < 0.0 ? -1.0 : 1.0;
    for (std::size_t i = 0; i < feet.size(); ++i) {
      if (feet[i].distance > kOutlierPx + border_) result.outlierPx += kSamplePx;
      reached_.push_back(curve.points[i]);
    }
    addSmooth(curve, feet, sign);
    if (border_ <= 0.0) addExtrema(curve, feet, sign);
  }

  void finish(Accuracy& result) const {
    result.cornersTrue = static_cast<int>(shape_.corners.size());
    if (sums_.count == 0) return;
    result.rmsPx = std::sqrt(sums_.square / static_cast<double>(sums_.count));
    result.maxPx = sums_.max;
    result.curvatureError = std::sqrt(sums_.curvatureSquare / static_cast<double>(sums_.count)) * shape_.diagonal();
    measureCoverage(result);
    if (border_ > 0.0) return;
    const bool ring = shape_.corners.empty();
    result.monotonePx = flatness_.monotonePx;
    result.flatPx = flatness_.flatPx;
    const Flatness asDrawn = trueFlatness();
    result.trueMonotonePx = asDrawn.monotonePx;
    result.trueFlatPx = asDrawn.flatPx;
    for (std::size_t p = 0; p < shape_.pieces.size(); ++p) {
      const std::vector<Placed> truth = trueExtremaOf(shape_, p);
      std::vector<Placed> found = found_[p];
      std::sort(found.begin(), found.end(), [](const Placed& a, const Placed& b) { return a.s < b.s; });
      const double length = index_.length[p], within = 0.06 * length + 10.0;
      const int pairs = ring ? pairsOnRing(truth, found, within, length) : pairsOf(truth, found, within);
      result.trueExtrema += static_cast<int>(truth.size());
      result.falseExtrema += static_cast<int>(found.size()) - pairs;
      result.missedExtrema += static_cast<int>(truth.size()) - pairs;
    }
  }

 private:
  bool isSmooth(const Vec2& p) const { return distanceToCorners(shape_, p) >= kCornerZonePx; }

  void addSmooth(const SampledCurve& curve, const std::vector<Foot>& feet, double sign) {
    for (std::size_t i = 0; i < feet.size(); ++i) {
      if (!isSmooth(curve.points[i])) continue;
      const double distance = std::abs(feet[i].distance - border_);
      const double error = sign * curve.kappa[i] - feet[i].kappa;
      sums_.square += distance * distance;
      sums_.max = std::max(sums_.max, distance);
      sums_.curvatureSquare += error * error;
      ++sums_.count;
    }
  }

  void addExtrema(const SampledCurve& curve, const std::vector<Foot>& feet, double sign) {
    const std::size_t n = feet.size();
    const double prominence = kExtremumProminence / shape_.diagonal();
    for (std::size_t begin = 0; begin < n;) {
      std::size_t end = begin;
      const int piece = feet[begin].piece;
      while (end < n && feet[end].piece == piece && isSmooth(curve.points[end])) ++end;
      std::vector<double> kappa;
      for (std::size_t i = begin; i < end; ++i) kappa.push_back(sign * curve.kappa[i]);
      const bool periodic = curve.closed && begin == 0 && end == n;
      for (const ProfileExtremum& e : extremaOf(kappa, prominence, periodic))
        found_[piece].push_back({feet[begin + e.index].s, e.isMaximum});
      std::vector<double> s;
      for (std::size_t i = begin; i < end; ++i)
        s.push_back(i > begin ? s.back() + (curve.points[i] - curve.points[i - 1]).norm() : 0.0);
      if (end > begin + 1) flatness_.add(s, kappa, prominence, periodic);
      begin = std::max(end, begin + 1);
    }
  }

  Flatness trueFlatness() const {
    Flatness truth;
    for (const TruthPiece& piece : shape_.pieces) {
      std::vector<double> s, kappa;
      for (std::size_t i = 0; i < piece.points.size(); ++i) {
        if (!isSmooth(piece.points[i])) continue;
        s.push_back(s.empty() ? 0.0 : s.back() + (piece.points[i] - piece.points[i - 1]).norm());
        kappa.push_back(piece.kappa[i]);
      }
      if (s.size() > 1) truth.add(s, kappa, kExtremumProminence / shape_.diagonal(), shape_.corners.empty());
    }
    return truth;
  }

  void measureCoverage(Accuracy& result) const {
    std::vector<Vec2> reached = reached_;
    std::sort(reached.begin(), reached.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
    const double within = kFoundWithinPx + border_;
    const std::vector<Vec2> outline = shape_.outline();
    std::size_t covered = 0, asked = 0;
    for (std::size_t i = 0; i < outline.size(); i += 25) {
      ++asked;
      const Vec2& at = outline[i];
      const auto from = std::lower_bound(reached.begin(), reached.end(), at.x() - within,
                                         [](const Vec2& p, double x) { return p.x() < x; });
      for (auto it = from; it != reached.end() && it->x() <= at.x() + within; ++it) {
        if ((*it - at).norm() > within) continue;
        ++covered;
        break;
      }
    }
    result.coverage = static_cast<double>(covered) / static_cast<double>(asked);
    result.found = result.coverage >= 0.95;
  }

  const TruthShape& shape_;
  TruthIndex index_;
  double border_;
  std::vector<std::vector<Placed>> found_;
  std::vector<Vec2> reached_;
  Flatness flatness_;
  Sums sums_;
};

/// The angle between the two sides that meet at corner i: pieces i - 1 and i.
double openingAt(const TruthShape& shape, std::size_t i) {
  const TruthPiece& before = shape.pieces[(i + shape.pieces.size() - 1) % shape.pieces.size()];
  const TruthPiece& after = shape.pieces[i];
  const Vec2 in = before.points[before.points.size() - 2] - before.points.back();
  const Vec2 out = after.points[1] - after.points[0];
  return std::atan2(std::abs(cross(in, out)), in.dot(out));
}

void measureCorners(const TruthShape& shape, const std::vector<Vec2>& corners, Accuracy& result) {
  for (std::size_t i = 0; i < shape.corners.size(); ++i) {
    double best = std::numeric_limits<double>::infinity();
    Vec2 off = Vec2::Zero();
    for (const Vec2& corner : corners) {
      const Vec2 d = corner - shape.corners[i];
      if (d.norm() < best) best = d.norm(), off = d;
    }
    if (best > kCornerWithinPx) best = std::numeric_limits<double>::infinity();
    result.corners.push_back({i, openingAt(shape, i) * 180.0 / std::numbers::pi, best, off});
    if (best <= kCornerWithinPx) ++result.cornersFound;
  }
  for (const Vec2& corner : corners) {
    if (distanceToCorners(shape, corner) > kCornerWithinPx) ++result.cornersFalse;
  }
}

SampledCurve sampledCurve(const TracedCurve& curve, bool faired, const PageFrame& frame) {
  const NurbsCurve& c = faired ? curve.faired : curve.sketched;
  const double length = frame.lengthToImage((faired ? curve.fairedFigures : curve.sketchedFigures).lengthMm);
  SampledCurve sampled;
  sampled.closed = curve.closed;
  for (const CurveSample& s : sampleByArcLength(c, std::max(20, static_cast<int>(length / kSamplePx)))) {
    sampled.points.push_back(frame.pointToImage(s.point));
    sampled.kappa.push_back(-s.kappa * frame.mmPerPx);  // y points down here
  }
  if (sampled.closed) sampled.points.pop_back(), sampled.kappa.pop_back();
  return sampled;
}

Vec2 directionOf(const SvgCubic& c, bool atEnd) {
  for (const int k : {1, 2, 3}) {
    const Vec2 d = atEnd ? Vec2(c.p[3] - c.p[3 - k]) : Vec2(c.p[k] - c.p[0]);
    if (d.norm() > 1e-9) return d.normalized();
  }
  return Vec2::Zero();
}

}  // namespace

Accuracy compareWithTruth(const TruthShape& shape, const TraceResult& result, double borderPx) {
  Accuracy accuracy;
  Comparison comparison(shape, borderPx);
  for (const SampledCurve& curve : result.curves)
    if (!curve.points.empty()) comparison.add(curve, accuracy);
  comparison.finish(accuracy);
  measureCorners(shape, result.corners, accuracy);
  return accuracy;
}

TraceResult traceShape(const TruthShape& shape, const Scan& scan, Recipe recipe, double clickOffsetPx) {
  TraceResult result;
  for (std::size_t i = 0; i < shape.corners.size() && !recipe.corners.automatic; ++i) {
    const double angle = 2.4 * static_cast<double>(i);  // clicks miss in every direction
    recipe.cornerMarks.push_back({shape.corners[i] + clickOffsetPx * Vec2(std::cos(angle), std::sin(angle))});
  }
  StageCache cache;
  const auto begin = std::chrono::steady_clock::now();
  const PipelineOutput output = runPipeline(scan, recipe, cache, {}, {});
  result.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  if (output.error) result.failure = output.error->message;
  if (!output.faired) return result;
  const bool faired = recipe.fairing.mode != FairingMode::None;
  for (const TracedCurve& curve : output.faired->curves) {
    result.curves.push_back(sampledCurve(curve, faired, output.frame));
    const NurbsCurve& shown = faired ? curve.faired : curve.sketched;
    const bool isArc = !faired && curve.construct.light && shown.isRational();
    result.controlPoints += isArc ? kPointsOfArc : shown.controlPointCount();
  }
  if (output.pieces)
    for (const Corner& corner : output.pieces->corners) result.corners.push_back(corner.positionPx);
  return result;
}

TraceResult sampledPaths(const std::vector<SvgPath>& paths) {
  constexpr double kCornerCosine = 0.94;  // 20 degrees
  TraceResult result;
  for (const SvgPath& path : paths) {
    SampledCurve curve;
    curve.closed = path.closed;
    const std::size_t n = path.segments.size();
    for (std::size_t i = 0; i < n; ++i) {
      const SvgCubic& c = path.segments[i];
      const double chord = (c.p[1] - c.p[0]).norm() + (c.p[2] - c.p[1]).norm() + (c.p[3] - c.p[2]).norm();
      const int steps = std::max(2, static_cast<int>(std::ceil(chord / kSamplePx)));
      for (int k = 0; k < steps; ++k) {
        const double t = (k + 0.5) / steps;  // within the segment: a joint has two curvatures
        const Vec2 d = c.derivative(t);
        const double speed = std::max(1e-9, d.norm());
        curve.points.push_back(c.at(t));
        curve.kappa.push_back(cross(d, c.second(t)) / (speed * speed * speed));
      }
      result.controlPoints += 3;
      if (!path.closed && i + 1 == n) continue;
      if (directionOf(c, true).dot(directionOf(path.segments[(i + 1) % n], false)) < kCornerCosine)
        result.corners.push_back(c.p[3]);
    }
    result.curves.push_back(std::move(curve));
  }
  return result;
}

}  // namespace batten::test
