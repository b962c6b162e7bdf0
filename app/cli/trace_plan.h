// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/trace_command.h"
#include "core/base/result.h"
#include "core/document/export_builder.h"
#include "core/document/report_pages/report_file.h"
#include "core/exchange/model/export_settings.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten::cli {

/// What is to be written.
struct OutputPlan {
  struct Output {
    std::filesystem::path path;
    ExportSettings settings;
  };
  struct ReportPages {
    std::filesystem::path path;
    ReportFormat format = ReportFormat::Pdf;
    ReportPaper paper = ReportPaper::A4;
  };
  struct Dump {
    std::string stage;
    std::filesystem::path path;
  };
  std::vector<Output> outputs;
  std::vector<ReportPages> reports;
  std::string curves;  ///< Numbers of the curves to write; empty: all.
  ExportedCurves which = ExportedCurves::Faired;
  std::vector<Dump> dumps;
};

/// A checked request: everything that can be wrong in the words alone has been refused before any work is done.
struct TracePlan : OutputPlan {
  Recipe recipe;
  int threads = 0;                 ///< At most; 0 = all.
  std::vector<std::string> notes;  ///< What to know of what was imported.
};

/// The words with a scan that is a file of curves or points among the imports.
TraceArguments withCurvesAsImport(TraceArguments);

/// A message if the scan is a file of curves of a kind that is not read. @return UnreadableScan with what to do.
Result<void> checkScanName(const TraceArguments&);

/// --threads. @return BadParameter with what to do.
Result<int> threadsOf(const TraceArguments&);

/// The words for one page of a file of which all pages are asked for: the names of what is written get "-p1" ….
TraceArguments argumentsForPage(TraceArguments, int page);

/// The plan with the lines of --import in its recipe: on the page of a scan, or null: on a page of their own.
/// @return BadParameter with what to do.
Result<TracePlan> withImports(const TraceArguments&, const PageFrame* frame, TracePlan);

/// The recipe and what is to be written. @return BadParameter with what to do.
Result<TracePlan> planTrace(const TraceArguments&);

}  // namespace batten::cli
