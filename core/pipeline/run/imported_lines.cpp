// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/imported_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/contour/pen_strokes.h"
#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "core/curve/rough_length.h"
#include "core/pipeline/run/piece_numbers.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kSampleStepPx = 1.0;  // distance of the points of a contour
constexpr double kMostImported = 1e6;  // points of all imported lines together; beyond, they lie wider apart
constexpr int kLeastSteps = 4, kMostSteps = 4000;  // of a span
constexpr int kMostSamples = 200'000;              // of a line
constexpr double kSeamGap = 1e-6;                  // of the size

/// A place on one of the curves of a line.
struct ImportedSample {
  int curve = 0;
  double u = 0.0;
};

/// Whether the line goes on in the same direction from its last curve to its first.
bool isSmoothSeam(const ImportedLine& line) {
  constexpr double kSameDirection = 1e-6;  // radians
  const NurbsCurve &last = line.curves.back().curve, &first = line.curves.front().curve;
  const Vec2 in = last.derivatives(last.end(), 1)[1], out = first.derivatives(first.start(), 1)[1];
  return in.dot(out) > 0.0 && std::abs(cross(in, out)) <= kSameDirection * in.norm() * out.norm();
}

/// [mm] At least as long as the line: no curve is longer than its control polygon.
double lengthBoundOf(const ImportedLine& line) {
  double length = polylineLength(line.points, line.closed);
  for (const auto& [curve, name] : line.curves) length += polylineLength(curve.controlPoints(), false);
  return length;
}

/// Steps of a span of a curve.
int stepsOf(const NurbsCurve& curve, double from, double to, const PageFrame& frame, double stepPx) {
  const double steps = std::ceil(frame.lengthToImage(roughLength(curve, from, to)) / stepPx);
  return static_cast<int>(std::clamp(steps, static_cast<double>(kLeastSteps), static_cast<double>(kMostSteps)));
}

std::vector<ImportedSample> samplesOf(const ImportedLine& line, const PageFrame& frame, double stepPx) {
  std::vector<ImportedSample> samples;
  for (std::size_t k = 0; k < line.curves.size(); ++k) {
    const NurbsCurve& curve = line.curves[k].curve;
    const std::vector<double> breaks = curve.breaks();
    for (std::size_t i = 1; i < breaks.size(); ++i) {
      const double from = breaks[i - 1], to = breaks[i];
      const bool isMuch = std::ssize(samples) > kMostSamples;
      const int steps = isMuch ? kLeastSteps : stepsOf(curve, from, to, frame, stepPx);
      for (int n = 0; n < steps; ++n) samples.push_back({static_cast<int>(k), from + (to - from) * n / steps});
    }
  }
  if (!line.closed) samples.push_back({static_cast<int>(line.curves.size()) - 1, line.curves.back().curve.end()});
  return samples;
}

Contour contourOfCurves(const ImportedLine& line, const PageFrame& frame, double stepPx) {
  Contour contour;
  const std::vector<ImportedSample> samples = samplesOf(line, frame, stepPx);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec2 at = frame.pointToImage(line.curves[samples[i].curve].curve.point(samples[i].u));
    contour.points.push_back({.at = at, .unrefined = at, .refined = true});
    const bool begins = i > 0 ? samples[i].curve != samples[i - 1].curve
                              : line.closed && (line.curves.size() > 1 || !isSmoothSeam(line));
    if (begins) contour.joints.push_back(static_cast<int>(i));
  }
  return contour;
}

/// Leaves out points between those that were given, so that about one every `stepPx` stays.
void keepEvery(double stepPx, Contour& contour) {
  const double laidPx = contour.lengthPx / static_cast<double>(std::max<std::ptrdiff_t>(1, std::ssize(contour.points)));
  const auto stride = static_cast<int>(std::ceil(stepPx / std::max(kSampleStepPx, laidPx)));
  if (stride <= 1) return;
  int since = 0;
  std::erase_if(contour.points, [&](const ContourPoint& p) {
    since = p.refined ? 0 : since + 1;
    return since % stride != 0;
  });
  contour.points.shrink_to_fit();
}

Contour contourOfPoints(const ImportedLine& line, const PageFrame& frame, double stepPx) {
  PenStroke stroke;
  stroke.closed = line.closed;
  for (const Vec2& p : line.points) stroke.points.push_back(frame.pointToImage(p));
  Contour contour = penContour(stroke);
  keepEvery(stepPx, contour);
  // Corners are counted in the points that were given.
  std::size_t corner = 0;
  int given = 0;
  for (std::size_t i = 0; i < contour.points.size() && corner < line.corners.size(); ++i) {
    if (!contour.points[i].refined) continue;
    while (given < std::ssize(stroke.points) && stroke.points[given] != contour.points[i].at) ++given;
    while (corner < line.corners.size() && line.corners[corner] < given) ++corner;
    if (corner < line.corners.size() && line.corners[corner] == given) {
      const bool isEnd = !line.closed && (i == 0 || i + 1 == contour.points.size());
      if (!isEnd) contour.joints.push_back(static_cast<int>(i));
      ++corner;
    }
  }
  return contour;
}

/// The part of a curve between two parameters.
std::optional<NurbsCurve> partOf(const NurbsCurve& curve, double from, double to) {
  NurbsCurve part = curve;
  if (to < part.end()) {
    auto cut = split(part, to);
    if (!cut) return std::nullopt;
    part = cut->left;
  }
  if (from > part.start()) {
    auto cut = split(part, from);
    if (!cut) return std::nullopt;
    part = cut->right;
  }
  return part;
}

