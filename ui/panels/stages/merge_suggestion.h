// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <optional>

#include "core/pipeline/run/merge_advice.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/inbox.h"
#include "ui/session/editor_session.h"

class QLabel;
class QPushButton;

namespace batten {

/// A button that asks the drawing how far its strokes are to be merged, sets that, and says why; where lines were
/// drawn over more than once, a second button turns edges.intent on. Works in the
/// background; while it does, a change of the lines makes it look anew, and Esc stops it.
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
  void showOffer();               ///< Of edges.intent, while the note says that it would find curves.

  EditorSession& session_;
  QLabel* note_;
  QPushButton* ask_;
  QPushButton* offer_;
  /// What the note is about: it holds no longer than both.
  struct Said {
    ContentHash key;
    double strength = 0.0;
    bool isMeant = false;  ///< Lines drawn over more than once were found.
  };
  std::optional<ContentHash> asked_;  ///< mergeAdviceKey() of what is being looked at.
  std::optional<Said> said_;          ///< None: the note says what the button is for, or that it is looking.
  Inbox inbox_;
  BackgroundWorker worker_;  ///< Last, so that it is joined before anything goes.
};

}  // namespace batten
