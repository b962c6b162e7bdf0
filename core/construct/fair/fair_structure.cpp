// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_structure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "core/solve/banded_program.h"

namespace batten {
namespace {

// Half-width of the window of an extremum: of the way to the next one, of its stretch, and at least.
constexpr double kWindowShare = 0.25, kStretchShare = 0.8, kWindowMinPx = 8.0;
constexpr double kWindowsApart = 0.45;  // of the distance of neighbouring extrema: half a window is no wider
constexpr double kRecentre = 0.7;       // of the half width
constexpr double kLocalReachPx = 640;   // far beyond any correlation that matters
constexpr double kMostStretches =
    4.0;                         // widest windows: a slope of the curvature is followed no farther to either side
constexpr int kOwnColumns = 6;   // coefficients of a quintic at one place
constexpr int kWholeFifths = 4;  // fifths of a line: to solve for a larger part is no faster than for all
constexpr int kRounds = 4;       // one solution and three recentrings

double slopeAt(const FrameStation& s, const Eigen::VectorXd& c) { return s.slope + dot(s.slopeRow, c); }
double bendAt(const FrameStation& s, const Eigen::VectorXd& c) { return s.bend + dot(s.bendRow, c); }

/// Check stations by number, running round closed curves.
struct Stations {
  const FairFrame& frame;
  int count = static_cast<int>(frame.checks.size());
  bool closed = frame.base.knots().closed;
  double step = frame.base.knots().length / (closed ? count : count - 1);

