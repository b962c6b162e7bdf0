// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <optional>

#include "core/pipeline/merge_advice.h"
#include "ui/session/background_worker.h"
#include "ui/session/editor_session.h"

class QLabel;
class QPushButton;

namespace batten {

/// A button that asks the drawing how far its strokes are to be merged, sets that, and says why. Works in the
/// background; while it does, a change of the recipe makes it look anew, and Esc stops it.
class MergeSuggestion : public QWidget {
  Q_OBJECT
 public:
  explicit MergeSuggestion(EditorSession& session, QWidget* parent = nullptr);

 private:
  void look();
  void stop();
  void follow();
  void take(const Result<MergeAdvice>& advice);
  void say(const QString& text);  ///< Nothing: what the button is for.

  EditorSession& session_;
  QLabel* note_;
  QPushButton* ask_;
  std::optional<Recipe> asked_;  ///< What is being looked at; merging left out.
  double said_ = -1.0;           ///< The strength that the note speaks of; -1: none.
  BackgroundWorker worker_;      ///< Last, so that it is joined before anything goes.
};

}  // namespace batten
