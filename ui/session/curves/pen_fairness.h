// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "core/contour/pen_strokes.h"
#include "core/fairing/curve_fairness.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/inbox.h"
#include "ui/session/editor_session.h"

namespace batten {

/// How fair the curve of a line is that the pen is drawing: made in the background from what there is of it. The newest
/// line wins; a run that is under way is finished first, so that there is something to see while the pen moves.
class PenFairness : public QObject {
  Q_OBJECT
 public:
  explicit PenFairness(const EditorSession& session, QObject* parent = nullptr);
  /// The line as far as it is drawn. [image px]
  void follow(PenStroke stroke);
  /// The line has ended: what is still on its way is not told.
  void stop();
  /// Of the line that is being drawn, as last known.
  const std::optional<CurveFairness>& latest() const { return latest_; }

 signals:
  void changed();

 private:
  const EditorSession& session_;
  std::optional<CurveFairness> latest_;
  int line_ = 0;  ///< Lines ended so far.
  Inbox inbox_;
  BackgroundWorker worker_;  ///< Last, so that it is joined before anything goes.
};

}  // namespace batten