  bool has(int j) const { return closed || (j >= 0 && j < count); }
  const FrameStation& operator[](int j) const { return frame.checks[((j % count) + count) % count]; }
};

/// Where the slope goes through zero between stations j and j + 1, and the curvature there (cubic by both slopes).
FairExtremum crossing(const Stations& stations, int j, const Eigen::VectorXd& c, double slope, double nextSlope) {
  FairExtremum e;
  const double x = slope / (slope - nextSlope);
  const double h = stations.step, length = stations.frame.base.knots().length;
  e.u = (j + x) * h;
  if (stations.closed) e.u -= length * std::floor(e.u / length);
  const double k0 = kappaAt(stations[j], c), k1 = kappaAt(stations[j + 1], c);
  const double s = x * x * (3.0 - 2.0 * x);
  e.kappa = k0 + (k1 - k0) * s + h * (slope * x * (1.0 - x) * (1.0 - x) + nextSlope * x * x * (x - 1.0));
  e.maximum = slope > 0.0;
  return e;
}

/// Moves every extremum to where it now is within its window. True if one is near the border of its window.
bool followExtrema(const Stations& stations, FairStructure& structure, const Eigen::VectorXd& c) {
  bool moved = false;
  const double length = stations.frame.base.knots().length;
  for (FairExtremum& e : structure.extrema) {
    const double sign = e.maximum ? 1.0 : -1.0;
    const int first = static_cast<int>(std::floor((e.u - e.halfWidth) / stations.step)) - 1;
    const int last = static_cast<int>(std::ceil((e.u + e.halfWidth) / stations.step)) + 1;
    double best = -std::numeric_limits<double>::infinity(), u = e.u, kappa = e.kappa;
    for (int j = first; j <= last; ++j) {
      if (!stations.has(j)) continue;
      const double here = kappaAt(stations[j], c);
      if (sign * here > best) best = sign * here, u = j * stations.step, kappa = here;
      if (j == last || !stations.has(j + 1)) continue;
      const double slope = slopeAt(stations[j], c), next = slopeAt(stations[j + 1], c);
      if (!(sign * slope > 0.0 && sign * next <= 0.0)) continue;
      const FairExtremum found = crossing(stations, j, c, slope, next);
      if (sign * found.kappa >= best) best = sign * found.kappa, u = found.u, kappa = found.kappa;
    }
    double shift = u - e.u;
    if (stations.closed) shift -= length * std::round(shift / length);
    if (std::abs(shift) > kRecentre * e.halfWidth) moved = true;
    e.u += shift;
    if (stations.closed) e.u -= length * std::floor(e.u / length);
    e.kappa = kappa;
  }
  const auto byPlace = [](const FairExtremum& a, const FairExtremum& b) { return a.u < b.u; };
  std::sort(structure.extrema.begin(), structure.extrema.end(), byPlace);
  return moved;
}

/// Adds the sign constraint of one station: bending one way inside a window, rising or falling outside.
void addConstraint(BandedProgram& qp, const FrameStation& station, const FairStructure& structure,
                   const UniformKnots& knots, int firstColumn, int columns) {
  const auto& extrema = structure.extrema;
  if (extrema.empty() && knots.closed) return;
  int firstOwn = station.slopeRow.first;
  if (columns < knots.coefficients()) {
    const int n = knots.coefficients();
    firstOwn = ((firstOwn - firstColumn) % n + n) % n;
    if (firstOwn + kOwnColumns > columns) return;
  }
  const FairExtremum* window = nullptr;
  bool rising = structure.rising;
  std::size_t stretch = 0;
  double away = kWidestWindowPx,
         gentle = 1.0;  // px beyond the windows on either side, px over which the slope may set in
  if (!extrema.empty()) {
    const auto notBefore = [&](const FairExtremum& e, double u) { return e.u + e.halfWidth < u; };
    const auto next = std::lower_bound(extrema.begin(), extrema.end(), station.u, notBefore);
    const FairExtremum& last = extrema.back();
    const FairExtremum& first = extrema.front();
    stretch = next == extrema.end() && knots.closed ? 0 : next - extrema.begin();
    const auto consider = [&](const FairExtremum& e, double u) {
      const double distance = std::abs(u - e.u) - e.halfWidth;
      if (distance < away) away = distance, gentle = e.halfWidth;
    };
    if (next != extrema.end()) consider(*next, station.u);
    if (next != extrema.begin()) consider(*std::prev(next), station.u);
    if (knots.closed && next == extrema.end()) consider(first, station.u - knots.length);
    if (knots.closed && next == extrema.begin()) consider(last, station.u + knots.length);
    if (next != extrema.end()) {
      if (station.u >= next->u - next->halfWidth) window = &*next;
      rising = next->maximum;
    } else if (knots.closed) {
      if (station.u - knots.length >= first.u - first.halfWidth) window = &first;
      rising = first.maximum;
    } else {
      rising = !last.maximum;
    }
    if (knots.closed && !window && station.u + knots.length <= last.u + last.halfWidth) window = &last;
  }
  BandRow row = window ? station.bendRow : station.slopeRow;
  const double sign = window ? (window->maximum ? -1.0 : 1.0) : (rising ? 1.0 : -1.0);
  row.first = firstOwn;
  for (double& v : row.v) v *= sign;
  qp.rows.push_back(row);
  double least = 0.0;
  if (!window && stretch < structure.leastSlope.size()) {
    least = structure.leastSlope[stretch] * std::clamp(away / gentle, 0.0, 1.0);
  }
  qp.bounds.push_back(least - sign * (window ? station.bend : station.slope));
}

/// The columns that a program solves for.
struct Part {
  int first = 0, count = 0;
  bool whole = true;
};

Part choosePart(const UniformKnots& knots, const std::optional<StructureStretch>& stretch) {
  const int n = knots.coefficients();
  Part part{0, n, true};
  if (!stretch) return part;
  int first = static_cast<int>(std::floor((stretch->from - kLocalReachPx) / knots.spacing()));
  int last = static_cast<int>(std::ceil((stretch->to + kLocalReachPx) / knots.spacing())) + kOwnColumns;
  if (!knots.closed) {
    first = std::max(first, 0);
    last = std::min(last, n);
  }
  if (last - first > kWholeFifths * n / 5 || last - first < 2 * kOwnColumns) return part;
  return {((first % n) + n) % n, last - first, false};
}

BandedProgram makeProgram(const FairFrame& frame, const FairPosterior& posterior, const Part& part,
                          const Eigen::VectorXd& start) {
  BandedProgram qp;
  if (part.whole) {
    qp.a = posterior.a;
    qp.b = posterior.b;
    return qp;
  }
  const int n = posterior.a.size();
  const bool closed = frame.base.knots().closed;
  qp.a = posterior.a.block(part.first, part.count);
  qp.b.resize(part.count);
  for (int i = 0; i < part.count; ++i) {
    const int at = (part.first + i) % n;
    double b = posterior.b[at];
    for (int k = 1; k <= BandRow::kHalfWidth; ++k) {
      if (i + k >= part.count && (closed || at + k < n)) b -= posterior.a.entry(at, k) * start[(at + k) % n];
      if (i - k < 0 && (closed || at - k >= 0)) {
        const int left = (at - k + n) % n;
        b -= posterior.a.entry(left, k) * start[left];
      }
    }
    qp.b[i] = b;
  }
  return qp;
}

}  // namespace

FairStructure localExtrema(const FairFrame& frame, const Eigen::VectorXd& c) {
  FairStructure structure;
  const Stations stations{frame};
  const int pairs = stations.closed ? stations.count : stations.count - 1;
  double slope = slopeAt(stations[0], c);
  for (int j = 0; j < pairs; ++j) {
    const double next = slopeAt(stations[j + 1], c);
    if ((slope > 0.0) != (next > 0.0)) {
      FairExtremum e = crossing(stations, j, c, slope, next);
      const double sign = e.maximum ? -1.0 : 1.0;
      int left = j, right = j + 1;
      const int reach = static_cast<int>(kMostStretches * kWidestWindowPx / stations.step);
      while (j - left < reach && stations.has(left) && sign * bendAt(stations[left], c) > 0.0) --left;
      while (right - j < reach && stations.has(right) && sign * bendAt(stations[right], c) > 0.0) ++right;
      e.stretch = 0.5 * (right - left - 1) * stations.step;
      e.id = static_cast<int>(structure.extrema.size());
      structure.extrema.push_back(e);
    }
    slope = next;
  }
  std::sort(structure.extrema.begin(), structure.extrema.end(),
            [](const FairExtremum& a, const FairExtremum& b) { return a.u < b.u; });
  const int end = stations.closed ? 0 : stations.count - 1;
  structure.rising = structure.extrema.empty() ? kappaAt(stations[end], c) >= kappaAt(stations[0], c)
                                               : structure.extrema.front().maximum;
  return structure;
}

void setWindows(FairStructure& structure, const UniformKnots& knots) {
  auto& extrema = structure.extrema;
  const auto count = extrema.size();
  for (std::size_t i = 0; i < count; ++i) {
    FairExtremum& e = extrema[i];
    const double infinite = std::numeric_limits<double>::infinity();
    double before = i > 0 ? e.u - extrema[i - 1].u : infinite;
    double after = i + 1 < count ? extrema[i + 1].u - e.u : infinite;
    if (knots.closed && i == 0) before = e.u + knots.length - extrema.back().u;
    if (knots.closed && i + 1 == count) after = extrema.front().u + knots.length - e.u;
    double nearest = std::min(before, after);
    const double limit = kWindowsApart * nearest;
    if (!knots.closed) nearest = std::min({nearest, e.u, knots.length - e.u});
    e.halfWidth =
        std::clamp(std::min(kWindowShare * nearest, kStretchShare * e.stretch), kWindowMinPx, kWidestWindowPx);
    e.halfWidth = std::min(e.halfWidth, limit);
  }
}

std::optional<StructureFit> fitStructure(const FairFrame& frame, const FairPosterior& posterior,
                                         FairStructure& structure, const Eigen::VectorXd& start,
                                         const StructureScope& scope, CancelCheck check) {
  const UniformKnots& knots = frame.base.knots();
  const Part part = choosePart(knots, scope.stretch);
  BandedProgram qp = makeProgram(frame, posterior, part, start);
  Eigen::VectorXd local(part.count);
  for (int i = 0; i < part.count; ++i) local[i] = start[(part.first + i) % knots.coefficients()];
  const double reference = local.dot(qp.a * local) - 2.0 * qp.b.dot(local);
  StructureFit fit;
  InteriorPointLimits limits;
  limits.abortAbove = reference + scope.abortRise;
  const int rounds = structure.leastSlope.empty() ? kRounds : 1;  // slopes are asked for once all is in place
  for (int round = 0; round < rounds; ++round) {
    setWindows(structure, knots);
    qp.rows.clear();
    qp.bounds.clear();
    for (const FrameStation& s : frame.checks) addConstraint(qp, s, structure, knots, part.first, part.count);
    const InteriorPointResult result = solveProgram(qp, limits, check);
    if (check.isCancelled()) return std::nullopt;
    fit.rise = result.objective - reference;
    if (result.why == Termination::ToleranceLimited) {
      fit.aborted = true;
      fit.rise = result.lowerBound - reference;
      return fit;
    }
    if (result.why == Termination::Degenerate || !result.x.allFinite()) return std::nullopt;
    fit.converged = result.why == Termination::Converged || result.why == Termination::Exact;
    fit.c = start;
    for (int i = 0; i < part.count; ++i) fit.c[(part.first + i) % knots.coefficients()] = result.x[i];
    if (!followExtrema(Stations{frame}, structure, fit.c)) break;
  }
  return fit;
}

}  // namespace batten
