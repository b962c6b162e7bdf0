// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/sharp_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "core/base/segment_foot.h"
#include "core/base/statistics.h"
#include "core/construct/fair/fair_piece.h"
#include "core/construct/fair/fair_prepare.h"

namespace batten {
namespace {

constexpr double kArmPx = 6.0;  // chords whose directions are compared
// Of the centre's standard deviation by grain: then three standard deviations of the angle between two chords, sqrt(6)
// times that over a chord, are as much as kSharpRad.
constexpr double kArmSigmas = 12.0;
constexpr double kGrainSigmas = 3.0;  // within which a point is where the stroke is
constexpr double kArmPoints = 3.0;    // and where points are sparse: chords of fewer have no direction
constexpr int kFewestPoints = 5;      // fewer have no turn that two chords could tell
constexpr double kFewestArms = 3.0;   // of line: shorter ones have no turn that two chords could tell
constexpr double kSharpRad = 0.6;     // between the two chords: an arc of less than 10 px radius, or a corner
constexpr double kMarginPx = 3.0;     // of line on either side that blur has rounded
constexpr double kEndGuardPx = 5.0;   // an end has hooks of its own
constexpr double kFarPx = 1.5, kVeryFarPx = 4.0;   // of a point from a curve: few may lie so far, and none
constexpr double kFarShare = 0.02;                 // of the points: so few
constexpr double kOutlierPx = 1.2, kBackPx = 0.5;  // what a fit has left, and where it is back on its points
constexpr double kLongestRatio = 1.15;  // of the lengths of curve and points: a longer one wanders between them
constexpr double kLoosePx = 4.0;        // that a curve may be longer than its points: of short lines noise makes length
constexpr double kLongRunPx = 30.0;     // of points that are left: longer runs are first cut at their sharpest turn
// A curve is measured along a polygon: chords of about so many px, and so many in a span.
constexpr double kChordPx = 2.0;
constexpr int kFewestChords = 2, kMostChords = 16;
// Chords to look ahead for the next point; more where the curve seems to have left the points, as behind a hook.
constexpr std::size_t kReach = 8, kFarReach = 24;
// A point counts as far where most of the five about it are: single outliers do not.
constexpr int kBeside = 2, kMajority = 3;

/// The points of a piece with lengths along them; outliers stand aside.
struct Course {
  std::vector<int> index;  ///< Of the points that are used.
  std::vector<Vec2> p;     ///< Averages of three.
  std::vector<double> s;   ///< From the first on.
  double total = 0.0;      ///< Closed: all the way round.
  bool closed = false;
  int count() const { return static_cast<int>(p.size()); }
  Vec2 at(int i) const { return p[((i % count()) + count()) % count()]; }
  double length(int i) const {
    const int n = count();
    const int laps = static_cast<int>(std::floor(static_cast<double>(i) / n));
    return s[i - laps * n] + laps * total;
  }
};

Course courseOf(const ConstructPiece& piece, double gatePx) {
  FairData data;
  data.closed = piece.closed;
  std::vector<int> original;
  for (int i = 0; i < std::ssize(piece.points); ++i) {
    if (!piece.points[i].at.allFinite()) continue;
    data.points.emplace_back().at = piece.points[i].at;
    original.push_back(i);
  }
  if (gatePx > 0.0) rejectOutliers(data, gatePx, medianSpacing(data));
  std::vector<Vec2> raw;
  Course course;
  course.closed = piece.closed;
  for (int i = 0; i < std::ssize(data.points); ++i) {
    if (!data.points[i].use) continue;
    raw.push_back(data.points[i].at);
    course.index.push_back(original[i]);
  }
  const int n = static_cast<int>(raw.size());
  for (int i = 0; i < n; ++i) {
    const bool end = !piece.closed && (i == 0 || i + 1 == n);
    course.p.push_back(end ? raw[i] : Vec2((raw[(i + n - 1) % n] + raw[i] + raw[(i + 1) % n]) / 3.0));
    course.s.push_back(i == 0 ? 0.0 : course.s.back() + (course.p[i] - course.p[i - 1]).norm());
  }
  if (n > 0) course.total = course.s.back() + (piece.closed ? (course.p.front() - course.p.back()).norm() : 0.0);
  return course;
}

/// Angle between the chords of about kArmPx before and after every point; 0 next to open ends.
std::vector<double> turning(const Course& course, double arm) {
  const int n = course.count();
  std::vector<double> angle(course.p.size(), 0.0);
  if (n < kFewestPoints || course.total < kFewestArms * arm) return angle;
  int back = course.closed ? -n : 0, front = 0;
  for (int i = 0; i < n; ++i) {
    const double here = course.s[i];
    while (back + 1 < i && here - course.length(back + 1) >= arm) ++back;
    front = std::max(front, i + 1);
    while ((course.closed || front < n) && course.length(front) - here < arm && front < i + n) ++front;
    if (!course.closed && (here < arm || front >= n)) continue;
    const Vec2 before = course.at(i) - course.at(back), after = course.at(front) - course.at(i);
    angle[i] = std::abs(std::atan2(cross(before, after), before.dot(after)));
  }
  return angle;
}

/// [px] By which grain may put a point beside its line.
double grainReach(const ConstructPiece& piece) { return kGrainSigmas * piece.grain.sigmaPx; }

/// [px] Length of the chords whose directions are compared.
double armOf(const Course& course, const ConstructPiece& piece) {
  const double longest = course.total / (2.0 * kFewestArms);  // a short piece has turns, too
  return std::max(
      {kArmPx, std::min(kArmSigmas * piece.grain.sigmaPx, longest), kArmPoints * course.total / course.count()});
}

/// Widens the places a..b of the course by a length on either side; as indices of the piece.
PointRange widened(const Course& course, const ConstructPiece& piece, int a, int b, double margin) {
  const int n = course.count();
  const double from = course.length(a) - margin, to = course.length(b) + margin;
  while ((course.closed ? a > b - n + 1 : a > 0) && course.length(a) > from) --a;
  while ((course.closed ? b < a + n - 1 : b + 1 < n) && course.length(b) < to) ++b;
  const int size = static_cast<int>(piece.points.size());
  const auto original = [&](int i) {
    const int laps = static_cast<int>(std::floor(static_cast<double>(i) / n));
    return course.index[i - laps * n] + laps * size;
  };
  PointRange range{original(a), original(b)};
  while (range.first < 0) range = {range.first + size, range.last + size};
  return range;
}

double lengthBetween(const ConstructPiece& piece, int first, int last) {
  const int n = static_cast<int>(piece.points.size());
  double length = 0.0;
  for (int i = first; i < last; ++i) length += (piece.points[(i + 1) % n].at - piece.points[i % n].at).norm();
  return length;
}

/// Where a polygon passes a point.
struct Passing {
  double distance = 0.0;
  double place = 0.0;  ///< Index into the polygon.
};

/// The place of the polygon nearest to p near vertex `at`, which follows along.
Passing follow(const std::vector<Vec2>& polygon, const Vec2& p, std::size_t& at, std::size_t reach) {
  const std::size_t last = polygon.size() - 1;
  const std::size_t low = at > reach / 2 ? at - reach / 2 : 0, high = std::min(last, at + reach);
  double best = (polygon[at] - p).squaredNorm();
  for (std::size_t i = low; i <= high; ++i) {
    const double d = (polygon[i] - p).squaredNorm();
    if (d < best) best = d, at = i;
  }
  double place = static_cast<double>(at);
  for (const std::size_t i : {at, at + 1}) {
    if (i == 0 || i > last) continue;
    const SegmentFoot foot = footOnSegment(p, polygon[i - 1], polygon[i]);
    const double d = foot.away.squaredNorm();
    if (d < best) best = d, place = static_cast<double>(i - 1) + foot.share;
  }
  return {std::sqrt(best), place};
}

}  // namespace

std::vector<PointRange> sharpFeatures(const ConstructPiece& piece, bool isStroke, const FairFitOptions& options) {
  const Course course = courseOf(piece, isStroke ? options.gateStrokePx : options.gateOutlinePx);
  const int n = course.count();
  std::vector<PointRange> features;
  if (n < kFewestPoints) return features;
  const std::vector<double> angle = turning(course, armOf(course, piece));
  const auto sharp = [&](int i) { return angle[i % n] > kSharpRad; };
  int begin = 0;
  if (piece.closed) {
    while (begin < n && sharp(begin)) ++begin;
    if (begin == n) return {{0, static_cast<int>(piece.points.size()) - 1}};
  }
  for (int i = begin; i < begin + n; ++i) {
    if (!sharp(i)) continue;
    int j = i;
    while (j + 1 < begin + n && sharp(j + 1)) ++j;
    const double from = course.length(i), to = course.length(j);
    if (piece.closed || (from > kEndGuardPx && to < course.total - kEndGuardPx)) {
      features.push_back(widened(course, piece, i, j, kMarginPx));
    }
    i = j;
  }
  return features;
}

std::vector<PointRange> united(std::vector<PointRange> ranges, const ConstructPiece& piece, double least) {
  const int n = static_cast<int>(piece.points.size());
  std::sort(ranges.begin(), ranges.end(), [](const PointRange& a, const PointRange& b) { return a.first < b.first; });
  std::vector<PointRange> out;
  for (const PointRange& r : ranges) {
    if (!out.empty() && (r.first <= out.back().last || lengthBetween(piece, out.back().last, r.first) < least)) {
      out.back().last = std::max(out.back().last, r.last);
    } else {
      out.push_back(r);
    }
  }
  if (out.empty()) return out;
  if (!piece.closed) {
    if (lengthBetween(piece, 0, out.front().first) < least) out.front().first = 0;
    if (lengthBetween(piece, out.back().last, n - 1) < least) out.back().last = n - 1;
    return out;
  }
  while (out.size() > 1 && (out.front().first + n <= out.back().last ||
                            lengthBetween(piece, out.back().last, out.front().first + n) < least)) {
    out.back().last = std::max(out.back().last, out.front().last + n);
    out.erase(out.begin());
  }
  if (out.size() == 1 && (out.front().last - out.front().first >= n - 1 ||
                          lengthBetween(piece, out.front().last, out.front().first + n) < least)) {
    out.front() = {0, n - 1};
  }
  return out;
}

std::vector<PointRange> between(const std::vector<PointRange>& features, const ConstructPiece& piece) {
  const int n = static_cast<int>(piece.points.size());
  if (features.empty()) return {{0, n - 1}};
  std::vector<PointRange> out;
  const auto add = [&](int first, int last) {
    if (last > first) out.push_back({first, last});
  };
  if (!piece.closed) add(0, features.front().first - 1);
  for (std::size_t i = 0; i + 1 < features.size(); ++i) add(features[i].last + 1, features[i + 1].first - 1);
  if (piece.closed) {
    add(features.back().last + 1, features.front().first + n - 1);
  } else {
    add(features.back().last + 1, n - 1);
  }
  return out;
}

bool PointDeviation::good() const {
  const auto share = static_cast<int>(kFarShare * static_cast<double>(points.size()));
  return veryFar == 0 && far <= share && lengthRatio < kLongestRatio;
}

namespace {

/// [px] Along the points of a piece, over chords of several: the noise of single points makes no length.
double lengthAlongPoints(const ConstructPiece& piece) {
  constexpr int kStride = 4;
  const auto& points = piece.points;
  const int n = static_cast<int>(points.size());
  if (n == 0) return 0.0;
  double length = 0.0;
  for (int i = kStride; i < n; i += kStride) length += (points[i].at - points[i - kStride].at).norm();
  length += (points[n - 1].at - points[(n - 1) / kStride * kStride].at).norm();
  return piece.closed ? length + (points.front().at - points.back().at).norm() : length;
}

}  // namespace

PointDeviation pointDeviation(const NurbsCurve& curve, const ConstructPiece& piece, CancelCheck check) {
  PointDeviation result;
  std::vector<Vec2> polygon;
  std::vector<double> parameter;
  double length = 0.0;
  const auto breaks = curve.breaks();
  for (std::size_t j = 0; j + 1 < breaks.size(); ++j) {
    const double width = breaks[j + 1] - breaks[j];
    const int steps = std::clamp(static_cast<int>(width / kChordPx), kFewestChords, kMostChords);
    for (int i = 0; i < steps; ++i) parameter.push_back(breaks[j] + width * i / steps);
  }
  parameter.push_back(breaks.back());
  polygon.reserve(parameter.size());
  for (const double u : parameter) polygon.push_back(curve.point(u));
  for (std::size_t i = 1; i < polygon.size(); ++i) length += (polygon[i] - polygon[i - 1]).norm();
  const int n = static_cast<int>(piece.points.size());
  result.lengthRatio = length / (lengthAlongPoints(piece) + kLoosePx);
  std::size_t at = 0;
  if (piece.closed && n > 0) {
    follow(polygon, piece.points.front().at, at, 2 * polygon.size());
  }
  double along = 0.0;
  for (const PiecePoint& point : piece.points) {
    if (check.isCancelled()) return {};
    const Vec2& p = point.at;
    Passing d = follow(polygon, p, at, kReach);
    if (d.distance > kBackPx) {
      if (const Passing further = follow(polygon, p, at, kFarReach); further.distance < d.distance) d = further;
    }
    if (piece.closed && (at < 2 || at + 2 >= polygon.size())) {
      std::size_t other = at < 2 ? polygon.size() - 1 : 0;
      const Passing round = follow(polygon, p, other, kReach);
      if (round.distance < d.distance) d = round, at = other;
    }
    PointOffset& offset = result.points.emplace_back();
    offset.offPx = d.distance;
    // Between merged strokes the line may lie anywhere, and grain scatters the points of a single one.
    const double allowed = std::max(static_cast<double>(point.spreadPx.value_or(0.0f)), grainReach(piece));
    offset.distancePx = std::max(0.0, d.distance - allowed);
    const int low = std::min(static_cast<int>(d.place), static_cast<int>(parameter.size()) - 2);
    offset.parameter = std::lerp(parameter[low], parameter[low + 1], d.place - low);
    along += offset.distancePx;
  }
  if (!std::isfinite(along)) result.veryFar = n + 1;
  for (int i = 0; i < n; ++i) {
    const auto near = [&](double limit) {
      int count = 0;
      for (int k = std::max(0, i - kBeside); k <= std::min(n - 1, i + kBeside); ++k)
        count += result.points[k].distancePx > limit;
      return count >= kMajority;
    };
    if (result.points[i].distancePx > kFarPx && near(kFarPx)) ++result.far;
    if (result.points[i].distancePx > kVeryFarPx && near(kVeryFarPx)) ++result.veryFar;
  }
  return result;
}

std::vector<PointRange> outlierRanges(const PointDeviation& close, const ConstructPiece& piece, bool whole) {
  std::vector<PointRange> out;
  const int n = static_cast<int>(piece.points.size());
  if (n < kFewestPoints) return out;
  const bool outliers =
      std::ranges::any_of(close.points, [](const PointOffset& p) { return !(p.distancePx <= kOutlierPx); });
  if (!outliers && close.lengthRatio < kLongestRatio) return out;
  const Course course = courseOf(piece, 0.0);
  const std::vector<double> angle = turning(course, armOf(course, piece));
  if (course.count() != n) return {{0, n - 1}};
  const auto distance = [&](int i) { return close.points[((i % n) + n) % n].distancePx; };
  const auto middle = [&](int i) {
    std::array<double, 2 * kBeside + 1> d{};
    for (int k = -kBeside; k <= kBeside; ++k) {
      d[k + kBeside] = distance(piece.closed ? i + k : std::clamp(i + k, 0, n - 1));
    }
    return upperMedian(d);
  };
  for (int i = 0; i < n; ++i) {
    if (!(middle(i) > kOutlierPx)) continue;
    int a = i, b = i;
    const auto isOff = [&](int k) {
      // What is cut out of a fit ends where the fit itself is back on the points.
      return (whole ? close.points[k].offPx - grainReach(piece) : middle(k)) > kBackPx;
    };
    while (a > 0 && isOff(a - 1)) --a;
    while (b + 1 < n && isOff(b + 1)) ++b;
    i = b;
    if (!whole && course.length(b) - course.length(a) > kLongRunPx) {
      const auto first = angle.begin() + a, last = angle.begin() + b + 1;
      a = b = static_cast<int>(std::max_element(first, last) - angle.begin());
    }
    out.push_back(widened(course, piece, a, b, 2.0 * kMarginPx));
  }
  if (out.empty() && close.lengthRatio >= kLongestRatio) out.push_back({0, n - 1});
  return out;
}

}  // namespace batten
