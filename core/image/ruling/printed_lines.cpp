// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/printed_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "core/base/statistics.h"
#include "core/image/ruling/find_rulings.h"

namespace batten {
namespace {

constexpr double kDarkCoverage = 0.85;  // asked of dark lines that make no grid
constexpr int kDarkLines = 12;          // likewise
constexpr int kBorder = 4;              // [grid] so near to it a line runs to the border of the page
constexpr double kLeastAtBorder = 0.5;  // of the lines that run to the border of the page
constexpr double kJoined = 0.9;         // of the spaces between lines that a stroke crosses
constexpr double kHandEvenness = 0.02;  // of the spacing: a hand with a ruler sets lines no more evenly
constexpr double kLeastMisfit = 0.1;    // [grid] places are not known better
constexpr int kFreeLines = 4;           // a lattice's place, spacing and two bends go through so many whatever they are
constexpr double kLeastEvidence = 6.9;  // logarithm of 1000 to 1 that no hand drew them
constexpr double kPenWidths = 1.5;      // of a line: strokes are at least so wide
constexpr int kColumnStep = 3;          // [grid] between the columns that are looked at
constexpr int kMostRun = 60;            // [grid] of ink: longer runs are shapes
constexpr double kBesideLine = 3.0;     // [grid] beyond the line's rim: what is there is not the line
constexpr int kShallowest = 2;          // [px along / px across] of the strokes that are looked for
constexpr double kLeastCrossed = 0.5;   // of the lines, by strokes
constexpr double kLeastInkBetween = 0.002;  // of the places between lines: with less ink there is no drawing over them
// Between two lines, of their distance.
constexpr std::array<double, 5> kBetween{0.2, 0.35, 0.5, 0.65, 0.8};

/// Share of the seen lines that hold ink at a side of the page.
double shareOfLinesAtBorder(const Plane& grey, const FoundLattice& found, bool isLeft) {
  const RulingLattice& l = found.lattice;
  const int first = isLeft ? 0 : std::max(0, grey.width - kBorder), past = std::min(grey.width, first + kBorder);
  const int half = std::max(2, static_cast<int>(0.5 * l.spacing));
  int seen = 0, inked = 0;
  for (std::size_t i = 0; i < l.isSeen.size(); ++i) {
    if (!l.isSeen[i]) continue;
    float darkest = std::numeric_limits<float>::max(), paper = 0.0f;
    for (int x = first; x < past; ++x) {
      const int middle = static_cast<int>(l.at(l.first + static_cast<double>(i), x + 0.5));
      for (int y = std::max(0, middle - half); y <= std::min(grey.height - 1, middle + half); ++y) {
        paper = std::max(paper, grey.row(y)[x]);
        if (std::abs(y - middle) <= 1) darkest = std::min(darkest, grey.row(y)[x]);
      }
    }
    ++seen;
    inked += static_cast<double>(darkest) < (1.0 - 0.5 * found.look.depth) * static_cast<double>(paper) ? 1 : 0;
  }
  return seen > 0 ? inked / static_cast<double>(seen) : 0.0;
}

/// The largest share of the spaces between lines that one straight stroke square to them crosses.
double shareJoined(const Plane& grey, const FoundLattice& found) {
  const RulingLattice& l = found.lattice;
  const int spaces = static_cast<int>(l.isSeen.size()) - 1;
  std::vector<int> crossed(grey.width, 0);
  for (int i = 0; i < spaces; ++i) {
    const auto rowAt = [&](int x) { return static_cast<int>(l.at(l.first + i + 0.5, x + 0.5)); };
    float paper = 0.0f;
    for (int x = 0; x < grey.width; ++x) {
      const int y = rowAt(x);
      if (y >= 0 && y < grey.height) paper = std::max(paper, grey.row(y)[x]);
    }
    for (int x = 0; x < grey.width; ++x) {
      const int y = rowAt(x);
      if (y < 0 || y >= grey.height) continue;
      crossed[x] += static_cast<double>(grey.row(y)[x]) < (1.0 - 0.5 * found.look.depth) * static_cast<double>(paper);
    }
  }
  return spaces > 0 ? *std::max_element(crossed.begin(), crossed.end()) / static_cast<double>(spaces) : 0.0;
}

/// Lines that end on the page and are joined by a stroke across: the teeth of a comb. Ruled lines run to the border of
/// the page, whatever crosses them, or stand by themselves.
bool isComb(const Plane& grey, const FoundLattice& found) {
  const double border = std::min(shareOfLinesAtBorder(grey, found, true), shareOfLinesAtBorder(grey, found, false));
  return border < kLeastAtBorder && shareJoined(grey, found) >= kJoined;
}

/// How much less likely a hand would have set the lines so evenly than a press, as a logarithm.
double evidenceOf(const RulingLattice& lattice) {
  const auto seen = static_cast<double>(std::ranges::count(lattice.isSeen, true)), free = seen - kFreeLines;
  if (free <= 0.0) return 0.0;
  const double misfit = std::max(kLeastMisfit, lattice.misfit) * std::sqrt(seen / free);
  return free * std::log(kHandEvenness * lattice.spacing / misfit);
}

/// Ink of the page about one line, darker than half of what its lines take from the paper.
class InkAboutLine {
 public:
  InkAboutLine(const Plane& grey, const FoundLattice& found, int line) : grey_(grey), lattice_(found.lattice) {
    number_ = lattice_.first + line;
    float paper = 0.0f;
    for (int x = found.fromX; x < found.toX; ++x) {
      const int y = rowAt(x, 0.5);
      if (y >= 0 && y < grey.height) paper = std::max(paper, grey.row(y)[x]);
    }
    limit_ = static_cast<float>(1.0 - 0.5 * found.look.depth) * paper;
  }

