// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "ui/session/background/inbox.h"
#include "ui/session/editor_session.h"

namespace batten {

class BackgroundWorker;
class MethodRow;
class LinesNote;
class SegmentedControl;

// in the order of the rows
inline constexpr std::array kMethods = {ConstructMethod::Fair, ConstructMethod::Nurbs, ConstructMethod::Bezier,
                                        ConstructMethod::Typical, ConstructMethod::ControlPolygon};
QString label(ConstructMethod);     ///< "True and fair fit", as the parameter table calls it.
QString word(ConstructMethod);      ///< "fair", "nurbs", … as files write it.
QString helpPage(ConstructMethod);  ///< "fair-fit", "quintic-nurbs", …: a file of resources/help.

/// The ways to make a curve of a line, each with what it gives for the selected curve, computed in the background while
/// the table is seen. A click chooses the way for the curve whose figures these are; for all curves when that is set.
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
  bool actsOnAll() const;
  void show(int method, const std::optional<CurveFigures>& figures, const QString& instead);
  void stop();

  EditorSession& session_;
  std::vector<MethodRow*> rows_;
  SegmentedControl* scope_;
  LinesNote* whose_;  ///< Names the curve that the figures are of.
  std::array<std::optional<CurveFigures>, kMethods.size()> figures_;
  struct Source {
    std::shared_ptr<const PieceSet> pieces;
    std::shared_ptr<const SegmentSet> segments;
    ConstructParams params;
    std::vector<SegmentPoint> segmentPoints;
    std::vector<ExtremumChoice> extremumChoices;
    int contour = 0, piece = 0;  ///< Of the selected curve.
    double mmPerPx = 0.0;
    std::optional<ConstructMethod> alongside{};  ///< The common method, when the curve gets one of its own.
    bool operator==(const Source&) const = default;
  };
  static Result<TracedCurve> constructedAs(const PipelineOutput&, const Recipe&, const Source&, const RunContext&);
  std::optional<Source> source_;
  Inbox inbox_;
  std::unique_ptr<BackgroundWorker> worker_;
};

}  // namespace batten
