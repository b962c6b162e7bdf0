// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/fairing_edits.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/low_pass.h"
#include "ui/session/piece_choice.h"

namespace batten {
namespace {

constexpr int kOpenPoints = 7, kClosedPoints = 8;
/// A split nearer to an end than this share of the length would part nothing.
constexpr double kLeastPart = 5e-3;

QString tr(const char* text) { return QCoreApplication::translate("FairingEdits", text); }

Vec2 placeAt(const EditorSession& session, double fraction) {
  const NurbsCurve& curve = session.selected()->sketched;
  const ArcLength arc(curve);
  return session.output().frame.pointToImage(curve.point(arc.parameter(fraction * arc.total())));
}

void edit(EditorSession& session, const QString& what, int gesture, const std::function<void(PieceChoice&)>& change) {
  Recipe after = withChoice(session, session.selectedCurve(), change);
  std::erase_if(after.choices, [](const PieceChoice& choice) { return choice.isEmpty(); });
  session.change(what, std::move(after), gesture);
}

bool isUsable(const EditorSession& session) {
  const TracedCurve* curve = session.selected();
  return curve && !curve->sketched.isEmpty();
}

std::vector<double> fractionsOf(const EditorSession& session, std::vector<Vec2> PieceChoice::*list) {
  std::vector<double> result;
  const PieceChoice* own = choiceOf(session, session.selectedCurve());
  if (!own || (own->*list).empty() || !isUsable(session)) return result;
  const NurbsCurve& curve = session.selected()->sketched;
  const ArcLength arc(curve);
  for (const Vec2& place : own->*list) {
    result.push_back(arc.at(closestPoint(curve, session.output().frame.pointToModel(place)).u) / arc.total());
  }
  return result;
}

}  // namespace

FairingParams fairingAsked(const EditorSession& session) {
  const auto own = choiceAlong(session, session.selectedCurve());
  return own ? own->fairing(session.recipe().fairing) : session.recipe().fairing;
}

std::vector<double> splitsOf(const EditorSession& session) { return fractionsOf(session, &PieceChoice::splitsPx); }

std::vector<double> keptOf(const EditorSession& session) { return fractionsOf(session, &PieceChoice::keepPx); }

void keepExtremum(EditorSession& session, double fraction) {
  if (!isUsable(session)) return;
  const Vec2 place = placeAt(session, std::clamp(fraction, 0.0, 1.0));
  edit(session, tr("Keep an extremum"), -1, [&](PieceChoice& choice) { choice.keepPx.push_back(place); });
}

void keepByNumber(EditorSession& session) {
  edit(session, tr("Keep extrema by number"), -1, [](PieceChoice& choice) { choice.keepPx.clear(); });
}

void addSplit(EditorSession& session, double fraction) {
  if (!isUsable(session) || fraction < kLeastPart || fraction > 1.0 - kLeastPart) return;
  const Vec2 place = placeAt(session, fraction);
  edit(session, tr("Split the target"), -1, [&](PieceChoice& choice) { choice.splitsPx.push_back(place); });
}

void moveSplit(EditorSession& session, int index, double fraction, int gesture) {
  if (!isUsable(session)) return;
  const Vec2 place = placeAt(session, std::clamp(fraction, kLeastPart, 1.0 - kLeastPart));
  edit(session, tr("Move a split"), gesture, [&](PieceChoice& choice) {
    if (index >= 0 && static_cast<std::size_t>(index) < choice.splitsPx.size()) choice.splitsPx[index] = place;
  });
}

void removeSplit(EditorSession& session, int index) {
  edit(session, tr("Remove a split"), -1, [&](PieceChoice& choice) {
    if (index >= 0 && static_cast<std::size_t>(index) < choice.splitsPx.size())
      choice.splitsPx.erase(choice.splitsPx.begin() + index);
  });
}

void removeSplits(EditorSession& session) {
  edit(session, tr("Remove the splits"), -1, [](PieceChoice& choice) { choice.splitsPx.clear(); });
}

std::vector<double> inflectionsOf(const EditorSession& session) {
  std::vector<double> result;
  const double size = isUsable(session) ? extent(session.selected()->sketched) : 0.0;
  if (!(size > 0.0)) return result;
  const TracedCurve& curve = *session.selected();
  const ArcLength arc(curve.sketched);
  for (const double u : inflections(curve.sketched, kExtremumProminence / size, curve.closed)) {
    const double fraction = arc.at(u) / arc.total();
    if (fraction > kLeastPart && fraction < 1.0 - kLeastPart) result.push_back(fraction);
  }
  return result;
}

void splitAtInflections(EditorSession& session) {
  std::vector<Vec2> places;
  for (const double fraction : inflectionsOf(session)) places.push_back(placeAt(session, fraction));
  if (places.empty()) return;
  edit(session, tr("Split at inflections"), -1, [&](PieceChoice& choice) { choice.splitsPx = places; });
}

bool isSplitOffered(const EditorSession& session) {
  const FairingParams asked = fairingAsked(session);
  if (!isUsable(session) || asked.mode != FairingMode::Target || asked.target == kDrawnTarget) return false;
  const PieceChoice* own = choiceOf(session, session.selectedCurve());
  if (own && !own->splitsPx.empty()) return false;
  const FairingReport& report = session.selected()->fairing;
  return !report.withinTolerance && !inflectionsOf(session).empty();
}

bool isTargetDrawn(const EditorSession& session) {
  const FairingParams asked = fairingAsked(session);
  return asked.mode == FairingMode::Target && asked.target == kDrawnTarget && isUsable(session);
}

std::vector<ProfilePoint> profileToBeginWith(const EditorSession& session) {
  std::vector<ProfilePoint> points;
  if (!isUsable(session)) return points;
  const TracedCurve& curve = *session.selected();
  const FairingParams asked = fairingAsked(session);
  if (asked.target == kDrawnTarget && asked.profile.size() >= 2) return asked.profile;
  const auto targets = session.targets();
  const int degree = asked.target >= 1 && asked.target <= 6 ? asked.target : targets ? targets->recommendedDegree : 0;
  const TargetProfile* target = targets && degree > 0 ? &targets->targets.profiles[degree - 1] : nullptr;
  std::vector<double> sketch;
  const int count = curve.closed ? kClosedPoints : kOpenPoints;
  constexpr int kSamples = 400;
  if (!target || !target->valid) {
    for (const CurveSample& one : sampleByArcLength(curve.sketched, kSamples + 1)) sketch.push_back(one.kappa);
    if (curve.closed) sketch.pop_back();
    sketch = lowPass(sketch, 1.0 / kSamples, 2.0 / count, curve.closed);
  }
  for (int i = 0; i < count; ++i) {
    const double f = static_cast<double>(i) / (curve.closed ? count : count - 1);
    const auto at =
        std::min(static_cast<std::size_t>(std::lround(f * kSamples)), sketch.empty() ? 0 : sketch.size() - 1);
    points.push_back({f, sketch.empty() ? target->curvatureAt(f) : sketch[at]});
  }
  return points;
}

void drawTarget(EditorSession& session, std::vector<ProfilePoint> profile, int gesture) {
  if (!isUsable(session) || validateProfile(profile) || profile.empty()) return;
  edit(session, tr("Draw the target"), gesture, [&](PieceChoice& choice) {
    choice.mode = FairingMode::Target;
    choice.target = kDrawnTarget;
    choice.profile = std::move(profile);
  });
}

void forgetDrawnTarget(EditorSession& session) {
  const bool isCommon = session.recipe().fairing.target == kDrawnTarget;
  edit(session, tr("Forget the drawn target"), -1, [isCommon](PieceChoice& choice) {
    choice.profile.clear();
    if (isCommon || choice.target == kDrawnTarget) choice.target = 0;
  });
}

}  // namespace batten
