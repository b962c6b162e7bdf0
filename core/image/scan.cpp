// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/scan.h"

#include "core/base/conventions.h"

namespace batten {

std::optional<Error> validate(const PageChoice& page) {
  if (!(page.number >= 1 && page.number <= kMostPages))
    return Error{ErrorCode::BadParameter, "The page of a scan is counted from 1 to 100000.", {}};
  if (!(page.pdfDpi >= kCoarsestPdfDpi && page.pdfDpi <= kFinestPdfDpi))
    return Error{ErrorCode::BadParameter, "The pages of a PDF are drawn at 20 to 4800 dpi.", {}};
  return std::nullopt;
}

Scan blankScan(int widthPx, int heightPx, double dpi) {
  Scan scan;
  scan.grey = GreyImage::uniform(widthPx, heightPx, 0xffff);
  scan.info.format = "blank";
  scan.info.width = widthPx;
  scan.info.height = heightPx;
  scan.info.bitsPerChannel = 16;
  scan.dpi = dpi;
  scan.fileHash = HashBuilder().text("blank page").integer(widthPx).integer(heightPx).finish();
  return scan;
}

bool isBlank(const Scan& scan) { return scan.info.format == "blank"; }

PageFrame pageFrame(const Scan& scan, std::optional<double> dpi) {
  return {scan.grey.width, scan.grey.height, kMillimetresPerInch / dpi.value_or(kAssumedDpi)};
}

}  // namespace batten
