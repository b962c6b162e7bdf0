// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/batch_run.h"

#include <QEventLoop>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "app/cli/exit_codes.h"
#include "core/base/number_text.h"
#include "core/base/platform.h"
#include "core/base/platform_memory.h"
#include "core/exchange/save_atomically.h"
#include "core/image/file/scan_reader.h"

namespace batten::cli {
namespace {

namespace fs = std::filesystem;

// A signal handler can reach nothing but such a number and atomics without a lock.
volatile std::sig_atomic_t signalsCaught = 0;
std::atomic<const CancelToken*> cutByASecondSignal = nullptr;
static_assert(std::atomic<const CancelToken*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void catchSignal(int) {
  signalsCaught = signalsCaught + 1;
  if (const CancelToken* const trace = cutByASecondSignal; trace != nullptr && signalsCaught > 1) trace->cancel();
}

constexpr int kTickMs = 100;                   // signals are heard and memory is looked at this often
constexpr int kLongestStartsMs = 50;           // the event loop is not held up longer by pages that need no call
constexpr double kProgressEverySeconds = 1.0;  // at most

// What a call is taken to need at its peak. The program alone takes 85 MB; drawings and photographs of 0.2 to 35
// megapixels took 6 to 25 bytes a pixel beside that, a page that one spiral of many turns covers took 55.
constexpr std::uint64_t kBytesOfACall = std::uint64_t{96} << 20;
constexpr std::uint64_t kBytesPerPixel = 64;  // above all that were measured

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

/// Removes what a call that failed has written: an output that it ended, and one that it was killed within.
void removeOutput(const std::string& output, const std::optional<FileId>& before) {
  removeLeftoversOf(output);
  if (const auto now = fileId(output); !now || now == before) return;
  std::error_code code;
  fs::remove(saveTarget(output).value_or(output), code);
}

}  // namespace

/// A page for which a call is needed, and which no other call works on.
struct BatchRun::Candidate {
  std::size_t index = 0;
  std::string key;                 ///< Empty: scan or recipe cannot be read, which the call will say.
  std::unique_ptr<LockFile> lock;  ///< Held until the page's line is written, where its folder takes one.
};

struct BatchRun::Running {
  std::unique_ptr<Candidate> page;
  std::uint64_t needs = 0;                     ///< [bytes]
  std::vector<std::optional<FileId>> outputs;  ///< What was there before.
  bool wasBegun = false;                       ///< By an earlier run, which may have reported the page.
  std::uint64_t resultsFrom = 0;               ///< As in its record.
  bool isAlone = false;                        ///< No other ran when it was started.
  std::unique_ptr<PageCall> call;
};

BatchRun::BatchRun(const BatchSettings& settings, const std::vector<BatchPage>& pages, ResultLines& lines,
                   CallHere callHere)
    : settings_(settings),
      pages_(pages),
      lines_(lines),
      callHere_(std::move(callHere)),
      most_(settings.jobs),
      showsProgress_(stderrIsTerminal()) {
  QObject::connect(&tick_, &QTimer::timeout, &tick_, [this] {
    again_.insert(again_.end(), busy_.begin(), busy_.end());
    busy_.clear();
    hearSignals();
    startMore();
    showProgress();
  });
}

BatchRun::~BatchRun() = default;

void BatchRun::run() {
  signalsCaught = 0;
  cutByASecondSignal = &cutShort_;
  const auto before = std::signal(SIGINT, catchSignal);
  const auto beforeTerm = std::signal(SIGTERM, catchSignal);
  tieChildrenToThisProcess();
  clock_.start();
  tick_.start(kTickMs);
  QEventLoop loop;
  QTimer::singleShot(0, &tick_, [this] { startMore(); });
  while (isLeft() || !running_.empty()) {
    if (!whyStopped_.empty() && running_.empty()) break;
    loop.processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
  }
  tick_.stop();
  hideProgress();
  std::signal(SIGINT, before);
  std::signal(SIGTERM, beforeTerm);
  cutByASecondSignal = nullptr;
}

bool BatchRun::isLeft() const {
  return next_ < pages_.size() || candidate_ || !unstarted_.empty() || !busy_.empty() || !again_.empty();
}

void BatchRun::startMore() {
  QElapsedTimer clock;
  clock.start();
  while (clock.elapsed() < kLongestStartsMs) {
    hearSignals();
    if (!whyStopped_.empty() || std::ssize(running_) >= most_) return;
    if (!takeNext()) return;
  }
  QTimer::singleShot(0, &tick_, [this] { startMore(); });
}

/// The pages in their order, then those that other calls worked on when they were asked for.
std::optional<std::size_t> BatchRun::nextIndex() {
  if (next_ < pages_.size()) return next_++;
  if (again_.empty()) return std::nullopt;
  const std::size_t index = again_.front();
  again_.pop_front();
  return index;
}

/// Settles the next page without a call, or starts its call; false if it has to wait for memory or none is left.
bool BatchRun::takeNext() {
  if (!candidate_ && !unstarted_.empty()) {
    candidate_ = std::move(unstarted_.front());
    unstarted_.pop_front();
  }
  if (!candidate_) {
    const auto index = nextIndex();
    if (!index) return false;
    candidate_ = candidateOf(*index);
    if (!candidate_) return true;
  }
  if (!running_.empty() && !isRoomFor(pages_[candidate_->index])) return false;
  start(std::move(candidate_));
  return true;
}

/// The page, locked, if it needs a call; null if it is settled without one, or another call works on it.
std::unique_ptr<BatchRun::Candidate> BatchRun::candidateOf(std::size_t index) {
  const BatchPage& page = pages_[index];
  auto candidate = std::make_unique<Candidate>();
  candidate->index = index;
  candidate->lock = std::make_unique<LockFile>(lockName(page));
  std::error_code code;
  // Most pages of a second run are unchanged: they are not locked at all. A lock that lies there is asked first: it may
  // be held, or left by a program that was killed and to be removed.
  bool isAsked = fs::exists(lockName(page), code);
  const auto isBusy = [&] { return candidate->lock->tryHold() == LockState::Busy; };
  if (isAsked && isBusy()) {
    busy_.push_back(index);
    return nullptr;
  }
  const auto key = pageKey(page);  // none: the call says what is wrong with the scan or the recipe
  candidate->key = key.value_or(std::string());
  for (; true; isAsked = true) {
    const auto known = resultWithoutCall(page, key);
    const bool isUntold = known && known->status == PageStatus::Unchanged && lines_.isFile() && !known->isTold;
    // Under the lock only it is sure what the record and the results say.
    if (isAsked || (known && !isUntold)) {
      if (!known) return candidate;
      report(index, *known);
      return nullptr;
    }
    if (isBusy()) {
      busy_.push_back(index);
      return nullptr;
    }
  }
}

/// What becomes of a page for which nothing needs to be done, or nothing may be.
std::optional<PageResult> BatchRun::resultWithoutCall(const BatchPage& page, const std::optional<std::string>& key) {
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
    result.isTold = lines_.isTold(*key, record->resultsFrom);
    return result;
  }
  if (record ? !hasForeignOutput(page, *record) : !anyOutputExists(page)) return std::nullopt;
  result.exitCode = kCannotWrite;
  result.error = record ? "An output was changed after batch had written it. Move it, or use --existing overwrite."
                        : "An output exists that was not written by batch. Move it, or use --existing overwrite.";
  return result;
}

bool BatchRun::isRoomFor(const BatchPage& page) const {
  const auto available = availableMemoryBytes();
  if (!available) return true;
  std::uint64_t needed = memoryNeeded(page);
  for (const auto& one : running_) {
    const std::uint64_t holds = one->call->memoryBytes().value_or(0);
    needed += one->needs - std::min(one->needs, holds);
  }
  return needed <= *available;
}

void BatchRun::start(std::unique_ptr<Candidate> candidate) {
  const std::size_t index = candidate->index;
  const BatchPage& page = pages_[index];
  auto running = std::make_unique<Running>();
  running->needs = memoryNeeded(page);
  running->isAlone = running_.empty();
  for (const std::string& output : page.outputs) running->outputs.push_back(fileId(output));
  // So that a later call knows the outputs for its own even if this one is killed between them. A folder that takes no
  // record takes no output either, and the call says so in its own words.
  const auto before = readRecord(page);
  running->wasBegun = before && before->key == candidate->key;
  running->resultsFrom = running->wasBegun ? before->resultsFrom : lines_.size();
  PageRecord begun;
  begun.key = candidate->key;
  begun.resultsFrom = running->resultsFrom;
  static_cast<void>(writeRecord(page, begun));
  running->page = std::move(candidate);
  running->call = std::make_unique<PageCall>(
      page, settings_.threads, settings_.pageTimeoutSeconds, [this, index](const PageResult& result) {
        QTimer::singleShot(
            0, &tick_, [this, index, result] { settle(index, result); });  // the call must not end in its own signal
      });
  running_.push_back(std::move(running));
}

void BatchRun::settle(std::size_t index, PageResult result) {
  const auto place =
      std::find_if(running_.begin(), running_.end(), [&](const auto& one) { return one->page->index == index; });
  if (place == running_.end()) return;                       // ended by a second signal
  const std::unique_ptr<Running> ended = std::move(*place);  // with the page's lock until all is written
  running_.erase(place);
  if (result.isUnstarted && !ended->isAlone) {
    most_ = std::max(1, static_cast<int>(running_.size()));
    unstarted_.push_back(std::move(ended->page));
    return startMore();
  }
  if (!result.isUnstarted) {
    most_ = std::min(most_ + 1, settings_.jobs);  // what stood in the way may be gone
  } else if (!settings_.pageTimeoutSeconds && canBeTracedHere(pages_[index])) {
    result = tracedHere(pages_[index], callHere_, cutShort_);
    if (cutShort_.isCancelled()) return hearSignals();  // as with the other calls, the page counts as begun
  }
  conclude(*ended, std::move(result));
  startMore();
}

/// Records and reports a page whose call has ended.
void BatchRun::conclude(const Running& ended, PageResult result) {
  const std::size_t index = ended.page->index;
  const BatchPage& page = pages_[index];
  result.key = ended.page->key;
  PageRecord record;
  record.key = result.key;
  record.isEnded = true;
  record.isEmpty = result.status == PageStatus::Empty;
  record.seconds = result.seconds;
  record.figures = result.figures;
  record.resultsFrom = ended.resultsFrom;
  if (record.isEmpty) record.note = result.error;
  if (result.status == PageStatus::Done) {
    for (const std::string& output : page.outputs) record.outputHashes.push_back(fileHash(output).value_or(""));
  }
  if (result.status != PageStatus::Failed) {
    if (const auto written = writeRecord(page, record); !written) {
      result.status = PageStatus::Failed;
      result.exitCode = kCannotWrite;
      result.error = written.error().message;
    }
  }
  if (result.status == PageStatus::Failed) {
    for (std::size_t i = 0; i < page.outputs.size(); ++i) removeOutput(page.outputs[i], ended.outputs[i]);
    std::error_code code;
    if (!anyOutputExists(page)) fs::remove(recordName(page), code);  // nothing was made, so nothing is left
  } else if (ended.wasBegun) {
    result.isTold = lines_.isTold(result.key, ended.resultsFrom);
  }
  report(index, result);
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
  if (!result.isTold) {
    if (!lines_.isFile()) hideProgress();  // a terminal would show both in one line
    if (const auto written = lines_.write(pages_[index], result); !written) {
      isResultLost_ = true;
      stop(written.error().message);
    }
  }
  const double share = static_cast<double>(counts_.failed) / static_cast<double>(pages_.size());
  if (share > settings_.maxFailures) {
    stop(failedPages(counts_.failed, pages_.size()) + ", more than --max-failures allows.");
  }
}

void BatchRun::stop(const std::string& why) {
  if (whyStopped_.empty()) whyStopped_ = why;
}

void BatchRun::hearSignals() {
  const int caught = signalsCaught;
  if (caught == signalsHeard_) return;
  signalsHeard_ = caught;
  stop("Stopped. Run the same command to resume.");
  if (caught > 1) running_.clear();  // ends the calls; their pages count as begun
}

void BatchRun::hideProgress() const {
  if (showsProgress_) std::fputs("\r\033[K", stderr);
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
  const std::size_t elsewhere = busy_.size() + again_.size();
  if (elsewhere > 0) line += ", " + std::to_string(elsewhere) + " with another call";
  if (!whyStopped_.empty()) line += "; ends after " + std::to_string(running_.size()) + " running";
  std::fputs((line + "\033[K").c_str(), stderr);
}

std::string failedPages(int failed, std::size_t all) {
  return std::to_string(failed) + (failed == 1 ? " page of " : " pages of ") + std::to_string(all) +
         (failed == 1 ? " has failed" : " have failed");
}

}  // namespace batten::cli
