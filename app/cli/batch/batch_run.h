// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/batch/page_call.h"
#include "app/cli/batch/result_lines.h"

namespace batten::cli {

/// What becomes of a page whose outputs are there.
enum class Existing {
  Skip,       ///< Unchanged pages are left; changed ones are made anew. A file that no batch wrote, or that was
              ///< changed since, is not touched: its page fails.
  Overwrite,  ///< Every page is made anew.
  Abort,      ///< Nothing is done if any output is there.
};

struct BatchSettings {
  int jobs = 1;     ///< >= 1. Pages at once.
  int threads = 1;  ///< >= 1. Threads of each page.
  Existing existing = Existing::Skip;
  std::optional<double> pageTimeoutSeconds;  ///< [s] > 0
  double maxFailures = 1.0;                  ///< 0..1. Share of all pages; once more have failed, no page is started.
};

struct BatchCounts {
  int done = 0, empty = 0, unchanged = 0, failed = 0;
  int ended() const { return done + empty + unchanged + failed; }
};

/// Runs over the pages in their order, several at once, each in a process of its own. SIGINT or SIGTERM: no page is
/// started any more and the running ones end; a second time cuts them short, and they count as begun. A page is started
/// beside others only while free memory holds it and the system starts a process for it, else once another has ended;
/// and never while another call works on it: then it waits, and finds the page done. Where the system starts not even
/// one, a page is traced in this process, unless that needs a process of its own: for a timeout or a printed report.
class BatchRun {
 public:
  BatchRun(const BatchSettings& settings, const std::vector<BatchPage>& pages, ResultLines& lines, CallHere callHere);
  ~BatchRun();

  /// Returns when the last page has ended, or no more are to be started. Needs a QCoreApplication.
  void run();

  const BatchCounts& counts() const { return counts_; }
  /// Why it ended before the last page; empty if it did not.
  const std::string& whyStopped() const { return whyStopped_; }
  /// It ended because a result could not be written.
  bool isResultLost() const { return isResultLost_; }
  /// What went wrong with the pages that failed, by their index.
  const std::map<std::size_t, std::string>& failed() const { return failed_; }

 private:
  struct Running;
  struct Candidate;
  void startMore();
  bool takeNext();
  std::optional<std::size_t> nextIndex();
  bool isLeft() const;
  std::unique_ptr<Candidate> candidateOf(std::size_t index);
  std::optional<PageResult> resultWithoutCall(const BatchPage& page, const std::optional<std::string>& key);
  void start(std::unique_ptr<Candidate> candidate);
  void settle(std::size_t index, PageResult result);
  void conclude(const Running& ended, PageResult result);
  void report(std::size_t index, const PageResult& result);
  bool isRoomFor(const BatchPage& page) const;
  void hearSignals();
  void showProgress();
  void hideProgress() const;
  void stop(const std::string& why);

  const BatchSettings& settings_;
  const std::vector<BatchPage>& pages_;
  ResultLines& lines_;
  const CallHere callHere_;
  std::size_t next_ = 0;
  int most_;                                          ///< Pages at once that the system lets run; at most the jobs.
  std::unique_ptr<Candidate> candidate_;              ///< The page that waits for memory.
  std::deque<std::unique_ptr<Candidate>> unstarted_;  ///< They wait for another page to end.
  /// Pages that another call works on: heard of this turn, or to be asked again.
  std::deque<std::size_t> busy_, again_;
  std::list<std::unique_ptr<Running>> running_;
  BatchCounts counts_;
  std::map<std::size_t, std::string> failed_;
  std::string whyStopped_;
  CancelToken cutShort_;  ///< Of the page that is traced in this process: a second signal cancels it.
  int signalsHeard_ = 0;
  bool isResultLost_ = false, showsProgress_ = false;
  double shownAtSeconds_ = 0.0;  ///< [s] When progress was shown last.
  QElapsedTimer clock_;
  QTimer tick_;
};

/// "1 page of 2 has failed", "3 pages of 5 have failed".
std::string failedPages(int failed, std::size_t all);

}  // namespace batten::cli
