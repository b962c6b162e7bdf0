// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/stations/piece_stations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/curve/knot_operations.h"

namespace batten {

namespace {

/// Of the spacing: a first station farther from the start of the piece is not the start, if the start lies behind it
/// (the cosine of the angle between the gap and its direction is more than kAhead).
constexpr double kStandsAway = 0.25, kAhead = 0.5;
constexpr int kFewestMeasured = 8;  ///< Stations measured round a closed line that has too few of its own.

double diagonal(std::span<const Vec2> points) {
  if (points.empty()) return 0.0;
  Vec2 low = points.front(), high = low;
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

Station stationAt(const Vec2& point, const Vec2& direction) { return {point, direction, point, point}; }

/// `d` mirrored on the chord: the direction at the other end of the circular arc over the chord.
Vec2 mirrored(const Vec2& d, const Vec2& chord) {
  const Vec2 c = chord.normalized();
  return 2.0 * d.dot(c) * c - d;
}

/// Stations at equal polygon length around a closed contour, directions across one step of either side.
std::vector<Station> measuredAround(std::span<const Vec2> points, int count) {
  std::vector<double> length = {0.0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    length.push_back(length.back() + (points[(i + 1) % points.size()] - points[i]).norm());
  }
  const auto at = [&](double s) {
    s = std::fmod(s + length.back(), length.back());
    const auto past = std::upper_bound(length.begin(), length.end(), s) - length.begin();
    const std::ptrdiff_t i = std::min(past, std::ssize(points)) - 1;
    const double step = length[i + 1] - length[i];
    const double f = step > 0.0 ? (s - length[i]) / step : 0.0;
    return Vec2((1.0 - f) * points[i] + f * points[(i + 1) % points.size()]);
  };
  std::vector<Station> stations;
  const double step = length.back() / count;
  for (int i = 0; i < count; ++i) {
    const Vec2 ahead = at(step * (i + 0.5)) - at(step * (i - 0.5));
    if (!(ahead.norm() > 0.0)) continue;
    stations.push_back(stationAt(at(step * i), ahead.normalized()));
    stations.back().along = static_cast<double>(i) / count;
  }
  return stations;
}

/// Drops coincident stations and repairs zero directions.
std::vector<Station> cleaned(std::span<const Station> stations, double tooNear) {
  std::vector<Station> result;
  for (const Station& s : stations) {
    if (!s.point.allFinite()) continue;
    if (!result.empty() && !((s.point - result.back().point).norm() > tooNear)) continue;
    result.push_back(s);
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    Vec2& d = result[i].direction;
    if (!d.allFinite() || !(d.norm() > 1e-9)) {
      d = result[std::min(i + 1, result.size() - 1)].point - result[i > 0 ? i - 1 : 0].point;
    }
    d = d.norm() > 0.0 ? Vec2(d.normalized()) : Vec2::UnitX();
  }
  return result;
}

/// Sees to it that the first station is the start of the piece.
void settleStart(std::vector<Station>& stations, const Vec2& start, bool corner, double along) {
  const Vec2 gap = stations.front().point - start;
  const double spacing = stations.size() > 1 ? (stations[1].point - stations[0].point).norm() : gap.norm();
  if (gap.norm() > kStandsAway * spacing && gap.dot(stations.front().direction) > kAhead * gap.norm()) {
    // What was first stands away from where it was measured.
    stations.front().along.reset();
    stations.insert(stations.begin(), stationAt(start, mirrored(stations.front().direction, gap)));
    stations.front().along = along;
  } else if (corner) {
    stations.front().point = start;
  }
}

void reverseStations(std::vector<Station>& stations) {
  std::reverse(stations.begin(), stations.end());
  for (Station& s : stations) s.direction = -s.direction;
}

}  // namespace

std::vector<Station> usableStations(const ConstructPiece& piece, int fewestClosed, ConstructEnds ends) {
  std::vector<Vec2> all = positionsOf(piece.points);
  for (const Station& s : piece.stations) {
    if (s.point.allFinite()) all.push_back(s.point);
  }
  const double size = diagonal(all), tooNear = 1e-9 * size;
  std::vector<Station> stations = cleaned(piece.stations, tooNear);
  if (piece.closed) {
    if (stations.size() > 1 && (stations.front().point - stations.back().point).norm() <= tooNear) stations.pop_back();
    if (static_cast<int>(stations.size()) < fewestClosed && piece.points.size() >= 3 && size > 0.0) {
      stations = cleaned(measuredAround(positionsOf(piece.points), std::max(kFewestMeasured, fewestClosed)), tooNear);
    }
    return stations;
  }
  if (stations.empty() || piece.points.size() < 2 || ends == ConstructEnds::Stations) return stations;
  settleStart(stations, piece.points.front().at, piece.startIsCorner, 0.0);
  reverseStations(stations);
  settleStart(stations, piece.points.back().at, piece.endIsCorner, 1.0);
  reverseStations(stations);
  return cleaned(stations, tooNear);
}

std::vector<double> arcCorrectedDistances(std::span<const Station> stations, bool closed) {
  std::vector<double> distances;
  const std::size_t m = stations.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < m; ++i) {
    const Station &a = stations[i], &b = stations[(i + 1) % m];
    const double half = 0.5 * std::abs(std::atan2(cross(a.direction, b.direction), a.direction.dot(b.direction)));
    const double stretch = half > 1e-4 ? half / std::sin(half) : 1.0 + half * half / 6.0;
    distances.push_back((b.point - a.point).norm() * stretch);
  }
  return distances;
}

Result<ConstructedPiece> straightPiece(const ConstructPiece& piece, const std::string& note) {
  std::vector<Vec2> ends;
  if (piece.points.size() >= 2) {
    ends = {piece.points.front().at, piece.points.back().at};
  } else if (piece.stations.size() >= 2) {
    ends = {piece.stations.front().point, piece.stations.back().point};
  }
  const double length = ends.empty() || piece.closed ? 0.0 : (ends[1] - ends[0]).norm();
  if (!(length > 0.0) || !std::isfinite(length)) {
    return fail(
        ErrorCode::Numerical,
        "A line is too short to construct a curve from: raise the smallest length of contours, or remove a corner "
        "mark.");
  }
  std::vector<Vec2> points;
  for (int i = 0; i <= 5; ++i) points.emplace_back(ends[0] + (ends[1] - ends[0]) * (i / 5.0));
  points.back() = ends[1];
  std::vector<double> knots(6, 0.0);
  knots.insert(knots.end(), 6, length);
  auto curve = NurbsCurve::make(5, std::move(knots), std::move(points));
  if (!curve) return fail(curve.error());
  ConstructedPiece result{std::move(*curve), {}};
  result.report.why = Termination::Degenerate;
  result.report.note = note;
  return result;
}

Result<NurbsCurve> clampedWithEnds(const NurbsCurve& curve, const Vec2& start, const Vec2& end) {
  auto ends = clamped(curve);
  if (!ends) return ends;
  std::vector<Vec2> points(ends->controlPoints().begin(), ends->controlPoints().end());
  points.front() = start;
  points.back() = end;
  return NurbsCurve::make(ends->degree(), {ends->knots().begin(), ends->knots().end()}, std::move(points));
}

}  // namespace batten
