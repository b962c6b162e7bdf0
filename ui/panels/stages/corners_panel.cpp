// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/corners_panel.h"

#include <QCoreApplication>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QShortcut>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/angle.h"
#include "core/contour/corner/corner_suggestions.h"
#include "ui/panels/controls/column_delegate.h"
#include "ui/panels/controls/hint_list.h"
#include "ui/panels/controls/lines_note.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/parameter_editor.h"
#include "ui/panels/controls/stage_panel.h"
#include "ui/panels/stages/corner_rounding.h"
#include "ui/panels/stages/suggestion_sliders.h"
#include "ui/session/suggestion_source.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kRows = 6;        // of the lists
constexpr int kFoundLines = 3;  // beside the link

QString across(const Vec2& px) { return QString::number(px.x(), 'f', 1); }
QString down(const Vec2& px) { return QCoreApplication::translate("CornersPanel", "%1 px").arg(px.y(), 0, 'f', 1); }

/// Parts of the row in columns of their own.
QListWidgetItem* addRow(QListWidget* list, const QStringList& parts) {
  auto* item = new QListWidgetItem(ColumnDelegate::joined(parts), list);
  item->setData(Qt::AccessibleTextRole, ColumnDelegate::spoken(parts));
  item->setFont(uiFont(12));
  return item;
}

/// "rounded 2 mm", "rounded R 2 mm"; empty for a sharp corner.
QString roundingOf(const CornerMark& mark) {
  if (!(mark.roundMm > 0.0)) return {};
  const QString mm = shortMillimetres(mark.roundMm);
  return mark.roundBy == RoundingSize::Radius ? QCoreApplication::translate("CornersPanel", "rounded R %1").arg(mm)
                                              : QCoreApplication::translate("CornersPanel", "rounded %1").arg(mm);
}

QString degrees(double rad) { return QStringLiteral("%1°").arg(std::abs(rad) * kDegPerRad, 0, 'f', 0); }

}  // namespace

CornersPanel::CornersPanel(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent),
      session_(session),
      view_(view),
      marks_(new HintList(tr("No corner is marked yet."), kRows, this)),
      found_(new LinesNote(kFoundLines, this)),
      restore_(linkButton(tr("Restore all"), QStringLiteral("corners.restore"), this)),
      close_(note({}, this)),
      remove_(linkButton(tr("Remove"), QStringLiteral("corners.remove"), this)),
      removeAll_(linkButton(tr("Remove all"), QStringLiteral("corners.removeAll"), this)),
      rounding_(new CornerRounding(this)),
      suggested_(new HintList({}, kRows, this)),
      suggestedNote_(note({}, this)),
      take_(linkButton(tr("Mark"), QStringLiteral("corners.take"), this)),
      takeAll_(linkButton(tr("Mark all"), QStringLiteral("corners.takeAll"), this)) {
  auto* column = panelColumn(this, tr("Corners"));
  column->addWidget(note(tr("Click a sharp corner of a line to mark it; click a mark to select it, and again to "
                            "remove it."),
                         this));
  column->addWidget(new ParameterEditor(session, {"corners.auto", "corners.exact", "corners.snap"}, this));
  buildFound();
  buildMarks();
  buildSuggestions();
  close_->setObjectName(QStringLiteral("corners.close"));
  column->addWidget(close_);
  column->addStretch();
  followSession();
  refresh();
}

QVBoxLayout* CornersPanel::column() const { return static_cast<QVBoxLayout*>(layout()); }

void CornersPanel::buildFound() {
  found_->setObjectName(QStringLiteral("corners.found"));
  auto* row = new QHBoxLayout;
  row->addWidget(found_, 1);
  row->addWidget(restore_, 0, Qt::AlignTop);
  column()->addLayout(row);
  connect(restore_, &QPushButton::clicked, this, [this] {
    Recipe after = session_.recipe();
    after.refusedCornersPx.clear();
    session_.change(tr("Restore corners"), std::move(after));
  });
}

void CornersPanel::buildMarks() {
  // Links stand above what grows.
  column()->addLayout(captionRow(tr("Marked"), {remove_, removeAll_}, this));
  column()->addWidget(rounding_);
  marks_->setObjectName(QStringLiteral("corners.list"));
  marks_->setAccessibleName(tr("Marked corners"));
  markColumns_ =
      new ColumnDelegate({Qt::AlignRight, Qt::AlignRight, Qt::AlignRight, Qt::AlignRight, Qt::AlignLeft}, *marks_);
  marks_->setItemDelegate(markColumns_);
  column()->addWidget(marks_);
  auto* del = new QShortcut(QKeySequence(Qt::Key_Delete), marks_, nullptr, nullptr, Qt::WidgetShortcut);
  connect(del, &QShortcut::activated, this, &CornersPanel::removeSelected);
  remove_->setToolTip(tr("Removes the mark that is selected in the list or on the drawing."));
  removeAll_->setToolTip(tr("Removes all marks; certain corners stay."));
  connect(remove_, &QPushButton::clicked, this, &CornersPanel::removeSelected);
  connect(removeAll_, &QPushButton::clicked, this, &CornersPanel::removeAll);
  connect(rounding_, &CornerRounding::changed, this, &CornersPanel::editSelected);
  connect(marks_, &QListWidget::currentRowChanged, this, [this](int row) {
    if (!filling_) session_.selectCorner(row < 0 ? std::nullopt : std::optional(row));
  });
}

