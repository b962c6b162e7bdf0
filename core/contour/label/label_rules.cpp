// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/label/label_rules.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

namespace batten {
namespace {

constexpr double kUneven = 0.15;  // share of its area that one width may leave unexplained
// A path so many pens wide and no longer than so many of its own widths is a bar among thin strokes.
constexpr double kBarWidths = 2.5, kShortWidths = 8.0;
// A path so many pens wide is a filled ribbon if hardly any of its piece is as wide: a second pen draws more than that.
constexpr double kRibbonWidths = 6.0, kRibbonShare = 0.25;
constexpr double kOwnPen = 10.0;      // widths of paths that show the pen of a piece
constexpr double kLimbWidths = 12.0;  // shorter paths that hang on a shape may be its limbs
constexpr double kSamePen = 1.5;      // ratio of widths
// Of the area of a piece, what strokes of one width each explain where it is lettering of a broad pen, and where it is
// strokes of the page's pen at all.
constexpr double kExplainedBroad = 0.75, kExplainedAny = 0.25;
constexpr double kBroadWidths = 2.0;       // paths of a broad pen that are longer count as strokes of it
constexpr double kLetterStroke = 10.0;     // strokes of filled letters are shorter
constexpr double kBroadLineWidths = 25.0;  // a longer one is a line that a broad pen drew, whatever is joined to it

bool isExplained(const InkPath& s) { return s.elongation() >= kStrokeWidths && s.unevenness <= kUneven; }

std::vector<LabelledPiece> boxesOf(const RunPieces& runs, std::unordered_map<int, int>& number) {
  std::vector<LabelledPiece> pieces;
  for (std::size_t i = 0; i < runs.runs.size(); ++i) {
    const InkRun& r = runs.runs[i];
    const auto [it, isNew] = number.try_emplace(runs.piece[i], static_cast<int>(pieces.size()));
    if (isNew) {
      pieces.emplace_back();
      pieces.back().firstRun = runs.piece[i];
      pieces.back().x0 = r.x0;
      pieces.back().y0 = r.y;
    }
    LabelledPiece& piece = pieces[it->second];
    piece.areaPx += r.x1 - r.x0;
    piece.x0 = std::min(piece.x0, r.x0);
    piece.x1 = std::max(piece.x1, r.x1);
    piece.y1 = r.y + 1;
  }
  return pieces;
}

enum class PenWeight { Length, Elongation };

double penOf(const LabelledPiece& piece, const InkGraph& graph, std::optional<double> pagePen, PenWeight weight) {
  std::vector<std::pair<double, double>> own;
  for (const int number : piece.paths) {
    const InkPath& s = graph.paths()[number];
    if (s.elongation() < kStrokeWidths) continue;
    own.emplace_back(*s.widthPx, weight == PenWeight::Length ? s.lengthPx : s.elongation());
  }
  const std::optional<double> pen = weightedMedian(own);
  if (!pen) return std::max(1.0, pagePen.value_or(1.0));
  return piece.strokesPx >= kOwnPen * *pen || !pagePen ? *pen : std::min(*pen, *pagePen);
}

// Labels in one pass over the paths of a page; see labelPaths.
class Labeller {
 public:
  Labeller(InkGraph& graph, const PiecesOfPage& page)
      : graph_(graph), page_(page), penOf_(graph.paths().size()), isRibbon_(graph.paths().size(), false) {
    for (const LabelledPiece& piece : page.pieces) {
      for (const int path : piece.paths) penOf_[path] = piece.penPx;
      noteRibbons(piece);
    }
  }

  void label() {
    for (std::size_t i = 0; i < penOf_.size(); ++i) {
      const InkPath& s = graph_.paths()[i];
      const bool isBar = s.widthPx && *s.widthPx >= kBarWidths * penOf_[i] && s.elongation() < kShortWidths;
      explained_.push_back(isExplained(s) && !isBar && !isRibbon_[i]);
    }
    for (std::size_t i = 0; i < penOf_.size(); ++i) {
      InkPath& s = graph_.paths()[i];
      // Where strokes lie over one another an unexplained path swells; a solid is wide along most of its length.
      const bool isWide = s.widthPx && *s.widthPx > coreWidth(widestStrokeAt(static_cast<int>(i)));
      s.label = !explained_[i] && isWide ? InkLabel::Shape : InkLabel::Stroke;
    }
    labelJunctions();
    labelPixels();
    for (std::size_t i = 0; i < penOf_.size(); ++i) {
      if (graph_.paths()[i].widthPx.value_or(0.0) > page_.widestPenPx) labelWhole(static_cast<int>(i));
    }
    absorbLimbs();
    for (const LabelledPiece& piece : page_.pieces) {
      if (piece.isBlot || isUnexplained(piece)) labelWhole(piece);
    }
    labelWithinJunctions();
  }

