// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/segment_foot.h"
#include "core/construct/bezier/bezier_chain.h"
#include "core/construct/stations/piece_stations.h"
#include "core/construct/typical/typical_growing.h"
#include "core/construct/typical/typical_line.h"
#include "core/construct/typical/typical_path_fit.h"
#include "core/construct/typical/typical_path_geometry.h"
#include "core/construct/typical/typical_rough_path.h"
#include "core/construct/typical/typical_structure.h"
#include "core/construct/typical/typical_tiling.h"
#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"

namespace batten {

namespace {

/// Standard deviations of the noise of its points that a path on its line may be off beside kLostRmsPx.
constexpr double kLostSigmas = 3.0;
/// A path laid along the fair fit is held to it by this [px].
constexpr double kHoldPx = 0.01;
/// A joint is put in no nearer to its neighbours than this part of their distance.
constexpr double kLeastSplitShare = 0.01;
/// A chain is said to be one of typical curves where they make this part of its length.
constexpr double kMostOfIt = 0.6;
/// Another start than a path of so many pieces takes long, and brings nothing where a line turns sharply again and
/// again.
constexpr std::size_t kManyElements = 60;
/// Segments of a grown path for each one of the chain that it may take the place of.
constexpr std::size_t kMostGrown = 2;

/// Joints nearest to the places that the user set, with those places.
std::vector<std::size_t> jointsAtPlaces(TypicalLine& line, std::span<const Vec2> places) {
  std::vector<std::size_t> at;
  for (const Vec2& onPiece : places) {
    const Vec2 place = line.toLine(onPiece);
    // The line at the foot of the place becomes a joint.
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity(), share = 0.0;
    for (std::size_t i = 0; i + 1 < line.joints.size(); ++i) {
      const Vec2 from = line.joints[i].point, to = line.joints[i + 1].point;
      const double t = footOnSegment(place, from, to).share;
      const double away = (from + t * (to - from) - place).norm();
      if (away < least) {
        least = away;
        nearest = i;
        share = t;
      }
    }
    const Joint a = line.joints[nearest], b = line.joints[nearest + 1];
    TypicalPath between;
    between.elements.resize(1);
    between.elements[0].typical = false;
    between.states = {{a.point, std::atan2(a.tangent.y(), a.tangent.x()), a.kappa},
                      {b.point, std::atan2(b.tangent.y(), b.tangent.x()), b.kappa}};
    between.split(0, std::clamp(share, kLeastSplitShare, 1.0 - kLeastSplitShare));
    for (std::size_t& i : at) i += i > nearest ? 1 : 0;
    line.joints.insert(line.joints.begin() + static_cast<std::ptrdiff_t>(nearest) + 1, between.states[1].joint());
    at.push_back(nearest + 1);
  }
  std::sort(at.begin(), at.end());
  return at;
}

PathData dataOf(const TypicalLine& line) {
  PathData data;
  data.points = line.points;
  data.start = line.joints.front().point;
  data.end = line.joints.back().point;
  return data;
}

/// True when a fitted path is still on its line.
bool isOnLine(const std::optional<FittedPath>& fitted) {
  return fitted && fitted->fit.rms < kLostRmsPx + kLostSigmas * fitted->fit.noise;
}

/// Two places of the user mean one segment between them: a typical curve where the line bends one way, else a Hermite
/// piece.
void oneBetweenPlaces(TypicalPath& path, const TypicalLine& line, const std::vector<std::size_t>& joints) {
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    const auto stateAt = [&](std::size_t joint) {
      std::size_t s = path.states.size();
      while (s > 0 && path.states[s - 1].point != line.joints[joint].point) --s;
      return s;  // one behind
    };
    const std::size_t from = stateAt(joints[i]), to = stateAt(joints[i + 1]);
    if (from == 0 || to <= from + 1) continue;
    PathElement one;
    const auto first = path.elements.begin() + static_cast<std::ptrdiff_t>(from) - 1;
    const auto last = path.elements.begin() + static_cast<std::ptrdiff_t>(to) - 1;
    one.typical = std::all_of(first, last, [&](const PathElement& e) { return e.typical && e.side == first->side; });
    one.side = first->side;
    double turn = 0.0, shape = 0.0;
    for (auto e = first; e != last; ++e) {
      turn += std::exp(e->logTurn);
      shape += e->shape;
    }
    one.logTurn = std::log(std::max(turn, kLeastStartTurnRad));
    one.shape = std::clamp(shape, -kMostStartLogRatio, kMostStartLogRatio);
    path.elements.erase(first, last);
    path.elements.insert(path.elements.begin() + static_cast<std::ptrdiff_t>(from) - 1, one);
    path.states.erase(path.states.begin() + static_cast<std::ptrdiff_t>(from),
                      path.states.begin() + static_cast<std::ptrdiff_t>(to) - 1);
  }
}

/// The path divided where the user wants it; absent where the points allow none.
std::optional<FoundPath> dividedPath(TypicalLine line, std::span<const Vec2> places, const RunContext& context) {
  const auto at = jointsAtPlaces(line, places);
  TypicalPath path = roughTypicalPath(line.joints, line.closed, at);
  oneBetweenPlaces(path, line, at);
  PathData data = dataOf(line);
  data.places.resize(path.states.size());
  for (const std::size_t joint : at) {
    for (std::size_t s = path.states.size(); s-- > 0;) {
      if (path.states[s].point != line.joints[joint].point) continue;
      data.places[s] = line.joints[joint].point;
      break;
    }
  }
  auto fitted = fitTypicalStructure(std::move(path), std::move(data), PathSearch::Keep, context);
  if (!isOnLine(fitted)) return std::nullopt;
  return FoundPath{std::move(fitted->path), fitted->fit.converged};
}

/// True for a curve that leaves its line: a loop between points, or an end that runs away, moves no point's foot.
bool leavesLine(const NurbsCurve& curve, const TypicalLine& line) {
  constexpr double kFarthestPx = 3.0, kLonger = 1.2;  // from the fair fit; times the length of the joints
  if (line.fair && !(deviation(curve, *line.fair).max < kFarthestPx)) return true;
  double length = 0.0;
  for (std::size_t i = 1; i < line.joints.size(); ++i)
    length += (line.joints[i].point - line.joints[i - 1].point).norm();
  return !(ArcLength(curve).total() < kLonger * length + 2.0 * kFarthestPx);
}

/// True when the ends of a closed path share place, direction and curvature.
bool isClosed(const TypicalPath& path) {
  constexpr double kShare = 1e-10;  // of the curvature, and radians: fitPath() closes a path to the last digits
  const PathState &a = path.states.front(), &b = path.states.back();
  const double turned = std::remainder(b.angleRad - a.angleRad, 2.0 * std::numbers::pi);
  return (b.point - a.point).norm() < 1e-9 && std::abs(turned) < kShare &&
         std::abs(b.kappa - a.kappa) <= kShare * std::abs(a.kappa);
}

/// A path with what speaks for it.
struct Candidate {
  std::optional<FoundPath> path;
  int falseExtrema = 0;  ///< More than the fair fit of the line has.
  double rms = 0.0;      ///< [px] of the points.
  double share = 0.0;    ///< Of the length, that typical curves make.

