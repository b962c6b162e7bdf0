// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <memory>
#include <optional>
#include <vector>

#include "core/pipeline/run/segment_points.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/inbox.h"

namespace batten {

class EditorSession;

/// Plays how the typical chain of the selected curve grows (002 figures 3 and 5): the steps are computed behind the
/// window on request and shown one by one. Belongs to the GUI thread; never waits.
class GrowingPlayer : public QObject {
  Q_OBJECT
 public:
  explicit GrowingPlayer(EditorSession& session);

  /// Computes the steps of the selected curve; `changed` follows.
  void open();
  void close();
  bool isOpen() const { return isOpen_; }
  bool isComputing() const { return isOpen_ && !steps_ && problem_.isEmpty(); }
  QString problem() const { return problem_; }
  int stepCount() const { return steps_ ? static_cast<int>(steps_->size()) : 0; }
  /// The step shown, 0..stepCount() - 1; none while there are none.
  std::optional<int> step() const { return step_; }
  const std::vector<GrowingStep>* steps() const { return steps_.get(); }
  /// Bounded to the steps there are.
  void setStep(int step);
  /// So many steps on, or back where negative.
  void stepBy(int steps) { setStep(step_.value_or(0) + steps); }
  bool isPlaying() const { return timer_.isActive(); }
  void setPlaying(bool playing);

 signals:
  void changed();

 private:
  void compute();
  /// Whether steps follow the one shown.
  bool isMore() const { return step_ && *step_ + 1 < stepCount(); }
  void take(std::uint64_t request, std::shared_ptr<const std::vector<GrowingStep>> steps, const QString& problem);

  EditorSession& session_;
  /// What the steps follow from.
  struct Source {
    std::shared_ptr<const PieceSet> pieces;
    std::shared_ptr<const SegmentSet> segments;
    ConstructParams params;
    std::vector<SegmentPoint> segmentPoints;
    std::optional<int> piece;
    bool operator==(const Source&) const = default;
  };
  std::optional<Source> source_;
  std::shared_ptr<const std::vector<GrowingStep>> steps_;
  QString problem_;
  bool isOpen_ = false;
  std::optional<int> step_;
  std::uint64_t newest_ = 0;
  QTimer timer_;
  Inbox inbox_;
  BackgroundWorker worker_;
};

}  // namespace batten
