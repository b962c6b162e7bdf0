// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/construct/bezier/bezier_chain.h"
#include "core/construct/fair/fair_fit.h"
#include "core/construct/stations/piece_stations.h"
#include "core/construct/typical/typical_growing.h"
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

/// More points than this are taken together in groups: they say no more, and cost time.
constexpr std::size_t kMostPoints = 400;
/// A path that runs this far [px, rms] from its points while the joints do not has lost its line.
constexpr double kLostRmsPx = 3.0;
/// Distance of the joints along a fair fit, and the shortest one that is taken as a guide.
constexpr double kHoldPx = 0.01, kAgreePx = 0.05;
/// Without a pixel size, assume the length of a typical line of a drawing.
constexpr double kUnitsOfLine = 1000.0;
/// A joint is put in no nearer to its neighbours than this part of their distance.
constexpr double kLeastSplitShare = 0.01;
constexpr double kJointPx = 40.0, kLeastFairPx = 40.0;

/// A closed line is opened after the station whose segment bends least: curvature is least at a joint, never inside a
/// typical curve.
void turnToStraightest(std::vector<Station>& stations) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const double turn = std::abs(angleBetween(stations[i].direction, stations[(i + 1) % stations.size()].direction));
    if (turn < least) {
      least = turn;
      best = i;
    }
  }
  const auto first = static_cast<std::ptrdiff_t>((best + 1) % stations.size());
  std::rotate(stations.begin(), stations.begin() + first, stations.end());
}

}  // namespace

namespace {

/// The line as its true and fair fit shows it; absent where there is none.
std::optional<TypicalLine> lineOnFairFit(const ConstructPiece& piece, double pixelMm, bool grows,
                                         const RunContext& context) {
  ConstructContour contour;
  contour.pieces = {piece};
  contour.pieces.front().constraints.clear();
  contour.pixelMm = pixelMm;
  FairFitOptions options;
  options.knotRemovalTolerance = 0.0;
  const auto fitted = fairFit(contour, options, context);
  // With sharp turns it still is the line, but nothing grows through them; a curve that only took its place is none.
  if (!fitted || fitted->size() != 1 || fitted->front().report.why == Termination::Degenerate) return std::nullopt;
  if (grows && !fitted->front().report.note.empty()) return std::nullopt;
  const NurbsCurve& curve = fitted->front().curve;
  const double length = curve.isEmpty() ? 0.0 : ArcLength(curve).total();
  if (!(pixelMm > 0.0) || !(length > kLeastFairPx * pixelMm)) return std::nullopt;
  // A fit that lost its line is no guide.
  if (!(deviation(curve, piece.points, true).rms < kLostRmsPx * pixelMm)) return std::nullopt;
  TypicalLine line;
  line.unitMm = pixelMm;
  line.closed = piece.closed;
  line.fair = curve;
  const int joints = std::max(8, static_cast<int>(std::ceil(length / (kJointPx * pixelMm)))) + 1;
  const auto samples = sampleByArcLength(curve, joints);
  line.originMm = samples.front().point;
  line.endMm = samples.back().point;
  // Where the stations and the fit agree on an end, it is that of the stations, as in the other constructions.
  const std::vector<Station> stations = line.closed ? std::vector<Station>{} : usableStations(piece, 6);
  if (!stations.empty()) {
    const auto agrees = [&](const Vec2& a, const Vec2& b) { return (a - b).norm() < kAgreePx * pixelMm; };
    if (agrees(stations.front().point, line.originMm)) line.originMm = stations.front().point;
    if (agrees(stations.back().point, line.endMm)) line.endMm = stations.back().point;
  }
  for (const CurveSample& s : samples) line.joints.push_back({line.toLine(s.point), s.tangent, s.kappa * pixelMm});
  if (line.closed) {
    line.joints.back() = line.joints.front();
  } else {
    line.joints.front().point = Vec2::Zero();
    line.joints.back().point = line.toLine(line.endMm);
  }
  return line;
}

/// The line as its stations show it.
TypicalLine lineOnStations(const ConstructPiece& piece, double pixelMm, const ConstructParams& params,
                           const RunContext& context) {
  TypicalLine line;
  // A chain needs no closer stations: it goes by the points, and by more joints it only takes longer.
  std::vector<Station> stations = usableStations(piece, 6);
  if (stations.size() < (piece.closed ? 3u : 2u)) return line;
  if (piece.closed) turnToStraightest(stations);
  const FairedJoints faired = fairedJoints(givenStations(stations), piece.closed, pixelMm, params.lowPass, context);
  double total = 0.0;
  for (const double length : faired.lengths) total += length;
  line.unitMm = pixelMm > 0.0 && std::isfinite(pixelMm) ? pixelMm : total / kUnitsOfLine;
  line.originMm = stations.front().point;
  line.endMm = stations.back().point;
  for (const Joint& j : faired.joints) {
    line.joints.push_back({line.toLine(j.point), j.tangent, j.kappa * line.unitMm});
  }
  line.closed = piece.closed;
  return line;
}

}  // namespace

