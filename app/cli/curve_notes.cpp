// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/curve_notes.h"

#include <algorithm>
#include <utility>

namespace batten::cli {
namespace {

constexpr std::size_t kMostNamed = 12;

/// "Curve 3", "Curves 1, 4 and 7", "Curves 1, 2, 3 and 40 more".
std::string named(const std::vector<int>& curves) {
  const std::size_t shown = curves.size() <= kMostNamed ? curves.size() : kMostNamed - 1;
  std::string text = curves.size() == 1 ? "Curve " : "Curves ";
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += i + 1 == curves.size() ? " and " : ", ";
    text += std::to_string(curves[i]);
  }
  if (shown < curves.size()) text += " and " + std::to_string(curves.size() - shown) + " more";
  return text;
}

/// Curves of which the same is to be said.
struct Kind {
  std::string kind, note;
  std::vector<int> curves;
};

void add(std::vector<Kind>& kinds, const std::string& kind, const std::string& note, int curve) {
  if (note.empty()) return;
  auto same = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.kind == kind; });
  if (same == kinds.end()) same = kinds.insert(kinds.end(), Kind{kind, note, {}});
  same->curves.push_back(curve);
}

/// "at 1 place: mark a corner" and "at 3 places: mark corners" are one kind.
std::string kindOf(const std::string& note) { return note.starts_with("Turns sharply at ") ? "Turns sharply" : note; }

/// What fairing refused, or did in part; what a target would have taken beyond the tolerance differs for every curve.
std::string fairingNote(const FairingReport& report) {
  if (report.note.empty() && !report.withinTolerance) return "Only part of what was asked lies within the tolerance.";
  return report.note;
}

}  // namespace

std::vector<std::string> curveNotes(const PipelineOutput& output) {
  std::vector<Kind> constructed, faired;
  for (const TracedCurve& curve : output.faired->curves) {
    if (!curve.included) continue;
    const int number = curveNumber(output, curve);
    add(constructed, kindOf(curve.construct.note), curve.construct.note, number);
    const std::string note = fairingNote(curve.fairing);
    add(faired, note, note, number);
  }
  std::vector<std::string> lines;
  for (const Kind& k : constructed) {
    if (k.kind == "Turns sharply") {
      lines.push_back(named(k.curves) + (k.curves.size() == 1 ? " turns" : " turn") +
                      " sharply where no corner is marked: add --corner there.");
    } else {
      lines.push_back(named(k.curves) + ": " + k.note);
    }
  }
  for (const Kind& k : faired) lines.push_back(named(k.curves) + ", fairing: " + k.note);
  return lines;
}

}  // namespace batten::cli
