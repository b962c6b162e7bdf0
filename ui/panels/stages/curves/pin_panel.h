// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>

#include "ui/session/background/inbox.h"
#include "ui/session/editor_session.h"

class QPushButton;

namespace batten {

class BackgroundWorker;
class FigureTable;
class LinesNote;

/// One curve in numbers, to set beside another.
struct ComparedFigures {
  double rmsMm = 0.0, maxMm = 0.0;  ///< Of the points of the line from the curve.
  int controlPoints = 0, extrema = 0;
  double energy = 0.0;  ///< variationEnergy.
};
struct Comparison {
  ComparedFigures pinned, now;
  double apartMm = 0.0;  ///< Largest distance between the two curves.
};
/// Both curves as constructed, so that ways of construction are compared and not what fairing makes of them. @pre both
/// hold a curve.
Comparison compare(const TracedCurve& pinned, const TracedCurve& now);

/// ComparedFigures::energy in few digits: "0.5", "123", "2.79 · 10⁷".
QString unevennessText(double energy);

/// Sets a result aside and compares the selected curve with it.
class PinPanel : public QWidget {
  Q_OBJECT
 public:
  explicit PinPanel(EditorSession& session, QWidget* parent = nullptr);
  ~PinPanel() override;
  /// The comparison: to be laid out where it may grow.
  QWidget* figures() const;

 protected:
  void showEvent(QShowEvent*) override;

 private:
  void refresh();
  void show(const Comparison&);

  EditorSession& session_;
  QPushButton* pin_;
  QPushButton* unpin_;
  LinesNote* what_;
  FigureTable* figures_;
  Inbox inbox_;
  std::unique_ptr<BackgroundWorker> worker_;
  int request_ = 0;
};

}  // namespace batten
