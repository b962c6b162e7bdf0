// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/explain/redraw.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/base/statistics.h"
#include "core/curve/arc_length.h"
#include "core/image/bits/bit_disc.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"
#include "core/polyline/point_grid.h"

namespace batten {
namespace {

constexpr double kLeastReachPx = 2.0;     // to either side of a curve
constexpr double kCellPx = 8.0;           // a curve lies nearer than this to the points that it was fitted to
constexpr double kMostlyInk = 2.0 / 3.0;  // of a place: pencil shading has highlights

// What a curve asks the points of its line.
class LineWidths {
 public:
  explicit LineWidths(const Contour& line) : line_(line), grid_(kCellPx) {
    for (int i = 0; i < std::ssize(line.points); ++i) grid_.add(line.points[i].at, i);
    bridged_.assign(line.points.size(), false);
    for (const auto& [first, last] : line.bridges) {
      for (int i = std::max(0, first); i <= last && i < std::ssize(bridged_); ++i) bridged_[i] = true;
    }
    std::vector<float> widths = strokeWidthsOf(line.points);
    if (!widths.empty()) usual_ = 0.5 * static_cast<double>(upperMedian(widths));
  }

  RedrawnPoint at(const Vec2& px) const {
    std::optional<int> nearest;
    double least = kCellPx * kCellPx;
    grid_.around(px, [&](int i) {
      const double distance = (line_.points[i].at - px).squaredNorm();
      if (distance < least) {
        least = distance;
        nearest = i;
      }
    });
    if (!nearest) return {px, usual_, false};
    const auto& width = line_.points[*nearest].widthPx;
    return {px, width ? 0.5 * static_cast<double>(*width) : usual_, bridged_[*nearest]};
  }

 private:
  const Contour& line_;
  PointGrid<int> grid_;
  std::vector<bool> bridged_;
  double usual_ = 0.0;
};

// Fills what closed lines enclose, even-odd.
BitImage filled(const std::vector<std::vector<Vec2>>& outlines, int width, int height, const RunContext& context) {
  std::vector<std::vector<double>> crossings(height);
  for (const auto& outline : outlines) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
      const double low = std::min(a.y(), b.y()), high = std::max(a.y(), b.y());
      const int y0 = std::max(0, static_cast<int>(std::ceil(low - 0.5)));
      for (int y = y0; y < height && y + 0.5 < high; ++y) {
        crossings[y].push_back(a.x() + (b.x() - a.x()) * (y + 0.5 - a.y()) / (b.y() - a.y()));
      }
    }
  }
  BitImage image(width, height);
  for (int y = 0; y < height && !context.isCancelled(); ++y) {
    std::sort(crossings[y].begin(), crossings[y].end());
    for (std::size_t k = 0; k + 1 < crossings[y].size(); k += 2) {
      const int x0 = std::max(0, static_cast<int>(std::ceil(crossings[y][k] - 0.5)));
      const int x1 = std::min(width, static_cast<int>(std::ceil(crossings[y][k + 1] - 0.5)));
      if (x0 < x1) setBits(image, {y, x0, x1});
    }
  }
  return image;
}

// The closed borders of which every piece has a curve.
std::vector<std::vector<Vec2>> closedBorders(const std::vector<RedrawnCurve>& curves, const PipelineOutput& out) {
  std::map<int, int> piecesOf;
  for (const Piece& piece : out.pieces->pieces) ++piecesOf[piece.contour];
  std::map<int, std::map<int, const RedrawnCurve*>> found;  // by contour, then in order along it
  for (const RedrawnCurve& c : curves) {
    const TracedCurve& traced = out.faired->curves[c.curve];
    if (c.kind == ContourKind::Outline && out.contours->contours[traced.contour].closed)
      found[traced.contour][out.pieces->pieces[traced.piece].index] = &c;
  }
  std::vector<std::vector<Vec2>> borders;
  for (const auto& [contour, pieces] : found) {
    if (static_cast<int>(pieces.size()) != piecesOf[contour]) continue;
    std::vector<Vec2>& border = borders.emplace_back();
    for (const auto& [index, curve] : pieces) {
      for (const RedrawnPoint& p : curve->points) border.push_back(p.at);
    }
  }
  return borders;
}

// Paper that a line goes around is not explained by the line.
BitImage onlyInked(const BitImage& areas, const BitImage& ink, const RunContext& context) {
  const RunPieces pieces = findPieces(areas, Connectivity::Four, context);
  struct Area {
    std::int64_t all = 0, inked = 0;
  };
  std::map<int, Area> area;
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    Area& a = area[pieces.piece[i]];
    a.all += pieces.runs[i].x1 - pieces.runs[i].x0;
    a.inked += countBits(ink, pieces.runs[i]);
  }
  BitImage kept(areas.width, areas.height);
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const Area& a = area[pieces.piece[i]];
    if (static_cast<double>(a.inked) >= kMostlyInk * static_cast<double>(a.all)) setBits(kept, pieces.runs[i]);
  }
  return kept;
}

}  // namespace

double explainingReach(const RedrawnPoint& p) { return std::max(kLeastReachPx, p.halfWidthPx); }

void setExplained(BitImage& page, const RedrawnPoint& p) { setDisc(page, p.at, p.halfWidthPx + explainingReach(p)); }

std::vector<RedrawnCurve> redrawCurves(const PipelineOutput& out, const RunContext& context) {
  std::vector<RedrawnCurve> redrawn;
  if (!out.faired || !out.contours) return redrawn;
  std::map<int, LineWidths> lines;
  for (int i = 0; i < std::ssize(out.faired->curves) && !context.isCancelled(); ++i) {
    const TracedCurve& curve = out.faired->curves[i];
    if (!curve.included) continue;
    const Contour& line = out.contours->contours[curve.contour];
    const LineWidths& widths = lines.try_emplace(curve.contour, line).first->second;
    RedrawnCurve& drawn = redrawn.emplace_back();
    drawn.curve = i;
    drawn.kind = line.kind;
    const double lengthPx = out.frame.lengthToImage(curve.fairedFigures.lengthMm);
    const int count = std::clamp(static_cast<int>(std::ceil(lengthPx)) + 1, 2, 1000000);
    for (const CurveSample& sample : sampleByArcLength(curve.faired, count))
      drawn.points.push_back(widths.at(out.frame.pointToImage(sample.point)));
  }
  return redrawn;
}

BitImage redrawPage(const std::vector<RedrawnCurve>& curves, const PipelineOutput& out, const BitImage& ink,
                    const RunContext& context) {
  BitImage page = onlyInked(filled(closedBorders(curves, out), ink.width, ink.height, context), ink, context);
  for (const RedrawnCurve& c : curves) {
    if (context.isCancelled()) return page;
    for (const RedrawnPoint& p : c.points) setExplained(page, p);
  }
  return page;
}

}  // namespace batten
