// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/stage_keys.h"

#include <algorithm>
#include <span>

#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/curve_stages.h"
#include "core/pipeline/run/piece_choices.h"

namespace batten {
namespace {

constexpr int kNoNumber = -2;  // no number of its own: none that KeptExtrema has

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

void add(HashBuilder& h, const PieceChoice& c) {
  h.integer(c.isPart)
      .integer(c.included)
      .integer(c.mode ? static_cast<int>(*c.mode) : -1)
      .integer(c.target ? static_cast<int>(*c.target) : -1);
  add(h, c.toleranceMm);
  add(h, c.lowPassMm);
  h.integer(c.keepExtrema ? numberOf(*c.keepExtrema) : kNoNumber);
  h.integer(c.tolerancePolicy ? static_cast<int>(*c.tolerancePolicy) : -1)
      .integer(c.means ? static_cast<int>(*c.means) : -1);
  for (const auto& hold : {c.startHold, c.endHold})
    h.integer(hold.has_value()).integer(hold && hold->tangent).integer(hold && hold->curvature);
  for (const auto* places : {&c.anchorsPx, &c.keepPx, &c.splitsPx}) {
    addCount(h, *places);
    for (const Vec2& p : *places) add(h, p);
  }
  add(h, c.profile);
  h.integer(c.spans ? static_cast<int>(*c.spans) : -1);
  addCount(h, c.spanTargets);
  for (const SpanChoice& span : c.spanTargets) {
    add(h, span.placePx);
    h.integer(span.degree);
  }
}

void addMethods(HashBuilder& h, const Recipe& recipe) {
  const std::vector<PieceChoice> choices = choicesForMethods(recipe);
  addCount(h, choices);
  for (const PieceChoice& choice : choices) {
    addCount(h, choice.anchorsPx);
    for (const Vec2& p : choice.anchorsPx) add(h, p);
    h.integer(choice.method ? static_cast<int>(*choice.method) : -1);
    h.integer(choice.detail ? 1 : 0).number(choice.detail.value_or(0.0));
  }
}

ContentHash scanKey(const Scan& scan) {
  HashBuilder h;
  h.integer(scan.grey.width).integer(scan.grey.height);
  // A scan that was not read from a file has no file hash; its pixels identify it.
  const bool hasFile =
      std::any_of(scan.fileHash.bytes.begin(), scan.fileHash.bytes.end(), [](auto b) { return b != 0; });
  if (scan.rectification) {
    for (const Vec2& corner : scan.rectification->cornersPx) add(h, corner);
    h.number(scan.rectification->bendPx).number(scan.rectification->outsideShare);
  }
  h.text(scan.rectifyNote);
  if (hasFile) h.hash(scan.fileHash).integer(scan.page.number).number(scan.page.pdfDpi);
  if (hasFile) return h.finish();
  if (!scan.colour.isEmpty()) h.bytes(std::as_bytes(std::span(scan.colour.pixels)));
  return h.bytes(std::as_bytes(std::span(scan.grey.pixels))).finish();
}

ContentHash preparedKey(const ContentHash& scan, const PreparationParams& params) {
  HashBuilder h;
  h.text("prepared page")
      .hash(scan)
      .integer(static_cast<int>(params.lines))
      .integer(static_cast<int>(params.colour))
      .integer(static_cast<int>(params.rulings))
      .integer(static_cast<int>(params.sheet))
      .integer(static_cast<int>(params.shading));
  for (const auto* list : {&params.inks.keep, &params.inks.drop}) {
    addCount(h, *list);
    for (const InkColour& ink : *list) add(h, ink.hueDeg);
  }
  h.number(params.inks.rangeDeg);
  return h.finish();
}

/// What of the recipe the contours are made of but for its parameters; the pen strokes come on top, see stageKeys.
void addContourChoices(HashBuilder& h, const Recipe& r) {
  addCount(h, r.regions);
  for (const RegionOfInterest& region : r.regions) {
    addCount(h, region.cornersPx);
    for (const Vec2& p : region.cornersPx) add(h, p);
  }
  addCount(h, r.edges.choices);
  for (const EdgeChoice& choice : r.edges.choices) {
    add(h, choice.positionPx);
    h.integer(static_cast<int>(choice.mode));
  }
  addCount(h, r.edges.painted);
  for (const PaintedInk& painted : r.edges.painted) {
    addCount(h, painted.coursePx);
    for (const Vec2& p : painted.coursePx) add(h, p);
    h.number(painted.radiusPx).integer(static_cast<int>(painted.mode));
  }
  addCount(h, r.edges.junctions);
  for (const JunctionChoice& choice : r.edges.junctions) {
    add(h, choice.positionPx);
    addCount(h, choice.pairs);
    for (const BranchPair& pair : choice.pairs) {
      add(h, pair.firstPx);
      add(h, pair.secondPx);
    }
  }
}

/// Adds to the digest what of the recipe a stage reads itself: its parameters, so that none can be forgotten, and the
/// choices that no table lists.
void addOwn(HashBuilder& h, StageId stage, const Recipe& r, const PageFrame& frame) {
  for (const Parameter& p : parameterTable()) {
    if (p.stage == stage && !p.isForDisplay) h.text(p.name).text(p.get(r));
  }
  switch (stage) {
    case StageId::Thresholds:
    case StageId::Binary:
    case StageId::Filtered:
    case StageId::Edges:
    case StageId::Segments:
      break;
    case StageId::Contours:
      addContourChoices(h, r);
      break;
    case StageId::Pieces:
      addCount(h, r.cornerMarks);
      for (const CornerMark& mark : r.cornerMarks) add(h, mark.positionPx);
      addCount(h, r.refusedCornersPx);
      for (const Vec2& place : r.refusedCornersPx) add(h, place);
      break;
    case StageId::Curves:
      addMethods(h, r);
      h.number(frame.mmPerPx).integer(frame.heightPx).number(frame.leftMm).number(frame.bottomMm);
      addCount(h, r.segmentPoints);
      for (const SegmentPoint& point : r.segmentPoints) add(h, point.positionPx);
      addCount(h, r.extremumChoices);
      for (const ExtremumChoice& choice : r.extremumChoices) {
        add(h, choice.positionPx);
        h.integer(choice.keep);
      }
      break;
    case StageId::Faired:
      addCount(h, r.choices);
      for (const PieceChoice& choice : r.choices) add(h, choice);
      for (const CornerMark& mark : r.cornerMarks)
        h.number(mark.roundMm).integer(static_cast<int>(mark.roundBy)).integer(static_cast<int>(mark.joint));
      break;
  }
}

void add(HashBuilder& h, const ImportedLine& line) {
  h.integer(line.closed);
  addCount(h, line.curves);
  for (const auto& [curve, name] : line.curves) {
    h.integer(curve.degree()).integer(std::ssize(curve.knots())).integer(std::ssize(curve.weights()));
    for (const double knot : curve.knots()) h.number(knot);
    for (const Vec2& p : curve.controlPoints()) add(h, p);
    for (const double weight : curve.weights()) h.number(weight);
  }
  addCount(h, line.points);
  for (const Vec2& p : line.points) add(h, p);
  addCount(h, line.corners);
  for (const int corner : line.corners) h.integer(corner);
}

ContentHash withImports(const ContentHash& lines, const Recipe& recipe, const PageFrame& frame) {
  HashBuilder h;
  h.text("imports")
      .hash(lines)
      .number(frame.mmPerPx)
      .integer(frame.heightPx)
      .number(frame.leftMm)
      .number(frame.bottomMm);
  addCount(h, recipe.imports);
  for (const ImportedFile& file : recipe.imports) {
    h.text(file.source);
    addCount(h, file.lines);
    for (const ImportedLine& line : file.lines) add(h, line);
  }
  return h.finish();
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

PreparationParams preparationOf(const Recipe& recipe) {
  PreparationParams params = recipe.preparation;
  if (recipe.paper.flatten && recipe.threshold.mode != ThresholdMode::Manual) return params;
  params.shading = ShadingUse::Keep;
  // The user's levels are those of the scan.
  if (params.lines == LineTone::Auto) params.lines = LineTone::Darker;
  return params;
}

StageKeys stageKeys(const Scan& scan, const Recipe& recipe, const PageFrame& frame) {
  StageKeys result;
  const ContentHash first = scanKey(scan);
  const ContentHash* input = &first;
  result.page = preparedKey(first, preparationOf(recipe));
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    HashBuilder h;
    h.text(name(kStages[i])).hash(*input);
    addOwn(h, kStages[i], recipe, frame);
    result.keys[i] = h.finish();
    if (kStages[i] == StageId::Filtered) result.fine = HashBuilder().text("fine page").hash(result.keys[i]).finish();
    if (kStages[i] == StageId::Contours) {
      result.traced = result.keys[i];
      if (!recipe.penStrokes.empty()) result.keys[i] = withStrokes(result.traced, recipe);
      if (!recipe.imports.empty()) result.keys[i] = withImports(result.keys[i], recipe, frame);
    }
    // The edges picture is only looked at; contours are made from the filtered mask.
    if (kStages[i] != StageId::Edges) input = &result.keys[i];
  }
  return result;
}

}  // namespace batten
