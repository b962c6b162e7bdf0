// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPointer>
#include <QWidget>
#include <memory>

#include "core/construct/polygon/control_polygon.h"
#include "ui/session/background/inbox.h"
#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"

class QCheckBox;
class QLabel;

namespace batten {

class BackgroundWorker;
class KnotGallery;
class KnotStrip;
class ParameterEditor;

/// A knot vector as a line of text with multiplicities: "0×4 1 2 3×3 4 …".
QString knotText(const std::vector<double>& knots);

/// Everything about the control polygon of the selected line: degree, point removal with its counts, the knot vector,
/// and the same polygon with uniform knots beside it.
class KnotPanel : public QWidget {
  Q_OBJECT
 public:
  KnotPanel(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);
  ~KnotPanel() override;

 protected:
  void showEvent(QShowEvent*) override;

 private:
  struct Result {
    LinePolygon line;
    std::optional<PolygonCurve> curve;
  };
  void refresh();
  void show(const std::shared_ptr<const Result>&);
  void openGallery();

  EditorSession& session_;
  ParameterEditor* editor_;
  QLabel* counts_;
  QLabel* warning_;
  KnotStrip* strip_;
  QLabel* text_;
  QCheckBox* uniform_;
  QPointer<KnotGallery> gallery_;
  Inbox inbox_;
  std::unique_ptr<BackgroundWorker> worker_;
  int request_ = 0;
};

}  // namespace batten
