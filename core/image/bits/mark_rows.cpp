// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/mark_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/base/parallel.h"
#include "core/base/vec2.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

constexpr int kDirections = 24;             // over half a turn; a mark is met half a step aside
constexpr double kNoBroader = 1.6;          // times as broad, and a pixel of the raster
constexpr double kAlongAcross = 1.25;       // a mark is no broader than this part of its length, and half a pixel
constexpr double kGapsAlike = 3.0;          // times as wide, and a pixel
constexpr int kDirectionsAlike = 2;         // steps from mark to mark
constexpr double kLeastGapWidths = 0.75;    // nearer pieces are the grain of a stroke
constexpr int kLeastMembers = 3;            // of a row
constexpr double kLeastLengthWidths = 2.0;  // a dot's gap is measured by this many of its widths
constexpr std::int64_t kMostMarkPx = 4096;  // a larger piece is no mark
constexpr int kMarksPerLook = 16;           // one part of the work of the threads

struct Mark {
  std::vector<Vec2> pixels;  // centres
  Vec2 middle = Vec2::Zero();
};

struct Marks {
  std::vector<Mark> all;
  std::vector<std::optional<int>> ofPiece;  // index into `all`, by the first run of the piece
};

// What lies on one side of a mark.
struct Neighbour {
  double gapPx = 0.0;
  std::optional<int> mark;  // absent: the end of longer ink
};

struct RowMember {
  int direction = 0;
  std::array<std::optional<Neighbour>, 2> side;
  bool hasBoth() const { return side[0] && side[1]; }
};

Marks marksOf(const RunPieces& pieces) {
  Marks marks;
  std::vector<std::int64_t> areas(pieces.runs.size(), 0);
  marks.ofPiece.resize(pieces.runs.size());
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) areas[pieces.piece[i]] += pieces.runs[i].x1 - pieces.runs[i].x0;
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    if (areas[pieces.piece[i]] > kMostMarkPx) continue;
    std::optional<int>& index = marks.ofPiece[pieces.piece[i]];
    if (!index) {
      index = static_cast<int>(marks.all.size());
      marks.all.emplace_back();
    }
    const InkRun& run = pieces.runs[i];
    for (int x = run.x0; x < run.x1; ++x) marks.all[*index].pixels.emplace_back(x + 0.5, run.y + 0.5);
  }
  for (Mark& mark : marks.all)
    for (const Vec2& p : mark.pixels) mark.middle += p / static_cast<double>(mark.pixels.size());
  return marks;
}

Vec2 unitOf(int direction) {
  const double angle = direction * std::numbers::pi / kDirections;
  return {std::cos(angle), std::sin(angle)};
}

bool isInk(const BitImage& ink, const Vec2& at) {
  return ink.at(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())));
}

class RowSearch {
 public:
  RowSearch(const RunPieces& pieces, const Marks& marks, const BitImage& ink)
      : pieces_(pieces), marks_(marks), ink_(ink) {}

