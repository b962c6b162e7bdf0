// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/run_context.h"
#include "core/document/report_pages/figure.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// What stands on the pages of a report, whatever they are made of. All texts are UTF-8 and safe to show.
struct ReportContent {
  struct Fact {
    std::string name, value;
  };
  /// One curve: its row in the tables and its figures.
  struct CurveSection {
    std::string name;                ///< "Curve 3", as the window calls it.
    std::vector<std::string> cells;  ///< One per entry of `columns`.
    std::vector<std::string> notes;  ///< What the user should know of it.
    std::string fairing;             ///< How it was faired, one line.
    Figure comb, radius;
  };
  std::string title;        ///< The drawing.
  std::vector<Fact> facts;  ///< Of the scan and the whole drawing.
  Figure drawing;           ///< 1:1.
  std::vector<std::string> columns;
  std::vector<CurveSection> curves;
  std::vector<Fact> settings;  ///< What the recipe sets otherwise than the program would.
  std::string recipeJson;      ///< The whole recipe, as its file.
};

/// What stays out of the run and the recipe.
struct ReportOrigin {
  std::string program;  ///< "Batten 0.1.0"
  std::string date;     ///< Display text; empty: none.
};

/// Gathers the report of a finished run: curves that are left out are counted only.
/// @return NoCurve without a curve, Cancelled.
Result<ReportContent> reportContent(const Scan&, const Recipe&, const PipelineOutput&, const ReportOrigin&,
                                    const RunContext& = {});

}  // namespace batten
