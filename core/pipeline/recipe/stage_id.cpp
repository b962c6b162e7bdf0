// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/stage_id.h"

namespace batten {

std::string_view name(StageId stage) {
  switch (stage) {
    case StageId::Thresholds:
      return "thresholds";
    case StageId::Binary:
      return "binary";
    case StageId::Filtered:
      return "filtered";
    case StageId::Edges:
      return "edges";
    case StageId::Contours:
      return "contours";
    case StageId::Pieces:
      return "pieces";
    case StageId::Segments:
      return "segments";
    case StageId::Curves:
      return "curves";
    case StageId::Faired:
      return "faired";
  }
  return "unknown";
}

std::optional<StageId> stageFromName(std::string_view text) {
  for (const StageId stage : kStages) {
    if (name(stage) == text) return stage;
  }
  return std::nullopt;
}

}  // namespace batten
