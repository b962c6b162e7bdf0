// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/pause_meter.h"

#include <sys/resource.h>
#include <QEvent>
#include <QMetaEnum>
#include <QThread>
#include <ctime>

#include "tests/ui/stack_sampler.h"

namespace batten::test {
namespace {

constexpr double kNoticedMs = 100.0;  // a user takes less for at once
constexpr double kListedMs = 60.0;
constexpr double kPartMs = 20.0;  // a part of a pause that is worth naming
constexpr qsizetype kMostParts = 6;

}  // namespace

PauseMeter::PauseMeter() = default;
PauseMeter::~PauseMeter() = default;

void PauseMeter::reset() {
  clock_.start();
  pauses_.clear();
  longest_ = mostWork_ = {};
  over_ = workOver_ = 0;
}

void PauseMeter::watchCalls() { sampler_ = std::make_unique<StackSampler>(); }

PauseMeter::Moment PauseMeter::now() const {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return {clock_.nsecsElapsed(), 1'000'000'000 * static_cast<qint64>(used.tv_sec) + used.tv_nsec, usage.ru_nvcsw};
}

Spent PauseMeter::between(const Moment& from, const Moment& to) {
  return {1e-6 * static_cast<double>(to.wallNs - from.wallNs),
          1e-6 * static_cast<double>(to.processorNs - from.processorNs), to.waits - from.waits};
}

QString PauseMeter::describe(const Event& event, const Spent& spent) {
  const char* type = QMetaEnum::fromType<QEvent::Type>().valueToKey(event.type);
  return QStringLiteral("%1 of %2 %3 (%4 ms)")
      .arg(type ? QString::fromLatin1(type) : QString::number(event.type), QString::fromLatin1(event.receiver),
           event.name)
      .arg(spent.wallMs, 0, 'f', 0);
}

void PauseMeter::begin(int loop, const QObject& receiver, const QEvent& event) {
  if (!clock_.isValid()) return;
  const bool isPart = !events_.empty() && loop <= events_.back().loop;
  if (!isPart && !events_.empty() && !events_.back().hasLoop) {
    events_.back().hasLoop = true;
    add(events_.back());
  }
  const Moment begun = now();
  events_.push_back(
      {loop, begun, begun, receiver.metaObject()->className(), receiver.objectName(), event.type(), {}, false, isPart});
  if (!isPart && sampler_) sampler_->begin();
}

void PauseMeter::end() {
  if (events_.empty()) return;  // it began before the meter did
  const Event event = std::move(events_.back());
  events_.pop_back();
  if (!event.isPart) {
    add(event);
    if (!events_.empty()) {
      events_.back().since = now();
      if (sampler_) sampler_->begin();
    }
    return;
  }
  Event& whole = events_.back();
  // A loop of its own was one of the event that it belongs to.
  if (event.hasLoop) {
    whole.hasLoop = true;
    whole.since = event.since;
  }
  const Spent spent = between(event.begun, now());
  if (spent.wallMs < kPartMs) return;
  whole.parts.append(describe(event, spent));
  whole.parts += event.parts;
  if (whole.parts.size() > kMostParts) whole.parts.resize(kMostParts);
}

void PauseMeter::add(const Event& event) {
  const Spent spent = between(event.since, now());
  const QStringList stack = sampler_ ? sampler_->end(spent.wallMs >= kListedMs) : QStringList();
  if (spent.wallMs > kNoticedMs) ++over_;
  if (spent.processorMs > kNoticedMs) ++workOver_;
  const bool isLongest = spent.wallMs > longest_.spent.wallMs;
  const bool isMostWork = spent.processorMs > mostWork_.spent.processorMs;
  const bool isListed = spent.wallMs >= kListedMs;
  if (!isLongest && !isMostWork && !isListed) return;
  const Pause pause{spent, doing_, (QStringList{describe(event, spent)} + event.parts).join(QStringLiteral(" > ")),
                    stack};
  if (isLongest) longest_ = pause;
  if (isMostWork) mostWork_ = pause;
  if (isListed) pauses_.push_back(pause);
}

bool TestApplication::notify(QObject* receiver, QEvent* event) {
  if (QThread::currentThread() != thread()) return QApplication::notify(receiver, event);
  meter().begin(QThread::currentThread()->loopLevel(), *receiver, *event);
  const bool isDone = QApplication::notify(receiver, event);
  meter().end();
  return isDone;
}

PauseMeter& TestApplication::meter() {
  static PauseMeter meter;
  return meter;
}

}  // namespace batten::test
