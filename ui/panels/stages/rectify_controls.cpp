// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/rectify_controls.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "ui/panels/controls/panel_parts.h"
#include "ui/session/edits/rectify_edits.h"

namespace batten {

RectifyControls::RectifyControls(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent),
      session_(session),
      view_(view),
      note_(note({}, this)),
      rectify_(plainButton(tr("Rectify"), QStringLiteral("scan.rectify"), this)),
      corners_(plainButton(tr("Corners of the sheet"), QStringLiteral("scan.sheetCorners"), this)),
      whole_(linkButton(tr("Whole picture"), QStringLiteral("scan.wholePicture"), this)),
      format_(new QComboBox(this)) {
  build();
  connect(rectify_, &QPushButton::clicked, this, &RectifyControls::rectify);
  connect(corners_, &QPushButton::clicked, this, &RectifyControls::toggleTool);
  connect(whole_, &QPushButton::clicked, this, [this] { stopRectifying(session_); });
  connect(format_, qOverload<int>(&QComboBox::activated), this, [this](int index) {
    say(setSheetFormat(session_, index < 1 ? PaperFormat::Unknown : paperSizes()[index - 1].format));
  });
  connect(&view_, &ViewSettings::rectifyRequested, this, &RectifyControls::rectify);
  connect(&view_, &ViewSettings::toolChanged, this, [this] {
    view_.setSheetCorners(std::nullopt);
    refresh();
  });
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::pageChanged})
    connect(&session_, signal, this, [this] {
      view_.setSheetCorners(std::nullopt);
      refresh();
    });
  connect(&session_, &EditorSession::recipeChanged, this, &RectifyControls::refresh);
  connect(&session_, &EditorSession::stageReady, this, &RectifyControls::refresh);
  refresh();
}

void RectifyControls::build() {
  setObjectName(QStringLiteral("paper.rectify.row"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  note_->setObjectName(QStringLiteral("scan.rectifyNote"));
  column->addWidget(note_);
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  rectify_->setToolTip(tr("Makes the sheet a rectangle again. All marks stay on their ink."));
  corners_->setToolTip(tr("Shows the corners of the sheet on the drawing; drag them, then press Rectify."));
  corners_->setCheckable(true);
  row->addWidget(corners_);
  row->addWidget(rectify_);
  row->addStretch();
  column->addLayout(row);
  whole_->setToolTip(tr("Shows the picture as it was taken."));
  column->addWidget(whole_, 0, Qt::AlignLeft);
  formatRow_ = new QWidget(this);
  formatRow_->setObjectName(QStringLiteral("paper.format.row"));
  auto* format = new QHBoxLayout(formatRow_);
  format->setContentsMargins(0, 0, 0, 0);
  const QString help =
      tr("Format of the sheet: sets its aspect ratio and resolution. Otherwise the aspect ratio is "
         "estimated from the perspective.");
  auto* name = new QLabel(tr("Sheet"), formatRow_);
  name->setToolTip(help);
  format_->setToolTip(help);
  format_->setObjectName(QStringLiteral("paper.format"));
  format_->setAccessibleName(tr("Format of the sheet"));
  format_->addItem(tr("Estimated"));
  for (const PaperSize& paper : paperSizes())
    format_->addItem(QString::fromLatin1(paper.name.data(), static_cast<qsizetype>(paper.name.size())));
  format->addWidget(name);
  format->addStretch();
  format->addWidget(format_);
  column->addWidget(formatRow_);
}

void RectifyControls::toggleTool(bool on) {
  view_.setTool(on ? Tool::Sheet : Tool::Select);
  refresh();
}

void RectifyControls::rectify() {
  if (!session_.hasScan()) return;
  const auto moved = view_.sheetCorners();
  const auto corners = moved ? moved : knownSheetCorners(session_);
  const bool isDoneAlready = !moved && session_.scan()->rectification.has_value();
  if (!corners) {
    say(fail(ErrorCode::BadParameter, "Drag the corners onto those of the sheet first."));
    return;
  }
  const auto done = isDoneAlready ? Result<void>() : rectifyBy(session_, *corners);
  say(done);
  if (done && view_.tool() == Tool::Sheet) view_.setTool(Tool::Select);
}

void RectifyControls::say(const Result<void>& done) {
  refresh();
  if (done) return;
  note_->setText(QString::fromStdString(done.error().message));
  note_->show();
}

QString RectifyControls::state() const {
  constexpr double kDoubtfulAspect = 0.01;  // share above which the uncertainty is shown
  if (!session_.hasScan()) return {};
  const auto& page = session_.output().page;
  if (const auto& made = session_.scan()->rectification) {
    QString text = tr("Rectified from the corners of the sheet; %1 % of the picture was cut off.")
                       .arg(100.0 * made->outsideShare, 0, 'f', 0);
    if (page && page->sheet)
      text +=
          tr(" A rim of %1 px along its border was cut off, too.").arg(page->sheet->outlinePx.front().x(), 0, 'f', 0);
    if (made->aspectError > kDoubtfulAspect)
      text += tr(" The aspect ratio is uncertain by %1 %: choose the sheet if you know it.")
                  .arg(100.0 * made->aspectError, 0, 'f', 1);
    return text;
  }
  if (!session_.scan()->rectifyNote.empty()) return QString::fromStdString(session_.scan()->rectifyNote);
  if (page && page->view)
    return tr("The sheet was photographed at an angle: %1.").arg(QString::fromStdString(page->view->text()));
  return {};
}

void RectifyControls::refresh() {
  const bool has = session_.hasScan() && !session_.isBlankPage();
  const bool isRectified = has && session_.scan()->rectification.has_value();
  const auto& page = session_.output().page;
  const bool isTool = view_.tool() == Tool::Sheet;
  const QString text = state();
  note_->setText(text);
  note_->setVisible(!text.isEmpty());
  corners_->setEnabled(has);
  corners_->setChecked(isTool);
  rectify_->setVisible(has && (isTool || (!isRectified && page && page->view)));
  whole_->setVisible(isRectified);
  formatRow_->setVisible(isRectified);
  const QSignalBlocker blocker(format_);
  const auto sizes = paperSizes();
  const auto known = std::ranges::find(sizes, session_.recipe().preparation.rectify.format, &PaperSize::format);
  format_->setCurrentIndex(known == sizes.end() ? 0 : static_cast<int>(known - sizes.begin()) + 1);
}

}  // namespace batten
