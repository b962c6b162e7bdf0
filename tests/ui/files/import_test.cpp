// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QClipboard>
#include <QComboBox>
#include <QGuiApplication>
#include <QLabel>
#include <QListWidget>
#include <QMimeData>
#include <QPdfWriter>
#include <QStandardPaths>

#include "core/image/pdf/pdf_page.h"
#include "tests/ui/window_fixture.h"

namespace batten {
namespace {

using test::waitUntil;

class ImportWindow : public test::WindowFixture {
 protected:
  QString written(const QString& name, const QByteArray& bytes) const {
    const QString path = folder_.filePath(name);
    QFile file(path);
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(bytes);
    return path;
  }
  QString dxf() const {
    return written(QStringLiteral("roof Süße.dxf"),
                   "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
                   "0\nLINE\n8\nA\n10\n5\n20\n5\n11\n40\n21\n20\n0\nCIRCLE\n8\nA\n10\n25\n20\n15\n40\n8\n"
                   "0\nENDSEC\n0\nEOF\n");
  }
  QAction* actionOf(const char* name) {
    auto* found = window_->findChild<QAction*>(QString::fromLatin1(name));
    EXPECT_NE(found, nullptr) << name;
    return found;
  }
  QString field(const char* name) { return find<QLineEdit>(name)->text(); }
};

TEST_F(ImportWindow, AFileOfCurvesIsADrawingOfItsOwn) {
  window_->openPath(dxf());
  ASSERT_TRUE(waitUntil([this] { return session().isBlankPage() && !session().isBusy(); }));
  ASSERT_EQ(session().curves().size(), 2u);
  EXPECT_FALSE(find<QWidget>("errorStrip")->isVisible());
  EXPECT_EQ(window_->stage(), PanelStage::Fairing);
  EXPECT_EQ(session().recipe().imports[0].source, "roof Süße.dxf");
  EXPECT_NEAR(session().curves()[1].fairedFigures.lengthMm, 16.0 * M_PI, 1e-6);
  // What cannot be read is told, and the drawing stays.
  window_->openPath(written(QStringLiteral("bad.step"), "hello"));
  ASSERT_TRUE(waitUntil([this] { return find<QWidget>("errorStrip")->isVisible(); }));
  EXPECT_EQ(session().curves().size(), 2u);
}

TEST_F(ImportWindow, NamesAndLayersAreShownWhereTheCurvesAre) {
  window_->openPath(
      written(QStringLiteral("roof.dxf"),
              "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
              "0\nLINE\n8\nBody\n10\n5\n20\n5\n11\n40\n21\n20\n1001\nBATTEN\n1000\nroof line\n"
              "0\nCIRCLE\n8\n0\n10\n25\n20\n45\n40\n8\n1001\nBATTEN\n1000\nCurve 9\n0\nENDSEC\n0\nEOF\n"));
  ASSERT_TRUE(waitUntil([this] { return session().isBlankPage() && !session().isBusy(); }));
  window_->setStage(PanelStage::Curves);
  auto* list = find<QListWidget>("curves.list");
  ASSERT_TRUE(waitUntil([&] { return list->count() == 2; }));
  EXPECT_TRUE(list->item(0)->text().startsWith(QStringLiteral("Curve 10 (roof line)")))
      << list->item(0)->text().toStdString();
  EXPECT_TRUE(list->item(0)->toolTip().contains(QStringLiteral("(roof line), roof.dxf, layer Body")));
  EXPECT_TRUE(list->item(1)->text().startsWith(QStringLiteral("Curve 9, closed")))
      << list->item(1)->text().toStdString();
  EXPECT_TRUE(list->item(1)->toolTip().contains(QStringLiteral("roof.dxf")));
}

TEST_F(ImportWindow, AFileWithoutAUnitIsAskedFor) {
  window_->openPath(written(QStringLiteral("bare.dxf"),
                            "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nA\n10\n0\n20\n0\n11\n40\n"
                            "21\n30\n0\nENDSEC\n0\nEOF\n"));
  ASSERT_TRUE(waitUntil([this] { return session().isBlankPage() && !session().isBusy(); }));
  EXPECT_TRUE(window_->windowTitle().startsWith(QStringLiteral("bare.dxf"))) << window_->windowTitle().toStdString();
  ASSERT_EQ(session().recipe().imports.at(0).unit, "mm?");
  const auto pick = [&](const QString& unit) {
    auto* choice = find<QComboBox>("import.unit.0");
    choice->setCurrentText(unit);
    emit choice->textActivated(unit);
    EXPECT_TRUE(waitUntil([this] { return !session().isBusy(); }));
  };
  EXPECT_EQ(find<QComboBox>("import.unit.0")->currentText(), QStringLiteral("mm?"));
  EXPECT_TRUE(find<QLabel>("import.note")->text().contains(QStringLiteral("states no unit")));
  pick(QStringLiteral("in"));
  EXPECT_EQ(session().recipe().imports.at(0).unit, "in");
  EXPECT_NEAR(session().curves()[0].fairedFigures.lengthMm, 1270.0, 1e-6);
  EXPECT_FALSE(find<QLabel>("import.note")->text().contains(QStringLiteral("states no unit")));
  actionOf("undo")->trigger();
  ASSERT_TRUE(waitUntil([this] { return session().recipe().imports.at(0).unit == "mm?" && !session().isBusy(); }));
  EXPECT_NEAR(session().curves()[0].fairedFigures.lengthMm, 50.0, 1e-6);
}

TEST_F(ImportWindow, CurvesAreImportedOverTheScanAndUndone) {
  openPage(test::zigzagPage());
  const std::size_t before = session().curves().size();
  inDialog(
      [&](QWidget& dialog) {
        auto* edit = dialog.findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
        ASSERT_NE(edit, nullptr);
        edit->setText(dxf());
        QTest::keyClick(edit, Qt::Key_Return);
      },
      [&] { actionOf("import-curves")->trigger(); });
  ASSERT_TRUE(waitUntil([&] { return session().curves().size() == before + 2 && !session().isBusy(); }));
  EXPECT_FALSE(session().isBlankPage());
  ASSERT_EQ(session().recipe().imports.size(), 1u);
  actionOf("undo")->trigger();
  ASSERT_TRUE(waitUntil([&] { return session().curves().size() == before && !session().isBusy(); }));
  EXPECT_TRUE(session().recipe().imports.empty());
}

TEST_F(ImportWindow, APictureIsPastedAsAScan) {
  QStandardPaths::setTestModeEnabled(true);
  QGuiApplication::clipboard()->setImage(test::zigzagPage());
  actionOf("paste-scan")->trigger();
  ASSERT_TRUE(waitUntil([this] { return session().hasScan() && !session().isBusy(); }));
  EXPECT_FALSE(session().curves().empty());
  EXPECT_EQ(session().scan()->grey.width, 640);
  EXPECT_TRUE(QFile::exists(session().scanPath()));
  QFile::remove(session().scanPath());
  QStandardPaths::setTestModeEnabled(false);
}

TEST_F(ImportWindow, ThePagesOfAFileAreChosenInTheScanPanel) {
  if (!hasPdf()) return;  // without Poppler there is no page to choose; the unit tests have the TIFF
  const QString path = folder_.filePath(QStringLiteral("pages.pdf"));
  {
    QPdfWriter writer(path);
    writer.setPageSize(QPageSize(QSizeF(60, 40), QPageSize::Millimeter));
    writer.setPageMargins(QMarginsF());
    writer.setResolution(300);
    QPainter painter(&writer);
    painter.setPen(QPen(Qt::black, 6.0));
    painter.drawEllipse(QRectF(100, 80, 400, 250));
    writer.newPage();
    painter.drawLine(QPointF(100, 100), QPointF(600, 300));
    painter.drawLine(QPointF(100, 300), QPointF(600, 420));
  }
  openFile(path);
  window_->setStage(PanelStage::Scan);
  ASSERT_EQ(session().scan()->pages, 2);
  EXPECT_NEAR(session().scan()->grey.width, 708.7, 1.0) << "the writer may round the page to points";
  const std::size_t curves = session().curves().size();
  EXPECT_TRUE(find<QLineEdit>("scan.page")->isVisible());
  type(find<QLineEdit>("scan.page"), QStringLiteral("2"));
  ASSERT_TRUE(waitUntil([this] { return session().scan()->page.number == 2 && !session().isBusy(); }));
  EXPECT_EQ(session().recipe().scanPage.number, 2);
  EXPECT_NE(session().curves().size(), curves);
  type(find<QLineEdit>("scan.pdfDpi"), QStringLiteral("150"));
  ASSERT_TRUE(waitUntil([this] { return session().scan()->grey.width < 400 && !session().isBusy(); }));
  EXPECT_NEAR(session().scan()->grey.width, 354.3, 1.0);
  EXPECT_NEAR(session().output().frame.mmPerPx * session().scan()->grey.width, 60.0, 0.2) << "the size in mm stays";
  // A recipe saved for the page is found with it, and the first page knows nothing of it.
  saveAs(folder_.filePath(QStringLiteral("pages-p2.recipe.json")), [&] { actionOf("save-recipe")->trigger(); });
  type(find<QLineEdit>("scan.page"), QStringLiteral("1"));
  ASSERT_TRUE(waitUntil([this] { return session().scan()->page.number == 1 && !session().isBusy(); }));
  EXPECT_FALSE(session().openedWithRecipe());
}

}  // namespace
}  // namespace batten
