// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <memory>
#include <vector>

#include "core/contour/corner/corner_marks.h"
#include "core/contour/corner/corner_suggestions.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/inbox.h"

namespace batten {

class EditorSession;

/// Places that could be corners, found in the background for whoever shows them: drawing and list see the same.
/// Belongs to the GUI thread.
class SuggestionSource : public QObject {
  Q_OBJECT
 public:
  explicit SuggestionSource(EditorSession& session);
  /// Looks for turns of at least this, over this length on either side, in the present lines, unless that is what was
  /// found; `changed` follows.
  void look(double angleDeg, double scalePx);
  const std::vector<CornerSuggestion>& found() const { return found_; }

 signals:
  void changed();

 private:
  EditorSession& session_;
  std::shared_ptr<const ContourSet> of_;
  double angleDeg_ = 0.0, scalePx_ = 0.0, snapPx_ = 0.0;
  std::vector<CornerSuggestion> found_;
  Inbox inbox_;
  BackgroundWorker worker_;
};

}  // namespace batten
