// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <optional>

#include "core/pipeline/run/pipeline.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/inbox.h"

namespace batten {

/// Tries in the background whether a tolerance is enough for what a curve is asked: within a larger one other spans, or
/// another curve with fewer extrema, may be taken, and the target be missed again. Belongs to the GUI thread.
class ToleranceOffer : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;
  /// The curve and the tolerance that are in question now; none: nothing is.
  void ask(const TracedCurve* curve, std::optional<double> toleranceMm);
  /// The tolerance in question, once it is known to be enough.
  std::optional<double> enough() const { return isEnough_ ? askedMm_ : std::nullopt; }
  /// It is not known yet whether the tolerance in question is enough.
  bool isTrying() const { return isTrying_; }

 signals:
  void changed();

 private:
  NurbsCurve curve_;      ///< Of which `askedMm_` is asked,
  FairingParams params_;  ///< and as it is faired now.
  std::optional<double> askedMm_;
  bool isEnough_ = false, isTrying_ = false;
  int request_ = 0;
  Inbox inbox_;
  BackgroundWorker worker_;  ///< Last: joined before what its jobs use goes away.
};

}  // namespace batten
