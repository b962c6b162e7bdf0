// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAbstractButton>
#include <QWidget>
#include <array>
#include <memory>

#include "core/fairing/fairing.h"
#include "ui/session/editor_session.h"

namespace batten {

/// One target: its profile over the sketched curve's, how similar, how far it moves the curve, how many extrema.
class TargetTile : public QAbstractButton {
  Q_OBJECT
 public:
  TargetTile(int degree, QWidget* parent);
  /// @param toleranceMm deviations above it are amber.
  /// @param waiting what an empty tile says.
  void show(std::shared_ptr<const TargetOutcomes> outcomes, double toleranceMm, bool chosen, bool oneCurve,
            const QString& waiting);
  /// How much of the figures is shown, from all of them to the length alone.
  enum class Figures { All, WithoutWords, WithoutSimilarity, LengthAndExtrema, Length };
  /// What there is room for in this tile.
  Figures roomFor() const;
  /// What is shown: for tiles side by side the same, so that they can be compared.
  void setFigures(Figures figures);
  Figures figures() const { return figures_; }
  static constexpr int kHeight = 97, kLowHeight = 77;
  QSize sizeHint() const override { return {156, kHeight}; }
  QSize minimumSizeHint() const override { return {96, kLowHeight}; }

 signals:
  void entered(int degree);
  void left();

 protected:
  void paintEvent(QPaintEvent*) override;
  void enterEvent(QEnterEvent*) override;
  void leaveEvent(QEvent*) override;
  void focusInEvent(QFocusEvent*) override;
  void focusOutEvent(QFocusEvent*) override;
  void keyPressEvent(QKeyEvent*) override;

 private:
  QString problem() const;
  /// Met within the tolerance, without a curvature extremum more.
  bool fits() const;
  void paintTitle(class QPainter&, const QRectF&) const;
  void paintProfiles(class QPainter&, const QRectF&) const;
  void paintFigures(class QPainter&, const QRectF&) const;
  /// The words of the figures. `needs` is the length with what it means where it is over tolerance.
  struct FigureTexts {
    QString similarity, length, needs, extrema;
    bool isOver = false, hasMoreExtrema = false;
  };
  FigureTexts figureTexts() const;
  QRectF innerBox() const;
  int degree_;
  std::shared_ptr<const TargetOutcomes> outcomes_;
  QString waiting_;
  double toleranceMm_ = 0.0;
  bool chosen_ = false;
  Figures figures_ = Figures::All;
};

/// The six targets of the selected curve side by side, on the same axes.
class TargetStrip : public QWidget {
  Q_OBJECT
 public:
  explicit TargetStrip(EditorSession& session, QWidget* parent = nullptr);
  /// Lower tiles, for low windows.
  void setLow(bool low);

 signals:
  void hint(const QString& text);

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;

 private:
  void refresh();
  void alignFigures();
  EditorSession& session_;
  std::array<TargetTile*, 6> tiles_{};
};

}  // namespace batten
