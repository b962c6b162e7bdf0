// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/rectify/sheet_corners.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/base/interpolation.h"
#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kEdgeEndShare = 0.06;                    // of the edge at either end: the next edge and bent corners
constexpr double kEdgeStationPx = 5.0;                    // along the edge
constexpr int kFewestStations = 24, kMostStations = 300;  // of an edge, whatever its length
constexpr double kSampleDistancePx = 1.5;                 // along the edge, of the profiles that make that of a station
constexpr int kMostSamples = 12;                          // of them: noise is small by then
// [steps across the edge] In the mean on either side of a change: the fewest that noise allows, the most that a blurred
// edge takes.
constexpr std::ptrdiff_t kFewestInMean = 3, kMostInMean = 12;
constexpr double kAcrossEdgePx = 0.5;     // across it
constexpr double kLeastOnEdge = 0.45;     // of the stations lie on the line
constexpr double kWeakShareOfStep = 0.4;  // of the median step: nothing is seen there
constexpr double kLeastStepOfEdge = 1.5;  // [grey]
constexpr double kFineReachPx = 9.0;      // of the second look
constexpr double kTightestPx = 0.8;       // of what counts as on the line
constexpr double kOnLineSigmas = 2.5;     // of the stations: what is farther off is not on the line
constexpr int kLinesTried = 60;           // through each of as many stations and all others of them
constexpr int kEdgeFitRounds = 3;         // which stations lie on the line hardly changes after them
constexpr double kLeastOfTerms = 1e-9;    // [sightings] a prior: the matrix has an inverse with hardly any sighting
constexpr double kPerPixel = 100.0;  // corners are rounded to a hundredth, so that files and messages show them whole

/// Grey, and what red and blue differ from it.
class Tints {
 public:
  Tints(const GreyImage& grey, const ColourImage& colour) : grey_(grey), colour_(colour) {}
  int channels() const { return colour_.isEmpty() ? 1 : 3; }
  bool has(const Vec2& px) const {
    return px.x() >= 0.0 && px.y() >= 0.0 && px.x() <= grey_.width && px.y() <= grey_.height;
  }
  /// Bilinear between pixels.
  double at(const Vec2& px, int channel) const {
    const BilinearPlace place(grey_.width, grey_.height, px.x() - 0.5, px.y() - 0.5);
    return place.of([&](int x, int y) { return pixel(x, y, channel); });
  }

 private:
  double pixel(int x, int y, int channel) const {
    const double level = grey_.level(x, y);
    if (channel == 0) return level;
    const Rgb8& colour = colour_.row(y)[x];
    return (channel == 1 ? colour.red : colour.blue) - level;
  }
  const GreyImage& grey_;
  const ColourImage& colour_;
};

struct EdgeLine {
  Vec2 from, to;
  Vec2 inward() const { return leftNormal(to - from).normalized(); }  // y down, clockwise: the left normal points in
};

/// Where the edge is seen: along the line from -1 to 1, and [px] how far inside of it.
struct Sighting {
  double along = 0.0, inside = 0.0;
};

/// What a stretch of the edge shows across it.
struct EdgeProfile {
  double along = 0.0;
  std::vector<double> levels;  // from outside to inside, kAcrossEdgePx apart
};

double lengthLookedAt(const EdgeLine& line) { return (line.to - line.from).norm() * (1.0 - 2.0 * kEdgeEndShare); }

int stationsAlong(const EdgeLine& line) {
  return std::clamp(static_cast<int>(lengthLookedAt(line) / kEdgeStationPx), kFewestStations, kMostStations);
}

std::vector<EdgeProfile> profilesAlong(const EdgeLine& line, double reachPx, int channel, const Tints& tints) {
  const int stations = stationsAlong(line);
  const int samples =
      std::clamp(static_cast<int>(lengthLookedAt(line) / stations / kSampleDistancePx), 1, kMostSamples);
  const int half = static_cast<int>(std::ceil(reachPx / kAcrossEdgePx));
  std::vector<EdgeProfile> profiles;
  for (int i = 0; i < stations; ++i) {
    EdgeProfile profile{2.0 * (i + 0.5) / stations - 1.0, std::vector<double>(2 * half + 1, 0.0)};
    bool isInside = true;
    for (int k = 0; k < samples; ++k) {
      const double share = kEdgeEndShare + (1.0 - 2.0 * kEdgeEndShare) * (i + (k + 0.5) / samples) / stations;
      const Vec2 on = line.from + share * (line.to - line.from);
      isInside = isInside && tints.has(on - reachPx * line.inward()) && tints.has(on + reachPx * line.inward());
      if (!isInside) break;
      for (int j = -half; j <= half; ++j)
        profile.levels[j + half] += tints.at(on + j * kAcrossEdgePx * line.inward(), channel) / samples;
    }
    if (isInside) profiles.push_back(std::move(profile));
  }
  return profiles;
}