  bool isBetterThan(const Candidate& other) const {
    if (!path || !other.path) return path.has_value();
    return falseExtrema != other.falseExtrema ? falseExtrema < other.falseExtrema : rms < other.rms;
  }
};

Candidate fittedCandidate(TypicalPath start, PathData data, PathSearch search, const TypicalLine& line,
                          const RunContext& context) {
  auto fitted = fitTypicalStructure(std::move(start), std::move(data), search, context);
  if (!isOnLine(fitted)) return {};
  const auto& [path, fit] = *fitted;
  if (firstSliver(path) || (path.closed && !isClosed(path))) return {};
  const auto curve = pathCurve(path, line);
  if (!curve || leavesLine(*curve, line)) return {};
  const int known = line.fair ? countedExtrema(*line.fair, line.closed) : 0;
  const int more = std::max(0, countedExtrema(*curve, line.closed) - known);
  const double share = typicalShare(segmentNotes(path, line));
  return {FoundPath{std::move(fitted->path), fit.converged}, more, fit.rms, share};
}

/// The better of a chain and the grown path: with no more extrema and no farther off than a light curve may be, the one
/// with more typical curves.
std::optional<FoundPath> orGrown(Candidate chain, const TypicalLine& line, const ConstructParams& params,
                                 const RunContext& context) {
  if (!chain.path || chain.share >= kMostOfIt || chain.path->path.elements.size() > kManyElements)
    return std::move(chain.path);
  auto grown = grownPath(line, {}, params, StepRecord::None, context).found;
  // Growing sees only what lies before it: on a line that wavers it makes many short segments, which take long to fit.
  if (!grown || grown->path.elements.size() > kMostGrown * chain.path->path.elements.size())
    return std::move(chain.path);
  // The noise of the points is in both.
  const double farthest = std::hypot(chain.rms, params.lightTolerancePx);
  for (const PathSearch search : {PathSearch::Tidy, PathSearch::Keep}) {
    Candidate one = fittedCandidate(grown->path, dataOf(line), search, line, context);
    if (one.path && one.falseExtrema <= chain.falseExtrema && one.rms <= farthest && one.share > chain.share)
      return std::move(one.path);
  }
  return std::move(chain.path);
}

/// The path of the global chain; absent where the points allow none. Laid along the fair fit of the line; where that
/// brings extrema that the line has not, also from a rough path that is divided and made plain as the points ask for.
std::optional<FoundPath> chainPath(const TypicalLine& line, std::span<const Vec2> places, const ConstructParams& params,
                                   const RunContext& context) {
  if (!places.empty()) return dividedPath(line, places, context);
  bool isLong = false;
  Candidate best;
  if (auto tiled = tiledPath(line)) {
    PathData held = dataOf(line);
    held.hold = kHoldPx;
    isLong = tiled->elements.size() > kManyElements;
    // A join too many may lead a path astray: then with doubts about what the fit finds, or as it was laid.
    for (const PathSearch search : {PathSearch::Simplify, PathSearch::Tidy, PathSearch::Keep}) {
      if (best.path || (isLong && search == PathSearch::Tidy)) continue;
      best = fittedCandidate(*tiled, held, search, line, context);
    }
  }
  if (best.path && isLong) return best.path;
  if (best.path && best.falseExtrema == 0) return orGrown(std::move(best), line, params, context);
  Candidate rough =
      fittedCandidate(roughTypicalPath(line.joints, line.closed, {}), dataOf(line), PathSearch::Full, line, context);
  return orGrown(rough.isBetterThan(best) ? std::move(rough) : std::move(best), line, params, context);
}

/// The grown path, tidied: growing sees only what lies before it, so that its many short segments bring turns of the
/// curvature that the line has not. As grown where that helps nothing, or the segments are the user's or the paper's.
std::optional<FoundPath> grownAndTidied(const TypicalLine& line, std::span<const Vec2> places,
                                        const ConstructParams& params, const RunContext& context) {
  TypicalLine divided = line;
  jointsAtPlaces(divided, places);
  auto grown = grownPath(divided, places, params, StepRecord::None, context).found;
  if (!grown) return std::nullopt;
  if (!places.empty() || params.growingAsInPaper) return grown;
  Candidate tidy = fittedCandidate(grown->path, dataOf(line), PathSearch::Tidy, line, context);
  const auto curve = pathCurve(grown->path, line);
  const bool stays = curve && !leavesLine(*curve, line);
  return !tidy.path || (stays && countedExtrema(*curve, line.closed) < tidy.falseExtrema) ? grown : tidy.path;
}

std::string percentText(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }

/// What a chain with few typical curves says of the rest; empty where they are most of it.
std::string typicalNote(const std::vector<SegmentNote>& segments) {
  const double share = typicalShare(segments);
  if (segments.empty() || share >= kMostOfIt) return {};
  return "Typical curves make " + percentText(share) +
         " of the length; the rest are transitions: " + transitionCauses(segments) + ".";
}

/// The Bezier path of a piece, with the reason why it took the place of the chain.
Result<ConstructedPiece> pathInstead(const ConstructPiece& piece, const ConstructParams& params,
                                     const RunContext& context) {
  auto other = constructBezierChain(piece, params, context);
  if (other && other->report.why != Termination::Degenerate) {
    const std::string more = other->report.note.empty() ? "" : " " + other->report.note;
    other->report.note = "Typical curves do not fit this line; a Bézier path was used." + more;
  }
  return other;
}

}  // namespace

