// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/pen_strokes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>

#include "core/base/number_text.h"
#include "core/contour/ink/line_choices.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr std::size_t kMostPoints = 100000;  // of one stroke
/// [px] Distance of the points in between; longer strokes take wider steps, so that a page never becomes too much.
constexpr double kPenStepPx = 1.0;
constexpr double kMostSteps = 200000.0;  // of one stroke

std::vector<Vec2> distinct(const PenStroke& stroke) {
  std::vector<Vec2> points;
  for (const Vec2& p : stroke.points) {
    if (points.empty() || p != points.back()) points.push_back(p);
  }
  while (stroke.closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
  return points;
}

// The part of a segment that lies on a page: from 0..1 at `from` to 0..1 at `to` (Liang and Barsky 1984).
struct SegmentPart {
  double from = 0.0, to = 1.0;
};
std::optional<SegmentPart> onPage(const Vec2& a, const Vec2& b, const PageExtent& page) {
  SegmentPart part;
  const Vec2 size(page.widthPx, page.heightPx), segment = b - a;
  for (const int axis : {0, 1}) {
    if (segment[axis] == 0.0) {
      if (a[axis] < 0.0 || a[axis] > size[axis]) return std::nullopt;
      continue;
    }
    const double low = -a[axis] / segment[axis], high = (size[axis] - a[axis]) / segment[axis];
    part.from = std::max(part.from, std::min(low, high));
    part.to = std::min(part.to, std::max(low, high));
  }
  if (!(part.from < part.to)) return std::nullopt;
  return part;
}

bool isOnPage(const PenStroke& stroke, const PageExtent& page) {
  return std::all_of(stroke.points.begin(), stroke.points.end(), [&](const Vec2& p) {
    return p.x() >= 0.0 && p.y() >= 0.0 && p.x() <= page.widthPx && p.y() <= page.heightPx;
  });
}

// The parts of a stroke that lie on a page, each an open line.
std::vector<std::vector<Vec2>> partsOnPage(const PenStroke& stroke, const PageExtent& page) {
  const std::vector<Vec2> drawn = distinct(stroke);
  const int n = static_cast<int>(drawn.size()), segments = stroke.closed ? n : n - 1;
  std::vector<std::vector<Vec2>> parts;
  bool isOpen = false;  // the last part ends where this segment begins
  for (int i = 0; i < segments; ++i) {
    const Vec2 &a = drawn[i], &b = drawn[(i + 1) % n];
    const auto segment = onPage(a, b, page);
    if (!segment) {
      isOpen = false;
      continue;
    }
    if (!isOpen || segment->from > 0.0) parts.push_back({a + segment->from * (b - a)});
    parts.back().push_back(segment->to < 1.0 ? Vec2(a + segment->to * (b - a)) : b);
    isOpen = segment->to >= 1.0;
  }
  // A closed stroke comes round to the part that it began with.
  if (stroke.closed && isOpen && parts.size() > 1 && parts.front().front() == drawn.front()) {
    parts.back().insert(parts.back().end(), parts.front().begin() + 1, parts.front().end());
    parts.erase(parts.begin());
  }
  return parts;
}

// The longest part of a stroke on a page; nothing where it lies beside it.
std::optional<PenStroke> cutToPage(const PenStroke& stroke, const PageExtent& page) {
  std::optional<PenStroke> longest;
  double most = 0.0;
  for (std::vector<Vec2>& part : partsOnPage(stroke, page)) {
    const double length = polylineLength(part, false);
    if (!(length > most)) continue;
    most = length;
    longest = PenStroke{std::move(part), false};
  }
  return longest;
}

// What became of the strokes of a drawing.
struct PenReport {
  int beside = 0, cut = 0, tooMany = 0;
};

std::string noteOf(const PenReport& report) {
  std::string note;
  const auto add = [&](int count, const std::string& one, const std::string& several) {
    if (count == 0) return;
    if (!note.empty()) note += ' ';
    note += counted(count, "pen stroke", "pen strokes") + (count == 1 ? one : several);
  };
  add(report.cut, " leaves the page: only its longest part on the page is used.",
      " leave the page: only the longest part of each on the page is used.");
  add(report.beside, " is outside the page and is ignored.", " are outside the page and are ignored.");
  add(report.tooMany, " is left out", " are left out");
  if (report.tooMany > 0) {
    note += ", because a drawing may hold ";
    note += std::to_string(kMostPenStrokes);
    note += " pen strokes of ";
    note += std::to_string(kMostPenPoints);
    note += " px and as many points together: remove some strokes, or shorten them.";
  }
  return note;
}

}  // namespace

