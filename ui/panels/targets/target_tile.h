// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAbstractButton>
#include <QPainterPath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/fairing/fairing.h"

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
  /// Whether lengths count from right to left, as the plot below shows them.
  void setRunsLeft(bool runsLeft);
  /// Where the sketched curve's line stands in the tile at each of its samples, for tests.
  QPainterPath sketchedPath() const;
  /// How much of the figures is shown, from all of them to the length alone.
  enum class Figures { All, WithoutWords, WithoutSimilarity, LengthAndExtrema, Length };
  /// What there is room for in this tile.
  Figures roomFor() const;
  /// What is shown: for tiles side by side the same, so that they can be compared.
  void setFigures(Figures figures);
  /// Whether the title leaves room for the word of advice, and whether that is written in full or as a sign.
  bool hasRoomForAdvice() const;
  void setAdviceInFull(bool inFull);
  /// Whether the title has room for the similarity where the line of figures has none, and whether it stands there.
  bool hasRoomForSimilarityAbove() const;
  void setSimilarityAbove(bool isAbove);
  /// Whether the similarity can be read somewhere on the tile.
  bool showsSimilarity() const {
    return isSimilarityAbove_ || figures_ == Figures::All || figures_ == Figures::WithoutWords;
  }
  Figures figures() const { return figures_; }
  /// Flat ones show no profile: the plot below shows all six.
  static constexpr int kHeight = 97, kLowHeight = 77, kFlatHeight = 41;
  QSize sizeHint() const override { return {156, kHeight}; }
  QSize minimumSizeHint() const override { return {96, kFlatHeight}; }

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
  /// Why there are no figures; empty where there are.
  QString problem() const;
  /// Of the recommended degree, where it is met within the tolerance, without a curvature extremum more.
  enum class Advice { None, SimplestFit, Recommended };
  Advice advice() const;
  QString nameText() const;
  QString spokenText() const;
  QString figuresTip() const;
  QString tipText(bool oneCurve) const;
  bool isFlat() const { return height() < kLowHeight; }
  void paintTitle(class QPainter&, const QRectF&) const;
  void paintTitleWithSimilarity(class QPainter&, const QRectF& box, bool isAdvised) const;
  void paintProfiles(class QPainter&, const QRectF&) const;
  QRectF profileBox() const;
  /// The range of values that all tiles show; none where there is too little to draw.
  std::optional<std::pair<double, double>> range(const std::vector<double>& sketched) const;
  QPainterPath pathOf(const std::vector<double>& values, const QRectF& box, double low, double high) const;
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
  bool chosen_ = false, runsLeft_ = false, adviceInFull_ = true, isSimilarityAbove_ = false;
  Figures figures_ = Figures::All;
};

}  // namespace batten
