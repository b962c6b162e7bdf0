// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/bezier/bezier_chain.h"

#include <algorithm>
#include <cmath>

#include "core/construct/stations/piece_stations.h"
#include "core/solve/residual_blocks.h"

namespace batten {

namespace {

/// The least length of the low pass; where stations were set closer, the least is shorter by as much.
constexpr double kShortestLowPassPx = 20.0;
constexpr double kKernelWidths = 8.0;  // standard deviations of a Gaussian; beyond it is 1e-14
/// Weights of one px: offset of a joint, turn of a joint (over a quarter of a segment), sagitta of a segment that the
/// curvature misses, change of that miss along a segment. Tuned on ellipses and roof lines with noise of 0 to 0.3 px.
constexpr double kOffsetWeight = 0.2;
constexpr double kPinnedOffsetWeight = 1e6;  // of the offset of an end: it stays where it is
constexpr double kAngleWeight = 0.05;        // of the turn of a joint
constexpr double kLevelWeight = 0.05;        // of the sagitta that is missed
constexpr double kChangeWeight = 3.0;  // of its change: the path may lie beside its target over a bend, but is fair
/// Places within a piece, as shares of its length, at which the curvature is compared; the start stands for the joint.
constexpr std::array<double, 5> kPlaces = {0.0, 0.2, 0.4, 0.6, 0.8};

Vec2 rotated(const Vec2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// The chain in terms of its unknowns: per joint offset [px], turn [px over a quarter of a segment], curvature change
/// [px of sagitta]; all about 1.
class Chain {
 public:
  /// @param share as SpacedStation::share, of every joint. @param lengths of the pieces between the joints.
  Chain(std::span<const Joint> joints, std::span<const double> share, std::vector<double> lengths, bool closed)
      : lengths_(std::move(lengths)), closed_(closed) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const double before = lengths_[i > 0 ? i - 1 : (closed ? lengths_.size() - 1 : 0)];
      const double reach = 0.5 * (before + (i < lengths_.size() ? lengths_[i] : before));
      joints_.push_back({joints[i], share[i], reach});
    }
  }

  std::size_t count() const { return joints_.size(); }
  std::size_t pieces() const { return lengths_.size(); }
  double length(std::size_t i) const { return lengths_[i]; }
  std::size_t next(std::size_t i) const { return (i + 1) % joints_.size(); }

  Joint moved(std::size_t i, const double* x) const {
    Joint joint = joints_[i].at;
    joint.point += x[0] * leftNormal(joint.tangent);
    joint.tangent = rotated(joint.tangent, x[1] * angleUnit(i));
    joint.kappa += x[2] * kappaUnit(i);
    return joint;
  }
  double angleUnit(std::size_t i) const { return 1.0 / (0.25 * joints_[i].reach); }
  double kappaUnit(std::size_t i) const { return 8.0 / (joints_[i].reach * joints_[i].reach); }

  std::vector<ResidualBlock> blocks(const std::vector<double>& targets) const {
    std::vector<ResidualBlock> result;
    for (std::size_t i = 0; i < pieces(); ++i) {
      const std::size_t j = next(i);
      ResidualBlock block;
      for (const std::size_t joint : {i, j}) {
        for (int k = 0; k < 3; ++k) block.columns.push_back(static_cast<int>(3 * joint) + k);
      }
      block.size = 2 * static_cast<int>(kPlaces.size());
      const double reach = std::max(lengths_[i], kShortestLowPassPx * std::min(joints_[i].share, joints_[j].share));
      const double weight = reach * reach / 8.0 / std::sqrt(static_cast<double>(kPlaces.size()));
      block.evaluate = [this, i, j, weight, &targets](std::span<const double> x, std::span<double> r) {
        const Quintic q = quinticHermite(moved(i, &x[0]), moved(j, &x[3]), lengths_[i]);
        // How far the curvature misses its target, little; how quickly the miss changes along the piece, much: the
        // target may be too low or high over a bend, but it is fair.
        constexpr std::size_t kCount = kPlaces.size();
        double last = 0.0;
        for (std::size_t k = 0; k <= kCount; ++k) {
          const bool end = k == kCount;
          const double target = end ? targets[j * kCount] : targets[i * kCount + k];
          const double miss = weight * (evaluate(q, end ? 1.0 : kPlaces[k]).curvature() - target);
          if (!end) r[k] = kLevelWeight * miss;
          if (k > 0) r[kCount + k - 1] = kChangeWeight * (miss - last);
          last = miss;
        }
      };
      result.push_back(std::move(block));
    }
    for (std::size_t i = 0; i < count(); ++i) {
      const bool pinned = !closed_ && (i == 0 || i + 1 == count());
      ResidualBlock block;
      block.columns = {static_cast<int>(3 * i), static_cast<int>(3 * i) + 1};
      block.size = 2;
      block.evaluate = [pinned](std::span<const double> x, std::span<double> r) {
        r[0] = (pinned ? kPinnedOffsetWeight : kOffsetWeight) * x[0];
        r[1] = kAngleWeight * x[1];
      };
      result.push_back(std::move(block));
    }
    return result;
  }

