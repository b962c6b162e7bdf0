// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/import_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/base/angle.h"
#include "core/base/statistics.h"
#include "core/curve/import_limits.h"
#include "core/curve/knot_operations.h"

namespace batten {
namespace {

constexpr double kSharpTurn = 35.0 * kRadPerDeg;  // a corner of points turns by as much
/// Polylines of no more points are drawn corner by corner; of longer ones a corner has to stand out from its
/// neighbours.
constexpr std::ptrdiff_t kFewPoints = 16;
/// Of the size of a line: a point that lies farther from the middle of its neighbours was not put there by the tremor
/// of a measurement. If it also turns by more than a round shape of chords does, it is a corner.
constexpr double kMostTremor = 1.0 / 200.0, kCertainTurn = 60.0 * kRadPerDeg;
/// A tremor turns a measured line at every point. A turn counts where it is that many times as large as most turns of
/// chords of its length.
constexpr double kStandsOut = 8.0;
constexpr std::ptrdiff_t kLongestChord = 64;  // points

/// DXF puts what has no layer on layer 0.
std::string layerOf(const CadEntity& entity) { return entity.layer == "0" ? std::string() : entity.layer; }

/// Makes lines of the entities of a drawing, one after the other.
class LineBuilder {
 public:
  explicit LineBuilder(double mmPerUnit) : linear_(mmPerUnit * Eigen::Matrix2d::Identity()) {}

  void add(const CadEntity& entity) {
    if (const auto* polyline = std::get_if<CadPolyline>(&entity.shape); polyline != nullptr && isOfChords(*polyline)) {
      endLine();
      addPoints(*polyline, entity);
      return;
    }
    if (const auto* polyline = std::get_if<CadPolyline>(&entity.shape); polyline != nullptr && hasArcs(*polyline)) {
      addEdges(*polyline, entity);
      return;
    }
    const auto curve = curveOf(entity.shape);
    const auto held = curve ? clamped(*curve) : Result<NurbsCurve>(tl::unexpected(curve.error()));
    if (!held) {
      ++left_;
      return;
    }
    const NurbsCurve shape = held->mapped(linear_, Vec2::Zero());
    const bool mayTurn = std::holds_alternative<CadArc>(entity.shape);  // an arc has no direction of its own
    if (!continues({shape, entity.name}, mayTurn, layerOf(entity))) {
      endLine();
      line_.name = entity.name;
      line_.layer = layerOf(entity);
      line_.curves = {{shape, entity.name}};
      firstMayTurn_ = mayTurn;
    }
    if (meet(line_.curves.back().curve, line_.curves.front().curve)) {
      line_.closed = true;
      endLine();
    }
  }
  std::vector<ImportedLine> take() {
    endLine();
    return std::move(lines_);
  }
  int left() const { return left_; }

 private:
  static bool isOfChords(const CadPolyline& line) {
    return line.vertices.size() > 2 &&
           std::all_of(line.vertices.begin(), line.vertices.end(), [](const CadVertex& v) { return v.bulge == 0.0; });
  }
  void addPoints(const CadPolyline& polyline, const CadEntity& entity) {
    ImportedLine line;
    line.name = entity.name;
    line.layer = layerOf(entity);
    line.closed = polyline.closed;
    for (const CadVertex& v : polyline.vertices) {
      const Vec2 at = linear_ * v.point;
      if (line.points.empty() || line.points.back() != at) line.points.push_back(at);
    }
    if (line.points.size() > 3 && line.points.front() == line.points.back()) {
      line.points.pop_back();
      line.closed = true;
    }
    if (line.points.size() < 3) line.closed = false;
    if (line.points.size() < 2) {
      ++left_;
      return;
    }
    findCorners(line);
    lines_.push_back(std::move(line));
  }

