// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QUndoCommand>

#include "ui/session/gesture_id.h"

namespace batten {

class ViewSettings;

/// What corners are suggested by. No part of the recipe, as it changes no curve, but set like any other value.
struct SuggestionSettings {
  double angleDeg = 0.0, scalePx = 0.0;
  bool operator==(const SuggestionSettings&) const = default;
};
SuggestionSettings suggestionSettings(const ViewSettings&);

/// The undoable change of them, in one order with the changes of the recipe. Those of one gesture merge.
class ChangeSuggestions final : public QUndoCommand {
 public:
  ChangeSuggestions(ViewSettings& view, const QString& what, const SuggestionSettings& after, GestureId gesture);
  void undo() override;
  void redo() override;
  int id() const override;
  bool mergeWith(const QUndoCommand* later) override;

 private:
  void set(const SuggestionSettings&);

  ViewSettings& view_;
  SuggestionSettings before_, after_;
  GestureId gesture_;
};

}  // namespace batten
