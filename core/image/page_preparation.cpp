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

}  // namespace

Result<PreparedPage> preparePage(const Scan& scan, const PreparationParams& params, const RunContext& context) {
  try {
    PreparedPage page;
    if (params.colour == ColourUse::Darkest && !scan.colour.isEmpty()) takeColouredInk(scan, page, context);
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
