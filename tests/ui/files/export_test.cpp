// SPDX-License-Identifier: GPL-3.0-or-later
// The export panel: who the file is for, what is written, and what the panel says of it.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QClipboard>
#include <QComboBox>
#include <QDropEvent>
#include <QFileInfo>
#include <QLabel>
#include <QListWidget>
#include <QMimeData>
#include <QProgressBar>
#include <QRegularExpression>
#include <QUndoStack>
#include <QUrl>
#include <QWindow>

#include "core/exchange/cad/dxf_reader.h"
#include "core/exchange/svg/svg_reader.h"
#include "tests/ui/rendered_scan.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/stages/export/export_preview.h"

namespace batten {
namespace {

using test::waitUntil;

class Export : public test::WindowFixture {};

TEST_F(Export, TheReceiverChoosesFormatEndingAndOptions) {
  openPage(test::ellipsePage());
  window_->action(ActionId::Export)->trigger();
  auto* path = find<QLineEdit>("export.path");
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("laser"));
  EXPECT_TRUE(path->text().endsWith(QStringLiteral("/page.dxf"))) << path->text().toStdString();
  EXPECT_TRUE(find<QLineEdit>("export.tolerance")->isVisible()) << "cubics approximate";
  EXPECT_TRUE(find<QComboBox>("export.unit")->isVisible());
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("fusion"));
  EXPECT_FALSE(find<QLineEdit>("export.tolerance")->isVisible()) << "exact";
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("matlab"));
  EXPECT_TRUE(path->text().endsWith(QStringLiteral("/page.poly.csv"))) << path->text().toStdString();
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("illustrator"));
  EXPECT_TRUE(path->text().endsWith(QStringLiteral("/page.svg"))) << path->text().toStdString();
  EXPECT_FALSE(find<QComboBox>("export.unit")->isVisible()) << "SVG is in mm";
}

TEST_F(Export, ADxfInInchesIsReadBackAndItsSizeShown) {
  openPage(test::ellipsePage());
  window_->action(ActionId::Export)->trigger();
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("laser"));
  auto* unit = find<QComboBox>("export.unit");
  unit->setFocus();
  QTest::keyClick(unit, Qt::Key_Down);
  EXPECT_TRUE(find<QLabel>("export.note")->text().contains(QStringLiteral("\u00a0in)")));
  // The ending of another format is replaced.
  auto* path = find<QLineEdit>("export.path");
  path->selectAll();
  path->insert(folder_.filePath(QStringLiteral("süß.svg")));  // letters that no test key stands for
  QTest::keyClick(path, Qt::Key_Return);
  QTest::mouseClick(find<QAbstractButton>("export.run"), Qt::LeftButton);
  const QString target = folder_.filePath(QStringLiteral("süß.dxf"));
  auto* result = find<QLabel>("export.result");
  ASSERT_TRUE(waitUntil([&] { return QFile::exists(target) && !result->text().isEmpty(); }));
  EXPECT_TRUE(result->text().contains(QStringLiteral("read back, largest difference"))) << result->text().toStdString();
  const auto drawing = readDxf(read(target).toStdString());
  ASSERT_TRUE(drawing) << drawing.error().message;
  EXPECT_EQ(drawing->mmPerUnit, 25.4);
  EXPECT_FALSE(drawing->entities.empty());
}

TEST_F(Export, ThePreviewShowsWhatWillBeWritten) {
  openPage(test::zigzagPage());
  for (const Vec2& corner : {Vec2(200, 100), Vec2(400, 300)}) {
    Recipe recipe = session().recipe();
    recipe.cornerMarks.push_back({corner});
    session().change(QStringLiteral("Corner"), recipe);
  }
  ASSERT_TRUE(settle());
  window_->action(ActionId::Export)->trigger();
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("illustrator"));
  auto* preview = find<ExportPreview>("export.preview");
  ASSERT_TRUE(waitUntil([&] { return preview->content().curves.size() == 1; })) << "a line is one path";
  auto* joined = find<QAbstractButton>("export.joined");
  QTest::mouseClick(joined, Qt::LeftButton, {}, {8, joined->height() / 2});
  ASSERT_TRUE(waitUntil([&] { return preview->content().curves.size() == 3; }));
  EXPECT_TRUE(find<QLabel>("export.held")->text().startsWith(QStringLiteral("3 curves")));
  EXPECT_NEAR(preview->content().box.width(), 520 * 25.4 / 300, 1.0);
  // A click selects, and the selected curve is turned round.
  const PreviewCurve first = preview->content().curves[0];
  QTest::mouseClick(preview, Qt::LeftButton, {}, preview->toWidget(first.points[20]).toPoint());
  ASSERT_EQ(session().selectedCurve(), *first.number - 1);
  QTest::mouseClick(find<QAbstractButton>("export.turn"), Qt::LeftButton);
  ASSERT_TRUE(waitUntil([&] {
    const auto& curves = preview->content().curves;
    return curves.size() == 3 && QLineF(curves[0].points.front(), first.points.back()).length() < 1e-6;
  })) << "it begins where it ended";
  window_->action(ActionId::Undo)->trigger();
  ASSERT_TRUE(waitUntil([&] {
    const auto& curves = preview->content().curves;
    return curves.size() == 3 && QLineF(curves[0].points.front(), first.points.front()).length() < 1e-6;
  }));
}

