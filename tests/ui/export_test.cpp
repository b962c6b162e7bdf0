// SPDX-License-Identifier: GPL-3.0-or-later
// The export panel: who the file is for, what is written, and what the panel says of it.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QComboBox>
#include <QLabel>

#include "core/exchange/dxf_reader.h"
#include "tests/ui/rendered_scan.h"
#include "tests/ui/window_fixture.h"

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
  EXPECT_TRUE(find<QLabel>("export.note")->text().contains(QStringLiteral(" in)")));
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

}  // namespace
}  // namespace batten
