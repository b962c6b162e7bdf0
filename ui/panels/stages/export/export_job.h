// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/document/export_builder.h"
#include "core/exchange/export_file.h"
#include "core/exchange/model/export_settings.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// Everything an export needs, by value: it runs in the background.
struct ExportRequest {
  PipelineOutput output;
  Recipe recipe;
  std::shared_ptr<const Scan> scan;
  ExportSettings settings;
  ExportedCurves which = ExportedCurves::Faired;
  std::filesystem::path path;
  std::optional<std::set<int>> numbers = {};  ///< Of the curves to take; absent: all.
};

/// What is to be written: the curves of the request as the drawing has them.
ExportDocument documentOf(const ExportRequest&, const ExportSettings&, CancelCheck = {});

/// Builds the document and writes it, checked. Pure but for the file.
Result<ExportReport> runExport(const ExportRequest&, const RunContext&);

/// Size of all curves that an export would hold, [mm], before it is scaled; zero when there are none.
struct ExportSize {
  double widthMm = 0.0, heightMm = 0.0;
  int curves = 0;
};
/// @param numbers of the curves to take; absent: all.
ExportSize exportSize(const PipelineOutput&, ExportedCurves which, const std::optional<std::set<int>>& numbers);

}  // namespace batten
