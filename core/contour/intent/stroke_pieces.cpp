// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/intent/stroke_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/contour/merge/turn_cuts.h"
#include "core/polyline/point_grid.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

// In stroke widths, which are also samples.
constexpr double kAttached = 1.6, kCrossed = 1.0, kFreeEnd = 2.0;
constexpr int kOwnAttached = 6, kOwnCrossed = 8;  // a line is another line to itself from here on
constexpr int kOnePlace = 2;                      // cuts as near as this are one
constexpr int kShortestPiece = 3;                 // a shorter one has no direction

enum class CutKind { Crossing, Attachment, Corner };  // the weaker first
struct StrokeCut {
  int sample = 0;
  CutKind kind = CutKind::Crossing;
};

// A line in steps of one width.
struct LineSample {
  Vec2 at;        // [stroke widths]
  int point = 0;  // of the line, nearest to the sample
};
struct SampledLine {
  std::vector<LineSample> samples;
  bool closed = false;
  int count() const { return static_cast<int>(samples.size()); }
  // Samples between two of them, the short way round.
  int apart(int a, int b) const {
    const int d = std::abs(a - b);
    return closed ? std::min(d, count() - d) : d;
  }
};

SampledLine sampledLine(const Contour& line, double widthPx) {
  SampledLine sampled;
  sampled.closed = line.closed;
  const std::vector<Vec2> points = positionsOf(line.points);
  const std::vector<double> arc = cumulativeLength(points);
  const double length = polylineLength(points, line.closed);
  const int steps = std::max(2, static_cast<int>(std::lround(length / widthPx)));
  const int last = static_cast<int>(points.size()) - 1;
  int i = 0;
  for (int k = 0; k < steps + (line.closed ? 0 : 1); ++k) {
    const double along = length * k / steps;
    while (i < last && arc[i + 1] <= along) ++i;
    const double end = i < last ? arc[i + 1] : length;
    const double f = end > arc[i] ? std::clamp((along - arc[i]) / (end - arc[i]), 0.0, 1.0) : 0.0;
    const bool isEnd = i == last && !line.closed;
    const Vec2& next = isEnd ? points[i] : points[wrapIndex(i + 1, last + 1)];
    sampled.samples.push_back(
        {(points[i] + f * (next - points[i])) / widthPx, f < 0.5 || isEnd ? i : wrapIndex(i + 1, last + 1)});
  }
  return sampled;
}

class PieceCutter {
 public:
  PieceCutter(const std::vector<Contour>& lines, double widthPx) : contours_(lines), width_(widthPx) {
    for (int l = 0; l < std::ssize(lines); ++l) {
      lines_.push_back(sampledLine(lines[l], widthPx));
      for (int k = 0; k < lines_.back().count(); ++k) grid_.add(lines_.back().samples[k].at, {l, k});
    }
  }

  StrokePieceSet cut(const RunContext& context) {
    StrokePieceSet set;
    attached_.resize(lines_.size());
    for (int l = 0; l < std::ssize(lines_); ++l) {
      if (context.isCancelled()) return {};
      findAttachments(l);
    }
    for (int l = 0; l < std::ssize(lines_); ++l) {
      if (context.isCancelled()) return {};
      cutLine(l, set);
    }
    for (StrokePiece& piece : set.pieces) setFreeEnds(piece);
    return set;
  }

 private:
  struct Place {
    int line, sample;
  };

  const Vec2& atPlace(const Place& p) const { return lines_[p.line].samples[p.sample].at; }

  void findAttachments(int l) {
    const SampledLine& line = lines_[l];
    if (line.closed) return;
    for (const int end : {0, line.count() - 1}) {
      std::map<int, Place> nearest;  // by line
      grid_.around(line.samples[end].at, [&](const Place& p) {
        if (p.line == l && line.apart(p.sample, end) <= kOwnAttached) return;
        const auto distance = [&](const Place& q) { return (atPlace(q) - line.samples[end].at).norm(); };
        if (distance(p) > kAttached) return;
        const auto [known, isNew] = nearest.try_emplace(p.line, p);
        if (!isNew && distance(p) < distance(known->second)) known->second = p;
      });
      for (const auto& [of, place] : nearest) attached_[of].push_back(place.sample);
    }
  }

  bool isCrossed(int l, int sample) const {
    bool found = false;
    const SampledLine& line = lines_[l];
    grid_.around(line.samples[sample].at, [&](const Place& p) {
      if (p.line == l && line.apart(p.sample, sample) <= kOwnCrossed) return;
      found = found || (atPlace(p) - line.samples[sample].at).norm() <= kCrossed;
    });
    return found;
  }

  // In the middle of every run of samples that lie on another line.
  std::vector<StrokeCut> crossingsOf(int l) const {
    std::vector<StrokeCut> cuts;
    const int n = lines_[l].count();
    std::vector<bool> crossed;
    crossed.reserve(n);
    for (int k = 0; k < n; ++k) crossed.push_back(isCrossed(l, k));
    for (int k = 0; k < n; ++k) {
      if (!crossed[k]) continue;
      int last = k;
      while (last + 1 < n && crossed[last + 1]) ++last;
      cuts.push_back({(k + last) / 2, CutKind::Crossing});
      k = last;
    }
    return cuts;
  }