/// The curve from one sample to another, on one curve of the line or over the seam of a closed one.
std::optional<NurbsCurve> curveBetween(const ImportedLine& line, std::span<const ImportedSample> samples, int first,
                                       int last) {
  const int count = static_cast<int>(samples.size());
  if (first < 0 || first >= count || last <= first) return std::nullopt;
  const ImportedSample& from = samples[first];
  const NurbsCurve& curve = line.curves[from.curve].curve;
  if (last >= count) {
    // Behind the last sample of a closed line comes its first.
    if (!line.closed || from.curve + 1 != std::ssize(line.curves)) return std::nullopt;
    auto head = partOf(curve, from.u, curve.end());
    const int rest = last - count;
    if (rest == 0 || !head) return head;
    const ImportedSample& to = samples[rest];
    if (rest >= count || to.curve != 0 || line.curves.size() != 1) return std::nullopt;
    const auto tail = partOf(curve, curve.start(), to.u);
    if (!tail) return std::nullopt;
    const std::array<NurbsCurve, 2> both{*head, *tail};
    auto joined = joinAtCorners(both, kSeamGap * extent(curve));
    return joined ? std::optional(std::move(*joined)) : std::nullopt;
  }
  const ImportedSample& to = samples[last];
  if (to.curve == from.curve) return partOf(curve, from.u, to.u);
  const bool isNext = to.curve == from.curve + 1 && (last == 0 || samples[last - 1].curve == from.curve);
  return isNext ? partOf(curve, from.u, curve.end()) : std::nullopt;
}

/// The curve of the line that a piece begins on; absent for lines of points. A curve begins at every joint.
std::optional<int> curveOfPiece(const ImportedLine& line, const Contour& contour, const Piece& piece) {
  if (line.curves.empty()) return std::nullopt;
  const auto begun = std::upper_bound(contour.joints.begin(), contour.joints.end(), piece.firstPoint);
  const auto before = std::distance(contour.joints.begin(), begun);
  const auto curve = line.closed ? before - 1 : before;
  const auto last = std::ssize(line.curves) - 1;
  return static_cast<int>(std::min(std::max<std::ptrdiff_t>(curve, 0), last));
}

}  // namespace

double importStepPx(std::span<const ImportedFile> imports, const PageFrame& frame) {
  double length = 0.0;
  for (const ImportedFile& file : imports) {
    for (const ImportedLine& line : file.lines) length += frame.lengthToImage(lengthBoundOf(line));
  }
  return std::max(kSampleStepPx, length / kMostImported);
}

ContourSet withImports(ContourSet set, std::span<const ImportedFile> imports, const PageFrame& frame,
                       const RunContext& context) {
  const double stepPx = importStepPx(imports, frame);
  int index = 0;
  for (const ImportedFile& file : imports) {
    for (const ImportedLine& line : file.lines) {
      if (context.isCancelled()) return set;
      Contour contour =
          line.curves.empty() ? contourOfPoints(line, frame, stepPx) : contourOfCurves(line, frame, stepPx);
      contour.kind = ContourKind::Imported;
      contour.closed = line.closed;
      contour.imported = index++;
      measureContour(contour);
      set.contours.push_back(std::move(contour));
    }
  }
  return set;
}

const ImportedLine* importedLineOf(const Contour& contour, std::span<const ImportedFile> imports) {
  if (!contour.imported) return nullptr;
  int index = *contour.imported;
  for (const ImportedFile& file : imports) {
    if (index < std::ssize(file.lines)) return &file.lines[index];
    index -= static_cast<int>(file.lines.size());
  }
  return nullptr;
}

std::string importedNameOf(const PieceSet& pieces, std::size_t piece, const ContourSet& contours,
                           std::span<const ImportedFile> imports) {
  const int line = pieces.pieces[piece].contour;
  if (line < 0 || line >= std::ssize(contours.contours)) return {};
  const Contour& contour = contours.contours[line];
  const ImportedLine* imported = importedLineOf(contour, imports);
  if (imported == nullptr) return {};
  const std::optional<int> curve = curveOfPiece(*imported, contour, pieces.pieces[piece]);
  const bool isNamed = curve && !imported->curves[*curve].name.empty();
  const std::string& name = isNamed ? imported->curves[*curve].name : imported->name;
  if (name.empty() || isMadeName(name)) return {};
  // The pieces of a line stand side by side.
  const auto isAlike = [&](std::size_t other) {
    const Piece& one = pieces.pieces[other];
    return one.contour == line && (!isNamed || curveOfPiece(*imported, contour, one) == curve);
  };
  std::size_t first = piece;
  // A line of thousands of pieces is not gone through for each of them.
  if (!isNamed) first -= pieces.pieces[piece].index;
  while (isNamed && first > 0 && isAlike(first - 1)) --first;
  const bool isAlone = first == piece && !(piece + 1 < pieces.pieces.size() && isAlike(piece + 1));
  return isAlone ? name : name + " " + std::to_string(piece - first + 1);
}

std::vector<std::optional<NurbsCurve>> importedCurves(const ImportedLine& line, std::span<const Piece> pieces,
                                                      const PageFrame& frame, double stepPx) {
  std::vector<std::optional<NurbsCurve>> curves(pieces.size());
  if (line.curves.empty()) return curves;
  const std::vector<ImportedSample> samples = samplesOf(line, frame, stepPx);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].closed) {
      if (line.curves.size() == 1) curves[i] = line.curves.front().curve;
    } else {
      curves[i] = curveBetween(line, samples, pieces[i].firstPoint, pieces[i].lastPoint);
    }
  }
  return curves;
}

}  // namespace batten
