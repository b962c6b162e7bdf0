// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/page_edge_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

#include "core/base/statistics.h"
#include "core/contour/centreline/profile/stroke_profile.h"

namespace batten {
namespace {

// All of the shorter side of the page, but for the length, which is of the side that the line runs along.
constexpr double kNearBorder = 0.03;   // the edge of a sheet that fills the picture
constexpr double kLong = 0.3;          // shorter ones near the border are drawn
constexpr double kAlone = 0.015;       // of any other line: a frame, a table or the ground touches something
constexpr double kInside = 0.12;       // no edge that shows as a step lies farther from the border
constexpr double kPart = 0.008;        // so near an edge lies what is a part of it
constexpr double kRightAcross = 0.95;  // of a side, but for what parts a line
constexpr double kPiece = 0.03;        // shorter pieces of an edge show no step for certain

constexpr double kLeastStep = 0.015;                  // of the brightness: by which one side of an edge is darker
constexpr double kStepped = 0.6, kAgainst = 0.1;      // of the length of an edge: so, and the other way round
constexpr double kFlatPaper = 0.02;                   // from a gutter: beyond, paper is as bright as the page
constexpr double kLeastDim = 0.03;                    // of the brightness: by which paper dims towards it
constexpr double kLeastAlong = 4.0;                   // of what an edge runs inwards
constexpr double kMostBow = 0.015, kMostBowPx = 2.0;  // of its length: a sheet is cut straight
constexpr double kGoesOn = 0.6;                       // of its length: so far beyond its ends an edge goes on straight
constexpr double kEdgeSideWidths = 1.5;               // from the middle of a line to the paper beside it
constexpr double kEdgeSidePx[] = {3.0, 5.0, 7.0, 9.0, 11.0};  // and farther

struct Page {
  explicit Page(const GreyImage& grey) : width(grey.width), height(grey.height) {}
  double width, height;
  double shorter() const { return std::min(width, height); }
};

/// A place as seen from one side of the page: along it, and inwards.
Vec2 seenFrom(int side, const Vec2& p, const Page& page) {
  switch (side) {
    case 0:
      return {p.x(), p.y()};
    case 1:
      return {p.x(), page.height - p.y()};
    case 2:
      return {p.y(), p.x()};
    default:
      return {p.y(), page.width - p.x()};
  }
}

struct Extent {
  Vec2 least = Vec2::Constant(std::numeric_limits<double>::infinity()), most = -least;
};
Extent extentFrom(int side, const Contour& c, const Page& page) {
  Extent extent;
  for (const ContourPoint& point : c.points) {
    const Vec2 p = seenFrom(side, point.at, page);
    extent.least = extent.least.cwiseMin(p), extent.most = extent.most.cwiseMax(p);
  }
  return extent;
}

/// Calls `look` at places along a line, with the unit normal there.
template <class Look>
void alongLine(const Contour& line, const Look& look) {
  constexpr int kEvery = 4, kTangent = 4;  // points
  for (int i = kTangent; i + kTangent < std::ssize(line.points); i += kEvery) {
    const Vec2 along = line.points[i + kTangent].at - line.points[i - kTangent].at;
    if (along.norm() > 0.0) look(line.points[i].at, leftNormal(along.normalized()));
  }
}

/// [px] From the middle of a line to the paper beside it.
double toPaperBeside(const Contour& line) {
  std::vector<float> widths = strokeWidthsOf(line.points);
  return widths.empty() ? 0.0 : kEdgeSideWidths * static_cast<double>(upperMedian(widths));
}

/// Brightness beside a place, from so many px on; for comparing.
double levelBeside(const GreyImage& grey, const Vec2& at, const Vec2& across, double fromPx) {
  double sum = 0.0;
  for (const double px : kEdgeSidePx) {
    const Vec2 p = at + (fromPx + px) * across;
    sum += static_cast<double>(sampleGrey(grey, p.x(), p.y()));
  }
  return sum;
}

/// +1 where the page is clearly brighter on the side of its middle than on that of its border along most of a line, and
/// hardly anywhere darker; -1 where it is the other way round; else 0.
int stepAlong(const Contour& line, int side, const GreyImage& grey) {
  const Page page(grey);
  const double beside = toPaperBeside(line);
  int brighter = 0, darker = 0, all = 0;
  alongLine(line, [&](const Vec2& at, Vec2 inwards) {
    if (seenFrom(side, at + inwards, page).y() < seenFrom(side, at, page).y()) inwards = -inwards;
    const double inner = levelBeside(grey, at, inwards, beside), outer = levelBeside(grey, at, -inwards, beside);
    const double least = kLeastStep * std::max(inner, outer);
    ++all, brighter += inner - outer > least ? 1 : 0, darker += outer - inner > least ? 1 : 0;
  });
  const double most = kStepped * all, few = kAgainst * all;
  if (brighter > most && darker < few) return 1;
  return darker > most && brighter < few ? -1 : 0;
}

/// Whether the paper dims towards a line on one of its sides: it bends away into a gutter, or lies in its shadow.
bool dimsTowards(const Contour& line, const GreyImage& grey) {
  const double beside = toPaperBeside(line), far = beside + kFlatPaper * Page(grey).shorter();
  const auto dims = [&](const Vec2& at, const Vec2& across) {
    return levelBeside(grey, at, across, beside) < (1.0 - kLeastDim) * levelBeside(grey, at, across, far);
  };
  int left = 0, right = 0, all = 0;
  alongLine(line, [&](const Vec2& at, const Vec2& across) {
    ++all, left += dims(at, across) ? 1 : 0, right += dims(at, -across) ? 1 : 0;
  });
  return all > 0 && std::max(left, right) >= kStepped * all;
}

bool isStraightEdge(const Contour& line) {
  const Vec2 from = line.points.front().at, chord = line.points.back().at - from;
  const double length = chord.norm();
  if (line.closed || !(length > 0.0)) return false;
  const Vec2 across = leftNormal(chord / length);
  return std::all_of(line.points.begin(), line.points.end(), [&](const ContourPoint& p) {
    return std::fabs(across.dot(p.at - from)) <= std::max(kMostBow * length, kMostBowPx);
  });
}

/// A line along one side that may be the edge of a sheet, or a part of it.
struct EdgePiece {
  int contour = 0;
  Extent extent;
  std::vector<double> depths;  ///< [px] How far it lies from the border, at equal steps along the side.
};
constexpr double kDepthStepPx = 8.0;  // along a side: an edge of a sheet does not change faster

EdgePiece edgePieceOf(int contour, int side, const Contour& line, const Page& page) {
  EdgePiece piece{contour, extentFrom(side, line, page), {}};
  const double length = piece.extent.most.x() - piece.extent.least.x();
  piece.depths.assign(static_cast<int>(length / kDepthStepPx) + 1, 0.0);
  for (const ContourPoint& point : line.points) {
    const Vec2 p = seenFrom(side, point.at, page);
    double& depth = piece.depths[static_cast<int>((p.x() - piece.extent.least.x()) / kDepthStepPx)];
    depth = std::max(depth, p.y());
  }
  // Where no point lies within a step it is as deep as the one before.
  for (std::size_t i = 1; i < piece.depths.size(); ++i)
    if (!(piece.depths[i] > 0.0)) piece.depths[i] = piece.depths[i - 1];
  return piece;
}

/// Where nothing is drawn along an edge.
enum class BlankPart {
  Beyond,    ///< From near the edge to the border of the page.
  BothSides  ///< Near the edge, whatever is beyond.
};

bool isIn(BlankPart part, const EdgePiece& piece, const Contour& other, int side, const Page& page) {
  const double alone = kAlone * page.shorter();
  return std::any_of(other.points.begin(), other.points.end(), [&](const ContourPoint& point) {
    const Vec2 p = seenFrom(side, point.at, page) - Vec2(piece.extent.least.x(), 0.0);
    if (p.x() <= -alone || p.x() >= piece.extent.most.x() - piece.extent.least.x() + alone) return false;
    const double last = static_cast<double>(piece.depths.size()) - 1.0;
    const double inwards = p.y() - piece.depths[static_cast<int>(std::clamp(p.x() / kDepthStepPx, 0.0, last))];
    return inwards < alone && (part == BlankPart::Beyond || inwards > -alone);
  });
}

/// Whether a line is the edge of a sheet that fills the picture, seen or not as a step.
bool isSheetEdge(int side, int index, const std::vector<Contour>& contours, const Page& page) {
  const Contour& line = contours[index];
  const Extent extent = extentFrom(side, line, page);
  const double along = side < 2 ? page.width : page.height;
  if (line.traceMode || extent.most.y() > kNearBorder * page.shorter() ||
      extent.most.x() - extent.least.x() < kLong * along)
    return false;
  const EdgePiece piece = edgePieceOf(index, side, line, page);
  for (int k = 0; k < std::ssize(contours); ++k)
    if (k != index && isIn(BlankPart::Beyond, piece, contours[k], side, page)) return false;
  return true;
}

/// Whether a line lies on another one made longer.
bool liesOnLineOf(const Contour& edge, const Contour& line, const Page& page) {
  const Vec2 from = edge.points.front().at, across = leftNormal((edge.points.back().at - from).normalized());
  return std::all_of(line.points.begin(), line.points.end(), [&](const ContourPoint& p) {
    return std::fabs(across.dot(p.at - from)) < kPart * page.shorter();
  });
}

/// Whether a line lies along a piece of the edge, or goes on where it ends: a part of the edge too.
bool isPartOf(const Contour& edge, const Contour& line, const Page& page) {
  const Vec2 from = edge.points.front().at, chord = edge.points.back().at - from;
  const Vec2 along = chord.normalized();
  const bool isNear = std::all_of(line.points.begin(), line.points.end(), [&](const ContourPoint& p) {
    const double at = along.dot(p.at - from) / chord.norm();
    return at > -kGoesOn && at < 1.0 + kGoesOn;
  });
  return isNear && liesOnLineOf(edge, line, page);
}

/// The lines along one side of a page and which of them are parts of the edge of a sheet.
class SheetEdge {
 public:
  SheetEdge(int side, const std::vector<Contour>& contours, const Page& page)
      : side_(side), contours_(contours), page_(page) {}

