// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/trace_contours.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <span>
#include <string>

#include "core/base/number_text.h"
#include "core/base/parallel.h"
#include "core/contour/centreline/centreline.h"
#include "core/contour/centreline/ends/meeting_ends.h"
#include "core/contour/centreline/ends/near_ends.h"
#include "core/contour/centreline/junction/junction_choices.h"
#include "core/contour/fine_lines.h"
#include "core/contour/ink/blots.h"
#include "core/contour/ink/faint_marks.h"
#include "core/contour/ink/ink_split.h"
#include "core/contour/ink/line_choices.h"
#include "core/contour/ink/page_edge_lines.h"
#include "core/contour/ink/tone_grain.h"
#include "core/contour/outline/implied_borders.h"
#include "core/contour/outline/ink_borders.h"
#include "core/contour/outline/soft_borders.h"
#include "core/contour/outline/soft_edges.h"
#include "core/contour/outline/subpixel_edges.h"
#include "core/contour/outline/texture_holes.h"
#include "core/contour/outline/tonal_holes.h"
#include "core/contour/outline/uneven_ink.h"
#include "core/contour/untraced_ink.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

constexpr std::size_t kLongContour = 4000;  // points: from here on one contour is worth all threads

// Longest first; ties by the topmost, then leftmost start, so that the numbering of curves never depends on chance.
bool before(const Contour& a, const Contour& b) {
  if (a.lengthPx != b.lengthPx) return a.lengthPx > b.lengthPx;
  const Vec2 p = a.points.empty() ? Vec2::Zero().eval() : a.points.front().unrefined;
  const Vec2 q = b.points.empty() ? Vec2::Zero().eval() : b.points.front().unrefined;
  return p.y() != q.y() ? p.y() < q.y() : p.x() < q.x();
}

bool hasInnerBorders(const EdgeParams& edges) {
  if (edges.internal == InnerBorders::Automatic) return edges.mode != EdgeMode::Outline;
  return edges.internal == InnerBorders::On;
}

std::string countedWere(int count, const char* one, const char* many) {
  return count == 1 ? std::string("One ") + one + " was" : counted(count, one, many) + " were";
}

// Notes on contours that were dropped.
void tellDropped(ContourSet& set, const EdgeParams& edges) {
  const ContourReport& report = set.report;
  if (report.droppedShort > 0)
    addNote(set, countedWere(report.droppedShort, "short line", "short lines") +
                     " dropped (contours.min_widths, contours.min_length).");
  if (report.droppedHoles > 0 && edges.internal == InnerBorders::Automatic)
    addNote(set, countedWere(report.droppedHoles, "inner border", "inner borders") +
                     " dropped: edges.internal=on keeps them.");
  if (report.droppedFaint > 0)
    addNote(set, countedWere(report.droppedFaint, "speck", "specks") +
                     " dropped, much fainter than the strokes around; contours.min_widths=2 keeps them.");
  if (report.droppedGrain > 0)
    addNote(set, countedWere(report.droppedGrain, "short line", "short lines") +
                     " dropped, no darker than the grain of the tone around; contours.min_widths=2 keeps them.");
  if (report.droppedMargins > 0)
    addNote(set,
            countedWere(report.droppedMargins, "line along the page border", "lines along the page border") +
                (set.sheetEdges.empty() ? " dropped." : " dropped; edges.mode=centreline keeps the edge of a sheet."));
}

void sortAndCut(ContourSet& set, const ContourParams& params) {
  std::sort(set.contours.begin(), set.contours.end(), before);
  constexpr int kMostUnasked = 20000;  // bounds time and memory, on halftones and dirt; no drawing has so many
  const int most = params.maxCount > 0 ? params.maxCount : kMostUnasked;
  if (std::ssize(set.contours) <= most) return;
  addNote(set, "Only the " + (most == 1 ? std::string() : std::to_string(most) + ' ') + "longest of " +
                   std::to_string(set.contours.size()) + (most == 1 ? " lines is" : " lines are") +
                   " kept: " + (params.maxCount > 0 ? "raise" : "set") + " contours.max_count to keep more.");
  set.contours.resize(most);
}

