// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <memory>
#include <set>
#include <string>

#include "app/cli/batch/page_record.h"
#include "core/base/result.h"

namespace batten::cli {

/// Where the lines about the pages go: to stdout, or to the end of a file. Each line is handed to the system whole and
/// at once, so that no line is lost or torn when the program is killed, and several programs may write one file.
class ResultLines {
 public:
  /// @param file empty for stdout. What a file holds already is kept: pages that it calls done or empty are known by
  /// their keys. @return CannotWrite if it cannot be opened.
  static Result<ResultLines> open(const std::string& file);

  /// Writes the line of a page. In a file an unchanged page is left out when an earlier line tells of it; when none
  /// does, as after a kill between a page's end and its line, the line says what the page's record says.
  /// @return CannotWrite when nothing more can be written.
  Result<void> write(const BatchPage&, const PageResult&);

 private:
  struct Close {
    void operator()(std::FILE* file) const {
      if (file != stdout) std::fclose(file);
    }
  };
  std::string name_;  ///< Empty: stdout.
  std::unique_ptr<std::FILE, Close> file_;
  std::set<std::string> known_;  ///< Keys of pages that the file calls done or empty.
};

}  // namespace batten::cli
