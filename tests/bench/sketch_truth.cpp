// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/sketch_truth.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "tests/support/svg_paths.h"

namespace batten::test {
namespace {

constexpr double kReachPx = 20.0, kCoveredPx = 8.0, kCellPx = 8.0;

int cellOf(double v) { return static_cast<int>(std::floor(v / kCellPx)); }

}  // namespace

std::optional<SketchTruth> SketchTruth::beside(const std::filesystem::path& drawing, int widthPx, int heightPx) {
  std::filesystem::path file = drawing;
  std::ifstream in(file.replace_extension(".svg"));
  if (!in) return std::nullopt;
  SketchTruth truth;
  std::map<std::string, int> numbers;
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::vector<SvgPath> paths = readSvgPaths(text);
  const double width = svgWidthPx(text);
  for (SvgPath& path : paths)
    for (SvgCubic& cubic : path.segments)
      for (Vec2& p : cubic.p) p *= width > 0.0 ? widthPx / width : 1.0;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    const std::string name = paths[p].group.starts_with("curve") ? paths[p].group : "path" + std::to_string(p);
    const auto [it, fresh] = numbers.try_emplace(name, static_cast<int>(numbers.size()));
    Stroke stroke;
    stroke.group = it->second;
    for (const SvgCubic& c : paths[p].segments) {
      const int steps = std::max(
          1, static_cast<int>(std::ceil((c.p[3] - c.p[0]).norm() / 2.0 + 3.0 * (c.p[1] - c.p[0]).norm() / 4.0)));
      for (int k = 0; k < steps; ++k) stroke.points.push_back(c.at(static_cast<double>(k) / steps));
    }
    if (paths[p].segments.empty()) continue;
    stroke.points.push_back(paths[p].segments.back().p[3]);
    const bool onPage = std::any_of(stroke.points.begin(), stroke.points.end(), [&](const Vec2& q) {
      return q.x() > 0.0 && q.y() > 0.0 && q.x() < widthPx && q.y() < heightPx;
    });
    if (onPage) truth.strokes_.push_back(std::move(stroke));
  }
  truth.groups_ = static_cast<int>(numbers.size());
  if (truth.strokes_.empty()) return std::nullopt;
  truth.fillGrid();
  return truth;
}

void SketchTruth::fillGrid() {
  for (std::size_t s = 0; s < strokes_.size(); ++s) {
    const auto& p = strokes_[s].points;
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
      cells_[{cellOf(0.5 * (p[i].x() + p[i + 1].x())), cellOf(0.5 * (p[i].y() + p[i + 1].y()))}].push_back(
          {static_cast<int>(s), i});
  }
}

// Mean place, along the normal, of the strokes of the group that lies nearest.
std::optional<double> SketchTruth::offsetAt(const CurvePoint& point) const {
  const Vec2 normal(-point.tangent.y(), point.tangent.x());
  std::map<int, double> nearest;  // by stroke
  std::set<std::pair<int, int>> seen;
  for (double u = -kReachPx; u <= kReachPx; u += 0.5 * kCellPx) {
    const Vec2 at = point.at + u * normal;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const std::pair<int, int> cell{cellOf(at.x()) + dx, cellOf(at.y()) + dy};
        if (!seen.insert(cell).second) continue;
        const auto found = cells_.find(cell);
        if (found == cells_.end()) continue;
        for (const Facet& f : found->second) {
          const Vec2 a = strokes_[static_cast<std::size_t>(f.stroke)].points[f.first] - point.at;
          const Vec2 b = strokes_[static_cast<std::size_t>(f.stroke)].points[f.first + 1] - point.at;
          const double sa = a.dot(point.tangent), sb = b.dot(point.tangent);
          if ((sa > 0.0) == (sb > 0.0)) continue;
          // Strokes that cross the curve are other lines.
          if (std::abs(sb - sa) < 0.6 * (b - a).norm()) continue;
          const double t = sa / (sa - sb), offset = (a + t * (b - a)).dot(normal);
          if (std::abs(offset) > kReachPx) continue;
          const auto [it, fresh] = nearest.try_emplace(f.stroke, offset);
          if (!fresh && std::abs(offset) < std::abs(it->second)) it->second = offset;
        }
      }
  }
  std::map<int, std::pair<double, int>> mean;  // by group
  for (const auto& [stroke, offset] : nearest) {
    auto& m = mean[strokes_[static_cast<std::size_t>(stroke)].group];
    m.first += offset;
    ++m.second;
  }
  std::optional<double> best;
  for (const auto& [group, m] : mean) {
    const double offset = m.first / m.second;
    if (!best || std::abs(offset) < std::abs(*best)) best = offset;
  }
  return best;
}

SketchTruth::Figures SketchTruth::compare(const std::vector<CurvePoint>& curves) const {
  Figures figures;
  figures.groups = groups_;
  if (curves.empty()) return figures;
  std::vector<double> offsets;
  std::map<std::pair<int, int>, std::vector<Vec2>> grid;
  for (const CurvePoint& point : curves) {
    grid[{cellOf(point.at.x()), cellOf(point.at.y())}].push_back(point.at);
    if (const auto offset = offsetAt(point)) offsets.push_back(std::abs(*offset));
  }
  figures.unmatched = 1.0 - static_cast<double>(offsets.size()) / static_cast<double>(curves.size());
  double square = 0.0;
  for (const double o : offsets) square += o * o;
  if (!offsets.empty()) {
    figures.rmsPx = std::sqrt(square / static_cast<double>(offsets.size()));
    const auto middle = offsets.begin() + static_cast<std::ptrdiff_t>(offsets.size() / 2);
    std::nth_element(offsets.begin(), middle, offsets.end());
    figures.medianPx = *middle;
  }
  double covered = 0.0, all = 0.0;
  for (const Stroke& stroke : strokes_)
    for (std::size_t i = 0; i + 1 < stroke.points.size(); ++i) {
      const double length = (stroke.points[i + 1] - stroke.points[i]).norm();
      const Vec2& at = stroke.points[i];
      bool near = false;
      for (int dy = -1; dy <= 1 && !near; ++dy)
        for (int dx = -1; dx <= 1 && !near; ++dx) {
          const auto found = grid.find({cellOf(at.x()) + dx, cellOf(at.y()) + dy});
          if (found == grid.end()) continue;
          near = std::any_of(found->second.begin(), found->second.end(),
                             [&](const Vec2& q) { return (q - at).norm() <= kCoveredPx; });
        }
      all += length;
      covered += near ? length : 0.0;
    }
  figures.covered = all > 0.0 ? covered / all : 0.0;
  return figures;
}

}  // namespace batten::test
