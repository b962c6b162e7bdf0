// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/label/ink_labels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <new>
#include <optional>
#include <unordered_map>

#include "core/contour/centreline/skeleton/skeleton.h"
#include "core/contour/label/broad_lines.h"
#include "core/contour/label/ink_graph.h"
#include "core/contour/label/label_rules.h"
#include "core/contour/label/label_vote.h"
#include "core/image/bits/bit_disc.h"
#include "core/image/bits/bit_steps.h"

namespace batten {
namespace {

constexpr std::size_t kDiscsPerCheck = 256;  // between two looks at the cancel token
constexpr double kWidestPen = 0.05;  // of the page's mean side: 12 mm on A4; bars of lettering and of signs are wider

// Discs of ink about skeleton pixels; those that lie within the one painted before are passed over.
class DiscPainter {
 public:
  explicit DiscPainter(BitImage& image) : image_(image) {}
  void paint(const InkPixel& p) {
    const double radius = static_cast<double>(p.radius);
    if (last_ && (p.centre() - last_->centre).norm() + radius <= last_->radius) return;
    constexpr double kLess = 1e-3;  // [px] the nearest centre of paper lies on the circle
    setDisc(image_, p.centre(), radius - kLess);
    last_ = {p.centre(), radius};
  }

 private:
  struct Disc {
    Vec2 centre;
    double radius;
  };
  BitImage& image_;
  std::optional<Disc> last_;
};

void paintLabels(const InkGraph& graph, InkLabels& labels, const RunContext& context) {
  DiscPainter shapes(labels.shapes), strokes(labels.strokes);
  std::size_t painted = 0;
  const auto paint = [&](const std::vector<InkPixel>& pixels) {
    for (const InkPixel& p : pixels) {
      if (painted++ % kDiscsPerCheck == 0 && context.isCancelled()) return;
      (p.label == InkLabel::Shape ? shapes : strokes).paint(p);
    }
  };
  for (const InkChain& chain : graph.chains()) paint(chain.pixels);
  for (const InkNode& node : graph.nodes()) {
    if (node.isJunction()) paint(node.pixels);
  }
  labels.strokes = without(std::move(labels.strokes), labels.shapes);
}

// Ink of neither goes to the nearer of the two, step by step through the ink. What nothing reaches is a blot.
void shareRest(const BitImage& ink, InkLabels& labels, const RunContext& context) {
  std::vector<SkeletonPixel> front, next;
  const auto touches = [](const BitImage& image, int x, int y) {
    return image.at(x - 1, y) || image.at(x + 1, y) || image.at(x, y - 1) || image.at(x, y + 1);
  };
  BitImage rest = without(without(ink, labels.shapes), labels.strokes);
  for (int y = 0; y < ink.height; ++y) {
    const std::uint64_t* row = rest.row(y);
    for (int i = 0; i < rest.wordsPerRow; ++i) {
      for (std::uint64_t bits = row[i]; bits != 0; bits &= bits - 1) {
        const int x = i * 64 + std::countr_zero(bits);
        if (touches(labels.shapes, x, y) || touches(labels.strokes, x, y)) front.push_back({x, y});
      }
    }
  }
  while (!front.empty() && !context.isCancelled()) {
    std::vector<bool> isShape;
    isShape.reserve(front.size());
    for (const SkeletonPixel& p : front) isShape.push_back(touches(labels.shapes, p.x, p.y));
    for (std::size_t i = 0; i < front.size(); ++i) {
      (isShape[i] ? labels.shapes : labels.strokes).set(front[i].x, front[i].y, true);
      rest.set(front[i].x, front[i].y, false);
    }
    next.clear();
    for (const SkeletonPixel& p : front) {
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        if (!rest.at(p.x + dx, p.y + dy)) continue;
        rest.set(p.x + dx, p.y + dy, false);
        next.push_back({p.x + dx, p.y + dy});
      }
    }
    front.swap(next);
  }
  labels.shapes = either(std::move(labels.shapes), rest);
}

void applyVotes(const RunPieces& runs, const PiecesOfPage& page, const std::vector<PieceVote>& votes,
                InkLabels& labels) {
  std::unordered_map<int, InkLabel> decided;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (votes[i].decision) decided.emplace(page.pieces[i].firstRun, *votes[i].decision);
  }
  for (std::size_t i = 0; i < runs.runs.size(); ++i) {
    const auto found = decided.find(runs.piece[i]);
    if (found == decided.end()) continue;
    const bool isShape = found->second == InkLabel::Shape;
    setBits(isShape ? labels.shapes : labels.strokes, runs.runs[i]);
    clearBits(isShape ? labels.strokes : labels.shapes, runs.runs[i]);
  }
}