 private:
  void noteRibbons(const LabelledPiece& piece) {
    const double least = kRibbonWidths * piece.penPx;
    std::vector<int> broad;
    double broadPx = 0.0;
    for (const int number : piece.paths) {
      const InkPath& s = graph_.paths()[number];
      if (!s.widthPx || *s.widthPx < least) continue;
      broad.push_back(number);
      broadPx += s.elongation() >= kStrokeWidths ? s.lengthPx : 0.0;
    }
    if (broadPx > kRibbonShare * piece.strokesPx) return;
    for (const int number : broad) isRibbon_[number] = true;
  }

  // [px] of the pen of a junction's piece, or of the widest stroke that meets there.
  double widestStrokeAt(const InkNode& node) const {
    double width = 0.0;
    for (const int end : node.ends) {
      const int path = *graph_.chains()[end / 2].path;
      width = std::max(width, explained_[path] ? *graph_.paths()[path].widthPx : penOf_[path]);
    }
    return width;
  }
  double widestStrokeAt(int path) const {
    double width = penOf_[path];
    for (const int number : graph_.paths()[path].chains) {
      for (const std::optional<int> node : graph_.chains()[number].node) {
        if (node && graph_.nodes()[*node].isJunction()) width = std::max(width, widestStrokeAt(graph_.nodes()[*node]));
      }
    }
    return width;
  }

  void labelJunctions() {
    for (InkNode& node : graph_.nodes()) {
      if (!node.isJunction()) continue;
      const double pen = std::max(penOf_[*graph_.chains()[node.ends.front() / 2].path], widestStrokeAt(node));
      if (node.widthPx() > coreWidth(pen)) node.label = InkLabel::Shape;
    }
  }

  void labelPixels() {
    for (InkChain& chain : graph_.chains()) {
      if (!chain.isAlive) continue;
      const InkPath& s = graph_.paths()[*chain.path];
      for (InkPixel& p : chain.pixels) {
        if (!p.inJunction) p.label = s.label;
      }
    }
  }

  // Lines of this width that a pen drew: they do not hang on a shape, or are too long to be a limb of it.
  struct Line {
    double widthPx = 0.0, lengthPx = 0.0;
  };

  bool isShape(int path) const { return graph_.paths()[path].label == InkLabel::Shape; }

  // More of the piece is shape than stroke.
  bool isSolid(const LabelledPiece& piece) const {
    double strokes = 0.0;
    for (const int path : piece.paths) {
      const InkPath& s = graph_.paths()[path];
      if (!isShape(path) && s.widthPx) strokes += s.lengthPx * *s.widthPx;
    }
    return 2.0 * strokes < static_cast<double>(piece.areaPx);
  }

  // A leg of an animal, a serif: of even width, but no line that a pen drew. Lines of that width elsewhere say
  // otherwise.
  void absorbLimbs() {
    std::vector<int> limbs;
    std::vector<Line> lines;
    for (const LabelledPiece& piece : page_.pieces) {
      const bool solid = isSolid(piece);
      for (const int path : piece.paths) {
        const InkPath& s = graph_.paths()[path];
        if (isShape(path) || !s.widthPx) continue;
        if (solid && s.elongation() < kLimbWidths) {
          limbs.push_back(path);
        } else if (explained_[path]) {
          lines.push_back({*s.widthPx, s.lengthPx});
        }
      }
    }
    for (const int limb : limbs) {
      const double width = *graph_.paths()[limb].widthPx;
      double length = 0.0;
      for (const Line& line : lines) {
        const double ratio = std::max(line.widthPx, width) / std::min(line.widthPx, width);
        if (ratio <= kSamePen + 1.0 / std::min(line.widthPx, width)) length += line.lengthPx;
      }
      if (length < kOwnPen * width) labelWhole(limb);
    }
    for (const LabelledPiece& piece : page_.pieces) {
      const bool anyLine = std::any_of(piece.paths.begin(), piece.paths.end(),
                                       [&](int path) { return explained_[path] && !isShape(path); });
      if (!anyLine && isSolid(piece)) labelWhole(piece);
    }
  }