  // The member that a mark is of a row; absent: it has no neighbour in any direction. Two neighbours are better than
  // one, and near ones better than far ones.
  std::optional<RowMember> memberOf(int mark) const {
    std::optional<RowMember> best;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kDirections; ++k) {
      const std::optional<RowMember> found = along(mark, k);
      if (!found) continue;
      double gaps = 0.0;
      for (const auto& side : found->side) gaps += side ? side->gapPx : 0.0;
      const bool isBetter = !best || (found->hasBoth() && !best->hasBoth());
      if (!isBetter && (found->hasBoth() != best->hasBoth() || gaps >= least)) continue;
      best = found;
      least = gaps;
    }
    return best;
  }

 private:
  std::optional<RowMember> along(int index, int direction) const {
    const Mark& mark = marks_.all[index];
    const Vec2 u = unitOf(direction), v = leftNormal(u);
    double from = 0.0, to = 0.0, left = 0.0, right = 0.0;
    for (const Vec2& p : mark.pixels) {
      const Vec2 off = p - mark.middle;
      from = std::min(from, off.dot(u)), to = std::max(to, off.dot(u));
      right = std::min(right, off.dot(v)), left = std::max(left, off.dot(v));
    }
    const double lengthPx = to - from + 1.0, widthPx = left - right + 1.0;
    if (widthPx > kAlongAcross * lengthPx + 0.5) return std::nullopt;
    const double reachPx = kMostMarkGap * std::max(lengthPx, kLeastLengthWidths * widthPx);
    RowMember member{direction, {}};
    member.side[0] = neighbour(index, -u, -from, reachPx, widthPx);
    member.side[1] = neighbour(index, u, to, reachPx, widthPx);
    if (!member.side[0] && !member.side[1]) return std::nullopt;
    if (member.hasBoth()) {
      const double a = member.side[0]->gapPx, b = member.side[1]->gapPx;
      if (std::max(a, b) > kGapsAlike * std::min(a, b) + 1.0) return std::nullopt;
    }
    return member;
  }

  std::optional<Neighbour> neighbour(int index, const Vec2& u, double beginPx, double reachPx, double widthPx) const {
    constexpr double kStepPx = 0.5, kInsidePx = 1.0;  // along the way; into the ink that is met
    for (double gap = kStepPx; gap <= reachPx; gap += kStepPx) {
      const Vec2 at = marks_.all[index].middle + (beginPx + 0.5 + gap) * u;
      if (!isInk(ink_, at)) continue;
      const auto piece = pieceAt(pieces_, static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())));
      const std::optional<int> mark = piece ? marks_.ofPiece[*piece] : std::nullopt;
      if (mark == index) return std::nullopt;  // it bends
      if (gap < kLeastGapWidths * widthPx) return std::nullopt;
      if (!isNarrow(at + kInsidePx * u, u, kNoBroader * widthPx + 1.0)) return std::nullopt;
      return Neighbour{gap, mark};
    }
    return std::nullopt;
  }

  // Whether the ink at a place is no broader than this across a direction: the end of something that lies along it, and
  // not the side of a line that is met askew.
  bool isNarrow(const Vec2& at, const Vec2& u, double mostPx) const {
    constexpr int kAngles = 8;  // of half a turn
    const Vec2 v = leftNormal(u);
    for (int k = 1; k < kAngles; ++k) {
      const double angle = k * std::numbers::pi / kAngles;
      const Vec2 askew = std::cos(angle) * u + std::sin(angle) * v;
      const double most = mostPx / std::sin(angle);
      double chordPx = 0.0;
      for (const double side : {-1.0, 1.0})
        for (double off = 0.5; off <= most && isInk(ink_, at + side * off * askew); off += 0.5) chordPx += 0.5;
      if (chordPx > most) return false;
    }
    return true;
  }

  const RunPieces& pieces_;
  const Marks& marks_;
  const BitImage& ink_;
};

// Marks by squares of the page, to look around one as far as it asks and until enough is seen; a PointGrid
// (core/polyline) looks one cell around, and to its end.
class MarkGrid {
 public:
  MarkGrid(const Marks& marks, int width) : marks_(marks), columns_(width / kCellPx + 1) {
    for (int i = 0; i < std::ssize(marks.all); ++i) {
      const int cell = cellOf(marks.all[i].middle);
      if (cell >= std::ssize(cells_)) cells_.resize(cell + 1);
      cells_[cell].push_back(i);
    }
  }
  // Looks at the marks around a place until `isEnough` says so.
  template <class IsEnough>
  void around(const Vec2& at, double reachPx, const IsEnough& isEnough) const {
    const int reach = static_cast<int>(reachPx) / kCellPx + 1, x = static_cast<int>(at.x()) / kCellPx;
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int i = std::max(0, x - reach); i <= std::min(columns_ - 1, x + reach); ++i) {
        const int cell = (static_cast<int>(at.y()) / kCellPx + dy) * columns_ + i;
        if (cell < 0 || cell >= std::ssize(cells_)) continue;
        for (const int mark : cells_[cell]) {
          if ((marks_.all[mark].middle - at).norm() <= reachPx && isEnough(mark)) return;
        }
      }
    }
  }

 private:
  static constexpr int kCellPx = 16;
  int cellOf(const Vec2& p) const {
    return static_cast<int>(p.y()) / kCellPx * columns_ + static_cast<int>(p.x()) / kCellPx;
  }
  const Marks& marks_;
  int columns_;
  std::vector<std::vector<int>> cells_;
};

// The dots of a halftone, a chequer, a woven ground: as many lie around as only a lattice of them has, or beside one.
std::vector<bool> findLattices(const Marks& marks, const std::vector<std::optional<RowMember>>& members, int width) {
  constexpr double kPitches = 2.1;   // within so many a square lattice has 12, and one of triangles 18
  constexpr int kFewestAround = 12;  // three rows side by side, and they end nowhere near
  const MarkGrid grid(marks, width);
  const int count = static_cast<int>(members.size());
  std::vector<double> pitch(count, 0.0);
  std::vector<bool> isWithin(count, false);
  for (int i = 0; i < count; ++i) {
    if (!members[i] || !members[i]->hasBoth()) continue;
    for (const auto& side : members[i]->side) {
      if (!side->mark) continue;
      const double apart = (marks.all[*side->mark].middle - marks.all[i].middle).norm();
      pitch[i] = pitch[i] > 0.0 ? std::min(pitch[i], apart) : apart;
    }
    int around = -1;  // itself
    grid.around(marks.all[i].middle, kPitches * pitch[i], [&](int) { return ++around >= kFewestAround; });
    isWithin[i] = pitch[i] > 0.0 && around >= kFewestAround;
  }
  std::vector<bool> isOne = isWithin;
  for (int i = 0; i < count; ++i) {
    if (!isWithin[i]) continue;
    grid.around(marks.all[i].middle, kPitches * pitch[i], [&](int mark) {
      isOne[mark] = true;
      return false;
    });
  }
  return isOne;
}

