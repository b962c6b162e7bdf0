// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/export/svg_carrier.h"

#include <QApplication>
#include <QClipboard>
#include <QDrag>
#include <QFile>
#include <QMimeData>
#include <QUrl>
#include <QWidget>
#include <new>

#include "core/base/conventions.h"
#include "ui/session/background/background_worker.h"

namespace batten {
namespace {

/// What is carried has pixels as user units: Inkscape takes what is pasted or dropped for pixels, whatever the view box
/// says. Others go by the size of the page, which is in mm.
constexpr double kPixelsPerMm = 96.0 / kMillimetresPerInch;

/// The picture under every name by which drawing programs look for one; the text is for editors.
std::unique_ptr<QMimeData> pictureOf(const QByteArray& svg) {
  auto data = std::make_unique<QMimeData>();
  data->setData(QStringLiteral("image/svg+xml"), svg);
  data->setData(QStringLiteral("image/x-inkscape-svg"), svg);
  return data;
}

Result<ExportedFile> svgOf(const ExportRequest& request, std::optional<int> number, const RunContext& context) {
  try {
    ExportSettings settings;
    settings.scale = request.settings.scale;
    settings.joined = request.settings.joined;
    settings.svgUnitsPerMm = kPixelsPerMm;
    ExportDocument document = documentOf(request, settings, context);
    if (context.isCancelled()) return cancelled();
    if (number) {
      auto one = chosenCurves(document, std::to_string(*number));
      if (!one) return fail(one.error());
      document = std::move(*one);
    }
    return exportedFile(document, settings, context);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory for the SVG. Exclude some curves.");
  }
}

}  // namespace

SvgCarrier::SvgCarrier(QWidget* window)
    : QObject(window), window_(window), worker_(std::make_unique<BackgroundWorker>()) {}

SvgCarrier::~SvgCarrier() = default;

void SvgCarrier::copy(const ExportRequest& request) { make(request, std::nullopt, Transfer::Copy, {}); }

void SvgCarrier::drag(const ExportRequest& request, std::optional<int> number, const QString& name) {
  make(request, number, Transfer::Drag, name);
}

void SvgCarrier::make(const ExportRequest& request, std::optional<int> number, Transfer transfer, const QString& name) {
  worker_->start([this, request, number, transfer, name](const CancelToken& cancel) {
    RunContext context;
    context.cancel = cancel;
    auto made = svgOf(request, number, context);
    if (cancel.isCancelled()) return;
    inbox_.post([this, transfer, name, made = std::move(made)] {
      if (!made) return emit failed(made.error());
      carry(*made, transfer, name);
    });
  });
}

void SvgCarrier::carry(const ExportedFile& made, Transfer transfer, const QString& name) {
  const QByteArray svg = QByteArray::fromStdString(made.bytes);
  auto data = pictureOf(svg);
  if (transfer == Transfer::Copy) {
    data->setText(QString::fromUtf8(svg));
    QApplication::clipboard()->setMimeData(data.release());
    emit copied(tr("Copied as SVG: %1.").arg(QString::fromStdString(sentenceByNumbers(made.report))));
    return;
  }
  if (!(QApplication::mouseButtons() & Qt::LeftButton)) return;
  if (!folder_) folder_.emplace();
  QFile file(folder_->filePath(name + QStringLiteral(".svg")));
  if (!folder_->isValid() || !file.open(QIODevice::WriteOnly) || file.write(svg) != svg.size()) {
    emit failed({ErrorCode::CannotWrite, "The temporary file for dragging cannot be written. Is the disk full?", {}});
    return;
  }
  file.close();
  data->setUrls({QUrl::fromLocalFile(file.fileName())});
  auto* drag = new QDrag(window_);
  drag->setMimeData(data.release());
  drag->exec(Qt::CopyAction);
}

}  // namespace batten
