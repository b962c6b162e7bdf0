// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/trace_contours.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <span>
#include <string>

#include "core/base/parallel.h"
#include "core/contour/centreline/centreline.h"
#include "core/contour/chosen_ink.h"
#include "core/contour/ink_split.h"
#include "core/contour/outline/crack_contours.h"
#include "core/contour/outline/implied_borders.h"
#include "core/contour/outline/soft_borders.h"
#include "core/contour/outline/soft_edges.h"
#include "core/contour/outline/subpixel_edges.h"
#include "core/polyline/polyline_tools.h"

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

void addSentence(ContourSet& set, const std::string& sentence) {
  if (!set.report.note.empty()) set.report.note += ' ';
  set.report.note += sentence;
}

bool hasInnerBorders(const EdgeParams& edges) {
  if (edges.internal == InnerBorders::Automatic) return edges.mode == EdgeMode::Automatic;
  return edges.internal == InnerBorders::On;
}

std::string counted(int count, const char* one, const char* many) {
  return count == 1 ? std::string("One ") + one + " is" : std::to_string(count) + " " + many + " are";
}

// What was found and is not there, in words.
void tellDropped(ContourSet& set, const EdgeParams& edges) {
  const ContourReport& report = set.report;
  if (report.droppedShort > 0)
    addSentence(set, counted(report.droppedShort, "short line", "short lines") +
                         " left out (contours.min_widths, contours.min_length).");
  if (report.droppedHoles > 0 && edges.internal == InnerBorders::Automatic)
    addSentence(set, counted(report.droppedHoles, "inner border", "inner borders") +
                         " left out: edges.internal=on keeps them.");
  if (report.droppedMargins > 0)
    addSentence(set, counted(report.droppedMargins, "line", "lines") + " along the border of the page left out.");
}

void sortAndCut(ContourSet& set, const ContourParams& params) {
  std::sort(set.contours.begin(), set.contours.end(), before);
  const auto most = static_cast<std::size_t>(params.maxCount);
  if (most == 0 || set.contours.size() <= most) return;
  addSentence(set, "Only the " + std::to_string(most) + " longest of " + std::to_string(set.contours.size()) +
                       " lines are kept: raise the largest number of lines to see the rest.");
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

// Who asked for outlines on a shaded drawing wants the edges of its tones, not where they fade.
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
  to.report.droppedMargins += from.report.droppedMargins;
  to.report.widthPx = std::max(to.report.widthPx, from.report.widthPx);
  if (to.report.note.empty()) to.report.note = std::move(from.report.note);
  std::move(from.contours.begin(), from.contours.end(), std::back_inserter(to.contours));
}

// [px] What a line has to be long, by the width of the pen.
double shortestPx(const ContourParams& params, double penPx) {
  return std::max(params.minLengthPx, params.minWidths * penPx);
}

// [px] A pen width for ink that is followed along its borders alone: that of its borders in the middle, where twice
// the area by the border is the width of a line; never more than a small mark may be wide.
double penOfBorders(const ContourSet& borders) {
  constexpr double kMostPx = 40.0 / 3.0;
  std::vector<std::pair<double, double>> widths;
  double all = 0.0, sum = 0.0;
  for (const Contour& c : borders.contours) {
    if (c.hole) continue;
    widths.emplace_back(2.0 * c.areaPx / std::max(1.0, c.lengthPx), c.lengthPx);
    all += c.lengthPx;
  }
  std::sort(widths.begin(), widths.end());
  for (const auto& [width, length] : widths) {
    sum += length;
    if (2.0 * sum >= all) return std::min(width, kMostPx);
  }
  return 0.0;
}

// The borders of ink that is followed along them, but the short ones. `penPx`: 0 = take it from the borders.
Result<ContourSet> bordersOf(const BitImage& ink, bool holes, const ContourParams& params, double penPx,
                             const RunContext& context) {
  constexpr double kLeastHole = 1.0 / 3.0;  // of a line's least length: the eye of an e is no wider than its pen
  Result<ContourSet> set = crackContours(ink, holes, params.minLengthPx, context);
  if (!set) return set;
  const double shortest = shortestPx(params, penPx > 0.0 ? penPx : penOfBorders(*set));
  const auto dropped = std::erase_if(
      set->contours, [&](const Contour& c) { return c.lengthPx < (c.hole ? kLeastHole * shortest : shortest); });
  set->report.droppedShort += static_cast<int>(dropped);
  return set;
}

