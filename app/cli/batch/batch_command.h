// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/batch/page_call.h"

namespace batten::cli {

/// The words of `batten-cli batch`, as typed.
struct BatchArguments {
  std::vector<std::string> inputs;           ///< One manifest (.jsonl, or - for stdin), or scans, folders and patterns.
  std::string to;                            ///< --to, for scans, folders and patterns
  std::string formats = "svg,json";          ///< --formats
  std::string recipe;                        ///< --recipe
  std::vector<std::string> settings;         ///< --set
  std::optional<double> dpi;                 ///< --dpi
  int jobs = 0;                              ///< --jobs, 0 = as many as processors
  std::string existing = "skip";             ///< --existing
  int firstLine = 1;                         ///< --first-line
  bool resume = false;                       ///< --resume
  std::optional<double> pageTimeoutSeconds;  ///< --page-timeout
  double maxFailures = 1.0;                  ///< --max-failures
  std::string results;                       ///< --results
  std::string failures;                      ///< --failures
  std::string sheet;                         ///< --sheet
  std::string writeManifest;                 ///< --write-manifest
};

/// Traces many drawings; one line of JSON for each as it ends. @return kDone if none failed, kPagesFailed, kStopped, or
/// what is wrong with the words. @param program the program's name as it was called, for the event loop. @param
/// callHere for pages that the system starts no process for.
int runBatch(const BatchArguments&, char* program, const CallHere& callHere);

}  // namespace batten::cli
