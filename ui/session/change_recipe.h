// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QUndoCommand>

#include "core/pipeline/recipe/recipe.h"
#include "ui/session/gesture_id.h"

namespace batten {

class EditorSession;

/// The one undoable change there is: it stores the recipe before and after, so undo restores values and recomputes
/// nothing itself. Changes of one gesture merge; a gesture that ends where it began leaves no trace.
class ChangeRecipe final : public QUndoCommand {
 public:
  ChangeRecipe(EditorSession& session, const QString& what, Recipe before, Recipe after, GestureId gesture);
  void undo() override;
  void redo() override;
  /// Qt merges no commands whose id is -1.
  int id() const override { return gesture_.value_or(-1); }
  bool mergeWith(const QUndoCommand* later) override;

 private:
  EditorSession& session_;
  Recipe before_, after_;
  GestureId gesture_;
};

}  // namespace batten
