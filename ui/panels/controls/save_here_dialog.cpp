// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/save_here_dialog.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>
#include <filesystem>
#include <system_error>

#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/save_dialog.h"
#include "ui/session/files/path_text.h"

namespace batten {

namespace {
constexpr int kWidth = 420;  // [px] a name and its suffix in one line
}

SaveHereDialog::SaveHereDialog(const SaveQuestion& question, QWidget* parent)
    : QDialog(parent),
      folder_(folderOf(question.start)),
      suffix_(question.suffix),
      name_(new QLineEdit(this)),
      message_(note({}, this)),
      save_(plainButton(tr("Save"), QStringLiteral("saveHere.save"), this)) {
  setObjectName(QStringLiteral("saveHere"));
  setWindowTitle(question.title);
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(20, 16, 20, 16);
  rows->setSpacing(8);
  auto* about = note(isUnicodePath(folder_)
                         ? tr("The name proposed is not valid UTF-8, so that the file dialog cannot show it.")
                         : tr("The name of this folder is not valid UTF-8, so that the file dialog cannot enter it."),
                     this);
  rows->addWidget(about);
  rows->addWidget(caption(tr("Folder"), this));
  auto* folder = new QLabel(shownPath(folder_), this);
  folder->setObjectName(QStringLiteral("saveHere.folder"));
  folder->setTextFormat(Qt::PlainText);
  folder->setWordWrap(true);
  rows->addWidget(folder);
  rows->addWidget(caption(tr("File name"), this));
  name_->setObjectName(QStringLiteral("saveHere.name"));
  name_->setAccessibleName(tr("File name"));
  name_->setText(pathText(nativePath(question.start).filename()));
  rows->addWidget(name_);
  message_->setObjectName(QStringLiteral("saveHere.message"));
  message_->setFixedWidth(kWidth);
  rows->addWidget(message_);
  addButtons();
  connect(name_, &QLineEdit::textChanged, this, &SaveHereDialog::follow);
  follow();
  name_->setFocus();
}

void SaveHereDialog::addButtons() {
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  auto* elsewhere = plainButton(tr("Choose another folder…"), QStringLiteral("saveHere.elsewhere"), this);
  auto* cancel = plainButton(tr("Cancel"), QStringLiteral("saveHere.cancel"), this);
  save_->setProperty("primary", true);
  save_->setDefault(true);
  for (QPushButton* button : {elsewhere, cancel}) button->setAutoDefault(false);
  buttons->addWidget(elsewhere);
  buttons->addStretch();
  buttons->addWidget(cancel);
  buttons->addWidget(save_);
  static_cast<QVBoxLayout*>(layout())->addLayout(buttons);
  connect(elsewhere, &QPushButton::clicked, this, [this] { done(kElsewhere); });
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  connect(save_, &QPushButton::clicked, this, &SaveHereDialog::save);
}

QString SaveHereDialog::path() const {
  return withSuffix(pathText(nativePath(folder_) / nativePath(name_->text().trimmed())), suffix_);
}

QString SaveHereDialog::obstacle() const {
  const QString typed = name_->text().trimmed();
  const std::filesystem::path name = nativePath(typed);
  if (name.filename() != name || name == "." || name == "..") return tr("Type a file name without a folder.");
  if (pathText(name) != typed || typed.contains(QChar(QChar::Null)))
    return tr("This name contains characters that no file name can hold. Type another one.");
  std::error_code failed;
  if (std::filesystem::is_directory(nativePath(path()), failed))
    return tr("%1 is a folder. Type another name.").arg(shownFileName(path()));
  return {};
}

void SaveHereDialog::follow() {
  const QString text = obstacle();
  ask(text, false);
  save_->setEnabled(text.isEmpty() && !name_->text().trimmed().isEmpty());
}

void SaveHereDialog::save() {
  if (confirmReplace_ || !pathExists(path())) return accept();
  ask(tr("%1 exists. Press again to replace it.").arg(shownFileName(path())), true);
}

void SaveHereDialog::ask(const QString& text, bool replaces) {
  confirmReplace_ = replaces;
  message_->setText(text);
  save_->setText(replaces ? tr("Replace the file") : tr("Save"));
  save_->setAccessibleName(save_->text());
}

}  // namespace batten
