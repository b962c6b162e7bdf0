// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QUndoCommand>

#include "core/pipeline/recipe/recipe.h"

namespace batten {

class EditorSession;

/// The one undoable change there is: it stores the recipe before and after, so undo restores values and recomputes
/// nothing itself. Changes of one gesture (>= 0) merge; a gesture that ends where it began leaves no trace.
class ChangeRecipe final : public QUndoCommand {
 public:
  ChangeRecipe(EditorSession& session, const QString& what, Recipe before, Recipe after, int gesture);
  void undo() override;
  void redo() override;
  int id() const override { return gesture_; }
  bool mergeWith(const QUndoCommand* later) override;

 private:
  EditorSession& session_;
  Recipe before_, after_;
  int gesture_;
};

}  // namespace batten
