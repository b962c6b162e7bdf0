// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/import_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "core/base/angle.h"
#include "core/curve/knot_operations.h"

namespace batten {
namespace {

constexpr double kSharpTurn = 35.0 * kRadPerDeg;
/// Polylines of no more points are drawn corner by corner; of longer ones a corner has to stand out from its
/// neighbours.
constexpr std::ptrdiff_t kFewPoints = 16;

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
    line.corners = sharpPoints(line.points, line.closed);
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

}  // namespace

std::vector<int> sharpPoints(const std::vector<Vec2>& points, bool closed) {
  const std::ptrdiff_t n = std::ssize(points);
  std::vector<double> turns(points.size(), 0.0);
  for (std::ptrdiff_t i = closed ? 0 : 1; i < (closed ? n : n - 1); ++i) {
    const Vec2 in = points[i] - points[(i + n - 1) % n];
    const Vec2 out = points[(i + 1) % n] - points[i];
    turns[i] = std::abs(std::atan2(cross(in, out), in.dot(out)));
  }
  std::vector<int> corners;
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double turn = turns[i];
    const double beside = std::max(turns[(i + n - 1) % n], turns[(i + 1) % n]);
    if (turn >= kSharpTurn && (n <= kFewPoints || turn >= 2.0 * beside)) corners.push_back(static_cast<int>(i));
  }
  return corners;
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
