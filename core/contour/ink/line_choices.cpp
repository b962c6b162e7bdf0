// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/line_choices.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/base/number_text.h"
#include "core/contour/chosen_ink.h"

namespace batten {
namespace {

void addPlace(ContourSet& set, const std::string& what, const Vec2& px) {
  addNote(set,
          what + " near (" + std::to_string(std::lround(px.x())) + ", " + std::to_string(std::lround(px.y())) + ").");
}

// Which choice of the user the ink of a point follows.
std::optional<int> choiceUnder(const Contour& contour, int point, const ChosenInk& chosen) {
  for (const Vec2& place : inkBeside(contour, point)) {
    if (const auto choice = chosen.choiceAt(place)) return choice;
  }
  return std::nullopt;
}

struct LongestLine {
  int points = 0;
  Contour* line = nullptr;
};

// A line that only ends in chosen ink, or begins there, is its neighbour's; one that is led through it is its own where
// there is no other.
void noteLines(ContourSet& set, const ChosenInk& chosen, std::span<const EdgeChoice> choices,
               const RunContext& context) {
  constexpr int kFewestInside = 3;  // points: with fewer a line only touches the ink
  std::vector<LongestLine> longest(choices.size());
  std::vector<bool> hasLine(choices.size(), false);
  for (Contour& contour : set.contours) {
    if (context.isCancelled()) return;
    std::vector<int> points(choices.size(), 0);
    for (int i = 0; i < std::ssize(contour.points); ++i) {
      if (const auto choice = choiceUnder(contour, i, chosen)) ++points[*choice];
    }
    for (std::size_t k = 0; k < choices.size(); ++k) {
      if (2 * points[k] > std::ssize(contour.points)) {
        contour.traceMode = choices[k];
        hasLine[k] = true;
      }
      if (points[k] >= kFewestInside && points[k] > longest[k].points) longest[k] = {points[k], &contour};
    }
  }
  for (std::size_t k = 0; k < choices.size(); ++k) {
    if (!hasLine[k] && longest[k].line != nullptr && !longest[k].line->traceMode)
      longest[k].line->traceMode = choices[k];
  }
}

}  // namespace

void addNote(ContourSet& set, const std::string& sentence) {
  if (!set.report.note.empty()) set.report.note += ' ';
  set.report.note += sentence;
}

void noteChoices(ContourSet& set, const RunPieces& regions, std::span<const EdgeChoice> choices, const BitImage& blots,
                 double pixelsPerPx, const RunContext& context) {
  if (choices.empty()) return;
  const ChosenInk chosen(regions, choices);
  for (const EdgeChoice& choice : chosen.withoutInk())
    addPlace(set, "A trace mode was chosen, but there is no ink", choice.positionPx / pixelsPerPx);
  std::vector<bool> isNoted(choices.size(), false);
  for (std::size_t i = 0; i < regions.runs.size(); ++i) {
    const auto chosenHere = chosen.choiceOf(regions.piece[i]);
    if (!chosenHere) continue;
    const int index = *chosenHere;
    if (isNoted[index] || choices[index].mode != EdgeMode::Centreline) continue;
    isNoted[index] = countBits(blots, regions.runs[i]) > 0;
    if (isNoted[index])
      addPlace(set, "Too short and wide for a centre line, so traced by its outline: the ink",
               choices[index].positionPx / pixelsPerPx);
  }
  noteLines(set, chosen, choices, context);
}

void noteJunctionChoices(ContourSet& set, const EdgeParams& edges) {
  constexpr int kTold = 3;  // of each kind, one by one
  if (edges.mergeWidths > 0.0 || edges.intent) return;
  int missing = 0, unmatched = 0;
  for (int i = 0; i < std::ssize(edges.junctions); ++i) {
    const Vec2& px = edges.junctions[i].positionPx;
    std::string place = std::to_string(std::lround(px.x()));
    place += ", " + std::to_string(std::lround(px.y()));
    // The last of several choices for one junction counts.
    const auto followsALater = [&](const StrokeJunction& j) {
      return j.choice && *j.choice > i && (j.positionPx - px).norm() <= kInkReachPx;
    };
    if (std::ranges::any_of(set.junctions, followsALater)) continue;
    const auto own = std::ranges::find_if(set.junctions, [i](const StrokeJunction& j) { return j.choice == i; });
    if (own == set.junctions.end()) {
      if (++missing <= kTold)
        addNote(set, "Strokes were paired at a junction, but none is found near (" + place + "); the choice is kept.");
    } else if (std::ssize(own->pairs) < std::ssize(edges.junctions[i].pairs) && ++unmatched <= kTold) {
      addNote(set, "A pair of strokes at the junction near (" + place +
                       ") was left out: its two places are not on two branches of it.");
    }
  }
  if (missing > kTold)
    addNote(set,
            counted(missing - kTold, "more paired junction is not found.", "more paired junctions are not found."));
  if (unmatched > kTold)
    addNote(set, "The same is true of " + counted(unmatched - kTold, "more junction.", "more junctions."));
}

}  // namespace batten