void refineOutlines(ContourSet& set, const GreyImage& grey, const RunContext& context) {
  std::vector<Contour*> small;
  for (Contour& contour : set.contours) {
    if (contour.kind != ContourKind::Outline) continue;
    if (contour.points.size() >= kLongContour) {
      refineOutline(contour, grey, context);
    } else {
      small.push_back(&contour);
    }
  }
  RunContext alone = context;
  alone.threads = 1;
  parallelFor(context, static_cast<int>(small.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) refineOutline(*small[i], grey, alone);
  });
}

// The outlines of a shaded drawing are the edges of its tones, not where they fade.
void dropSoftBorders(ContourSet& set, const GreyImage& grey, const ContourParams& params, const RunContext& context) {
  std::vector<Contour> kept;
  for (Contour& contour : set.contours) {
    if (contour.kind != ContourKind::Outline) {
      kept.push_back(std::move(contour));
      continue;
    }
    std::vector<Contour> parts = cutSoftBorders(contour, grey, context);
    if (context.isCancelled()) return;
    const bool cut = parts.size() != 1 || parts[0].closed != contour.closed;
    if (cut) {
      const std::size_t all = parts.size();
      std::erase_if(parts, [&](const Contour& c) { return c.lengthPx < params.minLengthPx; });
      set.report.droppedShort += static_cast<int>(all - parts.size());
    }
    std::move(parts.begin(), parts.end(), std::back_inserter(kept));
  }
  set.contours = std::move(kept);
}

void countRefined(ContourSet& set) {
  std::size_t points = 0, refined = 0;
  for (const Contour& contour : set.contours) {
    points += contour.points.size();
    for (const ContourPoint& p : contour.points) refined += p.refined ? 1 : 0;
  }
  set.report.refinedShare = points > 0 ? static_cast<double>(refined) / static_cast<double>(points) : 0.0;
}

void append(ContourSet& to, ContourSet&& from) {
  to.report.found += from.report.found;
  to.report.droppedShort += from.report.droppedShort;
  to.report.droppedHoles += from.report.droppedHoles;
  to.report.droppedHolesPx += from.report.droppedHolesPx;
  to.report.droppedMargins += from.report.droppedMargins;
  to.report.droppedFaint += from.report.droppedFaint;
  to.report.droppedGrain += from.report.droppedGrain;
  to.report.isGrouped = to.report.isGrouped || from.report.isGrouped;
  to.report.widthPx = std::max(to.report.widthPx, from.report.widthPx);
  if (to.report.note.empty()) to.report.note = std::move(from.report.note);
  std::move(from.contours.begin(), from.contours.end(), std::back_inserter(to.contours));
  std::move(from.junctions.begin(), from.junctions.end(), std::back_inserter(to.junctions));
}

// What a page is made of, before sub-pixel placement of the outlines; centre lines come placed.
struct FoundLines {
  ContourSet set;
  RunPieces regions;                ///< What a choice of the user holds for.
  BitImage blots;                   ///< Ink to be followed along its middle that has none.
  std::optional<BitImage> painted;  ///< InkSplit::painted.
  bool isPencil = false;            ///< Most of the ink is.
};

// Drops marks much fainter than the strokes around them. @return how many.
int dropFaint(FoundLines& found, InkSplit& split, const FaintMarks& faint) {
  found.blots = without(std::move(found.blots), faint.ink);
  split.shapes = without(std::move(split.shapes), faint.ink);
  split.strokes = without(std::move(split.strokes), faint.ink);
  return faint.count;
}

// Fills what holes of the shapes are texture of the ink. @return how many.
int fillTexture(InkSplit& split, const EdgeParams& edges, const GreyImage& grey, const RunContext& context) {
  if (edges.internal != InnerBorders::Automatic || split.shapes.count() == 0) return 0;
  EvenInk even = fillTextureHoles(std::move(split.shapes), grey, context);
  split.shapes = without(std::move(even.ink), split.strokes);
  return even.filled;
}

// Adds what strokes enclose and fill to the blots, unless the page is followed along middles alone.
void addFillings(FoundLines& found, const InkSplit& split, const ContourSet& lines, const EdgeParams& edges,
                 const RunContext& context) {
  if (edges.mode == EdgeMode::Centreline) {
    found.blots = chosenOf(found.blots, found.regions, edges);
  } else if (edges.mergeWidths <= 0.0 && !lines.report.isGrouped) {
    found.blots = either(std::move(found.blots),
                         notChosen(findFillings(split, lines, context), found.regions, split.painted, edges));
  }
}

