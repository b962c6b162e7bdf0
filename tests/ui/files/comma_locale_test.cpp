// SPDX-License-Identifier: GPL-3.0-or-later
// The window where numbers are written with commas: what is typed, stored and exported is the same.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QLabel>
#include <QLocale>
#include <sstream>

#include "core/pipeline/recipe/recipe_file.h"
#include "tests/support/comma_locale.h"
#include "tests/ui/window_fixture.h"

namespace batten {
namespace {

using test::waitUntil;

class UnderCommas : public test::WindowFixture {
 protected:
  void SetUp() override {
    before_ = QLocale();
    ASSERT_NO_FATAL_FAILURE(WindowFixture::SetUp());
  }
  void TearDown() override { QLocale::setDefault(before_); }

  /// Fairs within a tolerance that is typed, and exports; what the recipe and the file then contain.
  std::pair<std::string, QByteArray> fairAndExport(const QString& tolerance, const QString& file) {
    openPage(test::zigzagPage());
    window_->setStage(PanelStage::Fairing);
    QTest::mouseClick(find<QAbstractButton>("fairing.mode.tolerance"), Qt::LeftButton);
    type(find<QLineEdit>("fairing.tolerance.field"), tolerance);
    EXPECT_TRUE(settle());
    EXPECT_EQ(session().recipe().fairing.toleranceMm, 0.25);
    EXPECT_TRUE(find<QLineEdit>("fairing.tolerance.field")->text().startsWith(QStringLiteral("0.25")))
        << find<QLineEdit>("fairing.tolerance.field")->text().toStdString();
    window_->action(ActionId::Export)->trigger();
    chooseReceiver("illustrator");
    const QString target = folder_.filePath(file);
    type(find<QLineEdit>("export.path"), target);
    QTest::mouseClick(find<QAbstractButton>("export.run"), Qt::LeftButton);
    EXPECT_TRUE(waitUntil([&] { return QFile::exists(target) && !find<QLabel>("export.result")->text().isEmpty(); }));
    return {recipeToJson(session().recipe()), read(target)};
  }

  QLocale before_;
};

TEST_F(UnderCommas, FieldsRecipeAndFileAreTheSame) {
  const auto points = fairAndExport(QStringLiteral("0.25"), QStringLiteral("points.svg"));
  ASSERT_FALSE(points.second.isEmpty());

  QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
  const test::CommaLocale locale;
  std::ostringstream written;
  written << 1234.5;
  ASSERT_EQ(written.str(), "1.234,5") << "the locale holds";
  ASSERT_EQ(QLocale().toString(1.5), QStringLiteral("1,5")) << "in Qt, too";
  openWindow();
  for (const auto& [typed, file] : {std::pair("0,25", "comma.svg"), std::pair("0.25", "point.svg")}) {
    const auto commas = fairAndExport(QString::fromLatin1(typed), QString::fromLatin1(file));
    EXPECT_EQ(commas.first, points.first) << typed;
    EXPECT_EQ(commas.second, points.second) << typed;
  }
}

}  // namespace
}  // namespace batten
