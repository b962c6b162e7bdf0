// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/ends/meeting_ends.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/statistics.h"
#include "core/contour/centreline/ends/line_ends.h"
#include "core/contour/centreline/profile/grey_across.h"
#include "core/contour/centreline/profile/stroke_course.h"
#include "core/contour/centreline/stroke_path.h"

namespace batten {
namespace {

// [stroke widths] and [px] Of a line before its end, that tell how it goes on: its direction and its bend.
constexpr double kLeadWidths = 3.0, kLeastLeadPx = 6.0;
constexpr double kBendWidths = 4.0, kLeastBendPx = 16.0;
constexpr double kBentLead = 0.9;          // of that, seen
constexpr double kBentLengthWidths = 8.0;  // of a line whose bend tells where it goes on: that of a stub is its noise
constexpr double kMostTurn = 0.8;          // [rad] by which a line bends on to another
constexpr double kMarchPx = 0.5;           // from one look at the lines around to the next
constexpr double kMeetWidths = 1.0;        // before and after an end its line may be met at right angles,
constexpr double kRimWidths = 1.5;         // the border of a shape,
constexpr double kLeastSin = 0.12;         // and so much farther at smaller ones, down to 7 degrees
constexpr double kAcrossSin = 0.5;         // 30 degrees: a line is met across
constexpr double kInkPx = 1.0;             // beyond the widths of two lines: their ink touches still
constexpr double kTouchHalfWidths = 1.0;   // from a line: an end that comes as close touches it
constexpr double kMostLedWidths = 12.0;    // on from an end
constexpr double kLeastRestWidths = 0.75;  // from the anchor to a place where several ends meet,
constexpr double kMostMovedWidths = 2.0;   // and from where one would have ended to there
constexpr double kMostJump = 1.2;          // of a step, by which a distance changes: more is of another stretch
constexpr double kOwnWidths = 3.0;         // along a line from its own end: nearer it is the end itself
// Of two letters that only blur joins the ink between is paler: by so much of their depth at most it is theirs.
constexpr double kMostPaler = 0.5;
constexpr double kPaperWidths = 1.5, kPaperPx = 1.5;  // beside the middle of a line is paper

double widthAt(const ContourPoint& p) { return static_cast<double>(p.widthPx.value_or(0.0f)); }

// The end of a line, and how it goes on from there: at + s out + s^2 / 2 bend.
struct LineEnd {
  int line = 0, side = 0;
  int anchor = 0;  // index, counted from the end, of the first point that stays,
  int last = 0;    // of the last one
  Vec2 out = Vec2::Zero(), bend = Vec2::Zero();
  double widthPx = 1.0;
};

// From the anchor on, along the line's own points and beyond.
struct Way {
  std::vector<Vec2> places;
  int end = 0;  // index of the line's last point
};

// Where a line lies as seen from a place near it.
struct LineBeside {
  int line = 0;
  double distance = 0.0;  // [px] signed: to which side of the line's travel
  Vec2 foot = Vec2::Zero(), along = Vec2::Zero();
  double widthPx = 0.0;
  bool isRim = false;
};

struct LineMeeting {
  int line = 0;           // met
  std::vector<Vec2> way;  // from the anchor to the line met
  double sine = 0.0;      // of the angle there
  double beyondPx = 0.0;  // the end, along the way
};

struct Lead {
  LineEnd end;
  LineMeeting meeting;
};

class EndLeader {
 public:
  EndLeader(const std::vector<Contour>& lines, const GreyImage& grey)
      : lines_(lines), grey_(grey), grid_(gridOfLines(lines, cellPx(lines))) {}

  std::optional<LineEnd> endOf(int line, int side) const;
  std::optional<LineMeeting> meetingOf(const LineEnd& end) const;
  bool isInked(const LineEnd& end, const std::vector<Vec2>& way, const Vec2& onInk) const;
  std::optional<Lead> leadTo(const Lead& lead, const Vec2& place) const;

