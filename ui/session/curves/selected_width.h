// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "core/curve/width_profile.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/inbox.h"
#include "ui/session/editor_session.h"

namespace batten {

/// How wide the stroke is whose middle the selected curve is, measured in the background: it takes a moment on a long
/// line. The newest curve wins.
class SelectedWidth : public QObject {
  Q_OBJECT
 public:
  explicit SelectedWidth(const EditorSession& session, QObject* parent = nullptr);
  /// Sees to the figures of the curve that is selected now; changed() follows where they are not known yet.
  void follow();
  /// Nobody looks any more: nothing of the drawing is kept.
  void stop();
  /// True while the figures of the curve followed are being measured.
  bool isPending() const { return asked_ && !isKnown_; }
  /// [mm] Of the curve followed last; absent as long as they are pending, and for lines without a width.
  const std::optional<WidthFigures>& figures() const { return figures_; }

 signals:
  void changed();

 private:
  /// A curve and all that its width comes from.
  struct Asked {
    std::shared_ptr<const Scan> scan;
    PipelineOutput output;
    TracedCurve curve;
    bool isOf(const Asked& other) const;
    bool isStroke() const;
  };
  void take(const std::shared_ptr<const Asked>& of, const std::optional<WidthFigures>& found);

  const EditorSession& session_;
  std::shared_ptr<const Asked> asked_;  ///< Null while nothing is selected, or seen.
  bool isKnown_ = false;
  std::optional<WidthFigures> figures_;
  Inbox inbox_;
  BackgroundWorker worker_;  ///< Last, so that it is joined before anything goes.
};

}  // namespace batten
