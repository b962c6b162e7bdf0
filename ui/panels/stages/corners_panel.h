// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <functional>
#include <memory>
#include <vector>

#include "core/contour/corner/corner_suggestions.h"
#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"

class QLabel;
class QListWidget;
class QPushButton;
class QVBoxLayout;

namespace batten {

class ColumnDelegate;
class CornerRounding;
class HintList;
class LinesNote;

/// The marked corners as a list, and places that look like corners.
class CornersPanel : public QWidget {
  Q_OBJECT
 public:
  CornersPanel(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);

 protected:
  void changeEvent(QEvent*) override;
  void showEvent(QShowEvent*) override;

 private:
  QVBoxLayout* column() const;
  void buildFound();
  void buildMarks();
  void buildSuggestions();
  void followSession();
  void refresh();
  void refreshMarks();
  void suggest();
  void showSuggestions();
  void showSelected();
  /// Changes the selected mark.
  void editSelected(const QString& what, const std::function<void(CornerMark&)>& change);
  void removeSelected();
  void removeAll();
  void mark(const std::vector<Vec2>& positions);
  bool isMarked(const Vec2& positionPx) const;
  /// Whether a corner counts there without a mark.
  bool isFound(const Vec2& positionPx) const;
  void showFound();

  EditorSession& session_;
  ViewSettings& view_;
  QListWidget* marks_;
  ColumnDelegate* markColumns_ = nullptr;
  LinesNote* found_;  ///< How many corners count without a mark.
  QPushButton* restore_;
  QLabel* close_;  ///< Names corners that lie too close together.
  QPushButton* remove_;
  QPushButton* removeAll_;
  CornerRounding* rounding_;
  HintList* suggested_;
  ColumnDelegate* suggestedColumns_ = nullptr;
  QLabel* suggestedNote_;
  QPushButton* take_;
  QPushButton* takeAll_;
  std::vector<CornerSuggestion> suggestions_;
  bool filling_ = false;
};

}  // namespace batten