  /// @param pieces All with the same step.
  std::vector<bool> partsOf(std::vector<EdgePiece> pieces) const {
    for (;;) {
      std::vector<bool> parts = linesAlong(pieces);
      const auto drawn =
          std::erase_if(pieces, [&](const EdgePiece& e) { return hasLineIn(BlankPart::Beyond, e, parts); });
      if (drawn == 0) return lengthOf(parts) < kLong * (side_ < 2 ? page_.width : page_.height) ? none() : parts;
    }
  }

  /// Which lines are these pieces, or parts of the same edge.
  std::vector<bool> linesAlong(const std::vector<EdgePiece>& pieces) const {
    std::vector<bool> parts = none();
    for (int k = 0; k < std::ssize(contours_); ++k) {
      parts[k] = !contours_[k].traceMode && std::any_of(pieces.begin(), pieces.end(), [&](const EdgePiece& e) {
        return e.contour == k || isPartOf(contours_[e.contour], contours_[k], page_);
      });
    }
    return parts;
  }

  /// [px] Along the side, with what overlaps counted once.
  double lengthOf(const std::vector<bool>& parts) const {
    std::vector<Extent> extents;
    for (int k = 0; k < std::ssize(contours_); ++k)
      if (parts[k]) extents.push_back(extentFrom(side_, contours_[k], page_));
    std::ranges::sort(extents, {}, [](const Extent& extent) { return extent.least.x(); });
    double length = 0.0, end = 0.0;
    for (const Extent& extent : extents) {
      length += std::max(0.0, extent.most.x() - std::max(end, extent.least.x()));
      end = std::max(end, extent.most.x());
    }
    return length;
  }

