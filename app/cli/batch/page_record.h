// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/cli/batch/manifest.h"
#include "core/base/result.h"

namespace batten::cli {

/// What became of a page, and how it is called in what the program prints.
enum class PageStatus {
  Done,       ///< "done": its curves are written.
  Empty,      ///< "empty": there is no curve on it. An answer, not a failure.
  Unchanged,  ///< "unchanged": scan, recipe, settings and program are those of an earlier call; nothing was done.
  Failed,     ///< "failed": the error says why.
};

/// One line of the results: what is known of a page when it has ended.
struct PageResult {
  PageStatus status = PageStatus::Failed;
  std::optional<int> exitCode;     ///< As of `batten-cli trace` alone; none if the call did not end by itself.
  std::string error;               ///< Of a failed or empty page: what the call says.
  nlohmann::ordered_json figures;  ///< Of a page that is done: curves, pieces, times, memory, notes; else empty.
  std::string key;                 ///< See pageKey.
  double seconds = 0.0;            ///< [s] From the start of the call to its end.
  bool isTold = false;             ///< An earlier line of the results tells of it: none is to be written.
  bool isUnstarted = false;        ///< The system started no process for it. Beside fewer others it might.
};

/// {"line", "scan", "outputs", "status", "exit", …}: one line of JSON without a line break.
std::string resultLine(const BatchPage&, const PageResult&);

/// What the outputs depend on, as 64 hexadecimal digits: the bytes of scan and recipe, settings, resolution, page,
/// names of the outputs, and the program's version. nullopt if the scan or the recipe cannot be read.
std::optional<std::string> pageKey(const BatchPage&);
/// The same where the scan's fileHash is known already.
std::optional<std::string> pageKey(const BatchPage&, const std::optional<std::string>& scanHash);

/// What is kept of a page beside its outputs, as NAME.batch.json beside its first output NAME: with it, a page that is
/// unchanged is known, and one that was cut off is told from a file that someone else put there.
struct PageRecord {
  std::string key;
  bool isEnded = false;  ///< False: it was begun, and the program was stopped before its end.
  bool isEmpty = false;
  double seconds = 0.0;
  std::uint64_t resultsFrom = 0;          ///< [bytes] The page's line in the results lies behind this place of them.
  std::string note;                       ///< Of an empty page: what the call says.
  std::vector<std::string> outputHashes;  ///< SHA-256 of each output, in the order of the page's.
  nlohmann::ordered_json figures;
};

/// nullopt if there is none or it cannot be understood: the page then counts as never begun.
std::optional<PageRecord> readRecord(const BatchPage&);
Result<void> writeRecord(const BatchPage&, const PageRecord&);

/// SHA-256 of a file's bytes; nullopt if it cannot be read.
std::optional<std::string> fileHash(const std::string& name);

/// Whether an output of the page is there that is not as the record's call left it: somebody has changed it, or put it
/// there. False for a record that was begun only: which outputs its call wrote is not known.
bool hasForeignOutput(const BatchPage&, const PageRecord&);

/// Whether a record says that nothing needs to be done: it is of this key, ended, and the outputs are as they were
/// written.
bool isUnchanged(const BatchPage&, const PageRecord&, const std::string& key);

}  // namespace batten::cli
