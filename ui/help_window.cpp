// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/help_window.h"

#include <QDesktopServices>
#include <QFile>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QPointer>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextCursor>
#include <QTextDocument>
#include <QUrl>

#include "ui/panels/controls/panel_parts.h"
#include "ui/theme/theme.h"

#include <QPushButton>

namespace batten {

HelpWindow::HelpWindow(QWidget* parent) : QWidget(parent, Qt::Window), browser_(new QTextBrowser(this)) {
  setObjectName(QStringLiteral("helpWindow"));
  setWindowTitle(tr("Help — Batten"));
  resize(640, 720);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(4);
  auto* contents = linkButton(tr("All pages"), QStringLiteral("help.contents"), this);
  connect(contents, &QPushButton::clicked, this, [this] { load(QStringLiteral("index")); });
  layout->addWidget(contents, 0, Qt::AlignLeft);
  browser_->setObjectName(QStringLiteral("help.text"));
  browser_->setOpenLinks(false);
  connect(browser_, &QTextBrowser::anchorClicked, this, [this](const QUrl& url) {
    if (url.scheme().isEmpty())
      load(QFileInfo(url.path()).completeBaseName());
    else
      QDesktopServices::openUrl(url);
  });
  layout->addWidget(browser_, 1);
}

void HelpWindow::open(const QString& page) {
  load(page);
  show();
  raise();
  activateWindow();
}

void HelpWindow::load(const QString& page) {
  QFile file(QStringLiteral(":/help/%1.md").arg(page));
  if (!file.open(QIODevice::ReadOnly)) {
    if (page != QLatin1String("index")) load(QStringLiteral("index"));
    return;
  }
  page_ = page;
  // Made apart from the window: a change of what is shown would lay all of it out anew, paragraph by paragraph.
  auto* text = new QTextDocument(browser_);
  text->setDefaultFont(uiFont(14));
  text->setMarkdown(QString::fromUtf8(file.readAll()));
  // Air between paragraphs and lines; headings a little larger, in the window's own font.
  QTextCursor cursor(text);
  cursor.beginEditBlock();
  for (QTextBlock block = text->begin(); block.isValid(); block = block.next()) {
    QTextBlockFormat format = block.blockFormat();
    const int level = format.headingLevel();
    format.setLineHeight(130, QTextBlockFormat::ProportionalHeight);
    format.setTopMargin(level == 1 ? 4 : level > 1 ? 18 : block.textList() ? 2 : 8);
    format.setBottomMargin(level > 0 ? 4 : 2);
    cursor.setPosition(block.position());
    cursor.setBlockFormat(format);
  }
  cursor.endEditBlock();
  const QPointer<QTextDocument> before = browser_->document();  // the first one goes by itself
  browser_->setDocument(text);
  if (before) before->deleteLater();
  browser_->moveCursor(QTextCursor::Start);
}

void HelpWindow::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && !page_.isEmpty()) load(page_);
}

void HelpWindow::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) return void(close());
  QWidget::keyPressEvent(event);
}

}  // namespace batten
