// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/sketch_truth.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <set>

#include "core/base/statistics.h"
#include "core/curve/curvature.h"
#include "tests/support/svg_paths.h"

namespace batten::test {
namespace {

constexpr double kReachPx = 20.0, kCoveredPx = 8.0, kCellPx = 8.0;
constexpr double kBundlePx = 30.0;  // strokes of one line lie no farther from its middle
constexpr double kOnPx = 3.0, kMostly = 0.9;

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
  truth.names_.resize(numbers.size());
  for (const auto& [name, number] : numbers) truth.names_[number] = name;
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

std::map<int, SketchTruth::Crossed> SketchTruth::crossedAt(const CurvePoint& point, double reachPx) const {
  const Vec2 normal(-point.tangent.y(), point.tangent.x());
  std::map<int, Crossed> nearest;
  std::set<std::pair<int, int>> seen;
  for (double u = -reachPx; u <= reachPx; u += 0.5 * kCellPx) {
    const Vec2 at = point.at + u * normal;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const std::pair<int, int> cell{cellOf(at.x()) + dx, cellOf(at.y()) + dy};
        if (!seen.insert(cell).second) continue;
        const auto found = cells_.find(cell);
        if (found == cells_.end()) continue;
        for (const Facet& f : found->second) {
          const Vec2 a = strokes_[f.stroke].points[f.first] - point.at;
          const Vec2 b = strokes_[f.stroke].points[f.first + 1] - point.at;
          const double sa = a.dot(point.tangent), sb = b.dot(point.tangent);
          if ((sa > 0.0) == (sb > 0.0)) continue;
          // Strokes that cross the curve are other lines.
          if (std::abs(sb - sa) < 0.6 * (b - a).norm()) continue;
          const double t = sa / (sa - sb), offset = (a + t * (b - a)).dot(normal);
          if (std::abs(offset) > reachPx) continue;
          const auto [it, fresh] = nearest.try_emplace(f.stroke, Crossed{offset, f.first});
          if (!fresh && std::abs(offset) < std::abs(it->second.offset)) it->second = {offset, f.first};
        }
      }
  }
  return nearest;
}

// Mean place, along the normal, of the strokes of the group that lies nearest.
std::optional<double> SketchTruth::offsetAt(const CurvePoint& point) const {
  std::map<int, std::pair<double, int>> mean;  // by group
  for (const auto& [stroke, crossed] : crossedAt(point, kReachPx)) {
    auto& m = mean[strokes_[stroke].group];
    m.first += crossed.offset;
    ++m.second;
  }
  std::optional<double> best;
  for (const auto& [group, m] : mean) {
    const double offset = m.first / m.second;
    if (!best || std::abs(offset) < std::abs(*best)) best = offset;
  }
  return best;
}

std::vector<SketchTruth::Share> SketchTruth::sharesOf(const std::vector<CurvePoint>& line,
                                                      const std::vector<double>& length) const {
  const std::size_t groups = length.size();
  const auto groupOf = [&](int stroke) { return strokes_[stroke].group; };
  std::vector<Share> share(groups);
  std::set<std::pair<int, std::size_t>> covered;
  for (const CurvePoint& point : line) {
    std::vector<std::pair<double, double>> extent(groups, {1e9, -1e9});
    const auto crossed = crossedAt(point, kBundlePx);
    for (const auto& [stroke, c] : crossed) {
      auto& [low, high] = extent[groupOf(stroke)];
      low = std::min(low, c.offset);
      high = std::max(high, c.offset);
    }
    const auto isOn = [&](std::size_t g) { return extent[g].first <= kOnPx && extent[g].second >= -kOnPx; };
    for (std::size_t g = 0; g < groups; ++g) share[g].on += isOn(g) ? 1.0 / static_cast<double>(line.size()) : 0.0;
    for (const auto& [stroke, c] : crossed)
      if (isOn(groupOf(stroke))) covered.insert({stroke, c.first});
  }
  // Facets are up to a few px long, and the normals fan out on the outer side of a bend: their neighbours count.
  for (std::size_t s = 0; s < strokes_.size(); ++s) {
    const auto& p = strokes_[s].points;
    const auto has = [&](std::size_t i) { return covered.contains({static_cast<int>(s), i}); };
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
      if (has(i) || (i > 0 && has(i - 1)) || has(i + 1))
        share[groupOf(static_cast<int>(s))].covers += (p[i + 1] - p[i]).norm();
  }
  for (std::size_t g = 0; g < groups; ++g) share[g].covers /= std::max(1e-9, length[g]);
  return share;
}

SketchTruth::Grouping SketchTruth::group(const std::vector<std::vector<CurvePoint>>& lines) const {
  const std::size_t groups = groups_;
  std::vector<double> length(groups, 0.0);
  for (const Stroke& s : strokes_)
    for (std::size_t i = 0; i + 1 < s.points.size(); ++i) length[s.group] += (s.points[i + 1] - s.points[i]).norm();
  Grouping result;
  std::vector<std::vector<Share>> shares;  // by line and group
  for (const auto& line : lines) {
    std::vector<Share> share = sharesOf(line, length);
    int ons = 0, parts = 0;
    for (const Share& s : share) {
      ons += s.on >= kMostly ? 1 : 0;
      parts += s.on >= 1.0 - kMostly && s.covers >= 1.0 - kMostly ? 1 : 0;
    }
    result.onOne += ons > 0 ? 1 : 0;
    result.divided += parts > 1 ? 1 : 0;
    shares.push_back(std::move(share));
  }
  for (std::size_t g = 0; g < groups; ++g) {
    int covering = 0, matching = 0, lying = 0;
    std::string words = names_[g] + ":";
    for (std::size_t l = 0; l < shares.size(); ++l) {
      const Share& s = shares[l][g];
      covering += s.covers >= kMostly ? 1 : 0;
      lying += s.on >= kMostly ? 1 : 0;
      matching += s.covers >= kMostly && s.on >= kMostly ? 1 : 0;
      char text[64];
      std::snprintf(text, sizeof text, " line %zu covers %.0f %% (%.0f %% of it on)", l + 1, 100 * s.covers,
                    100 * s.on);
      if (s.covers >= 0.05) words += text;
    }
    result.covered += covering > 0 ? 1 : 0;
    const bool matched = matching == 1 && lying == 1;
    result.matched += matched ? 1 : 0;
    if (!matched) result.unmatched.push_back(words);
  }
  return result;
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
    figures.medianPx = upperMedian(offsets);
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
