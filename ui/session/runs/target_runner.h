// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "core/fairing/fairing.h"
#include "core/pipeline/run/pipeline.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/inbox.h"

namespace batten {

/// Computes the six targets of one curve in the background. Belongs to the GUI thread; the newest request wins.
class TargetRunner {
 public:
  /// `show` is called in the GUI thread with what the newest request found, null where it failed, as long as `inbox`
  /// lives.
  using Show = std::function<void(std::shared_ptr<const TargetOutcomes>)>;
  TargetRunner(Inbox& inbox, Show show) : inbox_(inbox), show_(std::move(show)) {}

  /// False, and nothing happens, where just these outcomes are computed or shown already.
  /// @param span whose targets, by a place in it as a share of the arc length; none: of the whole curve
  bool start(const TracedCurve& curve, const std::optional<double>& span);
  /// Stops what is computed; outcomes that are there already stay known.
  void cancel();
  /// Stops what is computed and forgets whose outcomes are shown.
  void stop();
  /// The next start() computes, whatever is shown.
  void forget() { curve_.reset(); }
  bool isComputing() const { return isComputing_; }
  /// True while a thread still runs a job, even a cancelled one.
  bool isRunning() const { return worker_.isRunning(); }
  /// Whether the outcomes that are computed or shown are those of this curve.
  bool isOf(const TracedCurve& curve) const { return curve_ && *curve_ == curve.sketched; }
  /// Whether the curve differs in length from the one whose outcomes are shown by more than a change of settings does.
  bool isLikeAnother(const TracedCurve& curve) const;

 private:
  void apply(std::uint64_t id, std::shared_ptr<const TargetOutcomes> outcomes, double lengthMm);

  Inbox& inbox_;
  Show show_;
  std::optional<NurbsCurve> curve_;  ///< Whose outcomes are computed or shown.
  FairingParams params_;
  std::optional<double> span_;
  double shownLengthMm_ = 0.0;  ///< Of the curve whose outcomes are shown.
  std::uint64_t newest_ = 0;
  bool isComputing_ = false;
  BackgroundWorker worker_;  ///< Last: joined before what its jobs use goes away.
};

}  // namespace batten
