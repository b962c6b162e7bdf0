// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/blank_margins.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr int kBlankUnits = 2 * 257;    // [1/257 grey] by which a margin may differ from its value
constexpr double kLeastMargin = 0.01;   // of the picture's side: a narrower one is a rim
constexpr double kLeastPasted = 0.1;    // of the picture
constexpr int kRipplePx = 12;           // JPEG leaves ripples as far beside an edge
constexpr int kStraightPx = 1;          // by which the edge may be off its line: scaled, blurred
constexpr double kLeastStraight = 0.9;  // of its length: a shape that somebody drew ends less straight
constexpr double kLeastUneven = 0.2;    // of pixels differ from the one beside them: programs fill with equal ones
constexpr double kMostBlank = 0.25;     // of the pixels inside: more, and a frame was drawn on the page
constexpr int kRowStep = 7;             // of the rows that are looked at for that

struct Range {
  int begin = 0, end = 0;
  int size() const { return end - begin; }
};

/// The lines of a picture that run along one of its sides, the outermost first.
struct SideLines {
  const GreyImage& page;
  bool down = false, fromEnd = false;  ///< Columns; from the right or from below.
  int count() const { return down ? page.width : page.height; }
  int at(int line, int i) const {
    const int k = fromEnd ? count() - 1 - line : line;
    return down ? page.row(i)[k] : page.row(k)[i];
  }
};

/// How many lines have one value.
int blankLines(const SideLines& lines, const Range& along, int value) {
  const auto isBlank = [&](int line) {
    for (int i = along.begin; i < along.end; ++i)
      if (std::abs(lines.at(line, i) - value) > kBlankUnits) return false;
    return true;
  };
  int line = 0;
  while (line < lines.count() && isBlank(line)) ++line;
  return line;
}

/// The columns that have another value somewhere in these rows. Row by row: a page lies so in memory.
Range columnsWithin(const GreyImage& page, const Range& rows, int value) {
  Range columns{page.width, 0};
  for (int y = rows.begin; y < rows.end; ++y) {
    const std::uint16_t* row = page.row(y);
    int first = 0, last = page.width;
    while (first < columns.begin && std::abs(row[first] - value) <= kBlankUnits) ++first;
    while (last > columns.end && std::abs(row[last - 1] - value) <= kBlankUnits) --last;
    columns = {first, last};
  }
  return columns;
}

/// The line at which the picture begins beside a margin. Absent: not at a straight edge.
std::optional<int> straightEdge(const SideLines& lines, int margin, const Range& along, int value) {
  const int last = std::min(margin + 2 * kRipplePx, lines.count()) - 1;
  if (margin < kLeastMargin * lines.count() || along.size() <= 2 * kRipplePx) return std::nullopt;
  std::vector<int> beyond, edges;
  for (int i = along.begin + kRipplePx; i < along.end - kRipplePx; ++i)
    beyond.push_back(std::abs(lines.at(last, i) - value));
  const int apart = upperMedian(beyond);
  if (apart <= kBlankUnits) return std::nullopt;  // paper as on the page: a frame that was drawn
  const int half = std::max(kBlankUnits, apart / 2);
  for (int i = along.begin + kRipplePx; i < along.end - kRipplePx; ++i) {
    int line = margin;
    while (line < last && std::abs(lines.at(line, i) - value) <= half) ++line;
    edges.push_back(line);
  }
  const int edge = upperMedian(edges);
  const auto straight = std::ranges::count_if(edges, [&](int at) { return std::abs(at - edge) <= kStraightPx; });
  if (edge > margin + kRipplePx || static_cast<double>(straight) < kLeastStraight * std::ssize(edges))
    return std::nullopt;
  return edge;
}

/// Whether a part is scanned paper: hardly anywhere of the page's value, and with grain.
bool isScanned(const GreyImage& page, const Range& columns, const Range& rows, int value) {
  std::int64_t all = 0, unlike = 0, blank = 0;
  for (int y = rows.begin; y < rows.end; y += kRowStep) {
    for (int x = columns.begin + 1; x < columns.end; ++x) {
      unlike += page.row(y)[x] != page.row(y)[x - 1] ? 1 : 0;
      blank += std::abs(page.row(y)[x] - value) <= kBlankUnits ? 1 : 0;
    }
    all += columns.size() - 1;
  }
  return static_cast<double>(unlike) >= kLeastUneven * static_cast<double>(all) &&
         static_cast<double>(blank) <= kMostBlank * static_cast<double>(all);
}

}  // namespace

std::optional<PaperSheet> sheetWithinMargins(const GreyImage& page) {
  if (page.isUniform || page.width < 1 || page.height < 1) return std::nullopt;
  const int value = page.row(0)[0];
  const SideLines top{page, false, false}, bottom{page, false, true}, left{page, true, false}, right{page, true, true};
  const Range wide{0, page.width};
  Range rows{blankLines(top, wide, value), 0};
  if (rows.begin == page.height) return std::nullopt;
  rows.end = page.height - blankLines(bottom, wide, value);
  Range columns = columnsWithin(page, rows, value);
  if (columns.size() == page.width && rows.size() == page.height) return std::nullopt;
  if (std::min(columns.size(), rows.size()) <= 4 * kRipplePx) return std::nullopt;
  if (1.0 * columns.size() * rows.size() < kLeastPasted * page.width * page.height) return std::nullopt;
  const auto edgeOf = [&](const SideLines& lines, int margin, const Range& along) {
    return margin > 0 ? straightEdge(lines, margin, along, value) : std::optional(0);
  };
  const auto x0 = edgeOf(left, columns.begin, rows), x1 = edgeOf(right, page.width - columns.end, rows);
  const auto y0 = edgeOf(top, rows.begin, columns), y1 = edgeOf(bottom, page.height - rows.end, columns);
  if (!x0 || !x1 || !y0 || !y1) return std::nullopt;
  columns = {*x0, page.width - *x1}, rows = {*y0, page.height - *y1};
  if (!isScanned(page, columns, rows, value)) return std::nullopt;
  PaperSheet sheet = sheetWithinRim(page.width, page.height, {columns.begin, rows.begin, columns.size(), rows.size()});
  const double cells = 1.0 * sheet.inside.width * sheet.inside.height;
  sheet.outsideShare = 1.0 - static_cast<double>(sheet.inside.count()) / cells;
  return sheet;
}

}  // namespace batten
