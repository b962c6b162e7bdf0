// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/line_company.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace batten {
namespace {

constexpr double kCompanyWidths = 8.0;  // [widths] from line to line: hatching and dashes lie closer
constexpr double kStretchWidths = 2.0;  // [widths] over which a line has one direction
constexpr double kRunWidths = 4.0;      // [widths] over which grain keeps its direction: one trial of chance
// The mean cosine of twice the angle to n lines of any direction is 0 +- sqrt(1 / 2n): beyond two of these only one
// line of forty lies by chance.
constexpr double kBeyondChance = 2.0;
// The cosine of 60 degrees: 30 apart, on the whole. The tooth of a paper has a direction, too, but a weaker one.
constexpr double kLeastAlike = 0.5;

}  // namespace

LineCompany::LineCompany(const ContourSet& set, const std::vector<bool>& isOut, double widthPx)
    : widthPx_(widthPx), ofLine_(set.contours.size()) {
  const auto step = static_cast<std::ptrdiff_t>(std::max(2.0, kStretchWidths * widthPx));  // points, one a pixel
  for (int k = 0; k < std::ssize(set.contours); ++k) {
    if (isOut[k]) continue;
    const std::vector<ContourPoint>& points = set.contours[k].points;
    const std::ptrdiff_t n = std::ssize(points);
    for (std::ptrdiff_t i = 0; i + 1 < n; i += step) {
      const Vec2 &from = points[i].at, &to = points[std::min(n - 1, i + step)].at;
      if (!((to - from).norm() > 0.0)) continue;
      const Stretch stretch{0.5 * (from + to), to - from, k};
      cells_[cellOf(stretch.at)].push_back(stretch);
      ofLine_[k].push_back(stretch);
    }
  }
}

std::pair<int, int> LineCompany::cellOf(const Vec2& at) const {
  const double cellPx = kCompanyWidths * widthPx_;
  return {static_cast<int>(std::floor(at.x() / cellPx)), static_cast<int>(std::floor(at.y() / cellPx))};
}

LineCompany::Likeness LineCompany::likenessOf(const Stretch& own) const {
  Likeness sum;
  const double length = own.along.norm();
  const auto [column, row] = cellOf(own.at);
  for (int j = row - 1; j <= row + 1; ++j) {
    for (int i = column - 1; i <= column + 1; ++i) {
      const auto cell = cells_.find({i, j});
      if (cell == cells_.end()) continue;
      for (const Stretch& other : cell->second) {
        if (other.line == own.line || (other.at - own.at).norm() > kCompanyWidths * widthPx_) continue;
        const double weight = length * other.along.norm(), cosine = own.along.dot(other.along) / weight;
        sum.alike += weight * (2.0 * cosine * cosine - 1.0);
        sum.all += weight;
      }
    }
  }
  return sum;
}

bool LineCompany::isOneOf(int line) const {
  double alike = 0.0, all = 0.0, length = 0.0;
  for (const Stretch& stretch : ofLine_[line]) {
    const Likeness sum = likenessOf(stretch);
    alike += sum.alike;
    all += sum.all;
    length += stretch.along.norm();
  }
  if (!(all > 0.0)) return false;
  const double likeness = alike / all, trials = all / (length * kRunWidths * widthPx_);
  return likeness >= kLeastAlike && likeness * std::sqrt(2.0 * trials) >= kBeyondChance;
}

}  // namespace batten