double meanLevel(const std::vector<double>& values, std::ptrdiff_t begin, std::ptrdiff_t end) {
  double sum = 0.0;
  for (std::ptrdiff_t i = begin; i < end; ++i) sum += values[i];
  return sum / static_cast<double>(end - begin);
}

/// Inside less outside, away from the edge itself.
double stepAcross(const EdgeProfile& profile) {
  const std::ptrdiff_t n = std::ssize(profile.levels), third = n / 3;
  return meanLevel(profile.levels, n - third, n) - meanLevel(profile.levels, 0, third);
}

double medianStepAcross(const std::vector<EdgeProfile>& profiles) {
  std::vector<double> steps;
  steps.reserve(profiles.size());
  for (const EdgeProfile& profile : profiles) steps.push_back(stepAcross(profile));
  return steps.empty() ? 0.0 : upperMedian(steps);
}

/// Where the level passes half way, beside the place where it changes most in the direction of `sign`.
struct EdgeChange {
  double place = 0.0, step = 0.0;  // place: in steps from the first
};
EdgeChange greatestChange(const EdgeProfile& profile, double sign, std::ptrdiff_t width) {
  const auto& levels = profile.levels;
  const auto stepAt = [&](std::ptrdiff_t i) {
    return sign * (meanLevel(levels, i + 1, i + 1 + width) - meanLevel(levels, i - width, i));
  };
  std::ptrdiff_t best = width;
  double greatest = stepAt(best);
  for (std::ptrdiff_t i = best + 1; i + width < std::ssize(levels); ++i) {
    const double step = stepAt(i);
    if (step > greatest) greatest = step, best = i;
  }
  const std::ptrdiff_t outer = std::max<std::ptrdiff_t>(1, width / 2);
  const double outside = meanLevel(levels, best - width, best - width + outer);
  const double inside = meanLevel(levels, best + width + 1 - outer, best + width + 1);
  const double middle = 0.5 * (outside + inside);
  EdgeChange change{static_cast<double>(best), greatest};
  std::optional<double> nearest;
  for (std::ptrdiff_t i = best - width; i < best + width; ++i) {
    const double a = sign * (levels[i] - middle), b = sign * (levels[i + 1] - middle);
    if (!(a <= 0.0 && b > 0.0)) continue;
    const double place = static_cast<double>(i) + a / (a - b);
    const double distance = std::abs(place - static_cast<double>(best));
    if (nearest && distance >= *nearest) continue;
    nearest = distance;
    change.place = place;
  }
  return change;
}

std::vector<Sighting> sightings(const EdgeLine& line, double reachPx, const Tints& tints) {
  std::vector<EdgeProfile> clearest;
  for (int channel = 0; channel < tints.channels(); ++channel) {
    std::vector<EdgeProfile> profiles = profilesAlong(line, reachPx, channel, tints);
    if (clearest.empty() || std::abs(medianStepAcross(profiles)) > std::abs(medianStepAcross(clearest)))
      clearest = std::move(profiles);
  }
  const double step = medianStepAcross(clearest);
  if (std::abs(step) < kLeastStepOfEdge) return {};
  const auto width = std::clamp<std::ptrdiff_t>(std::lround(reachPx / 3.0 / kAcrossEdgePx), kFewestInMean, kMostInMean);
  std::vector<Sighting> found;
  const double half = std::ceil(reachPx / kAcrossEdgePx);
  for (const EdgeProfile& profile : clearest) {
    const EdgeChange change = greatestChange(profile, step > 0.0 ? 1.0 : -1.0, width);
    if (change.step >= kWeakShareOfStep * std::abs(step))
      found.push_back({profile.along, (change.place - half) * kAcrossEdgePx});
  }
  return found;
}

/// inside = at + slope * along + bend * (along^2 - 1/3)
struct FittedEdge {
  double at = 0.0, slope = 0.0, bend = 0.0, sigma = 0.0;
  std::ptrdiff_t seen = 0;
  double offset(const Sighting& s) const { return s.inside - at - slope * s.along; }
};

/// The line from which the middle one of the distances is least.
/// @pre at least two sightings.
FittedEdge leastMedianLine(const std::vector<Sighting>& all) {
  const std::size_t step = std::max<std::size_t>(1, all.size() / kLinesTried);
  FittedEdge best;
  std::optional<double> least;
  std::vector<double> distances;
  for (std::size_t i = 0; i < all.size(); i += step) {
    for (std::size_t j = i + step; j < all.size(); j += step) {
      FittedEdge line;
      line.slope = (all[j].inside - all[i].inside) / (all[j].along - all[i].along);
      line.at = all[i].inside - line.slope * all[i].along;
      distances.clear();
      for (std::size_t k = 0; k < all.size(); k += step) distances.push_back(std::abs(line.offset(all[k])));
      const double median = upperMedian(distances);
      if (!least || median < *least) least = median, best = line, best.sigma = kSigmaPerMad * median;
    }
  }
  return best;
}

