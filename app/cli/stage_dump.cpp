// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/stage_dump.h"

#include <algorithm>
#include <cmath>
#include "core/curve/arc_length.h"
#include "core/image/threshold/region_values.h"

namespace batten::cli {
namespace {

constexpr Colour kSketchColour{60, 110, 200};  // of lines in pictures
constexpr Colour kFairedColour{210, 40, 40};   // of lines in pictures
constexpr Colour kCornerColour{20, 150, 60};   // of marks in pictures
// of neighbours, to tell them apart
constexpr std::array<Colour, 6> kCycle = {Colour{200, 50, 50}, Colour{40, 110, 200}, Colour{20, 150, 60},
                                          Colour{190, 110, 0}, Colour{140, 60, 180}, Colour{0, 140, 150}};

std::uint8_t toByte(double level) { return static_cast<std::uint8_t>(std::lround(std::clamp(level, 0.0, 255.0))); }

/// A grey picture from a function of the pixel.
template <class Level>
Picture greyPicture(const GreyImage& scan, const Level& level) {
  Picture picture(scan.width, scan.height);
  for (int y = 0; y < scan.height; ++y) {
    for (int x = 0; x < scan.width; ++x) {
      const std::uint8_t value = toByte(level(x, y));
      picture.set(x, y, {value, value, value});
    }
  }
  return picture;
}

Picture maskPicture(const GreyImage& scan, const BitImage& mask) {
  return greyPicture(scan, [&](int x, int y) { return mask.at(x, y) ? 0.0 : 255.0; });
}

Picture lightenedScan(const GreyImage& scan) {
  return greyPicture(scan, [&](int x, int y) { return 128.0 + 0.5 * scan.level(x, y); });
}

Picture thresholdPicture(const GreyImage& scan, const RegionThresholds& thresholds) {
  Picture picture = greyPicture(scan, [](int, int) { return 0.0; });
  for (int region = 0; region < kRegions; ++region) {
    const RegionBounds bounds = regionBounds(scan.width, scan.height, region);
    const std::uint8_t level = toByte(thresholds.level[region]);
    for (int y = bounds.y0; y < bounds.y1; ++y) {
      for (int x = bounds.x0; x < bounds.x1; ++x) picture.set(x, y, {level, level, level});
    }
  }
  return picture;
}

/// Width of drawn lines: visible when the whole page is looked at.
double lineWidth(const GreyImage& scan) { return std::max(1.5, std::hypot(scan.width, scan.height) / 1500.0); }

PictureLine lineOf(const NurbsCurve& curve, const PageFrame& frame, Colour colour, double width) {
  PictureLine line{{}, false, colour, width};
  const double lengthPx = frame.lengthToImage(ArcLength(curve).total());
  const int count = std::clamp(static_cast<int>(lengthPx / 2.0), 16, 20000);
  for (const CurveSample& s : sampleByArcLength(curve, count)) line.points.push_back(frame.pointToImage(s.point));
  return line;
}

PictureLine circleAt(const Vec2& centre, double radius, double width) {
  PictureLine line{{}, true, kCornerColour, width};
  for (int i = 0; i < 32; ++i)
    line.points.push_back(centre + radius * Vec2(std::cos(i * M_PI / 16), std::sin(i * M_PI / 16)));
  return line;
}

std::vector<PictureLine> linesOf(StageId stage, const PipelineOutput& out, double width) {
  std::vector<PictureLine> lines;
  const auto colour = [&] { return kCycle[lines.size() % kCycle.size()]; };
  if (stage == StageId::Contours) {
    for (const Contour& c : out.contours->contours) lines.push_back({positionsOf(c.points), c.closed, colour(), width});
  } else if (stage == StageId::Pieces) {
    for (const Piece& p : out.pieces->pieces) lines.push_back({positionsOf(p.points), p.closed, colour(), width});
    for (const Corner& c : out.pieces->corners) lines.push_back(circleAt(c.positionPx, 5.0 * width, width));
  } else if (stage == StageId::Segments) {
    for (const PieceSegments& p : out.segments->pieces) {
      for (const Station& s : p.stations) lines.push_back({{s.from, s.to}, false, colour(), width});
    }
  } else if (stage == StageId::Curves) {
    for (const TracedCurve& c : out.constructed->curves)
      lines.push_back(lineOf(c.sketched, out.frame, kSketchColour, width));
  } else if (stage == StageId::Faired) {
    for (const TracedCurve& c : out.faired->curves) {
      lines.push_back(lineOf(c.sketched, out.frame, kSketchColour, width));
      if (c.included) lines.push_back(lineOf(c.faired, out.frame, kFairedColour, width));
    }
  }
  return lines;
}

bool isThere(StageId stage, const PipelineOutput& out) {
  switch (stage) {
    case StageId::Thresholds:
      return out.thresholds != nullptr;
    case StageId::Binary:
      return out.binary != nullptr;
    case StageId::Filtered:
      return out.filtered != nullptr;
    case StageId::Edges:
      return out.edges != nullptr;
    case StageId::Contours:
      return out.contours != nullptr;
    case StageId::Pieces:
      return out.pieces != nullptr;
    case StageId::Segments:
      return out.segments != nullptr;
    case StageId::Curves:
      return out.constructed != nullptr;
    case StageId::Faired:
      return out.faired != nullptr;
  }
  return false;
}

Picture stagePicture(StageId stage, const Scan& scan, const PipelineOutput& out) {
  if (stage == StageId::Thresholds) return thresholdPicture(tracedGrey(scan, out), *out.thresholds);
  if (stage == StageId::Binary) return maskPicture(scan.grey, *out.binary);
  if (stage == StageId::Filtered) return maskPicture(scan.grey, out.filtered->ink);
  if (stage == StageId::Edges) return maskPicture(scan.grey, *out.edges);
  Picture picture = lightenedScan(scan.grey);
  drawLines(picture, linesOf(stage, out, lineWidth(scan.grey)));
  return picture;
}

tl::unexpected<Error> notThere(std::string_view dumpName) {
  return fail(ErrorCode::NoCurve, "There is no picture of \"" + std::string(dumpName) + "\": the run ended before it.");
}

}  // namespace

std::vector<std::string> dumpNames() {
  std::vector<std::string> names{"log", "page", "paper"};
  for (const StageId stage : kStages) names.emplace_back(name(stage));
  return names;
}

Result<Picture> dumpStage(std::string_view dumpName, const Scan& scan, const Recipe& recipe,
                          const PipelineOutput& out) {
  const GreyImage& grey = scan.grey;
  if (dumpName == "log") {
    const LogParams log{true, recipe.log.factor};
    return greyPicture(grey, [&](int x, int y) { return logTone(grey.level(x, y), log); });
  }
  if (dumpName == "page") {
    if (!out.page) return notThere(dumpName);
    const GreyImage& page = tracedGrey(scan, out);
    return greyPicture(page, [&](int x, int y) { return page.level(x, y); });
  }
  if (dumpName == "paper") {
    if (!out.thresholds) return notThere(dumpName);
    const PaperBackground& paper = out.thresholds->paper;
    const GreyImage& page = tracedGrey(scan, out);
    return greyPicture(
        page, [&](int x, int y) { return 255.0 * page.level(x, y) / std::max(1.0, paper.at(x + 0.5, y + 0.5)); });
  }
  const auto stage = stageFromName(dumpName);
  if (!stage || !isThere(*stage, out)) return notThere(dumpName);
  return stagePicture(*stage, scan, out);
}

}  // namespace batten::cli
