// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/ink_split.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/contour/centreline/centreline.h"
#include "core/contour/centreline/junction/find_stroke_paths.h"
#include "core/contour/centreline/pencil/grain_closing.h"
#include "core/contour/centreline/pencil/graininess.h"
#include "core/contour/centreline/pencil/lettering.h"
#include "core/contour/centreline/pencil/stroke_split.h"
#include "core/contour/chosen_ink.h"
#include "core/contour/ink/painted_ink.h"
#include "core/contour/ink/pencil_solids.h"
#include "core/contour/ink/row_vote.h"
#include "core/contour/label/ink_labels.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/fine_page.h"
#include "core/image/narrow_paper.h"

namespace batten {
namespace {

// Lengths by what they were drawn with.
struct Drawn {
  double pencil = 0.0, pen = 0.0;
  bool isPencil() const { return pencil > pen; }
};

// Whether each piece of ink was drawn with a pencil; what is too small to tell goes with the page.
class PencilPieces {
 public:
  PencilPieces(const BitImage& ink, const std::vector<StrokePath>& paths, const GraininessMap& grain,
               const RunContext& context)
      : pieces_(findPieces(ink, Connectivity::Eight, context)) {
    for (int i = 0; i < static_cast<int>(paths.size()); ++i) {
      const double length = paths[i].length();
      const std::optional<int> piece = pieceOf(paths[i]);
      for (Drawn* drawn : {&page_, piece ? &byPiece_[*piece] : nullptr}) {
        if (drawn != nullptr) (grain.isPencil(i) ? drawn->pencil : drawn->pen) += length;
      }
    }
  }
  const RunPieces& pieces() const { return pieces_; }
  bool isPencil(int piece) const {
    const auto found = byPiece_.find(piece);
    return found == byPiece_.end() ? page_.isPencil() : found->second.isPencil();
  }
  bool any() const { return page_.pencil > 0.0; }
  std::optional<int> pieceOf(const StrokePath& path) const { return pieceOfPath(pieces_, path); }