TypicalLine typicalLine(const ConstructPiece& piece, double pixelMm, const ConstructParams& params,
                        const RunContext& context) {
  auto fair = lineOnFairFit(piece, pixelMm, params.typical == TypicalMode::Growing, context);
  TypicalLine line = fair ? std::move(*fair) : lineOnStations(piece, pixelMm, params, context);
  if (!line.joints.empty()) line.points = pointsAlong(piece, line);
  return line;
}

std::vector<Vec2> pointsAlong(const ConstructPiece& piece, const TypicalLine& line) {
  std::vector<Vec2> all;
  for (const Vec2& p : piece.points) {
    if (p.allFinite()) all.push_back(line.toLine(p));
  }
  if (line.closed && !all.empty()) {
    const auto first = std::min_element(all.begin(), all.end(), [&](const Vec2& a, const Vec2& b) {
      return (a - line.joints.front().point).squaredNorm() < (b - line.joints.front().point).squaredNorm();
    });
    std::rotate(all.begin(), first, all.end());
  }
  if (all.size() < 2 * line.joints.size()) {
    // Hardly more points than joints: the joints are the line.
    all.clear();
    for (const Joint& j : line.joints) all.push_back(j.point);
  }
  const std::size_t group = (all.size() + kMostPoints - 1) / kMostPoints;
  if (group < 2) return all;
  std::vector<Vec2> means;
  std::size_t joint = 0;
  for (std::size_t i = 0; i + group <= all.size(); i += group) {
    Vec2 mean = Vec2::Zero();
    for (std::size_t k = i; k < i + group; ++k) mean += all[k] / static_cast<double>(group);
    while (joint + 1 < line.joints.size() &&
           (line.joints[joint + 1].point - mean).squaredNorm() <= (line.joints[joint].point - mean).squaredNorm()) {
      ++joint;
    }
    // The mean of an arc lies inside it: kappa / 2 times the variance of the arc length.
    const double length =
        (all[i + group - 1] - all[i]).norm() * static_cast<double>(group) / static_cast<double>(group - 1);
    means.push_back(mean - line.joints[joint].kappa * length * length / 24.0 * leftNormal(line.joints[joint].tangent));
  }
  return means;
}

Result<NurbsCurve> pathCurve(const TypicalPath& path, const TypicalLine& line) {
  std::vector<Quintic> pieces;
  for (std::size_t e = 0; e < path.elements.size(); ++e) {
    Quintic& q = pieces.emplace_back(path.quintic(e));
    for (Vec2& p : q) p = line.toModel(p);
  }
  return joinedQuintics(pieces, 1.0);
}

namespace {

/// Why a segment is no typical curve.
SegmentCause causeOf(double startKappa, double endKappa, double turnRad) {
  constexpr double kStraightTurn = 0.05;  // [rad]
  if (startKappa * endKappa < 0.0 || startKappa * turnRad < 0.0) return SegmentCause::Inflection;
  return std::abs(turnRad) < kStraightTurn ? SegmentCause::Straight : SegmentCause::Even;
}

}  // namespace

std::vector<SegmentNote> segmentNotes(const TypicalPath& path, const TypicalLine& line) {
  std::vector<SegmentNote> notes;
  for (std::size_t e = 0; e < path.elements.size(); ++e) {
    SegmentNote note;
    note.typical = path.elements[e].typical;
    note.startKappa = path.states[e].kappa / line.unitMm;
    note.endKappa = path.states[e + 1].kappa / line.unitMm;
    note.startMm = line.toModel(path.states[e].point);
    note.turnRad = path.states[e + 1].angleRad - path.states[e].angleRad;
    if (!note.typical) note.turnRad = std::remainder(note.turnRad, 2.0 * std::numbers::pi);
    if (!note.typical) note.cause = causeOf(path.states[e].kappa, path.states[e + 1].kappa, note.turnRad);
    if (note.typical) {
      const TypicalCurve curve = path.typical(e);
      note.ratio = curve.ratio;
      note.lengthMm =
          line.unitMm * curve.edge * (1.0 + curve.ratio * std::cos(curve.turnRad) + curve.ratio * curve.ratio);
      note.monotone = curve.isMonotone();
    } else {
      note.lengthMm = line.unitMm * path.hermiteLength(e);
    }
    notes.push_back(note);
  }
  return notes;
}

