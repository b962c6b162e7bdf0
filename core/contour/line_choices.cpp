// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/line_choices.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

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
  constexpr int kFewestInside = 3;
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
                 const RunContext& context) {
  if (choices.empty()) return;
  const ChosenInk chosen(regions, choices);
  for (const EdgeChoice& choice : chosen.withoutInk())
    addPlace(set, "A trace mode was chosen, but there is no ink", choice.positionPx);
  std::vector<bool> isNoted(choices.size(), false);
  for (std::size_t i = 0; i < regions.runs.size(); ++i) {
    const auto chosenHere = chosen.choiceOf(regions.piece[i]);
    if (!chosenHere) continue;
    const int index = *chosenHere;
    if (isNoted[index] || choices[index].mode != EdgeMode::Centreline) continue;
    isNoted[index] = countBits(blots, regions.runs[i]) > 0;
    if (isNoted[index])
      addPlace(set, "Too short and wide for a centre line, so traced by its outline: the ink",
               choices[index].positionPx);
  }
  noteLines(set, chosen, choices, context);
}

}  // namespace batten
