// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/overdrawn_strokes.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "core/contour/merge/parallel_strokes.h"

namespace batten {
namespace {

constexpr double kLeastOverdrawn = 0.08;  // of the lines: less is a line or two that happen to touch
constexpr double kSlim = 12.0;            // widths long: from here on no shape
constexpr double kThinShare = 0.25;       // of the ink: at least as much is single strokes
constexpr double kLadder = 1.02;          // from one distance looked at to the next
constexpr double kNearlyBest = 0.93;      // of the best balance: as good
// Strokes near the distance count less in a mean (stroke_mean.cpp); up to here they count in full.
constexpr double kFullWeight = 0.7;

enum class Verdict { OneLine, TwoLines, Unknown };

struct Judged {
  Verdict verdict = Verdict::Unknown;
  bool meets = false;
};

Judged judge(const ParallelStretch& s) {
  const auto has = [&](SideEnd e) { return s.begin == e || s.end == e; };
  if (has(SideEnd::Parts) || has(SideEnd::Never)) return {Verdict::TwoLines, false};
  // A leaf, a wedge: shapes of their own, unless they are too slim to be drawn as such.
  const bool isShape = (has(SideEnd::Tip) || has(SideEnd::Cut)) && s.lengthPx() < kSlim * s.widestPx;
  if (has(SideEnd::Meets) && !isShape) return {Verdict::OneLine, true};
  // One stroke takes over from the other. One that lies beside a longer one may be a line of its own.
  if (has(SideEnd::OwnEnd) && has(SideEnd::OtherEnd)) return {Verdict::OneLine, false};
  return {};
}

// What merging within a distance does to the lines, by length.
class MergeBalance {
 public:
  MergeBalance(const std::vector<ParallelStretch>& stretches, double touching, const RunContext& context) {
    for (const ParallelStretch& s : stretches) {
      if (context.isCancelled()) return;
      const Judged judged = judge(s);
      if (judged.verdict == Verdict::OneLine) {
        rightly_.push_back({s.widestPx, s.lengthPx()});
        if (judged.meets) meeting_.push_back({s.widestPx, s.lengthPx()});
      }
      if (judged.verdict != Verdict::TwoLines) continue;
      for (const double apart : s.apartPx)
        if (apart > touching) wrongly_.push_back({apart, s.stepPx});
    }
    for (auto* parts : {&rightly_, &meeting_, &wrongly_}) {
      if (context.isCancelled()) return;
      sumUp(*parts);
    }
  }
  double at(double distance) const { return upTo(rightly_, distance) - upTo(wrongly_, distance); }
  double meeting(double distance) const { return upTo(meeting_, distance); }

 private:
  struct Part {
    double distance, length;
  };
  static void sumUp(std::vector<Part>& parts) {
    std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.distance < b.distance; });
    for (int i = 1; i < std::ssize(parts); ++i) parts[i].length += parts[i - 1].length;
  }
  static double upTo(const std::vector<Part>& parts, double distance) {
    const auto after = std::upper_bound(parts.begin(), parts.end(), distance,
                                        [](double d, const Part& part) { return d < part.distance; });
    return after == parts.begin() ? 0.0 : (after - 1)->length;
  }
  std::vector<Part> rightly_, meeting_, wrongly_;
};

// [px] Strokes that run into one another are wider than the pen: the width of the thinner ones.
double singleWidth(const std::vector<Contour>& strokes) {
  std::vector<float> widths;
  for (const Contour& c : strokes) {
    const std::vector<float> own = strokeWidthsOf(c.points);
    widths.insert(widths.end(), own.begin(), own.end());
  }
  if (widths.empty()) return 1.0;
  const auto rank = static_cast<std::ptrdiff_t>(kThinShare * static_cast<double>(widths.size()));
  return std::max(1.0, static_cast<double>(elementOfRank(widths, rank)));
}

// Of all places on the strokes, those beside a stroke of the same line; one between two such strokes counts once.
double shareWithin(double distance, const std::vector<Contour>& strokes, const std::vector<ParallelStretch>& stretches,
                   const RunContext& context) {
  std::vector<std::vector<bool>> beside(strokes.size());
  for (const ParallelStretch& s : stretches) {
    if (context.isCancelled()) return 0.0;
    if (s.widestPx > distance || judge(s).verdict != Verdict::OneLine) continue;
    std::vector<bool>& own = beside[s.line];
    if (own.empty()) own.resize(strokes[s.line].points.size(), false);
    const int points = static_cast<int>(own.size()), step = static_cast<int>(s.stepPx);
    const int steps = (points + step - 1) / step;
    for (int k = 0; k < std::ssize(s.apartPx); ++k) {
      const int from = (s.firstStep + k) % steps * step;
      for (int i = from; i < std::min(from + step, points); ++i) own[i] = true;
    }
  }
  double such = 0.0, all = 0.0;
  for (int l = 0; l < std::ssize(strokes); ++l) {
    such += static_cast<double>(std::count(beside[l].begin(), beside[l].end(), true));
    all += static_cast<double>(strokes[l].points.size());
  }
  return such / all;
}

}  // namespace

std::optional<OverdrawnStrokes> findOverdrawnStrokes(const std::vector<Contour>& lines, double reachPx,
                                                     const RunContext& context) {
  std::vector<Contour> strokes;
  double length = 0.0;
  for (const Contour& c : lines) {
    if (context.isCancelled()) return std::nullopt;
    if (c.kind != ContourKind::Centreline || c.points.size() < 3) continue;
    strokes.push_back(c);
    length += c.lengthPx;
  }
  if (strokes.empty() || !(length > 0.0)) return std::nullopt;
  const double width = singleWidth(strokes);
  const std::vector<ParallelStretch> stretches = findParallelStrokes(strokes, width, reachPx, context);
  if (context.isCancelled()) return std::nullopt;
  const MergeBalance balance(stretches, touchingPx(width), context);
  if (context.isCancelled()) return std::nullopt;
  double best = 0.0, nearest = 0.0;
  for (double d = touchingPx(width); d <= reachPx; d *= kLadder) {
    if (balance.at(d) <= best) continue;
    best = balance.at(d);
    nearest = d;
  }
  if (balance.meeting(nearest) < kLeastOverdrawn * length || best < kLeastOverdrawn * length) return std::nullopt;
  double farthest = nearest;
  const double most = std::min(nearest / kFullWeight, reachPx);
  while (farthest * kLadder <= most && balance.at(farthest * kLadder) >= kNearlyBest * best) farthest *= kLadder;
  const double share = shareWithin(nearest, strokes, stretches, context);
  if (context.isCancelled()) return std::nullopt;
  return OverdrawnStrokes{std::sqrt(nearest * farthest), share};
}

}  // namespace batten
