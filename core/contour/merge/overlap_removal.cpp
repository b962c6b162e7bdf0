// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/overlap_removal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <optional>
#include <utility>

#include "core/contour/merge/stroke_lines.h"
#include "core/polyline/point_grid.h"

namespace batten {
namespace {

constexpr double kOnLinePx = 1.6;       // a point this near to another line lies on it, or this part of
constexpr double kOnLine = 0.15;        // the distance within which strokes are one
constexpr double kSameDirection = 0.8;  // 37 degrees: the cosine between lines that are one
constexpr int kShortestOn = 12;         // points: lying on a line for less is crossing it
constexpr int kShortestGap = 4;         // points: not lying on a line for less is noise
constexpr double kOwnLength = 4.0;      // distances along a line,
constexpr int kOwnPoints = 30;          // and so many points, before it can lie on itself
constexpr int kTipPoints = 8;           // over which the direction of an end is taken
constexpr int kPointsPerLook = 4096;    // between two looks at the cancel token
constexpr double kMostOnLinePx = 4.0;   // however far strokes are merged: farther off lies another stroke
constexpr double kTouch = 0.25;         // distances: an end as near as this touches
constexpr double kShort = 2.0;          // distances: such strokes need not touch
constexpr double kBesideSlack = 0.1;    // part of a stretch that may be farther away than beside

// A point of a piece.
struct PiecePlace {
  int piece = 0, index = 0;
  auto operator<=>(const PiecePlace&) const = default;  // NOLINT(modernize-use-nullptr): a false alarm
};

// A point that another lies on or beside: of a piece, or of the line itself, which is none yet.
struct CoverPlace {
  std::optional<int> piece;
  int index = 0;
  auto operator<=>(const CoverPlace&) const = default;  // NOLINT(modernize-use-nullptr): a false alarm
};

// How one point lies to the lines before it.
struct PointCover {
  bool on = false;
  std::optional<CoverPlace> beside;  // the nearest point in the same direction
};

class PieceMaker {
 public:
  explicit PieceMaker(double distancePx)
      : distance_(std::max(1.0, distancePx)),
        onLine_(std::clamp(kOnLine * distancePx, kOnLinePx, kMostOnLinePx)),
        ownLength_(static_cast<int>(kOwnLength * distance_) + kOwnPoints),
        index_(std::max(distance_, onLine_)) {}

  void add(MeanLine line, const RunContext& context) {
    std::vector<PointCover> covers = coverage(line, context);
    if (context.isCancelled()) return;
    if (line.closed) {
      const auto first = std::find_if(covers.begin(), covers.end(), [](const PointCover& c) { return c.on; });
      if (first == covers.end()) return keepWhole(std::move(line));
      // A ring that partly lies on other lines becomes an open line that begins there.
      startAt(line, static_cast<int>(first - covers.begin()));
      line.closed = false;
      covers = coverage(line, context);
      if (context.isCancelled()) return;
    }
    keepUncovered(line, covers);
  }

  RemainingLines finish() {
    attachEnds();
    return std::move(result_);
  }

 private:
  std::vector<PointCover> coverage(const MeanLine& line, const RunContext& context) const {
    const int n = line.count();
    std::vector<PointCover> covers(line.points.size());
    PointGrid<int> own(std::max(distance_, onLine_));
    for (int i = 0; i < n; ++i) {
      if (i % kPointsPerLook == 0 && context.isCancelled()) break;
      const MeanPoint& here = line.points[i];
      PointCover& c = covers[i];
      double nearest = distance_;
      const auto look = [&](const MeanPoint& there, const CoverPlace& place) {
        const double d = (there.at - here.at).norm();
        if (d > nearest || std::abs(there.tangent.dot(here.tangent)) < kSameDirection) return;
        // The same from any order of the cells.
        if (d == nearest && c.beside && place > *c.beside) return;
        nearest = d;
        c = {d <= onLine_, place};
      };
      index_.around(here.at, [&](const PiecePlace& p) {
        look(result_.pieces[p.piece].points[p.index], {p.piece, p.index});
      });
      own.around(here.at, [&](int index) {
        const int apart = i - index;
        if (apart < ownLength_ || (line.closed && n - apart < ownLength_)) return;
        look(line.points[index], {std::nullopt, index});
      });
      if (!c.on) own.add(here.at, i);
    }
    flipStretches(covers, false, kShortestGap, false);
    flipStretches(covers, true, kShortestOn, true);
    absorbBeside(covers);
    return covers;
  }

