// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/curve_notes.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "app/cli/note_list.h"
#include "core/base/number_text.h"
#include "core/construct/typical/typical_chain.h"
#include "core/pipeline/run/left_as_drawn.h"

namespace batten::cli {
namespace {

/// "Curve 3", "Curves 1, 4 and 7", "Curves 1, 2, 3 and 40 more".
std::string named(const std::vector<int>& curves) {
  const std::size_t shown = namedOf(curves.size());
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

// how notes begin that are told once for all curves
constexpr std::string_view kTurnsSharply = "Turns sharply at ", kFewTypical = "Typical curves make ";

/// "at 1 place: mark a corner" and "at 3 places: mark corners" are one kind; so are all shares of typical curves.
std::string kindOf(const std::string& note) {
  for (const std::string_view kind : {kTurnsSharply, kFewTypical})
    if (note.starts_with(kind)) return std::string(kind);
  return note;
}

/// What fairing refused, or did in part; what a target would have taken beyond the tolerance differs for every curve.
std::string fairingNote(const TracedCurve& curve) {
  const FairingReport& report = curve.fairing;
  if (report.note.empty() && !report.withinTolerance)
    return curve.fairingUsed.mode == FairingMode::LowPass
               ? "The tolerance is too small to follow the filtered curvature."
               : "The tolerance is too small to reach the target.";
  return report.note.empty() ? leftAsDrawnReason(curve) : report.note;
}

/// Of what typical chains are made; empty where there are none.
std::string typicalNote(const std::vector<TracedCurve>& curves) {
  std::vector<SegmentNote> segments;
  for (const TracedCurve& curve : curves) {
    if (curve.included)
      segments.insert(segments.end(), curve.construct.segments.begin(), curve.construct.segments.end());
  }
  if (segments.empty()) return {};
  int typical = 0, monotone = 0;
  for (const SegmentNote& segment : segments) {
    typical += segment.typical ? 1 : 0;
    monotone += segment.typical && segment.monotone ? 1 : 0;
  }
  const std::string causes = transitionCauses(segments);
  return counted(typical, "typical curve, ", "typical curves, ") + std::to_string(monotone) +
         " of them monotone, and " +
         counted(static_cast<int>(segments.size()) - typical, "transition; typical: ", "transitions; typical: ") +
         std::to_string(std::lround(100.0 * typicalShare(segments))) + " % of the length" +
         (causes.empty() ? std::string() : "; transitions: " + causes) + ".";
}

std::string constructionLine(const Kind& k) {
  if (k.kind == kFewTypical && k.curves.size() > 1)
    return named(k.curves) + ": Typical curves make less than 60 % of the length; the report has it for each.";
  if (k.kind != kTurnsSharply) return named(k.curves) + ": " + k.note;
  return named(k.curves) + (k.curves.size() == 1 ? " turns" : " turn") +
         " sharply where no corner is marked: add --corner there (suggest lists the places); where the line "
         "trembles, raise construct.detail instead.";
}

}  // namespace

std::vector<std::string> curveNotes(const PipelineOutput& output) {
  std::vector<Kind> constructed, faired;
  for (const TracedCurve& curve : output.faired->curves) {
    if (!curve.included) continue;
    const int number = curveNumber(output, curve);
    add(constructed, kindOf(curve.construct.note), curve.construct.note, number);
    const std::string note = fairingNote(curve);
    add(faired, note, note, number);
  }
  std::vector<std::string> lines;
  const auto more = [](const std::string& count) {
    return count + " more notes on curves are in the report (--report).";
  };
  addNotes(lines, constructed, constructionLine, more);
  if (std::string note = typicalNote(output.faired->curves); !note.empty()) lines.push_back(std::move(note));
  addNotes(
      lines, faired, [](const Kind& k) { return named(k.curves) + ", fairing: " + k.note; }, more);
  return lines;
}

}  // namespace batten::cli
