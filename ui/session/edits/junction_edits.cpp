// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/edits/junction_edits.h"

#include <QCoreApplication>
#include <algorithm>
#include <limits>

namespace batten {
namespace {

QString junctionText(const char* text) { return QCoreApplication::translate("JunctionEdits", text); }

/// Whether a choice is about the junction: as where lines are found, it is about the nearest one.
bool isAbout(const EditorSession& session, const JunctionChoice& choice, const StrokeJunction& junction) {
  const double distance = (choice.positionPx - junction.positionPx).norm();
  return distance <= kInkReachPx && std::ranges::none_of(junctionsOf(session), [&](const StrokeJunction& other) {
           return (choice.positionPx - other.positionPx).norm() < distance;
         });
}

const JunctionChoice* choiceFor(const EditorSession& session, const StrokeJunction& junction) {
  const auto& choices = session.recipe().edges.junctions;
  const auto last = std::find_if(choices.rbegin(), choices.rend(),
                                 [&](const JunctionChoice& c) { return isAbout(session, c, junction); });
  return last == choices.rend() ? nullptr : &*last;
}

int nearestBranch(const StrokeJunction& junction, const Vec2& place) {
  double least = std::numeric_limits<double>::infinity();
  int nearest = 0;
  for (int i = 0; i < std::ssize(junction.branchesPx); ++i) {
    const double distance = (junction.branchesPx[i] - place).norm();
    if (distance < least) least = distance, nearest = i;
  }
  return nearest;
}

void setPairs(EditorSession& session, const StrokeJunction& junction, const EndPairs& pairs) {
  Recipe after = session.recipe();
  JunctionChoice choice{junction.positionPx, {}};
  std::erase_if(after.edges.junctions, [&](const JunctionChoice& c) { return isAbout(session, c, junction); });
  for (const auto& [a, b] : pairs) choice.pairs.push_back({junction.branchesPx[a], junction.branchesPx[b]});
  const bool isRule = !junction.pairings.empty() && pairs == junction.pairings.front();
  if (!isRule) after.edges.junctions.push_back(std::move(choice));
  session.change(isRule ? junctionText("Pair strokes by rule") : junctionText("Pair strokes"), std::move(after));
}

}  // namespace

std::span<const StrokeJunction> junctionsOf(const EditorSession& session) {
  const auto& set = session.output().contours;
  return set ? std::span<const StrokeJunction>(set->junctions) : std::span<const StrokeJunction>();
}

EndPairs askedPairs(const EditorSession& session, const StrokeJunction& junction) {
  const JunctionChoice* choice = choiceFor(session, junction);
  if (choice == nullptr) return junction.pairings.empty() ? junction.pairs : junction.pairings.front();
  // What was found by the choice knows best which branches its places mean.
  if (junction.choice && session.recipe().edges.junctions.data() + *junction.choice == choice &&
      !session.isStale(StageId::Contours))
    return junction.pairs;
  EndPairs pairs;
  for (const BranchPair& pair : choice->pairs) {
    const auto [a, b] = std::minmax({nearestBranch(junction, pair.firstPx), nearestBranch(junction, pair.secondPx)});
    if (a != b) pairs.emplace_back(a, b);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

bool isPairedByHand(const EditorSession& session, const StrokeJunction& junction) {
  return choiceFor(session, junction) != nullptr;
}

void pairNext(EditorSession& session, const StrokeJunction& junction) {
  const auto& pairings = junction.pairings;
  if (pairings.empty()) return;
  const auto now = std::find(pairings.begin(), pairings.end(), askedPairs(session, junction));
  setPairs(session, junction, now == pairings.end() || now + 1 == pairings.end() ? pairings.front() : *(now + 1));
}

void pairBranches(EditorSession& session, const StrokeJunction& junction, int first, int second) {
  if (first == second) return;
  const std::pair<int, int> asked(std::min(first, second), std::max(first, second));
  EndPairs pairs = askedPairs(session, junction);
  const bool isOne = std::erase(pairs, asked) > 0;
  if (!isOne) {
    std::erase_if(pairs, [&](const auto& pair) {
      return pair.first == first || pair.first == second || pair.second == first || pair.second == second;
    });
    pairs.push_back(asked);
    std::sort(pairs.begin(), pairs.end());
  }
  setPairs(session, junction, pairs);
}

void forgetPairings(EditorSession& session) {
  Recipe after = session.recipe();
  after.edges.junctions.clear();
  session.change(junctionText("Pair all strokes by rule"), std::move(after));
}

}  // namespace batten