// The borders of shapes. Holes belong to shapes; on a page that is followed by outlines only, they are the inner
// borders of its lines.
Result<ContourSet> outlinesOf(const InkSplit& split, const EdgeParams& edges, const ContourParams& params,
                              const RunContext& context) {
  Result<ContourSet> set = bordersOf(split.shapes, hasInnerBorders(edges), params, split.penPx, context);
  if (!set) return set;
  for (Contour& outline : set->contours) implyBorders(outline, split.strokes);
  return set;
}

// The lines of the page before sub-pixel placement of the outlines; centre lines come placed. `regions`: what a choice
// of the user holds for.
Result<ContourSet> findLines(const BitImage& ink, const GreyImage& grey, const EdgeParams& edges,
                             const ContourParams& params, RunPieces& regions, const RunContext& context) {
  if (edges.mode == EdgeMode::Outline && edges.choices.empty()) {
    return bordersOf(ink, hasInnerBorders(edges), params, 0.0, context);
  }
  Result<InkSplit> found = splitInk(ink, grey, edges, context);
  if (!found) return fail(found.error());
  InkSplit& split = *found;
  context.report(0.2);
  ContourSet set;
  const bool anyShape = split.shapes.count() > 0;
  if (anyShape) {
    Result<ContourSet> outlines = outlinesOf(split, edges, params, context);
    if (!outlines) return outlines;
    append(set, std::move(*outlines));
  }
  context.report(0.3);
  const CentrelineOptions options{anyShape ? &split.shapes : nullptr, params.minWidths};
  Result<ContourSet> lines = centrelines(split.strokes, grey, edges, context, options);
  if (!lines) return lines;
  const std::size_t all = lines->contours.size();
  std::erase_if(lines->contours, [&](const Contour& c) { return c.lengthPx < params.minLengthPx; });
  lines->report.droppedShort += static_cast<int>(all - lines->contours.size());
  append(set, std::move(*lines));
  regions = std::move(split.regions);
  return set;
}

void addNote(ContourSet& set, const std::string& what, const Vec2& px) {
  addSentence(
      set, what + " near (" + std::to_string(std::lround(px.x())) + ", " + std::to_string(std::lround(px.y())) + ").");
}

// Which choice of the user the ink of a point follows; -1 = none.
int choiceUnder(const Contour& contour, std::size_t point, const ChosenInk& chosen) {
  for (const Vec2& place : inkBeside(contour, point)) {
    const int choice = chosen.choiceAt(place);
    if (choice >= 0) return choice;
  }
  return -1;
}

// Notes on every line which choice of the user its ink follows; true for every choice that gave a line. A line that
// only ends in chosen ink, or begins there, is its neighbour's; one that is led through it is its own where there is no
// other.
std::vector<bool> noteWays(ContourSet& set, const ChosenInk& chosen, std::span<const EdgeChoice> choices) {
  constexpr int kFewestPoints = 3;
  struct Longest {
    int points = 0;
    Contour* line = nullptr;
  };
  std::vector<Longest> longest(choices.size());
  std::vector<bool> gaveLine(choices.size(), false);
  for (Contour& contour : set.contours) {
    std::vector<int> points(choices.size(), 0);
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
      const int choice = choiceUnder(contour, i, chosen);
      if (choice >= 0) ++points[choice];
    }
    for (std::size_t k = 0; k < choices.size(); ++k) {
      if (2 * points[k] > std::ssize(contour.points)) {
        contour.traceMode = choices[k];
        gaveLine[k] = true;
      }
      if (points[k] >= kFewestPoints && points[k] > longest[k].points) longest[k] = {points[k], &contour};
    }
  }
  for (std::size_t k = 0; k < choices.size(); ++k) {
    if (gaveLine[k] || longest[k].line == nullptr) continue;
    gaveLine[k] = true;
    if (!longest[k].line->traceMode) longest[k].line->traceMode = choices[k];
  }
  return gaveLine;
}