// A stroke that runs into a shape.
struct StrokeInto {
  double widthPx;  ///< Where it leaves the shape.
  int path;
};

// What is known of one connected shape.
struct ShapeRegion {
  std::int64_t areaPx = 0;
  double largestRadiusPx = 0.0;
  int mouths = 0;                           ///< Places where strokes run into it.
  std::vector<StrokeInto> strokesInto;      ///< These strokes.
  std::int64_t borderPx = 0, mouthsPx = 0;  ///< Pixels around it; those of them that are strokes.
  double widthPx() const { return 2.0 * largestRadiusPx - kRadiiBeyondWidthPx; }
};

std::optional<int> pieceBeside(const RunPieces& pieces, const SkeletonPixel& p) {
  for (const auto& [dx, dy] : {std::pair{-1, 0}, {0, -1}, {0, 1}, {-1, -1}, {-1, 1}, {1, -1}, {1, 1}, {1, 0}}) {
    if (const auto piece = pieceAt(pieces, p.x + dx, p.y + dy)) return piece;
  }
  return std::nullopt;
}

std::unordered_map<int, ShapeRegion> measureShapes(const InkGraph& graph, const RunPieces& shapes,
                                                   const RunPieces& mouths) {
  std::unordered_map<int, ShapeRegion> regions;
  for (std::size_t i = 0; i < shapes.runs.size(); ++i)
    regions[shapes.piece[i]].areaPx += shapes.runs[i].x1 - shapes.runs[i].x0;
  const auto addPixels = [&](const std::vector<InkPixel>& pixels) {
    for (const InkPixel& p : pixels) {
      const auto piece = pieceAt(shapes, p.x, p.y);
      if (!piece) continue;
      double& largest = regions[*piece].largestRadiusPx;
      largest = std::max(largest, static_cast<double>(p.radius));
    }
  };
  for (const InkChain& chain : graph.chains()) addPixels(chain.pixels);
  for (const InkNode& node : graph.nodes()) addPixels(node.pixels);
  for (std::size_t i = 0; i < mouths.runs.size(); ++i) {
    if (mouths.piece[i] != static_cast<int>(i)) continue;
    const InkRun& run = mouths.runs[i];
    if (const auto piece = pieceBeside(shapes, {run.x0, run.y})) ++regions[*piece].mouths;
  }
  return regions;
}

// The widths of the strokes that run into each shape, where their middles leave it.
void measureStrokesInto(std::unordered_map<int, ShapeRegion>& regions, const InkGraph& graph, const BitImage& ink,
                        const RunPieces& shapes) {
  const auto leaves = [&](int number, const InkPixel& inside, const InkPixel& outside) {
    if (!ink.at(inside.x, inside.y) || ink.at(outside.x, outside.y)) return;
    if (const auto piece = pieceAt(shapes, inside.x, inside.y))
      regions[*piece].strokesInto.push_back({outside.widthPx(), number});
  };
  for (const InkChain& chain : graph.chains()) {
    if (!chain.isAlive) continue;
    for (std::size_t i = 0; i + 1 < chain.pixels.size(); ++i) {
      leaves(*chain.path, chain.pixels[i], chain.pixels[i + 1]);
      leaves(*chain.path, chain.pixels[i + 1], chain.pixels[i]);
    }
    for (int side = 0; side < 2 && !chain.pixels.empty(); ++side) {
      if (!chain.node[side]) continue;
      for (const InkPixel& p : graph.nodes()[*chain.node[side]].pixels) {
        const InkPixel& end = side == 0 ? chain.pixels.front() : chain.pixels.back();
        if (std::max(std::abs(p.x - end.x), std::abs(p.y - end.y)) <= 1) leaves(*chain.path, p, end);
      }
    }
  }
}

