// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/joined_sections.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/construct/fair/fair_join.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

/// Curvature extrema of what follows the points closely, without a judgement of each.
int extremaOf(const std::vector<NurbsCurve>& fills, double size, bool closed, const RunContext& context) {
  std::ptrdiff_t count = 0;
  for (const NurbsCurve& fill : fills)
    count += std::ssize(curvatureExtrema(fill, kExtremumProminence / size, closed, context));
  return static_cast<int>(count);
}

std::string sharpFeatureNote(std::size_t count) {
  if (count == 1)
    return "Turns sharply at 1 place: mark a corner there for an exact fit; where the line only trembles, raise "
           "Detail.";
  constexpr std::size_t kScatteredPlaces = 500;  // that nobody draws in one line
  if (count >= kScatteredPlaces)
    return "Turns sharply at " + std::to_string(count) +
           " places. Points that are scattered must be put in the order in which the line runs; corners that are meant "
           "can be marked.";
  return "Turns sharply at " + std::to_string(count) +
         " places: mark corners there for an exact fit; where the line only trembles, raise "
         "Detail.";
}

/// The curve of a piece, section by section in the order of the line.
class SectionChain {
 public:
  SectionChain(const ConstructPiece& piece, const FittedSections& sections, const RunContext& context)
      : piece_(piece),
        smooth_(sections.smooth),
        fits_(sections.fits),
        count_(static_cast<int>(smooth_.size())),
        pointCount_(static_cast<int>(piece.points.size())),
        context_(context) {
    whole_.report.why = Termination::Converged;
    whole_.report.note = sharpFeatureNote(sections.sharp.size());
  }

  Result<ConstructedPiece> run() {
    if (smooth_.empty()) return throughThePoints();
    if (piece_.closed) first_ = longestSection();
    if (auto begun = piece_.closed ? beginInTheMiddle() : beginAtTheStart(); !begun) return fail(begun.error());
    for (int k = 1; k < count_; ++k) {
      if (context_.isCancelled()) return cancelled();
      const int to = (first_ + k) % count_;
      if (auto filled = fillBefore(to); !filled) return fail(filled.error());
      place(fits_[to].curve, fits_[to].report, 0.0, lengthOf(fits_[to].curve));
    }
    if (auto ended = piece_.closed ? endInTheMiddle() : endAtTheEnd(); !ended) return fail(ended.error());
    return joined();
  }

 private:
  static double lengthOf(const NurbsCurve& curve) { return curve.end() - curve.start(); }

  /// Without a smooth section: close to the points all along.
  Result<ConstructedPiece> throughThePoints() {
    auto curve = piece_.closed ? tightLoop(positionsOf(piece_.points)) : cornerFill(positionsOf(piece_.points), {}, {});
    if (!curve) return fail(curve.error());
    whole_.curve = std::move(*curve);
    whole_.report.why = Termination::Degenerate;
    whole_.report.note =
        "The line bends too sharply everywhere for the fair fit; a curve close to the points was "
        "used.";
    whole_.report.extremaInSharpFeatures = extremaOf({whole_.curve}, extent(whole_.curve), piece_.closed, context_);
    return std::move(whole_);
  }

  int longestSection() const {
    const auto isShorter = [](const PointRange& a, const PointRange& b) { return a.last - a.first < b.last - b.first; };
    return static_cast<int>(std::max_element(smooth_.begin(), smooth_.end(), isShorter) - smooth_.begin());
  }

  /// Closed: begins in the middle of the longest section, where all derivatives meet.
  Result<void> beginInTheMiddle() {
    const NurbsCurve& longest = fits_[first_].curve;
    half_ = 0.5 * lengthOf(longest);
    auto made = split(longest, longest.start() + half_);
    if (!made) return fail(made.error());
    place(made->right, fits_[first_].report, half_, 2.0 * half_);
    halves_ = std::move(*made);
    return {};
  }

  Result<void> endInTheMiddle() {
    if (context_.isCancelled()) return cancelled();
    if (auto filled = fillBefore(first_); !filled) return filled;
    place(halves_->left, fits_[first_].report, 0.0, half_);
    return {};
  }