/// Through those that lie on the line, by least squares, and again through those that lie on the new one.
FittedEdge fittedEdge(const std::vector<Sighting>& all) {
  FittedEdge edge = leastMedianLine(all);
  for (int round = 0; round < kEdgeFitRounds; ++round) {
    const double on = std::max(kTightestPx, kOnLineSigmas * edge.sigma);
    Eigen::Matrix3d normal = kLeastOfTerms * Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    edge.seen = 0;
    for (const Sighting& s : all) {
      if (std::abs(edge.offset(s)) > on) continue;
      const Eigen::Vector3d row(1.0, s.along, s.along * s.along - 1.0 / 3.0);
      normal += row * row.transpose();
      right += s.inside * row;
      ++edge.seen;
    }
    // The straight line alone; how much it bends is only told.
    const Eigen::Vector2d line = normal.topLeftCorner<2, 2>().inverse() * right.head<2>();
    edge.bend = (normal.inverse() * right)(2);
    edge.at = line(0);
    edge.slope = line(1);
  }
  return edge;
}

EdgeLine movedOnto(const EdgeLine& line, const FittedEdge& edge) {
  // `along` is -1 and 1 where the ends that are left out begin.
  const double end = 1.0 / (1.0 - 2.0 * kEdgeEndShare);
  return {line.from + (edge.at - end * edge.slope) * line.inward(),
          line.to + (edge.at + end * edge.slope) * line.inward()};
}

Vec2 crossingOf(const EdgeLine& a, const EdgeLine& b) {
  const Vec2 along = a.to - a.from, other = b.to - b.from;
  return a.from + cross(b.from - a.from, other) / cross(along, other) * along;
}

struct SeenEdge {
  EdgeLine line;
  double bendPx = 0.0;
};
/// The edge within `reachPx` of a line, looked at a second time from near by. Absent: it is not to be seen.
std::optional<SeenEdge> edgeNear(const EdgeLine& rough, double reachPx, const Tints& tints) {
  SeenEdge edge{rough, 0.0};
  for (const bool isFine : {false, true}) {
    const double reach = isFine ? std::min(reachPx, kFineReachPx + edge.bendPx) : reachPx;
    const std::vector<Sighting> seen = sightings(edge.line, reach, tints);
    if (std::ssize(seen) < kFewestStations / 2) return std::nullopt;
    const FittedEdge fitted = fittedEdge(seen);
    if (static_cast<double>(fitted.seen) < kLeastOnEdge * stationsAlong(edge.line)) return std::nullopt;
    edge = {movedOnto(edge.line, fitted), std::abs(fitted.bend)};
  }
  return edge;
}

Result<FoundCorners> notSeen(std::size_t side) {
  constexpr std::array kNames = {"upper", "right", "lower", "left"};  // of the sides, in their order
  return fail(ErrorCode::UnreadableScan,
              std::string("The ") + kNames[side] +
                  " edge of the sheet is not seen clearly enough on the picture; state its corners instead: "
                  "paper.rectify=X,Y,X,Y,X,Y,X,Y.");
}

}  // namespace

Result<FoundCorners> sheetCorners(const GreyImage& grey, const ColourImage& colour, const SheetCorners& roughPx,
                                  double reachPx, const RunContext& context) {
  const Tints tints(grey, colour);
  std::array<EdgeLine, 4> edges;
  FoundCorners found;
  for (std::size_t side = 0; side < edges.size(); ++side) {
    if (context.isCancelled()) return cancelled();
    const auto edge = edgeNear({roughPx[side], roughPx[(side + 1) % 4]}, reachPx, tints);
    if (!edge) return notSeen(side);
    found.bendPx = std::max(found.bendPx, edge->bendPx);
    edges[side] = edge->line;
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Vec2 corner = crossingOf(edges[(i + 3) % 4], edges[i]);
    found.cornersPx[i] = (corner * kPerPixel).array().round() / kPerPixel;
  }
  return found;
}

std::array<bool, 4> paperEdges(const GreyImage& grey, const ColourImage& colour, const SheetCorners& cornersPx,
                               double reachPx, const RunContext& context) {
  const Tints tints(grey, colour);
  std::array<bool, 4> isSeen{};
  for (std::size_t side = 0; side < isSeen.size() && !context.isCancelled(); ++side)
    isSeen[side] = edgeNear({cornersPx[side], cornersPx[(side + 1) % 4]}, reachPx, tints).has_value();
  return isSeen;
}

}  // namespace batten
