// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_marks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contour/corner/corner_geometry.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kLooksLikeCornerRad = 25.0 * std::numbers::pi / 180.0;
constexpr double kTurnInnerPx = 3.0;   // the part next to a corner that blur has rounded
constexpr double kTurnOuterPx = 16.0;  // about as far as a corner of a drawing stands free
constexpr double kSamePlacePx = 2.0;
constexpr double kSliverPx = 12.0;  // a piece shorter than this has no points beyond the rounded zones of its corners
constexpr float kCornerSigmaPx = 0.1f;
constexpr double kSnapOuterPx = 64.0;  // looked at on either side before the neighbours are known

struct Nearest {
  int contour = -1;
  int index = -1;
  double squared = 0.0;
};

Nearest nearestOf(const ContourSet& set, const Vec2& at, double limit) {
  Nearest best;
  best.squared = limit * limit;
  for (std::size_t c = 0; c < set.contours.size(); ++c) {
    const auto& points = set.contours[c].points;
    // The sharp point of a pen stroke is one of the points that were drawn (004 section 3.2), none in between.
    const bool onlyDrawn = isDrawn(set.contours[c].kind);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (onlyDrawn && !points[i].refined) continue;
      const double d = (points[i].at - at).squaredNorm();
      if (d < best.squared || (best.contour < 0 && d == best.squared)) {
        best = {static_cast<int>(c), static_cast<int>(i), d};
      }
    }
  }
  return best;
}

// The first of equally sharp points within this of each other stands for the turn.
constexpr double kOneTurnPx = 5.0;

// A click need not be exact: a sharp turn within the snap distance wins over the nearest point, the nearer and sharper
// one first. The turn is where its two sides meet when extended, because the filter of the mask ends a contour 10 px
// and more before an acute tip. On a smooth part no point turns, and the nearest one is taken.
struct Snap {
  int index = -1;
  double distance = 0.0;  // [px] from the mark to the turn or the point
  double score = 0.0;
};

void considerTurns(const Contour& contour, const Vec2& mark, double snap, int first, int last, Snap& best) {
  const int n = static_cast<int>(contour.points.size());
  struct Turn {
    int index;
    double score;
  };
  std::vector<Turn> turns;
  for (int k = first; k <= last; ++k) {
    const int i = contour.closed ? wrapIndex(k, n) : k;
    if ((contour.points[i].at - mark).norm() > snap + kFarthestTipPx) continue;
    const double inner = contour.kind == ContourKind::Outline ? kTurnInnerPx : roundedZonePx(contour, i);
    const auto turning = turningAt(contour, i, inner, kTurnOuterPx + 2.0 * (inner - kTurnInnerPx));
    if (!turning || std::abs(turning->angleRad) < kLooksLikeCornerRad) continue;
    turns.push_back({i, turning->score});
  }
  std::stable_sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) { return a.score > b.score; });
  std::vector<Vec2> taken;
  for (const Turn& turn : turns) {
    const Vec2& at = contour.points[turn.index].at;
    if (std::any_of(taken.begin(), taken.end(), [&](const Vec2& t) { return (t - at).norm() < kOneTurnPx; })) continue;
    taken.push_back(at);
    const CornerFix fix =
        locateCorner(contour, turn.index, roundedZonePx(contour, turn.index), kSnapOuterPx, kSnapOuterPx);
    const double distance = (fix.position - mark).norm();
    const double score = turn.score * (1.0 - 0.5 * distance / snap);
    if (distance <= snap && score > best.score) best = {turn.index, distance, score};
  }
}

// The stretches of a contour near a mark, as index ranges (a closed contour's first may begin before 0).
Snap sharpestNear(const Contour& contour, const Vec2& mark, double snap) {
  Snap best;
  const int n = static_cast<int>(contour.points.size());
  const double reach = snap + kFarthestTipPx;
  const auto near = [&](int i) { return (contour.points[i].at - mark).squaredNorm() <= reach * reach; };
  for (int i = 0; i < n; ++i) {
    if (!near(i)) {
      // Points lie less than 2 px apart, so those skipped cannot be near. A mark may be any distance away.
      const double away = (contour.points[i].at - mark).norm() - reach;
      i += static_cast<int>(std::clamp(std::floor(0.5 * away) - 1.0, 0.0, static_cast<double>(n)));
      continue;
    }
    int end = i;
    while (end + 1 < n && near(end + 1)) ++end;
    considerTurns(contour, mark, snap, i, end, best);
    i = end;
  }
  return best;
}

