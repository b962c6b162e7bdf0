// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <atomic>
#include <optional>
#include <vector>

#include "core/base/cancel_token.h"

namespace batten {

/// Ends the runs of a session that a newer request has overtaken. The one that runs still gets the grace since its
/// start, so that a drag that never pauses shows results all the same. Belongs to the GUI thread, but for runBegins()
/// and runEnds().
class OvertakenRuns {
 public:
  static constexpr int kGraceMs = 150;
  explicit OvertakenRuns(int graceMs = kGraceMs);

  /// In the thread of the runs, where one runs at a time.
  void runBegins() { beganMs_ = clock_.elapsed(); }
  void runEnds() { beganMs_ = kNone; }

  /// A newer request takes the place of this run.
  void add(const CancelToken& token);
  /// The coarse ink of the newest request is seen. It takes the grace where no curves are shown, as an overtaken run
  /// would be seen no sooner. Curves come from the overtaken runs alone, so where there are any these keep it.
  void newerInkIsSeen(bool areCurvesShown);
  /// None of them matters any more: they are left as they are.
  void forget();

 private:
  /// Since when a run goes on; absent while none does.
  std::optional<qint64> beganMs() const;
  void endLate();
  void end();

  static constexpr qint64 kNone = -1;  // no time of a clock; in the same word, so that both change at once
  const int graceMs_;
  QElapsedTimer clock_;
  std::atomic<qint64> beganMs_{kNone};
  QTimer timer_;
  std::vector<CancelToken> tokens_;
};

}  // namespace batten