// Ink that was chosen to be followed along its middle, but is a blot that has none, keeps its outline: a line that
// vanished could not be clicked again.
Result<void> followChoices(ContourSet& set, const BitImage& ink, const EdgeParams& edges, const ContourParams& params,
                           const RunPieces& pieces, const RunContext& context) {
  if (edges.choices.empty()) return {};
  const ChosenInk chosen(pieces, edges.choices);
  for (const EdgeChoice& choice : chosen.withoutInk())
    addNote(set, "No ink to follow in its own way lies", choice.positionPx);
  const std::vector<bool> gaveLine = noteWays(set, chosen, edges.choices);
  BitImage blots(ink.width, ink.height);
  std::vector<bool> isNoted(edges.choices.size(), false);
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const int index = chosen.choiceOf(pieces.piece[i]);
    if (index < 0) continue;
    const auto at = static_cast<std::size_t>(index);
    const EdgeChoice& choice = edges.choices[at];
    if (gaveLine[at] || choice.mode != EdgeMode::Centreline) continue;
    setBits(blots, pieces.runs[i]);
    if (!isNoted[at])
      addNote(set, "Too short and wide for a centre line, followed along its outline: the ink", choice.positionPx);
    isNoted[at] = true;
  }
  if (std::find(isNoted.begin(), isNoted.end(), true) == isNoted.end()) return {};
  Result<ContourSet> outlines = bordersOf(blots, hasInnerBorders(edges), params, set.report.widthPx, context);
  if (!outlines) return fail(outlines.error());
  noteWays(*outlines, chosen, edges.choices);
  append(set, std::move(*outlines));
  return {};
}

std::string noLineMessage(const ContourSet& set) {
  if (set.report.found == 0) {
    return "No line was found: raise the thresholds, or check that the drawing is darker than the paper.";
  }
  return "No line is long enough: lower the smallest length or raise the thresholds.";
}

Result<ContourSet> traceAll(const BitImage& ink, const GreyImage& grey, const EdgeParams& edges,
                            const ContourParams& params, const RunContext& context) {
  RunPieces regions;
  Result<ContourSet> set = findLines(ink, grey, edges, params, regions, context);
  if (!set) return set;
  if (auto followed = followChoices(*set, ink, edges, params, regions, context); !followed)
    return fail(followed.error());
  if (context.isCancelled()) return cancelled();
  if (set->contours.empty()) {
    return fail(
        ErrorCode::NoCurve, noLineMessage(*set),
        std::to_string(set->report.found) + " found, " + std::to_string(set->report.droppedShort) + " too short");
  }
  if (edges.strokeWidth != EdgeParams{}.strokeWidth) {
    addSentence(*set, "edges.stroke_width has no effect: strokes and shapes are told apart region by region.");
  }
  sortAndCut(*set, params);
  context.report(0.6);
  if (edges.subpixel) {
    refineOutlines(*set, grey, context);
    refineSoftOutlines(*set, grey, context);
    if (edges.mode == EdgeMode::Outline) dropSoftBorders(*set, grey, params, context);
    if (context.isCancelled()) return cancelled();
    std::sort(set->contours.begin(), set->contours.end(), before);
  }
  tellDropped(*set, edges);
  countRefined(*set);
  context.report(1.0);
  return set;
}

}  // namespace

Result<ContourSet> traceContours(const BitImage& ink, const GreyImage& grey, const EdgeParams& edges,
                                 const ContourParams& params, const RunContext& context) {
  if (auto error = validate(edges)) return fail(*error);
  if (auto error = validate(params)) return fail(*error);
  if (ink.width != grey.width || ink.height != grey.height) {
    return fail(ErrorCode::BadParameter, "The mask and the scan differ in size.");
  }
  try {
    return traceAll(ink, grey, edges, params, context);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to trace the lines: raise the smallest length.");
  }
}

}  // namespace batten
