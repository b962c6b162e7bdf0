// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/piece_choices.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "core/pipeline/run/choice_course.h"
#include "core/pipeline/run/curve_stages.h"
#include "core/polyline/point_grid.h"
#include "core/polyline/polyline_tools.h"
#include "core/polyline/thinning.h"

namespace batten {
namespace {

/// [px] A choice farther than this from every line has lost its line.
constexpr double kAnchorReachPx = 24.0;
/// [px] A line on a course given by several anchors lies within this: thresholds and filters move a line by less, and
/// of lines that are nearer to each other, like the two borders of a thin stroke, the nearest one is taken.
constexpr double kCourseReachPx = 8.0;
/// [px] A point farther than this from where a course ends lies beyond it.
constexpr double kPastEndPx = 1.0;
/// [px] A choice that much nearer to a piece counts before a later one.
constexpr double kAboutAsNearPx = 2.0;

double distanceTo(const Piece& piece, const Vec2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const PiecePoint& q : piece.points) nearest = std::min(nearest, (q.at - p).squaredNorm());
  return std::sqrt(nearest);
}

/// The piece nearest to a place, the first of equals; none beyond the reach.
std::optional<std::size_t> nearestPiece(const PieceSet& set, const Vec2& p) {
  std::optional<std::size_t> owner;
  double nearest = kAnchorReachPx;
  for (std::size_t piece = 0; piece < set.pieces.size(); ++piece) {
    const double distance = distanceTo(set.pieces[piece], p);
    if (distance > nearest || (owner && distance == nearest)) continue;
    nearest = distance;
    owner = piece;
  }
  return owner;
}

/// A piece that a choice would have, and how near it lies [px].
struct Claim {
  std::size_t piece = 0;
  double distance = 0.0;
};

std::vector<Claim> claimsOfPlace(const PieceSet& set, const std::vector<Vec2>& anchors) {
  const auto owner = anchors.empty() ? std::nullopt : nearestPiece(set, anchors.front());
  if (!owner) return {};
  return {{*owner, distanceTo(set.pieces[*owner], anchors.front())}};
}

/// Finds the pieces that lie on a course given by anchors.
class CourseFinder {
 public:
  /// Only pieces near a course are looked at: most choices are few.
  CourseFinder(const PieceSet& set, const std::vector<PieceChoice>& choices) : set_(set) {
    std::vector<Eigen::AlignedBox2d> courses;
    for (const PieceChoice& choice : choices) {
      if (choice.anchorsPx.size() < 2) continue;
      Eigen::AlignedBox2d& box = courses.emplace_back(boxOf(choice.anchorsPx));
      box.min().array() -= kCourseReachPx;
      box.max().array() += kCourseReachPx;
    }
    for (std::size_t piece = 0; piece < set.pieces.size(); ++piece) {
      const Eigen::AlignedBox2d box = boxOf(positionsOf(set.pieces[piece].points));
      if (std::none_of(courses.begin(), courses.end(), [&](const auto& c) { return c.intersects(box); })) continue;
      for (const PiecePoint& p : set.pieces[piece].points) {
        cells_.add(p.at, places_.size());
        places_.push_back({p.at, piece});
      }
    }
    feet_.resize(places_.size());
  }

  std::vector<Claim> piecesOn(const std::vector<Vec2>& anchors) {
    const std::vector<Vec2> course = courseOf(anchors);
    const bool closed = anchors.front() == anchors.back();
    std::vector<std::size_t> owners(course.size(), set_.pieces.size()), touched;
    for (std::size_t k = 0; k < course.size(); ++k) {
      double nearest = kCourseReachPx;
      cells_.around(course[k], [&](std::size_t place) {
        const std::size_t piece = places_[place].piece;
        const double distance = (places_[place].at - course[k]).norm();
        if (distance > kCourseReachPx) return;
        if (distance < nearest || (distance == nearest && piece < owners[k])) nearest = distance, owners[k] = piece;
        Foot& foot = feet_[place];
        if (!std::isfinite(foot.distance)) touched.push_back(place);
        if (distance < foot.distance) foot = {distance, k};
      });
    }
    std::map<std::size_t, Share> shares;
    for (const std::size_t place : touched) {
      const Foot foot = std::exchange(feet_[place], {});
      const bool isAtAnEnd = foot.at == 0 || foot.at + 1 == course.size();
      const bool isPastAnEnd = !closed && isAtAnEnd && foot.distance > kPastEndPx;
      if (isPastAnEnd || owners[foot.at] != places_[place].piece) continue;
      Share& share = shares[places_[place].piece];
      ++share.points;
      share.distance += foot.distance;
    }
    std::vector<Claim> claims;
    for (const auto& [piece, share] : shares) {
      // Half is enough: both points of the shortest pieces are corners that their neighbours have, too.
      if (2 * share.points < set_.pieces[piece].points.size()) continue;
      claims.push_back({piece, share.distance / static_cast<double>(share.points)});
    }
    return claims;
  }

 private:
  struct Place {
    Vec2 at;
    std::size_t piece;
  };
  /// The point of the course that is nearest to a place.
  struct Foot {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t at = 0;
  };
  struct Share {
    std::size_t points = 0;
    double distance = 0.0;
  };