std::optional<Error> validate(const PenStroke& stroke) {
  const auto bad = [](const char* message) { return Error{ErrorCode::BadParameter, message, {}}; };
  if (stroke.points.size() > kMostPoints) return bad("A pen stroke may hold at most 100000 points.");
  for (const Vec2& p : stroke.points) {
    if (!p.allFinite()) return bad("A point of a pen stroke has no valid position.");
  }
  const std::size_t places = distinct(stroke).size();
  if (places < 2) return bad("A pen stroke needs at least two points at different places.");
  if (stroke.closed && places < 3) return bad("A closed pen stroke needs at least three points at different places.");
  return std::nullopt;
}

Contour penContour(const PenStroke& stroke) {
  const std::vector<Vec2> drawn = distinct(stroke);
  Contour contour;
  contour.kind = ContourKind::Pen;
  contour.closed = stroke.closed;
  contour.lengthPx = polylineLength(drawn, stroke.closed);
  if (stroke.closed) contour.areaPx = polygonArea(drawn);
  const double step = std::max(kPenStepPx, contour.lengthPx / kMostSteps);
  const int n = static_cast<int>(drawn.size()), segments = stroke.closed ? n : n - 1;
  const auto add = [&](const Vec2& at, bool isDrawn) {
    contour.points.push_back({.at = at, .unrefined = at, .refined = isDrawn});
  };
  for (int i = 0; i < n; ++i) {
    add(drawn[i], true);
    if (i >= segments) break;
    const Vec2& next = drawn[(i + 1) % n];
    const int parts = static_cast<int>(std::ceil((next - drawn[i]).norm() / step));
    for (int k = 1; k < parts; ++k) {
      add(drawn[i] + (next - drawn[i]) * (static_cast<double>(k) / parts), false);
    }
  }
  return contour;
}

Result<ContourSet> withPenStrokes(const ContourSet& set, std::span<const PenStroke> strokes, const PageExtent& page) {
  ContourSet result = set;
  PenReport report;
  std::int64_t points = 0;
  int count = 0;
  for (const PenStroke& stroke : strokes) {
    Contour& contour = result.contours.emplace_back();
    contour.kind = ContourKind::Pen;
    const bool isWhole = isOnPage(stroke, page);
    const std::optional<PenStroke> kept = isWhole ? std::optional(stroke) : cutToPage(stroke, page);
    if (!kept) {
      ++report.beside;
      continue;
    }
    if (count == kMostPenStrokes) {
      ++report.tooMany;
      continue;
    }
    const std::int64_t left = kMostPenPoints - points;
    const double lengthPx = polylineLength(kept->points, kept->closed);
    // A stroke that runs to and fro may have few points and be longer than any that a hand draws.
    if (lengthPx > kPenStepPx * static_cast<double>(left)) {
      ++report.tooMany;
      continue;
    }
    Contour laid = penContour(*kept);
    if (std::ssize(laid.points) > left) {
      ++report.tooMany;
      continue;
    }
    if (!isWhole) ++report.cut;
    ++count;
    points += std::max(std::ssize(laid.points), static_cast<std::ptrdiff_t>(lengthPx / kPenStepPx));
    contour = std::move(laid);
  }
  const std::string note = noteOf(report);
  if (points == 0 && set.contours.empty() && report.tooMany > 0) return fail(ErrorCode::NoCurve, note);
  if (points == 0 && set.contours.empty()) {
    return fail(ErrorCode::NoCurve, "No line lies on the page: draw on it, or make the page larger.", note);
  }
  if (!note.empty()) addNote(result, note);
  return result;
}

}  // namespace batten