// A corner while the pieces are cut.
struct Cut {
  Corner corner;
  double zone = 4.0;     // [px] points nearer than this are left out
  bool isMarked = true;  // else it is a joint of the line itself
  bool exact = false;
};

void locateCuts(const Contour& contour, const GreyImage* grey, std::vector<Cut>& cuts) {
  std::vector<int> places;
  for (const Cut& cut : cuts) places.push_back(cut.corner.pointIndex);
  const std::vector<CornerFix> fixes = locateCorners(contour, places, grey);
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    cuts[i].corner.positionPx = fixes[i].position;
    cuts[i].corner.turningAngleRad = fixes[i].angleRad;
    cuts[i].exact = fixes[i].exact;
    cuts[i].zone = fixes[i].zonePx;
  }
}

// How many points to leave out at one end of a piece: those inside the rounded zone, those that lie behind the corner,
// and beyond them those that were not measured but laid between measured ones.
std::size_t pointsToDrop(const Piece& piece, bool isPen, bool fromEnd, const Vec2& corner, double zone) {
  const std::size_t n = piece.points.size();
  std::size_t drop = 0;
  double arc = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = fromEnd ? n - 1 - k : k;
    const Vec2& p = piece.points[i];
    if (k > 0) arc += (p - piece.points[fromEnd ? n - k : k - 1]).norm();
    if (arc > 3.0 * zone + 12.0) break;
    const bool guessed = drop == k && piece.refined[i] == 0 && !isPen;
    if ((p - corner).norm() < zone || arc < zone || guessed) drop = k + 1;
  }
  return drop;
}

// One piece from point index `from` to `to` (unwrapped, to >= from) with its ends put on the corners.
Piece makePiece(const ContourSet& set, int contourIndex, int from, int to, const Cut* start, const Cut* end) {
  const Contour& contour = set.contours[contourIndex];
  const int n = static_cast<int>(contour.points.size());
  Piece piece;
  piece.contour = contourIndex;
  piece.firstPoint = from;
  piece.lastPoint = to;
  for (int i = from; i <= to; ++i) {
    const ContourPoint& p = contour.points[wrapIndex(i, n)];
    piece.points.push_back(p.at);
    piece.refined.push_back(p.refined ? 1 : 0);
    if (p.sigmaPx) piece.sigmaPx.push_back(*p.sigmaPx);
    if (p.band) piece.spreadPx.push_back(0.5f * (p.band->left + p.band->right));
  }
  const auto zoneOf = [&](const Cut* cut) { return cut->exact ? cut->zone : 0.5; };
  std::size_t head = 0, tail = 0;
  if (start != nullptr)
    head = pointsToDrop(piece, isDrawn(contour.kind), false, start->corner.positionPx, zoneOf(start));
  if (end != nullptr) tail = pointsToDrop(piece, isDrawn(contour.kind), true, end->corner.positionPx, zoneOf(end));
  if (head + tail >= piece.points.size()) head = piece.points.size(), tail = 0;
  const auto cutEnds = [&](auto& values) {
    values.erase(values.end() - static_cast<std::ptrdiff_t>(tail), values.end());
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(head));
  };
  cutEnds(piece.points);
  cutEnds(piece.refined);
  if (start != nullptr) {
    piece.points.insert(piece.points.begin(), start->corner.positionPx);
    piece.refined.insert(piece.refined.begin(), start->exact || isDrawn(contour.kind) ? 1 : 0);
    piece.startIsCorner = true;
  }
  if (end != nullptr) {
    piece.points.push_back(end->corner.positionPx);
    piece.refined.push_back(end->exact || isDrawn(contour.kind) ? 1 : 0);
    piece.endIsCorner = true;
  }
  const auto cutValues = [&](std::vector<float>& values, float ofAlone) {
    if (values.empty()) return;
    cutEnds(values);
    // Of a corner: what is known of the line next to it.
    const float first = values.empty() ? ofAlone : values.front(), last = values.empty() ? ofAlone : values.back();
    if (start != nullptr) values.insert(values.begin(), first);
    if (end != nullptr) values.push_back(last);
  };
  cutValues(piece.sigmaPx, kCornerSigmaPx);
  cutValues(piece.spreadPx, 0.0f);
  piece.lengthPx = polylineLength(piece.points, false);
  return piece;
}

