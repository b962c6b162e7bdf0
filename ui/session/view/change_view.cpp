// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/view/change_view.h"

#include "ui/session/view/view_settings.h"

namespace batten {

SuggestionSettings suggestionSettings(const ViewSettings& view) {
  return {view.suggestionAngleDeg(), view.suggestionScalePx()};
}

ChangeSuggestions::ChangeSuggestions(ViewSettings& view, const QString& what, const SuggestionSettings& after,
                                     GestureId gesture)
    : QUndoCommand(what), view_(view), before_(suggestionSettings(view)), after_(after), gesture_(gesture) {}

void ChangeSuggestions::set(const SuggestionSettings& settings) {
  view_.setSuggestionAngleDeg(settings.angleDeg);
  view_.setSuggestionScalePx(settings.scalePx);
}

void ChangeSuggestions::undo() { set(before_); }

void ChangeSuggestions::redo() { set(after_); }

// Qt merges no commands whose id is -1.
int ChangeSuggestions::id() const { return gesture_.value_or(-1); }

bool ChangeSuggestions::mergeWith(const QUndoCommand* later) {
  const auto* next = dynamic_cast<const ChangeSuggestions*>(later);
  if (next == nullptr || next->gesture_ != gesture_) return false;
  after_ = next->after_;
  setObsolete(after_ == before_);
  return true;
}

}  // namespace batten