  static Eigen::AlignedBox2d boxOf(const std::vector<Vec2>& points) {
    Eigen::AlignedBox2d box;
    for (const Vec2& p : points) box.extend(p);
    return box;
  }

  /// Points along the polyline of the anchors, closer together than those of a piece.
  static std::vector<Vec2> courseOf(const std::vector<Vec2>& anchors) {
    // Places that no line can have must not ask for endless points.
    constexpr double kStepPx = 1.0, kMostPoints = 1e6;
    const double step = std::max(kStepPx, polylineLength(anchors, false) / kMostPoints);
    std::vector<Vec2> course = {anchors.front()};
    for (std::size_t i = 1; i < anchors.size(); ++i) {
      const Vec2 chord = anchors[i] - anchors[i - 1];
      const int count = std::max(1, static_cast<int>(std::ceil(chord.norm() / step)));
      for (int k = 1; k <= count; ++k) course.push_back(anchors[i - 1] + (static_cast<double>(k) / count) * chord);
    }
    return course;
  }

  const PieceSet& set_;
  std::vector<Place> places_;  ///< All points of the pieces near a course.
  std::vector<Foot> feet_;     ///< One per place, cleared after use.
  PointGrid<std::size_t> cells_{kCourseReachPx};
};

}  // namespace

ChoiceOwners assignChoices(const PieceSet& set, const std::vector<PieceChoice>& choices) {
  ChoiceOwners owners;
  owners.ofPiece.resize(set.pieces.size());
  std::vector<double> distances(set.pieces.size(), std::numeric_limits<double>::infinity());
  std::optional<CourseFinder> finder;
  for (std::size_t choice = 0; choice < choices.size(); ++choice) {
    const std::vector<Vec2>& anchors = choices[choice].anchorsPx;
    if (anchors.size() > 1 && !finder) finder.emplace(set, choices);
    const std::vector<Claim> claims = anchors.size() > 1 ? finder->piecesOn(anchors) : claimsOfPlace(set, anchors);
    if (claims.empty() && !choices[choice].isEmpty()) owners.waiting.push_back(choice);
    for (const Claim& claim : claims) {
      if (claim.distance > distances[claim.piece] + kAboutAsNearPx) continue;
      owners.ofPiece[claim.piece] = choice;
      distances[claim.piece] = claim.distance;
    }
  }
  return owners;
}

std::size_t makeOwnChoice(std::vector<PieceChoice>& choices, const PieceSet& set, std::size_t piece) {
  const auto owners = assignChoices(set, choices).ofPiece;
  const std::optional<std::size_t> found = owners[piece];
  // Edited is what the piece has: said along the line as it runs now.
  PieceChoice own = found ? alongPiece(choices[*found], set.pieces[piece]) : PieceChoice{};
  const bool isShared = found && std::count(owners.begin(), owners.end(), found) > 1;
  if (found && !isShared) {
    const bool isReversed = !(own == choices[*found]);
    // One of a recipe that knew single anchors only has no course yet.
    if (isReversed || own.anchorsPx.size() == 1) own.anchorsPx = anchorsOf(set.pieces[piece]);
    choices[*found] = std::move(own);
    return *found;
  }
  own.anchorsPx = anchorsOf(set.pieces[piece]);
  own.isPart = isShared;
  choices.push_back(std::move(own));
  return choices.size() - 1;
}

std::vector<PieceChoice> choicesForMethods(const Recipe& recipe) {
  std::vector<PieceChoice> competing;
  std::copy_if(recipe.choices.begin(), recipe.choices.end(), std::back_inserter(competing),
               [](const PieceChoice& choice) { return choice.method || choice.detail || choice.isPart; });
  return competing;
}

std::vector<std::vector<std::size_t>> assignExtremumChoices(const PieceSet& set, const Recipe& recipe) {
  std::vector<std::vector<std::size_t>> assigned(set.pieces.size());
  for (std::size_t i = 0; i < recipe.extremumChoices.size(); ++i) {
    if (const auto owner = nearestPiece(set, recipe.extremumChoices[i].positionPx)) assigned[*owner].push_back(i);
  }
  return assigned;
}

Vec2 anchorOf(const Piece& piece) {
  return piece.points.empty() ? Vec2(Vec2::Zero()) : piece.points[piece.points.size() / 2].at;
}

std::vector<Vec2> anchorsOf(const Piece& piece) {
  // anchors follow the line so closely; [px] and are rounded to this
  constexpr double kStraightPx = 1.5, kRoundedTo = 0.1;
  std::vector<Vec2> points = positionsOf(piece.points);
  if (piece.closed && !points.empty()) points.push_back(points.front());
  std::vector<Vec2> anchors;
  for (const int i : thinnedByTolerance(points, {}, kStraightPx)) {
    const Vec2& p = points[i];
    anchors.emplace_back(kRoundedTo * std::round(p.x() / kRoundedTo), kRoundedTo * std::round(p.y() / kRoundedTo));
  }
  return anchors;
}

}  // namespace batten