void appendLongLines(ContourSet& to, ContourSet&& lines, const ContourParams& params) {
  const std::size_t all = lines.contours.size();
  std::erase_if(lines.contours, [&](const Contour& c) { return c.lengthPx < params.minLengthPx; });
  lines.report.droppedShort += static_cast<int>(all - lines.contours.size());
  append(to, std::move(lines));
}

// Ink and grey of a page, or of one that was enlarged.
struct InkedPage {
  const BitImage& ink;
  const GreyImage& grey;
  const GreyImage* page = nullptr;         // what an enlarged `grey` was made of, else absent
  const PaperBackground* paper = nullptr;  // PageAids::paper
};

Result<FoundLines> findLines(const InkedPage& inked, const EdgeParams& edges, const ContourParams& params,
                             const RunContext& context) {
  const auto& [ink, grey, page, paper] = inked;
  FoundLines found;
  if (edges.mode == EdgeMode::Outline && edges.choices.empty() && edges.painted.empty()) {
    Result<ContourSet> borders = bordersOf(ink, hasInnerBorders(edges), params, std::nullopt, nullptr, context);
    if (!borders) return fail(borders.error());
    found.set = std::move(*borders);
    return found;
  }
  Result<InkSplit> split = splitInk(ink, grey, edges, context, page, paper);
  if (!split) return fail(split.error());
  context.report(0.2);
  found.regions = std::move(split->regions);
  found.isPencil = split->pencil && 2 * split->pencil->ink.count() > ink.count();
  const BitImage rows =
      hasOwnLengths(params) ? BitImage(ink.width, ink.height) : findRows(*split, params.minWidths, context);
  const CentrelineOptions options{split->shapes.count() > 0 ? &split->shapes : nullptr,
                                  &rows,
                                  params.minWidths,
                                  split->known.get(),
                                  split->clear ? &*split->clear : nullptr,
                                  page};
  Result<ContourSet> lines = centrelines(split->strokes, grey, edges, context, options);
  if (!lines) return fail(lines.error());
  split->known.reset();
  context.report(0.3);
  found.blots = findBlots(*split, *lines, rows, params.minWidths, context);
  int faint = 0;
  if (edges.mode == EdgeMode::Automatic && !hasOwnLengths(params)) {
    const BitImage marks = notChosen(either(found.blots, split->shapes), found.regions, split->painted, edges);
    faint = dropFaint(found, *split, faintMarks(marks, ink, *lines, grey, split->penPx, context));
  }
  addFillings(found, *split, *lines, edges, context);
  if (context.isCancelled()) return cancelled();
  const bool isPaintedInVain = split->painted && both(found.blots, *split->painted).count() > 0;
  split->shapes = either(std::move(split->shapes), found.blots);
  split->strokes = without(std::move(split->strokes), found.blots);
  const auto grainy =
      split->pencil ? std::optional(without(without(BitImage(split->pencil->ink), found.blots), rows)) : std::nullopt;
  const int texture = fillTexture(*split, edges, grey, context);
  Result<ContourSet> borders =
      bordersOf(split->shapes, hasInnerBorders(edges), params, split->penPx, grainy ? &*grainy : nullptr, context);
  if (!borders) return fail(borders.error());
  if (split->pencil) notePencil(*borders, split->pencil->ink, split->pencil->pencilPx);
  noteUnevenInk(*borders, split->shapes, grey, context);
  borders->report.droppedHoles += texture;
  borders->report.droppedFaint = faint;
  for (Contour& border : borders->contours) implyBorders(border, split->strokes);
  found.painted = std::move(split->painted);
  found.set = std::move(*borders);
  appendLongLines(found.set, std::move(*lines), params);
  if (isPaintedInVain)
    addNote(found.set,
            "Ink that was painted for a centre line is too short and wide for one: it was traced by its outline.");
  return found;
}

std::string noLineMessage(const ContourSet& set, const ContourParams& params) {
  if (set.report.found == 0) {
    return "No line was found: raise the thresholds, or check that the drawing is darker than the paper.";
  }
  constexpr double kMostShown = 1e9;  // what an integer holds
  const bool isPx = params.minLengthPx > 0.0;
  const auto limit = std::lround(std::min(isPx ? params.minLengthPx : params.minWidths, kMostShown));
  return "No line of " + std::to_string(limit) + (isPx ? " px" : " stroke widths") +
         " or longer was found: lower the smallest length or raise the thresholds.";
}