  Result<void> beginAtTheStart() {
    const NurbsCurve& first = fits_.front().curve;
    if (smooth_.front().first > 0) {
      if (auto filled = fill({0, smooth_.front().first - 1}, {}, startOf(first)); !filled) return filled;
    }
    place(first, fits_.front().report, 0.0, lengthOf(first));
    return {};
  }

  Result<void> endAtTheEnd() {
    if (smooth_.back().last >= pointCount_ - 1) return {};
    return fill({smooth_.back().last + 1, pointCount_ - 1}, endOf(fits_.back().curve), {});
  }

  /// The corner fill between a smooth section and the one before it.
  Result<void> fillBefore(int to) {
    const int from = (to + count_ - 1) % count_;
    int next = smooth_[to].first;
    while (next <= smooth_[from].last) next += pointCount_;
    return fill({smooth_[from].last + 1, next - 1}, endOf(fits_[from].curve), startOf(fits_[to].curve));
  }

  Result<void> fill(const PointRange& range, const std::optional<CurveEnd>& before,
                    const std::optional<CurveEnd>& after) {
    std::vector<Vec2> points;
    for (int i = range.first; i <= range.last; ++i) points.push_back(piece_.points[i % pointCount_].at);
    auto curve = cornerFill(points, before, after);
    if (!curve) return fail(curve.error());
    total_ += lengthOf(*curve);
    fills_.push_back(*curve);
    parts_.push_back(std::move(*curve));
    return {};
  }

  /// A fit, or half of one: what lies between two of its arc lengths.
  void place(const NurbsCurve& curve, const ConstructReport& report, double from, double to) {
    addNotes(whole_.report, report, {from, to, total_});
    parts_.push_back(curve);
    total_ += lengthOf(curve);
  }

  Result<ConstructedPiece> joined() {
    auto curve = joinSmoothly(parts_);
    if (!curve) return fail(curve.error());
    whole_.curve = std::move(*curve);
    whole_.report.noisePx = fits_[first_].report.noisePx;
    whole_.report.extremaInSharpFeatures = extremaOf(fills_, extent(whole_.curve), false, context_);
    int full = whole_.curve.controlPointCount();
    for (const ConstructedPiece& fit : fits_) {
      if (fit.report.fullControlPoints) full += *fit.report.fullControlPoints - fit.curve.controlPointCount();
    }
    whole_.report.fullControlPoints = full;
    return std::move(whole_);
  }

  const ConstructPiece& piece_;
  std::span<const PointRange> smooth_;
  std::span<const ConstructedPiece> fits_;
  int count_, pointCount_;
  const RunContext& context_;
  ConstructedPiece whole_;
  std::vector<NurbsCurve> parts_, fills_;
  double total_ = 0.0;                ///< Length of the parts so far.
  int first_ = 0;                     ///< The smooth section with which the curve begins.
  std::optional<SplitCurve> halves_;  ///< Closed: of its fit.
  double half_ = 0.0;
};

}  // namespace

void addNotes(ConstructReport& whole, const ConstructReport& part, const NotedStretch& stretch) {
  const auto [from, to, offset] = stretch;
  for (ExtremumNote e : part.extrema) {
    if (e.s < from || e.s > to) continue;
    e.s += offset - from;
    whole.extrema.push_back(e);
  }
  for (const NoiseNote& note : part.noise) {
    if (note.s < from || note.s > to) continue;
    whole.noise.push_back({note.s + offset - from, note.sigma});
  }
  whole.knotRemovalMovedPx = std::max(whole.knotRemovalMovedPx, part.knotRemovalMovedPx);
  if (part.why == Termination::IterationLimit) whole.why = Termination::IterationLimit;
}

Result<ConstructedPiece> joinSections(const ConstructPiece& piece, const FittedSections& sections,
                                      const RunContext& context) {
  return SectionChain(piece, sections, context).run();
}

}  // namespace batten
