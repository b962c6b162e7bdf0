// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/edits/fairing_edits.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/followed_target.h"
#include "core/fairing/profile/profile_points.h"
#include "core/fairing/profile/target_degrees.h"
#include "core/fairing/target/low_pass.h"
#include "core/fairing/target/natural_spans.h"
#include "ui/session/edits/piece_choice.h"

namespace batten {
namespace {

/// Even points on the smoothed curvature of a sketch without a target.
constexpr int kOpenPoints = 7, kClosedPoints = 8;
/// Of the tolerance: beginning to draw moves the curve by no more than this.
constexpr double kStillShare = 0.05;
/// A split nearer to an end than this share of the length would part nothing.
constexpr double kLeastPart = 5e-3;

QString tr(const char* text) { return QCoreApplication::translate("FairingEdits", text); }

Vec2 placeAt(const EditorSession& session, double fraction) {
  const NurbsCurve& curve = session.selected()->sketched;
  const ArcLength arc(curve);
  return session.output().frame.pointToImage(curve.point(arc.parameter(fraction * arc.total())));
}

void edit(EditorSession& session, const QString& what, GestureId gesture,
          const std::function<void(PieceChoice&)>& change) {
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

std::vector<double> splitsOf(const EditorSession& session) {
  std::vector<double> own = fractionsOf(session, &PieceChoice::splitsPx);
  if (!own.empty() || !isUsable(session)) return own;
  const TracedCurve& curve = *session.selected();
  FairingParams asked = fairingAsked(session);
  asked.targets.splits.clear();
  return session.knownSplits().of(curve.fairingStart(), curve.closed, asked);
}

std::vector<double> keptOf(const EditorSession& session) { return fractionsOf(session, &PieceChoice::keepPx); }

void keepExtremum(EditorSession& session, double fraction) {
  if (!isUsable(session)) return;
  const Vec2 place = placeAt(session, std::clamp(fraction, 0.0, 1.0));
  edit(session, tr("Keep an extremum"), {}, [&](PieceChoice& choice) { choice.keepPx.push_back(place); });
}

void keepByNumber(EditorSession& session) {
  edit(session, tr("Keep extrema by number"), {}, [](PieceChoice& choice) { choice.keepPx.clear(); });
}

namespace {

/// Edits the splits as places; natural ones become the user's.
void editSplits(EditorSession& session, const QString& what, GestureId gesture,
                const std::function<void(std::vector<Vec2>&)>& change) {
  if (!isUsable(session)) return;
  std::vector<Vec2> places;
  const PieceChoice* own = choiceOf(session, session.selectedCurve());
  if (own && !own->splitsPx.empty()) {
    places = own->splitsPx;
  } else {
    for (const double f : splitsOf(session)) places.push_back(placeAt(session, f));
  }
  change(places);
  edit(session, what, gesture, [&](PieceChoice& choice) {
    choice.splitsPx = places;
    // Without splits the natural ones would be back.
    if (places.empty()) choice.spans = TargetSpans::Whole;
  });
}

}  // namespace

void addSplit(EditorSession& session, double fraction) {
  if (!isUsable(session) || fraction < kLeastPart || fraction > 1.0 - kLeastPart) return;
  const Vec2 place = placeAt(session, fraction);
  editSplits(session, tr("Split the target"), {}, [&](std::vector<Vec2>& places) { places.push_back(place); });
}

void moveSplit(EditorSession& session, int index, double fraction, GestureId gesture) {
  if (!isUsable(session)) return;
  const Vec2 place = placeAt(session, std::clamp(fraction, kLeastPart, 1.0 - kLeastPart));
  editSplits(session, tr("Move a split"), gesture, [&](std::vector<Vec2>& places) {
    if (index >= 0 && index < std::ssize(places)) places[index] = place;
  });
}

void joinAtSplit(EditorSession& session, int index) {
  editSplits(session, tr("Join two spans"), {}, [&](std::vector<Vec2>& places) {
    if (index >= 0 && index < std::ssize(places)) places.erase(places.begin() + index);
  });
}

void joinAllSpans(EditorSession& session) {
  session.pointAtSpan({});
  edit(session, tr("Join all spans"), {}, [](PieceChoice& choice) {
    choice.splitsPx.clear();
    choice.spanTargets.clear();
    choice.spans = TargetSpans::Whole;
  });
}

void splitNaturally(EditorSession& session) {
  const bool isCommon = session.recipe().fairing.targets.spans == TargetSpans::Natural;
  edit(session, tr("Natural spans"), {}, [isCommon](PieceChoice& choice) {
    choice.splitsPx.clear();
    choice.spans = isCommon ? std::nullopt : std::optional(TargetSpans::Natural);
  });
}

bool hasNaturalSpans(const EditorSession& session) {
  const PieceChoice* own = choiceOf(session, session.selectedCurve());
  return !(own && !own->splitsPx.empty()) && fairingAsked(session).targets.spans == TargetSpans::Natural;
}

void pointAtSpanNear(EditorSession& session, const Vec2& px) {
  if (!isUsable(session)) return;
  const TracedCurve& curve = *session.selected();
  const ArcLength arc(curve.sketched);
  const double share = arc.at(closestPoint(curve.sketched, session.output().frame.pointToModel(px)).u) / arc.total();
  std::vector<double> splits = splitsOf(session);
  std::sort(splits.begin(), splits.end());
  const auto spanOf = [&](double at) { return spanBetween(splits, at, curve.closed); };
  const bool isOne = splits.empty() || (curve.closed && splits.size() < 2);
  const bool again = session.pointedSpan() && spanOf(*session.pointedSpan()) == spanOf(share);
  session.pointAtSpan(isOne || again ? std::nullopt : std::optional(share));
}

void chooseSpanTarget(EditorSession& session, int degree) {
  const auto share = session.pointedSpan();
  if (!isUsable(session) || !share || !isTargetDegree(degree)) return;
  const TracedCurve& curve = *session.selected();
  std::vector<double> splits = splitsOf(session);
  std::sort(splits.begin(), splits.end());
  const ProfileSpan span = spanBetween(splits, *share, curve.closed);
  const ArcLength arc(curve.sketched);
  const auto isThere = [&](const SpanChoice& one) {
    const Vec2 mm = session.output().frame.pointToModel(one.placePx);
    return spanBetween(splits, arc.at(closestPoint(curve.sketched, mm).u) / arc.total(), curve.closed) == span;
  };
  // The middle of the span stays in it when its ends move a little.
  const double middle = 0.5 * (span.from + span.to);
  const SpanChoice chosen{placeAt(session, middle > 1.0 ? middle - 1.0 : middle), degree};
  // What the whole curve follows, its other spans go on following.
  const FairingParams asked = fairingAsked(session);
  std::vector<SpanChoice> others;
  const auto whole = asked.mode == FairingMode::Target ? degreeOf(asked.target) : std::nullopt;
  if (whole && curve.fairingUsed.spanTargets.empty()) {
    std::vector<double> borders = splits;
    if (!curve.closed) borders.insert(borders.begin(), 0.0), borders.push_back(1.0);
    if (curve.closed) borders.push_back(splits.front() + 1.0);
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
      const double at = 0.5 * (borders[i] + borders[i + 1]);
      others.push_back({placeAt(session, at > 1.0 ? at - 1.0 : at), *whole});
    }
  }
  edit(session, tr("Target %1 of a span").arg(degree), {}, [&](PieceChoice& choice) {
    choice.mode = FairingMode::Target;
    if (choice.spanTargets.empty()) choice.spanTargets = others;
    if (choice.target == FairingTarget::Drawn || session.recipe().fairing.target == FairingTarget::Drawn)
      choice.target = FairingTarget::Recommended;
    std::erase_if(choice.spanTargets, isThere);
    choice.spanTargets.push_back(chosen);
  });
}

std::optional<int> chosenSpanTarget(const EditorSession& session) {
  const TracedCurve* curve = session.selected();
  if (!curve || !session.pointedSpan() || fairingAsked(session).mode != FairingMode::Target) return std::nullopt;
  std::vector<double> splits = splitsOf(session);
  std::sort(splits.begin(), splits.end());
  const ProfileSpan span = spanBetween(splits, *session.pointedSpan(), curve->closed);
  std::optional<int> degree;
  for (const SpanTarget& one : curve->fairingUsed.spanTargets)
    if (spanBetween(splits, one.at, curve->closed) == span) degree = one.degree;
  return degree;
}

bool isTargetDrawn(const EditorSession& session) {
  const FairingParams asked = fairingAsked(session);
  return asked.mode == FairingMode::Target && asked.target == FairingTarget::Drawn && isUsable(session);
}

namespace {

struct TargetOnCurve {
  TargetProfile profile;
  std::vector<double> splits;
};

/// The target that the selected curve follows, or that it would follow; none where there is none yet.
std::optional<TargetOnCurve> targetOn(const EditorSession& session, const FairingParams& asked) {
  const TracedCurve& curve = *session.selected();
  const FairingParams& used = curve.fairingUsed;
  const bool isFollowed =
      asked.mode == FairingMode::Target && used.mode == FairingMode::Target && used.target == asked.target;
  const auto targets = session.targets();
  const bool isOneOfSix = isPolynomial(asked.target) && !(isFollowed && !used.spanTargets.empty());
  if (targets && !targets->span && isOneOfSix) {
    std::optional<int> degree = degreeOf(asked.target);
    if (!degree && isFollowed) degree = curve.fairing.targetDegree;
    if (!degree) degree = targets->recommendedDegree;
    if (degree && targets->targets.profiles[*degree - 1].valid)
      return TargetOnCurve{targets->targets.profiles[*degree - 1], targets->splits};
  }
  if (!isFollowed) return std::nullopt;
  auto followed = followedTarget(curve.fairingStart(), curve.closed, used, curve.fairing);
  if (!followed || !followed->valid) return std::nullopt;
  return TargetOnCurve{std::move(*followed), curve.fairing.targetSplits};
}

}  // namespace

std::vector<ProfilePoint> profileToBeginWith(const EditorSession& session) {
  std::vector<ProfilePoint> points;
  if (!isUsable(session)) return points;
  const TracedCurve& curve = *session.selected();
  const FairingParams asked = fairingAsked(session);
  if (asked.target == FairingTarget::Drawn && asked.profile.size() >= 2) return asked.profile;
  if (const auto target = targetOn(session, asked))
    return pointsAlong(target->profile, target->splits, curve.closed, ArcLength(curve.sketched).total(),
                       kStillShare * asked.toleranceMm);
  std::vector<double> sketch;
  const int count = curve.closed ? kClosedPoints : kOpenPoints;
  constexpr int kSamples = 400;  // along the sketch
  for (const CurveSample& one : sampleByArcLength(curve.sketched, kSamples + 1)) sketch.push_back(one.kappa);
  if (curve.closed) sketch.pop_back();
  sketch = lowPass(sketch, 1.0 / kSamples, 2.0 / count, curve.closed);
  for (int i = 0; i < count; ++i) {
    const double f = static_cast<double>(i) / (curve.closed ? count : count - 1);
    const auto at = std::min<std::size_t>(std::lround(f * kSamples), sketch.size() - 1);
    points.push_back({f, sketch[at]});
  }
  return points;
}

void drawTarget(EditorSession& session, std::vector<ProfilePoint> profile, GestureId gesture) {
  if (!isUsable(session) || validateProfile(profile) || profile.empty()) return;
  edit(session, tr("Draw the target"), gesture, [&](PieceChoice& choice) {
    choice.mode = FairingMode::Target;
    choice.target = FairingTarget::Drawn;
    choice.profile = std::move(profile);
  });
}

void forgetDrawnTarget(EditorSession& session) {
  const bool isCommon = session.recipe().fairing.target == FairingTarget::Drawn;
  edit(session, tr("Forget the drawn target"), {}, [isCommon](PieceChoice& choice) {
    choice.profile.clear();
    if (isCommon || choice.target == FairingTarget::Drawn) choice.target = FairingTarget::Recommended;
  });
}

}  // namespace batten