// How much of its border each shape shares with strokes.
void measureMouths(std::unordered_map<int, ShapeRegion>& regions, const RunPieces& shapes, const BitImage& border,
                   const BitImage& mouths) {
  for (int y = 0; y < border.height; ++y) {
    const std::uint64_t* row = border.row(y);
    for (int i = 0; i < border.wordsPerRow; ++i) {
      for (std::uint64_t bits = row[i]; bits != 0; bits &= bits - 1) {
        const SkeletonPixel p{i * 64 + std::countr_zero(bits), y};
        const auto piece = pieceBeside(shapes, p);
        if (!piece) continue;
        ++regions[*piece].borderPx;
        if (mouths.at(p.x, p.y)) ++regions[*piece].mouthsPx;
      }
    }
  }
}

// Whether lines run into a shape without a step in width and cover far more than it does: a line that swells.
bool isSwelling(const ShapeRegion& r, const InkGraph& graph, double widestPenPx) {
  constexpr double kStep = 1.5;  // of widths; more is the edge of a shape
  constexpr double kLine = 3.0;  // of the area of the shape: strokes that fill one cover no more
  const double shapePx = r.widthPx();
  if (r.mouths < 2 || shapePx <= 0.0 || shapePx > widestPenPx) return false;
  double covered = 0.0;
  std::vector<int> counted;
  for (const auto& [widthPx, number] : r.strokesInto) {
    const InkPath& path = graph.paths()[number];
    const bool isCounted = std::find(counted.begin(), counted.end(), number) != counted.end();
    if (isCounted || path.elongation() < kStrokeWidths || shapePx > kStep * widthPx + 1.0) continue;
    covered += path.lengthPx * *path.widthPx;
    counted.push_back(number);
  }
  return covered >= kLine * static_cast<double>(r.areaPx);
}

// [px] On a page of several pens, that of the lines that meet in a knot; no less than the page's.
double penAt(const ShapeRegion& r, const InkGraph& graph, double penPx) {
  constexpr double kKnotArea = 3.0;  // in squared widths; what is longer than a knot may be a filled ribbon or bar
  if (static_cast<double>(r.areaPx) >= kKnotArea * r.widthPx() * r.widthPx()) return penPx;
  constexpr double kLineWidths = 8.0;  // shorter ones may be lobes, bars and the grain of a tone
  std::vector<std::pair<double, double>> widths;
  for (const StrokeInto& s : r.strokesInto) {
    const InkPath& path = graph.paths()[s.path];
    if (path.elongation() >= kLineWidths) widths.emplace_back(*path.widthPx, path.elongation());
  }
  if (widths.size() < 2) return penPx;
  return std::max(penPx, weightedMedian(std::move(widths)).value_or(0.0));
}

