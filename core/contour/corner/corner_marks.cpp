// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_marks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/contour/corner/corner_finder.h"
#include "core/contour/corner/corner_geometry.h"
#include "core/polyline/point_grid.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kSamePlacePx = 2.0;  // marks whose points are as near stand for one corner
constexpr double kSliverPx = 12.0;    // a piece shorter than this has no points beyond the rounded zones of its corners
constexpr float kCornerSigmaPx = 0.1f;    // [px] noise assumed of a corner that is all its piece has
constexpr double kLeastFoundZones = 2.5;  // of a side between corners found without marks
constexpr double kLedElsewhere = 0.25;    // of the rounded zone: where two ways to fit the sides agree, they do to less
constexpr double kGuessedZonePx = 0.5;    // of a corner that was not located: its point itself
constexpr double kLeastAsidePx = 1.5;     // of a line so thin that half its width says nothing
constexpr double kZonesLookedAt = 3.0;    // zones, and a sliver: what lies farther from a corner cannot be behind it
constexpr int kManyMarks = 16;            // from here on sorting the points of the drawing pays

// A corner while the pieces are cut.
struct PlacedCorner {
  Corner corner;
  double zone = 4.0;     // [px] points nearer than this are left out
  bool isJoint = false;  // of the line itself
  bool isMarkedJoint = false;
  bool exact = false;
};

void locate(const Contour& contour, const GreyImage* grey, const RunContext& context,
            std::vector<PlacedCorner>& corners) {
  std::vector<int> places;
  places.reserve(corners.size());
  for (const PlacedCorner& placed : corners) places.push_back(placed.corner.pointIndex);
  const std::vector<CornerFix> fixes = locateCorners(contour, places, context, grey);
  for (int i = 0; i < std::ssize(fixes); ++i) {
    // One found between short sides stays where these meet: a fit of longer sides that fails, or meets elsewhere, has
    // followed a hook or gone past a neighbour.
    const double zone = roundedZonePx(contour, places[i]),
                 apart = (fixes[i].position - corners[i].corner.positionPx).norm();
    if (corners[i].corner.isLocated && !corners[i].corner.mark && (!fixes[i].exact || apart > kLedElsewhere * zone)) {
      corners[i].exact = true;
      corners[i].zone = zone;
      continue;
    }
    corners[i].corner.positionPx = fixes[i].position;
    corners[i].corner.turningAngleRad = fixes[i].angleRad;
    corners[i].exact = fixes[i].exact;
    corners[i].zone = fixes[i].zonePx;
  }
}

// Whether points `first` to `count` - 1, counted from an end of a piece, lie along the straight way from the corner to
// the next one, within half the stroke.
bool areOnTheWay(const Piece& piece, bool fromEnd, const Vec2& corner, int first, int count) {
  const int n = static_cast<int>(piece.points.size());
  const auto point = [&](int k) -> const PiecePoint& { return piece.points[fromEnd ? n - 1 - k : k]; };
  if (count >= n) return true;
  for (int k = first; k < count; ++k) {
    const double half = std::max(kLeastAsidePx, 0.5 * static_cast<double>(point(k).widthPx.value_or(0.0f)));
    if (awayFromSegment(point(k).at, corner, point(count).at).norm() > half) return false;
  }
  return true;
}

// How many points to leave out at one end of a piece: those inside the rounded zone, those that lie behind the corner,
// and beyond them those that were not measured but laid between measured ones, unless the line bends there.
int pointsToDrop(const Piece& piece, bool isPen, bool fromEnd, const Vec2& corner, double zone) {
  const int n = static_cast<int>(piece.points.size());
  int drop = 0, guessed = 0;
  double arc = 0.0;
  for (int k = 0; k < n; ++k) {
    const int i = fromEnd ? n - 1 - k : k;
    const Vec2& p = piece.points[i].at;
    if (k > 0) arc += (p - piece.points[fromEnd ? n - k : k - 1].at).norm();
    if (arc > kZonesLookedAt * zone + kSliverPx) break;
    if ((p - corner).norm() < zone || arc < zone) drop = k + 1;
    if (std::max(drop, guessed) == k && !piece.points[i].refined && !isPen) guessed = k + 1;
  }
  return guessed > drop && areOnTheWay(piece, fromEnd, corner, drop, guessed) ? guessed : drop;
}

