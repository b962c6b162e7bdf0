// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/stack_sampler.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>

namespace batten::test {
namespace {

using namespace std::chrono_literals;
constexpr auto kLookEvery = 8ms;
constexpr long long kLongNs = 30'000'000;  // what is over sooner is not looked at
constexpr int kDeepest = 64;
constexpr std::size_t kMostStacks = 12;

std::array<void*, kDeepest> calls;
std::atomic<int> callCount = 0;  // 0 while none have been noted

void noteCalls(int) { callCount = backtrace(calls.data(), kDeepest); }

long long nowNs() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

QString nameOf(void* address) {
  Dl_info info{};
  if (dladdr(address, &info) == 0) return QStringLiteral("?");
  const auto offset = reinterpret_cast<quintptr>(address) - reinterpret_cast<quintptr>(info.dli_fbase);
  if (!info.dli_sname) return QStringLiteral("%1+0x%2").arg(QString::fromLocal8Bit(info.dli_fname)).arg(offset, 0, 16);
  int status = 0;
  char* plain = abi::__cxa_demangle(info.dli_sname, nullptr, nullptr, &status);
  const QString name = QString::fromLatin1(status == 0 ? plain : info.dli_sname);
  std::free(plain);
  return name;
}

}  // namespace

StackSampler::StackSampler() : watched_(pthread_self()) {
  backtrace(calls.data(), kDeepest);  // loads what it needs: no signal handler may
  struct sigaction action {};
  action.sa_handler = noteCalls;
  action.sa_flags = SA_RESTART;
  sigaction(SIGUSR2, &action, nullptr);
  thread_ = std::thread([this] { watch(); });
}

StackSampler::~StackSampler() {
  isOver_ = true;
  thread_.join();
}

void StackSampler::begin() { sinceNs_ = nowNs(); }

QStringList StackSampler::end(bool wanted) {
  sinceNs_ = 0;
  const std::scoped_lock lock(mutex_);
  QStringList text;
  for (const Stack& stack : seen_) {
    if (!wanted) break;
    QStringList names;
    for (void* call : stack) names.append(nameOf(call));
    text.append(names.join(QStringLiteral(" < ")));
  }
  seen_.clear();
  return text;
}

void StackSampler::watch() {
  while (!isOver_) {
    std::this_thread::sleep_for(kLookEvery);
    const long long since = sinceNs_;
    if (since == 0 || nowNs() - since < kLongNs) continue;
    callCount = 0;
    if (pthread_kill(watched_, SIGUSR2) != 0) continue;
    for (int i = 0; i < 100 && callCount == 0; ++i) std::this_thread::sleep_for(1ms);
    const std::scoped_lock lock(mutex_);
    if (sinceNs_ != since || seen_.size() >= kMostStacks) continue;
    const int count = callCount;
    // The handler and the return of a signal are no calls of the thread's own.
    if (count > 2) seen_.emplace_back(calls.begin() + 2, calls.begin() + count);
  }
}

}  // namespace batten::test