// The lines before the outlines are refined, and what the user chose of them.
Result<ContourSet> findChosenLines(const InkedPage& inked, const EdgeParams& edges, const ContourParams& params,
                                   const RunContext& context) {
  Result<FoundLines> found = findLines(inked, edges, params, context);
  if (!found) return fail(found.error());
  if (edges.mode == EdgeMode::Automatic) {
    auto net = bordersOfLostNet(found->set, inked.ink, edges, params, context);
    if (!net) return fail(net.error());
    if (*net) found->set = std::move(**net);
  }
  noteChoices(found->set, found->regions, edges.choices, found->blots, inked.page != nullptr ? kFineFactor : 1.0,
              context);
  // A line of several strokes lies beside their ink.
  const bool isOfOne = edges.mergeWidths <= 0.0 && !found->set.report.isGrouped;
  if (edges.mode == EdgeMode::Automatic && !hasOwnLengths(params)) {
    if (isOfOne) dropGrain(found->set, inked.grey, found->isPencil, found->painted, context);
    dropPageEdgeLines(found->set, inked.grey);
  }
  if (isOfAllInk(edges, params)) noteUntraced(found->set, inked.ink);
  return std::move(found->set);
}

Result<ContourSet> traceAll(const BitImage& ink, const GreyImage& grey, const EdgeParams& edges,
                            const ContourParams& params, const PageAids& aids, const RunContext& context) {
  const FinePage* fine = aids.fine;
  Result<ContourSet> found =
      fine != nullptr ? findChosenLines({fine->ink, *fine->grey, &grey}, onFinePage(edges), onFinePage(params), context)
                      : findChosenLines({ink, grey, nullptr, aids.paper}, edges, params, context);
  if (!found) return found;
  if (fine != nullptr) found = fromFinePage(std::move(*found));
  ContourSet* set = &*found;
  noteJunctionChoices(*set, edges);
  if (context.isCancelled()) return cancelled();
  if (set->contours.empty()) {
    return fail(
        ErrorCode::NoCurve, noLineMessage(*set, params),
        std::to_string(set->report.found) + " found, " + std::to_string(set->report.droppedShort) + " too short");
  }
  if (edges.strokeWidth != EdgeParams{}.strokeWidth) {
    addNote(*set, "edges.stroke_width has no effect.");
  }
  if (edges.intent && !set->report.isGrouped) {
    addNote(*set, "No lines drawn over more than once were found: edges.intent changes nothing.");
  }
  sortAndCut(*set, params);
  // Those of lines that were left out are no longer offered.
  set->junctions = junctionsOfLines(std::move(set->junctions), set->contours);
  context.report(0.6);
  if (edges.subpixel) {
    refineOutlines(*set, grey, context);
    refineSoftOutlines(*set, grey, context);
    if (edges.mode == EdgeMode::Outline) dropSoftBorders(*set, grey, params, context);
    if (edges.mode == EdgeMode::Automatic && edges.internal == InnerBorders::Automatic)
      dropTonalHoles(*set, grey, context);
    if (context.isCancelled()) return cancelled();
    leadToLines(set->contours, grey, context);
    const bool isOfOneStroke = edges.mergeWidths <= 0.0 && !set->report.isGrouped;
    if (isOfOneStroke) leadOverPaper(set->contours, ink, edges.gapFactor, context);
    std::sort(set->contours.begin(), set->contours.end(), before);
  }
  tellDropped(*set, edges);
  countRefined(*set);
  context.report(1.0);
  return found;
}

}  // namespace

Result<ContourSet> traceContours(const BitImage& ink, const GreyImage& grey, const EdgeParams& edges,
                                 const ContourParams& params, const RunContext& context, const PageAids& aids) {
  if (auto error = validate(edges)) return fail(*error);
  if (auto error = validate(params)) return fail(*error);
  if (ink.width != grey.width || ink.height != grey.height) {
    return fail(ErrorCode::BadParameter, "The mask and the scan differ in size.");
  }
  try {
    return traceAll(ink, grey, edges, params, aids, context);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to trace the lines: raise the smallest length.");
  }
}

}  // namespace batten