 private:
  RunPieces pieces_;
  Drawn page_;
  std::map<int, Drawn> byPiece_;
};

void move(const BitImage& ink, const InkRun& run, bool isShape, InkSplit& split) {
  clearBits(isShape ? split.strokes : split.shapes, run);
  copyBits(ink, run, isShape ? split.shapes : split.strokes);
}

RunPieces regionsOf(const InkSplit& split, const RunContext& context) {
  struct Marked {
    InkRun run;
    std::pair<int, int> region;  // of which picture, and its piece there
  };
  std::vector<Marked> marked;
  int kind = 0;
  const auto mark = [&](const BitImage& ink) {
    const RunPieces pieces = findPieces(ink, Connectivity::Eight, context);
    for (std::size_t i = 0; i < pieces.runs.size(); ++i) marked.push_back({pieces.runs[i], {kind, pieces.piece[i]}});
    ++kind;
  };
  for (const BitImage* ink : {&split.strokes, &split.shapes}) {
    if (context.isCancelled()) return {};
    if (!split.painted) {
      mark(*ink);
    } else {
      mark(without(BitImage(*ink), *split.painted));
      mark(both(*ink, *split.painted));
    }
  }
  std::sort(marked.begin(), marked.end(), [](const Marked& a, const Marked& b) {
    return a.run.y != b.run.y ? a.run.y < b.run.y : a.run.x0 < b.run.x0;
  });
  RunPieces regions;
  if (context.isCancelled()) return regions;
  std::map<std::pair<int, int>, int> first;
  for (const Marked& m : marked) {
    regions.piece.push_back(first.try_emplace(m.region, static_cast<int>(regions.runs.size())).first->second);
    regions.runs.push_back(m.run);
  }
  return regions;
}

Result<BitImage> withGrainClosed(const BitImage& pencil, double widthPx, bool isFinePage, const RunContext& context) {
  try {
    return closeGrain(pencil, widthPx, isFinePage, context);
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to tell strokes from shapes.", e.what());
  }
}

// The ink without what a pencil drew.
BitImage penInk(const BitImage& ink, const PencilPieces& pencil) {
  BitImage pen = ink;
  const RunPieces& pieces = pencil.pieces();
  for (std::size_t i = 0; i < pieces.runs.size(); ++i)
    if (pencil.isPencil(pieces.piece[i])) clearBits(pen, pieces.runs[i]);
  return pen;
}

// Of what a pencil drew, the paper within pieces no larger than a line of lettering, and within lettering that which
// the closing of its grain fills; absent: there is none.
std::optional<BitImage> paperInLettering(const BitImage& pencil, const BitImage& closed, const GreyImage& grey,
                                         const PaperBackground& sheet, double penPx, const RunContext& context) {
  const BitImage large = keepPieces(pencil, {.minDiagonal = kLongestLettering * penPx}, context);
  BitImage small = without(BitImage(pencil), large);
  const RunPieces pieces = findPieces(closed, Connectivity::Eight, context);
  if (const auto letters = letteringOf(pieces, closed, penPx, kPencilLetters))
    small = either(std::move(small), *letters);
  BitImage paper = clearPaper(small, grey, sheet, penPx, context);
  return paper.count() > 0 ? std::optional(std::move(paper)) : std::nullopt;
}

// Paper that ink has closed: what the sheet is, by which it is found, or that which was.
struct PaperInInk {
  const PaperBackground* sheet = nullptr;  // absent: none is looked for
  std::optional<BitImage> clear = {};      // InkSplit::clear
};

struct OpenedInk {
  BitImage ink;
  std::optional<BitImage> clear;  // InkSplit::clear
};

// Ink that a pencil helped to draw, by what drew it.
struct PencilClosing {
  BitImage pens;    // what pens drew, as it is
  BitImage closed;  // what the pencil drew, its grain closed
};

// The ink with the paper open again that strokes which have run together, or lettering, have closed; absent: there is
// none. @param pieces of the ink. @param pencil absent: pens drew all of it.
std::optional<OpenedInk> withPaperOpened(const BitImage& ink, const RunPieces& pieces, const GreyImage& grey,
                                         const InkSplit& split, const std::optional<PencilClosing>& pencil,
                                         const PaperBackground& sheet, const RunContext& context) {
  const BitImage& pens = pencil ? pencil->pens : ink;
  BitImage strokes = both(BitImage(pens), split.strokes);
  std::optional<BitImage> letters = letteringOf(pieces, ink, *split.penPx, kPenLetters);
  if (letters) {
    letters = both(std::move(*letters), pens);
    strokes = without(std::move(strokes), *letters);
  }
  BitImage open = withoutClosedPaper(strokes, grey, sheet, *split.penPx, context);
  if (letters) {
    strokes = either(std::move(strokes), *letters);
    open = either(std::move(open),
                  withoutClosedPaper(std::move(*letters), grey, sheet, *split.penPx, context, PaperBetween::Letters));
  }
  OpenedInk opened;
  if (pencil) {
    const BitImage ofPencil = without(BitImage(ink), pencil->pens);
    opened.clear = paperInLettering(ofPencil, pencil->closed, grey, sheet, *split.penPx, context);
  }
  if (context.isCancelled() || (open == strokes && !opened.clear)) return std::nullopt;
  opened.ink = either(without(BitImage(ink), strokes), open);
  if (opened.clear) opened.ink = without(std::move(opened.ink), *opened.clear);
  return opened;
}

// [px] Length of a path that lies in the strokes; 0 unless it is long and of one width. Paths through grain and shading
// are not.
double lineOn(const BitImage& strokes, const StrokePath& path, double penPx) {
  constexpr double kLongLine = 12.0;   // [pens]
  constexpr double kMostUneven = 0.3;  // of its width, in the mean
  if (path.length() < kLongLine * penPx) return 0.0;
  const double widthPx = path.widthPx();
  double uneven = 0.0;
  int inStrokes = 0;
  for (const StrokePathPoint& p : path.points) {
    uneven += std::abs(2.0 * static_cast<double>(p.radius) - widthPx);
    inStrokes += strokes.at(static_cast<int>(p.at.x()), static_cast<int>(p.at.y())) ? 1 : 0;
  }
  const auto count = static_cast<double>(path.points.size());
  return uneven <= kMostUneven * widthPx * count ? path.length() * inStrokes / count : 0.0;
}

// For the first run of every piece, whether many lines are part of it, whatever they are joined to.
std::vector<bool> linedPieces(const PencilPieces& pencil, const InkSplit& split) {
  constexpr double kManyPens = 20.0;    // [pens] of length
  constexpr double kLeastLined = 0.15;  // of all that is no solid: grain and shading hold a few lines, too
  const RunPieces& pieces = pencil.pieces();
  std::vector<bool> isLined(pieces.runs.size(), false);
  if (!split.penPx) return isLined;
  const double penPx = *split.penPx;
  std::vector<double> linesPx(pieces.runs.size(), 0.0);
  std::vector<std::int64_t> strokesPx2(pieces.runs.size(), 0);
  for (const StrokePath& path : split.known->paths)
    if (const auto piece = pencil.pieceOf(path)) linesPx[*piece] += lineOn(split.strokes, path, penPx);
  for (std::size_t i = 0; i < pieces.runs.size(); ++i)
    strokesPx2[pieces.piece[i]] += countBits(split.strokes, pieces.runs[i]);
  for (std::size_t i = 0; i < pieces.runs.size(); ++i)
    isLined[i] =
        linesPx[i] >= kManyPens * penPx && linesPx[i] * penPx >= kLeastLined * static_cast<double>(strokesPx2[i]);
  return isLined;
}

// Moves what a pencil drew to the strokes or to the shapes, whole pieces at a time: to the strokes, too, where many
// lines are joined to something solid, which pencilSolids() tells from them. @return its ink.
BitImage movePencil(const BitImage& ink, const PencilPieces& pencil, const StrokeSplit& byPiece, InkSplit& split) {
  const std::vector<bool> isLined = linedPieces(pencil, split);
  const RunPieces& pieces = pencil.pieces();
  BitImage drawn(ink.width, ink.height);
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    if (!pencil.isPencil(pieces.piece[i])) continue;
    setBits(drawn, pieces.runs[i]);
    const bool isShape = byPiece.shapes.at(pieces.runs[i].x0, pieces.runs[i].y) && !isLined[pieces.piece[i]];
    move(ink, pieces.runs[i], isShape, split);
  }
  return drawn;
}

Result<InkSplit> splitByLabel(const BitImage& ink, const GreyImage& grey, const EdgeParams& params,
                              const GreyImage* page, PaperInInk paper, const RunContext& context) {
  const double pixelsPerPx = page != nullptr ? kFineFactor : 1.0;
  Result<InkLabels> labels = labelInk(ink, context, params.mergeWidths, pixelsPerPx);
  if (!labels) return fail(labels.error());
  InkSplit split;
  split.strokes = std::move(labels->strokes);
  split.shapes = std::move(labels->shapes);
  split.swellings = std::move(labels->swellings);
  split.penPx = labels->penPx;
  auto [paths, junctions] = findPathsAndJunctions(labels->skeleton, ink, params, context);
  if (context.isCancelled()) return cancelled();
  GraininessMap grain = page != nullptr ? grainOnFinePage(paths, *page, context) : GraininessMap(paths, grey, context);
  const PencilPieces pencil(ink, paths, grain, context);
  if (context.isCancelled()) return cancelled();
  // Strokes that have run together are told anew once the paper between them is open.
  if (paper.sheet != nullptr && split.penPx) {
    std::optional<PencilClosing> closing;
    if (pencil.any()) {
      BitImage pens = penInk(ink, pencil);
      const double pencilPx = medianWidth(paths, [&](int i) { return grain.isPencil(i); });
      Result<BitImage> closed = withGrainClosed(without(BitImage(ink), pens), pencilPx, page != nullptr, context);
      if (!closed) return fail(closed.error());
      closing = PencilClosing{std::move(pens), std::move(*closed)};
    }
    auto opened = withPaperOpened(ink, pencil.pieces(), grey, split, closing, *paper.sheet, context);
    if (context.isCancelled()) return cancelled();
    const bool isOther = opened && opened->ink != ink;  // else only what the closing would fill stays open
    if (isOther) return splitByLabel(opened->ink, grey, params, page, {nullptr, std::move(opened->clear)}, context);
    if (opened) paper.clear = std::move(opened->clear);
  }
  split.known = std::make_unique<StrokesOfInk>(
      StrokesOfInk{ink, std::move(labels->skeleton), std::move(paths), std::move(junctions), std::move(grain)});
  const auto vote = [&](const BitImage& labelled, const BitImage* ofPencil) {
    voteInRows({pencil.pieces(), split.known->paths, labelled, ofPencil}, split.strokes, split.shapes, context);
  };
  if (!pencil.any()) {
    vote(split.shapes, nullptr);
    return split;
  }
  Result<StrokeSplit> byPiece = splitStrokes(ink, context);
  if (!byPiece) return fail(byPiece.error());
  PencilInk drawn;
  const BitImage labelled = split.shapes;
  drawn.ink = movePencil(ink, pencil, *byPiece, split);
  vote(labelled, &drawn.ink);
  const StrokesOfInk& known = *split.known;
  const double widthPx = medianWidth(known.paths, [&](int i) { return known.grain.isPencil(i); });
  Result<BitImage> body = withGrainClosed(both(split.strokes, drawn.ink), widthPx, page != nullptr, context);
  if (!body) return fail(body.error());
  if (context.isCancelled()) return cancelled();
  if (paper.clear) *body = without(std::move(*body), *paper.clear);
  split.clear = std::move(paper.clear);
  Result<InkLabels> ofBody = labelInk(*body, context, params.mergeWidths, pixelsPerPx);
  if (!ofBody) return fail(ofBody.error());
  const double penPx = std::max(ofBody->penPx.value_or(0.0), widthPx);
  const BitImage solids = pencilSolids(*body, ofBody->shapes, penPx, context);
  if (context.isCancelled()) return cancelled();
  split.strokes = without(std::move(split.strokes), solids);
  split.shapes = either(std::move(split.shapes), solids);
  drawn.widthPx = std::max(split.penPx.value_or(0.0), widthPx);
  drawn.pencilPx = widthPx;
  drawn.body = std::move(*body);
  split.pencil = std::move(drawn);
  return split;
}

}  // namespace

