// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/svg/own_svg.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "core/curve/closest_point.h"
#include "core/exchange/svg/svg_path_data.h"
#include "core/exchange/svg/svg_writer.h"

namespace batten {
namespace {

constexpr int kPlacesPerSpan = 8;         ///< At which a path is compared, between two knots.
constexpr double kRewrittenMm = 0.001;    ///< [mm] By which programs round places when they save a drawing.
constexpr double kUnstatedMm = 0.01;      ///< [mm] Taken for the error of a file whose description is gone.
constexpr double kLargestStatedMm = 1.0;  ///< [mm] A description that states more was not written by us.

/// Places along a path; `ends` are those at which one of its segments ends.
struct PathPlaces {
  std::vector<Vec2> places;
  std::vector<std::size_t> ends;
};

PathPlaces placesOf(const ImportedLine& line) {
  PathPlaces path;
  for (const auto& [curve, name] : line.curves) {
    const std::vector<double> breaks = curve.breaks();
    if (path.places.empty()) path.places.push_back(curve.point(curve.start()));
    for (std::size_t i = 1; i < breaks.size(); ++i) {
      for (int k = 1; k <= kPlacesPerSpan; ++k)
        path.places.push_back(curve.point(breaks[i - 1] + (breaks[i] - breaks[i - 1]) * k / kPlacesPerSpan));
      path.ends.push_back(path.places.size() - 1);
    }
  }
  return path;
}

bool isNear(const Vec2& a, const Vec2& b, double tolerance) { return (a - b).norm() <= tolerance; }

/// Whether a path runs along the curves of a line, from its start to its end.
bool showsLine(const PathPlaces& path, const ImportedLine& line, double tolerance) {
  if (line.curves.empty() || path.places.empty()) return false;
  const NurbsCurve &front = line.curves.front().curve, &back = line.curves.back().curve;
  if (!isNear(path.places.front(), front.point(front.start()), tolerance) ||
      !isNear(path.places.back(), back.point(back.end()), tolerance))
    return false;
  std::size_t first = 0;
  for (std::size_t i = 0; i < line.curves.size(); ++i) {
    const NurbsCurve& curve = line.curves[i].curve;
    std::size_t last = path.places.size() - 1;
    if (i + 1 < line.curves.size()) {
      const Vec2 end = curve.point(curve.end());
      const auto found = std::find_if(path.ends.begin(), path.ends.end(), [&](std::size_t at) {
        return at > first && isNear(path.places[at], end, tolerance);
      });
      if (found == path.ends.end()) return false;
      last = *found;
    }
    const std::span<const Vec2> part(path.places.data() + first, last - first + 1);
    if (part.size() < 2 || !(deviation(curve, part, true).max <= tolerance)) return false;
    first = last;
  }
  return true;
}

}  // namespace

OwnSvgLines exactWhereUnchanged(std::vector<ImportedLine> exact, std::vector<ImportedLine> drawn, double toleranceMm) {
  OwnSvgLines result;
  std::vector<bool> used(exact.size(), false);
  std::size_t next = 0;  // files keep their order mostly
  for (ImportedLine& path : drawn) {
    const PathPlaces places = placesOf(path);
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < exact.size() && !found; ++k) {
      const std::size_t i = (next + k) % exact.size();
      if (!used[i] && exact[i].closed == path.closed && showsLine(places, exact[i], toleranceMm)) found = i;
    }
    if (!found) {
      ++result.drawn;
      result.lines.push_back(std::move(path));
      continue;
    }
    used[*found] = true;
    next = *found + 1;
    result.lines.push_back(std::move(exact[*found]));
  }
  result.gone = static_cast<int>(std::count(used.begin(), used.end(), false));
  return result;
}

double statedPathTolerance(std::string_view svg) {
  const auto at = svg.find(kPathsLieWithin);
  std::optional<double> stated;
  if (at != std::string_view::npos) {
    std::string_view rest = svg.substr(at + std::string_view(kPathsLieWithin).size());
    stated = takeSvgNumber(rest);
  }
  if (!stated || !(*stated >= 0.0 && *stated <= kLargestStatedMm)) stated = kUnstatedMm;
  return *stated + kRewrittenMm;
}

}  // namespace batten
