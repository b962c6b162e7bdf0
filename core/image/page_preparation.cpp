// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/page_preparation.h"

#include <new>
#include <opencv2/core.hpp>
#include <utility>

#include "core/image/coloured_ink.h"

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
  for (const RulingFamily& family : families) {
    counts += (counts.empty() ? "" : " and ") + std::to_string(family.lines.size()) +
              (family.runsDown ? " printed lines down" : " printed lines across");
  }
  return counts + " the page were left out; paper.rulings=keep brings them back.";
}

void leaveOutRulings(const Scan& scan, PreparedPage& page, const RunContext& context) {
  const GreyImage& grey = page.isUntouched() ? scan.grey : page.grey;
  std::vector<RulingFamily> found = findRulings(grey, context);
  if (context.isCancelled() || found.empty()) return;
  GreyImage without = withoutRulings(grey, found, context);
  if (context.isCancelled()) return;
  page.grey = std::move(without);
  page.notes.push_back(rulingNote(found));
  page.rulings = std::move(found);
}

}  // namespace

Result<PreparedPage> preparePage(const Scan& scan, const PreparationParams& params, const RunContext& context) {
  try {
    PreparedPage page;
    if (params.colour == ColourUse::Darkest && !scan.colour.isEmpty()) takeColouredInk(scan, page, context);
    if (context.isCancelled()) return cancelled();
    if (params.rulings == RulingUse::LeaveOut) leaveOutRulings(scan, page, context);
    if (context.isCancelled()) return cancelled();
    return page;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory for the colours of the scan; save it as grey or crop it.");
  } catch (const cv::Exception& exception) {
    return fail(ErrorCode::Numerical, "The colours of the scan could not be measured; set paper.colour to grey.",
                exception.what());
  }
}

}  // namespace batten
