// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/runs/overtaken_runs.h"

namespace batten {

OvertakenRuns::OvertakenRuns(int graceMs) : graceMs_(graceMs) {
  clock_.start();
  timer_.setSingleShot(true);
  QObject::connect(&timer_, &QTimer::timeout, &timer_, [this] { endLate(); });
}

std::optional<qint64> OvertakenRuns::beganMs() const {
  const qint64 ms = beganMs_;
  return ms == kNone ? std::nullopt : std::optional(ms);
}

void OvertakenRuns::add(const CancelToken& token) {
  tokens_.push_back(token);
  endLate();
}

void OvertakenRuns::newerInkIsSeen(bool areCurvesShown) {
  if (!areCurvesShown) end();
}

void OvertakenRuns::forget() { tokens_.clear(); }

// The timer may have been set for a run that has ended since: the one that runs now has a grace of its own.
void OvertakenRuns::endLate() {
  if (const std::optional<qint64> began = beganMs())
    if (const qint64 elapsed = clock_.elapsed() - *began; elapsed < graceMs_)
      return timer_.start(static_cast<int>(graceMs_ - elapsed));
  end();
}

void OvertakenRuns::end() {
  timer_.stop();
  for (const CancelToken& token : tokens_) token.cancel();
  tokens_.clear();
}

}  // namespace batten