// What a corner knows where its piece has no other point.
PiecePoint besideNoPoint(const std::vector<PiecePoint>& dropped) {
  PiecePoint alone;
  if (!dropped.empty() && dropped.front().sigmaPx) alone.sigmaPx = kCornerSigmaPx;
  if (!dropped.empty() && dropped.front().spreadPx) alone.spreadPx = 0.0f;
  return alone;
}

// One piece from point index `from` to `to` (unwrapped, to >= from) with its ends put on the corners.
Piece makePiece(const ContourSet& set, int contourIndex, int from, int to, const PlacedCorner* start,
                const PlacedCorner* end) {
  const Contour& contour = set.contours[contourIndex];
  const int n = static_cast<int>(contour.points.size());
  Piece piece;
  piece.contour = contourIndex;
  piece.firstPoint = from;
  piece.lastPoint = to;
  piece.isPen = contour.kind == ContourKind::Pen;
  for (int i = from; i <= to; ++i) {
    const ContourPoint& p = contour.points[wrapIndex(i, n)];
    std::optional<float> spreadPx;
    if (p.bundle) spreadPx = 0.5f * (p.bundle->left + p.bundle->right);
    piece.points.push_back({p.at, p.refined, p.sigmaPx, spreadPx, p.widthPx});
  }
  const auto zoneOf = [&](const PlacedCorner* placed) { return placed->exact ? placed->zone : kGuessedZonePx; };
  int head = 0, tail = 0;
  if (start != nullptr)
    head = pointsToDrop(piece, isDrawn(contour.kind), false, start->corner.positionPx, zoneOf(start));
  if (end != nullptr) tail = pointsToDrop(piece, isDrawn(contour.kind), true, end->corner.positionPx, zoneOf(end));
  if (head + tail >= std::ssize(piece.points)) head = static_cast<int>(piece.points.size()), tail = 0;
  const PiecePoint alone = besideNoPoint(piece.points);
  piece.points.erase(piece.points.end() - tail, piece.points.end());
  piece.points.erase(piece.points.begin(), piece.points.begin() + head);
  const bool drawn = isDrawn(contour.kind);
  // Of a corner: what is known of the line next to it.
  const PiecePoint first = piece.points.empty() ? alone : piece.points.front();
  const PiecePoint last = piece.points.empty() ? alone : piece.points.back();
  const auto at = [&](const PlacedCorner& placed, const PiecePoint& beside) {
    return PiecePoint{placed.corner.positionPx, placed.exact || drawn, beside.sigmaPx, beside.spreadPx, beside.widthPx};
  };
  if (start != nullptr) piece.points.insert(piece.points.begin(), at(*start, first));
  if (end != nullptr) piece.points.push_back(at(*end, last));
  piece.startIsCorner = start != nullptr;
  piece.endIsCorner = end != nullptr;
  piece.lengthPx = polylineLength(positionsOf(piece.points), false);
  return piece;
}

// The pieces of one contour, between corners in the order of travel.
std::vector<Piece> piecesOf(const ContourSet& set, int c, const std::vector<PlacedCorner>& corners) {
  const Contour& contour = set.contours[c];
  const int n = static_cast<int>(contour.points.size());
  std::vector<Piece> pieces;
  if (n == 0) return pieces;
  const int count = static_cast<int>(corners.size());
  if (corners.empty()) {
    pieces.push_back(makePiece(set, c, 0, n - 1, nullptr, nullptr));
    pieces.back().closed = contour.closed;
    pieces.back().lengthPx = polylineLength(positionsOf(pieces.back().points), contour.closed);
  } else if (contour.closed) {
    for (int i = 0; i < count; ++i) {
      const PlacedCorner& next = corners[(i + 1) % count];
      const int from = corners[i].corner.pointIndex;
      const int to = next.corner.pointIndex + (i + 1 == count ? n : 0);
      pieces.push_back(makePiece(set, c, from, to, &corners[i], &next));
    }
  } else {
    const PlacedCorner* previous = nullptr;
    int from = 0;
    for (const PlacedCorner& placed : corners) {
      pieces.push_back(makePiece(set, c, from, placed.corner.pointIndex, previous, &placed));
      previous = &placed;
      from = placed.corner.pointIndex;
    }
    pieces.push_back(makePiece(set, c, from, n - 1, previous, nullptr));
  }
  // A mark at the very end of a line leaves nothing on its far side.
  std::erase_if(pieces, [](const Piece& p) { return p.points.size() < 2 || !(p.lengthPx > 0.0); });
  for (int i = 0; i < std::ssize(pieces); ++i) pieces[i].index = i;
  return pieces;
}