TEST_F(Export, StrokesAreOutlinedOnRequest) {
  openPage(test::zigzagPage());
  Recipe recipe = session().recipe();
  recipe.edges.mode = EdgeMode::Centreline;
  session().change(QStringLiteral("Centre lines"), recipe);
  ASSERT_TRUE(settle());
  window_->action(ActionId::Export)->trigger();
  auto* widths = find<QAbstractButton>("export.widths");
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("fusion"));
  EXPECT_FALSE(widths->isVisible()) << "a DXF has no areas";
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("inkscape"));
  ASSERT_TRUE(widths->isVisible());
  EXPECT_FALSE(widths->isChecked());
  QTest::mouseClick(widths, Qt::LeftButton, {}, {8, widths->height() / 2});
  ASSERT_TRUE(widths->isChecked());
  auto* path = find<QLineEdit>("export.path");
  path->setFocus();
  path->selectAll();
  path->insert(folder_.filePath(QStringLiteral("wide.svg")));
  QTest::keyClick(path, Qt::Key_Return);
  QTest::mouseClick(find<QAbstractButton>("export.run"), Qt::LeftButton);
  const QString target = folder_.filePath(QStringLiteral("wide.svg"));
  auto* result = find<QLabel>("export.result");
  ASSERT_TRUE(waitUntil([&] { return QFile::exists(target) && !result->text().isEmpty(); }));
  EXPECT_TRUE(result->text().contains(QStringLiteral("outlined within"))) << result->text().toStdString();
  EXPECT_TRUE(read(target).contains("batten:width-of=\"curve-1\""));
}

TEST_F(Export, TheCurvesOfTheFileAreChosenInThePanel) {
  openPage(test::zigzagPage());
  Recipe recipe = session().recipe();
  recipe.cornerMarks = {{{200, 100}}, {{400, 300}}};
  session().change(QStringLiteral("Corners"), recipe);
  ASSERT_TRUE(settle());
  window_->action(ActionId::Export)->trigger();
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("illustrator"));
  auto* choice = find<QComboBox>("export.choice");
  auto* list = find<QListWidget>("export.list");
  auto* button = find<QAbstractButton>("export.run");
  auto* preview = find<ExportPreview>("export.preview");
  EXPECT_FALSE(list->isVisible());
  choice->setFocus();
  QTest::keyClick(choice, Qt::Key_End);
  ASSERT_TRUE(list->isVisible());
  ASSERT_EQ(list->count(), 3);
  EXPECT_EQ(list->item(1)->text(), QStringLiteral("Curve 2"));
  list->setFocus();
  list->setCurrentRow(1);
  EXPECT_EQ(session().selectedCurve(), 1) << "what is pointed at shows in the drawing";
  // With the mouse on the drawing Space pans.
  QCursor::setPos(list->mapToGlobal(list->rect().center()));
  ASSERT_TRUE(waitUntil([this] { return !find<CurveCanvas>("canvas")->underMouse(); }));
  QTest::keyClick(list, Qt::Key_Space);
  ASSERT_EQ(list->item(1)->checkState(), Qt::Unchecked);
  ASSERT_TRUE(waitUntil([&] { return preview->content().curves.size() == 2; })) << "the line is interrupted";
  EXPECT_TRUE(find<QLabel>("export.held")->text().startsWith(QStringLiteral("2 curves")));
  const QString target = folder_.filePath(QStringLiteral("some.svg"));
  auto* path = find<QLineEdit>("export.path");
  path->selectAll();
  path->insert(target);
  QTest::keyClick(path, Qt::Key_Return);
  QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_TRUE(waitUntil([&] { return QFile::exists(target) && button->isEnabled(); }));
  const auto written = readSvg(read(target).toStdString());
  ASSERT_TRUE(written) << written.error().message;
  ASSERT_EQ(written->curves.size(), 2u);
  EXPECT_EQ(written->curves[0].pieces[0].name, "Curve 1");
  EXPECT_EQ(written->curves[1].pieces[0].name, "Curve 3");
  // Nothing ticked is nothing to write.
  QTest::mouseClick(find<QAbstractButton>("export.none"), Qt::LeftButton);
  EXPECT_FALSE(button->isEnabled());
  EXPECT_TRUE(find<QLabel>("export.note")->text().startsWith(QStringLiteral("Tick")));
  // The selected one follows the selection, and another drawing begins with all.
  choice->setFocus();
  QTest::keyClick(choice, Qt::Key_Up);
  EXPECT_FALSE(list->isVisible());
  session().selectCurve(2);
  ASSERT_TRUE(
      waitUntil([&] { return preview->content().curves.size() == 1 && preview->content().curves[0].number == 3; }));
  openPage(test::ellipsePage());
  EXPECT_EQ(choice->currentIndex(), 0);
}

