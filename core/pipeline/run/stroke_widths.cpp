// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/stroke_widths.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "core/contour/centreline/profile/stroke_profile.h"
#include "core/curve/arc_length.h"
#include "core/curve/width_fit.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kSamplesPerPx = 2.0;  ///< Of the curve: a width changes by nothing over half a pixel.
/// [stroke widths] So near to a corner the other side's ink lies across this one's.
constexpr double kCornerWidths = 1.0;

/// Follows the points of a line along a curve through samples of it.
class CurveWalk {
 public:
  CurveWalk(const NurbsCurve& curve, bool closed, double pixelMm, CancelCheck check) : closed_(closed) {
    const double length = ArcLength(curve, check).total();
    const int count = std::max(3, static_cast<int>(std::ceil(kSamplesPerPx * length / pixelMm)) + 1);
    samples_ = sampleByArcLength(curve, count, check);
    length_ = samples_.empty() ? 0.0 : samples_.back().s;
  }
  double length() const { return length_; }
  double step() const { return length_ / static_cast<double>(last()); }

  /// The sample nearest to a point, wherever it is.
  std::ptrdiff_t nearest(const Vec2& p) const {
    const auto found = std::min_element(samples_.begin(), samples_.end(), [&](const auto& a, const auto& b) {
      return (a.point - p).squaredNorm() < (b.point - p).squaredNorm();
    });
    return found - samples_.begin();
  }
  /// Down the distance from a sample to a near one; a loop goes on across its seam.
  std::ptrdiff_t near(std::ptrdiff_t from, const Vec2& p) const {
    std::ptrdiff_t at = placed(from);
    double best = distance(at, p);
    for (std::ptrdiff_t steps = 0; steps < last(); ++steps) {
      const std::ptrdiff_t before = placed(at - 1), behind = placed(at + 1);
      const double db = distance(before, p), da = distance(behind, p);
      if (!(std::min(db, da) < best)) break;
      at = db < da ? before : behind;
      best = std::min(db, da);
    }
    return at;
  }
  double arcLength(std::ptrdiff_t at) const { return samples_[at].s; }

 private:
  std::ptrdiff_t last() const { return std::ssize(samples_) - 1; }
  std::ptrdiff_t placed(std::ptrdiff_t at) const {
    if (!closed_) return std::clamp<std::ptrdiff_t>(at, 0, last());
    const std::ptrdiff_t r = at % last();
    return r < 0 ? r + last() : r;
  }
  double distance(std::ptrdiff_t at, const Vec2& p) const { return (samples_[at].point - p).squaredNorm(); }

  bool closed_;
  std::vector<CurveSample> samples_;
  double length_ = 0.0;
};

/// The widths of thin places by their darkness. Between half levels a blurred stroke is never thinner than the blur;
/// all of its darkness together is in proportion to its width, whatever the blur.
class ThinPlaces {
 public:
  ThinPlaces(const Contour& line, const GreyImage& grey)
      : line_(line), grey_(grey), directions_(directions(positionsOf(line.points), line.closed, kDirectionReach)) {
    const int stride = std::max(1, static_cast<int>(std::ssize(line.points)) / kInkPlaces);
    std::vector<double> levels;
    for (int i = 0; i < std::ssize(line.points); i += stride) {
      const ContourPoint& point = line.points[i];
      if (!point.refined || !point.widthPx || *point.widthPx < kWholePx) continue;
      const InkAcross ink = across(i, *point.widthPx, sampleGrey(grey, point.at.x(), point.at.y()));
      levels.push_back(ink.paper - ink.middle);
    }
    if (!levels.empty()) inkLevel_ = upperMedian(levels);
  }

  /// [px] Nothing for places that are not thin, or where the stroke is nowhere so wide that its full ink shows.
  std::optional<double> widthAt(int i) const {
    const ContourPoint& point = line_.points[i];
    if (!inkLevel_ || *point.widthPx >= kWholePx) return std::nullopt;
    const InkAcross ink = across(i, *point.widthPx, *inkLevel_);
    const double contrast = ink.paper - *inkLevel_;
    if (!(contrast >= kLeastContrast)) return std::nullopt;
    const double dark = std::max(0.0, ink.darkness / contrast);
    if (dark >= kWholePx) return std::nullopt;
    if (!point.refined) return dark;
    const double share = std::clamp((kWholePx - *point.widthPx) / kBlendPx, 0.0, 1.0);
    return std::lerp(static_cast<double>(*point.widthPx), dark, share);
  }

 private:
  static constexpr int kDirectionReach = 3;  ///< [points]
  static constexpr int kInkPlaces = 200;     ///< Where the full ink is looked at, about.
  /// [px] Blur of a scan (0.8 px, and 0.5 px of the measurement) leaves the middle of so wide a stroke at its full ink.
  static constexpr double kWholePx = 5.0;
  static constexpr double kLeastContrast = 10.0;  ///< [grey] Less is noise of the scan.
  static constexpr double kBlendPx = 1.0;         ///< Over which one measure takes over from the other.
  static constexpr double kPaperPx = 3.5;         ///< [px] Beside the ink: two px of blur, and paper to measure.

  InkAcross across(int i, double widthPx, double inkLevel) const {
    const int half = static_cast<int>(std::ceil((0.5 * widthPx + kPaperPx) / kStrokeStepPx));
    return inkAcross(profileAcross(grey_, line_.points[i].at, directions_[i], half), widthPx, inkLevel);
  }