  // A filled letter or mark: wider than lines of the page's pen where they cross, and either all of it is and no stroke
  // is long, or redrawn with strokes of one width each much of its ink would be missing.
  bool isUnexplained(const LabelledPiece& piece) const {
    if (!page_.pagePenPx) return false;
    const double broadPx = coreWidth(*page_.pagePenPx);
    if (piece.widestPx() <= broadPx) return false;
    const bool isBroad = piece.penPx > broadPx;
    double redrawn = 0.0, longest = 0.0;
    for (const int number : piece.paths) {
      const InkPath& s = graph_.paths()[number];
      if (isShape(number) && !isBroad) return false;
      if (isShape(number) || !s.widthPx) continue;
      if (explained_[number]) longest = std::max(longest, s.elongation());
      const bool isLine = explained_[number] || s.elongation() >= (isBroad ? kBroadWidths : kShortWidths) ||
                          *s.widthPx <= kSamePen * *page_.pagePenPx + 1.0;
      redrawn += isLine ? s.lengthPx * *s.widthPx : 0.0;
    }
    if (isBroad && longest < kLetterStroke) return true;
    if (longest >= kBroadLineWidths) return false;
    return redrawn < (isBroad ? kExplainedBroad : kExplainedAny) * static_cast<double>(piece.areaPx);
  }

  void labelWhole(int path) {
    graph_.paths()[path].label = InkLabel::Shape;
    for (const int number : graph_.paths()[path].chains) {
      for (InkPixel& p : graph_.chains()[number].pixels) p.label = InkLabel::Shape;
      for (const std::optional<int> node : graph_.chains()[number].node) {
        if (node) joinShape(graph_.nodes()[*node]);
      }
    }
  }
  void labelWhole(const LabelledPiece& piece) {
    for (const int path : piece.paths) labelWhole(path);
  }
  // A junction is a shape where all paths that meet there are.
  void joinShape(InkNode& node) {
    for (const int end : node.ends) {
      if (graph_.paths()[*graph_.chains()[end / 2].path].label != InkLabel::Shape) return;
    }
    node.label = InkLabel::Shape;
  }

  // What lies within the disc of a junction goes with it.
  void labelWithinJunctions() {
    for (InkChain& chain : graph_.chains()) {
      if (!chain.isAlive) continue;
      for (const std::optional<int> number : chain.node) {
        if (!number || graph_.nodes()[*number].label != InkLabel::Shape) continue;
        const InkNode& node = graph_.nodes()[*number];
        for (InkPixel& p : chain.pixels) {
          if (p.inJunction && (p.centre() - node.centre).norm() < node.radius) p.label = InkLabel::Shape;
        }
      }
    }
    for (InkNode& node : graph_.nodes()) {
      if (node.label != InkLabel::Shape) continue;
      for (InkPixel& p : node.pixels) p.label = InkLabel::Shape;
    }
  }

  InkGraph& graph_;
  const PiecesOfPage& page_;
  std::vector<double> penOf_;  ///< Of each path.
  std::vector<bool> isRibbon_;
  std::vector<bool> explained_;
};

}  // namespace

std::optional<double> weightedMedian(std::vector<std::pair<double, double>> valueAndWeight) {
  std::sort(valueAndWeight.begin(), valueAndWeight.end());
  double all = 0.0, sum = 0.0;
  for (const auto& [value, weight] : valueAndWeight) all += weight;
  for (const auto& [value, weight] : valueAndWeight) {
    sum += weight;
    if (2.0 * sum >= all) return value;
  }
  return std::nullopt;
}

PiecesOfPage measurePieces(const InkGraph& graph, const RunPieces& runs) {
  PiecesOfPage page;
  std::unordered_map<int, int> number;
  page.pieces = boxesOf(runs, number);
  std::vector<std::pair<double, double>> byLength, byElongation;
  for (int i = 0; i < static_cast<int>(graph.paths().size()); ++i) {
    const InkPath& s = graph.paths()[i];
    const InkPixel& first = graph.chains()[s.chains.front()].pixels.front();
    LabelledPiece& piece = page.pieces[number.at(*pieceAt(runs, first.x, first.y))];
    piece.paths.push_back(i);
    for (const int chain : s.chains) {
      for (const InkPixel& p : graph.chains()[chain].pixels) {
        piece.largestRadiusPx = std::max(piece.largestRadiusPx, static_cast<double>(p.radius));
      }
    }
    if (s.elongation() < kStrokeWidths) continue;
    piece.strokesPx += s.lengthPx;
    byLength.emplace_back(*s.widthPx, s.lengthPx);
    byElongation.emplace_back(*s.widthPx, s.elongation());
  }
  page.pagePenPx = weightedMedian(std::move(byElongation));
  const std::optional<double> mainPen = weightedMedian(std::move(byLength));
  for (LabelledPiece& piece : page.pieces) {
    piece.isBlot = piece.strokesPx <= 0.0;
    piece.penPx = penOf(piece, graph, page.pagePenPx, PenWeight::Elongation);
    piece.mainPenPx = penOf(piece, graph, mainPen, PenWeight::Length);
  }
  return page;
}

void labelPaths(InkGraph& graph, const PiecesOfPage& page) { Labeller(graph, page).label(); }

}  // namespace batten
