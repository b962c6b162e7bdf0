// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/traced_lines.h"

namespace batten::test {

std::vector<std::vector<Vec2>> linesOf(const PipelineOutput& out) {
  std::vector<std::vector<Vec2>> lines;
  if (!out.contours) return lines;
  for (const Contour& c : out.contours->contours) {
    lines.push_back(positionsOf(c.points));
    if (c.closed && !c.points.empty()) lines.back().push_back(c.points.front().at);
  }
  return lines;
}

PipelineOutput tracedPage(const Scan& scan, const Recipe& recipe) {
  StageCache cache;
  PipelineRequest request;
  request.upTo = StageId::Contours;
  request.needEdges = false;
  return runPipeline(scan, recipe, cache, request, {});
}

std::vector<std::vector<Vec2>> tracedLines(const Scan& scan, const Recipe& recipe) {
  return linesOf(tracedPage(scan, recipe));
}

}  // namespace batten::test
