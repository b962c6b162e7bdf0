// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/choice_course.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/segment_foot.h"
#include "core/fairing/profile/drawn_profile.h"

namespace batten {
namespace {

/// Ends nearer to each other than this share of the course are the same end: thresholds and filters move a line a
/// little.
constexpr double kSameEnd = 0.03;
/// Places of a piece at which it is compared with the course: enough for a vote that no crossing of the line upsets.
constexpr std::size_t kPlaces = 65;
constexpr double kRounding = 1e-9;  // of shares
/// A point nearer to the begin of a closed line than this share lies on it: anchors are spaced, so shares are a little
/// off, and a point just before the begin would bend the profile there.
constexpr double kSeam = 5e-3;

double fractionOf(double share) { return share - std::floor(share); }

/// The polyline of a choice's anchors, measured in shares of its length.
class Course {
 public:
  explicit Course(const std::vector<Vec2>& anchors)
      : anchors_(anchors), closed_(anchors.size() > 2 && anchors.front() == anchors.back()) {
    lengths_.push_back(0.0);
    for (std::size_t i = 1; i < anchors.size(); ++i)
      lengths_.push_back(lengths_.back() + (anchors[i] - anchors[i - 1]).norm());
  }
  bool isClosed() const { return closed_; }
  bool isPoint() const { return !(lengths_.back() > 0.0); }

  double shareAt(const Vec2& place) const {
    double nearest = std::numeric_limits<double>::infinity(), at = 0.0;
    for (std::size_t i = 1; i < anchors_.size(); ++i) {
      const SegmentFoot foot = footOnSegment(place, anchors_[i - 1], anchors_[i]);
      const double distance = foot.away.squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      at = lengths_[i - 1] + foot.share * (lengths_[i] - lengths_[i - 1]);
    }
    return at / lengths_.back();
  }

 private:
  const std::vector<Vec2>& anchors_;
  std::vector<double> lengths_;
  bool closed_;
};

/// How a piece runs on a course: from `start`, forwards or backwards, over `covered` of it.
struct CourseStretch {
  double start = 0.0, covered = 1.0;
  bool isReversed = false;
  bool isWhole() const { return start == 0.0 && covered == 1.0 && !isReversed; }
};

CourseStretch runOf(const Course& course, const Piece& piece) {
  std::vector<double> shares;
  const std::size_t count = std::min(kPlaces, piece.points.size());
  for (std::size_t i = 0; i < count; ++i)
    shares.push_back(course.shareAt(piece.points[i * (piece.points.size() - 1) / (count - 1)].at));
  double forwards = 0.0, advance = 0.0;
  for (std::size_t i = 1; i < shares.size(); ++i) {
    double step = shares[i] - shares[i - 1];
    if (course.isClosed()) step -= std::round(step);
    // Where the line comes near itself a place may fall on another stretch: such jumps say nothing.
    if (std::abs(step) > 0.25) continue;
    forwards += step > 0.0 ? 1.0 : step < 0.0 ? -1.0 : 0.0;
    advance += step;
  }
  CourseStretch run;
  run.isReversed = forwards != 0.0 ? forwards < 0.0 : advance < 0.0;
  if (course.isClosed()) {
    run.start = shares.front();
    run.covered = piece.closed ? 1.0 : std::min(1.0, std::abs(advance));
    if (run.covered > 1.0 - kSameEnd) run.covered = 1.0;
    if (run.covered == 1.0 && std::abs(run.start - std::round(run.start)) < kSameEnd) run.start = 0.0;
    return run;
  }
  const auto [low, high] = std::minmax_element(shares.begin(), shares.end());
  const double from = *low < kSameEnd ? 0.0 : *low, to = *high > 1.0 - kSameEnd ? 1.0 : *high;
  run.covered = to - from;
  run.start = run.isReversed ? to : from;
  if (run.isReversed && run.covered == 1.0) run.start = 1.0;
  return run;
}

/// The drawn profile as the piece runs.
std::vector<ProfilePoint> profileAlong(const std::vector<ProfilePoint>& profile, const CourseStretch& run,
                                       bool closedCourse) {
  const double side = run.isReversed ? -1.0 : 1.0;
  const auto courseShare = [&](double t) {
    const double share = run.start + side * t * run.covered;
    return closedCourse ? (share == 1.0 ? 1.0 : fractionOf(share)) : std::clamp(share, 0.0, 1.0);
  };
  const TargetProfile drawn = drawnProfile(profile, closedCourse);
  std::vector<ProfilePoint> points;
  const bool isPart = run.covered < 1.0;
  // The ends of a part are added below, where its profile is cut.
  const double least = isPart ? kSameEnd : -kRounding, most = isPart ? 1.0 - kSameEnd : 1.0 + kRounding;
  for (const ProfilePoint& p : profile) {
    const double along = side * (p.fraction - run.start);
    double t = (closedCourse ? fractionOf(along) : along) / run.covered;
    if (closedCourse && !isPart && std::min(t, 1.0 - t) < kSeam) t = 0.0;
    if (t >= least && t <= most) points.push_back({std::clamp(t, 0.0, 1.0), side * p.kappa});
  }
  std::sort(points.begin(), points.end(),
            [](const ProfilePoint& a, const ProfilePoint& b) { return a.fraction < b.fraction; });
  // Begin and end of a closed course are one place.
  const auto isSame = [](const ProfilePoint& a, const ProfilePoint& b) { return b.fraction - a.fraction < kRounding; };
  points.erase(std::unique(points.begin(), points.end(), isSame), points.end());
  if (isPart) {
    points.insert(points.begin(), {0.0, side * drawn.curvatureAt(courseShare(0.0))});
    points.push_back({1.0, side * drawn.curvatureAt(courseShare(1.0))});
  }
  return points;
}

}  // namespace

PieceChoice alongPiece(PieceChoice choice, const Piece& piece) {
  if (choice.anchorsPx.size() < 2 || piece.points.size() < 2) return choice;
  const Course course(choice.anchorsPx);
  if (course.isPoint()) return choice;
  const CourseStretch run = runOf(course, piece);
  if (run.isWhole() || !(run.covered > 0.0)) return choice;
  if (run.isReversed) std::swap(choice.startHold, choice.endHold);
  if (choice.profile.empty()) return choice;
  std::vector<ProfilePoint> profile = profileAlong(choice.profile, run, course.isClosed());
  if (profile.size() >= 2 && !validateProfile(profile)) choice.profile = std::move(profile);
  return choice;
}

}  // namespace batten
