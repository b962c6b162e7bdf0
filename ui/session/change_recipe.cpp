// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/change_recipe.h"

#include <utility>

#include "ui/session/editor_session.h"

namespace batten {

ChangeRecipe::ChangeRecipe(EditorSession& session, const QString& what, Recipe before, Recipe after, GestureId gesture)
    : QUndoCommand(what), session_(session), before_(std::move(before)), after_(std::move(after)), gesture_(gesture) {}

void ChangeRecipe::undo() { session_.setRecipe(before_); }

void ChangeRecipe::redo() { session_.setRecipe(after_); }

bool ChangeRecipe::mergeWith(const QUndoCommand* later) {
  const auto* next = dynamic_cast<const ChangeRecipe*>(later);
  if (next == nullptr || next->gesture_ != gesture_) return false;
  after_ = next->after_;
  setObsolete(after_ == before_);
  return true;
}

}  // namespace batten
