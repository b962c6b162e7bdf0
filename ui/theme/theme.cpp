// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/theme/theme.h"

#include <QApplication>
#include <QFile>
#include <QFontDatabase>
#include <QPainter>
#include <QPixmap>
#include <QPixmapCache>
#include <QStyle>
#include <QStyleFactory>
#include <optional>

#include "ui/theme/tool_tips.h"

namespace batten {
namespace {

QString familyName() {
  static const QString family = [] {
    const QStringList known = QFontDatabase::families();
    for (const char* wanted : {"Inter", "Cantarell", "Noto Sans", "Segoe UI", "Liberation Sans", "DejaVu Sans"}) {
      const QString name = QString::fromLatin1(wanted);
      if (known.contains(name)) return name;
    }
    return QApplication::font().family();
  }();
  return family;
}

QPalette paletteOf(const Theme& t) {
  QPalette p;
  p.setColor(QPalette::Window, t.panel);
  p.setColor(QPalette::WindowText, t.text);
  p.setColor(QPalette::Base, t.panel);
  p.setColor(QPalette::AlternateBase, t.background);
  p.setColor(QPalette::Text, t.text);
  p.setColor(QPalette::Button, t.panel);
  p.setColor(QPalette::ButtonText, t.text);
  p.setColor(QPalette::BrightText, t.bad);
  p.setColor(QPalette::PlaceholderText, t.mute);
  p.setColor(QPalette::Highlight, t.accent);
  p.setColor(QPalette::HighlightedText, t.onAccent);
  p.setColor(QPalette::Link, t.accent);
  p.setColor(QPalette::Mid, t.line);
  p.setColor(QPalette::Midlight, t.hover);
  p.setColor(QPalette::Light, t.panel);
  p.setColor(QPalette::Dark, t.line);
  p.setColor(QPalette::Shadow, t.line);
  p.setColor(QPalette::ToolTipBase, t.panel);
  p.setColor(QPalette::ToolTipText, t.text);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    p.setColor(QPalette::Disabled, role, t.mute);
  return p;
}

QString sheetOf(const Theme& t) {
  QFile file(QStringLiteral(":/theme/style.qss"));
  QString sheet;
  if (file.open(QIODevice::ReadOnly)) sheet = QString::fromUtf8(file.readAll());
  const std::pair<const char*, QColor> names[] = {{"@background", t.background},
                                                  {"@panel", t.panel},
                                                  {"@line", t.line},
                                                  {"@text", t.text},
                                                  {"@mute", t.mute},
                                                  {"@accent", t.accent},
                                                  {"@on-accent", t.onAccent},
                                                  {"@selection", t.selection},
                                                  {"@hover", t.hover},
                                                  {"@good", t.good},
                                                  {"@amber", t.amber},
                                                  {"@bad", t.bad}};
  for (const auto& [name, color] : names)
    sheet.replace(QString::fromLatin1(name) + QLatin1Char(';'), color.name() + QLatin1Char(';'));
  return sheet;
}

}  // namespace

const Theme& lightTheme() {
  static const Theme theme{
      false,     "#f4f4f2", "#ffffff", "#dcdcd8", "#1d1f21", "#6b6f74", "#0b6bcb",
      "#ffffff", "#e6f0fa", "#f0f0ed", "#1a7f4b", "#9c5a00", "#c0321c", {"#990044", "#aa66aa", "#669944"}};
  return theme;
}

const Theme& darkTheme() {
  static const Theme theme{
      true,      "#1e1f21", "#27292c", "#3a3d41", "#e6e7e8", "#989ca1", "#5aa9f5",
      "#10202f", "#24384c", "#303338", "#58c48b", "#e5a33c", "#f0776a", {"#cc6633", "#9966bb", "#aaeecc"}};
  return theme;
}

const Theme& themeOf(const QPalette& palette) {
  return palette.color(QPalette::Window).lightness() < 128 ? darkTheme() : lightTheme();
}

void applyTheme(ThemeChoice choice) {
  static const bool systemIsDark = QApplication::palette().color(QPalette::Window).lightness() < 128;
  static std::optional<bool> isDarkNow;
  const bool dark = choice == ThemeChoice::Dark || (choice == ThemeChoice::System && systemIsDark);
  if (isDarkNow == dark) return;  // or every widget would be styled anew
  isDarkNow = dark;
  const Theme& theme = dark ? darkTheme() : lightTheme();
  if (QApplication::style()->name().compare(QLatin1String("fusion"), Qt::CaseInsensitive) != 0 ||
      qApp->styleSheet().isEmpty())
    QApplication::setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  static const auto* const tips = [] {
    auto* lines = new ToolTipLines(qApp);
    qApp->installEventFilter(lines);
    return lines;
  }();
  Q_UNUSED(tips);
  QApplication::setFont(uiFont());
  QApplication::setPalette(paletteOf(theme));
  qApp->setStyleSheet(sheetOf(theme));
}

QFont uiFont(int pixelSize, QFont::Weight weight) {
  QFont font(familyName());
  font.setPixelSize(pixelSize);
  font.setWeight(weight);
  return font;
}

QIcon themedIcon(const QString& name, const QPalette& palette) {
  const Theme& theme = themeOf(palette);
  std::optional<QIcon> source;
  QIcon icon;
  for (const auto& [mode, color] : {std::pair{QIcon::Normal, theme.text}, std::pair{QIcon::Disabled, theme.line}}) {
    for (const int size : {16, 32, 48}) {
      // Lists ask for the icons of their rows whenever they paint.
      const QString key = QStringLiteral("batten-icon %1 %2 %3 %4")
                              .arg(name, color.name(QColor::HexArgb))
                              .arg(size)
                              .arg(qApp->devicePixelRatio());
      QPixmap pixmap;
      if (!QPixmapCache::find(key, &pixmap)) {
        if (!source) source = QIcon(QStringLiteral(":/icons/") + name + QStringLiteral(".svg"));
        pixmap = source->pixmap(size, size);
        if (pixmap.isNull()) continue;
        QPainter painter(&pixmap);
        painter.setCompositionMode(QPainter::CompositionMode_SourceIn);
        painter.fillRect(pixmap.rect(), color);
        painter.end();
        QPixmapCache::insert(key, pixmap);
      }
      icon.addPixmap(pixmap, mode);
    }
  }
  return icon;
}

void drawFocusRing(QPainter& painter, const QRectF& rect, double radius, const Theme& theme) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(theme.accent, 1.5));
  painter.drawRoundedRect(rect.adjusted(0.75, 0.75, -0.75, -0.75), radius, radius);
  painter.restore();
}

}  // namespace batten
