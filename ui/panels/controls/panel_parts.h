// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFont>
#include <QString>
#include <QStringList>
#include <QWidget>
#include <utility>
#include <vector>

class QLabel;
class QLayout;
class QPushButton;
class QToolButton;
class QVBoxLayout;

namespace batten {

/// Small pieces that all panels are put together from.

QLabel* heading(const QString& text, QWidget* parent);  ///< "Fairing": bold, 13 px.
inline constexpr int kCaptionMargin = 6;                // [px] above the text of a caption()
QLabel* caption(const QString& text, QWidget* parent);  ///< "BEFORE AND AFTER": small, grey, spaced.
/// A caption with what is done to all below it at its right, where it takes no line of its own.
QLayout* captionRow(const QString& text, const std::vector<QPushButton*>& links, QWidget* parent);
QFont captionFont();                                 ///< Of a caption that is painted.
QLabel* note(const QString& text, QWidget* parent);  ///< Grey 12 px, wraps.
QPushButton* plainButton(const QString& text, const QString& name, QWidget* parent);
QPushButton* linkButton(const QString& text, const QString& name, QWidget* parent);  ///< Accent text without frame.

/// Tab walks what takes the keyboard in the order of the layouts, from top to bottom, whichever was made first.
void tabAsLaidOut(const std::vector<QWidget*>& parts);

/// Numbers in rows with hairlines: a name at the left, one or two columns at the right. Amber marks what is over
/// tolerance.
class FigureTable : public QWidget {
  Q_OBJECT
 public:
  struct Cell {
    QString text;
    bool warns = false;
  };
  struct Row {
    QString name;
    std::vector<Cell> cells;
    QString help;
  };
  explicit FigureTable(QWidget* parent = nullptr);
  void setHeader(const QString& first, const QStringList& columns);
  /// The caption of the table, in the line of its header, where it takes no room of its own.
  void setTitle(const QString& title);
  void setRows(std::vector<Row> rows);
  const std::vector<Row>& rows() const { return rows_; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return {120, sizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent*) override;
  bool event(QEvent*) override;

 private:
  QString first_, title_;
  QStringList columns_;
  std::vector<Row> rows_;
};

/// Lengths and places as the window writes them.
QString millimetres(double mm);       ///< "286.4 mm", "0.14 mm"
QString shortMillimetres(double mm);  ///< At most four digits: "0.014 mm", "0.14 mm", "51.9 mm", "340 mm"
QString areaText(double mm2);         ///< "0.14 mm²": two digits, and never a power of ten.
QString zoomText(double zoom);        ///< "78 %", below ten percent "7.8 %"
QString grouped(qint64 count);        ///< "12 345" with thin spaces
QString similarityText(double s);     ///< ".9987"
QString counted(qint64 count, const QString& one, const QString& many);  ///< "1 curve", "4 curves": `many` holds %1.
QString degreeName(int degree);                                          ///< "linear" … "sextic"

}  // namespace batten