  const Contour& line_;
  const GreyImage& grey_;
  std::vector<Vec2> directions_;
  std::optional<double> inkLevel_;  ///< [grey] Of the full ink; absent: nowhere wide.
};

}  // namespace

/// The widths of the points of a line, where they are this stroke's alone. @pre hasStrokeWidths
class StrokeWidths::OfLine {
 public:
  OfLine(const Contour& line, const GreyImage& grey) : line_(line), thin_(line, grey) {
    std::vector<float> widths = strokeWidthsOf(line.points);
    usualPx_ = upperMedian(widths);
    anyRefined_ = std::any_of(line.points.begin(), line.points.end(), [](const auto& p) { return p.refined; });
    isBridge_.assign(line.points.size(), 0);
    const int last = static_cast<int>(line.points.size()) - 1;
    for (const auto& [from, to] : line.bridges)
      for (int i = std::max(0, from); i <= std::min(last, to); ++i) isBridge_[i] = 1;
  }
  std::optional<double> usual() const { return usualPx_ > 0.0 ? std::optional(usualPx_) : std::nullopt; }
  /// @param index of a point of the line, as its piece counts on from its first one.
  std::optional<double> widthAt(const Piece& piece, int index, double toStartPx, double toEndPx) const {
    const int i = wrapIndex(index, static_cast<int>(line_.points.size()));
    const ContourPoint& point = line_.points[i];
    if (!point.widthPx || !std::isfinite(*point.widthPx)) return std::nullopt;
    if (isBridge_[i] != 0) return std::nullopt;
    const double near = kCornerWidths * usualPx_;
    if ((piece.startIsCorner && toStartPx < near) || (piece.endIsCorner && toEndPx < near)) return std::nullopt;
    if (!anyRefined_) return *point.widthPx;  // pencil has no edges to measure between
    if (const auto thin = thin_.widthAt(i)) return thin;
    return point.refined ? std::optional<double>(*point.widthPx) : std::nullopt;
  }

 private:
  const Contour& line_;
  ThinPlaces thin_;
  std::vector<char> isBridge_;  ///< By point.
  double usualPx_ = 0.0;
  bool anyRefined_ = false;
};

StrokeWidths::StrokeWidths(const PipelineOutput& output, const Scan& scan, CancelCheck check)
    : output_(output), scan_(scan), check_(check) {}
StrokeWidths::~StrokeWidths() = default;

const StrokeWidths::OfLine* StrokeWidths::ofLine(int contour) {
  const auto [known, isNew] = lines_.try_emplace(contour);
  const Contour& line = output_.contours->contours[contour];
  if (isNew && hasStrokeWidths(line.points)) known->second = std::make_unique<OfLine>(line, tracedGrey(scan_, output_));
  return known->second.get();
}

std::optional<WidthProfile> StrokeWidths::along(const TracedCurve& curve, const NurbsCurve& shape) {
  if (shape.isEmpty() || !output_.pieces || !output_.contours) return std::nullopt;
  // Curves of an older run may be shown beside the pieces of a newer one, for a moment.
  if (curve.piece < 0 || curve.piece >= std::ssize(output_.pieces->pieces)) return std::nullopt;
  const Piece& piece = output_.pieces->pieces[curve.piece];
  if (piece.points.size() < 2) return std::nullopt;
  const OfLine* widths = ofLine(piece.contour);
  if (widths == nullptr) return std::nullopt;
  const double pixel = output_.frame.mmPerPx;
  const CurveWalk walk(shape, curve.closed, pixel, check_);
  if (check_.isCancelled() || !(walk.length() > 0.0)) return std::nullopt;
  const std::vector<double> along = cumulativeLength(positionsOf(piece.points));
  const double whole = along.back() + (piece.closed ? (piece.points.front().at - piece.points.back().at).norm() : 0.0);
  if (!(whole > 0.0)) return std::nullopt;
  // A faired or simplified curve may be shorter or longer than its line.
  const double samplesPerPx = walk.length() / walk.step() / whole;
  std::vector<WidthSample> measured;
  std::ptrdiff_t at = curve.closed ? walk.nearest(output_.frame.pointToModel(piece.points[0].at)) : 0;
  for (int i = 0; i < std::ssize(piece.points); ++i) {
    if (check_.isCancelled()) return std::nullopt;
    const double gone = i > 0 ? along[i] - along[i - 1] : 0.0;
    at = walk.near(at + std::lround(gone * samplesPerPx), output_.frame.pointToModel(piece.points[i].at));
    if (const auto px = widths->widthAt(piece, piece.firstPoint + i, along[i], whole - along[i]))
      measured.push_back({walk.arcLength(at), output_.frame.lengthToModel(*px)});
  }
  // A piece all of which is near corners or crossings: as wide as its line.
  if (measured.empty()) measured.push_back({0.0, output_.frame.lengthToModel(widths->usual().value_or(0.0))});
  WidthProfile fitted = fittedWidths(measured, walk.length(), curve.closed, pixel, check_);
  if (check_.isCancelled()) return std::nullopt;
  return fitted;
}

std::optional<WidthProfile> strokeWidthsAlong(const PipelineOutput& output, const Scan& scan, const TracedCurve& curve,
                                              const NurbsCurve& shape, CancelCheck check) {
  return StrokeWidths(output, scan, check).along(curve, shape);
}

}  // namespace batten
