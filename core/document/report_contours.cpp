// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/report_contours.h"

#include <algorithm>
#include <vector>

#include "core/base/statistics.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

/// Where a line was not measured as elsewhere: points first..last of it.
ReportJson stretchToJson(const Contour& c, int first, int last) {
  const std::vector<Vec2> at = positionsOf({c.points.begin() + first, c.points.begin() + last + 1});
  return {{"from_px", pointToJson(at.front())},
          {"to_px", pointToJson(at.back())},
          {"points", last - first + 1},
          {"length_px", numberToJson(polylineLength(at, false))}};
}

ReportJson notPlacedToJson(const Contour& c) {
  ReportJson list = ReportJson::array();
  const int n = static_cast<int>(c.points.size());
  for (int i = 0; i < n; ++i) {
    if (c.points[i].refined) continue;
    int last = i;
    while (last + 1 < n && !c.points[last + 1].refined) ++last;
    list.push_back(stretchToJson(c, i, last));
    i = last;
  }
  return list;
}

constexpr std::ptrdiff_t kMostSteps = 64;  // along a line: enough to draw its widths

/// Median and largest of some lengths along a line, and some of them at equal steps from its start to its end.
ReportJson rangeToJson(std::vector<float> px, const PageFrame& frame) {
  if (px.empty()) return nullptr;
  ReportJson along = ReportJson::array();
  const std::ptrdiff_t last = std::ssize(px) - 1, steps = std::min(kMostSteps, last);
  for (std::ptrdiff_t i = 0; i <= steps; ++i) {
    along.push_back(numberToJson(static_cast<double>(px[steps == 0 ? 0 : i * last / steps])));
  }
  const auto most = static_cast<double>(*std::max_element(px.begin(), px.end()));
  const auto middle = static_cast<double>(upperMedian(px));
  return {{"median_px", numberToJson(middle)},
          {"largest_px", numberToJson(most)},
          {"median_mm", numberToJson(frame.lengthToModel(middle))},
          {"largest_mm", numberToJson(frame.lengthToModel(most))},
          {"along_px", std::move(along)}};
}

std::vector<float> halfSpread(const Contour& c) {
  std::vector<float> half;
  for (const ContourPoint& p : c.points)
    if (p.bundle) half.push_back(0.5f * (p.bundle->left + p.bundle->right));
  return half;
}

}  // namespace

ReportJson contourToJson(const Contour& c, std::ptrdiff_t index, const PageFrame& frame) {
  const double mm2 = frame.mmPerPx * frame.mmPerPx;
  ReportJson json{{"contour", index + 1},
                  {"kind", kindName(c.kind)},
                  {"closed", c.closed},
                  {"hole", c.hole},
                  {"kind_chosen_by_user", c.traceMode.has_value()},
                  {"length_px", numberToJson(c.lengthPx)},
                  {"length_mm", numberToJson(frame.lengthToModel(c.lengthPx))},
                  {"area_px2", c.closed ? numberToJson(c.areaPx) : ReportJson(nullptr)},
                  {"area_mm2", c.closed ? numberToJson(c.areaPx * mm2) : ReportJson(nullptr)},
                  {"stroke_width", rangeToJson(strokeWidthsOf(c.points), frame)},
                  {"merged_half_spread", rangeToJson(halfSpread(c), frame)},
                  {"bridges", ReportJson::array()},
                  {"not_placed", isDrawn(c.kind) ? ReportJson::array() : notPlacedToJson(c)}};
  const int n = static_cast<int>(c.points.size());
  for (const auto& [first, last] : c.bridges) {
    if (first >= 0 && first <= last && last < n) json["bridges"].push_back(stretchToJson(c, first, last));
  }
  return json;
}

}  // namespace batten
