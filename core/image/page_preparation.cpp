// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/page_preparation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>
#include <utility>

#include "core/base/number_text.h"
#include "core/image/bits/run_pieces.h"
#include "core/image/colour/coloured_ink.h"
#include "core/image/ruling/dot_grid.h"
#include "core/image/ruling/find_rulings.h"
#include "core/image/ruling/remove_rulings.h"
#include "core/image/ruling/ruling_count.h"
#include "core/image/sheet/paint_over.h"
#include "core/image/sheet/sheet_and_holes.h"
#include "core/image/threshold/bright_lines.h"
#include "core/image/threshold/region_values.h"
#include "core/image/tones/shading.h"
#include "core/image/tones/tone_areas.h"
#include "core/image/tones/without_tones.h"

namespace batten {
namespace {

void takeColouredInk(const Scan& scan, PreparedPage& page, const RunContext& context) {
  std::optional<ColouredInk> ink = darkenColouredInk(scan.grey, scan.colour, context);
  if (!ink) return;
  page.colouredShare = static_cast<double>(ink->pixels) / static_cast<double>(scan.grey.pixels.size());
  page.grey = std::move(ink->grey);
}

std::string rulingNote(const std::vector<RulingFamily>& families) {
  std::string counts;
  for (const bool runsDown : {false, true}) {
    const int lines = ruledLines(families, runsDown);
    if (lines == 0) continue;
    counts += (counts.empty() ? "" : " and ") + (runsDown ? counted(lines, "ruled line down", "ruled lines down")
                                                          : counted(lines, "ruled line across", "ruled lines across"));
  }
  return counts + " the page were removed; paper.rulings=keep restores them.";
}

constexpr int kPaperOneOf = 10;            // the brightest tenth of a region is its paper
constexpr double kCrossingWidths = 2.0;    // [line widths] diagonal of what is left where two lines cross
constexpr double kLeastDrawnShare = 0.01;  // of the pixels of the lines: a drawing on ruled paper has more
// a note
constexpr const char* kNothingButRulings =
    "The page contains only evenly spaced dark lines; they are treated as the drawing.";
// an error
constexpr const char* kNoMemory = "Not enough memory to prepare the page; scan at a lower resolution or crop.";
constexpr int kRulingRounds = 3;  // the ruling of the back may shine through beside that of the front

const GreyImage& greyOf(const Scan& scan, const PreparedPage& page) { return page.grey ? *page.grey : scan.grey; }

/// Whether dark lines at even distances are all that is on the page: then they were drawn. What the eraser leaves where
/// two of them cross, and at the border of the page, is nothing.
bool isNothingButRulings(const GreyImage& with, const GreyImage& without, const std::vector<RulingFamily>& families,
                         const RunContext& context) {
  double widthPx = 0.0, spacingPx = 0.0, depth = 1.0;
  for (const RulingFamily& family : families) {
    if (family.lines.size() == 1) continue;  // a margin
    widthPx = std::max(widthPx, family.widthPx);
    spacingPx = std::max(spacingPx, family.spacingPx);
    depth = std::min(depth, family.depth);
  }
  if (depth <= kDarkRuling) return false;
  const int margin = static_cast<int>(std::ceil(spacingPx));
  BitImage left(with.width, with.height);
  std::int64_t removed = 0;
  for (int region = 0; region < kRegions; ++region) {
    if (context.isCancelled()) return false;
    const RegionBounds b = regionBounds(with.width, with.height, region);
    const auto counts = regionHistogram(without, region);
    std::int64_t darker = 0;
    int paper = 255;
    for (const std::int64_t brighter = (b.x1 - b.x0) * (b.y1 - b.y0) / kPaperOneOf; paper > 0; --paper)
      if ((darker += counts[paper]) > brighter) break;
    const double limit = paper * (1.0 - 0.5 * depth) * GreyImage::kGreyUnit;
    for (int y = std::max(b.y0, margin); y < std::min(b.y1, with.height - margin); ++y) {
      for (int x = std::max(b.x0, margin); x < std::min(b.x1, with.width - margin); ++x) {
        if (without.row(y)[x] < limit)
          left.set(x, y, true);
        else
          removed += with.row(y)[x] < limit ? 1 : 0;
      }
    }
  }
  const BitImage drawn = keepPieces(left, {.minArea = 1, .minDiagonal = kCrossingWidths * (widthPx + 1.0)}, context);
  return static_cast<double>(drawn.count()) < kLeastDrawnShare * static_cast<double>(removed);
}

void leaveOutRulings(const Scan& scan, PreparedPage& page, const RunContext& context) {
  std::optional<GreyImage> before;  // absent: the scan's own
  for (int round = 0; round < kRulingRounds; ++round) {
    const std::vector<RulingFamily> found = findRulings(greyOf(scan, page), context);
    if (context.isCancelled() || found.empty()) break;
    GreyImage without = withoutRulings(greyOf(scan, page), found, context);
    if (context.isCancelled() || without.pixels == greyOf(scan, page).pixels) break;  // lines that cannot be taken out
    if (page.rulings.empty()) before = std::move(page.grey);
    page.grey = std::move(without);
    page.rulings.insert(page.rulings.end(), found.begin(), found.end());
  }
  if (page.rulings.empty() || context.isCancelled()) return;
  if (isNothingButRulings(before ? *before : scan.grey, *page.grey, page.rulings, context)) {
    page.grey = std::move(before);
    page.rulings.clear();
    page.notes.emplace_back(kNothingButRulings);
    return;
  }
  page.notes.push_back(rulingNote(page.rulings));
}

void leaveOutDots(const Scan& scan, PreparedPage& page, const RunContext& context) {
  page.dots = findDotGrid(greyOf(scan, page), context);
  if (page.dots.empty()) return;
  if (!page.grey) page.grey = scan.grey;
  page.grey = withoutDots(std::move(*page.grey), page.dots);
  page.notes.push_back(std::to_string(page.dots.size()) +
                       " dots of dotted paper were removed; paper.rulings=keep restores them.");
}

void paintOverHoles(const Scan& scan, const BindingHoles& holes, PreparedPage& page, const RunContext& context) {
  BitImage inside(holes.cells.width, holes.cells.height);
  for (int j = 0; j < inside.height; ++j) {
    for (int i = 0; i < inside.width; ++i) inside.set(i, j, !holes.cells.at(i, j));
  }
  page.grey = paintedOver(greyOf(scan, page), inside, holes.cellPx, context);
  page.bindingHoles = holes.count;
  page.notes.push_back("A row of " + std::to_string(holes.count) +
                       " binding holes was removed; paper.sheet=off keeps it.");
}

void cutOffTable(const Scan& scan, PreparedPage& page, const RunContext& context) {
  if (scan.rectification) {
    page.sheet = sheetWithinRim(scan.grey.width, scan.grey.height);
    page.grey = onlyTheSheet(greyOf(scan, page), *page.sheet, context);
    page.notes.push_back("A rim of " + roundedText(page.sheet->outlinePx.front().x(), 0) +
                         " px along the border of the rectified page, where the edge of its sheet lies, was cut off; "
                         "paper.sheet=off keeps it.");
    return;
  }
  auto [holes, sheet] = findSheetAndHoles(scan.grey, scan.colour, context);
  if (holes) paintOverHoles(scan, *holes, page, context);
  if (context.isCancelled() || !sheet) return;
  page.grey = onlyTheSheet(greyOf(scan, page), *sheet, context);
  page.notes.push_back(std::to_string(std::lround(100.0 * sheet->outsideShare)) +
                       " % of the picture is outside the sheet and was cut off; paper.sheet=off keeps it.");
  page.view = sheetView(scan, *sheet, context);
  if (page.view && !page.view->isAngled()) page.view.reset();
  if (page.view)
    page.notes.push_back("The sheet was photographed at an angle: " + page.view->text() +
                         "; paper.rectify=auto rectifies the page.");
  page.sheet = std::move(sheet);
}

void leaveOutShading(const Scan& scan, PreparedPage& page, const RunContext& context) {
  const std::optional<ToneCopy> copy = toneCopyOf(greyOf(scan, page), context);
  if (!copy) return;
  const std::optional<ToneAreas> areas = findShading(*copy, context);
  if (!areas || context.isCancelled()) return;
  if (!page.grey) page.grey = scan.grey;
  page.grey = withoutTones(std::move(*page.grey), *areas, context);
  // The page was changed even where nothing is clearly shaded: the share must not read 0.
  page.shadedShare = std::max(areas->share, 1.0 / (1.0 * scan.grey.width * scan.grey.height));
  page.notes.push_back("Shading on " + percentText(page.shadedShare) +
                       " % of the page was left out, so that the lines on it are found; paper.shading=keep traces it.");
}

void addRectifyNotes(const Scan& scan, PreparedPage& page) {
  constexpr double kDoubtfulAspect = 0.01, kNotableBendPx = 3.0;  // share and [px] above which a note says so
  if (!scan.rectifyNote.empty()) page.notes.push_back(scan.rectifyNote);
  if (!scan.rectification) return;
  const Rectification& made = *scan.rectification;
  std::string note = "The page was rectified from the corners of its sheet";
  if (made.outsideShare > 0.0)
    note += ", and " + std::to_string(std::lround(100.0 * made.outsideShare)) +
            " % of the picture, outside it, was cut off";
  page.notes.push_back(note + "; paper.rectify=off keeps the picture as it is.");
  if (made.aspectError > kDoubtfulAspect)
    page.notes.push_back("The aspect ratio of the rectified page, " + roundedText(made.aspect, 3) +
                         ", is uncertain by " + roundedText(100.0 * made.aspectError, 1) +
                         " %: name the paper (paper.format) if you know it.");
  if (made.bendPx > kNotableBendPx)
    page.notes.push_back("The edges of the sheet bulge by up to " + roundedText(made.bendPx, 0) +
                         " px: the lens distorts, or the paper is not flat. Rectifying does not remove that.");
}

void takeInks(const Scan& scan, const InkChoice& choice, PreparedPage& page, const RunContext& context) {
  page.inks = findInks(scan.grey, scan.colour, context);
  if (context.isCancelled() || choice.isAll()) return;
  std::optional<DroppedInk> dropped = dropInks(greyOf(scan, page), scan.grey, scan.colour, choice, context);
  if (context.isCancelled() || !dropped) return;
  page.grey = std::move(dropped->grey);
  page.droppedShare = static_cast<double>(dropped->pixels) / static_cast<double>(scan.grey.pixels.size());
}

/// The scan with black for white. Its colours serve to find coloured ink only: their hues are not those of the inks.
Scan invertedScan(const Scan& scan) {
  Scan inverted = scan;
  for (std::uint16_t& value : inverted.grey.pixels) value = static_cast<std::uint16_t>(~value);
  const auto other = [](std::uint8_t value) { return static_cast<std::uint8_t>(~value); };
  for (Rgb8& pixel : inverted.colour.pixels) pixel = {other(pixel.red), other(pixel.green), other(pixel.blue)};
  return inverted;
}

/// Whatever is to be left out is taken out of the page.
void leaveOut(const Scan& scan, const PreparationParams& params, PreparedPage& page, const RunContext& context) {
  if (params.colour == ColourUse::Darkest && !scan.colour.isEmpty()) takeColouredInk(scan, page, context);
  if (context.isCancelled()) return;
  if (!scan.colour.isEmpty() && !page.isInverted) takeInks(scan, params.inks, page, context);
  if (context.isCancelled()) return;
  addRectifyNotes(scan, page);
  if (params.sheet == SheetUse::CutOff) cutOffTable(scan, page, context);
  if (context.isCancelled()) return;
  if (params.rulings == RulingUse::LeaveOut) {
    leaveOutRulings(scan, page, context);
    if (context.isCancelled()) return;
    leaveOutDots(scan, page, context);
  }
  if (context.isCancelled()) return;
  if (params.shading == ShadingUse::LeaveOut) leaveOutShading(scan, page, context);
}

void prepareInverted(const Scan& scan, const PreparationParams& params, PreparedPage& page, const RunContext& context) {
  page.isInverted = true;
  page.notes.emplace_back(
      "The lines are brighter than the paper, so the page was inverted; paper.lines=darker keeps it as it is.");
  if (!params.inks.isAll())
    page.notes.emplace_back("On an inverted page inks are not told apart: inks.keep and inks.drop have no effect.");
  Scan inverted = invertedScan(scan);
  leaveOut(inverted, params, page, context);
  if (!page.grey) page.grey = std::move(inverted.grey);
}

}  // namespace

std::optional<Error> validate(const PreparationParams& params) {
  if (auto wrong = validate(params.rectify)) return wrong;
  return validate(params.inks);
}

Result<PreparedPage> preparePage(const Scan& scan, const PreparationParams& params, const RunContext& context) {
  // OpenCV works on the calling thread: threads of its own would not keep to RunContext::threads, and it throws where
  // the system gives none.
  [[maybe_unused]] static const bool isAlone = (cv::setNumThreads(0), true);
  try {
    PreparedPage page;
    const bool isInverted =
        params.lines == LineTone::Brighter || (params.lines == LineTone::Auto && areLinesBrighter(scan.grey, context));
    if (context.isCancelled()) return cancelled();
    if (isInverted)
      prepareInverted(scan, params, page, context);
    else
      leaveOut(scan, params, page, context);
    if (context.isCancelled()) return cancelled();
    return page;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, kNoMemory);
  } catch (const cv::Exception& exception) {
    if (exception.code == cv::Error::StsNoMem) return fail(ErrorCode::OutOfMemory, kNoMemory, exception.what());
    return fail(ErrorCode::Numerical,
                "The page could not be prepared; set paper.sheet to off and paper.colour to grey.", exception.what());
  }
}

}  // namespace batten
