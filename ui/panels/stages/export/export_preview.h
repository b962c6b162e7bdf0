// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPointF>
#include <QPolygonF>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "ui/panels/stages/export/export_job.h"
#include "ui/session/background/inbox.h"

namespace batten {

class BackgroundWorker;

/// One curve of the file that is to be written.
struct PreviewCurve {
  QPolygonF points;                 ///< [mm] of the file, y down.
  QPointF arrowAt, arrowDirection;  ///< Middle, and the direction of the curve there.
  bool isSketched = false, isClosed = false;
  std::optional<int> number;  ///< Of its first piece, from 1.
};
struct PreviewContent {
  std::vector<PreviewCurve> curves;
  QRectF box;  ///< [mm] of the file.
  int layers = 0, doubles = 0;
};
/// What a file would hold, drawn with few points. @return the error of the export.
Result<PreviewContent> previewOf(const ExportRequest&, const RunContext&);

/// What will be written: every curve of the file with its start and its direction. Curves can be dragged out of it as
/// SVG files.
class ExportPreview : public QWidget {
  Q_OBJECT
 public:
  explicit ExportPreview(QWidget* parent = nullptr);
  ~ExportPreview() override;
  /// Shows what a request would write, soon; a newer one replaces it.
  void show(const ExportRequest&);
  void clear();
  /// In a panel too low for all it holds, the preview gives way so that this part of it, below, is in sight.
  void keepInSight(QWidget* below);
  const PreviewContent& content() const { return content_; }
  QSize sizeHint() const override { return {240, 150}; }
  QPointF toWidget(QPointF mm) const;

 signals:
  void changed();           ///< Other content is shown.
  void chosen(int number);  ///< A curve was clicked, by its number from 1.
  /// A drag begins: of one curve, by its number, or of all.
  void dragAsked(std::optional<int> number);

 protected:
  bool eventFilter(QObject* watched, QEvent*) override;
  void showEvent(QShowEvent*) override;
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseMoveEvent(QMouseEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;

 private:
  std::optional<int> curveAt(QPointF widget) const;
  void fitHeight();

  QWidget* below_ = nullptr;
  PreviewContent content_;
  std::optional<QPointF> pressedAt_;
  Inbox inbox_;
  std::unique_ptr<BackgroundWorker> worker_;
  int request_ = 0;
};

}  // namespace batten
