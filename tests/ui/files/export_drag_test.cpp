// SPDX-License-Identifier: GPL-3.0-or-later
// A curve dragged from the preview of the export into another program.
#include <gtest/gtest.h>

#include <QAction>
#include <QDropEvent>
#include <QFileInfo>
#include <QMimeData>
#include <QTimer>
#include <QUrl>
#include <QWindow>

#include "core/exchange/svg/svg_reader.h"
#include "tests/ui/rendered_scan.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/stages/export/export_preview.h"

namespace batten {
namespace {

using test::waitUntil;

/// Where something is dropped, as a drawing program would take it.
class DropTarget : public QWidget {
 public:
  using QWidget::QWidget;
  bool isEntered = false;
  QStringList formats;
  QByteArray picture, file;
  QString fileName;

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override {
    isEntered = true;
    event->acceptProposedAction();
  }
  void dropEvent(QDropEvent* event) override {
    formats = event->mimeData()->formats();
    picture = event->mimeData()->data(QStringLiteral("image/svg+xml"));
    const QList<QUrl> urls = event->mimeData()->urls();
    if (!urls.isEmpty()) {
      QFile dragged(urls[0].toLocalFile());
      fileName = QFileInfo(dragged).fileName();
      if (dragged.open(QIODevice::ReadOnly)) file = dragged.readAll();
    }
    event->acceptProposedAction();
  }
};

class ExportDrag : public test::WindowFixture {};

TEST_F(ExportDrag, ACurveIsDraggedOutAsAnSvg) {
  openPage(test::zigzagPage());
  Recipe recipe = session().recipe();
  recipe.cornerMarks.push_back({Vec2(200, 100)});
  session().change(QStringLiteral("Corner"), recipe);
  ASSERT_TRUE(settle());
  window_->action(ActionId::Export)->trigger();
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("fusion"));
  auto* preview = find<ExportPreview>("export.preview");
  ASSERT_TRUE(waitUntil([&] { return preview->content().curves.size() == 2; }));
  DropTarget target(window_.get());
  target.setAcceptDrops(true);
  target.setGeometry(0, 0, 120, 120);
  target.show();
  target.raise();
  const PreviewCurve& second = preview->content().curves[1];
  QWindow* window = window_->windowHandle();
  const QPoint from = preview->mapTo(window_.get(), preview->toWidget(second.points[20]).toPoint());
  // The drag holds the event loop until it ends, and it may begin within any of the first moves.
  bool isPulled = false;
  int ticks = 0, moves = 0;
  constexpr int kTicksOfAPull = 20;
  QTimer hand;
  QObject::connect(&hand, &QTimer::timeout, [&] {
    if (!isPulled && ++ticks < kTicksOfAPull) return;
    if (!target.isEntered && moves < 200) {
      ++moves;
      return QTest::mouseMove(window, QPoint(60 + moves % 2, 60));
    }
    QTest::mouseRelease(window, Qt::LeftButton, {}, QPoint(60, 60));
    hand.stop();
  });
  hand.start(30);
  QTest::mousePress(window, Qt::LeftButton, {}, from);
  for (int i = 1; i <= 5; ++i) QTest::mouseMove(window, from + QPoint(8 * i, 0));
  isPulled = true;
  ASSERT_TRUE(waitUntil([&] { return !target.picture.isEmpty(); })) << moves;
  EXPECT_TRUE(target.formats.contains(QStringLiteral("image/x-inkscape-svg")));
  EXPECT_EQ(target.file, target.picture);
  EXPECT_EQ(target.fileName, QStringLiteral("Curve %1.svg").arg(*second.number));
  const auto dragged = readSvg(target.picture.toStdString());
  ASSERT_TRUE(dragged) << dragged.error().message;
  ASSERT_EQ(dragged->curves.size(), 1u) << "the one under the mouse alone";
  const NurbsCurve& there = dragged->curves[0].pieces[0].curve;
  EXPECT_NEAR(there.point(there.start()).x(), second.points.front().x(), 1e-6);
  EXPECT_NEAR(there.point(there.start()).y(), -second.points.front().y(), 1e-6);
}

}  // namespace
}  // namespace batten
