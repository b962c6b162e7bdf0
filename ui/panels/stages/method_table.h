// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "ui/session/editor_session.h"

class QCheckBox;

namespace batten {

class BackgroundWorker;
class MethodRow;

inline constexpr std::array kMethods = {ConstructMethod::Fair, ConstructMethod::Nurbs, ConstructMethod::Bezier,
                                        ConstructMethod::Typical, ConstructMethod::ControlPolygon};
QString label(ConstructMethod);     ///< "True and fair fit", as the parameter table calls it.
QString word(ConstructMethod);      ///< "fair", "nurbs", … as files write it.
QString helpPage(ConstructMethod);  ///< "fair-fit", "quintic-nurbs", …: a file of resources/help.

/// The ways to make a curve of a line, each with what it gives for the selected curve, computed in the background while
/// the table is seen. A click chooses the way: for all curves, or with "only for this curve" for the selected one.
class MethodTable : public QWidget {
  Q_OBJECT
 public:
  explicit MethodTable(EditorSession& session, QWidget* parent = nullptr);
  ~MethodTable() override;
  /// The figures shown of a method, or none while they are computed or when it gave no curve.
  std::optional<CurveFigures> figures(ConstructMethod) const;
  ConstructMethod current() const;

 signals:
  void helpAsked(const QString& page);

 protected:
  void showEvent(QShowEvent*) override;

 private:
  void refresh();
  void compute();
  void choose(ConstructMethod);
  void show(int method, const std::optional<CurveFigures>& figures, const QString& instead);
  void stop();

  EditorSession& session_;
  std::vector<MethodRow*> rows_;
  QCheckBox* own_;
  std::array<std::optional<CurveFigures>, kMethods.size()> figures_;
  struct Source {
    std::shared_ptr<const PieceSet> pieces;
    std::shared_ptr<const SegmentSet> segments;
    ConstructParams params;
    std::vector<SegmentPoint> segmentPoints;
    std::vector<ExtremumChoice> extremumChoices;
    int contour = -1, piece = -1;
    double mmPerPx = 0.0;
    bool operator==(const Source&) const = default;
  };
  std::optional<Source> source_;
  std::unique_ptr<BackgroundWorker> worker_;
};

}  // namespace batten