void cutContour(const ContourSet& set, int c, const std::vector<Cut>& cuts, PieceSet& out) {
  const Contour& contour = set.contours[c];
  const int n = static_cast<int>(contour.points.size());
  if (n == 0) return;
  std::vector<Piece> pieces;
  if (cuts.empty()) {
    pieces.push_back(makePiece(set, c, 0, n - 1, nullptr, nullptr));
    pieces.back().closed = contour.closed;
    pieces.back().lengthPx = polylineLength(pieces.back().points, contour.closed);
  } else if (contour.closed) {
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      const Cut& next = cuts[(i + 1) % cuts.size()];
      const int from = cuts[i].corner.pointIndex;
      const int to = next.corner.pointIndex + (i + 1 == cuts.size() ? n : 0);
      pieces.push_back(makePiece(set, c, from, to, &cuts[i], &next));
    }
  } else {
    const Cut* previous = nullptr;
    int from = 0;
    for (const Cut& cut : cuts) {
      pieces.push_back(makePiece(set, c, from, cut.corner.pointIndex, previous, &cut));
      previous = &cut;
      from = cut.corner.pointIndex;
    }
    pieces.push_back(makePiece(set, c, from, n - 1, previous, nullptr));
  }
  // A mark at the very end of a line leaves nothing on its far side.
  std::erase_if(pieces, [](const Piece& p) { return p.points.size() < 2 || !(p.lengthPx > 0.0); });
  int index = 0;
  for (Piece& piece : pieces) {
    piece.index = index++;
    out.pieces.push_back(std::move(piece));
  }
}

void noteCloseCorners(const Contour& contour, const std::vector<Cut>& cuts, PieceSet& out) {
  if (cuts.size() < 2) return;
  const std::vector<Vec2> points = positionsOf(contour.points);
  const double length = contour.closed ? polylineLength(points, true) : 0.0;
  const std::vector<double> arc = cumulativeLength(points);
  const auto at = [&arc](const Cut& cut) { return arc[cut.corner.pointIndex]; };
  // A closed line comes round to its first corner, which with two of them is looked at from both sides.
  for (std::size_t i = 0; i < (contour.closed ? cuts.size() : cuts.size() - 1); ++i) {
    const Cut &one = cuts[i], &next = cuts[(i + 1) % cuts.size()];
    const double along = at(next) - at(one) + (i + 1 == cuts.size() ? length : 0.0);
    const double apart = (next.corner.positionPx - one.corner.positionPx).norm();
    if (along >= kSliverPx || apart >= kSliverPx) continue;
    out.closeCorners.push_back(
        {std::max(one.corner.mark, next.corner.mark), std::min(one.corner.mark, next.corner.mark), apart});
  }
}

}  // namespace

std::optional<Error> validate(const CornerParams& p) {
  if (p.snapDistancePx > 0.0 && std::isfinite(p.snapDistancePx)) return std::nullopt;
  return Error{ErrorCode::BadParameter, "corners.snap must be more than 0 px.", {}};
}

