// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QTemporaryDir>
#include <memory>
#include <optional>

#include "ui/panels/stages/export/export_job.h"
#include "ui/session/background/inbox.h"

class QWidget;

namespace batten {

class BackgroundWorker;

/// Carries curves out of the window as SVG: onto the clipboard, or in the hand of the mouse. The SVG is made in the
/// background.
class SvgCarrier : public QObject {
  Q_OBJECT
 public:
  explicit SvgCarrier(QWidget* window);
  ~SvgCarrier() override;
  /// Puts all curves of a request on the clipboard.
  void copy(const ExportRequest&);
  /// Begins to drag a curve, by its number from 1, or all of them: once the SVG is made, if the button is still down.
  void drag(const ExportRequest&, std::optional<int> number, const QString& name);

 signals:
  void copied(const QString& sentence);
  void failed(const batten::Error& error);

 private:
  enum class Transfer { Copy, Drag };
  void make(const ExportRequest&, std::optional<int> number, Transfer, const QString& name);
  void carry(const ExportedFile&, Transfer, const QString& name);

  QWidget* window_;
  /// Of the files that are dragged: receivers read them after the drop. Made for the first one, because a window that
  /// is ended by force leaves it behind.
  std::optional<QTemporaryDir> folder_;
  Inbox inbox_;
  std::unique_ptr<BackgroundWorker> worker_;
};

}  // namespace batten
