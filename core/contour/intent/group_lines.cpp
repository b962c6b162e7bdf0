// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/intent/group_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/contour/merge/merged_contour.h"
#include "core/contour/merge/stroke_lines.h"
#include "core/contour/merge/turn_cuts.h"
#include "core/polyline/point_grid.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

// In stroke widths.
constexpr double kLeastAlone = 0.9;        // of the ink of its pieces: a shorter mean has some of them side by side
constexpr double kGroupReachShare = 0.95;  // of the strokes' samples lie within the reach of the bundle
constexpr double kBundleMargin = 1.0;      // beyond the middles of the strokes: the ink of the outermost
constexpr double kClosing = 3.0;           // ends as near as this, and the spread, close a line
constexpr double kClosingCos = 0.5;        // 60 degrees
constexpr double kShortestRing = 15.0;     // the ends of a shorter line are near each other in any case
// What runs within the bundle of a longer line is of it; a lone line has no bundle.
constexpr double kExplainedNear = 1.5, kExplainedAlong = 4.5, kExplainedSpreads = 1.5, kExplainedCos = 0.85,
                 kExplainedNearCos = 0.5;
constexpr double kUnexplained = 3.0, kUnexplainedShare = 0.35;  // of a line, of its ink: with less of its own it goes

// A line made of one mean.
struct GroupLine {
  PieceMean mean;
  Contour contour;
};

// The pieces if they follow each other on one line, in its order.
std::optional<std::pair<int, int>> oneStretch(const PieceMean& mean, const StrokePieceSet& set) {
  const std::vector<int>& members = mean.strip.members;
  for (std::size_t i = 1; i < members.size(); ++i) {
    const StrokePiece &before = set.pieces[members[i - 1]], &after = set.pieces[members[i]];
    if (members[i] != members[i - 1] + 1 || before.line != after.line) return std::nullopt;
    // Pieces that lie over each other are no stretch of the line.
    if (static_cast<double>(mean.strip.count()) < kLeastAlone * mean.strip.inkPerLength * mean.strip.count())
      return std::nullopt;
  }
  return std::pair(members.front(), members.back());
}

Contour tracedStretch(const std::vector<Contour>& lines, const StrokePieceSet& set, std::pair<int, int> pieces) {
  const StrokePiece &first = set.pieces[pieces.first], &last = set.pieces[pieces.second];
  const Contour& line = lines[first.line];
  const int n = static_cast<int>(line.points.size());
  if (first.strip.closed) return line;
  int to = last.lastPoint;
  while (to <= first.firstPoint) to += n;
  if (line.closed && to - first.firstPoint >= n) {
    // All round: cut where it was not joined.
    return cutPart(line, first.firstPoint, first.firstPoint + n);
  }
  return cutPart(line, first.firstPoint, std::min(to, line.closed ? to : n - 1));
}

class MeanDrawer {
 public:
  MeanDrawer(const std::vector<Contour>& lines, const StrokePieceSet& set, double widthPx)
      : lines_(lines), set_(set), width_(widthPx) {}

  Contour draw(const PieceMean& mean, const RunContext& context) const {
    std::vector<Contour> parts;
    for (const PlacedPiece& p : mean.placed) {
      const StrokePiece& piece = set_.pieces[p.piece];
      const Contour& line = lines_[piece.line];
      parts.push_back(piece.strip.closed ? line : cutPart(line, piece.firstPoint, piece.lastPoint));
    }
    MeanLine line = meanLine(mean, parts);
    close(line, mean);
    const double reach = (reachOf(mean) + kBundleMargin) * width_;
    const StrokesBeside strokes(parts, reach);
    return mergedContour(line, parts, strokes, reach, context);
  }

 private:
  // [stroke widths] From the mean to nearly all strokes.
  double reachOf(const PieceMean& mean) const {
    std::vector<double> across;
    for (const PlacedPiece& p : mean.placed) {
      const Strip& strip = set_.pieces[p.piece].strip;
      for (int k = 0; k < strip.count(); ++k) {
        const int i = std::clamp(static_cast<int>(std::lround(p.direction * k + p.offset - mean.from)), 0,
                                 mean.strip.count() - 1);
        const StripSample& on = mean.strip.samples[i];
        across.push_back(std::abs(cross(on.tangent, Vec2(strip.samples[k].at - on.at))));
      }
    }
    return lowerQuantile(across, kGroupReachShare);
  }

  // About one point a pixel; its source is the nearest stroke there.
  MeanLine meanLine(const PieceMean& mean, const std::vector<Contour>& parts) const {
    MeanLine line;
    const Strip& strip = mean.strip;
    const std::vector<Vec2> positions = positionsOf(strip.samples);
    const int points = std::max(2, static_cast<int>(std::lround((strip.count() - 1) * width_)) + 1);
    MeanPoint::Source last;
    for (int i = 0; i < points; ++i) {
      const double place = static_cast<double>(i) * (strip.count() - 1) / (points - 1);
      MeanPoint p;
      p.at = width_ * pointBetween(positions, false, place);
      const StripSample& sample = strip.samples[std::lround(place)];
      p.tangent = sample.tangent;
      p.weight = static_cast<float>(std::max(1, sample.strokes));
      p.source = sourceAt(mean, place + mean.from, p.at, parts).value_or(last);
      last = p.source;
      line.points.push_back(p);
    }
    return line;
  }