  /// Row of a place that is so many spacings below the line.
  int rowAt(int x, double below) const { return static_cast<int>(std::floor(lattice_.at(number_ + below, x + 0.5))); }
  bool isInk(int x, int y) const {
    return x >= 0 && x < grey_.width && y >= 0 && y < grey_.height && grey_.row(y)[x] < limit_;
  }
  /// [grid] Length of the ink through a place, to both sides along x, or along y.
  int runThrough(int x, int y, bool isAlongX) const {
    int length = 1;
    for (const int side : {-1, 1}) {
      int i = side;
      while (std::abs(i) <= kMostRun && (isAlongX ? isInk(x + i, y) : isInk(x, y + i))) i += side;
      length += std::abs(i) - 1;
    }
    return length;
  }
  /// Row of ink on the line; -1 for none.
  int inkOnLine(int x) const {
    for (const int off : {0, -1, 1}) {
      if (const int y = rowAt(x, 0.0) + off; isInk(x, y)) return y;
    }
    return -1;
  }

 private:
  const Plane& grey_;
  const RulingLattice& lattice_;
  double number_ = 0.0;
  float limit_ = 0.0f;
};

/// Widths [grid] of the ink on the lines, and of what lies between them.
struct InkWidths {
  std::vector<int> ofLines, ofStrokes;
  std::ptrdiff_t places = 0;  ///< Between the lines.
};

InkWidths inkWidths(const Plane& grey, const FoundLattice& found) {
  InkWidths widths;
  const RulingLattice& l = found.lattice;
  for (int i = 0; i < std::ssize(l.isSeen); ++i) {
    if (!l.isSeen[i]) continue;
    const InkAboutLine ink(grey, found, i);
    for (int x = found.fromX; x < found.toX; x += kColumnStep) {
      if (const int y = ink.inkOnLine(x); y >= 0) widths.ofLines.push_back(ink.runThrough(x, y, false));
      for (const double between : kBetween) {
        ++widths.places;
        if (const int y = ink.rowAt(x, between); ink.isInk(x, y))
          widths.ofStrokes.push_back(std::min(ink.runThrough(x, y, false), ink.runThrough(x, y, true)));
      }
    }
  }
  return widths;
}

/// Whether a straight stroke of any slope goes through a place on a line: ink so far above and below it.
bool isCrossed(const InkAboutLine& ink, int x, int y, int away) {
  for (int shift = -kShallowest * away; shift <= kShallowest * away; shift += std::max(1, away / 2))
    if (ink.isInk(x - shift, y - away) && ink.isInk(x + shift, y + away)) return true;
  return false;
}

/// Share of the seen lines that a stroke crosses.
double shareCrossed(const Plane& grey, const FoundLattice& found, double widthOfLines) {
  const int away = static_cast<int>(std::ceil(0.5 * widthOfLines + kBesideLine));
  int seen = 0, crossed = 0;
  for (int i = 0; i < std::ssize(found.lattice.isSeen); ++i) {
    if (!found.lattice.isSeen[i]) continue;
    ++seen;
    const InkAboutLine ink(grey, found, i);
    for (int x = found.fromX; x < found.toX; ++x) {
      const int y = ink.inkOnLine(x);
      if (y < 0 || !isCrossed(ink, x, y, away)) continue;
      ++crossed;
      break;
    }
  }
  return seen > 0 ? crossed / static_cast<double>(seen) : 0.0;
}

}  // namespace

bool areUnderTheDrawing(const Plane& grey, const FoundLattice& found) {
  if (evidenceOf(found.lattice) < kLeastEvidence || isComb(grey, found)) return false;
  InkWidths widths = inkWidths(grey, found);
  if (widths.ofLines.empty() || widths.ofStrokes.empty() ||
      static_cast<double>(std::ssize(widths.ofStrokes)) < kLeastInkBetween * static_cast<double>(widths.places))
    return false;
  // Where a stroke runs into a line its ink is longer.
  constexpr double kThinRank = 0.25;
  const double ofLines = lowerQuantile(widths.ofLines, kThinRank), ofStrokes = upperMedian(widths.ofStrokes);
  return ofStrokes >= kPenWidths * ofLines && shareCrossed(grey, found, ofLines) >= kLeastCrossed;
}

bool isPrinted(const Plane& grey, const FoundLattice& found, bool isGrid) {
  if (found.look.depth <= kDarkRuling || isGrid) return true;
  const bool fillThePage = found.lattice.coverage >= kDarkCoverage && std::ssize(found.lattice.isSeen) >= kDarkLines;
  return fillThePage ? !isComb(grey, found) : areUnderTheDrawing(grey, found);
}

}  // namespace batten