  std::vector<Joint> joints(const Eigen::VectorXd& x) const {
    std::vector<Joint> all;
    for (std::size_t i = 0; i < count(); ++i) {
      std::array<double, 3> own = {x(static_cast<Eigen::Index>(3 * i)), x(static_cast<Eigen::Index>(3 * i + 1)),
                                   x(static_cast<Eigen::Index>(3 * i + 2))};
      if (!closed_ && (i == 0 || i + 1 == count())) own[0] = 0.0;
      all.push_back(moved(i, own.data()));
    }
    if (closed_) all.push_back(all.front());
    return all;
  }

 private:
  struct ChainJoint {
    Joint at;
    double share = 1.0;  ///< Of the distance that there was before stations were set closer.
    double reach = 0.0;  ///< [px] Mean length of the pieces beside it.
  };

  std::vector<ChainJoint> joints_;
  std::vector<double> lengths_;  ///< [px] Of the pieces; open: one fewer than joints.
  bool closed_;
};

/// Joints of the path as 001 leaves it: mean curvature of both sides at every joint.
std::vector<Joint> jointsOf(std::vector<Quintic> path, std::span<const Station> stations, bool closed) {
  std::vector<Joint> joints;
  for (const Station& s : stations) joints.push_back({s.point, s.direction, 0.0});
  const std::size_t pieces = path.size();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    std::optional<double> kappa;
    if (!closed && i == 0) {
      kappa = startCurvature(path.front());
    } else if (!closed && i == pieces) {
      kappa = endCurvature(path.back());
    } else {
      kappa = equaliseJoint(path[(i + pieces - 1) % pieces], path[i]);
    }
    joints[i].kappa = kappa.value_or(0.0);
  }
  return joints;
}

/// Change of direction from one station to the next over their distance.
struct StationTurn {
  double start = 0.0, length = 0.0;  ///< [px] along the stations
  double kappa = 0.0;                ///< [1/px] at the middle.
  double missed = 0.0;               ///< What smoothing it once leaves.

  double middle() const { return start + 0.5 * length; }
};
struct TurningData {
  bool closed;
  std::vector<StationTurn> turns;
  double total = 0.0;

  TurningData(std::span<const Station> stations, bool isClosed) : closed(isClosed) {
    const std::vector<double> lengths = arcCorrectedDistances(stations, isClosed);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      const Vec2 &a = stations[i].direction, &b = stations[(i + 1) % stations.size()].direction;
      const double kappa = lengths[i] > 0.0 ? std::atan2(cross(a, b), a.dot(b)) / lengths[i] : 0.0;
      turns.push_back({total, lengths[i], kappa});
      total += lengths[i];
    }
  }
  /// Local-linear Gaussian of a value of the turns. Unlike smoothPolyline() it weighs by length, as stations lie at any
  /// distances, keeps slopes at open ends, and takes another width at every place.
  double smoothed(double StationTurn::*value, double s, double width) const {
    double w0 = 0, w1 = 0, w2 = 0, k0 = 0, k1 = 0;
    for (const StationTurn& turn : turns) {
      double away = turn.middle() - s;
      if (closed) away -= total * std::round(away / total);
      if (std::abs(away) > kKernelWidths * width) continue;
      const double w = turn.length * std::exp(-0.5 * away * away / (width * width));
      w0 += w;
      w1 += w * away;
      w2 += w * away * away;
      k0 += w * turn.*value;
      k1 += w * away * turn.*value;
    }
    const double determinant = w0 * w2 - w1 * w1;
    if (determinant > 1e-9 * w0 * w2) return (w2 * k0 - w1 * k1) / determinant;
    return w0 > 0.0 ? k0 / w0 : 0.0;
  }
};