  std::optional<MeanPoint::Source> sourceAt(const PieceMean& mean, double s, const Vec2& atPx,
                                            const std::vector<Contour>& parts) const {
    std::optional<MeanPoint::Source> best;
    double nearest = 0.0;
    for (int m = 0; m < std::ssize(mean.placed); ++m) {
      const PlacedPiece& p = mean.placed[m];
      const int samples = set_.pieces[p.piece].strip.count(), n = static_cast<int>(parts[m].points.size());
      const double k = p.direction * (s - p.offset);
      if (k < 0.0 || k > samples - 1) continue;
      const int index = std::clamp(static_cast<int>(std::lround(k / (samples - 1) * (n - 1))), 0, n - 1);
      const double distance = (parts[m].points[index].at - atPx).norm();
      if (best && distance >= nearest) continue;
      nearest = distance;
      best = MeanPoint::Source{m, index};
    }
    return best;
  }

  // A line that comes back to its start is closed; what runs on beyond the start is cut off.
  void close(MeanLine& line, const PieceMean& mean) const {
    const int n = line.count();
    if (mean.strip.count() < kShortestRing) return;
    const double reach = (kClosing + mean.strip.spread) * width_;
    const MeanPoint& start = line.points.front();
    std::optional<int> best;
    double nearest = reach;
    for (int i = n - 1; i >= (3 * n) / 4; --i) {  // of the last quarter: no more is given up
      const double d = (line.points[i].at - start.at).norm();
      if (d >= nearest || line.points[i].tangent.dot(start.tangent) < kClosingCos) continue;
      nearest = d;
      best = i;
    }
    if (!best) return;
    line = partOf(line, 0, *best);
    closeLine(line, 2.0 * reach);
  }

  const std::vector<Contour>& lines_;
  const StrokePieceSet& set_;
  double width_;
};

struct Explaining {
  Vec2 at, tangent;
  double reach;  // [stroke widths] of the bundle that it is of
};

// Leaves out what lies along longer lines, by the ink of their pieces. @pre longest first.
std::vector<Contour> withoutExplained(std::vector<GroupLine> found, const StrokePieceSet& set) {
  PointGrid<Explaining> ink(kExplainedAlong);
  std::vector<Contour> kept;
  for (int l = 0; l < std::ssize(found); ++l) {
    double unexplained = 0.0, all = 0.0;
    for (const int piece : found[l].mean.strip.members) {
      for (const StripSample& sample : set.pieces[piece].strip.samples) {
        bool explained = false;
        ink.around(sample.at, [&](const Explaining& e) {
          const double d = (e.at - sample.at).norm(), cosine = std::abs(e.tangent.dot(sample.tangent));
          explained = explained || (d <= kExplainedNear && cosine > kExplainedNearCos) ||
                      (d <= e.reach && cosine > kExplainedCos);
        });
        all += 1.0;
        unexplained += explained ? 0.0 : 1.0;
      }
    }
    const double perLength = found[l].mean.strip.inkPerLength;
    if (l > 0 && (unexplained < kUnexplained * perLength || unexplained < kUnexplainedShare * all)) {
      const bool isAlone = unexplained >= all;
      if (!isAlone) continue;
    }
    const double reach = std::min(kExplainedAlong, kExplainedNear + kExplainedSpreads * found[l].mean.strip.spread);
    for (const int piece : found[l].mean.strip.members) {
      for (const StripSample& sample : set.pieces[piece].strip.samples)
        ink.add(sample.at, {sample.at, sample.tangent, reach});
    }
    kept.push_back(std::move(found[l].contour));
  }
  return kept;
}

}  // namespace

std::vector<Contour> linesOfGroups(const std::vector<Contour>& lines, const StrokePieceSet& set,
                                   const PieceMeans& means, const std::vector<std::vector<int>>& groups, double widthPx,
                                   const RunContext& context) {
  std::vector<GroupLine> found;
  for (const auto& group : groups) {
    if (context.isCancelled()) return {};
    for (PieceMean& mean : means.of(group)) found.push_back({std::move(mean), {}});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const GroupLine& a, const GroupLine& b) { return a.mean.strip.count() > b.mean.strip.count(); });
  const MeanDrawer drawer(lines, set, widthPx);
  parallelFor(context, static_cast<int>(found.size()), 1, [&](int begin, int end) {
    RunContext alone = context;
    alone.threads = 1;
    for (int i = begin; i < end; ++i) {
      const auto stretch = oneStretch(found[i].mean, set);
      found[i].contour = stretch ? tracedStretch(lines, set, *stretch) : drawer.draw(found[i].mean, alone);
    }
  });
  if (context.isCancelled()) return {};
  std::erase_if(found, [](const GroupLine& line) { return line.contour.points.size() < 3; });
  return withoutExplained(std::move(found), set);
}

}  // namespace batten