// Where strokes lie over one another there is no solid: see labelInk.
void releaseBundles(const InkGraph& graph, const PiecesOfPage& page, double mergeWidths, InkLabels& labels,
                    const RunContext& context) {
  constexpr double kBundlePens = 5.0;  // a bundle is no wider
  // Area by the square of the width: of what is long where two strokes come out of an end, or one out of each.
  constexpr double kLong = 1.3, kLongBetweenTwo = kStrokeWidths;
  constexpr double kKnotPens = 4.0;    // what six strokes hold that cross in one point
  constexpr double kMouthShare = 0.5;  // of its border: most of what surrounds a dot is paper
  if (!labels.penPx || labels.shapes.count() == 0) return;
  const double penPx = *labels.penPx;
  const RunPieces shapes = findPieces(labels.shapes, Connectivity::Eight, context);
  const BitImage border = without(grown(labels.shapes, 1, context), labels.shapes);
  const BitImage rim = both(border, labels.strokes);
  const RunPieces mouths = findPieces(rim, Connectivity::Eight, context);
  if (context.isCancelled()) return;
  auto regions = measureShapes(graph, shapes, mouths);
  measureMouths(regions, shapes, border, rim);
  measureStrokesInto(regions, graph, labels.shapes, shapes);
  const auto isBundle = [&](const ShapeRegion& r) {
    const double width = r.widthPx();
    if (r.mouths == 0 || width <= 0.0) return false;
    if (mergeWidths > 0.0 && width <= (mergeWidths + 1.0) * penPx + 1.0) return true;
    const double pen = penAt(r, graph, penPx);
    if (r.mouths < 2 || width > std::min(kBundlePens * pen + 1.0, page.widestPenPx)) return false;
    const bool isKnot = static_cast<double>(r.mouthsPx) >= kMouthShare * static_cast<double>(r.borderPx);
    if (isKnot && width <= kKnotPens * pen + 1.0) return true;
    return static_cast<double>(r.areaPx) >= (r.mouths > 2 ? kLong : kLongBetweenTwo) * width * width;
  };
  BitImage& swellings = labels.swellings.emplace(labels.shapes.width, labels.shapes.height);
  for (std::size_t i = 0; i < shapes.runs.size(); ++i) {
    const ShapeRegion& region = regions.at(shapes.piece[i]);
    const bool swells = isSwelling(region, graph, page.widestPenPx);
    if (!swells && !isBundle(region)) continue;
    if (swells) setBits(swellings, shapes.runs[i]);
    setBits(labels.strokes, shapes.runs[i]);
    clearBits(labels.shapes, shapes.runs[i]);
  }
}

// [px] median width of the strokes, weighed by their lengths in widths; absent: there is none.
std::optional<double> penOfStrokes(const InkGraph& graph) {
  std::vector<std::pair<double, double>> widths;
  for (const InkPath& s : graph.paths()) {
    if (s.label == InkLabel::Stroke && s.elongation() >= kStrokeWidths) widths.emplace_back(*s.widthPx, s.elongation());
  }
  return weightedMedian(std::move(widths));
}

Result<InkLabels> label(const BitImage& ink, double mergeWidths, double pixelsPerPx, const RunContext& context) {
  InkLabels labels{BitImage(ink.width, ink.height), BitImage(ink.width, ink.height), ink};
  if (!thinToSkeleton(labels.skeleton, context)) return cancelled();
  InkGraph graph(labels.skeleton, ink, context);
  const RunPieces runs = findPieces(ink, Connectivity::Eight, context);
  if (context.isCancelled()) return cancelled();
  PiecesOfPage page = measurePieces(graph, runs);
  page.widestPenPx = kWidestPen * std::sqrt(static_cast<double>(ink.width) * ink.height);
  labelPaths(graph, page);
  labels.penPx = penOfStrokes(graph);
  paintLabels(graph, labels, context);
  shareRest(ink, labels, context);
  if (labels.penPx && releaseBroadLines(graph, *labels.penPx, page.widestPenPx, labels.shapes)) {
    labels.strokes = labels.shapes = BitImage(ink.width, ink.height);
    paintLabels(graph, labels, context);
    shareRest(ink, labels, context);
  }
  releaseBundles(graph, page, mergeWidths, labels, context);
  if (context.isCancelled()) return cancelled();
  std::unordered_map<int, std::int64_t> shapeArea;
  for (std::size_t i = 0; i < runs.runs.size(); ++i) shapeArea[runs.piece[i]] += countBits(labels.shapes, runs.runs[i]);
  std::vector<PieceVote> votes;
  for (const LabelledPiece& piece : page.pieces)
    votes.push_back({2 * shapeArea[piece.firstRun] > piece.areaPx, std::nullopt});
  voteAmongAlike(votes, graph, page, std::hypot(ink.width, ink.height), pixelsPerPx);
  applyVotes(runs, page, votes, labels);
  if (labels.strokes.count() == 0) labels.penPx.reset();  // crumbs beside shapes that went with them
  return labels;
}

}  // namespace

Result<InkLabels> labelInk(const BitImage& ink, const RunContext& context, double mergeWidths, double pixelsPerPx) {
  if (ink.width <= 0 || ink.height <= 0) return InkLabels{};
  try {
    return label(ink, mergeWidths, pixelsPerPx, context);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to tell strokes from shapes.");
  }
}

}  // namespace batten