void CornersPanel::followSession() {
  connect(&session_, &EditorSession::cornerSelectionChanged, this, &CornersPanel::showSelected);
  connect(&session_.suggestions(), &SuggestionSource::changed, this, &CornersPanel::showSuggestions);
  connect(&session_, &EditorSession::scanOpened, this, &CornersPanel::refresh);
  connect(&session_, &EditorSession::recipeChanged, this, &CornersPanel::refresh);
  connect(&session_, &EditorSession::stageReady, this, [this](StageId stage) {
    if (stage == StageId::Pieces) refreshMarks();
    if (stage == StageId::Contours) suggest();
  });
}

void CornersPanel::buildSuggestions() {
  column()->addLayout(captionRow(tr("Suggestions"), {take_, takeAll_}, this));
  column()->addWidget(new SuggestionSliders(session_, view_, this));
  column()->addWidget(suggestedNote_);
  suggestedNote_->setMinimumHeight(2 * suggestedNote_->fontMetrics().lineSpacing());
  suggestedNote_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  suggested_->setObjectName(QStringLiteral("corners.suggestions"));
  suggested_->setAccessibleName(tr("Suggested corners"));
  suggestedColumns_ = new ColumnDelegate({Qt::AlignRight, Qt::AlignRight, Qt::AlignRight}, *suggested_);
  suggested_->setItemDelegate(suggestedColumns_);
  suggested_->useRoomBelow();
  column()->addWidget(suggested_, 1);
  connect(&view_, &ViewSettings::changed, this, &CornersPanel::suggest);
  take_->setToolTip(tr("Marks the suggested corner that is selected in the list."));
  takeAll_->setToolTip(tr("Marks all suggested corners."));
  connect(take_, &QPushButton::clicked, this, [this] {
    const int at = suggested_->currentRow();
    if (at >= 0 && at < std::ssize(suggestions_)) mark({suggestions_[at].positionPx});
  });
  connect(suggested_, &QListWidget::itemActivated, take_, &QPushButton::click);
  connect(takeAll_, &QPushButton::clicked, this, [this] {
    std::vector<Vec2> all;
    for (const auto& suggestion : suggestions_) all.push_back(suggestion.positionPx);
    mark(all);
  });
  connect(suggested_, &QListWidget::currentRowChanged, this, [this](int current) { take_->setEnabled(current >= 0); });
  suggest();
}

void CornersPanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  // Marks without a line hold the colour of the theme they were listed in.
  if (event->type() == QEvent::PaletteChange) refreshMarks();
}

void CornersPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  suggest();
}

void CornersPanel::refresh() {
  refreshMarks();
  suggest();
}

void CornersPanel::refreshMarks() {
  const Theme& theme = themeOf(palette());
  const auto& marks = session_.recipe().cornerMarks;
  const auto& pieces = session_.output().pieces;
  filling_ = true;
  marks_->clear();
  for (std::size_t i = 0; i < marks.size(); ++i) {
    QString angle;
    bool lost = false;
    std::optional<int> same;
    if (pieces) {
      const auto corner = std::find_if(pieces->corners.begin(), pieces->corners.end(),
                                       [&](const Corner& c) { return c.mark == static_cast<int>(i); });
      if (corner != pieces->corners.end()) angle = degrees(corner->turningAngleRad);
      for (const MarkPair& pair : pieces->sameCorner)
        if (pair.mark == static_cast<int>(i)) same = pair.other;
      lost =
          std::find(pieces->lostMarks.begin(), pieces->lostMarks.end(), static_cast<int>(i)) != pieces->lostMarks.end();
    }
    const QString more = lost   ? tr("no line here")
                         : same ? tr("same corner as %1").arg(*same + 1)
                                : roundingOf(marks[i]);
    const Vec2& at = marks[i].positionPx;
    auto* item = addRow(marks_, {QString::number(i + 1), across(at), down(at), lost || same ? QString() : angle, more});
    if (lost) item->setForeground(theme.bad);
    item->setToolTip(same ? tr("Both marks snap to the same corner. Remove one, or reduce the corner reach if you mean "
                               "two corners.")
                     : lost
                         ? tr("No line within reach of this mark. It applies again when the line returns; remove it if "
                              "it is not needed.")
                         : tr("Position of the mark and turning angle of the line there."));
  }
  QStringList close;
  for (const MarkPair& pair : pieces ? pieces->closeCorners : std::vector<MarkPair>{})
    close += tr("Corners %1 and %2 are only %3 px apart: remove one of them.")
                 .arg(pair.other + 1)
                 .arg(pair.mark + 1)
                 .arg(pair.apartPx, 0, 'f', 0);
  showFound();
  close_->setText(close.join(QLatin1Char('\n')));
  close_->setVisible(!close.empty());
  markColumns_->measure();
  filling_ = false;
  removeAll_->setEnabled(!marks.empty());
  showSelected();
  showSuggestions();
}

