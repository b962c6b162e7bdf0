// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/batch_run.h"

#include <QEventLoop>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "app/cli/exit_codes.h"
#include "core/base/number_text.h"
#include "core/base/platform.h"
#include "core/image/scan_reader.h"

namespace batten::cli {
namespace {

namespace fs = std::filesystem;

volatile std::sig_atomic_t signalsCaught = 0;  // a signal handler can reach nothing else

void catchSignal(int) { signalsCaught = signalsCaught + 1; }

constexpr int kTickMs = 100;        // signals are heard and memory is looked at this often
constexpr int kLongestTurnMs = 50;  // the event loop is not held up longer by pages that need no call
constexpr double kProgressEverySeconds = 1.0;

// What a call is taken to need at its peak. The program alone takes 85 MB; drawings and photographs of 0.2 to 35
// megapixels took 6 to 25 bytes a pixel beside that, so the allowance for a pixel is generous.
constexpr std::uint64_t kBytesOfACall = std::uint64_t{96} << 20;
constexpr std::uint64_t kBytesPerPixel = 40;

/// [bytes] What tracing the page will take at its peak, from the size that the scan states.
std::uint64_t memoryNeeded(const BatchPage& page) {
  const auto info = probeScan(page.scan, {page.page, page.dpi.value_or(PageChoice{}.pdfDpi)});
  if (!info) return kBytesOfACall;
  return kBytesOfACall +
         kBytesPerPixel * static_cast<std::uint64_t>(info->width) * static_cast<std::uint64_t>(info->height);
}

bool anyOutputExists(const BatchPage& page) {
  std::error_code code;
  return std::any_of(page.outputs.begin(), page.outputs.end(),
                     [&](const std::string& name) { return fs::exists(name, code); });
}

}  // namespace

struct BatchRun::Running {
  std::size_t index = 0;
  std::string key;
  std::uint64_t needs = 0;  ///< [bytes]
  std::unique_ptr<PageCall> call;
};

BatchRun::BatchRun(const BatchSettings& settings, const std::vector<BatchPage>& pages, ResultLines& lines)
    : settings_(settings), pages_(pages), lines_(lines), showsProgress_(stderrIsTerminal()) {
  QObject::connect(&tick_, &QTimer::timeout, &tick_, [this] {
    hearSignals();
    startMore();
    showProgress();
  });
}

BatchRun::~BatchRun() = default;

void BatchRun::run() {
  signalsCaught = 0;
  const auto before = std::signal(SIGINT, catchSignal);
  const auto beforeTerm = std::signal(SIGTERM, catchSignal);
  tieChildrenToThisProcess();
  clock_.start();
  tick_.start(kTickMs);
  QEventLoop loop;
  QTimer::singleShot(0, &tick_, [this] { startMore(); });
  while (next_ < pages_.size() || !running_.empty()) {
    if (!whyStopped_.empty() && running_.empty()) break;
    loop.processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
  }
  tick_.stop();
  if (showsProgress_) std::fputs("\r\033[K", stderr);
  std::signal(SIGINT, before);
  std::signal(SIGTERM, beforeTerm);
}

void BatchRun::startMore() {
  QElapsedTimer turn;
  turn.start();
  while (turn.elapsed() < kLongestTurnMs) {
    hearSignals();
    if (!whyStopped_.empty() || next_ >= pages_.size() || std::ssize(running_) >= settings_.jobs) return;
    if (!takeNext()) return;
  }
  QTimer::singleShot(0, &tick_, [this] { startMore(); });
}

/// Settles the next page without a call, or starts its call; false if it has to wait for memory.
bool BatchRun::takeNext() {
  const BatchPage& page = pages_[next_];
  if (lookedAt_ != next_) {
    const auto key = pageKey(page);  // none: the call says what is wrong with the scan or the recipe
    if (auto known = resultWithoutCall(page, key)) {
      report(next_++, *known);
      return true;
    }
    lookedAt_ = next_;
    nextKey_ = key.value_or(std::string());
  }
  if (!running_.empty() && !isRoomFor(page)) return false;
  start(next_++, nextKey_);
  return true;
}

/// What becomes of a page for which nothing needs to be done, or nothing may be.
std::optional<PageResult> BatchRun::resultWithoutCall(const BatchPage& page,
                                                      const std::optional<std::string>& key) const {
  if (settings_.existing != Existing::Skip) return std::nullopt;
  const auto record = readRecord(page);
  PageResult result;
  if (record && key && isUnchanged(page, *record, *key)) {
    result.status = PageStatus::Unchanged;
    result.exitCode = record->isEmpty ? kNoCurve : kDone;
    result.error = record->note;
    result.figures = record->figures;
    result.key = *key;
    result.seconds = record->seconds;
    return result;
  }
  if (record || !anyOutputExists(page)) return std::nullopt;
  result.exitCode = kCannotWrite;
  result.error = "An output is there that no batch has written. Move it away, or use --existing overwrite.";
  return result;
}

bool BatchRun::isRoomFor(const BatchPage& page) const {
  const auto available = availableMemoryBytes();
  if (!available) return true;
  std::uint64_t needed = memoryNeeded(page);
  for (const auto& one : running_) {
    const std::uint64_t holds = one->call->memoryBytes();
    needed += one->needs - std::min(one->needs, holds);
  }
  return needed <= *available;
}

void BatchRun::start(std::size_t index, const std::string& key) {
  const BatchPage& page = pages_[index];
  auto running = std::make_unique<Running>();
  running->index = index;
  running->key = key;
  running->needs = memoryNeeded(page);
  // So that a later call knows the outputs for its own even if this one is killed between them. A folder that takes no
  // record takes no output either, and the call says so in its own words.
  PageRecord begun;
  begun.key = key;
  static_cast<void>(writeRecord(page, begun));
  running->call = std::make_unique<PageCall>(
      page, settings_.threads, settings_.pageTimeoutSeconds, [this, index](const PageResult& result) {
        QTimer::singleShot(
            0, &tick_, [this, index, result] { settle(index, result); });  // the call must not end in its own signal
      });
  running_.push_back(std::move(running));
}

void BatchRun::settle(std::size_t index, PageResult result) {
  const auto running =
      std::find_if(running_.begin(), running_.end(), [&](const auto& one) { return one->index == index; });
  if (running == running_.end()) return;  // ended by a second signal
  const BatchPage& page = pages_[index];
  result.key = (*running)->key;
  running_.erase(running);
  PageRecord record;
  record.key = result.key;
  record.isEnded = true;
  record.isEmpty = result.status == PageStatus::Empty;
  record.seconds = result.seconds;
  record.figures = result.figures;
  if (record.isEmpty) record.note = result.error;
  if (result.status == PageStatus::Done) {
    for (const std::string& output : page.outputs) record.outputHashes.push_back(fileHash(output).value_or(""));
  }
  if (result.status != PageStatus::Failed) {
    if (const auto written = writeRecord(page, record); !written) {
      result.status = PageStatus::Failed;
      result.error = written.error().message;
    }
  } else {
    std::error_code code;
    if (!anyOutputExists(page)) fs::remove(recordName(page), code);  // nothing was made, so nothing is left
  }
  report(index, result);
  startMore();
}

void BatchRun::report(std::size_t index, const PageResult& result) {
  switch (result.status) {
    case PageStatus::Done:
      ++counts_.done;
      break;
    case PageStatus::Empty:
      ++counts_.empty;
      break;
    case PageStatus::Unchanged:
      ++counts_.unchanged;
      break;
    case PageStatus::Failed:
      ++counts_.failed;
      failed_[index] = result.error;
      break;
  }
  if (const auto written = lines_.write(pages_[index], result); !written) stop(written.error().message);
  const double share = static_cast<double>(counts_.failed) / static_cast<double>(pages_.size());
  if (share > settings_.maxFailures) {
    stop(std::to_string(counts_.failed) + " of " + std::to_string(pages_.size()) +
         " pages have failed, more than --max-failures allows.");
  }
}

void BatchRun::stop(const std::string& why) {
  if (whyStopped_.empty()) whyStopped_ = why;
}

void BatchRun::hearSignals() {
  const int caught = signalsCaught;
  if (caught == signalsHeard_) return;
  signalsHeard_ = caught;
  stop("It was stopped. The same command goes on where it ended.");
  if (caught > 1) running_.clear();  // ends the calls; their pages count as begun
}

void BatchRun::showProgress() {
  const double seconds = 1e-3 * static_cast<double>(clock_.elapsed());
  if (!showsProgress_ || seconds < shownAtSeconds_ + kProgressEverySeconds) return;
  shownAtSeconds_ = seconds;
  const int all = static_cast<int>(pages_.size()), made = counts_.ended() - counts_.unchanged;
  const double aMinute = seconds > 0.0 ? 60.0 * made / seconds : 0.0;
  std::string line = "\r" + std::to_string(counts_.ended()) + " of " + std::to_string(all) + " pages, " +
                     std::to_string(counts_.failed) + " failed, " + std::to_string(counts_.empty) + " empty";
  if (made > 0) {
    const double left = (all - counts_.ended()) / aMinute;
    line += ", " + numberToText(static_cast<double>(std::lround(10.0 * aMinute)) / 10.0) + " a minute, " +
            (left < 1.0 ? std::string("less than a minute") : std::to_string(static_cast<int>(left + 0.5)) + " min") +
            " left";
  }
  if (!whyStopped_.empty()) line += "; ends after " + std::to_string(running_.size()) + " running";
  std::fputs((line + "\033[K").c_str(), stderr);
}

}  // namespace batten::cli
