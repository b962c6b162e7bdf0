// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/command_palette.h"

#include <QAction>
#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QPainter>
#include <QStyledItemDelegate>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>
#include <vector>

#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kWidth = 520;    // px
constexpr int kRow = 30;       // [px] height
constexpr int kMostRows = 10;  // that are seen at once
enum Role { ShortcutRole = Qt::UserRole, EnabledRole, HelpRole };
constexpr const char* kWhyNot = "whyNot";  // property of an action: why it is disabled

class ActionDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override { return {kWidth - 24, kRow}; }
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const Theme& theme = themeOf(option.palette);
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    if (option.state & QStyle::State_Selected) {
      painter->setPen(Qt::NoPen);
      painter->setBrush(theme.selection);
      painter->drawRoundedRect(option.rect, 5, 5);
    }
    const QRect box = option.rect.adjusted(8, 0, -8, 0);
    const bool enabled = index.data(EnabledRole).toBool();
    painter->setFont(uiFont(13));
    painter->setPen(enabled ? theme.text : theme.mute);
    const QString name = index.data().toString();
    painter->drawText(box, Qt::AlignVCenter | Qt::AlignLeft, name);
    const int nameWidth = painter->fontMetrics().horizontalAdvance(name) + 12;
    painter->setFont(uiFont(12));
    painter->setPen(theme.mute);
    const QString keys = index.data(ShortcutRole).toString();
    painter->drawText(box, Qt::AlignVCenter | Qt::AlignRight, keys);
    const int keysWidth = painter->fontMetrics().horizontalAdvance(keys) + 12;
    const QRect middle = box.adjusted(nameWidth, 0, -keysWidth, 0);
    const QString help = index.data(HelpRole).toString();
    if (middle.width() > 40)
      painter->drawText(middle, Qt::AlignVCenter | Qt::AlignLeft,
                        painter->fontMetrics().elidedText(help, Qt::ElideRight, middle.width()));
    painter->restore();
  }
};

}  // namespace

void setWhyNot(QAction& action, const QString& why) { action.setProperty(kWhyNot, why); }

CommandPalette::CommandPalette(QWidget* parent)
    : QFrame(parent), edit_(new QLineEdit(this)), list_(new QListWidget(this)) {
  setObjectName(QStringLiteral("commandPalette"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(6);
  edit_->setObjectName(QStringLiteral("palette.edit"));
  edit_->setAccessibleName(tr("Find an action or setting"));
  edit_->setPlaceholderText(tr("Find an action or setting"));
  edit_->installEventFilter(this);
  list_->setObjectName(QStringLiteral("palette.list"));
  list_->setAccessibleName(tr("Actions found"));
  list_->setItemDelegate(new ActionDelegate(list_));
  list_->setFocusPolicy(Qt::NoFocus);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  layout->addWidget(edit_);
  layout->addWidget(list_);
  connect(edit_, &QLineEdit::textChanged, this, &CommandPalette::refresh);
  connect(edit_, &QLineEdit::returnPressed, this, &CommandPalette::runCurrent);
  connect(list_, &QListWidget::itemClicked, this, &CommandPalette::runCurrent);
  hide();
}

void CommandPalette::open(const QList<QAction*>& actions) {
  actions_ = actions;
  edit_->clear();
  refresh();
  const int width = std::min(kWidth, parentWidget()->width() - 32);
  setGeometry((parentWidget()->width() - width) / 2, 52, width, height());
  show();
  raise();
  edit_->setFocus();
}

int CommandPalette::score(const QString& letters, const QString& text) {
  int points = 1, from = 0;
  for (const QChar letter : letters) {
    if (letter.isSpace()) continue;
    const auto next = static_cast<int>(text.indexOf(letter, from, Qt::CaseInsensitive));
    if (next < 0) return 0;
    const bool wordStart = next == 0 || !text.at(next - 1).isLetterOrNumber();
    points += wordStart ? 8 : next == from ? 4 : 1;
    from = next + 1;
  }
  // The word itself, before words that merely hold its letters.
  if (text.contains(letters, Qt::CaseInsensitive)) points += 8;
  return points;
}

void CommandPalette::refresh() {
  const QString letters = edit_->text().trimmed();
  std::vector<std::pair<int, QAction*>> ranked;
  for (QAction* action : actions_) {
    // A hit in the name counts for more than one in the help.
    const int name = score(letters, action->text().remove(QLatin1Char('&')));
    const int help = action->statusTip().contains(letters, Qt::CaseInsensitive) ? 1 : 0;
    if (name > 0 || help > 0) ranked.emplace_back(2 * name + help, action);
  }
  if (!letters.isEmpty())
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  list_->clear();
  shown_.clear();
  for (const auto& [points, action] : ranked) {
    auto* item = new QListWidgetItem(action->text().remove(QLatin1Char('&')), list_);
    item->setData(ShortcutRole, action->shortcut().toString(QKeySequence::NativeText));
    item->setData(EnabledRole, action->isEnabled());
    const QString whyNot = action->property(kWhyNot).toString();
    const QString help = action->isEnabled() ? action->statusTip()
                         : whyNot.isEmpty()  ? tr("Not available now.")
                                             : whyNot;
    item->setData(HelpRole, help);
    item->setData(Qt::AccessibleTextRole, item->text() + QStringLiteral(". ") + help);
    if (!action->isEnabled()) item->setToolTip(help);
    shown_.append(action);
  }
  list_->setCurrentRow(0);
  // As high as what was found, so that little of the drawing is covered.
  const int rows = std::clamp(list_->count(), 1, kMostRows);
  list_->setFixedHeight(rows * kRow + 2);
  resize(width(), edit_->sizeHint().height() + rows * kRow + 26);
}

void CommandPalette::runCurrent() {
  const int row = list_->currentRow();
  if (row < 0 || row >= shown_.size() || !shown_[row]->isEnabled()) return;
  QAction* action = shown_[row];
  hide();
  parentWidget()->setFocus();
  action->trigger();
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (watched == edit_ && event->type() == QEvent::ShortcutOverride) {
    // Keys typed here belong to the finder alone, Escape too.
    event->accept();
    return true;
  }
  if (watched == edit_ && event->type() == QEvent::FocusOut && !underMouse()) hide();
  if (watched == edit_ && event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    const int step = key == Qt::Key_Down       ? 1
                     : key == Qt::Key_Up       ? -1
                     : key == Qt::Key_PageDown ? 9
                     : key == Qt::Key_PageUp   ? -9
                                               : 0;
    if (step != 0) {
      list_->setCurrentRow(std::clamp(list_->currentRow() + step, 0, std::max(0, list_->count() - 1)));
      return true;
    }
    if (key == Qt::Key_Escape) {
      hide();
      parentWidget()->setFocus();
      return true;
    }
  }
  return QFrame::eventFilter(watched, event);
}

void CommandPalette::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(theme.line, 1));
  painter.setBrush(theme.panel);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 8, 8);
}

}  // namespace batten
