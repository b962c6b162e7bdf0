// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QCheckBox>
#include <QLabel>
#include <QListWidget>
#include <QPointingDevice>
#include <QTabletEvent>
#include <cmath>
#include <filesystem>

#include "core/document/export_builder.h"
#include "core/exchange/save_atomically.h"
#include "core/exchange/svg/svg_writer.h"
#include "core/exchange/text/curve_json.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "tests/ui/window_fixture.h"
#include "ui/new_drawing_dialog.h"
#include "ui/panels/stages/curves/knot_panel.h"
#include "ui/panels/stages/curves/knot_strip.h"
#include "ui/session/edits/pen_edits.h"

namespace batten {
namespace {

using test::waitUntil;

class Pen : public test::WindowFixture {
 protected:
  void begin() {
    window_->beginDrawing(NewDrawingDialog::recipeFor({100, 80}, 127.0));
    ASSERT_TRUE(waitUntil([this] { return session().isBlankPage() && !session().isBusy(); }));
  }
  /// Draws through these places (image px) with the left button, a few moves to each.
  void draw(const std::vector<Vec2>& places, Qt::KeyboardModifiers modifiers = {}) {
    auto* canvas = find<CurveCanvas>("canvas");
    QTest::mousePress(canvas, Qt::LeftButton, modifiers, canvas->toWidget(places.front()).toPoint());
    for (std::size_t i = 1; i < places.size(); ++i)
      for (int k = 1; k <= 6; ++k) {
        const Vec2 at = places[i - 1] + (places[i] - places[i - 1]) * (k / 6.0);
        QMouseEvent move(QEvent::MouseMove, canvas->toWidget(at), canvas->mapToGlobal(canvas->toWidget(at)),
                         Qt::NoButton, Qt::LeftButton, modifiers);
        QCoreApplication::sendEvent(canvas, &move);
      }
    QTest::mouseRelease(canvas, Qt::LeftButton, modifiers, canvas->toWidget(places.back()).toPoint());
    ASSERT_TRUE(settle());
  }
  /// Three legs with two sharp corners.
  void drawZigzag() { draw({{60, 300}, {200, 100}, {340, 300}, {440, 80}}); }
};

TEST_F(Pen, ANewPageWaitsForThePenWithoutComplaint) {
  begin();
  EXPECT_EQ(window_->view().tool(), Tool::Pen);
  EXPECT_TRUE(find<QAbstractButton>("pen.draw")->isChecked());
  EXPECT_FALSE(find<QWidget>("errorStrip")->isVisible());
  EXPECT_EQ(session().scan()->grey.width, 500);
  EXPECT_EQ(session().scan()->grey.height, 400);
}

TEST_F(Pen, AStrokeBecomesACurveAndCanBeTakenBackAndRemoved) {
  begin();
  drawZigzag();
  ASSERT_EQ(session().recipe().penStrokes.size(), 1u);
  EXPECT_GT(session().recipe().penStrokes[0].points.size(), 12u);
  EXPECT_FALSE(session().recipe().penStrokes[0].closed);
  ASSERT_EQ(session().curves().size(), 1u);
  EXPECT_EQ(session().selectedCurve(), 0);
  EXPECT_EQ(strokeOf(session(), 0), 0u);
  auto* list = find<QListWidget>("pen.list");
  EXPECT_EQ(list->count(), 1);
  EXPECT_EQ(list->currentRow(), 0);
  session().undoStack()->undo();
  EXPECT_TRUE(session().recipe().penStrokes.empty());
  session().undoStack()->redo();
  ASSERT_TRUE(settle());
  draw({{60, 40}, {120, 40}, {120, 70}, {60, 70}, {61, 41}});
  ASSERT_EQ(session().recipe().penStrokes.size(), 2u);
  EXPECT_TRUE(session().recipe().penStrokes[1].closed);
  EXPECT_EQ(strokeOf(session(), session().selectedCurve()), 1u) << "the line just drawn is the selected one";
  draw({{260, 340}, {320, 340}, {320, 370}, {260, 370}, {261, 341}}, Qt::AltModifier);
  EXPECT_FALSE(session().recipe().penStrokes[2].closed) << "Alt leaves it open";
  clickCanvas({200, 100});
  EXPECT_EQ(strokeOf(session(), session().selectedCurve()), 0u);
  QTest::keyClick(find<CurveCanvas>("canvas"), Qt::Key_Delete);
  EXPECT_EQ(session().recipe().penStrokes.size(), 2u);
  ASSERT_TRUE(settle());
  list->setCurrentRow(0);
  QTest::mouseClick(find<QAbstractButton>("pen.remove"), Qt::LeftButton);
  EXPECT_EQ(session().recipe().penStrokes.size(), 1u);
  QTest::mouseClick(find<QAbstractButton>("pen.removeAll"), Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(session().curves().empty());
  EXPECT_FALSE(find<QWidget>("errorStrip")->isVisible()) << "an empty page is no failure";
}

TEST_F(Pen, ATabletDrawsAtItsOwnAccuracyWhateverThePressure) {
  begin();
  auto* canvas = find<CurveCanvas>("canvas");
  const QPointingDevice stylus(QStringLiteral("stylus"), 7, QInputDevice::DeviceType::Stylus,
                               QPointingDevice::PointerType::Pen, QInputDevice::Capability::Pressure, 1, 2);
  const auto send = [&](QEvent::Type type, const Vec2& px, double pressure) {
    const QPointF at = canvas->toWidget(px);
    const bool up = type == QEvent::TabletRelease;
    QTabletEvent event(type, &stylus, at, canvas->mapToGlobal(at), pressure, 0, 0, 0, 0, 0, {},
                       type == QEvent::TabletMove ? Qt::NoButton : Qt::LeftButton, up ? Qt::NoButton : Qt::LeftButton);
    QCoreApplication::sendEvent(canvas, &event);
  };
  send(QEvent::TabletPress, {100.25, 100.5}, 0.2);
  for (int i = 1; i <= 40; ++i)
    send(QEvent::TabletMove, {100.25 + 5 * i, 100.5 + 40.0 * std::sin(0.1 * i)}, 0.1 + 0.02 * i);
  send(QEvent::TabletRelease, {300.25, 100.5 + 40.0 * std::sin(4.0)}, 0.0);
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().recipe().penStrokes.size(), 1u);
  const auto& points = session().recipe().penStrokes[0].points;
  EXPECT_LT((points.front() - Vec2(100.25, 100.5)).norm(), 1e-6) << "between pixels too";
  EXPECT_GE(points.size(), 38u);
}

TEST_F(Pen, PointsAreRemovedSharpPointsMarkedAndTheKnotsShown) {
  begin();
  drawZigzag();
  window_->setStage(PanelStage::Curves);
  QTest::mouseClick(find<QAbstractButton>("construct.method.control-polygon"), Qt::LeftButton);
  EXPECT_EQ(session().recipe().construct.method, ConstructMethod::ControlPolygon);
  ASSERT_TRUE(settle());
  auto* counts = find<QLabel>("knots.counts");
  auto* strip = find<KnotStrip>("knots.strip");
  const auto drawn = session().recipe().penStrokes[0].points.size();
  type(find<QLineEdit>("construct.removal_step.field"), QStringLiteral("0"));
  ASSERT_TRUE(settle());
  const QString all =
      QString::number(drawn) + QStringLiteral(" points, ") + QString::number(drawn) + QStringLiteral(" kept");
  EXPECT_TRUE(waitUntil([&] { return counts->text().startsWith(all); })) << counts->text().toStdString();
  type(find<QLineEdit>("construct.removal_step.field"), QStringLiteral("60"));
  ASSERT_TRUE(settle());
  ASSERT_TRUE(waitUntil([&] { return !counts->text().startsWith(all); }));
  EXPECT_TRUE(counts->text().startsWith(QString::number(drawn) + QStringLiteral(" points, ")));
  EXPECT_LT(session().curves()[0].sketched.controlPointCount(), static_cast<int>(drawn));

  window_->setStage(PanelStage::Corners);
  clickCanvas({203, 103});
  ASSERT_TRUE(settle());
  clickCanvas({338, 297});
  ASSERT_TRUE(settle());
  ASSERT_EQ(session().curves().size(), 3u);
  const auto& points = session().recipe().penStrokes[0].points;
  for (const Corner& corner : session().output().pieces->corners)
    EXPECT_NE(std::find(points.begin(), points.end(), corner.positionPx), points.end()) << "a drawn point";

  window_->setStage(PanelStage::Curves);
  for (int degree = 2; degree <= 5; ++degree) {
    type(find<QLineEdit>("construct.degree.field"), QString::number(degree));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(waitUntil([&] { return !strip->columns().empty() && strip->columns().front().times == degree + 1; }))
        << degree;
    int corners = 0;
    for (std::size_t i = 1; i + 1 < strip->columns().size(); ++i) {
      EXPECT_TRUE(strip->columns()[i].times == 1 || strip->columns()[i].times == degree);
      corners += strip->columns()[i].times == degree ? 1 : 0;
    }
    EXPECT_EQ(corners, 2);
    EXPECT_TRUE(find<QLabel>("knots.text")->text().startsWith(QStringLiteral("0×%1 1").arg(degree + 1)));
  }
  QTest::mouseClick(find<QCheckBox>("knots.uniform"), Qt::LeftButton, {},
                    QPoint(8, find<QCheckBox>("knots.uniform")->height() / 2));
  EXPECT_TRUE(window_->view().showsUniformKnots());
  QTest::mouseClick(find<QAbstractButton>("knots.compare"), Qt::LeftButton);
  auto* tile = find<QAbstractButton>("knots.tile.repeated.3");
  ASSERT_TRUE(tile->isVisible());
  QTest::mouseClick(tile, Qt::LeftButton);
  EXPECT_EQ(session().recipe().construct.degree, 3);
}

TEST_F(Pen, ADrawingIsSavedOpenedAgainAndTracedAlikeByItsRecipe) {
  begin();
  drawZigzag();
  draw({{60, 40}, {120, 40}, {120, 70}, {60, 70}, {61, 41}});
  Recipe recipe = session().recipe();
  recipe.construct.method = ConstructMethod::ControlPolygon;
  recipe.cornerMarks = {{{200, 100}}, {{340, 300}}};
  session().change(QStringLiteral("Marks"), recipe);
  ASSERT_TRUE(settle());
  for (const bool svg : {false, true}) {
    window_->action(ActionId::Export)->trigger();
    ASSERT_NO_FATAL_FAILURE(chooseReceiver(svg ? "illustrator" : "archive"));
    const QString target = folder_.filePath(svg ? QStringLiteral("d.svg") : QStringLiteral("d.json"));
    type(find<QLineEdit>("export.path"), target);
    ASSERT_TRUE(waitUntil([&] { return find<QAbstractButton>("export.run")->isEnabled(); }));
    QTest::mouseClick(find<QAbstractButton>("export.run"), Qt::LeftButton);
    ASSERT_TRUE(waitUntil([&] { return QFile::exists(target) && !find<QLabel>("export.result")->text().isEmpty(); }));
  }
  // The oracle: the stages alone, from the saved recipe and a page of its size, as batten-cli runs them.
  const std::string saved = recipeToJson(session().recipeToSave());
  const auto read = recipeFromJson(saved);
  ASSERT_TRUE(read);
  const Scan page = blankScan(read->page->widthPx, read->page->heightPx, *read->dpi);
  StageCache cache;
  const PipelineOutput output = runPipeline(page, *read, cache, {}, {});
  const ExportDocument document = exportDocument(output, *read, page);
  EXPECT_EQ(this->read(folder_.filePath(QStringLiteral("d.json"))).toStdString(), writeCurveJson(document).value());
  EXPECT_EQ(this->read(folder_.filePath(QStringLiteral("d.svg"))).toStdString(), writeSvg(document, {}).value().text);

  const QString path = folder_.filePath(QStringLiteral("drawing.recipe.json"));
  ASSERT_TRUE(saveAtomically(std::filesystem::path(path.toStdU16String()), saved));
  openPage(test::ellipsePage());
  ASSERT_NO_FATAL_FAILURE(openFile(path));
  EXPECT_TRUE(session().isBlankPage());
  EXPECT_EQ(session().recipeToSave(), *read);
  EXPECT_EQ(session().curves().size(), output.faired->curves.size());
  EXPECT_EQ(MainWindow::recentFiles().value(0), path);
}

TEST_F(Pen, DrawsOverAScanToo) {
  openPage(test::ellipsePage());
  const auto before = session().curves().size();
  window_->setStage(PanelStage::Scan);
  QTest::mouseClick(find<QAbstractButton>("tool-pen.button"), Qt::LeftButton);
  EXPECT_EQ(window_->view().tool(), Tool::Pen);
  EXPECT_TRUE(window_->view().isVisible(Layer::Curve)) << "what is drawn can be seen";
  draw({{40, 40}, {120, 30}, {240, 44}});
  EXPECT_EQ(session().curves().size(), before + 1);
}

}  // namespace
}  // namespace batten
