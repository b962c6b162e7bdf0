// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/pdf/pdf_page.h"

#include <poppler-qt6.h>

#include <QImage>
#include <memory>
#include <mutex>

#include "core/base/parallel.h"

namespace batten {
namespace {

/// Poppler keeps its settings in one place for the whole program.
std::mutex& popplerMutex() {
  static std::mutex mutex;
  return mutex;
}

void beSilent() {
  Poppler::setDebugErrorFunction([](const QString&, const QVariant&) {}, {});
}

tl::expected<std::unique_ptr<Poppler::Document>, PdfProblem> openPdf(std::span<const std::byte> file) {
  beSilent();
  const auto size = static_cast<qsizetype>(file.size());
  const QByteArray bytes = QByteArray::fromRawData(reinterpret_cast<const char*>(file.data()), size);
  auto document = Poppler::Document::loadFromData(bytes);
  if (!document || document->numPages() < 1) return tl::unexpected(PdfProblem::Damaged);
  if (document->isLocked()) return tl::unexpected(PdfProblem::Locked);
  return document;
}

/// What goes through Poppler as an address and comes back when it asks whether to go on.
struct Drawing {
  const RunContext& context;
};
bool isCancelled(const QVariant& drawing) {
  return static_cast<Drawing*>(drawing.value<void*>())->context.isCancelled();
}

PdfPicture pictureOf(const QImage& drawn, const RunContext& context) {
  PdfPicture picture{GreyImage(drawn.width(), drawn.height()), ColourImage(drawn.width(), drawn.height())};
  parallelFor(context, drawn.height(), kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const auto* in = reinterpret_cast<const QRgb*>(drawn.constScanLine(y));
      std::uint16_t* out = picture.grey.row(y);
      Rgb8* colours = picture.colour.row(y);
      constexpr std::uint32_t kUnit = 257;  // of 8 bit on the 16-bit scale
      for (int x = 0; x < drawn.width(); ++x) {
        const auto red = static_cast<std::uint8_t>(qRed(in[x])), green = static_cast<std::uint8_t>(qGreen(in[x])),
                   blue = static_cast<std::uint8_t>(qBlue(in[x]));
        colours[x] = {red, green, blue};
        const std::uint32_t luma = 299u * red + 587u * green + 114u * blue;
        out[x] = static_cast<std::uint16_t>((luma * kUnit + 500) / 1000);
      }
    }
  });
  return picture;
}

}  // namespace

bool hasPdf() { return true; }

tl::expected<PdfPage, PdfRefusal> lookAtPdfPage(std::span<const std::byte> file, int number) {
  const std::lock_guard lock(popplerMutex());
  const auto document = openPdf(file);
  if (!document) return tl::unexpected(PdfRefusal{document.error()});
  const int pages = (*document)->numPages();
  if (number < 1 || number > pages) return tl::unexpected(PdfRefusal{PdfProblem::NoSuchPage, pages});
  const auto page = (*document)->page(number - 1);
  if (!page) return tl::unexpected(PdfRefusal{PdfProblem::Damaged, pages});
  const QSizeF size = page->pageSizeF();
  if (!(size.width() > 0.0) || !(size.height() > 0.0)) return tl::unexpected(PdfRefusal{PdfProblem::Damaged, pages});
  return PdfPage{pages, size.width(), size.height()};
}

tl::expected<PdfPicture, PdfProblem> drawPdfPage(std::span<const std::byte> file, int number, const PdfSize& size,
                                                 const RunContext& context) {
  const std::lock_guard lock(popplerMutex());
  const auto document = openPdf(file);
  if (!document) return tl::unexpected(document.error());
  (*document)->setRenderHint(Poppler::Document::Antialiasing);
  (*document)->setRenderHint(Poppler::Document::TextAntialiasing);
  (*document)->setPaperColor(Qt::white);
  const auto page = (*document)->page(number - 1);
  if (!page) return tl::unexpected(PdfProblem::Damaged);
  Drawing drawing{context};
  QImage picture =
      page->renderToImage(size.dpi, size.dpi, 0, 0, size.widthPx, size.heightPx, Poppler::Page::Rotate0, nullptr,
                          nullptr, isCancelled, QVariant::fromValue(static_cast<void*>(&drawing)));
  if (context.isCancelled()) return tl::unexpected(PdfProblem::Cancelled);
  if (picture.width() != size.widthPx || picture.height() != size.heightPx) return tl::unexpected(PdfProblem::Damaged);
  if (picture.format() != QImage::Format_RGB32 && picture.format() != QImage::Format_ARGB32)
    picture.convertTo(QImage::Format_RGB32);
  return pictureOf(picture, context);
}

}  // namespace batten