namespace {

/// Joints nearest to the places that the user set, with those places.
std::vector<std::size_t> jointsAtPlaces(TypicalLine& line, std::span<const Vec2> placesMm) {
  std::vector<std::size_t> at;
  for (const Vec2& placeMm : placesMm) {
    const Vec2 place = line.toLine(placeMm);
    // The line at the foot of the place becomes a joint.
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity(), share = 0.0;
    for (std::size_t i = 0; i + 1 < line.joints.size(); ++i) {
      const Vec2 chord = line.joints[i + 1].point - line.joints[i].point;
      const double t = std::clamp((place - line.joints[i].point).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
      const double away = (line.joints[i].point + t * chord - place).norm();
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
bool isOnLine(const std::optional<PathFit>& fit, const PathData& data) {
  return fit && fit->rms < kLostRmsPx + 3.0 * data.noise;
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
std::optional<FoundPath> dividedPath(TypicalLine line, std::span<const Vec2> placesMm, const RunContext& context) {
  const auto at = jointsAtPlaces(line, placesMm);
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
  const auto fit = fitTypicalStructure(path, data, PathSearch::Keep, context);
  if (!isOnLine(fit, data)) return std::nullopt;
  return FoundPath{std::move(path), fit->converged};
}

/// True for a curve that leaves its line: a loop between points, or an end that runs away, moves no point's foot.
bool isAstray(const NurbsCurve& curve, const TypicalLine& line) {
  constexpr double kFarthestPx = 3.0, kLonger = 1.2;
  if (line.fair && !(deviation(curve, *line.fair).max < kFarthestPx * line.unitMm)) return true;
  double length = 0.0;
  for (std::size_t i = 1; i < line.joints.size(); ++i)
    length += (line.joints[i].point - line.joints[i - 1].point).norm();
  return !(ArcLength(curve).total() < line.unitMm * (kLonger * length + 2.0 * kFarthestPx));
}

/// True when the ends of a closed path share place, direction and curvature.
bool isClosed(const TypicalPath& path) {
  constexpr double kShare = 1e-10;
  const PathState &a = path.states.front(), &b = path.states.back();
  const double turned = std::remainder(b.angleRad - a.angleRad, 2.0 * std::numbers::pi);
  return (b.point - a.point).norm() < 1e-9 && std::abs(turned) < kShare &&
         std::abs(b.kappa - a.kappa) <= kShare * std::abs(a.kappa);
}

/// True for a path with a segment too short to be one: its curvature would be all rounding.
bool hasSliver(const TypicalPath& path) {
  constexpr double kShortest = 0.5;
  for (std::size_t e = 0; e < path.elements.size(); ++e) {
    if (!((path.states[e + 1].point - path.states[e].point).norm() > kShortest)) return true;
  }
  return false;
}

/// A path with what speaks for it.
struct Candidate {
  std::optional<FoundPath> path;
  int falseExtrema = 0;  ///< More than the fair fit of the line has.
  double rms = 0.0;

  bool isBetterThan(const Candidate& other) const {
    if (!path || !other.path) return path.has_value();
    return falseExtrema != other.falseExtrema ? falseExtrema < other.falseExtrema : rms < other.rms;
  }
};

Candidate fittedCandidate(TypicalPath path, PathData data, PathSearch search, const TypicalLine& line,
                          const RunContext& context) {
  const auto fit = fitTypicalStructure(path, data, search, context);
  if (!isOnLine(fit, data) || hasSliver(path) || (path.closed && !isClosed(path))) return {};
  const auto curve = pathCurve(path, line);
  if (!curve || isAstray(*curve, line)) return {};
  const int known = line.fair ? countedExtrema(*line.fair, line.closed) : 0;
  const int more = std::max(0, countedExtrema(*curve, line.closed) - known);
  return {FoundPath{std::move(path), fit->converged}, more, fit->rms};
}

/// The path of the global chain; absent where the points allow none. Laid along the fair fit of the line; where that
/// brings extrema that the line has not, also from a rough path that is divided and made plain as the points ask for.
std::optional<FoundPath> chainPath(const TypicalLine& line, std::span<const Vec2> placesMm, const RunContext& context) {
  if (!placesMm.empty()) return dividedPath(line, placesMm, context);
  // To divide a rough path of so many pieces takes long, and brings nothing where a line turns sharply again and again.
  constexpr std::size_t kManyElements = 60;
  bool isLong = false;
  Candidate best;
  if (auto tiled = tiledPath(line)) {
    PathData data = dataOf(line);
    data.hold = kHoldPx;
    isLong = tiled->elements.size() > kManyElements;
    best = fittedCandidate(std::move(*tiled), data, PathSearch::Simplify, line, context);
  }
  if (best.path && (best.falseExtrema == 0 || isLong)) return best.path;
  Candidate rough =
      fittedCandidate(roughTypicalPath(line.joints, line.closed, {}), dataOf(line), PathSearch::Full, line, context);
  return rough.isBetterThan(best) ? rough.path : best.path;
}

/// The grown path, tidied: growing sees only what lies before it, so that its many short segments bring turns of the
/// curvature that the line has not. As grown where that helps nothing, or the segments are the user's or the paper's.
std::optional<FoundPath> grownAndTidied(const TypicalLine& line, std::span<const Vec2> placesMm,
                                        const ConstructParams& params, const RunContext& context) {
  TypicalLine divided = line;
  jointsAtPlaces(divided, placesMm);
  auto grown = grownPath(divided, placesMm, params, nullptr, context);
  if (!grown) return std::nullopt;
  if (!placesMm.empty() || params.growingAsInPaper) return grown;
  Candidate tidy = fittedCandidate(grown->path, dataOf(line), PathSearch::Tidy, line, context);
  const auto curve = pathCurve(grown->path, line);
  const bool stays = curve && !isAstray(*curve, line);
  return !tidy.path || (stays && countedExtrema(*curve, line.closed) < tidy.falseExtrema) ? grown : tidy.path;
}

/// What a chain with few typical curves says of the rest; empty where they are most of it.
std::string typicalNote(const std::vector<SegmentNote>& segments) {
  constexpr double kMostOfIt = 0.6;
  const double share = typicalShare(segments);
  if (segments.empty() || share >= kMostOfIt) return {};
  const auto counted = [&](SegmentCause cause) {
    return std::count_if(segments.begin(), segments.end(),
                         [&](const SegmentNote& one) { return !one.typical && one.cause == cause; });
  };
  std::string why;
  const auto add = [&](std::ptrdiff_t count, const char* what) {
    if (count > 0) why.append(why.empty() ? "" : ", ").append(std::to_string(count)).append(what);
  };
  add(counted(SegmentCause::Straight), " nearly straight");
  add(counted(SegmentCause::Inflection), " at inflections");
  add(counted(SegmentCause::Even), " of hardly changing curvature or beyond what one typical curve can follow");
  return "Typical curves make " + std::to_string(static_cast<int>(std::lround(100.0 * share))) +
         " % of the length; the other segments are transitions: " + why + ".";
}

/// The Bezier path of a piece, with the reason why it took the place of the chain.
Result<ConstructedPiece> pathInstead(const ConstructPiece& piece, double pixelMm, const ConstructParams& params,
                                     const RunContext& context) {
  auto other = constructBezierChain(piece, pixelMm, params, context);
  if (other && other->report.why != Termination::Degenerate) {
    const std::string more = other->report.note.empty() ? "" : " " + other->report.note;
    other->report.note = "Typical curves do not fit this line; a Bézier path was used." + more;
  }
  return other;
}

}  // namespace

Result<ConstructedPiece> constructTypical(const ConstructPiece& piece, double pixelMm, const ConstructParams& params,
                                          const RunContext& context) {
  if (context.isCancelled()) return cancelled();
  const TypicalLine line = typicalLine(piece, pixelMm, params, context);
  if (line.joints.empty()) return straightPiece(piece, "Too few stations for a curve; a straight line was used.");
  if (context.isCancelled()) return cancelled();
  auto found = params.typical == TypicalMode::Growing ? grownAndTidied(line, piece.breakpoints, params, context)
                                                      : chainPath(line, piece.breakpoints, context);
  if (context.isCancelled()) return cancelled();
  auto curve = found ? pathCurve(found->path, line) : Result<NurbsCurve>(fail(ErrorCode::Numerical, ""));
  if (!curve) return pathInstead(piece, pixelMm, params, context);
  const bool endsFree = params.typical == TypicalMode::Growing && params.growingAsInPaper && found->path.endsTypical();
  const Vec2 end = line.closed ? Vec2(curve->controlPoints().front())
                   : endsFree  ? Vec2(curve->controlPoints().back())
                               : line.endMm;
  const Vec2 start = line.closed ? end : line.originMm;
  curve = clampedWithEnds(*curve, start, end);
  if (!curve) return fail(curve.error());
  // The fit looks at feet that move along with it; a chain that has run away from its line is seen only from the line.
  constexpr double kAstrayPx = 5.0;
  const bool asInPaper = params.typical == TypicalMode::Growing && params.growingAsInPaper;
  if (!asInPaper && (isAstray(*curve, line) || !(deviation(*curve, piece.points, true).rms < kAstrayPx * pixelMm))) {
    return pathInstead(piece, pixelMm, params, context);
  }
  ConstructedPiece result{std::move(*curve), {}};
  result.report.why = found->converged ? Termination::Converged : Termination::IterationLimit;
  result.report.segments = segmentNotes(found->path, line);
  result.report.note = typicalNote(result.report.segments);
  return result;
}

}  // namespace batten
