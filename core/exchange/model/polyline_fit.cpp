// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/polyline_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/segment_foot.h"
#include "core/curve/arc_length.h"

namespace batten {
namespace {

constexpr int kChordSamples = 24;   ///< Places at which a chord or an arc is measured.
constexpr int kMaxChordDepth = 30;  ///< Halvings; the parameters end there.
/// A chord between samples may bow out by this much more of its own height than at the samples.
constexpr double kMargin = 0.98;
constexpr double kMaxBulge = 0.42;  ///< Arcs up to about 90 degrees.

struct End {
  double s = 0.0;
  Vec2 point, direction;
};
struct Arc {
  Vec2 from, to;
  double bulge = 0.0;
};

class Fit {
 public:
  Fit(double tolerance, bool arcs, PolylineFit& fit) : tolerance_(tolerance), arcs_(arcs), fit_(fit) {}

  void add(const NurbsCurve& curve) {
    curve_ = &curve;
    length_.emplace(curve);
    // Corners inside a curve and turns are found by the halving; pieces of the polynomials are where corners can be.
    const std::vector<double> breaks = curve.breaks();
    for (std::size_t i = 1; i < breaks.size(); ++i)
      recurse(end(breaks[i - 1], breaks[i]), end(breaks[i], breaks[i - 1]), 0);
  }
  /// The last vertex, which no edge begins at.
  void finish(const Vec2& last, bool closed) {
    fit_.line.closed = closed;
    if (!closed) fit_.line.vertices.push_back({last});
  }

 private:
  /// Place and direction at u, from the side of `other`.
  End end(double u, double other) const {
    const double inside = u + (other - u) * 1e-9;
    Vec2 direction = curve_->derivatives(u < other ? u : inside, 1)[1];
    if (!(direction.norm() > 0.0)) direction = (other > u ? 1.0 : -1.0) * (curve_->point(inside) - curve_->point(u));
    const double size = direction.norm();
    return {u, curve_->point(u), size > 0.0 ? Vec2(direction / size) : Vec2(Vec2::UnitX())};
  }

  static double bulgeOf(const Vec2& from, const Vec2& to, const Vec2& directionAtFrom) {
    const Vec2 chord = to - from;
    return std::tan(0.5 * std::atan2(cross(directionAtFrom, chord), directionAtFrom.dot(chord)));
  }

  /// Two arcs with one tangent where they meet, from the direction at one end to that at the other; handles of equal
  /// length (Bolton's biarc).
  static std::optional<std::pair<Arc, Arc>> biarc(const End& a, const End& b) {
    const Vec2 v = b.point - a.point, t = a.direction + b.direction;
    const double square = v.squaredNorm(), along = v.dot(t), turn = 2.0 * (1.0 - a.direction.dot(b.direction));
    double d = 0.0;
    if (turn > 1e-12) {
      d = (-along + std::sqrt(along * along + turn * square)) / turn;
    } else if (along > 0.0) {
      d = square / (2.0 * along);
    }
    if (!(d > 0.0) || !std::isfinite(d)) return std::nullopt;
    const Vec2 joint = 0.5 * (a.point + b.point + d * (a.direction - b.direction));
    std::pair<Arc, Arc> arcs{{a.point, joint, bulgeOf(a.point, joint, a.direction)},
                             {joint, b.point, -bulgeOf(b.point, joint, -b.direction)}};
    for (const Arc& arc : {arcs.first, arcs.second})
      if (!(std::abs(arc.bulge) <= kMaxBulge) || (arc.to - arc.from).norm() == 0.0) return std::nullopt;
    return arcs;
  }

  static double distanceFromArc(const Vec2& p, const Arc& arc) {
    const Vec2 chord = arc.to - arc.from;
    const double length = chord.norm();
    if (std::abs(arc.bulge) < 1e-9) return length > 0.0 ? std::abs(cross(chord, p - arc.from)) / length : 0.0;
    const Vec2 centre =
        arc.from + 0.5 * chord + (1.0 - arc.bulge * arc.bulge) / (4.0 * arc.bulge) * Vec2(-chord.y(), chord.x());
    return std::abs((p - centre).norm() - (arc.from - centre).norm());
  }

  template <class Distance>
  double worst(double from, double to, const Distance& distance) const {
    double most = 0.0;
    for (int i = 1; i < kChordSamples; ++i)
      most = std::max(most, distance(curve_->point(from + (to - from) * i / kChordSamples)));
    return most;
  }

  bool takeArcs(const End& a, const End& b) {
    const auto pair = biarc(a, b);
    if (!pair) return false;
    const Vec2 along = pair->second.to - pair->first.from;
    const double most = worst(a.s, b.s, [&](const Vec2& p) {
      const bool first = (p - pair->first.to).dot(along) <= 0.0;
      return distanceFromArc(p, first ? pair->first : pair->second);
    });
    if (!(most <= kMargin * tolerance_)) return false;
    fit_.line.vertices.push_back({pair->first.from, pair->first.bulge});
    fit_.line.vertices.push_back({pair->second.from, pair->second.bulge});
    fit_.largestError = std::max(fit_.largestError, most);
    return true;
  }

  void recurse(const End& a, const End& b, int depth) {
    const double middle = 0.5 * (a.s + b.s);
    const bool mayHalve = depth < kMaxChordDepth && middle > a.s && middle < b.s;
    const double flat = worst(a.s, b.s, [&](const Vec2& p) { return footOnSegment(p, a.point, b.point).away.norm(); });
    if (flat <= (arcs_ ? 1e-3 : kMargin) * tolerance_ || !mayHalve) {
      fit_.line.vertices.push_back({a.point});
      fit_.largestError = std::max(fit_.largestError, flat);
      return;
    }
    if (arcs_ && takeArcs(a, b)) return;
    const double half = length_->parameter(0.5 * (length_->at(a.s) + length_->at(b.s)));
    const double cut = half > a.s && half < b.s ? half : middle;
    recurse(a, end(cut, a.s), depth + 1);
    recurse(end(cut, b.s), b, depth + 1);
  }

  double tolerance_;
  bool arcs_;
  PolylineFit& fit_;
  const NurbsCurve* curve_ = nullptr;
  std::optional<ArcLength> length_;
};

/// Vertices on the straight between their neighbours say nothing: the spans of a spline end there.
void dropStraight(CadPolyline& line) {
  std::vector<CadVertex> kept;
  for (std::size_t i = 0; i < line.vertices.size(); ++i) {
    const CadVertex& now = line.vertices[i];
    const bool inner = !kept.empty() && i + 1 < line.vertices.size();
    if (inner && now.bulge == 0.0 && kept.back().bulge == 0.0) {
      const Vec2 in = now.point - kept.back().point, out = line.vertices[i + 1].point - now.point;
      if (std::abs(cross(in, out)) <= 1e-9 * in.norm() * out.norm() && in.dot(out) > 0.0) continue;
    }
    kept.push_back(now);
  }
  line.vertices = std::move(kept);
}

}  // namespace

PolylineFit polylineWithin(std::span<const NurbsCurve> curves, bool closed, double tolerance, bool arcs) {
  PolylineFit result;
  Fit fit(tolerance, arcs, result);
  for (const NurbsCurve& curve : curves) fit.add(curve);
  fit.finish(curves.back().point(curves.back().end()), closed);
  dropStraight(result.line);
  return result;
}

}  // namespace batten
