// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/pdf/pdf_absent.h"

#include "core/image/pdf/pdf_page.h"

namespace batten {

bool hasPdf() { return false; }

tl::expected<PdfPage, PdfRefusal> lookAtPdfPage(std::span<const std::byte>, int) {
  return tl::unexpected(PdfRefusal{PdfProblem::NotInstalled});
}

tl::expected<PdfPicture, PdfProblem> drawPdfPage(std::span<const std::byte>, int, const PdfSize&, const RunContext&) {
  return tl::unexpected(PdfProblem::NotInstalled);
}

}  // namespace batten
