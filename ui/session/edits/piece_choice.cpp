// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/edits/piece_choice.h"

#include <QCoreApplication>

#include "core/pipeline/run/choice_course.h"
#include "core/pipeline/run/piece_choices.h"
#include "ui/session/curve_piece.h"
#include "ui/session/edits/fairing_edits.h"

namespace batten {
namespace {

QString choiceText(const char* text) { return QCoreApplication::translate("PieceChoice", text); }

}  // namespace

const PieceChoice* choiceOf(const EditorSession& session, std::optional<int> curve) {
  const auto piece = pieceOf(session, curve);
  if (!piece) return nullptr;
  const auto index = session.choiceOwners().ofPiece[*piece];
  return index ? &session.recipe().choices[*index] : nullptr;
}

std::optional<PieceChoice> choiceAlong(const EditorSession& session, std::optional<int> curve) {
  const PieceChoice* choice = choiceOf(session, curve);
  if (!choice) return std::nullopt;
  return alongPiece(*choice, session.output().pieces->pieces[*pieceOf(session, curve)]);
}

bool hasOwnFairing(const EditorSession& session, std::optional<int> curve) {
  const PieceChoice* choice = choiceOf(session, curve);
  return choice && choice->hasFairing();
}

Recipe withChoice(const EditorSession& session, std::optional<int> curve,
                  const std::function<void(PieceChoice&)>& edit) {
  Recipe after = session.recipe();
  if (const auto piece = pieceOf(session, curve))
    edit(after.choices[makeOwnChoice(after.choices, *session.output().pieces, *piece)]);
  return after;
}

bool choosesForOneCurve(const EditorSession& session) {
  return session.curves().size() > 1 && pieceOf(session, session.selectedCurve()).has_value();
}

void chooseTarget(EditorSession& session, FairingTarget target) {
  const auto degree = degreeOf(target);
  if (session.pointedSpan() && degree) return chooseSpanTarget(session, *degree);
  Recipe after = session.recipe();
  if (choosesForOneCurve(session)) {
    after = withChoice(session, session.selectedCurve(), [target](PieceChoice& choice) {
      choice.mode = FairingMode::Target;
      choice.target = target;
      choice.spanTargets.clear();
    });
  } else {
    after.fairing.mode = FairingMode::Target;
    after.fairing.target = target;
    // An only curve must not keep an older choice of its own that would win over this one.
    if (session.curves().size() == 1 && hasOwnFairing(session, 0))
      for (PieceChoice& choice : after.choices) choice.mode.reset(), choice.target.reset(), choice.spanTargets.clear();
  }
  session.change(degree ? choiceText("Target %1").arg(*degree) : choiceText("Log-aesthetic target"), std::move(after));
}

void setIncluded(EditorSession& session, int curve, bool included) {
  session.change(included ? choiceText("Include curve") : choiceText("Exclude curve"),
                 withChoice(session, curve, [included](PieceChoice& choice) { choice.included = included; }));
}

void forgetWaitingChoices(EditorSession& session) {
  Recipe after = session.recipe();
  const std::vector<std::size_t> waiting = session.choiceOwners().waiting;
  for (auto choice = waiting.rbegin(); choice != waiting.rend(); ++choice)
    after.choices.erase(after.choices.begin() + static_cast<std::ptrdiff_t>(*choice));
  session.change(choiceText("Forget choices"), std::move(after));
}

}  // namespace batten