  static bool hasArcs(const CadPolyline& line) {
    return line.vertices.size() > 1 &&
           std::any_of(line.vertices.begin(), line.vertices.end(), [](const CadVertex& v) { return v.bulge != 0.0; });
  }
  /// A polyline with arcs: a line of its own, with a corner at each vertex, where a line or an arc ends.
  void addEdges(const CadPolyline& polyline, const CadEntity& entity) {
    endLine();
    const auto edges = edgesOf(polyline);
    if (!edges || edges->empty()) {
      ++left_;
      return;
    }
    line_.name = entity.name;
    line_.layer = layerOf(entity);
    for (const NurbsCurve& edge : *edges) line_.curves.push_back({edge.mapped(linear_, Vec2::Zero())});
    line_.closed = polyline.closed || meet(line_.curves.back().curve, line_.curves.front().curve);
    endLine();
  }

  static double sizeOf(const NurbsCurve& curve) {
    double size = 0.0;
    for (const Vec2& p : curve.controlPoints()) size = std::max(size, (p - curve.controlPoints().front()).norm());
    return size;
  }
  static bool isSamePlace(const Vec2& a, const Vec2& b, const NurbsCurve& one, const NurbsCurve& other) {
    constexpr double kSame = 1e-7;  // of the size of the larger one
    return (a - b).norm() <= kSame * std::max(sizeOf(one), sizeOf(other));
  }
  static bool meet(const NurbsCurve& before, const NurbsCurve& behind) {
    return isSamePlace(before.controlPoints().back(), behind.controlPoints().front(), before, behind);
  }

  /// Adds the curve to the line if it begins where that one ends.
  bool continues(const ImportedCurve& next, bool mayTurn, const std::string& layer) {
    if (line_.curves.empty() || layer != line_.layer) return false;
    const NurbsCurve &last = line_.curves.back().curve, &curve = next.curve;
    const bool isFirst = line_.curves.size() == 1 && firstMayTurn_;
    const std::array<NurbsCurve, 2> lasts{last, isFirst ? reversed(last) : NurbsCurve()};
    const std::array<NurbsCurve, 2> nexts{curve, mayTurn ? reversed(curve) : NurbsCurve()};
    for (const NurbsCurve& before : lasts) {
      for (const NurbsCurve& behind : nexts) {
        if (before.isEmpty() || behind.isEmpty() || !meet(before, behind)) continue;
        line_.curves.back().curve = before;
        line_.curves.push_back({behind, next.name});
        return true;
      }
    }
    return false;
  }
  void endLine() {
    if (!line_.curves.empty()) lines_.push_back(std::move(line_));
    line_ = {};
  }

  Eigen::Matrix2d linear_;
  std::vector<ImportedLine> lines_;
  ImportedLine line_;
  bool firstMayTurn_ = false;
  int left_ = 0;
};

double sizeOf(const std::vector<Vec2>& points) {
  Vec2 low = points.front(), high = low;
  for (const Vec2& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).norm();
}

/// How a polyline turns at its points.
class PointTurns {
 public:
  PointTurns(const std::vector<Vec2>& points, bool closed)
      : points_(points), count_(std::ssize(points)), closed_(closed) {}

  /// [rad] Between the chords to the points so many before and behind; 0 where an open line has none.
  std::vector<double> over(std::ptrdiff_t chord) const {
    std::vector<double> turns(points_.size(), 0.0);
    const std::ptrdiff_t first = closed_ ? 0 : chord, last = closed_ ? count_ : count_ - chord;
    for (std::ptrdiff_t i = first; i < last; ++i) {
      const Vec2 in = at(i) - at(i - chord), out = at(i + chord) - at(i);
      turns[i] = std::abs(std::atan2(cross(in, out), in.dot(out)));
    }
    return turns;
  }

  /// The shortest chord over which most turns are so small that a sharp one stands out; where none is, as on a coarse
  /// polygon, the one over which they are smallest.
  std::ptrdiff_t calmChord() const {
    std::ptrdiff_t calmest = 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::ptrdiff_t chord = 1; chord <= std::min(kLongestChord, count_ / 8); chord *= 2) {
      std::vector<double> turns = over(chord);
      const double usual = upperMedian(turns);
      if (usual < least) least = usual, calmest = chord;
      if (usual <= kSharpTurn / kStandsOut) break;
    }
    return calmest;
  }

  /// How far a point lies from the middle of its neighbours.
  double offMiddle(std::ptrdiff_t i) const { return (at(i) - 0.5 * (at(i - 1) + at(i + 1))).norm(); }

