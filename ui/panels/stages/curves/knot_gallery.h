// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "core/construct/polygon/control_polygon.h"
#include "ui/session/background/inbox.h"
#include "ui/session/editor_session.h"

namespace batten {

class BackgroundWorker;
class KnotTile;

/// One control polygon in all degrees, with uniform knots above and with knots repeated at the corners below, as in the
/// figures 3 to 6 of 004. A click on a column takes its degree.
class KnotGallery : public QWidget {
  Q_OBJECT
 public:
  explicit KnotGallery(EditorSession& session, QWidget* parent = nullptr);
  ~KnotGallery() override;
  void setLine(const LinePolygon& line, SharpKnots repeated);

 protected:
  void keyPressEvent(QKeyEvent*) override;

 private:
  void refresh();
  EditorSession& session_;
  std::vector<KnotTile*> tiles_;
  Inbox inbox_;
  std::unique_ptr<BackgroundWorker> worker_;
  int request_ = 0;
};

}  // namespace batten
