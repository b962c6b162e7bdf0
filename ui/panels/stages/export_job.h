// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

#include "core/base/result.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

enum class ExportFormat { Svg, Json };

/// Everything an export needs, by value: it runs in the background.
struct ExportRequest {
  PipelineOutput output;
  Recipe recipe;
  std::shared_ptr<const Scan> scan;
  ExportFormat format = ExportFormat::Svg;
  double toleranceMm = 0.002;  ///< [mm] SVG only: largest distance of the cubics from the exact curves.
  std::filesystem::path path;
};

struct ExportOutcome {
  int lines = 0;   ///< From end to end, or closed.
  int curves = 0;  ///< Their pieces from corner to corner, as the window numbers them.
  int cubics = 0;  ///< SVG only.
  double largestDifferenceMm =
      0.0;  ///< SVG, read back: cubics from the exact curves; JSON: read back from the file against memory.
  std::filesystem::path path;
};

/// Builds the document, writes it atomically, and checks what was written. Pure but for the file.
Result<ExportOutcome> runExport(const ExportRequest&);

/// Size of all curves that an export would hold, [mm]; zero when there are none.
struct ExportSize {
  double widthMm = 0.0, heightMm = 0.0;
  int curves = 0;
};
ExportSize exportSize(const PipelineOutput&);

}  // namespace batten