std::vector<std::vector<Vec2>> polylinesOf(const std::vector<Quintic>& path) {
  constexpr int kSteps = 16;  // of a piece: a chord leaves it by 1/256 of what the piece bends out
  std::vector<std::vector<Vec2>> lines;
  for (const Quintic& q : path) {
    auto& line = lines.emplace_back();
    for (int k = 0; k <= kSteps; ++k) line.push_back(evaluate(q, static_cast<double>(k) / kSteps).point);
  }
  return lines;
}

/// The path as 001 leaves it without the low pass: at every joint the mean of both curvatures (Eq 9, 10), or as it was
/// before that.
Result<ConstructedPiece> plainPath(std::span<const Station> stations, bool closed, bool equalise) {
  std::vector<Quintic> path = bezierPath(stations, closed);
  for (std::size_t i = 0; equalise && i + 1 < path.size(); ++i) equaliseJoint(path[i], path[i + 1]);
  if (equalise && closed) equaliseJoint(path.back(), path.front());
  auto curve = joinedQuintics(path, 1.0);
  if (!curve) return fail(curve.error());
  ConstructedPiece result{std::move(*curve), {}};
  result.report.why = Termination::Exact;
  return result;
}

}  // namespace

std::vector<Quintic> bezierPath(std::span<const Station> stations, bool closed) {
  std::vector<Quintic> path;
  const std::size_t m = stations.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < m; ++i) {
    const Station &a = stations[i], &b = stations[(i + 1) % m];
    if (const auto vertex = tangentVertex(a.point, a.direction, b.point, b.direction)) {
      path.push_back(elevatedQuadratic(a.point, *vertex, b.point));
    } else {
      const double handle = (b.point - a.point).norm() / 3.0;
      path.push_back(elevatedCubic(a.point, a.point + handle * a.direction, b.point - handle * b.direction, b.point));
    }
  }
  return path;
}

std::vector<double> lowPassedCurvature(std::span<const Station> stations, bool closed, double width,
                                       std::span<const double> arcLengths) {
  return lowPassedCurvature(stations, closed, std::vector<double>(stations.size(), width), arcLengths);
}

std::vector<double> lowPassedCurvature(std::span<const Station> stations, bool closed, std::span<const double> widths,
                                       std::span<const double> arcLengths) {
  TurningData data(stations, closed);
  const auto widthAt = [&](double s) {
    const auto after = std::ranges::upper_bound(data.turns, s, {}, &StationTurn::start) - data.turns.begin();
    const std::size_t i = std::clamp<std::ptrdiff_t>(after - 1, 0, std::ssize(data.turns) - 1);
    const StationTurn& turn = data.turns[i];
    const double t = turn.length > 0.0 ? std::clamp((s - turn.start) / turn.length, 0.0, 1.0) : 0.0;
    return (1.0 - t) * widths[i] + t * widths[(i + 1) % widths.size()];
  };
  // Once over the data and once over what it missed there: the bends keep their height.
  const auto at = [&](double StationTurn::*value, double s) { return data.smoothed(value, s, widthAt(s)); };
  for (StationTurn& turn : data.turns) turn.missed = turn.kappa - at(&StationTurn::kappa, turn.middle());
  std::vector<double> result;
  for (const double s : arcLengths) result.push_back(at(&StationTurn::kappa, s) + at(&StationTurn::missed, s));
  return result;
}