  /// Whether the turn over chords is sharp, and far sharper than those one chord on.
  bool standsOut(std::ptrdiff_t i, std::ptrdiff_t chord, const std::vector<double>& turns) const {
    const auto turn = [&](std::ptrdiff_t k) { return turns[((k % count_) + count_) % count_]; };
    if (turn(i) < kSharpTurn || turn(i) < 2.0 * std::max(turn(i - chord), turn(i + chord))) return false;
    for (std::ptrdiff_t k = 1; k < chord; ++k)
      if (turn(i - k) >= turn(i) || turn(i + k) > turn(i)) return false;
    return true;
  }

 private:
  const Vec2& at(std::ptrdiff_t i) const { return points_[((i % count_) + count_) % count_]; }

  const std::vector<Vec2>& points_;
  std::ptrdiff_t count_;
  bool closed_;
};

}  // namespace

std::vector<int> sharpPoints(const std::vector<Vec2>& points, bool closed) {
  const PointTurns line(points, closed);
  const std::ptrdiff_t n = std::ssize(points), chord = n <= kFewPoints ? 1 : line.calmChord();
  const std::vector<double> turns = line.over(1), calm = chord == 1 ? turns : line.over(chord);
  const double farOff = kMostTremor * sizeOf(points);
  std::vector<int> corners;
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const bool isMeant =
        n <= kFewPoints ? turns[i] >= kSharpTurn : turns[i] > kCertainTurn && line.offMiddle(i) > farOff;
    if (isMeant || line.standsOut(i, chord, calm)) corners.push_back(static_cast<int>(i));
  }
  return corners;
}

std::size_t sharpTurnsOf(const ImportedLine& line) {
  std::size_t turns = line.corners.size();
  const auto sideOf = [](const NurbsCurve& curve) -> std::optional<Vec2> {
    if (curve.controlPointCount() != 2) return std::nullopt;
    return curve.controlPoints()[1] - curve.controlPoints()[0];
  };
  std::optional<Vec2> before;
  for (const ImportedCurve& each : line.curves) {
    const std::optional<Vec2> side = sideOf(each.curve);
    if (before && side && std::abs(std::atan2(cross(*before, *side), before->dot(*side))) >= kSharpTurn) ++turns;
    before = side;
  }
  return turns;
}

void findCorners(ImportedLine& line) {
  line.corners = sharpPoints(line.points, line.closed);
  const std::size_t n = line.points.size(), sides = line.closed ? n : n - 1;
  if (std::ssize(line.points) <= kFewPoints || 2 * line.corners.size() <= n || line.corners.size() > kMostSharpTurns)
    return;
  std::vector<ImportedCurve> curves;
  for (std::size_t i = 0; i < sides; ++i) {
    const Vec2 &from = line.points[i], &to = line.points[(i + 1) % n];
    const double length = (to - from).norm();
    auto side = NurbsCurve::make(1, {0.0, 0.0, length, length}, {from, to});
    if (!side) return;
    curves.push_back({std::move(*side)});
  }
  line.curves = std::move(curves);
  line.points.clear();
  line.corners.clear();
}

DrawingLines linesOf(const CadDrawing& drawing, double mmPerUnit) {
  LineBuilder builder(mmPerUnit);
  for (const CadEntity& entity : drawing.entities) builder.add(entity);
  std::vector<ImportedLine> lines = builder.take();
  return {std::move(lines), builder.left()};
}

std::vector<ImportedLine> linesOf(const ExportDocument& document) {
  std::vector<ImportedLine> lines;
  for (const ExportCurve& curve : document.curves) {
    ImportedLine line;
    line.name = curve.name;
    line.layer = curve.layer;
    line.closed = curve.closed;
    for (const ExportPiece& piece : curve.pieces) {
      const auto held = clamped(piece.curve);
      if (!held) continue;
      const bool isApart =
          !line.curves.empty() &&
          !(line.curves.back().curve.controlPoints().back() - held->controlPoints().front()).isZero(1e-9);
      if (isApart) {
        line.closed = false;
        lines.push_back(line);
        line.curves.clear();
      }
      line.curves.push_back({*held, piece.name});
    }
    if (!line.curves.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace batten
