// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/image/colour/inks.h"
#include "core/image/log_transform.h"
#include "ui/session/editor_session.h"

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace batten {

class FigureTable;
class NumberField;
class ParameterEditor;
class ViewSettings;

/// The grey ramp before and after the log transform, over one another.
class ToneSwatch : public QWidget {
  Q_OBJECT
 public:
  explicit ToneSwatch(QWidget* parent = nullptr);
  void show(const LogParams& params);
  QSize sizeHint() const override { return {240, 52}; }

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  LogParams params_;
};

/// The file as it was read, its scale, and how its tones are shown.
class ScanPanel : public QWidget {
  Q_OBJECT
 public:
  ScanPanel(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);
  /// Puts the keyboard into the resolution field ("no scale: set it").
  void focusResolution();
  /// Shows what is open again, after a choice that was not followed.
  void refresh();

 signals:
  /// Another page of the file is to be opened, or its PDF to be drawn more or less finely.
  void pageChosen(const batten::PageChoice& page);

 private:
  QVBoxLayout* column() const;
  void buildPages();
  void buildScale(ViewSettings& view);
  void buildPaper(ViewSettings& view);
  void setDpi(std::optional<double> dpi);
  void refreshPage(const Scan* scan);
  void refreshPaper();
  void refreshInks();
  EditorSession& session_;
  FigureTable* facts_;
  QLabel* pageName_;
  NumberField* page_;
  QLabel* pdfName_;
  NumberField* pdfDpi_;
  NumberField* dpi_;
  QLabel* scaleNote_;
  QPushButton* fromFile_;
  ToneSwatch* swatch_;
  QLabel* paperNote_;
  QWidget* inkBox_;                  ///< A button for every ink of the page.
  std::vector<FoundInk> shownInks_;  ///< What its buttons were made for.
  QPushButton* pickInk_;
};

}  // namespace batten
