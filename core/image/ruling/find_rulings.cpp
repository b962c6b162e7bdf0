// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/find_rulings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/plane.h"
#include "core/image/ruling/margin_lines.h"
#include "core/image/ruling/printed_lines.h"
#include "core/image/ruling/ruling_ink.h"
#include "core/image/ruling/ruling_lattice.h"

namespace batten {
namespace {

constexpr int kHidden = 3;                             // lines beyond the seen ones, where ink may hide them
constexpr std::int64_t kLargestLatticePx = 4'000'000;  // [px] of the shrunk page: bounds the time
constexpr int kStationPx = 16;                         // [px] between the points of a course
// Of the columns of a strip. Printed lines go on, unlike grain and most hatching; where few of them do, all count.
constexpr std::array<double, 2> kLeastInked = {0.7, 0.0};
constexpr std::size_t kMostMargins = 2;    // more straight lines are no margins but drawn
constexpr double kMostMisfit = 0.75;       // [grid] drawn lines are less even
constexpr double kMostMisfitShare = 0.02;  // of the spacing; likewise: crumpled paper bends print by less
constexpr double kLeastLineSeen = 0.8,
                 kLeastLineSeenAlone = 0.7;             // of the lines; the latter where hardly any others are
constexpr double kLeastCoverage = 0.7;                  // of the stretches of the lines that are seen
constexpr double kAlone = 0.4, kLeastSelective = 0.25;  // of the thin lines over the ruling that belong to it
constexpr double kLeastInk = 0.8;                       // of the length of the lines: they go on
constexpr double kLeastInkOfBroken = 0.65;              // likewise, of lines that copying has broken
constexpr double kLeastAlong = 0.35;                    // of the contrast beside a line: so much lasts along it
constexpr double kMostBetween = 0.5;                    // of the depth of dark lines, of what lies between two of them
constexpr double kBetweenPx = 3.0;                      // [grid] between two lines, and as much to either side
constexpr int kLeastRun = 3;                            // strips of a page that lies beside others
constexpr double kMostlyInked = 0.5;                    // of the lines, in a column they run through
constexpr double kMarginWidths = 2.5;                   // of the ruled lines: a margin is hardly wider
constexpr double kEdgeShare = 0.1;                      // of a lattice: there lines have the direction they end with
constexpr double kMostWidth = 0.3;                      // of the spacing
constexpr double kLeastRulingDepth = 0.015;             // of a ruling, below its paper

Plane mirrored(const Plane& in, const RunContext& context) {
  constexpr int kRows = 32;  // one part of the work of the threads
  Plane out(in.height, in.width);
  parallelFor(context, out.height, kRows, [&](int begin, int end) {
    PlaneView{in, true}.copyRows(begin, end, out.row(begin));
  });
  return out;
}

/// Width at half depth and depth of a lattice's lines, each the median over places on lines that are seen.
LineLook lookOf(const Plane& grey, const RulingLattice& lattice) {
  constexpr int kPlaces = 41;  // along a line, for medians
  const int reach = std::max(2, static_cast<int>(0.5 * lattice.spacing));
  std::vector<double> widths, depths;
  for (std::size_t i = 0; i < lattice.isSeen.size(); ++i) {
    if (!lattice.isSeen[i]) continue;
    for (int p = 0; p < kPlaces; ++p) {
      const double x = lattice.fromX + (p + 0.5) / kPlaces * (lattice.toX() - lattice.fromX);
      const int column = static_cast<int>(x),
                row = static_cast<int>(lattice.at(lattice.first + static_cast<double>(i), x));
      if (row < reach || row + reach >= grey.height) continue;
      float paper = 0.0f;
      int darkest = row;
      for (int y = row - reach; y <= row + reach; ++y) paper = std::max(paper, grey.row(y)[column]);
      for (int y = row - 1; y <= row + 1; ++y) {
        if (grey.row(y)[column] < grey.row(darkest)[column]) darkest = y;
      }
      const float depth = paper - grey.row(darkest)[column], half = paper - 0.5f * depth;
      int from = darkest, to = darkest;
      while (from > row - reach && grey.row(from - 1)[column] < half) --from;
      while (to < row + reach && grey.row(to + 1)[column] < half) ++to;
      widths.push_back(to - from + 1);
      depths.push_back(static_cast<double>(depth / std::max(1.0f, paper)));
    }
  }
  if (widths.empty()) return {};
  return {static_cast<double>(upperMedian(widths)), static_cast<double>(upperMedian(depths))};
}

std::optional<FoundLattice> judged(const Plane& grey, RulingLattice lattice, const RunContext& context) {
  FoundLattice found{std::move(lattice), {}, 0, grey.width};
  const RulingLattice& l = found.lattice;
  found.look = lookOf(grey, l);
  const bool isEven = l.misfit <= std::max(kMostMisfit, kMostMisfitShare * l.spacing);
  const bool isThin = found.look.width <= std::max(2.0, kMostWidth * l.spacing);
  if (!isEven || !isThin || found.look.depth < kLeastRulingDepth) return std::nullopt;
  if (l.seen < (l.selective >= kAlone ? kLeastLineSeenAlone : kLeastLineSeen) || l.coverage < kLeastCoverage ||
      l.selective < kLeastSelective)
    return std::nullopt;
  // Letters, dots or crossings in rows.
  const double ink = inkAlongLines(grey, l, context);
  if (ink < kLeastInkOfBroken) return std::nullopt;
  if (ink < kLeastInk && (found.look.depth <= kDarkRuling || !areUnderTheDrawing(grey, found))) return std::nullopt;
  const LatticeContrast contrast = contrastOf(grey, l);
  if (contrast.along < kLeastAlong) return std::nullopt;
  // As dark lines between them: every other line of a hatching that is too fine for a ruling.
  const bool isApart = l.spacing > 2.0 * found.look.width + kBetweenPx;
  if (found.look.depth > kDarkRuling && isApart && contrast.between > kMostBetween) return std::nullopt;
  return found;
}

/// A lattice of the lines along x of a plane, if it is a ruling. `isHopeful` becomes true where there is one at all.
/// @param planeOf makes the plane, which is needed only there.
template <class PlaneOf>
std::optional<FoundLattice> latticeOf(const RulingStretches& found, PlaneOf& planeOf, bool& isHopeful,
                                      const RunContext& context) {
  for (const double share : kLeastInked) {
    if (context.isCancelled()) break;
    auto lattice = findRulingLattice(found.inkedAtLeast(share), context);
    if (!lattice) continue;
    isHopeful = true;
    if (auto passed = judged(planeOf(), std::move(*lattice), context)) return passed;
  }
  return std::nullopt;
}

/// The ruling of the lines along x of a plane, or those of the pages side by side on it: each in strips of its own, in
/// most of them together.
template <class PlaneOf>
std::vector<FoundLattice> latticesOf(const RulingStretches& found, PlaneOf planeOf, const RunContext& context) {
  bool isHopeful = false;
  std::vector<FoundLattice> lattices;
  if (auto whole = latticeOf(found, planeOf, isHopeful, context)) lattices.push_back(std::move(*whole));
  if (!lattices.empty() || !isHopeful) return lattices;
  const int strips = static_cast<int>(found.strips.size());
  std::vector<bool> isTaken(strips, false);
  for (int count = strips - 1; count >= kLeastRun; --count) {
    for (int first = 0; first + count <= strips; ++first) {
      if (context.isCancelled()) return {};
      const auto end = isTaken.begin() + first + count;
      if (std::find(isTaken.begin() + first, end, true) != end) continue;
      auto part = latticeOf(found.inStrips(first, count), planeOf, isHopeful, context);
      if (!part || (part->look.depth > kDarkRuling && !areUnderTheDrawing(planeOf(), *part))) continue;
      std::fill_n(isTaken.begin() + first, count, true);
      lattices.push_back(std::move(*part));
    }
  }
  if (static_cast<double>(std::ranges::count(isTaken, true)) < kLeastCoverage * strips) lattices.clear();
  return lattices;
}

/// Where a line runs. Those farther than kHidden from the seen ones follow the outermost of them at the distance that
/// it has there from its neighbour: the lattice's own bends say nothing so far beyond it.
double lineAt(const RulingLattice& lattice, double k, double x) {
  const double known =
      std::clamp(k, static_cast<double>(lattice.first - kHidden), static_cast<double>(lattice.last + kHidden));
  if (known == k || lattice.first == lattice.last) return lattice.at(k, x);
  const double inside = k < known ? known + 1.0 : known - 1.0, at = lattice.at(known, x);
  return at + std::abs(k - known) * (at - lattice.at(inside, x));
}

/// The same, also beyond the ends of its lattice: straight on.
double courseAt(const RulingLattice& lattice, double k, double x) {
  const double edge = std::clamp(x, lattice.fromX, lattice.toX());
  if (edge == x) return lineAt(lattice, k, x);
  const double within = kEdgeShare * (lattice.toX() - lattice.fromX) * (x < edge ? 1.0 : -1.0);
  const double here = lineAt(lattice, k, edge);
  return here + (lineAt(lattice, k, edge + within) - here) / within * (x - edge);
}

/// Share of the seen lines that hold ink in a column.
double shareInked(const Plane& grey, const FoundLattice& found, int x) {
  const RulingLattice& l = found.lattice;
  const int half = std::max(2, static_cast<int>(0.5 * l.spacing));
  int seen = 0, inked = 0;
  for (std::size_t i = 0; i < l.isSeen.size(); ++i) {
    const auto middle = static_cast<int>(courseAt(l, l.first + static_cast<double>(i), x + 0.5));
    if (!l.isSeen[i] || middle - half < 0 || middle + half >= grey.height) continue;
    std::vector<float> levels;
    for (int y = middle - half; y <= middle + half; ++y) levels.push_back(grey.row(y)[x]);
    const float darkest = std::min({levels[half - 1], levels[half], levels[half + 1]});
    ++seen;
    inked += static_cast<double>(darkest) < (1.0 - 0.5 * found.look.depth) * static_cast<double>(upperMedian(levels));
  }
  return seen > 0 ? inked / static_cast<double>(seen) : 0.0;
}

/// Where the lines of a part of the page end, sought from the last of its strips towards its border or the next part.
int endOf(const Plane& grey, const FoundLattice& found, int from, int limit) {
  const int direction = limit < from ? -1 : 1;
  double sum = 0.0, best = 0.0;
  int end = from;
  for (int x = from; x != limit; x += direction) {
    sum += shareInked(grey, found, direction > 0 ? x : x - 1) - kMostlyInked;
    if (sum <= best) continue;
    best = sum;
    end = x + direction;
  }
  return end;
}

RulingFamily familyOf(const FoundLattice& found, const Plane& grey, bool runsDown, int shrink) {
  const RulingLattice& lattice = found.lattice;
  RulingFamily family;
  family.runsDown = runsDown;
  family.spacingPx = lattice.spacing * shrink;
  family.widthPx = found.look.width * shrink;
  family.depth = found.look.depth;
  // Lines go on to the borders of the page, where they may be hidden. Of a rotated page many cross no more than a
  // corner, too little to be seen as lines.
  constexpr int kPlacesAcross = 8;
  const double least = -1.0, most = grey.height + 1.0;
  const auto placesOnPage = [&](int k) {
    int count = 0;
    for (int i = 0; i <= kPlacesAcross; ++i) {
      const double y = lineAt(lattice, k, lattice.fromX + i * (lattice.toX() - lattice.fromX) / kPlacesAcross);
      if (y > least && y < most) ++count;
    }
    return count;
  };
  int first = lattice.first, last = lattice.last;
  const auto continues = [&](int k, int beyond) {
    const int places = first < last ? placesOnPage(k) : 0;  // a margin has no neighbours
    return places > 0 && (beyond <= kHidden || 2 * places <= kPlacesAcross);
  };
  while (continues(first - 1, lattice.first - first + 1)) --first;
  while (continues(last + 1, last + 1 - lattice.last)) ++last;
  const double from = static_cast<double>(found.fromX) * shrink,
               length = static_cast<double>(found.toX) * shrink - from;
  const int stations = static_cast<int>(std::ceil(length / kStationPx)) + 1;
  for (int k = first; k <= last; ++k) {
    RulingLine line;
    for (int i = 0; i < stations; ++i) {
      const double x = from + std::min(length, static_cast<double>(i) * kStationPx);
      const double y = courseAt(lattice, k, x / shrink) * shrink;
      line.coursePx.push_back(runsDown ? Vec2(y, x) : Vec2(x, y));
    }
    family.lines.push_back(std::move(line));
  }
  return family;
}

/// The lines of the lattices of one direction. Those of a part of the page end where their ink does.
void addFamilies(std::vector<FoundLattice>& lattices, const Plane& grey, bool runsDown, bool isGrid, int shrink,
                 std::vector<RulingFamily>& families) {
  std::ranges::sort(lattices, {}, [](const FoundLattice& found) { return found.lattice.fromX; });
  for (std::size_t i = 0; i < lattices.size(); ++i) {
    FoundLattice& found = lattices[i];
    if (!isPrinted(grey, found, isGrid)) continue;
    const auto columnOf = [&](double x) { return std::clamp(static_cast<int>(std::lround(x)), 0, grey.width); };
    const int before = i == 0 ? 0 : columnOf(lattices[i - 1].lattice.toX());
    const int after = i + 1 == lattices.size() ? grey.width : columnOf(lattices[i + 1].lattice.fromX);
    // Those of a copy fade, one here and one there.
    const bool isBroken = found.look.depth > kDarkRuling && !isGrid;
    found.fromX = isBroken ? before : endOf(grey, found, columnOf(found.lattice.fromX), before);
    found.toX = isBroken ? after : endOf(grey, found, columnOf(found.lattice.toX()), after);
    families.push_back(familyOf(found, grey, runsDown, shrink));
    families.back().isBroken = isBroken;
  }
}

/// A line across ruled ones that is their margin: thin, whole, from border to border, and no darker than a ruling.
std::optional<FoundLattice> judgedMargin(const Plane& along, const RulingLattice& line, const LineLook& ruling,
                                         const RunContext& context) {
  FoundLattice found{line, lookOf(along, line), 0, along.width};
  const LineLook& look = found.look;
  if (look.width > std::max(2.0, kMostWidth * line.spacing) || look.depth < kLeastRulingDepth) return std::nullopt;
  if (look.width > kMarginWidths * std::max(ruling.width, 2.0)) return std::nullopt;  // the gutter of a book
  if (look.depth > std::max(kDarkRuling, ruling.depth)) return std::nullopt;          // drawn with a pen
  if (inkAlongLines(along, line, context) < kLeastInk) return std::nullopt;
  return found;
}

}  // namespace

std::vector<RulingFamily> findRulings(const GreyImage& image, const RunContext& context) {
  int shrink = 1;
  while (static_cast<std::int64_t>(image.width / shrink) * (image.height / shrink) > kLargestLatticePx) ++shrink;
  const Plane across = shrinkGrey(image, shrink, context);
  if (context.isCancelled()) return {};
  const RulingStretches ofRows = findRulingStretches({across, false}, context);
  std::vector<FoundLattice> rows = latticesOf(
      ofRows, [&]() -> const Plane& { return across; }, context);
  if (context.isCancelled()) return {};
  Plane down;  // few pages have lines that run down, and only they need it
  const RulingStretches ofColumns = findRulingStretches({across, true}, context);
  std::vector<FoundLattice> columns = latticesOf(
      ofColumns,
      [&]() -> const Plane& {
        if (down.width == 0) down = mirrored(across, context);
        return down;
      },
      context);
  std::vector<RulingFamily> families;
  if (context.isCancelled()) return families;
  addFamilies(rows, across, false, !columns.empty(), shrink, families);
  addFamilies(columns, down, true, !rows.empty(), shrink, families);
  if (families.size() == 1) {
    const bool runsDown = families.front().runsDown;
    const LineLook ruling{families.front().widthPx / shrink, families.front().depth};
    const auto lines = findMarginLines({across, !runsDown}, runsDown ? ofRows : ofColumns,
                                       (runsDown ? columns : rows).front().lattice, context);
    if (!lines.empty() && !runsDown && down.width == 0) down = mirrored(across, context);
    const Plane& along = runsDown ? across : down;
    std::vector<RulingFamily> margins;
    for (const RulingLattice& line : lines) {
      if (auto margin = judgedMargin(along, line, ruling, context))
        margins.push_back(familyOf(*margin, along, !runsDown, shrink));
    }
    if (margins.size() <= kMostMargins) std::ranges::move(margins, std::back_inserter(families));
  }
  if (context.isCancelled()) families.clear();
  return families;
}

}  // namespace batten
