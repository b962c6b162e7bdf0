// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/overlap_removal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/contour/merge/stroke_lines.h"
#include "core/polyline/point_grid.h"

namespace batten {
namespace {

constexpr double kOnLinePx = 1.6;     // a point this near to another line lies on it, or this part of
constexpr double kOnLine = 0.15;      // the distance within which strokes are one
constexpr double kSameWay = 0.8;      // cosine between lines that are one
constexpr int kShortestRun = 12;      // points: lying on a line for less is crossing it
constexpr int kShortestGap = 4;       // points: not lying on a line for less is noise
constexpr double kOwnWay = 4.0;       // distances along a line before it can lie on itself
constexpr double kTouch = 0.25;       // distances: an end as near as this touches
constexpr double kShort = 2.0;        // distances: such strokes need not touch
constexpr double kBesideSlack = 0.1;  // part of a stretch that may be farther away than beside

struct CoverPlace {
  int piece = 0, index = 0;
};

// How one point lies to the lines before it.
struct PointCover {
  bool on = false, beside = false;
  CoverPlace place;  // the nearest point in the same direction
};

class PieceMaker {
 public:
  explicit PieceMaker(double distancePx)
      : distance_(std::max(1.0, distancePx)),
        onLine_(std::clamp(kOnLine * distancePx, kOnLinePx, 4.0)),
        index_(std::max(distance_, onLine_)) {}

  void add(MeanLine line, const RunContext& context) {
    std::vector<PointCover> covers = coverage(line, context);
    if (context.isCancelled()) return;
    if (line.closed) {
      const auto first = std::find_if(covers.begin(), covers.end(), [](const PointCover& c) { return c.on; });
      if (first == covers.end()) return keepWhole(std::move(line));
      // A ring that partly lies on other lines becomes an open line that begins there.
      turnTo(line, static_cast<int>(first - covers.begin()));
      line.closed = false;
      covers = coverage(line, context);
      if (context.isCancelled()) return;
    }
    keepUncovered(line, covers);
  }

  StrokePieces finish() {
    attachEnds();
    return std::move(result_);
  }

 private:
  std::vector<PointCover> coverage(const MeanLine& line, const RunContext& context) const {
    const int n = static_cast<int>(line.points.size());
    const int ownWay = static_cast<int>(kOwnWay * distance_) + 30;
    std::vector<PointCover> covers(line.points.size());
    PointGrid<CoverPlace> own(std::max(distance_, onLine_));
    for (int i = 0; i < n; ++i) {
      if ((i & 4095) == 0 && context.isCancelled()) break;
      const auto at = static_cast<std::size_t>(i);
      PointCover& c = covers[at];
      double nearest = distance_;
      const auto look = [&](const Vec2& p, const Vec2& t, CoverPlace place) {
        const double d = (p - line.points[at]).norm();
        if (d > nearest || std::abs(t.dot(line.tangent[at])) < kSameWay) return;
        // The same from any order of the cells.
        if (d == nearest && c.beside && std::pair(place.piece, place.index) > std::pair(c.place.piece, c.place.index))
          return;
        nearest = d;
        c = {d <= onLine_, true, place};
      };
      index_.around(line.points[at], [&](const CoverPlace& p) {
        const MeanLine& piece = result_.pieces[p.piece];
        look(piece.points[p.index], piece.tangent[p.index], p);
      });
      own.around(line.points[at], [&](const CoverPlace& p) {
        const int apart = i - p.index;
        if (apart < ownWay || (line.closed && n - apart < ownWay)) return;
        look(line.points[p.index], line.tangent[p.index], p);
      });
      if (!c.on) own.add(line.points[at], {-1, i});
    }
    flipRuns(covers, false, kShortestGap, false);
    flipRuns(covers, true, kShortestRun, true);
    absorbBeside(covers);
    return covers;
  }

  static void flipRuns(std::vector<PointCover>& covers, bool what, int shorter, bool onlyInside) {
    const int n = static_cast<int>(covers.size());
    for (int i = 0; i < n; ++i) {
      if (covers[i].on != what) continue;
      int end = i;
      while (end + 1 < n && covers[end + 1].on == what) ++end;
      const bool inside = i > 0 && end + 1 < n;
      if (end - i + 1 < shorter && (inside || !onlyInside))
        for (int k = i; k <= end; ++k) covers[k].on = !what;
      i = end;
    }
  }

  // A stretch that leaves a line, stays within the distance all along and comes back, or ends there, is of that line.
  // A short stroke beside one is, too.
  void absorbBeside(std::vector<PointCover>& covers) const {
    const int n = static_cast<int>(covers.size());
    for (int i = 0; i < n; ++i) {
      if (covers[i].on) continue;
      int end = i, beside = 0;
      while (end + 1 < n && !covers[end + 1].on) ++end;
      for (int k = i; k <= end; ++k) beside += covers[k].beside ? 1 : 0;
      const bool touches = i > 0 || end + 1 < n || n < kShort * distance_;
      if (touches && beside >= (1.0 - kBesideSlack) * (end - i + 1))
        for (int k = i; k <= end; ++k) covers[k].on = true;
      i = end;
    }
  }