Result<InkSplit> splitInk(const BitImage& ink, const GreyImage& grey, const EdgeParams& params,
                          const RunContext& context, const GreyImage* page, const PaperBackground* paper) {
  InkSplit split;
  if (params.mode == EdgeMode::Automatic) {
    Result<InkSplit> labelled = splitByLabel(ink, grey, params, page, {paper, {}}, context);
    if (!labelled) return fail(labelled.error());
    split = std::move(*labelled);
  } else {
    split.strokes = split.shapes = BitImage(ink.width, ink.height);
    (params.mode == EdgeMode::Outline ? split.shapes : split.strokes) = ink;
  }
  if (!params.painted.empty()) split.painted = applyPaint(params.painted, split.strokes, split.shapes, context);
  if (params.choices.empty()) return split;
  split.regions = regionsOf(split, context);
  if (context.isCancelled()) return cancelled();
  const ChosenInk chosen(split.regions, params.choices);
  for (std::size_t i = 0; i < split.regions.runs.size(); ++i) {
    const auto choice = chosen.choiceOf(split.regions.piece[i]);
    if (!choice || params.choices[*choice].mode == EdgeMode::Automatic) continue;
    move(ink, split.regions.runs[i], params.choices[*choice].mode == EdgeMode::Outline, split);
  }
  return split;
}

}  // namespace batten