  // Ascending, none too near to another or to an open end.
  std::vector<StrokeCut> cutsOf(int l) const {
    const SampledLine& line = lines_[l];
    std::vector<StrokeCut> cuts;
    for (const int point : sharpPlacesOf(contours_[l], width_)) {
      const auto at = std::ranges::min_element(
          line.samples, {}, [&](const LineSample& sample) { return std::abs(sample.point - point); });
      cuts.push_back({static_cast<int>(at - line.samples.begin()), CutKind::Corner});
    }
    for (const int sample : attached_[l]) cuts.push_back({sample, CutKind::Attachment});
    const std::vector<StrokeCut> crossings = crossingsOf(l);
    cuts.insert(cuts.end(), crossings.begin(), crossings.end());
    cuts = places(std::move(cuts));
    std::stable_sort(cuts.begin(), cuts.end(), [](const StrokeCut& a, const StrokeCut& b) { return a.kind > b.kind; });
    std::vector<StrokeCut> kept;
    for (const StrokeCut& c : cuts) {
      const bool atEnd = !line.closed && std::min(c.sample, line.count() - 1 - c.sample) < kShortestPiece;
      const bool isNear = std::ranges::any_of(
          kept, [&](const StrokeCut& other) { return line.apart(c.sample, other.sample) < kShortestPiece; });
      if (!atEnd && !isNear) kept.push_back(c);
    }
    std::sort(kept.begin(), kept.end(), [](const StrokeCut& a, const StrokeCut& b) { return a.sample < b.sample; });
    return kept;
  }

  // Cuts that follow each other closely become one: at the corner among them, else in their middle.
  static std::vector<StrokeCut> places(std::vector<StrokeCut> cuts) {
    std::sort(cuts.begin(), cuts.end(), [](const StrokeCut& a, const StrokeCut& b) {
      return a.sample != b.sample ? a.sample < b.sample : a.kind < b.kind;
    });
    std::vector<StrokeCut> found;
    for (std::size_t i = 0; i < cuts.size();) {
      std::size_t end = i + 1;
      while (end < cuts.size() && cuts[end].sample - cuts[end - 1].sample <= kOnePlace) ++end;
      StrokeCut best{(cuts[i].sample + cuts[end - 1].sample) / 2, cuts[i].kind};
      for (std::size_t k = i; k < end; ++k) {
        if (cuts[k].kind == CutKind::Corner) found.push_back(cuts[k]);
        best.kind = std::max(best.kind, cuts[k].kind);
      }
      if (best.kind != CutKind::Corner) found.push_back(best);
      i = end;
    }
    return found;
  }

  void addPiece(int l, int from, int to, bool closed, StrokePieceSet& set) const {
    const SampledLine& line = lines_[l];
    StrokePiece piece;
    piece.line = l;
    piece.firstPoint = line.samples[wrapIndex(from, line.count())].point;
    piece.lastPoint = line.samples[wrapIndex(to, line.count())].point;
    const int points = static_cast<int>(contours_[l].points.size());
    if (closed) {
      piece.firstPoint = 0;
      piece.lastPoint = points - 1;
    } else if (piece.lastPoint <= piece.firstPoint) {
      piece.lastPoint += points;
    }
    for (int k = from; k <= to; ++k) piece.strip.samples.push_back({.at = line.samples[wrapIndex(k, line.count())].at});
    piece.strip.closed = closed;
    setTangents(piece.strip);
    piece.strip.members = {static_cast<int>(set.pieces.size())};
    set.pieces.push_back(std::move(piece));
  }

  void cutLine(int l, StrokePieceSet& set) const {
    const SampledLine& line = lines_[l];
    const std::vector<StrokeCut> cuts = cutsOf(l);
    const int n = line.count(), first = static_cast<int>(set.pieces.size());
    const auto link = [&](int from, int to, CutKind kind) {
      set.links.push_back({2 * from + 1, 2 * to, kind == CutKind::Corner});
    };
    if (cuts.empty()) {
      addPiece(l, 0, n - 1, line.closed, set);
    } else if (line.closed) {
      const int pieces = static_cast<int>(cuts.size());
      for (int i = 0; i < pieces; ++i)
        addPiece(l, cuts[i].sample, i + 1 < pieces ? cuts[i + 1].sample : cuts[0].sample + n, false, set);
      for (int i = 0; i < pieces; ++i) link(first + wrapIndex(i - 1, pieces), first + i, cuts[i].kind);
    } else {
      int from = 0;
      for (const StrokeCut& c : cuts) addPiece(l, std::exchange(from, c.sample), c.sample, false, set);
      addPiece(l, from, n - 1, false, set);
      for (int i = 0; i < std::ssize(cuts); ++i) link(first + i, first + i + 1, cuts[i].kind);
    }
  }

  // The piece's own samples are those of its line near the end.
  void setFreeEnds(StrokePiece& piece) const {
    const SampledLine& line = lines_[piece.line];
    if (piece.strip.closed) return;
    for (const int side : {0, 1}) {
      const Vec2& tip = side == 0 ? piece.strip.samples.front().at : piece.strip.samples.back().at;
      const Vec2 &first = line.samples.front().at, &last = line.samples.back().at;
      const bool isLineEnd = !line.closed && (tip == first || tip == last);
      if (!isLineEnd) continue;
      const int end = tip == first ? 0 : line.count() - 1;
      bool alone = true;
      grid_.around(tip, [&](const Place& p) {
        if (p.line == piece.line && line.apart(p.sample, end) <= kOwnAttached) return;
        alone = alone && (atPlace(p) - tip).norm() > kFreeEnd;
      });
      piece.strip.isFree[side] = alone;
    }
  }

  const std::vector<Contour>& contours_;
  double width_;
  std::vector<SampledLine> lines_;
  PointGrid<Place> grid_{kFreeEnd};
  std::vector<std::vector<int>> attached_;  // by line: samples
};

}  // namespace

StrokePieceSet cutIntoPieces(const std::vector<Contour>& lines, double widthPx, const RunContext& context) {
  return PieceCutter(lines, widthPx).cut(context);
}

}  // namespace batten
