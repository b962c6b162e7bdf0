// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/rail/stage_of_change.h"

#include <tuple>
#include <vector>

namespace batten {

std::optional<PanelStage> stageOfChange(const Recipe& a, const Recipe& b) {
  if (a == b) return std::nullopt;
  if (a.dpi != b.dpi || a.scaleLine != b.scaleLine || !(a.log == b.log) || !(a.paper == b.paper) ||
      !(a.preparation == b.preparation))
    return PanelStage::Scan;
  if (!(a.threshold == b.threshold)) return PanelStage::Threshold;
  if (!(a.filter == b.filter)) return PanelStage::CleanUp;
  const bool isOfEdges = a.edges == b.edges && a.contours == b.contours && a.penStrokes == b.penStrokes &&
                         a.imports == b.imports && a.page == b.page && a.regions == b.regions;
  if (!isOfEdges) return PanelStage::Edges;
  if (!(a.corners == b.corners) || a.cornerMarks != b.cornerMarks || a.refusedCornersPx != b.refusedCornersPx)
    return PanelStage::Corners;
  // Of a choice for one curve the method and whether it counts are chosen under Curves, the rest is how it is faired.
  const auto constructed = [](const Recipe& recipe) {
    std::vector<std::tuple<bool, std::optional<ConstructMethod>, std::optional<double>>> said;
    for (const PieceChoice& choice : recipe.choices)
      if (!choice.included || choice.method || choice.detail)
        said.emplace_back(choice.included, choice.method, choice.detail);
    return said;
  };
  const bool isOfCurves = a.segments == b.segments && a.segmentPoints == b.segmentPoints &&
                          a.construct == b.construct && a.extremumChoices == b.extremumChoices &&
                          constructed(a) == constructed(b);
  if (isOfCurves && a.choices == b.choices && a.fairing == b.fairing) return PanelStage::Export;
  return isOfCurves ? PanelStage::Fairing : PanelStage::Curves;
}

}  // namespace batten
