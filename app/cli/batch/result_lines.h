// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_set>

#include "app/cli/batch/page_record.h"
#include "core/base/platform.h"
#include "core/base/result.h"

namespace batten::cli {

/// Where the lines about the pages go: to stdout, or to the end of a file. Each line is handed to the system whole and
/// at once, so that no line is lost or torn when the program is killed, and several programs may write one file.
class ResultLines {
 public:
  /// @param file empty or - for stdout. What a file holds already is kept. @return CannotWrite if it cannot be opened.
  static Result<ResultLines> open(const std::string& file);

  bool isFile() const { return file_.has_value(); }
  /// [bytes] Of the file so far: a line that is written later lies behind this place.
  std::uint64_t size() const { return file_ ? file_->size() : 0; }
  /// Whether the file calls the page with this key done or empty, as far as it has been written by now, by whomever.
  /// `from` is where to look first (PageRecord::resultsFrom): a long file is not read further if the line is found.
  bool isTold(const std::string& key, std::uint64_t from);

  /// @return CannotWrite when nothing more can be written.
  Result<void> write(const BatchPage&, const PageResult&);

 private:
  void readOn();
  std::string name_;  ///< Empty: stdout.
  std::optional<SharedLines> file_;
  std::uint64_t readTo_ = 0;               ///< [bytes] Lines of the file before this place are in known_.
  std::unordered_set<std::string> known_;  ///< Keys of pages that the file calls done or empty.
};

}  // namespace batten::cli