FairedJoints fairedJoints(const StationSet& set, bool closed, double lowPass, const RunContext& context) {
  const std::vector<Station> stations = set.plain();
  const auto lengths = arcCorrectedDistances(stations, closed);
  double total = 0.0;
  std::vector<double> places;
  for (const double length : lengths) {
    for (const double t : kPlaces) places.push_back(total + t * length);
    total += length;
  }
  if (!closed) places.push_back(total);
  // Distances that there were before stations were set closer.
  std::vector<double> shares;
  for (const SpacedStation& station : set.stations) shares.push_back(station.share);
  double distances = 0.0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    distances += 0.5 * (shares[i] + shares[(i + 1) % shares.size()]);
  }
  const double width = std::max(lowPass * total / distances, kShortestLowPassPx);
  std::vector<double> widths;
  widths.reserve(shares.size());
  for (const double share : shares) widths.push_back(share * width);
  const auto targets = lowPassedCurvature(stations, closed, widths, places);
  const Chain chain(jointsOf(bezierPath(stations, closed), stations, closed), shares, lengths, closed);
  const auto blocks = chain.blocks(targets);
  const auto unknowns = static_cast<Eigen::Index>(3 * chain.count());
  const BlockSolution solved =
      minimiseBlocks(Eigen::VectorXd::Zero(unknowns), Eigen::VectorXd::Ones(unknowns), blocks, context);
  return {chain.joints(solved.x), lengths, solved.run.why};
}

StationSet bezierStations(const ConstructPiece& piece, const ConstructParams& params, const RunContext& context) {
  StationSet set = givenStations(usableStations(piece, kFewestClosedStations, params.ends));
  const bool closed = piece.closed;
  if (set.stations.size() < (closed ? 3u : 2u)) return set;
  const auto plain = [closed](const StationSet& now) { return polylinesOf(bezierPath(now.plain(), closed)); };
  set = adaptiveStations(piece, std::move(set), params.maxDeviationPx, plain, context);
  // A wider low pass is to calm the path, and may move it.
  const double lowPass = std::min(params.lowPass, 1.0);
  if (lowPass == 0.0) return set;
  const auto faired = [&](const StationSet& now) {
    const FairedJoints joints = fairedJoints(now, closed, lowPass, context);
    std::vector<Quintic> path;
    for (std::size_t i = 0; i < joints.lengths.size(); ++i) {
      path.push_back(quinticHermite(joints.joints[i], joints.joints[i + 1], joints.lengths[i]));
    }
    return polylinesOf(path);
  };
  return adaptiveStations(piece, std::move(set), params.maxDeviationPx, faired, context);
}

namespace {

Result<ConstructedPiece> chainThrough(const StationSet& set, bool closed, const ConstructParams& params,
                                      const RunContext& context) {
  if (params.lowPass == 0.0) return plainPath(set.plain(), closed, params.equaliseJoints);
  const FairedJoints faired = fairedJoints(set, closed, params.lowPass, context);
  if (context.isCancelled()) return cancelled();
  auto curve = hermiteChain(faired.joints, faired.lengths);
  if (!curve) return fail(curve.error());
  ConstructedPiece result{std::move(*curve), {}};
  result.report.why = faired.why;
  return result;
}

}  // namespace

Result<ConstructedPiece> constructBezierChain(const ConstructPiece& piece, const ConstructParams& params,
                                              const RunContext& context) {
  if (context.isCancelled()) return cancelled();
  StationSet set = bezierStations(piece, params, context);
  if (set.stations.size() < (piece.closed ? 3u : 2u)) {
    return straightPiece(piece, "Too few stations for a curve; a straight line was used.");
  }
  auto made = chainThrough(set, piece.closed, params, context);
  if (!made && set.added > 0 && !context.isCancelled()) {
    set = givenStations(usableStations(piece, kFewestClosedStations, params.ends));
    made = chainThrough(set, piece.closed, params, context);
  }
  if (!made) return made;
  made->report.stationsAdded = set.added;
  made->report.note = maxDeviationNote(set);
  return made;
}

}  // namespace batten