void CornersPanel::showFound() {
  const auto& pieces = session_.output().pieces;
  const Recipe& recipe = session_.recipe();
  const auto& refused = recipe.refusedCornersPx;
  const int found = pieces ? unmarkedCornerCount(*pieces) : 0;
  QStringList lines;
  if (recipe.corners.automatic && pieces)
    lines += found == 0 ? recipe.cornerMarks.empty() ? tr("No certain corner was found.")
                                                     : tr("No certain corner besides the marked ones.")
                        : counted(found, tr("1 certain corner was found (diamond). Click it to exclude it."),
                                  tr("%1 certain corners were found (diamonds). Click one to exclude it."));
  // A mark wins over an excluded corner within its reach.
  const auto excluded = std::count_if(refused.begin(), refused.end(), [&](const Vec2& place) {
    return std::none_of(recipe.cornerMarks.begin(), recipe.cornerMarks.end(), [&](const CornerMark& mark) {
      return (mark.positionPx - place).norm() <= recipe.corners.snapDistancePx;
    });
  });
  if (excluded > 0) lines += counted(excluded, tr("1 is excluded."), tr("%1 are excluded."));
  found_->setText(lines.join(QLatin1Char(' ')));
  restore_->setEnabled(!refused.empty());
  restore_->setToolTip(refused.empty() ? tr("No certain corner is excluded.")
                                       : tr("Certain corners that were excluded count again."));
}

bool CornersPanel::isFound(const Vec2& positionPx) const {
  const auto& pieces = session_.output().pieces;
  const double reach = session_.recipe().corners.snapDistancePx;
  return pieces && std::any_of(pieces->corners.begin(), pieces->corners.end(), [&](const Corner& corner) {
           return !corner.mark && (corner.positionPx - positionPx).norm() <= reach;
         });
}

void CornersPanel::showSelected() {
  filling_ = true;
  marks_->setCurrentRow(session_.selectedCorner().value_or(-1));  // -1: none, as Qt counts
  filling_ = false;
  remove_->setEnabled(marks_->currentRow() >= 0);
  const int row = marks_->currentRow();
  const auto& marks = session_.recipe().cornerMarks;
  rounding_->showMark(row >= 0 && row < std::ssize(marks) ? std::optional(marks[row]) : std::nullopt);
}

void CornersPanel::suggest() {
  if (isVisible() || !session_.output().contours)
    session_.suggestions().look(view_.suggestionAngleDeg(), view_.suggestionScalePx());
}

bool CornersPanel::isMarked(const Vec2& positionPx) const {
  const double reach = session_.recipe().corners.snapDistancePx;
  const auto& marks = session_.recipe().cornerMarks;
  return std::any_of(marks.begin(), marks.end(),
                     [&](const CornerMark& mark) { return (mark.positionPx - positionPx).norm() <= reach; });
}

void CornersPanel::showSuggestions() {
  suggestions_ = session_.suggestions().found();
  std::erase_if(suggestions_,
                [this](const CornerSuggestion& s) { return isMarked(s.positionPx) || isFound(s.positionPx); });
  suggested_->clear();
  for (const auto& suggestion : suggestions_) {
    const Vec2& at = suggestion.positionPx;
    addRow(suggested_, {across(at), down(at), degrees(suggestion.turningAngleRad)});
  }
  suggestedColumns_->measure();
  suggestedNote_->setText(suggestions_.empty()
                              ? tr("No further candidate above this angle.")
                              : counted(static_cast<qint64>(suggestions_.size()),
                                        tr("1 possible corner. It is used only if you mark it."),
                                        tr("%1 possible corners. They are used only if you mark them.")));
  take_->setEnabled(suggested_->currentRow() >= 0);
  takeAll_->setEnabled(!suggestions_.empty());
}

void CornersPanel::mark(const std::vector<Vec2>& positions) {
  Recipe after = session_.recipe();
  for (const Vec2& position : positions) after.cornerMarks.push_back({position});
  session_.change(positions.size() == 1 ? tr("Mark corner") : tr("Mark suggested corners"), std::move(after));
}

void CornersPanel::editSelected(const QString& what, const std::function<void(CornerMark&)>& change) {
  const int row = marks_->currentRow();
  Recipe after = session_.recipe();
  if (row < 0 || row >= std::ssize(after.cornerMarks)) return;
  change(after.cornerMarks[row]);
  session_.change(what, std::move(after));
}

void CornersPanel::removeSelected() {
  const int row = marks_->currentRow();
  Recipe after = session_.recipe();
  if (row < 0 || row >= std::ssize(after.cornerMarks)) return;
  after.cornerMarks.erase(after.cornerMarks.begin() + row);
  session_.change(tr("Remove corner"), std::move(after));
}

void CornersPanel::removeAll() {
  Recipe after = session_.recipe();
  after.cornerMarks.clear();
  session_.change(tr("Remove all corners"), std::move(after));
}

}  // namespace batten
