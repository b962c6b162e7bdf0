// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/curves/extremum_marks.h"

#include <QCoreApplication>
#include <cmath>
#include <utility>

#include "core/curve/curvature.h"

namespace batten {
namespace {

constexpr double kCertainFactor = 5.0;  // of the cost that an extremum must have to be kept
constexpr double kDoubtfulShare = 0.5;  // of that cost: what costs less is noise
constexpr double kSameMarkPx = 1.0;     // nearer marks are one
constexpr double kMostShift = 0.02;     // of the curve's length, by which fewer control points move an extremum
QString extremumText(const char* text) { return QCoreApplication::translate("ExtremumMarks", text); }

/// The choice in the recipe that a note stands for. While a new run is on its way the numbers in the report are those
/// of the recipe before; then the place counts.
std::optional<std::size_t> choiceOf(const EditorSession& session, const ExtremumNote& note) {
  const auto& choices = session.recipe().extremumChoices;
  if (!session.isStale(StageId::Curves)) {
    if (!note.constraint || *note.constraint < 0 || *note.constraint >= std::ssize(choices)) return std::nullopt;
    return *note.constraint;
  }
  const Vec2 px = session.output().frame.pointToImage(note.point);
  for (std::size_t i = 0; i < choices.size(); ++i)
    if ((choices[i].positionPx - px).norm() < kSameMarkPx) return i;
  return std::nullopt;
}

QString textOf(const ExtremumMark& mark, const ExtremumNote& note) {
  // Seen along the line, whichever way it runs: where it bends most, or least.
  const bool isPeak = note.maximum == (note.kappa > 0.0);
  QString text = isPeak ? extremumText("Curvature maximum") : extremumText("Curvature minimum");
  const auto rounded = [](double cost) { return QString::number(cost, 'f', cost < 9.95 ? 1 : 0); };
  const QString significance =
      extremumText(" (significance %1, %2 asked)").arg(rounded(note.removalCost), rounded(note.askedCost));
  text += QStringLiteral(" · ");
  if (note.kept) {
    text += (mark.isCertain                       ? extremumText("certain")
             : note.removalCost >= note.askedCost ? extremumText("probable")
                                                  : extremumText("not certain")) +
            significance;
  } else {
    text += (note.removalCost >= note.askedCost                    ? extremumText("drawn, but removed")
             : note.removalCost >= kDoubtfulShare * note.askedCost ? extremumText("doubtful, dropped")
                                                                   : extremumText("noise, dropped")) +
            significance;
  }
  if (mark.wantedToKeep) {
    text += *mark.wantedToKeep == note.kept
                ? (note.kept ? extremumText(" · kept by you") : extremumText(" · removed by you"))
                : extremumText(" · cannot be changed: a closed curve has at least four");
    return text + extremumText(". Click to let the program decide.");
  }
  return text + (note.kept ? extremumText(". Click to remove it.") : extremumText(". Click to keep it."));
}

/// The extrema of a curve as its figures count them.
std::vector<CurvatureExtremumPoint> extremaOf(const NurbsCurve& curve, bool closed) {
  const double size = extent(curve);
  if (!(size > 0.0)) return {};
  return curvatureExtrema(curve, kExtremumProminence / size, closed);
}

std::vector<ExtremumMark> marksOf(const EditorSession& session, const NurbsCurve& curve, bool closed, bool isFaired) {
  std::vector<ExtremumMark> marks;
  for (const CurvatureExtremumPoint& one : extremaOf(curve, closed)) {
    ExtremumMark mark;
    mark.px = session.output().frame.pointToImage(curve.point(one.u));
    mark.s = one.s;
    mark.kappa = one.kappa;
    const bool isPeak = one.maximum == (one.kappa > 0.0);
    mark.text = isPeak     ? isFaired ? extremumText("Curvature maximum of the faired curve.")
                                      : extremumText("Curvature maximum of the curve.")
                    : isFaired ? extremumText("Curvature minimum of the faired curve.")
                           : extremumText("Curvature minimum of the curve.");
    marks.push_back(std::move(mark));
  }
  return marks;
}

/// The extremum of the curve as it is shown that a kept one became: its place was judged on the dense curve.
std::optional<CurvatureExtremumPoint> shownExtremum(const std::vector<CurvatureExtremumPoint>& shown,
                                                    const ExtremumNote& note, double lengthMm) {
  std::optional<CurvatureExtremumPoint> nearest;
  double leastMm = kMostShift * lengthMm;
  for (const CurvatureExtremumPoint& one : shown) {
    const double apartMm = std::abs(one.s - note.s);
    if (one.maximum != note.maximum || (one.kappa > 0.0) != (note.kappa > 0.0) || apartMm > leastMm) continue;
    leastMm = apartMm;
    nearest = one;
  }
  return nearest;
}

}  // namespace

std::vector<ExtremumMark> extremumMarks(const EditorSession& session, std::optional<int> curve, Judged judged) {
  const TracedCurve* traced = session.curveAt(curve);
  if (!traced) return {};
  if (judged == Judged::Result && isChanged(*traced)) return marksOf(session, traced->faired, traced->closed, true);
  // Only the fair fit judges extrema; of all other curves they are shown as they are.
  if (traced->construct.extrema.empty()) return marksOf(session, traced->sketched, traced->closed, false);
  const NurbsCurve& sketched = traced->sketched;
  const std::vector<CurvatureExtremumPoint> shown = extremaOf(sketched, traced->closed);
  std::vector<ExtremumMark> marks;
  for (std::size_t i = 0; i < traced->construct.extrema.size(); ++i) {
    const ExtremumNote& note = traced->construct.extrema[i];
    if (!note.point.allFinite() || !std::isfinite(note.kappa)) continue;
    ExtremumMark mark;
    mark.note = static_cast<int>(i);
    mark.px = session.output().frame.pointToImage(note.point);
    mark.s = note.s;
    mark.kappa = note.kappa;
    const auto seen = note.kept ? shownExtremum(shown, note, traced->sketchedFigures.lengthMm) : std::nullopt;
    if (seen) {
      mark.px = session.output().frame.pointToImage(sketched.point(seen->u));
      mark.s = seen->s;
      mark.kappa = seen->kappa;
    }
    mark.isKept = note.kept;
    mark.isCertain = note.kept && note.removalCost >= kCertainFactor * note.askedCost;
    if (const auto choice = choiceOf(session, note)) mark.wantedToKeep = session.recipe().extremumChoices[*choice].keep;
    mark.text = textOf(mark, note);
    marks.push_back(std::move(mark));
  }
  return marks;
}

void toggleExtremum(EditorSession& session, std::optional<int> curve, int note) {
  const TracedCurve* traced = session.curveAt(curve);
  if (!traced || note < 0 || note >= std::ssize(traced->construct.extrema)) return;
  const ExtremumNote& extremum = traced->construct.extrema[note];
  Recipe after = session.recipe();
  if (const auto choice = choiceOf(session, extremum)) {
    after.extremumChoices.erase(after.extremumChoices.begin() + static_cast<std::ptrdiff_t>(*choice));
    session.change(extremumText("Reset extremum to automatic"), std::move(after));
    return;
  }
  after.extremumChoices.push_back({session.output().frame.pointToImage(extremum.point), !extremum.kept});
  session.change(extremum.kept ? extremumText("Remove extremum") : extremumText("Keep extremum"), std::move(after));
}

}  // namespace batten
