// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QElapsedTimer>
#include <QProcess>
#include <QTimer>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/batch/page_record.h"
#include "core/base/cancel_token.h"

namespace batten::cli {

/// Runs `batten-cli` with these words in this process: prints to std::cout and std::cerr, and returns its exit code.
using CallHere = std::function<int(const std::vector<std::string>& words, const CancelToken& cancel)>;

/// A page traced in this process, for where the system starts no other: with the outputs of a call, but a page that
/// crashes or takes all memory ends the others as well. No other is traced meanwhile, so it has all threads.
/// @pre canBeTracedHere() @param cancel ends the trace; what it returns then means nothing.
bool canBeTracedHere(const BatchPage& page);
PageResult tracedHere(const BatchPage& page, const CallHere& call, const CancelToken& cancel);

/// One page, traced by a call of this program in a process of its own: a page that crashes, hangs or takes all memory
/// takes none of the others with it, and its outputs are those of the call alone, byte for byte.
class PageCall {
 public:
  using Ended = std::function<void(const PageResult&)>;

  /// Starts the call. `ended` hears of its end once, from the event loop; it must not destroy this object.
  /// @param timeoutSeconds after which the call is ended as failed; nullopt: never.
  PageCall(const BatchPage& page, int threads, std::optional<double> timeoutSeconds, Ended ended);
  ~PageCall();

  /// [bytes] What the call holds now; absent if unknown.
  std::optional<std::uint64_t> memoryBytes() const;

 private:
  void finish();
  PageResult result();

  std::vector<std::string> words_;     ///< The program and what it is told, byte by byte.
  std::vector<const char*> pointers_;  ///< To them, and null.
  double timeoutSeconds_ = 0.0;
  bool isTooSlow_ = false, hasEnded_ = false;
  Ended ended_;
  QElapsedTimer clock_;
  QTimer timer_;
  QProcess process_;
};

}  // namespace batten::cli
