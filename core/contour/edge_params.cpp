// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/edge_params.h"

namespace batten {

std::optional<Error> validate(const EdgeParams& p) {
  const auto bad = [](const char* message) { return Error{ErrorCode::BadParameter, message, {}}; };
  if (!(p.strokeWidth >= 0.005 && p.strokeWidth <= 0.1)) return bad("edges.stroke_width must be 0.005 to 0.1.");
  if (!(p.gapFactor >= 0.0 && p.gapFactor <= 20.0)) return bad("edges.gap must be 0 to 20 stroke widths.");
  if (!(p.mergeWidths >= 0.0 && p.mergeWidths <= 20.0)) return bad("edges.merge must be 0 to 20 stroke widths.");
  if (!(p.spurFactor >= 0.0 && p.spurFactor <= 5.0)) return bad("edges.spur must be 0 to 5 stroke widths.");
  if (!(p.maxBendDeg >= 0.0 && p.maxBendDeg <= 90.0)) return bad("edges.bend must be 0 to 90 degrees.");
  for (const EdgeChoice& choice : p.choices) {
    if (auto error = validate(choice)) return error;
  }
  for (const PaintedInk& painted : p.painted) {
    if (auto error = validate(painted)) return error;
  }
  for (const JunctionChoice& choice : p.junctions) {
    if (auto error = validate(choice)) return error;
  }
  return std::nullopt;
}

std::optional<Error> validate(const ContourParams& p) {
  const auto bad = [](const char* message) { return Error{ErrorCode::BadParameter, message, {}}; };
  if (!(p.minWidths >= 0.0 && p.minWidths <= 100.0)) return bad("contours.min_widths must be 0 to 100 stroke widths.");
  if (!(p.minLengthPx >= 0.0)) return bad("contours.min_length must be 0 px or more.");
  if (p.maxCount < 0 || p.maxCount > 100000) return bad("contours.max_count must be 0 (all) to 100000.");
  return std::nullopt;
}

bool hasOwnLengths(const ContourParams& params) {
  return params.minLengthPx > 0.0 || params.minWidths != ContourParams{}.minWidths;
}

}  // namespace batten