std::optional<Corner> nearestContourPoint(const ContourSet& set, const Vec2& positionPx, double snapDistancePx) {
  if (!positionPx.allFinite() || !(snapDistancePx >= 0.0)) return std::nullopt;
  Corner corner;
  Snap best;
  for (std::size_t c = 0; c < set.contours.size() && snapDistancePx > 0.0; ++c) {
    if (isDrawn(set.contours[c].kind)) continue;
    const Snap snap = sharpestNear(set.contours[c], positionPx, snapDistancePx);
    if (snap.index >= 0 && snap.score > best.score) best = snap, corner.contour = static_cast<int>(c);
  }
  const Nearest nearest = nearestOf(set, positionPx, snapDistancePx);
  const bool isOnPen = nearest.contour >= 0 && isDrawn(set.contours[nearest.contour].kind);
  // A drawn point means itself: it need not be the sharpest place around.
  if (best.index < 0 || (isOnPen && std::sqrt(nearest.squared) < best.distance)) {
    if (nearest.contour < 0) return std::nullopt;
    corner.contour = nearest.contour;
    best.index = nearest.index;
    best.distance = std::sqrt(nearest.squared);
  }
  const Contour& contour = set.contours[corner.contour];
  corner.pointIndex = best.index;
  corner.snapPx = best.distance;
  corner.positionPx = contour.points[best.index].at;
  if (const auto turning = turningAt(contour, best.index, kTurnInnerPx, kTurnOuterPx)) {
    corner.turningAngleRad = turning->angleRad;
  }
  return corner;
}

namespace {

// The joints of a line join its marks; a mark beside one means it.
void addJoints(const Contour& contour, int index, std::vector<Cut>& cuts) {
  for (const int joint : contour.joints) {
    Corner corner;
    corner.contour = index;
    corner.pointIndex = joint;
    corner.positionPx = contour.points[joint].at;
    const auto beside = std::find_if(cuts.begin(), cuts.end(), [&](const Cut& cut) {
      return (cut.corner.positionPx - corner.positionPx).norm() <= kSamePlacePx;
    });
    if (beside == cuts.end()) {
      cuts.push_back({.corner = corner, .isMarked = false});
    } else {
      beside->corner.pointIndex = joint;
      beside->corner.positionPx = corner.positionPx;
    }
  }
}

}  // namespace

Result<PieceSet> splitAtCorners(const ContourSet& set, std::span<const CornerMark> marks, const CornerParams& params,
                                const GreyImage* grey) {
  if (auto error = validate(params)) return fail(*error);
  PieceSet out;
  std::vector<std::vector<Cut>> cuts(set.contours.size());
  for (std::size_t m = 0; m < marks.size(); ++m) {
    auto corner = nearestContourPoint(set, marks[m].positionPx, params.snapDistancePx);
    if (!corner) {
      out.lostMarks.push_back(static_cast<int>(m));
      continue;
    }
    corner->mark = static_cast<int>(m);
    const auto c = static_cast<std::size_t>(corner->contour);
    const auto known = std::find_if(cuts[c].begin(), cuts[c].end(), [&](const Cut& other) {
      return (other.corner.positionPx - corner->positionPx).norm() <= kSamePlacePx;
    });
    if (known == cuts[c].end()) {
      cuts[c].push_back({*corner});
    } else {
      out.sameCorner.push_back({corner->mark, known->corner.mark, 0.0});
    }
  }
  for (std::size_t c = 0; c < set.contours.size(); ++c) {
    addJoints(set.contours[c], static_cast<int>(c), cuts[c]);
    std::sort(cuts[c].begin(), cuts[c].end(),
              [](const Cut& a, const Cut& b) { return a.corner.pointIndex < b.corner.pointIndex; });
    const Contour& contour = set.contours[c];
    // A pen stroke is exact already: its corner is the point that was drawn.
    if (params.exact && !isDrawn(contour.kind) && !cuts[c].empty()) {
      locateCuts(contour, grey, cuts[c]);
    }
    cutContour(set, static_cast<int>(c), cuts[c], out);
    std::erase_if(cuts[c], [](const Cut& cut) { return !cut.isMarked; });
    noteCloseCorners(contour, cuts[c], out);
    for (const Cut& cut : cuts[c]) out.corners.push_back(cut.corner);
  }
  return out;
}

}  // namespace batten
