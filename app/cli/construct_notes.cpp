// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/construct_notes.h"

#include <algorithm>
#include <utility>

namespace batten::cli {
namespace {

constexpr std::size_t kMostNamed = 12;

/// "Curve 3", "Curves 1, 4 and 7", "Curves 1, 2, 3 and 40 more".
std::string named(const std::vector<std::size_t>& curves) {
  const std::size_t shown = curves.size() <= kMostNamed ? curves.size() : kMostNamed - 1;
  std::string text = curves.size() == 1 ? "Curve " : "Curves ";
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += i + 1 == curves.size() ? " and " : ", ";
    text += std::to_string(curves[i]);
  }
  if (shown < curves.size()) text += " and " + std::to_string(curves.size() - shown) + " more";
  return text;
}

/// "at 1 place: mark a corner" and "at 3 places: mark corners" are one kind.
std::string kindOf(const std::string& note) { return note.starts_with("Turns sharply at ") ? "Turns sharply" : note; }

}  // namespace

std::vector<std::string> constructNotes(std::span<const TracedCurve> curves) {
  struct Kind {
    std::string kind, note;
    std::vector<std::size_t> curves;
  };
  std::vector<Kind> kinds;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::string& note = curves[i].construct.note;
    if (note.empty() || !curves[i].included) continue;
    const std::string kind = kindOf(note);
    auto same = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.kind == kind; });
    if (same == kinds.end()) same = kinds.insert(kinds.end(), Kind{kind, note, {}});
    same->curves.push_back(i + 1);
  }
  std::vector<std::string> lines;
  for (const Kind& k : kinds) {
    if (k.kind == "Turns sharply") {
      lines.push_back(named(k.curves) + (k.curves.size() == 1 ? " turns" : " turn") +
                      " sharply where no corner is marked: add --corner there.");
    } else {
      lines.push_back(named(k.curves) + ": " + k.note);
    }
  }
  return lines;
}

}  // namespace batten::cli
