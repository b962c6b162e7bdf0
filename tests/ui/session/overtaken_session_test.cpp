// SPDX-License-Identifier: GPL-3.0-or-later
// How long a run goes on that a newer request has overtaken.
#include <gtest/gtest.h>

#include <QElapsedTimer>

#include "tests/ui/rendered_scan.h"
#include "ui/session/runs/overtaken_runs.h"

namespace batten {
namespace {

using test::waitUntil;

constexpr int kGraceMs = 300, kTickMs = 20, kForeverMs = 1000000;

/// Ticks of a slider, each with coarse ink that comes before the next one, until the run ends or its grace is over
/// since long. [ms] How long it went on; where it was not ended, more than kGraceMs many times.
qint64 endsAfter(bool areCurvesShown) {
  OvertakenRuns runs(kGraceMs);
  const CancelToken running;
  runs.runBegins();
  QElapsedTimer clock;
  clock.start();
  runs.add(running);
  while (clock.elapsed() < 20 * kGraceMs) {
    runs.newerInkIsSeen(areCurvesShown);
    if (waitUntil([&] { return running.isCancelled(); }, kTickMs)) break;
    // Behind the one that runs each waits for the next to replace it.
    runs.add(CancelToken());
  }
  return clock.elapsed();
}

TEST(OvertakenRuns, SteadyTicksLeaveTheRunThatMovesTheCurvesItsGrace) {
  const qint64 ms = endsAfter(true);
  EXPECT_GE(ms, kGraceMs - 5) << "the curves would stand still for the whole drag";
  EXPECT_LT(ms, 10 * kGraceMs);
}

TEST(OvertakenRuns, WithoutCurvesARunEndsOnceNewerInkIsSeen) { EXPECT_LT(endsAfter(false), kGraceMs); }

TEST(OvertakenRuns, ARunThatBeginsLaterHasAGraceOfItsOwn) {
  OvertakenRuns runs(kForeverMs);
  const CancelToken ended, running;
  runs.add(ended);
  EXPECT_TRUE(ended.isCancelled()) << "no run has a grace: it waited, or had ended";
  runs.runBegins();
  runs.runEnds();
  runs.runBegins();
  runs.add(running);
  EXPECT_FALSE(running.isCancelled());
}

TEST(OvertakenRuns, AForgottenRunIsLeftAsItIs) {
  OvertakenRuns runs(kForeverMs);
  const CancelToken running;
  runs.runBegins();
  runs.add(running);
  runs.forget();
  runs.newerInkIsSeen(false);
  EXPECT_FALSE(running.isCancelled());
}

}  // namespace
}  // namespace batten