std::vector<MarkPair> closeCornersOf(const Contour& contour, const std::vector<PlacedCorner>& corners) {
  std::vector<MarkPair> close;
  const int count = static_cast<int>(corners.size());
  if (count < 2) return close;
  const std::vector<Vec2> points = positionsOf(contour.points);
  const double length = contour.closed ? polylineLength(points, true) : 0.0;
  const std::vector<double> arc = cumulativeLength(points);
  // A closed line comes round to its first corner, which with two of them is looked at from both sides.
  for (int i = 0; i < (contour.closed ? count : count - 1); ++i) {
    const Corner &here = corners[i].corner, &next = corners[(i + 1) % count].corner;
    if (!here.mark || !next.mark) continue;
    const double along = arc[next.pointIndex] - arc[here.pointIndex] + (i + 1 == count ? length : 0.0);
    const double apart = (next.positionPx - here.positionPx).norm();
    if (along >= kSliverPx || apart >= kSliverPx) continue;
    close.push_back({std::max(*here.mark, *next.mark), std::min(*here.mark, *next.mark), apart});
  }
  return close;
}

// The corners of one contour: those that marks found, its joints, and those found without marks. Marks within
// kSamePlacePx are one corner; joints never are, as a line may come through one place several times.
class ContourCorners {
 public:
  /// The mark that found the corner before; nothing: it is new.
  std::optional<int> add(const Corner& corner) {
    if (const auto known = firstAt(corner.positionPx)) return corners_[*known].corner.mark;
    near_.add(corner.positionPx, static_cast<int>(corners_.size()));
    corners_.push_back({.corner = corner});
    return std::nullopt;
  }
  /// Of an imported line. A mark beside a joint means the joint, of several at one place the first. @pre all marks are
  /// in.
  void addJoint(const Corner& joint) {
    const auto marked = firstAt(joint.positionPx);
    if (marked && !corners_[*marked].isMarkedJoint) {
      corners_[*marked].corner.pointIndex = joint.pointIndex;
      corners_[*marked].corner.positionPx = joint.positionPx;
      corners_[*marked].isMarkedJoint = true;
    } else {
      corners_.push_back({.corner = joint, .isJoint = true});
    }
  }
  /// Found without a mark. What is there already wins; what was found, too, may lie a short side away.
  /// @param apartPx from another that was found, at least. @pre all marks and joints are in.
  void addFound(const Corner& corner, double apartPx) {
    const bool isTaken = std::any_of(corners_.begin(), corners_.end(), [&](const PlacedCorner& other) {
      const bool isFound = !other.corner.mark && !other.isJoint;
      return (other.corner.positionPx - corner.positionPx).norm() < (isFound ? apartPx : kSliverPx);
    });
    if (!isTaken) corners_.push_back({.corner = corner});
  }
  /// In the order of travel.
  std::vector<PlacedCorner> sorted() && {
    std::sort(corners_.begin(), corners_.end(),
              [](const PlacedCorner& a, const PlacedCorner& b) { return a.corner.pointIndex < b.corner.pointIndex; });
    return std::move(corners_);
  }

