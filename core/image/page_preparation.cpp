// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/page_preparation.h"

#include <cmath>
#include <new>
#include <opencv2/core.hpp>
#include <utility>

#include "core/image/coloured_ink.h"
#include "core/image/find_rulings.h"
#include "core/image/remove_rulings.h"

namespace batten {
namespace {

void takeColouredInk(const Scan& scan, PreparedPage& page, const RunContext& context) {
  ColouredInk ink = darkenColouredInk(scan.grey, scan.colour, context);
  if (ink.pixels == 0) return;
  page.colouredShare = static_cast<double>(ink.pixels) / static_cast<double>(scan.grey.pixels.size());
  page.grey = std::move(ink.grey);
}

std::string rulingNote(const std::vector<RulingFamily>& families) {
  std::string counts;
  for (const bool runsDown : {false, true}) {
    std::size_t lines = 0;
    for (const RulingFamily& family : families) lines += family.runsDown == runsDown ? family.lines.size() : 0;
    if (lines == 0) continue;
    counts += (counts.empty() ? "" : " and ") + std::to_string(lines) +
              (runsDown ? " printed lines down" : " printed lines across");
  }
  return counts + " the page were left out; paper.rulings=keep brings them back.";
}

constexpr int kRulingRounds = 3;  // the ruling of the back may shine through beside that of the front

const GreyImage& greyOf(const Scan& scan, const PreparedPage& page) {
  return page.isUntouched() ? scan.grey : page.grey;
}

void leaveOutRulings(const Scan& scan, PreparedPage& page, const RunContext& context) {
  for (int round = 0; round < kRulingRounds; ++round) {
    const std::vector<RulingFamily> found = findRulings(greyOf(scan, page), context);
    if (context.isCancelled() || found.empty()) break;
    GreyImage without = withoutRulings(greyOf(scan, page), found, context);
    if (context.isCancelled()) break;
    page.grey = std::move(without);
    page.rulings.insert(page.rulings.end(), found.begin(), found.end());
  }
  if (!page.rulings.empty()) page.notes.push_back(rulingNote(page.rulings));
}

void cutOffTable(const Scan& scan, PreparedPage& page, const RunContext& context) {
  auto sheet = findPaperSheet(scan.grey, scan.colour, context);
  if (context.isCancelled() || !sheet) return;
  page.grey = onlyTheSheet(greyOf(scan, page), *sheet, context);
  page.notes.push_back(std::to_string(std::lround(100.0 * sheet->outsideShare)) +
                       " % of the picture lies beside the sheet and was cut off; paper.sheet=off keeps it.");
  page.sheet = std::move(sheet);
}

void takeInks(const Scan& scan, const InkChoice& choice, PreparedPage& page, const RunContext& context) {
  page.inks = findInks(scan.grey, scan.colour, context);
  if (context.isCancelled() || choice.isAll()) return;
  DroppedInk dropped = dropInks(greyOf(scan, page), scan.grey, scan.colour, choice, context);
  if (context.isCancelled() || dropped.pixels == 0) return;
  page.grey = std::move(dropped.grey);
  page.droppedShare = static_cast<double>(dropped.pixels) / static_cast<double>(scan.grey.pixels.size());
}

}  // namespace

std::optional<Error> validate(const PreparationParams& params) { return validate(params.inks); }

Result<PreparedPage> preparePage(const Scan& scan, const PreparationParams& params, const RunContext& context) {
  try {
    PreparedPage page;
    if (params.colour == ColourUse::Darkest && !scan.colour.isEmpty()) takeColouredInk(scan, page, context);
    if (context.isCancelled()) return cancelled();
    if (!scan.colour.isEmpty()) takeInks(scan, params.inks, page, context);
    if (context.isCancelled()) return cancelled();
    if (params.sheet == SheetUse::CutOff) cutOffTable(scan, page, context);
    if (context.isCancelled()) return cancelled();
    if (params.rulings == RulingUse::LeaveOut) leaveOutRulings(scan, page, context);
    if (context.isCancelled()) return cancelled();
    return page;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to prepare the page; scan at a lower resolution or crop.");
  } catch (const cv::Exception& exception) {
    return fail(ErrorCode::Numerical,
                "The page could not be prepared; set paper.sheet to off and paper.colour to grey.", exception.what());
  }
}

}  // namespace batten