  // Stretches that lie on lines, or do not, as `what` says, and are shorter than this count as what is around them.
  static void flipStretches(std::vector<PointCover>& covers, bool what, int shorter, bool onlyInside) {
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
    for (int i = 0; i < line.count(); ++i) index_.add(line.points[i].at, {piece, i});
  }

  void keepWhole(MeanLine line) {
    result_.pieces.push_back(std::move(line));
    index(static_cast<int>(result_.pieces.size()) - 1);
  }

  using Kept = std::vector<std::optional<PiecePlace>>;  // by point of the line: where it went

  // The place on what was kept that the point `i` lies on; the line's own points have become pieces by then.
  static std::optional<PiecePlace> placeOf(const std::vector<PointCover>& covers, const Kept& kept, int i) {
    for (const int k : {i, i - 1, i + 1, i - 2, i + 2}) {
      if (k < 0 || k >= std::ssize(covers) || !covers[k].beside) continue;
      const CoverPlace& place = *covers[k].beside;
      if (place.piece) return PiecePlace{*place.piece, place.index};
      if (kept[place.index]) return kept[place.index];
    }
    return std::nullopt;
  }

  void keepUncovered(const MeanLine& line, const std::vector<PointCover>& covers) {
    const int n = line.count();
    Kept kept(line.points.size());
    std::vector<std::pair<int, int>> stretches;
    const int before = static_cast<int>(result_.pieces.size());
    for (int i = 0; i < n; ++i) {
      if (covers[i].on) continue;
      int end = i;
      while (end + 1 < n && !covers[end + 1].on) ++end;
      if (end - i >= 2) {
        for (int k = i; k <= end; ++k) kept[k] = PiecePlace{static_cast<int>(result_.pieces.size()), k - i};
        result_.pieces.push_back(partOf(line, i, end));
        stretches.emplace_back(i, end);
      }
      i = end;
    }
    for (int r = 0; r < std::ssize(stretches); ++r) {
      const auto [from, to] = stretches[r];
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

  // The nearest place that an end of a piece lies on, about in its direction.
  std::optional<PiecePlace> placeUnder(int piece, int side, double nearPx) const {
    const MeanLine& own = result_.pieces[piece];
    const int n = own.count(), end = side == 0 ? 0 : n - 1;
    const int inside = side == 0 ? std::min(n - 1, kTipPoints) : std::max(0, n - 1 - kTipPoints);
    const Vec2& tip = own.points[end].at;
    const Vec2 out = tip - own.points[inside].at;
    std::optional<PiecePlace> best;
    double nearest = nearPx;
    index_.around(tip, [&](const PiecePlace& place) {
      if (place.piece == piece && std::abs(place.index - end) < ownLength_) return;
      const MeanPoint& other = result_.pieces[place.piece].points[place.index];
      const double d = (other.at - tip).norm();
      if (d > nearest || std::abs(other.tangent.dot(out)) < kSameDirection * out.norm()) return;
      if (d == nearest && best && place > *best) return;
      nearest = d;
      best = place;
    });
    return best;
  }

  // A line that begins or ends in another, about in its direction, goes on along it.
  void attachEnds() {
    const double nearPx = std::max(onLine_, kTouch * distance_);
    std::vector<std::array<bool, 2>> attached(result_.pieces.size(), {false, false});
    for (const RemainingLines::Attachment& a : result_.attachments) attached[a.piece][a.side] = true;
    for (int p = 0; p < std::ssize(result_.pieces); ++p) {
      for (const int side : {0, 1}) {
        if (result_.pieces[p].closed || attached[p][side]) continue;
        if (const auto place = placeUnder(p, side, nearPx))
          result_.attachments.push_back({p, side, place->piece, place->index});
      }
    }
  }

  double distance_, onLine_;  // [px]
  int ownLength_;             // points
  RemainingLines result_;
  PointGrid<PiecePlace> index_;
};

}  // namespace

RemainingLines removeOverlaps(std::vector<MeanLine> lines, double distancePx, const RunContext& context) {
  PieceMaker maker(distancePx);
  for (MeanLine& line : lines) {
    if (context.isCancelled()) return {};
    if (line.points.size() >= 3) maker.add(std::move(line), context);
  }
  return maker.finish();
}

}  // namespace batten
