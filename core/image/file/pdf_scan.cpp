// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/file/pdf_scan.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/image/file/scan_file.h"
#include "core/image/file/scan_grey.h"
#include "core/image/pdf/pdf_absent.h"
#include "core/image/pdf/pdf_page.h"

namespace batten {
namespace {

constexpr double kPointsPerInch = 72.0;  // the unit of PDF
/// [bytes] a pixel: the picture that is drawn, a copy of it, its grey and its colours.
constexpr std::uint64_t kBytesPerPixel = 13;
/// [px] Of a side; no page of paper is larger.
constexpr double kMostSide = 1e6;

Error problemOfPdf(const std::filesystem::path& path, PdfProblem problem, int page, int pages) {
  switch (problem) {
    case PdfProblem::NotInstalled:
      return unreadable(path, std::string("is a PDF, but this build of Batten has no Poppler (") + kPdfPackage +
                                  "). Export the page as PNG.")
          .value();
    case PdfProblem::Locked:
      return unreadable(path, "is password-protected. Save it without a password, or export the page as PNG.").value();
    case PdfProblem::NoSuchPage:
      return noSuchPage(path, page, pages);
    case PdfProblem::Cancelled:
      return cancelled().value();
    case PdfProblem::Damaged:
      break;
  }
  return unreadable(path, "is a damaged PDF. Export the page as PNG.").value();
}

struct FoundPage {
  std::vector<std::byte> bytes;
  ScanInfo info;
  int pages = 1;
};

Result<FoundPage> pageOf(const std::filesystem::path& path, const RegularFile& file, const PageChoice& choice) {
  if (file.size() > kLargestScanBytes) return unreadable(path, "is too large a PDF. Export the page as PNG.");
  auto bytes = readBytes(path, file, file.size());
  if (!bytes) return fail(bytes.error());
  const auto page = lookAtPdfPage(*bytes, choice.number);
  if (!page) return fail(problemOfPdf(path, page.error().problem, choice.number, page.error().pages));
  const double width = page->widthPoints * choice.pdfDpi / kPointsPerInch;
  const double height = page->heightPoints * choice.pdfDpi / kPointsPerInch;
  if (!(width < kMostSide && height < kMostSide))
    return unreadable(path, "has a page far larger than paper. Choose a lower resolution by --dpi.");
  FoundPage found{std::move(*bytes), {}, page->pages};
  found.info.format = "PDF";
  found.info.width = std::max(1, static_cast<int>(std::lround(width)));
  found.info.height = std::max(1, static_cast<int>(std::lround(height)));
  found.info.channels = 3;
  found.info.dpi = choice.pdfDpi;
  return found;
}

}  // namespace

bool isPdf(const RegularFile& file) {
  std::vector<std::byte> begin(std::min<std::uint64_t>(file.size(), 5));
  if (!file.read(begin)) return false;
  const std::string_view text(reinterpret_cast<const char*>(begin.data()), begin.size());
  return text.starts_with("%PDF-");
}

Result<ScanInfo> probePdf(const std::filesystem::path& path, const RegularFile& file, const PageChoice& choice) {
  auto found = pageOf(path, file, choice);
  if (!found) return fail(found.error());
  return found->info;
}

int countPdfPages(const std::filesystem::path& path, const RegularFile& file) {
  const auto found = pageOf(path, file, PageChoice{});
  return found ? found->pages : 1;
}

Result<Scan> readPdfScan(const std::filesystem::path& path, const RegularFile& file, const PdfRequest& request,
                         const RunContext& context) {
  auto found = pageOf(path, file, request.page);
  if (!found) return fail(found.error());
  const int width = found->info.width, height = found->info.height;
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  const ReadingCost cost{width, height, file.size() + kBytesPerPixel * pixels, file.size()};
  if (const auto error = checkCost(path, cost, request.memoryBytes, "Choose a lower resolution by --dpi."))
    return fail(*error);
  Scan scan;
  scan.info = found->info;
  scan.dpi = found->info.dpi;
  scan.path = path.string();
  scan.page = request.page;
  scan.pages = found->pages;
  scan.fileHash = sha256(found->bytes);
  if (context.isCancelled()) return cancelled();
  auto drawn = drawPdfPage(found->bytes, request.page.number, {width, height, request.page.pdfDpi}, context);
  if (!drawn) return fail(problemOfPdf(path, drawn.error(), request.page.number, found->pages));
  scan.grey = std::move(drawn->grey);
  scan.colour = std::move(drawn->colour);
  dropGreyColours(scan.colour, context);
  if (context.isCancelled()) return cancelled();
  return scan;
}

}  // namespace batten