TEST_F(Export, DirectionsAndStartsAreSetOnTheDrawing) {
  openPage(test::ellipsePage());
  window_->action(ActionId::Export)->trigger();
  window_->action(ActionId::ToolDirection)->trigger();
  ASSERT_EQ(session().curves().size(), 1u);
  const PageFrame frame = session().output().frame;
  const NurbsCurve shape = session().curves()[0].faired;
  const auto placeAt = [&](double share) {
    return frame.pointToImage(shape.point(shape.start() + share * (shape.end() - shape.start())));
  };
  ASSERT_TRUE(waitUntil([&] {
    clickCanvas(placeAt(0.3));
    return session().recipe().directions.size() == 1;
  })) << "once the curves are drawn";
  // The ring moves, as one step.
  auto* canvas = find<CurveCanvas>("canvas");
  const int steps = session().undoStack()->index();
  const auto widget = [&](const Vec2& px) { return canvas->toWidget(px).toPoint(); };
  QTest::mousePress(canvas, Qt::LeftButton, {}, widget(placeAt(0.0)));
  QTest::mouseMove(canvas, widget(placeAt(0.2)));
  QTest::mouseMove(canvas, widget(placeAt(0.4)));
  QTest::mouseRelease(canvas, Qt::LeftButton, {}, widget(placeAt(0.4)));
  ASSERT_EQ(session().recipe().starts.size(), 1u);
  EXPECT_LT((session().recipe().starts[0].positionPx - placeAt(0.4)).norm(), 4.0);
  EXPECT_EQ(session().undoStack()->index(), steps + 1);
  auto* preview = find<ExportPreview>("export.preview");
  ASSERT_TRUE(waitUntil([&] {
    if (preview->content().curves.size() != 1) return false;
    const QPointF start = preview->content().curves[0].points.front();
    return (frame.pointToImage({start.x(), -start.y()}) - placeAt(0.4)).norm() < 4.0;
  }));
}

TEST_F(Export, CurvesAreCopiedAsSvg) {
  openPage(test::ellipsePage());
  window_->action(ActionId::Export)->trigger();
  QApplication::clipboard()->clear();
  QTest::mouseClick(find<QAbstractButton>("export.copy"), Qt::LeftButton);
  ASSERT_TRUE(
      waitUntil([] { return QApplication::clipboard()->mimeData()->hasFormat(QStringLiteral("image/svg+xml")); }));
  const QMimeData* data = QApplication::clipboard()->mimeData();
  const QByteArray svg = data->data(QStringLiteral("image/svg+xml"));
  // Inkscape asks for its own name first, editors for the text.
  EXPECT_EQ(data->data(QStringLiteral("image/x-inkscape-svg")), svg);
  EXPECT_EQ(data->text().toUtf8(), svg);
  const auto copied = readSvg(svg.toStdString());
  ASSERT_TRUE(copied) << copied.error().message;
  ASSERT_EQ(copied->curves.size(), 1u);
  const NurbsCurve &shape = session().curves()[0].faired, &there = copied->curves[0].pieces[0].curve;
  for (int i = 0; i <= 200; ++i) {
    const auto at = [&](const NurbsCurve& c) { return c.point(c.start() + (c.end() - c.start()) * i / 200); };
    EXPECT_LE((at(shape) - at(there)).norm(), 1e-9);
  }
  // Its size is that of the page; user units are pixels, for which Inkscape takes what it is given.
  const QRegularExpressionMatch head =
      QRegularExpression(QStringLiteral("width=\"([0-9.]+)mm\" .*viewBox=\"0 0 ([0-9.]+) "))
          .match(QString::fromUtf8(svg));
  const double side = session().output().frame.widthPx * session().output().frame.mmPerPx;
  EXPECT_NEAR(head.captured(1).toDouble(), side, 1e-6);
  EXPECT_NEAR(head.captured(2).toDouble(), side * 96 / 25.4, 1e-6);
  EXPECT_TRUE(find<QLabel>("export.result")->text().contains(QStringLiteral("read back")));
}