std::string transitionCauses(std::span<const SegmentNote> segments) {
  struct Class {
    SegmentCause cause;
    const char* what;
  };
  constexpr std::array kClasses{Class{SegmentCause::Straight, "nearly straight"},
                                Class{SegmentCause::Inflection, "at inflections"},
                                Class{SegmentCause::Even, "that one typical curve does not follow as closely"}};
  std::string text;
  for (const Class& one : kClasses) {
    const double share = shareOf(one.cause, segments);
    if (share > 0.0) text.append(text.empty() ? "" : ", ").append(percentText(share)).append(" ").append(one.what);
  }
  return text;
}

Result<ConstructedPiece> constructTypical(const ConstructPiece& piece, const ConstructParams& params,
                                          const RunContext& context) {
  if (context.isCancelled()) return cancelled();
  const TypicalLine line = typicalLine(piece, params, context);
  if (line.joints.empty()) return straightPiece(piece, "Too few stations for a curve; a straight line was used.");
  if (context.isCancelled()) return cancelled();
  auto found = params.typical == TypicalMode::Growing ? grownAndTidied(line, piece.breakpoints, params, context)
                                                      : chainPath(line, piece.breakpoints, params, context);
  if (context.isCancelled()) return cancelled();
  auto curve = found ? pathCurve(found->path, line) : Result<NurbsCurve>(fail(ErrorCode::Numerical, ""));
  if (!curve) return pathInstead(piece, params, context);
  const bool endsFree = params.typical == TypicalMode::Growing && params.growingAsInPaper && found->path.endsTypical();
  const Vec2 end = line.closed ? Vec2(curve->controlPoints().front())
                   : endsFree  ? Vec2(curve->controlPoints().back())
                               : line.end;
  const Vec2 start = line.closed ? end : line.origin;
  curve = clampedWithEnds(*curve, start, end);
  if (!curve) return fail(curve.error());
  // The fit looks at feet that move along with it; a chain that has run away from its line is seen only from the line.
  constexpr double kLeftLinePx = 5.0;
  const bool asInPaper = params.typical == TypicalMode::Growing && params.growingAsInPaper;
  if (!asInPaper &&
      (leavesLine(*curve, line) || !(deviation(*curve, positionsOf(piece.points), true).rms < kLeftLinePx))) {
    return pathInstead(piece, params, context);
  }
  ConstructedPiece result{std::move(*curve), {}};
  result.report.why = found->converged ? Termination::Converged : Termination::IterationLimit;
  result.report.segments = segmentNotes(found->path, line);
  result.report.note = typicalNote(result.report.segments);
  return result;
}

}  // namespace batten
