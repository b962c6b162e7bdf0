// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/background/thread_shortage.h"

namespace batten {

namespace {
constexpr int kBetweenTriesMs = 500;  // soon after another program was closed; a try costs nothing
}

ThreadShortage::ThreadShortage(BackgroundThreads& threads, QObject* parent) : QObject(parent), threads_(threads) {
  timer_.setInterval(kBetweenTriesMs);
  connect(&timer_, &QTimer::timeout, this, &ThreadShortage::tryAgain);
  threads_.onStuck([this] { inbox_.post([this] { begin(); }); });
}

ThreadShortage::~ThreadShortage() { threads_.onStuck({}); }

void ThreadShortage::begin() {
  if (timer_.isActive() || !threads_.isStuck()) return;
  timer_.start();
  emit changed(true);
}

void ThreadShortage::tryAgain() {
  threads_.tryAgain();
  if (threads_.isStuck()) return;
  timer_.stop();
  emit changed(false);
}

}  // namespace batten
