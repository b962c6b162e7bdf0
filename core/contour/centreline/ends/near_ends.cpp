// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/ends/near_ends.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/statistics.h"
#include "core/contour/centreline/ends/line_ends.h"

namespace batten {
namespace {

// [stroke widths] of paper: letters stand no nearer, and a pencil fades before it is lifted.
constexpr double kPenPaper = 0.75, kPencilPaper = 2.0;
constexpr double kAimWidths = 3.0, kLeastAimPx = 6.0;  // of a line before its end, that point on
constexpr double kFewestWidths = 20.0;                 // of a line that is led on: letters stay apart
constexpr double kMostOfLine = 0.1;                    // of its length that a line is led on
constexpr double kMeetSin = 0.5;                       // 30 degrees: at less a line runs beside the other
constexpr double kAimStepPx = 0.5;                     // along the way
constexpr double kCellPx = 4.0;                        // of the lines around: more than a step and one between points
constexpr double kOwnLineWidths = 3.0;                 // along a line from its own end
constexpr double kLeastWayPx = 0.3;                    // an end as near is there

struct NearEnd {
  int line = 0, side = 0;
  Vec2 at = Vec2::Zero(), out = Vec2::Zero();
  double widthPx = 1.0, paperPx = 0.0, mostPx = 0.0;  // [px] of paper at most; of the way in all
  std::optional<double> toLine = {};                  // [px] from `at` along `out`
  std::optional<int> partner = {};                    // the end that it meets at the least way
  double toPartner = 0.0, bothWays = 0.0;
};

double medianWidthOf(const Contour& c) {
  std::vector<float> widths = strokeWidthsOf(c.points);
  return widths.empty() ? 1.0 : std::max(1.0, static_cast<double>(upperMedian(widths)));
}

std::optional<NearEnd> endOf(const Contour& c, int side, double width, double longestWidths) {
  if (c.points.size() < 3 || c.lengthPx < kFewestWidths * width) return std::nullopt;
  const ContourPoint& last = pointFromEnd(c, side, 0);
  const LocalQuadratic fit = fitBeforeEnd(c, side, 0, std::max(kLeastAimPx, kAimWidths * width), 1, 0.0);
  if (fit.order.value_or(0) < 1 || !(fit.r1.norm() > 0.0)) return std::nullopt;
  // What was drawn with a pencil has no standard deviation (ContourPoint::sigmaPx).
  const double paper = last.sigmaPx ? kPenPaper : kPencilPaper;
  NearEnd end;
  end.side = side;
  end.at = last.at;
  end.out = fit.r1.normalized();
  end.widthPx = width;
  end.paperPx = std::min(paper, longestWidths) * width;
  end.mostPx = kMostOfLine * c.lengthPx;
  return end;
}

// Whether no more of the way is paper than may be. An end may lie half a width within its ink, or at its edge.
bool isOverLittlePaper(const NearEnd& end, double way, const BitImage& ink) {
  double paper = 0.0;
  for (double s = 0.0; s <= way; s += kAimStepPx) {
    const Vec2 p = end.at + s * end.out;
    if (!ink.at(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())))) paper += kAimStepPx;
  }
  return paper <= end.paperPx + kAimStepPx;
}

class NearLines {
 public:
  /// @param widths [px] of the lines; 0 of outlines.
  NearLines(const std::vector<Contour>& lines, const std::vector<double>& widths)
      : lines_(lines), widths_(widths), grid_(gridOfLines(lines, kCellPx)) {}

  // [px] to the first line that the end meets across.
  std::optional<double> wayToLine(const NearEnd& end) const {
    std::optional<double> least;
    constexpr double kInkWidths = 1.5;  // half a width from the end to the border, and a stroke to be crossed
    const double most = kInkWidths * end.widthPx + end.paperPx;
    for (double s = 0.0; s <= most && !least; s += kAimStepPx) {
      grid_.around(end.at + s * end.out, [&](const PointOfLine& place) {
        if (const std::optional<double> way = crossing(end, place); way && (!least || *way < *least)) least = way;
      });
    }
    return least;
  }

 private:
  // [px] to where the end meets the segment from this point on.
  std::optional<double> crossing(const NearEnd& end, const PointOfLine& place) const {
    const Contour& other = lines_[place.line];
    const int n = static_cast<int>(other.points.size());
    if (place.point + 1 == n && !other.closed) return std::nullopt;
    const int fromEnd = end.side == 0 ? place.point : n - 1 - place.point;
    if (place.line == end.line && fromEnd < kOwnLineWidths * end.widthPx) return std::nullopt;
    const Vec2 &p = other.points[place.point].at, &q = other.points[(place.point + 1) % n].at;
    const Vec2 left = leftNormal(end.out), step = q - p;
    const double up = left.dot(p - end.at), down = left.dot(q - end.at);
    if ((up > 0.0) == (down > 0.0) || std::abs(up - down) < kMeetSin * step.norm()) return std::nullopt;
    const double way = end.out.dot(p + up / (up - down) * step - end.at);
    const double most = 0.5 * (end.widthPx + widths_[place.line]) + end.paperPx;
    return way > kLeastWayPx && way <= std::min(most, end.mostPx) ? std::optional(way) : std::nullopt;
  }

