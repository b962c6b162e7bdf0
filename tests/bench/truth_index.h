// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "tests/support/truth_shapes.h"

namespace batten::test {

/// Where the truth is nearest to a place.
struct Foot {
  double distance = std::numeric_limits<double>::infinity();
  double kappa = 0.0;
  int piece = 0;
  double s = 0.0;  ///< [px] along the piece.
  Vec2 tangent = Vec2::Zero();
};

/// The truth as facets in a grid of cells.
class TruthIndex {
 public:
  explicit TruthIndex(const TruthShape& shape) {
    for (std::size_t p = 0; p < shape.pieces.size(); ++p) {
      const TruthPiece& piece = shape.pieces[p];
      const std::size_t count = piece.points.size();
      const bool wraps = shape.corners.empty();
      double s = 0.0;
      for (std::size_t i = 0; i + (wraps ? 0 : 1) < count; ++i) {
        const std::size_t j = (i + 1) % count;
        facets_.push_back({piece.points[i], piece.points[j], piece.kappa[i], piece.kappa[j], static_cast<int>(p), s});
        s += (piece.points[j] - piece.points[i]).norm();
      }
      length.push_back(s);
    }
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      auto& cell = cells_[key(cellOf(facets_[f].a.x()), cellOf(facets_[f].a.y()))];
      cell.push_back(f);
    }
  }

  Foot nearest(const Vec2& p) const {
    Foot best;
    const int cx = cellOf(p.x()), cy = cellOf(p.y());
    // Facets start in the cell they are filed under and are far shorter than a cell: one ring more than the distance.
    for (int ring = 0; ring < 400 && (ring - 2) * kCellPx <= best.distance; ++ring) {
      for (int dy = -ring; dy <= ring; ++dy) {
        const int step = std::abs(dy) == ring || ring == 0 ? 1 : 2 * ring;
        for (int dx = -ring; dx <= ring; dx += step) look(p, key(cx + dx, cy + dy), best);
      }
    }
    return best;
  }

  std::vector<double> length;  ///< [px] of every piece.

 private:
  struct Facet {
    Vec2 a, b;
    double kappaA, kappaB;
    int piece;
    double s;
  };
  static constexpr double kCellPx = 8.0;
  static int cellOf(double v) { return static_cast<int>(std::floor(v / kCellPx)); }
  static std::int64_t key(int x, int y) { return (static_cast<std::int64_t>(y) << 32) ^ (x & 0xffffffffLL); }

  void look(const Vec2& p, std::int64_t cell, Foot& best) const {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return;
    for (const std::size_t index : found->second) {
      const Facet& f = facets_[index];
      const Vec2 d = f.b - f.a;
      const double square = d.squaredNorm();
      const double t = square > 0.0 ? std::clamp((p - f.a).dot(d) / square, 0.0, 1.0) : 0.0;
      const double distance = (p - f.a - t * d).norm();
      if (!(distance < best.distance)) continue;
      best = {distance, std::lerp(f.kappaA, f.kappaB, t), f.piece, f.s + t * std::sqrt(square), d};
    }
  }

  std::vector<Facet> facets_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

}  // namespace batten::test
