// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/centreline.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "core/contour/centreline/ends/faint_ends.h"
#include "core/contour/centreline/ends/gaps.h"
#include "core/contour/centreline/junction/find_stroke_paths.h"
#include "core/contour/centreline/junction/junction_choices.h"
#include "core/contour/centreline/on_ink.h"
#include "core/contour/centreline/page_scale.h"
#include "core/contour/centreline/paper_faces.h"
#include "core/contour/centreline/pencil/graininess.h"
#include "core/contour/centreline/pencil/pencil_bodies.h"
#include "core/contour/centreline/placing/refinement.h"
#include "core/contour/centreline/profile/grey_across.h"
#include "core/contour/centreline/skeleton/skeleton.h"
#include "core/contour/intent/intended_lines.h"
#include "core/contour/merge/stroke_merge.h"
#include "core/contour/merge/turn_cuts.h"
#include "core/image/bits/bit_disc.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/fine_page.h"

namespace batten {
namespace {

constexpr double kPencilSmoothingPx = 3.0;  // of the middles along a pencil stroke, whose grain moves every one
constexpr double kAtRimPx = 2.0;            // a skeleton that was cut at a rim ends nearer to the shape

// A stroke that runs into a shape has no free end there.
void endAtRims(std::vector<StrokePath>& paths, const BitImage& shapes) {
  for (StrokePath& path : paths) {
    if (path.closed || path.points.empty()) continue;
    if (anyInDisc(shapes, path.points.front().at, kAtRimPx)) path.tip[0] = false;
    if (anyInDisc(shapes, path.points.back().at, kAtRimPx)) path.tip[1] = false;
  }
}

// [points] from a turn to both sides, over which it is seen; and its cosine: 75 degrees.
constexpr int kTurnReach = 8;
constexpr double kTurnCos = 0.26;

// Whether two strokes come together here: one would not turn so sharply.
bool turnsBack(const StrokePath& path, int i) {
  const int n = static_cast<int>(path.points.size());
  const Vec2 in = path.points[i].at - path.points[std::max(0, i - kTurnReach)].at;
  const Vec2 out = path.points[std::min(n - 1, i + kTurnReach)].at - path.points[i].at;
  return in.dot(out) < kTurnCos * in.norm() * out.norm();
}

// Two strokes that run to one place of a rim have no junction left before it: they are cut apart where they turn back.
// endAtRims() knows these ends by where they lie.
void cutAtRims(std::vector<StrokePath>& paths, const BitImage& shapes) {
  for (std::size_t k = 0; k < paths.size(); ++k) {
    if (paths[k].closed) continue;
    const int n = static_cast<int>(paths[k].points.size());
    for (int i = n - 3; i >= 2; --i) {
      if (!turnsBack(paths[k], i) || !anyInDisc(shapes, paths[k].points[i].at, kAtRimPx)) continue;
      StrokePath rest = paths[k];
      rest.points.erase(rest.points.begin(), rest.points.begin() + i);
      paths[k].points.resize(i + 1);
      paths.push_back(std::move(rest));
      break;
    }
  }
}

// The skeleton of all ink is cut at the rims of the shapes, so that it runs straight up to them.
StrokePathSet centrelinesOf(const BitImage& ink, const CentrelineOptions& options, const EdgeParams& params,
                            const RunContext& context, JunctionsOf of = JunctionsOf::Pen) {
  const BitImage* shapes = options.shapes;
  const BitImage all = shapes != nullptr ? either(ink, *shapes) : ink;
  const bool isKnown = options.known != nullptr && options.known->ink == all;
  if (isKnown && shapes == nullptr) return {std::move(options.known->paths), std::move(options.known->junctions)};
  BitImage skeleton = isKnown ? std::move(options.known->skeleton) : BitImage(all);
  if (!isKnown && !thinToSkeleton(skeleton, context)) return {};
  if (shapes == nullptr) return findPathsAndJunctions(skeleton, all, params, context, of);
  StrokePathSet found = findPathsAndJunctions(without(std::move(skeleton), *shapes), all, params, context, of);
  cutAtRims(found.paths, *shapes);
  endAtRims(found.paths, *shapes);
  return found;
}

// Ink that touches the border of the page nearly all along is the margin of the scanner or the edge of the sheet.
bool isMargin(const Contour& c, const GreyImage& grey, double pixelsPerPx) {
  constexpr double kTouchPx = 2.0, kMostly = 0.7;  // from the stroke to the border of the page; of its points
  int touching = 0;
  for (const ContourPoint& point : c.points) {
    const Vec2& p = point.at;
    const double toBorder = std::min({p.x(), p.y(), grey.width - p.x(), grey.height - p.y()});
    if (toBorder <= 0.5 * point.widthPx.value_or(0.0f) + kTouchPx * pixelsPerPx) ++touching;
  }
  return static_cast<double>(touching) >= kMostly * static_cast<double>(c.points.size());
}

// How grainy the strokes are is a matter of the scan, whatever page they are followed on.
GraininessMap grainOf(const std::vector<StrokePath>& paths, const GreyImage& grey, const CentrelineOptions& options,
                      const RunContext& context) {
  return options.page != nullptr ? grainOnFinePage(paths, *options.page, context) : GraininessMap(paths, grey, context);
}

// Every stroke path is placed by the rule that suits it.
RefinedStrokes placeStrokePaths(const std::vector<StrokePath>& paths, const GraininessMap* grain, const GreyImage& grey,
                                bool subpixel, const RunContext& context) {
  RefineSettings pen, pencil;
  pencil.rule = CentreRule::Centroid;
  pencil.smoothShiftPx = kPencilSmoothingPx;
  if (!subpixel) pen.rule = CentreRule::None;
  if (!subpixel || grain == nullptr) return refineStrokePaths(paths, grey, pen, context);
  RefinedStrokes all;
  all.contours.resize(paths.size());
  for (const bool isPencil : {false, true}) {
    std::vector<StrokePath> some;
    std::vector<int> number;
    for (int i = 0; i < std::ssize(paths); ++i) {
      if (grain->isPencil(i) != isPencil) continue;
      some.push_back(paths[i]);
      number.push_back(i);
    }
    if (some.empty()) continue;
    RefinedStrokes placed = refineStrokePaths(some, grey, isPencil ? pencil : pen, context);
    for (int k = 0; k < std::ssize(number); ++k) all.contours[number[k]] = std::move(placed.contours[k]);
    all.faint.insert(all.faint.end(), placed.faint.begin(), placed.faint.end());
  }
  return all;
}

// The lines on the enlarged page, placed on the page.
RefinedStrokes placeOnPage(const std::vector<StrokePath>& paths, const GraininessMap* grain, const GreyImage& page,
                           bool subpixel, const RunContext& context) {
  RefinedStrokes placed = placeStrokePaths(fromFinePage(paths), grain, page, subpixel, context);
  for (Contour& c : placed.contours) scaleContour(c, kFineFactor);
  for (Vec2& at : placed.faint) at *= kFineFactor;
  return placed;
}

// [grey] by which a stroke is darker than the paper on both its sides.
double depthBesidePaper(const StrokePath& s, const GreyImage& grey) {
  constexpr double kBesideWidths = 1.25, kTakenBesidePx = 1.5;  // from the middle: paper beyond the blur of the border
  const auto level = [&](const Vec2& at) { return levelOfPixel(grey, at); };
  double sum = 0.0;
  int count = 0;
  for (int i = 1; i + 1 < std::ssize(s.points); ++i) {
    const Vec2 along = s.points[i + 1].at - s.points[i - 1].at;
    if (!(along.norm() > 0.0)) continue;
    const double beside = kBesideWidths * 2.0 * static_cast<double>(s.points[i].radius) + kTakenBesidePx;
    const Vec2 away = beside * leftNormal(along.normalized()), &at = s.points[i].at;
    sum += 0.5 * (level(at + away) + level(at - away)) - level(at);
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

// Within the discs of junctions and corners no grey values are read.
bool isHidden(const StrokePath& s) {
  return std::none_of(s.points.begin(), s.points.end(),
                      [](const StrokePathPoint& p) { return p.part == StrokePart::Ink; });
}

bool isBetweenJunctions(const StrokePath& s) { return !s.closed && !s.tip[0] && !s.tip[1]; }

// [stroke widths] Length of the ink: a free end of a skeleton lies half a width before that of its ink.
double widthsOf(const StrokePath& s) {
  const double ends = s.closed ? 0.0 : (s.tip[0] ? 0.5 : 0.0) + (s.tip[1] ? 0.5 : 0.0);
  return s.length() / s.widthPx() + ends;
}

// A dash of a broken line, long enough to have a direction.
bool isDash(const StrokePath& s, double widths, const BitImage* rows) {
  constexpr double kLeastWidths = 1.5;
  if (rows == nullptr || s.closed || s.points.size() < 3 || widths < kLeastWidths) return false;
  return anyInDisc(*rows, s.points[s.points.size() / 2].at, 1.0);
}

// Strokes shorter than `minWidths` of their widths are blots, but for dashes. Grain breaks the strokes of a pencil and
// makes short ones of its own, which end free. Such are kept where they are as dark as the strokes around, or as ink
// must be by the threshold if they look like strokes of the same pencil: no broader, as marks are, and long enough for
// its width. What parts two faces of the paper was drawn, however short and even where no grey values are read: the bar
// of an A, the rim of a lamp beside another. @return how many such strokes there are, which come last.
int dropShort(std::vector<StrokePath>& paths, const GreyImage& grey, const CentrelineOptions& options, bool anyPencil,
              PaperFaces* faces, const RunContext& context) {
  constexpr double kGrainWidths = 2.5;               // times the shortest: longer ones are no grain
  constexpr double kSamePencil = 1.5;                // of its usual width: two strokes side by side are broader
  constexpr double kAsDark = 0.8, kHalfLevel = 0.5;  // of the depth of the strokes around
  const double minWidths = options.minWidths;
  const std::optional<GraininessMap> grain =
      anyPencil ? std::optional(grainOf(paths, grey, options, context)) : std::nullopt;
  if (context.isCancelled()) return 0;
  const double usualPx = grain ? medianWidth(paths, [&](int i) { return grain->isPencil(i); }) : 0.0;
  std::vector<StrokePath> kept, links;
  for (int i = 0; i < std::ssize(paths); ++i) {
    StrokePath& s = paths[i];
    const double widths = widthsOf(s);
    const bool isPencil = grain && grain->isPencil(i), isShort = s.points.size() < 3 || widths < minWidths;
    if (isShort && isDash(s, widths, options.rows)) {
      kept.push_back(std::move(s));
      continue;
    }
    if (isShort || (!isPencil && isHidden(s))) {
      const bool isLink = faces != nullptr && (s.closed || isBetweenJunctions(s)) && faces->arePartedBy(s);
      if (isLink || !isShort) (isLink ? links : kept).push_back(std::move(s));
      continue;
    }
    if (!isBetweenJunctions(s) && isPencil && widths < kGrainWidths * minWidths) {
      const bool isStroke = s.length() >= minWidths * usualPx && s.widthPx() <= kSamePencil * usualPx;
      const double usualDepth = grain->depthAt(s.points[s.points.size() / 2].at);
      if (depthBesidePaper(s, grey) < (isStroke ? kHalfLevel : kAsDark) * usualDepth) continue;
    }
    kept.push_back(std::move(s));
  }
  paths = std::move(kept);
  std::move(links.begin(), links.end(), std::back_inserter(paths));
  return static_cast<int>(links.size());
}

// A line of which the grey values show no point is none.
bool isSeen(const Contour& c) {
  return std::any_of(c.points.begin(), c.points.end(), [](const ContourPoint& p) { return p.refined; });
}

// Where a pencil's broad and torn strokes meet, and between large junctions of a pen, whole strokes lie hidden: they
// are read all along. Links are not: what parts two faces needs no grey; nor are the lines of a net, which run on and
// on.
void readHidden(std::vector<StrokePath>& paths, int links, const GraininessMap* grain) {
  constexpr double kNetWidths = 10.0;  // a hidden line of a pen that is longer crosses many
  const int count = static_cast<int>(std::ssize(paths));
  for (int i = 0; i < count; ++i) {
    const bool isPencil = grain != nullptr && grain->isPencil(i);
    if (!isHidden(paths[i]) || (!isPencil && (i >= count - links || widthsOf(paths[i]) > kNetWidths))) continue;
    for (StrokePathPoint& p : paths[i].points) {
      if (p.part == StrokePart::Junction) p.part = StrokePart::Ink;
    }
  }
}

// The intended curves, in place of the lines, where the page shows lines drawn over more than once.
void groupByIntent(ContourSet& set, const EdgeParams& params, double width, double minWidths,
                   const RunContext& context) {
  const std::optional<double> given = params.mergeWidths > 0.0 ? std::optional(params.mergeWidths) : std::nullopt;
  auto intended = intendedLines(set.contours, width, given, context);
  if (!intended) return;
  set.contours = std::move(*intended);
  set.report.isGrouped = true;
  set.report.droppedShort +=
      static_cast<int>(std::erase_if(set.contours, [&](const Contour& c) { return c.lengthPx < minWidths * width; }));
}

struct PathsFound {
  StrokePathSet strokes;
  std::optional<BitImage> bodies;  ///< What the strokes became where some are of a pencil.
  double widthPx = 0.0;            ///< Median of the strokes as they were thresholded.
};

// Follows the bodies of pencil strokes on where they fade. @return the grain of the strokes as they then are.
GraininessMap addFaintEnds(PathsFound& found, const GreyImage& grey, const EdgeParams& params,
                           const CentrelineOptions& options, const RunContext& context) {
  GraininessMap grain = grainOf(found.strokes.paths, grey, options, context);
  if (context.isCancelled()) return grain;
  const BitImage all = options.shapes != nullptr ? either(*found.bodies, *options.shapes) : *found.bodies;
  const BitImage trails = followFaintEnds(
      found.strokes.paths, [&](int i) { return grain.isPencil(i); }, all, grey, context, options.pixelsPerPx());
  if (context.isCancelled() || trails.count() == 0) return grain;
  found.bodies = either(std::move(*found.bodies), trails);
  if (options.shapes != nullptr) found.bodies = without(std::move(*found.bodies), *options.shapes);
  found.strokes = centrelinesOf(*found.bodies, options, params, context, JunctionsOf::Pencil);
  return grainOf(found.strokes.paths, grey, options, context);
}

// The stroke paths, with the gaps between them bridged. Unfinished when cancelled.
PathsFound findPaths(const BitImage& strokes, const GreyImage& grey, const EdgeParams& params,
                     const CentrelineOptions& options, const RunContext& context) {
  const BitImage* shapes = options.shapes;
  PathsFound found;
  found.strokes = centrelinesOf(strokes, options, params, context);
  std::vector<StrokePath>& paths = found.strokes.paths;
  if (context.isCancelled()) return found;
  found.widthPx = medianWidth(paths, [](int) { return true; });
  const bool isKnown = shapes == nullptr && options.known != nullptr && options.known->ink == strokes;
  const GraininessMap grain = isKnown ? std::move(options.known->grain) : grainOf(paths, grey, options, context);
  if (options.known != nullptr) options.known->ink = options.known->skeleton = BitImage();
  const auto isPencil = [&](int i) { return grain.isPencil(i); };
  bool anyPencil = false;
  for (int i = 0; i < std::ssize(paths); ++i) anyPencil = anyPencil || isPencil(i);
  std::vector<bool> pencil;
  if (anyPencil) {
    found.bodies = pencilBodies(strokes, grey, paths, grain, {options.pixelsPerPx(), options.clear}, context);
    if (context.isCancelled()) return found;
    found.strokes = centrelinesOf(*found.bodies, options, params, context, JunctionsOf::Pencil);
    const GraininessMap ofBodies = addFaintEnds(found, grey, params, options, context);
    if (context.isCancelled()) return found;
    for (int i = 0; i < std::ssize(paths); ++i) pencil.push_back(ofBodies.isPencil(i));
  } else {
    pencil.assign(paths.size(), false);
  }
  const BitImage& ink = found.bodies ? *found.bodies : strokes;
  // Merging sees bundles as a whole.
  const bool isMerged = params.mergeWidths > 0.0 || params.intent;
  const FollowedInk followed{ink, grey, pencil};
  if (!isMerged) joinThroughInk(paths, followed, found.strokes.junctions, params, context);
  bridgeGaps(paths, followed, params, context);
  return found;
}

// One line of several strokes, by whichever of the two ways is requested.
void joinStrokes(ContourSet& set, const EdgeParams& params, double width, double minWidths, const RunContext& context) {
  if (params.intent) {
    groupByIntent(set, params, width, minWidths, context);
  } else if (params.mergeWidths * width >= 1.0) {
    // Between middles: the paper between two strokes is a width less.
    set.contours = cutAtTurns(mergeStrokes(set.contours, (params.mergeWidths + 1.0) * width, context), width, context);
  }
}

Result<ContourSet> traceStrokes(const BitImage& strokes, const GreyImage& grey, const EdgeParams& params,
                                const RunContext& context, const CentrelineOptions& options) {
  PathsFound found = findPaths(strokes, grey, params, options, context);
  if (context.isCancelled()) return cancelled();
  std::vector<StrokePath>& paths = found.strokes.paths;
  const bool anyPencil = found.bodies.has_value();
  const int pixelsPerPx = options.pixelsPerPx();
  ContourSet set;
  set.report.found = static_cast<int>(paths.size());
  const BitImage& ink = found.bodies ? *found.bodies : strokes;
  BitImage seen = options.shapes != nullptr ? either(ink, *options.shapes) : ink;
  PaperFaces faces(seen, found.widthPx, context);
  // Between strokes that are merged into one there is no face that was drawn; who asks for longer lines wants no links.
  const bool isMerged = params.mergeWidths > 0.0 && !params.intent;
  const bool keepsLinks = !isMerged && options.minWidths <= ContourParams{}.minWidths;
  const int links = dropShort(paths, grey, options, anyPencil, keepsLinks ? &faces : nullptr, context);
  if (context.isCancelled()) return cancelled();
  set.report.droppedShort = set.report.found - static_cast<int>(paths.size());
  std::optional<GraininessMap> ofKept;
  if (anyPencil) {
    ofKept = grainOf(paths, grey, options, context);
  }
  const GraininessMap* grain = ofKept ? &*ofKept : nullptr;
  readHidden(paths, links, grain);
  RefinedStrokes placed = options.page != nullptr ? placeOnPage(paths, grain, *options.page, params.subpixel, context)
                                                  : placeStrokePaths(paths, grain, grey, params.subpixel, context);
  if (context.isCancelled()) return cancelled();
  const auto firstLink = placed.contours.end() - links;
  std::vector<Contour> parting(std::make_move_iterator(firstLink), std::make_move_iterator(placed.contours.end()));
  placed.contours.erase(firstLink, placed.contours.end());
  set.contours = std::move(placed.contours);
  const auto isNoLine = [](const Contour& c) { return c.points.size() < 3; };
  const auto dropped = std::erase_if(parting, isNoLine) + std::erase_if(set.contours, [&](const Contour& c) {
                         return isNoLine(c) || (params.subpixel && !isSeen(c));
                       });
  set.report.droppedShort += static_cast<int>(dropped);
  for (const Vec2& at : placed.faint) setDisc(seen, at, pixelsPerPx);
  set.contours = keepOnInk(std::move(set.contours), seen, pixelsPerPx);
  if (!set.contours.empty()) set.report.widthPx = found.widthPx;
  joinStrokes(set, params, found.widthPx, options.minWidths, context);
  if (params.intent && !set.report.isGrouped && !context.isCancelled()) {
    // Without lines drawn over more than once the page is traced as if nobody had asked for grouping.
    EdgeParams plain = params;
    plain.intent = false;
    return traceStrokes(strokes, grey, plain, context, options);
  }
  // Links alone are a net, whose borders tell more.
  if (!set.report.isGrouped && !set.contours.empty())
    std::move(parting.begin(), parting.end(), std::back_inserter(set.contours));
  if (!params.intent && params.mergeWidths <= 0.0)
    set.junctions = junctionsOfLines(std::move(found.strokes.junctions), set.contours);
  if (context.isCancelled()) return cancelled();
  set.report.droppedMargins =
      static_cast<int>(std::erase_if(set.contours, [&](const Contour& c) { return isMargin(c, grey, pixelsPerPx); }));
  return set;
}

}  // namespace

Result<ContourSet> centrelines(const BitImage& strokes, const GreyImage& grey, const EdgeParams& params,
                               const RunContext& context, const CentrelineOptions& options) {
  if (strokes.width <= 0 || strokes.height <= 0) return ContourSet{};
  if (grey.width != strokes.width || grey.height != strokes.height) {
    return fail(ErrorCode::BadParameter, "The mask and the scan differ in size.");
  }
  try {
    return traceStrokes(strokes, grey, params, context, options);
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to find the centre lines.", e.what());
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to find the centre lines.");
  }
}

}  // namespace batten