// A row drawn by hand bends and its dots are uneven: marks ahead of a member of a row, or between two, are of it too,
// and what follows them if they have a neighbour in the same direction themselves. @return by mark, whether it is of a
// row.
std::vector<bool> grownRows(std::vector<bool> isOfRow, const Marks& marks,
                            const std::vector<std::optional<RowMember>>& members, const std::vector<bool>& isLattice,
                            int width) {
  constexpr double kSizesAlike = 4.0;  // areas, of which a raster makes much where they are small
  constexpr double kAheadCos = 0.866;  // 30 degrees beside the row
  const MarkGrid grid(marks, width);
  const auto isAhead = [&](int mark, const Vec2& way) {
    return std::abs(way.dot(unitOf(members[mark]->direction))) >= kAheadCos * way.norm();
  };
  std::vector<int> next;
  for (int i = 0; i < std::ssize(isOfRow); ++i)
    if (isOfRow[i]) next.push_back(i);
  while (!next.empty()) {
    const int at = next.back();
    next.pop_back();
    if (!members[at]) continue;
    const auto area = static_cast<double>(marks.all[at].pixels.size());
    const double reachPx = kMostMarkGap * kLeastLengthWidths * std::sqrt(area);
    grid.around(marks.all[at].middle, reachPx, [&](int mark) {
      if (isOfRow[mark] || isLattice[mark]) return false;
      const auto other = static_cast<double>(marks.all[mark].pixels.size());
      const Vec2 way = marks.all[mark].middle - marks.all[at].middle;
      if (std::max(area, other) > kSizesAlike * std::min(area, other) || !isAhead(at, way)) return false;
      isOfRow[mark] = true;
      if (members[mark] && isAhead(mark, way)) next.push_back(mark);
      return false;
    });
  }
  return isOfRow;
}

bool areAlike(int a, int b) {
  const int step = std::abs(a - b);
  return std::min(step, kDirections - step) <= kDirectionsAlike;
}

}  // namespace

BitImage marksInRows(const BitImage& marks, const BitImage& ink, const RunContext& context) {
  BitImage kept(ink.width, ink.height);
  const RunPieces pieces = findPieces(marks, Connectivity::Eight, context);
  if (pieces.runs.empty() || context.isCancelled()) return kept;
  const Marks found = marksOf(pieces);
  const int count = static_cast<int>(found.all.size());
  std::vector<std::optional<RowMember>> members(count);
  const RowSearch search(pieces, found, ink);
  parallelFor(context, count, kMarksPerLook, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) members[i] = search.memberOf(i);
  });
  const std::vector<bool> isLattice = findLattices(found, members, ink.width);
  for (int i = 0; i < count; ++i)
    if (isLattice[i]) members[i].reset();
  // Neighbours that lie in one direction are of one row; the last of it has been met by the one before it.
  DisjointSets rows(count);
  std::vector<int> ends(count, 0);
  std::vector<bool> isMember(count, false);
  for (int i = 0; i < count; ++i) {
    if (!members[i] || !members[i]->hasBoth()) continue;
    isMember[i] = true;
    for (const auto& side : members[i]->side) {
      if (!side->mark) {
        ++ends[i];
        continue;
      }
      const std::optional<RowMember>& other = members[*side->mark];
      if (!other || !areAlike(other->direction, members[i]->direction)) continue;
      isMember[*side->mark] = true;
      rows.join(i, *side->mark);
    }
  }
  std::vector<int> size(count, 0);
  for (int i = 0; i < count; ++i)
    if (isMember[i]) size[rows.root(i)] += 1 + ends[i];
  for (int i = 0; i < count; ++i) isMember[i] = isMember[i] && size[rows.root(i)] >= kLeastMembers;
  isMember = grownRows(std::move(isMember), found, members, isLattice, ink.width);
  for (std::size_t r = 0; r < pieces.runs.size(); ++r) {
    const std::optional<int> mark = found.ofPiece[pieces.piece[r]];
    if (mark && isMember[*mark]) setBits(kept, pieces.runs[r]);
  }
  return kept;
}

}  // namespace batten
