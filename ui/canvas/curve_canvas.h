// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "core/base/vec2.h"
#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"

namespace batten {

/// The drawing with everything traced from it. Paints from a tile pyramid at screen resolution; zooms at the cursor
/// (wheel, Ctrl+wheel, pinch), pans (Space or middle drag, Shift+wheel), never waits for the pipeline.
class CurveCanvas : public QWidget {
  Q_OBJECT
 public:
  CurveCanvas(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);
  ~CurveCanvas() override;

  void zoomFit();
  void zoomActual();           ///< One scan pixel is one device pixel.
  void zoomBy(double factor);  ///< About the centre of the view.
  double zoom() const;         ///< Device pixels per scan pixel.
  QPointF toWidget(const Vec2& imagePx) const;
  Vec2 toImage(const QPointF& widget) const;

 signals:
  void zoomChanged(double zoom);
  /// The place under the mouse in image px, or none when it has left.
  void hovered(std::optional<batten::Vec2> imagePx);
  /// One line about what the place under the mouse offers ("Click to mark a corner").
  void hint(const QString& text);

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void wheelEvent(QWheelEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseMoveEvent(QMouseEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;
  void mouseDoubleClickEvent(QMouseEvent*) override;
  void tabletEvent(QTabletEvent*) override;
  bool focusNextPrevChild(bool next) override;
  void leaveEvent(QEvent*) override;
  void keyPressEvent(QKeyEvent*) override;
  void keyReleaseEvent(QKeyEvent*) override;
  bool event(QEvent*) override;
  /// Sees Space and \\ wherever the focus is, but for fields that take text.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void hold(const QKeyEvent& event, bool isDown);
  bool takesHeldKey(const QWidget& focused, bool isSpace) const;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace batten
