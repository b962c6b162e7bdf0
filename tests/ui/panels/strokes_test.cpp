// SPDX-License-Identifier: GPL-3.0-or-later
// The lines of the plots can be told from each other, by everybody and on both themes; notes can be read to their end.
#include <gtest/gtest.h>

#include <QApplication>
#include <QFrame>
#include <QLineEdit>
#include <QScreen>
#include <QTest>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/fairing/profile/target_degrees.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/controls/lines_note.h"
#include "ui/plots/plot_style.h"

namespace batten {
namespace {

using test::waitUntil;
using Colour = std::array<double, 3>;

/// Linear light of sRGB.
Colour linear(const QColor& colour) {
  const auto part = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  return {part(colour.redF()), part(colour.greenF()), part(colour.blueF())};
}

double luminance(const Colour& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

/// WCAG 2.
double contrast(const QColor& a, const QColor& b) {
  const double x = luminance(linear(a)), y = luminance(linear(b));
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

using Eye = std::array<Colour, 3>;
/// Full sight, protanopia, deuteranopia, tritanopia: Machado et al. 2009, severity 1.
constexpr std::array<Eye, 4> kEyes = {
    Eye{Colour{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    Eye{Colour{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}},
    Eye{Colour{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}},
    Eye{Colour{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}};

/// CIE L*a*b* of D65, as the eye sees it.
Colour labOf(const QColor& colour, const Eye& eye) {
  const Colour light = linear(colour);
  Colour seen{};
  for (std::size_t i = 0; i < 3; ++i)
    seen[i] = std::clamp(eye[i][0] * light[0] + eye[i][1] * light[1] + eye[i][2] * light[2], 0.0, 1.0);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double x = f((0.4124 * seen[0] + 0.3576 * seen[1] + 0.1805 * seen[2]) / 0.95047);
  const double y = f(luminance(seen));
  const double z = f((0.0193 * seen[0] + 0.1192 * seen[1] + 0.9505 * seen[2]) / 1.08883);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

/// For the eye that tells them apart worst. 2 is just seen side by side.
double difference(const QColor& a, const QColor& b) {
  double least = 1e9;
  for (const Eye& eye : kEyes) {
    const Colour one = labOf(a, eye), other = labOf(b, eye);
    least = std::min(least, std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]));
  }
  return least;
}

TEST(Strokes, EachTargetOfAPlotHasAStrokeOfItsOwn) {
  constexpr double kLeastContrast = 3.0;     // WCAG 2.1, 1.4.11
  constexpr double kLeastDifference = 15.0;  // of thin lines that do not touch
  for (const Theme* theme : {&lightTheme(), &darkTheme()}) {
    for (int degree = 1; degree <= kMostTargetDegree; ++degree) {
      const QPen pen = penOf(PlotRole::Target, *theme, degree);
      EXPECT_GE(contrast(pen.color(), theme->panel), kLeastContrast) << degree << " dark " << theme->dark;
      for (const PlotRole role : {PlotRole::Sketched, PlotRole::Faired, PlotRole::ChosenTarget}) {
        const QPen other = penOf(role, *theme, degree);
        EXPECT_GE(difference(pen.color(), other.color()), kLeastDifference) << degree << " dark " << theme->dark;
        EXPECT_GT(other.widthF(), pen.widthF()) << "what counts stands out";
      }
      EXPECT_NE(pen.dashPattern(), penOf(PlotRole::ChosenTarget, *theme, degree).dashPattern());
      for (int before = 1; before < degree; ++before) {
        const QPen other = penOf(PlotRole::Target, *theme, before);
        EXPECT_TRUE(pen.dashPattern() != other.dashPattern() ||
                    difference(pen.color(), other.color()) >= kLeastDifference)
            << before << " and " << degree << " dark " << theme->dark;
      }
    }
  }
}

class Notes : public test::WindowFixture {};

TEST_F(Notes, TheRestOfACutNoteIsReachedByClickAndByKey) {
  QWidget page;
  auto* column = new QVBoxLayout(&page);
  auto* note = new LinesNote(2, &page);
  column->addWidget(note);
  page.resize(260, 80);
  note->setText(QStringLiteral("Short."));
  page.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&page));
  QTest::mouseClick(note, Qt::LeftButton);
  EXPECT_EQ(page.findChild<QFrame*>(QStringLiteral("note.whole")), nullptr) << "there is no more to read";
  EXPECT_EQ(note->focusPolicy(), Qt::NoFocus);
  const QString all = QStringLiteral("word ").repeated(60) + QStringLiteral("last.");
  note->setText(all);
  ASSERT_TRUE(waitUntil([&] { return note->focusPolicy() == Qt::TabFocus; }, 5000));
  const auto expectWhole = [&] {
    auto* whole = page.findChild<QFrame*>(QStringLiteral("note.whole"));
    ASSERT_NE(whole, nullptr);
    EXPECT_TRUE(whole->isVisible());
    EXPECT_EQ(whole->findChild<QLabel*>()->text(), all);
    QTest::keyClick(whole, Qt::Key_Escape);
    EXPECT_TRUE(waitUntil([&] { return page.findChild<QFrame*>(QStringLiteral("note.whole")) == nullptr; }, 5000));
  };
  QTest::mouseClick(note, Qt::LeftButton);
  ASSERT_NO_FATAL_FAILURE(expectWhole());
  note->setFocus();
  QTest::keyClick(note, Qt::Key_Space);
  ASSERT_NO_FATAL_FAILURE(expectWhole());
}

TEST_F(Notes, ACutNoteIsInTheTabOrderBeforeItIsPaintedAndNoLongerThanItIsCut) {
  QWidget page;
  auto* column = new QVBoxLayout(&page);
  auto* note = new LinesNote(2, &page);
  auto* next = new QLineEdit(&page);
  column->addWidget(note);
  column->addWidget(next);
  page.resize(260, 120);
  page.show();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&page));
  const QString all = QStringLiteral("word ").repeated(30);
  note->setText(all);
  EXPECT_EQ(note->focusPolicy(), Qt::TabFocus) << "not painted yet";
  note->setFocus(Qt::TabFocusReason);
  ASSERT_TRUE(note->hasFocus());
  note->setText(QStringLiteral("Short."));
  EXPECT_EQ(note->focusPolicy(), Qt::NoFocus);
  EXPECT_FALSE(note->hasFocus()) << "Space would do nothing";
  EXPECT_TRUE(next->hasFocus());
  note->setText(all);
  ASSERT_TRUE(note->isCut());
  note->setLines(40);
  EXPECT_EQ(note->focusPolicy(), Qt::NoFocus) << "there is room for all";
}

TEST_F(Notes, TheWholeNoteStaysOnTheScreen) {
  QWidget page;
  auto* note = new LinesNote(2, &page);
  note->setText(QStringLiteral("word ").repeated(200));
  note->setGeometry(10, 10, 240, note->roomFor(2));
  page.resize(260, 60);
  page.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&page));
  const QRect room = page.screen()->availableGeometry();
  page.move(room.bottomRight() - QPoint(260, 60));
  ASSERT_TRUE(waitUntil([&] { return note->mapToGlobal(QPoint()).y() > room.bottom() - 200; }, 5000));
  QTest::mouseClick(note, Qt::LeftButton);
  auto* whole = page.findChild<QFrame*>(QStringLiteral("note.whole"));
  ASSERT_NE(whole, nullptr);
  EXPECT_GT(whole->height(), 200) << "too much for the room below the note";
  EXPECT_TRUE(room.contains(whole->geometry())) << whole->y() << " and " << whole->height() << " high";
  whole->close();
}

TEST_F(Notes, TheStatusLineDoesNotOfferToSelectWhatIsSelected) {
  openPage(test::zigzagPage());
  window_->setStage(PanelStage::Curves);
  session().selectCurve(std::nullopt);
  auto* hint = find<QLabel>("status.hint");
  EXPECT_TRUE(hint->text().contains(QStringLiteral("Click a curve"))) << hint->text().toStdString();
  clickCanvas({300, 200});
  ASSERT_TRUE(session().selectedCurve());
  EXPECT_FALSE(hint->text().startsWith(QStringLiteral("Click"))) << hint->text().toStdString();
}

}  // namespace
}  // namespace batten
