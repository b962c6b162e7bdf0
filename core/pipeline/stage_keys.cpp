// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/stage_keys.h"

#include <algorithm>
#include <span>

namespace batten {
namespace {

/// To be raised for a stage whose algorithm gives other results than before.
constexpr std::array<int, kStages.size()> kAlgorithmVersions = {1, 1, 1, 1, 1, 1, 1, 1, 1};

void add(HashBuilder& h, const std::optional<double>& v) {
  h.integer(v.has_value());
  if (v) h.number(*v);
}
void add(HashBuilder& h, const Vec2& p) { h.number(p.x()).number(p.y()); }
/// Before every list, so that what follows it cannot be taken for more of it.
template <class T>
void addCount(HashBuilder& h, const std::vector<T>& list) {
  h.integer(static_cast<std::int64_t>(list.size()));
}
void add(HashBuilder& h, const std::vector<ProfilePoint>& profile) {
  addCount(h, profile);
  for (const ProfilePoint& p : profile) h.number(p.fraction).number(p.kappa);
}

void add(HashBuilder& h, const ThresholdParams& p) {
  h.integer(static_cast<int>(p.mode)).number(p.manualLevel).number(p.strength).integer(p.interpolate).number(p.reach);
  h.integer(p.speckArea).integer(p.holeArea);
  for (const auto& cell : p.grid) add(h, cell);
}
void add(HashBuilder& h, const FilterParams& p) {
  h.integer(p.coefficient).integer(p.iterations).integer(static_cast<int>(p.order)).integer(static_cast<int>(p.border));
}
void add(HashBuilder& h, const EdgeParams& p) {
  h.integer(static_cast<int>(p.mode)).integer(p.internal).integer(p.subpixel).number(p.strokeWidth).number(p.gapFactor);
  h.number(p.mergeWidths).number(p.spurFactor).number(p.maxBendDeg);
}
void add(HashBuilder& h, const SegmentParams& p) {
  h.integer(static_cast<int>(p.mode)).integer(p.count).number(p.spacingPx).number(p.tolerancePx);
}
void add(HashBuilder& h, const ConstructParams& p) {
  h.integer(static_cast<int>(p.method)).number(p.derivativeMagnitude).integer(p.magnitudeAsInPaper);
  h.integer(static_cast<int>(p.gradients)).integer(p.degree).number(p.keepExtremaCost).number(p.reduceShare);
  h.integer(static_cast<int>(p.knots)).integer(static_cast<int>(p.removal)).number(p.removalStepPx);
  h.number(p.removalTolerancePx);
  h.number(p.closenessPx);
  h.number(p.lowPass).integer(static_cast<int>(p.typical)).number(p.growingStopDeg).integer(p.growingAsInPaper);
}
void add(HashBuilder& h, const FairingParams& p) {
  h.integer(static_cast<int>(p.mode)).integer(p.target).number(p.toleranceMm);
  h.integer(p.startHold.tangent).integer(p.startHold.curvature).integer(p.endHold.tangent).integer(p.endHold.curvature);
  h.integer(static_cast<int>(p.targets.quantity)).integer(p.targets.monotone).integer(p.targets.samples);
  h.number(p.lowPassMm).integer(p.keepExtrema);
  add(h, p.profile);
}
void add(HashBuilder& h, const PieceChoice& c) {
  add(h, c.anchorPx);
  h.integer(c.included).integer(c.mode ? static_cast<int>(*c.mode) : -1).integer(c.target.value_or(-1));
  add(h, c.toleranceMm);
  add(h, c.lowPassMm);
  h.integer(c.keepExtrema.value_or(-2));
  for (const auto* places : {&c.keepPx, &c.splitsPx}) {
    addCount(h, *places);
    for (const Vec2& p : *places) add(h, p);
  }
  add(h, c.profile);
}

/// The choices with a method; no others compete for a curve's method.
void addMethods(HashBuilder& h, const std::vector<PieceChoice>& choices) {
  h.integer(std::count_if(choices.begin(), choices.end(), [](const PieceChoice& c) { return c.method.has_value(); }));
  for (const PieceChoice& choice : choices) {
    if (!choice.method) continue;
    add(h, choice.anchorPx);
    h.integer(static_cast<int>(*choice.method));
  }
}

ContentHash scanKey(const Scan& scan) {
  HashBuilder h;
  h.integer(scan.grey.width).integer(scan.grey.height);
  // A scan that was not read from a file has no file hash; its pixels identify it.
  const bool hasFile =
      std::any_of(scan.fileHash.bytes.begin(), scan.fileHash.bytes.end(), [](auto b) { return b != 0; });
  return hasFile ? h.hash(scan.fileHash).finish() : h.bytes(std::as_bytes(std::span(scan.grey.pixels))).finish();
}

/// Adds to the digest what of the recipe a stage reads itself.
void addOwn(HashBuilder& h, StageId stage, const Recipe& r, const PageFrame& frame) {
  switch (stage) {
    case StageId::Thresholds:
      h.integer(r.paper.flatten);
      add(h, r.threshold);
      break;
    case StageId::Binary:
      add(h, r.threshold);
      break;
    case StageId::Filtered:
      add(h, r.filter);
      break;
    case StageId::Edges:
      break;
    case StageId::Contours:
      add(h, r.edges);
      h.number(r.contours.minLengthPx).integer(r.contours.maxCount);
      addCount(h, r.regions);
      for (const RegionOfInterest& region : r.regions) {
        addCount(h, region.cornersPx);
        for (const Vec2& p : region.cornersPx) add(h, p);
      }
      break;  // the pen strokes come on top, see stageKeys
    case StageId::Pieces:
      h.number(r.corners.snapDistancePx).integer(r.corners.exact);
      addCount(h, r.cornerMarks);
      for (const CornerMark& mark : r.cornerMarks) add(h, mark.positionPx);
      break;
    case StageId::Segments:
      add(h, r.segments);
      break;
    case StageId::Curves:
      add(h, r.construct);
      addMethods(h, r.choices);
      h.number(frame.mmPerPx).integer(frame.heightPx);
      addCount(h, r.segmentPoints);
      for (const SegmentPoint& point : r.segmentPoints) add(h, point.positionPx);
      addCount(h, r.extremumChoices);
      for (const ExtremumChoice& choice : r.extremumChoices) {
        add(h, choice.positionPx);
        h.integer(choice.keep);
      }
      break;
    case StageId::Faired:
      add(h, r.fairing);
      addCount(h, r.choices);
      for (const PieceChoice& choice : r.choices) add(h, choice);
      for (const CornerMark& mark : r.cornerMarks) h.number(mark.roundMm);
      break;
  }
}

ContentHash withStrokes(const ContentHash& traced, const Recipe& recipe) {
  HashBuilder h;
  h.text("pen strokes").hash(traced);
  addCount(h, recipe.penStrokes);
  for (const PenStroke& stroke : recipe.penStrokes) {
    h.integer(stroke.closed);
    addCount(h, stroke.points);
    for (const Vec2& p : stroke.points) add(h, p);
  }
  return h.finish();
}

}  // namespace

StageKeys stageKeys(const Scan& scan, const Recipe& recipe, const PageFrame& frame) {
  StageKeys result;
  const ContentHash first = scanKey(scan);
  const ContentHash* input = &first;
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    HashBuilder h;
    h.text(name(kStages[i])).integer(kAlgorithmVersions[i]).hash(*input);
    addOwn(h, kStages[i], recipe, frame);
    result.keys[i] = h.finish();
    if (kStages[i] == StageId::Contours) {
      result.traced = result.keys[i];
      if (!recipe.penStrokes.empty()) result.keys[i] = withStrokes(result.traced, recipe);
    }
    // The edges picture is only looked at; contours are made from the filtered mask.
    if (kStages[i] != StageId::Edges) input = &result.keys[i];
  }
  return result;
}

}  // namespace batten