  /// Whether anything but these lines is drawn where an edge has nothing.
  bool hasLineIn(BlankPart blank, const EdgePiece& piece, const std::vector<bool>& but) const {
    for (int k = 0; k < std::ssize(contours_); ++k)
      if (!but[k] && isIn(blank, piece, contours_[k], side_, page_)) return true;
    return false;
  }

 private:
  std::vector<bool> none() const { return std::vector<bool>(contours_.size(), false); }

  int side_;
  const std::vector<Contour>& contours_;
  Page page_;
};

/// Lines near one side of a page that are as straight as the edge of a sheet.
std::vector<EdgePiece> straightPieces(int side, const std::vector<Contour>& contours, const Page& page) {
  const double along = side < 2 ? page.width : page.height;
  std::vector<EdgePiece> pieces;
  for (int k = 0; k < std::ssize(contours); ++k) {
    const Extent extent = extentFrom(side, contours[k], page);
    const Vec2 size = extent.most - extent.least;
    if (!contours[k].traceMode && extent.most.y() <= kInside * page.shorter() && size.x() >= kPiece * along &&
        size.x() >= kLeastAlong * size.y() && isStraightEdge(contours[k]))
      pieces.push_back(edgePieceOf(k, side, contours[k], page));
  }
  return pieces;
}

/// Finds the gutter of a book along one side, or the edge of a sheet upon another: paper dims towards it, and it runs
/// right across the picture, whatever is drawn beyond. What was drawn does so rarely.
void findGutters(int side, const std::vector<EdgePiece>& straight, const std::vector<Contour>& contours,
                 const GreyImage& grey, std::vector<bool>& isEdge) {
  const Page page(grey);
  const double along = side < 2 ? page.width : page.height, alone = kAlone * page.shorter();
  const SheetEdge edge(side, contours, page);
  for (const EdgePiece& first : straight) {
    if (first.extent.most.x() - first.extent.least.x() < kLong * along) continue;
    std::vector<EdgePiece> pieces;
    std::ranges::copy_if(straight, std::back_inserter(pieces), [&](const EdgePiece& e) {
      return liesOnLineOf(contours[first.contour], contours[e.contour], page);
    });
    double begin = along, end = 0.0;
    for (const EdgePiece& e : pieces)
      begin = std::min(begin, e.extent.least.x()), end = std::max(end, e.extent.most.x());
    std::vector<bool> known = edge.linesAlong(pieces);
    if (begin > alone || end < along - alone || edge.lengthOf(known) < kRightAcross * along) continue;
    if (!dimsTowards(contours[first.contour], grey)) continue;
    for (std::size_t k = 0; k < known.size(); ++k) known[k] = known[k] || isEdge[k];
    const auto isTouched = [&](const EdgePiece& e) { return edge.hasLineIn(BlankPart::BothSides, e, known); };
    if (std::ranges::none_of(pieces, isTouched)) isEdge = known;
  }
}

/// Finds the edges of sheets that are lighter or darker than what lies beyond, along one side.
void findSteps(int side, const std::vector<EdgePiece>& straight, const std::vector<Contour>& contours,
               const GreyImage& grey, std::vector<bool>& isEdge) {
  const Page page(grey);
  std::vector<EdgePiece> brighter, darker;
  for (const EdgePiece& piece : straight) {
    const int step = stepAlong(contours[piece.contour], side, grey);
    if (step != 0) (step > 0 ? brighter : darker).push_back(piece);
  }
  for (std::vector<EdgePiece>* pieces : {&brighter, &darker}) {
    const std::vector<bool> parts = SheetEdge(side, contours, page).partsOf(std::move(*pieces));
    for (std::size_t k = 0; k < parts.size(); ++k) isEdge[k] = isEdge[k] || parts[k];
  }
}

}  // namespace

void dropPageEdgeLines(ContourSet& set, const GreyImage& grey) {
  const Page page(grey);
  std::vector<bool> isEdge(set.contours.size(), false);
  std::array<std::vector<EdgePiece>, 4> straight;
  for (int side = 0; side < 4; ++side) {
    for (int k = 0; k < std::ssize(set.contours); ++k)
      isEdge[k] = isEdge[k] || isSheetEdge(side, k, set.contours, page);
    straight[side] = straightPieces(side, set.contours, page);
    findSteps(side, straight[side], set.contours, grey, isEdge);
  }
  for (int side = 0; side < 4; ++side) findGutters(side, straight[side], set.contours, grey, isEdge);
  if (std::find(isEdge.begin(), isEdge.end(), false) == isEdge.end()) return;
  std::vector<Contour> drawn;
  for (std::size_t k = 0; k < isEdge.size(); ++k)
    (isEdge[k] ? set.sheetEdges : drawn).push_back(std::move(set.contours[k]));
  set.contours = std::move(drawn);
  set.report.droppedMargins += static_cast<int>(std::ssize(set.sheetEdges));
}

}  // namespace batten
