// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/end_hooks.h"

#include <algorithm>
#include <limits>

#include "core/construct/light/light_check.h"
#include "core/curve/curvature.h"

namespace batten {
namespace {

constexpr double kEndShare = 0.1;  // of the length: what counts as an end, two widths of a stroke of twenty
// [1/diagonal] A smaller change of the curvature turns the end by less than a degree (a tenth of 0.2 rad), and no comb
// shows it.
constexpr double kSeenChange = 0.2;
constexpr double kSharper = 2.0;    // times the change of the dense curve: no longer its own
constexpr double kMeasured = 0.99;  // what lies between two places is not seen

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double width() const { return std::max(0.0, high - low); }
};

struct EndRanges {
  Range start, end;
};

EndRanges rangesOf(const LightReference& dense) {
  EndRanges ranges;
  for (const LightSample& sample : dense.samples()) {
    if (sample.s <= kEndShare * dense.length()) ranges.start.add(sample.kappa);
    if (sample.s >= (1.0 - kEndShare) * dense.length()) ranges.end.add(sample.kappa);
  }
  return ranges;
}

/// From an end inwards; the arc length of a place is that of its foot on the dense curve.
Range rangeOf(const NurbsCurve& light, const LightReference& dense, bool atEnd) {
  Range range;
  const std::vector<double> breaks = light.breaks();
  const int spans = static_cast<int>(breaks.size()) - 1;
  const int places = checkedPlacesPerSpan(spans);
  int foot = atEnd ? dense.size() - 1 : 0;
  for (int i = 0; i < spans; ++i) {
    const double outer = breaks[atEnd ? spans - i : i], inner = breaks[atEnd ? spans - 1 - i : i + 1];
    for (int k = 0; k <= places; ++k) {
      const double u = outer + (inner - outer) * k / places;
      foot = dense.foot(light.point(u), foot).index;
      const double s = dense.at(foot).s;
      if ((atEnd ? dense.length() - s : s) > kEndShare * dense.length()) return range;
      if (const auto kappa = curvature(light, u)) range.add(*kappa);
    }
  }
  return range;
}

bool isHook(const Range& light, const Range& dense, double diagonal) {
  return light.width() > kMeasured * (kSharper * dense.width() + kSeenChange / diagonal);
}

}  // namespace

CurvatureRange calmRange(const LightReference& dense, bool atEnd, double share) {
  const EndRanges ranges = rangesOf(dense);
  const Range& range = atEnd ? ranges.end : ranges.start;
  const double more = share * ((kSharper - 1.0) * range.width() + kSeenChange / dense.diagonal());
  return {range.low - more, range.high + more};
}

EndHooks endHooks(const NurbsCurve& light, const LightReference& dense) {
  const EndRanges before = rangesOf(dense);
  return {isHook(rangeOf(light, dense, false), before.start, dense.diagonal()),
          isHook(rangeOf(light, dense, true), before.end, dense.diagonal())};
}

}  // namespace batten