TEST_F(Export, EscapeStopsItAndNothingIsWritten) {
  openPage(test::ellipsePage());
  window_->action(ActionId::Export)->trigger();
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("laser"));
  const QString target = folder_.filePath(QStringLiteral("stopped.dxf"));
  auto* path = find<QLineEdit>("export.path");
  auto* result = find<QLabel>("export.result");
  path->selectAll();
  path->insert(target);
  // It may be done before the key is heard; then it is tried again with another file.
  bool wasStopped = false;
  for (int attempt = 0; attempt < 50 && !wasStopped; ++attempt) {
    QFile::remove(target);
    result->clear();
    find<QAbstractButton>("export.run")->click();
    window_->action(ActionId::CancelWork)->trigger();
    ASSERT_TRUE(waitUntil([&] { return !result->text().isEmpty(); }));
    wasStopped = result->text().startsWith(QStringLiteral("Stopped"));
    if (wasStopped) {
      EXPECT_FALSE(QFile::exists(target));
    }
  }
  EXPECT_TRUE(wasStopped);
  EXPECT_FALSE(find<QProgressBar>("export.progress")->isVisible());
}

TEST_F(Export, AFileThatAnotherProgramChangedIsAskedAboutAgain) {
  openPage(test::ellipsePage());
  window_->action(ActionId::Export)->trigger();
  ASSERT_NO_FATAL_FAILURE(chooseReceiver("laser"));
  const QString target = folder_.filePath(QStringLiteral("ours.dxf"));
  auto* path = find<QLineEdit>("export.path");
  auto* result = find<QLabel>("export.result");
  auto* button = find<QAbstractButton>("export.run");
  path->selectAll();
  path->insert(target);
  const auto press = [&] {
    result->clear();
    EXPECT_TRUE(waitUntil([&] { return button->isEnabled(); }));
    button->click();
    EXPECT_TRUE(waitUntil([&] { return !result->text().isEmpty(); }));
    return result->text();
  };
  EXPECT_TRUE(press().startsWith(QStringLiteral("Wrote")));
  EXPECT_TRUE(press().startsWith(QStringLiteral("Wrote"))) << "its own file is replaced without a word";
  QFile file(target);
  ASSERT_TRUE(file.open(QIODevice::Append));
  file.write("999\nedited\n");
  file.close();
  EXPECT_TRUE(press().contains(QStringLiteral("changed by another program"))) << result->text().toStdString();
  EXPECT_TRUE(read(target).endsWith("edited\n"));
  EXPECT_TRUE(press().startsWith(QStringLiteral("Wrote")));
  EXPECT_FALSE(read(target).endsWith("edited\n"));
}

TEST_F(Export, AReportIsWrittenFromThePanel) {
  openPage(test::ellipsePage());
  window_->action(ActionId::Export)->trigger();
  auto* button = find<QAbstractButton>("report.write");
  ASSERT_TRUE(waitUntil([&] { return button->isEnabled(); }));
  for (const char* name : {"r.report.pdf", "r.report.html"}) {
    const QString target = folder_.filePath(QLatin1String(name));
    find<QComboBox>("report.kind")->setCurrentIndex(target.endsWith(QStringLiteral("pdf")) ? 0 : 2);
    saveAs(target, [&] { QTest::mouseClick(button, Qt::LeftButton); });
    ASSERT_TRUE(waitUntil([&] { return QFile::exists(target) && button->isEnabled(); }));
    EXPECT_TRUE(find<QLabel>("report.result")->text().contains(QLatin1String(name)));
    EXPECT_TRUE(find<QLabel>("export.result")->text().isEmpty()) << "that line is the export's";
    const QByteArray bytes = read(target);
    EXPECT_TRUE(bytes.startsWith(target.endsWith(QStringLiteral("pdf")) ? "%PDF-" : "<!DOCTYPE html>"));
  }
}

}  // namespace
}  // namespace batten