 private:
  /// The corner at a place that was added first.
  std::optional<int> firstAt(const Vec2& place) const {
    std::optional<int> first;
    near_.around(place, [&](int i) {
      const bool isHere = (corners_[i].corner.positionPx - place).norm() <= kSamePlacePx;
      if (isHere && (!first || i < *first)) first = i;
    });
    return first;
  }

  PointGrid<int> near_{kSamePlacePx};
  std::vector<PlacedCorner> corners_;
};

// By contour; notes on `out` what became of the marks. Not complete when cancelled.
std::vector<ContourCorners> findCorners(const ContourSet& set, std::span<const CornerMark> marks, double snapDistancePx,
                                        const RunContext& context, PieceSet& out) {
  std::vector<ContourCorners> found(set.contours.size());
  CornerFinder finder(set, snapDistancePx);
  if (std::ssize(marks) >= kManyMarks) finder.sortPoints();
  for (int m = 0; m < std::ssize(marks); ++m) {
    if (context.isCancelled()) break;
    auto corner = finder.find(marks[m].positionPx);
    if (!corner) {
      out.lostMarks.push_back(m);
      continue;
    }
    corner->mark = m;
    if (const auto before = found[corner->contour].add(*corner)) out.sameCorner.push_back({m, *before, 0.0});
  }
  return found;
}

void addJoints(const Contour& contour, int index, ContourCorners& corners) {
  for (const int joint : contour.joints) {
    Corner corner;
    corner.contour = index;
    corner.pointIndex = joint;
    corner.positionPx = contour.points[joint].at;
    corners.addJoint(corner);
  }
}

}  // namespace

std::optional<Error> validate(const CornerParams& p) {
  if (p.snapDistancePx > 0.0 && std::isfinite(p.snapDistancePx)) return std::nullopt;
  return Error{ErrorCode::BadParameter, "corners.snap must be more than 0 px.", {}};
}

int unmarkedCornerCount(const PieceSet& set) {
  return static_cast<int>(std::ranges::count_if(set.corners, [](const Corner& corner) { return !corner.mark; }));
}

std::optional<Corner> nearestContourPoint(const ContourSet& set, const Vec2& positionPx, double snapDistancePx) {
  return CornerFinder(set, snapDistancePx).find(positionPx);
}

Result<PieceSet> splitAtCorners(const ContourSet& set, std::span<const CornerMark> marks, const CornerParams& params,
                                const RunContext& context, const GreyImage* grey, std::span<const Corner> found) {
  if (auto error = validate(params)) return fail(*error);
  PieceSet out;
  std::vector<ContourCorners> atContour = findCorners(set, marks, params.snapDistancePx, context, out);
  std::vector<std::vector<Corner>> unmarked(set.contours.size());
  for (const Corner& corner : found) unmarked[corner.contour].push_back(corner);
  for (int c = 0; c < std::ssize(set.contours); ++c) {
    if (context.isCancelled()) return cancelled();
    const Contour& contour = set.contours[c];
    addJoints(contour, c, atContour[c]);
    // The border of a shape bends between corners that are so near; the line of a stroke is straight there.
    const bool isStroke = contour.kind == ContourKind::Centreline;
    for (const Corner& corner : unmarked[c]) {
      const double zone = roundedZonePx(contour, corner.pointIndex);
      atContour[c].addFound(corner, isStroke ? std::min(kSliverPx, kLeastFoundZones * zone) : kSliverPx);
    }
    std::vector<PlacedCorner> corners = std::move(atContour[c]).sorted();
    // A pen stroke is exact already: its corner is the point that was drawn.
    if (params.exact && !isDrawn(contour.kind) && !corners.empty()) locate(contour, grey, context, corners);
    if (context.isCancelled()) return cancelled();
    std::ranges::move(piecesOf(set, c, corners), std::back_inserter(out.pieces));
    std::erase_if(corners, [](const PlacedCorner& placed) { return placed.isJoint; });
    std::ranges::copy(closeCornersOf(contour, corners), std::back_inserter(out.closeCorners));
    for (const PlacedCorner& one : corners) out.corners.push_back(one.corner);
  }
  return out;
}

}  // namespace batten