  void index(int piece) {
    const MeanLine& line = result_.pieces[piece];
    for (std::size_t i = 0; i < line.points.size(); ++i) index_.add(line.points[i], {piece, static_cast<int>(i)});
  }

  void keepWhole(MeanLine line) {
    result_.pieces.push_back(std::move(line));
    index(static_cast<int>(result_.pieces.size()) - 1);
  }

  // The place on what was kept that the point `i` lies on; the line's own points have become pieces by then.
  static std::optional<CoverPlace> placeOf(const std::vector<PointCover>& covers, const std::vector<CoverPlace>& kept,
                                           int i) {
    for (int k : {i, i - 1, i + 1, i - 2, i + 2}) {
      if (k < 0 || k >= static_cast<int>(covers.size())) continue;
      const PointCover& c = covers[k];
      if (!c.beside) continue;
      const CoverPlace place = c.place.piece >= 0 ? c.place : kept[c.place.index];
      if (place.piece >= 0) return place;
    }
    return std::nullopt;
  }

  void keepUncovered(const MeanLine& line, const std::vector<PointCover>& covers) {
    const int n = static_cast<int>(line.points.size());
    std::vector<CoverPlace> kept(line.points.size(), {-1, 0});
    std::vector<std::pair<int, int>> runs;
    const auto before = static_cast<int>(result_.pieces.size());
    for (int i = 0; i < n; ++i) {
      if (covers[i].on) continue;
      int end = i;
      while (end + 1 < n && !covers[end + 1].on) ++end;
      if (end - i >= 2) {
        for (int k = i; k <= end; ++k) kept[k] = {static_cast<int>(result_.pieces.size()), k - i};
        result_.pieces.push_back(partOf(line, i, end));
        runs.emplace_back(i, end);
      }
      i = end;
    }
    for (int r = 0; r < static_cast<int>(runs.size()); ++r) {
      const auto [from, to] = runs[r];
      const auto attach = [&](int side, int beyond) {
        if (beyond < 0 || beyond >= n) return;
        if (const auto place = placeOf(covers, kept, beyond))
          result_.attachments.push_back({before + r, side, place->piece, place->index});
      };
      attach(0, from - 1);
      attach(1, to + 1);
      index(before + r);
    }
  }

  // A line that begins or ends in another, about in its direction, goes on along it.
  void attachEnds() {
    const double nearPx = std::max(onLine_, kTouch * distance_);
    std::vector<std::array<bool, 2>> attached(result_.pieces.size(), {false, false});
    for (const StrokePieces::Attachment& a : result_.attachments) attached[a.piece][a.side] = true;
    const int ownWay = static_cast<int>(kOwnWay * distance_) + 30;
    for (int p = 0; p < static_cast<int>(result_.pieces.size()); ++p) {
      const MeanLine& piece = result_.pieces[p];
      const int n = static_cast<int>(piece.points.size());
      for (const int side : {0, 1}) {
        if (piece.closed || attached[p][side]) continue;
        const int end = side == 0 ? 0 : n - 1, inside = side == 0 ? std::min(n - 1, 8) : std::max(0, n - 9);
        const Vec2& tip = piece.points[end];
        const Vec2 way = tip - piece.points[inside];
        std::optional<CoverPlace> best;
        double nearest = nearPx;
        index_.around(tip, [&](const CoverPlace& place) {
          if (place.piece == p && std::abs(place.index - end) < ownWay) return;
          const MeanLine& other = result_.pieces[place.piece];
          const auto k = static_cast<std::size_t>(place.index);
          const double d = (other.points[k] - tip).norm();
          if (d > nearest || std::abs(other.tangent[k].dot(way)) < kSameWay * way.norm()) return;
          if (d == nearest && best && std::pair(place.piece, place.index) > std::pair(best->piece, best->index)) return;
          nearest = d;
          best = place;
        });
        if (best) result_.attachments.push_back({p, side, best->piece, best->index});
      }
    }
  }

  double distance_, onLine_;
  StrokePieces result_;
  PointGrid<CoverPlace> index_;
};

}  // namespace

StrokePieces removeOverlaps(std::vector<MeanLine> lines, double distancePx, const RunContext& context) {
  PieceMaker maker(distancePx);
  for (MeanLine& line : lines) {
    if (context.isCancelled()) return {};
    if (line.points.size() >= 3) maker.add(std::move(line), context);
  }
  return maker.finish();
}

}  // namespace batten