  const std::vector<Contour>& lines_;
  const std::vector<double>& widths_;
  PointGrid<PointOfLine> grid_;
};

// Offers two ends at an angle each other.
void offerCorner(std::vector<NearEnd>& ends, int i, int j, const BitImage& ink) {
  NearEnd &a = ends[i], &b = ends[j];
  const double sine = cross(a.out, b.out);
  if (std::abs(sine) < kMeetSin) return;
  const Vec2 d = b.at - a.at;
  const double ofA = cross(d, b.out) / sine, ofB = cross(d, a.out) / sine;
  const auto isNear = [&](const NearEnd& e, double way) {
    return way > kLeastWayPx && way <= std::min(0.5 * e.widthPx + e.paperPx, e.mostPx) &&
           isOverLittlePaper(e, way, ink);
  };
  if (!isNear(a, ofA) || !isNear(b, ofB)) return;
  const auto take = [&](NearEnd& e, int other, double way) {
    if (e.partner && e.bothWays <= ofA + ofB) return;
    e.partner = other;
    e.toPartner = way;
    e.bothWays = ofA + ofB;
  };
  take(a, j, ofA);
  take(b, i, ofB);
}

// [px] that the end is led on.
std::optional<double> wayOf(const std::vector<NearEnd>& ends, int i) {
  const NearEnd& e = ends[i];
  const auto isShorter = [](const NearEnd& end) { return !end.toLine || end.toPartner <= *end.toLine; };
  const bool isCorner = e.partner && ends[*e.partner].partner == i && isShorter(e) && isShorter(ends[*e.partner]);
  return isCorner ? std::optional(e.toPartner) : e.toLine;
}

void leadStraightOn(Contour& c, const NearEnd& end, double way) {
  if (end.side == 0) std::reverse(c.points.begin(), c.points.end());
  const ContourPoint last = c.points.back();
  const int steps = std::max(1, static_cast<int>(std::ceil(way))), before = static_cast<int>(c.points.size());
  for (int k = 1; k <= steps; ++k) c.points.push_back(laidPoint(last, end.at + end.out * (way * k / steps)));
  if (end.side == 0) {
    std::reverse(c.points.begin(), c.points.end());
    for (auto& [first, to] : c.bridges) first += steps, to += steps;
    c.bridges.insert(c.bridges.begin(), {0, steps - 1});
  } else {
    c.bridges.emplace_back(before, before + steps - 1);
  }
  measureContour(c);
}

}  // namespace

void leadOverPaper(std::vector<Contour>& lines, const BitImage& ink, double longestWidths, const RunContext& context) {
  if (!(longestWidths > 0.0)) return;
  std::vector<NearEnd> ends;
  std::vector<double> widths;
  double farthest = 1.0;
  for (int i = 0; i < std::ssize(lines); ++i) {
    const Contour& c = lines[i];
    widths.push_back(c.kind == ContourKind::Outline ? 0.0 : medianWidthOf(c));
    if (c.kind != ContourKind::Centreline || c.closed) continue;
    for (const int side : {0, 1}) {
      if (c.endsInInk[side]) continue;
      std::optional<NearEnd> end = endOf(c, side, widths.back(), longestWidths);
      if (!end) continue;
      end->line = i;
      farthest = std::max(farthest, end->widthPx + 2.0 * end->paperPx);
      ends.push_back(*end);
    }
  }
  if (ends.empty()) return;
  const NearLines near(lines, widths);
  PointGrid<int> places(farthest);
  for (int i = 0; i < std::ssize(ends); ++i) places.add(ends[i].at, i);
  for (int i = 0; i < std::ssize(ends); ++i) {
    if (context.isCancelled()) return;
    ends[i].toLine = near.wayToLine(ends[i]);
    if (ends[i].toLine && !isOverLittlePaper(ends[i], *ends[i].toLine, ink)) ends[i].toLine.reset();
    places.around(ends[i].at, [&](int j) {
      if (j > i && ends[j].line != ends[i].line) offerCorner(ends, i, j, ink);
    });
  }
  std::vector<std::optional<double>> ways;
  ways.reserve(ends.size());
  for (int i = 0; i < std::ssize(ends); ++i) ways.push_back(wayOf(ends, i));
  for (int i = 0; i < std::ssize(ends); ++i)
    if (ways[i]) leadStraightOn(lines[ends[i].line], ends[i], *ways[i]);
}

}  // namespace batten