 private:
  // Lines three times as wide as usual are still seen from where their ink begins.
  static double cellPx(const std::vector<Contour>& lines) {
    std::vector<float> widths;
    for (const Contour& c : lines)
      for (const ContourPoint& p : c.points)
        if (p.widthPx) widths.push_back(*p.widthPx);
    return 2.0 * std::max(1.0, widths.empty() ? 1.0 : static_cast<double>(upperMedian(widths))) + 2.0 * kInkPx;
  }
  const ContourPoint& point(const LineEnd& end, int k) const { return pointFromEnd(lines_[end.line], end.side, k); }
  LocalQuadratic fitBefore(const LineEnd& end, double reach, int order) const {
    return fitBeforeEnd(lines_[end.line], end.side, end.last, reach, order, kBentLead);
  }
  Way wayOf(const LineEnd& end, bool isBent) const;
  std::optional<LineMeeting> meetingAlong(const LineEnd& end, const Way& way) const;
  std::vector<LineBeside> around(const LineEnd& end, const Vec2& place) const;
  double levelAt(const Vec2& at) const { return levelOfPixel(grey_, at); }

  const std::vector<Contour>& lines_;
  const GreyImage& grey_;
  PointGrid<PointOfLine> grid_;
};

std::optional<LineEnd> EndLeader::endOf(int line, int side) const {
  LineEnd end{line, side};
  const int n = static_cast<int>(lines_[line].points.size());
  if (n < 3) return std::nullopt;
  end.widthPx = std::max(1.0, widthAt(point(end, 0)));
  const bool isPlaced = point(end, 0).refined;
  // Before the border of a shape a skeleton turns to its corners.
  const auto isNear = [&](int k, double px) { return (point(end, k).at - point(end, 0).at).norm() < px; };
  while (isPlaced && end.last + 1 < n && isNear(end.last, kHookWidths * end.widthPx)) ++end.last;
  end.anchor = end.last;
  while (end.anchor + 1 < n && isNear(end.anchor, kMeetWidths * end.widthPx)) ++end.anchor;
  if (3 * end.anchor > n) return std::nullopt;  // the other end may be led on too
  const LocalQuadratic fit = fitBefore(end, std::max(kLeastLeadPx, kLeadWidths * end.widthPx), 1);
  if (fit.order.value_or(0) < 1 || !(fit.r1.norm() > 0.0)) return std::nullopt;
  end.out = fit.r1.normalized();
  // The grain of a pencil bends its line to and fro.
  if (!point(end, end.anchor).sigmaPx) return end;
  const LocalQuadratic bent = fitBefore(end, std::max(kLeastBendPx, kBendWidths * end.widthPx), 2);
  if (bent.order != 2 || !(bent.r1.norm() > 0.0) || lines_[line].lengthPx < kBentLengthWidths * end.widthPx) return end;
  end.out = bent.r1.normalized();
  const Vec2 left = leftNormal(end.out);
  end.bend = left * left.dot(bent.r2);
  return end;
}

Way EndLeader::wayOf(const LineEnd& end, bool isBent) const {
  Way way;
  for (int k = end.anchor; k >= end.last; --k) way.places.push_back(point(end, k).at);
  way.end = static_cast<int>(way.places.size()) - 1;
  const Vec2 at = way.places.back(), out = end.out;
  const Vec2 bend = isBent ? end.bend : Vec2(Vec2::Zero());
  const double most = kMostLedWidths * end.widthPx, turn = bend.norm();
  const double to = turn > 0.0 ? std::min(most, kMostTurn / turn) : most;
  for (double s = kMarchPx; s <= to; s += kMarchPx) way.places.emplace_back(at + s * (out + 0.5 * s * bend));
  return way;
}

// The lines near a place, each by its nearest segment.
std::vector<LineBeside> EndLeader::around(const LineEnd& end, const Vec2& place) const {
  std::vector<LineBeside> nearest;
  grid_.around(place, [&](const PointOfLine& near) {
    const Contour& other = lines_[near.line];
    const int n = static_cast<int>(other.points.size());
    if (near.point + 1 == n && !other.closed) return;
    const int fromEnd = end.side == 0 ? near.point : n - 1 - near.point;
    if (near.line == end.line && fromEnd < end.anchor + kOwnWidths * end.widthPx) return;
    const ContourPoint &p = other.points[near.point], &q = other.points[(near.point + 1) % n];
    const Vec2 step = q.at - p.at;
    if (!(step.norm() > 0.0)) return;
    const Vec2 away = awayFromSegment(place, p.at, q.at);
    // Beyond its end a line is not met.
    const Vec2 foot = place - away;
    const bool isFirst = near.point == 0, isLast = near.point + 2 == n;
    if (!other.closed && ((isFirst && foot == p.at) || (isLast && foot == q.at))) return;
    const auto found = std::ranges::find(nearest, near.line, &LineBeside::line);
    if (found != nearest.end() && std::abs(found->distance) <= away.norm()) return;
    const double sign = cross(step, Vec2(place - p.at)) < 0.0 ? -1.0 : 1.0;
    const LineBeside beside{near.line,         sign * away.norm(), foot,
                            step.normalized(), widthAt(p),         other.kind == ContourKind::Outline};
    (found != nearest.end() ? *found : nearest.emplace_back()) = beside;
  });
  return nearest;
}

std::optional<LineMeeting> EndLeader::meetingAlong(const LineEnd& end, const Way& way) const {
  std::optional<LineMeeting> crossed, touched;
  std::vector<LineBeside> before;
  double arc = 0.0;  // from the end
  for (int k = 0; k < way.end; ++k) arc -= (way.places[k + 1] - way.places[k]).norm();
  for (int k = 0; k < std::ssize(way.places); ++k) {
    const Vec2& place = way.places[k];
    const Vec2 step = k > 0 ? Vec2(place - way.places[k - 1]) : end.out;
    if (k > 0) arc += step.norm();
    std::vector<LineBeside> now = around(end, place);
    bool isOnInk = k <= way.end;
    for (const LineBeside& beside : now) {
      // The mouth of a stroke is laid straight from rim to rim; its ink begins before it.
      const double inkPx = beside.isRim ? kRimWidths * end.widthPx : 0.5 * (end.widthPx + beside.widthPx);
      isOnInk = isOnInk || std::abs(beside.distance) <= inkPx + kInkPx;
      const auto was = std::ranges::find(before, beside.line, &LineBeside::line);
      if (was == before.end()) continue;
      const double d = beside.distance, old = was->distance;
      const double sine = std::abs(cross(beside.along, step.normalized()));
      const double widths = beside.isRim ? kRimWidths : kMeetWidths;
      const double reach = widths * std::max(end.widthPx, beside.widthPx) / std::max(kLeastSin, sine) + kInkPx;
      // What jumps is the line's other bank, or beyond its end.
      if (std::abs(arc) > reach || std::abs(d - old) > kMostJump * step.norm()) continue;
      const auto isBetter = [&](const std::optional<LineMeeting>& than) {
        return !than || std::abs(arc) < std::abs(than->beyondPx);
      };
      if (d * old <= 0.0) {
        if (!isBetter(crossed)) continue;
        std::vector<Vec2> taken(way.places.begin(), way.places.begin() + k + 1);
        taken.back() = beside.foot;
        crossed = LineMeeting{beside.line, std::move(taken), sine, arc};
      } else if (k > way.end && std::abs(d) > std::abs(old) && sine < kAcrossSin &&
                 std::abs(d) <= kTouchHalfWidths * 0.5 * std::max(1.0, beside.widthPx) && isBetter(touched)) {
        std::vector<Vec2> taken(way.places.begin(), way.places.begin() + way.end + 1);
        const Vec2 along = beside.along.dot(end.out) < 0.0 ? Vec2(-beside.along) : beside.along;
        for (const Vec2& at : cubicBetween(taken.back(), end.out, beside.foot, along)) taken.push_back(at);
        taken.push_back(beside.foot);
        touched = LineMeeting{beside.line, std::move(taken), sine, arc};
      }
    }
    if (!isOnInk || (crossed && arc > std::abs(crossed->beyondPx))) break;
    before = std::move(now);
  }
  return crossed ? crossed : touched;
}

// Whether the way from the end on is as dark as the line and a place known to lie on ink, as on the line met.
bool EndLeader::isInked(const LineEnd& end, const std::vector<Vec2>& way, const Vec2& onInk) const {
  const int own = end.anchor - end.last;
  // A pencil pales towards its end.
  if (std::ssize(way) <= own + 1 || !point(end, end.anchor).sigmaPx) return true;
  const Vec2 aside = leftNormal(end.out) * (kPaperWidths * end.widthPx + kPaperPx);
  const double paper = std::max(levelAt(way.front() + aside), levelAt(way.front() - aside));
  const double ink = std::max(levelAt(way.front()), levelAt(onInk));
  const double palest = ink + kMostPaler * std::max(0.0, paper - ink);
  return std::all_of(way.begin() + own, way.end(), [&](const Vec2& at) { return levelAt(at) <= palest; });
}

// The lead with its end at a place, bent there from the anchor on. Nothing where that is far or behind.
std::optional<Lead> EndLeader::leadTo(const Lead& lead, const Vec2& place) const {
  Lead on = lead;
  LineEnd& end = on.end;
  end.last = end.anchor;
  const Vec2 anchor = point(end, end.anchor).at, before = point(end, end.anchor + 1).at, rest = place - anchor;
  if (rest.dot(end.out) < kLeastRestWidths * end.widthPx ||
      (place - lead.meeting.way.back()).norm() > kMostMovedWidths * end.widthPx)
    return std::nullopt;
  std::vector<Vec2>& way = on.meeting.way;
  way.assign(1, anchor);
  for (const Vec2& at : cubicBetween(anchor, (anchor - before).normalized(), place, rest.normalized()))
    way.push_back(at);
  way.push_back(place);
  return isInked(end, way, anchor) ? std::optional(on) : std::nullopt;
}

// Straight on where that meets a line well across; else as the line bends.
std::optional<LineMeeting> EndLeader::meetingOf(const LineEnd& end) const {
  std::optional<LineMeeting> straight = meetingAlong(end, wayOf(end, false));
  if ((straight && straight->sine >= kAcrossSin) || !(end.bend.norm() > 0.0)) return straight;
  std::optional<LineMeeting> bent = meetingAlong(end, wayOf(end, true));
  return bent ? bent : straight;
}

// Replaces what lies beyond the anchor by points about 1 px apart along the way.
void leadOn(Contour& c, const LineEnd& end, const std::vector<Vec2>& way) {
  if (end.side == 0) std::reverse(c.points.begin(), c.points.end());
  const std::vector<ContourPoint> own(c.points.end() - end.anchor, c.points.end());
  c.points.resize(c.points.size() - end.anchor);
  for (int k = 1; k < std::ssize(way); ++k) {
    const bool isLast = k + 1 == std::ssize(way);
    // Points of the line stay what they are.
    if (k - 1 < end.anchor - end.last && !isLast) {
      c.points.push_back(own[k - 1]);
      continue;
    }
    if (!isLast && (way[k] - c.points.back().at).norm() < 1.0 - 0.5 * kMarchPx) continue;
    c.points.push_back(laidPoint(c.points.back(), way[k]));
  }
  if (end.side == 0) std::reverse(c.points.begin(), c.points.end());
}

// Which of the leads moves the place where another one ends: the end of the line met lies there. By lead.
std::vector<std::optional<int>> leadsMet(const std::vector<Contour>& lines, const std::vector<Lead>& leads) {
  constexpr double kAtEndPx = 1.5;  // points lie a pixel apart
  std::vector<std::array<std::optional<int>, 2>> ofEnd(lines.size());
  for (int i = 0; i < std::ssize(leads); ++i) ofEnd[leads[i].end.line][leads[i].end.side] = i;
  std::vector<std::optional<int>> met(leads.size());
  for (int i = 0; i < std::ssize(leads); ++i) {
    double nearest = kAtEndPx;
    for (const std::optional<int>& other : ofEnd[leads[i].meeting.line]) {
      if (!other || *other == i) continue;
      const LineEnd& end = leads[*other].end;
      for (int k = 0; k < end.anchor; ++k) {
        const double apart = (pointFromEnd(lines[end.line], end.side, k).at - leads[i].meeting.way.back()).norm();
        if (apart < nearest) nearest = apart, met[i] = other;
      }
    }
  }
  return met;
}

// The place nearest to the straight lines on which ends run on. Nothing where all run one way.
std::optional<Vec2> commonPlace(const std::vector<Contour>& lines, const std::vector<Lead>& leads,
                                const std::vector<int>& chosen) {
  constexpr double kLeastSpread = 0.1;  // of the smaller eigenvalue, of the number of lines
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  Vec2 moment = Vec2::Zero();
  for (const int i : chosen) {
    const LineEnd& end = leads[i].end;
    const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - end.out * end.out.transpose();
    sum += across;
    moment += across * pointFromEnd(lines[end.line], end.side, end.last).at;
  }
  const double half = 0.5 * sum.trace(), least = half - std::sqrt(std::max(0.0, half * half - sum.determinant()));
  if (least < kLeastSpread * static_cast<double>(chosen.size())) return std::nullopt;
  return Vec2(sum.inverse() * moment);
}

// Three ends or more that are led on to each other's in a ring would make a triangle of their tails: where several
// strokes end in one place they meet there.
void meetInOnePlace(const std::vector<Contour>& lines, const EndLeader& leader, std::vector<Lead>& leads) {
  constexpr int kFewest = 3;
  const std::vector<std::optional<int>> met = leadsMet(lines, leads);
  std::vector<int> round(leads.size(), -1);  // of the walk that came by
  for (int first = 0; first < std::ssize(leads); ++first) {
    int at = first;
    while (round[at] < 0) {
      round[at] = first;
      if (!met[at]) break;
      at = *met[at];
    }
    if (!met[at] || round[at] != first) continue;
    std::vector<int> ring;
    int next = at;
    do {
      ring.push_back(next);
      next = *met[next];
    } while (next != at);
    if (std::ssize(ring) < kFewest) continue;
    const std::optional<Vec2> place = commonPlace(lines, leads, ring);
    std::vector<Lead> led;
    for (const int i : ring) {
      std::optional<Lead> on = place ? leader.leadTo(leads[i], *place) : std::nullopt;
      if (on) led.push_back(std::move(*on));
    }
    if (led.size() != ring.size()) continue;
    for (std::size_t k = 0; k < ring.size(); ++k) leads[ring[k]] = std::move(led[k]);
    // An end that was led on to one of theirs goes along.
    const auto isOfRing = [&](int i) { return std::ranges::find(ring, i) != ring.end(); };
    for (int i = 0; i < std::ssize(leads); ++i) {
      if (!met[i] || isOfRing(i) || !isOfRing(*met[i])) continue;
      if (auto on = leader.leadTo(leads[i], *place)) leads[i] = std::move(*on);
    }
  }
}

}  // namespace

void leadToLines(std::vector<Contour>& lines, const GreyImage& grey, const RunContext& context) {
  const auto endsInInk = [](const Contour& c) { return !c.closed && (c.endsInInk[0] || c.endsInInk[1]); };
  if (std::ranges::none_of(lines, endsInInk)) return;
  std::vector<Lead> leads;
  const EndLeader leader(lines, grey);
  for (int i = 0; i < std::ssize(lines); ++i) {
    if (!endsInInk(lines[i])) continue;
    if (context.isCancelled()) return;
    for (const int side : {0, 1}) {
      const std::optional<LineEnd> end = lines[i].endsInInk[side] ? leader.endOf(i, side) : std::nullopt;
      if (!end) continue;
      std::optional<LineMeeting> meeting = leader.meetingOf(*end);
      if (meeting && leader.isInked(*end, meeting->way, meeting->way.back()))
        leads.push_back({*end, std::move(*meeting)});
    }
  }
  meetInOnePlace(lines, leader, leads);
  // All are found on the lines as they were, so that their order does not matter.
  for (const auto& [end, meeting] : leads) {
    Contour& c = lines[end.line];
    const auto before = static_cast<int>(c.points.size());
    leadOn(c, end, meeting.way);
    const int after = static_cast<int>(c.points.size()), stay = before - end.anchor;
    const auto [low, high] = end.side == 0 ? std::pair(after - stay, after - 1) : std::pair(0, stay - 1);
    for (auto& [first, last] : c.bridges) {
      const int shift = end.side == 0 ? after - before : 0;
      first = std::max(first + shift, low);
      last = std::min(last + shift, high);
    }
    std::erase_if(c.bridges, [](const auto& bridge) { return bridge.first > bridge.second; });
    measureContour(c);
  }
}

}  // namespace batten
