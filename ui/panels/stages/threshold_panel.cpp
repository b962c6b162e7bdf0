// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/threshold_panel.h"

#include <QCheckBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/conventions.h"
#include "core/image/threshold/region_thresholds.h"
#include "core/image/threshold/region_values.h"
#include "ui/panels/controls/number_field.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/parameter_editor.h"
#include "ui/panels/controls/parameter_row.h"
#include "ui/panels/controls/region_histogram.h"
#include "ui/panels/controls/stage_panel.h"
#include "ui/theme/theme.h"

namespace batten {

ThresholdPanel::ThresholdPanel(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent),
      session_(session),
      view_(view),
      scale_(session, view),
      editor_(new ParameterEditor(
          session,
          {"threshold.mode", "threshold.level", "threshold.strength", "threshold.reach", "threshold.speck_area",
           "threshold.hole_area", "threshold.interpolate", "threshold.smooth"},
          this)),
      regionName_(caption(tr("Region"), this)),
      histogram_(new RegionHistogram(this)),
      level_(new NumberField(this)),
      regionAuto_(plainButton(tr("Automatic here"), QStringLiteral("threshold.autoRegion"), this)),
      allAuto_(plainButton(tr("All automatic"), QStringLiteral("threshold.autoAll"), this)),
      table_(new QTableWidget(kRegionsPerSide, kRegionsPerSide, this)),
      showRegions_(new QCheckBox(tr("Show the regions on the picture"), this)),
      note_(note({}, this)) {
  auto* layout = panelColumn(this, tr("Threshold"));
  layout->addWidget(editor_);
  layout->addWidget(note_);
  // The panel's title says it already.
  editor_->row("threshold.mode")->setLabel({});
  buildRegion();
  layout->addStretch();
  connect(&session_, &EditorSession::scanOpened, this, &ThresholdPanel::refresh);
  connect(&session_, &EditorSession::recipeChanged, this, &ThresholdPanel::refresh);
  connect(&session_, &EditorSession::stageReady, this, [this](StageId stage) {
    if (stage == StageId::Thresholds) refresh();
  });
  connect(&view_, &ViewSettings::selectedRegionChanged, this, [this] {
    refreshRegion();
    refreshTable();
  });
  connect(&view_, &ViewSettings::changed, this, [this] {
    showRegions_->setChecked(view_.isVisible(Layer::Regions));
    if (scale_ == GreyScale(session_, view_)) return;
    refreshRegion();
    refreshTable();
  });
  refresh();
}

void ThresholdPanel::buildRegion() {
  auto* layout = static_cast<QVBoxLayout*>(this->layout());
  level_->setRange(0, 255);
  level_->setDecimals(0);
  level_->setStep(1);
  level_->setFixedWidth(76);
  level_->edit()->setObjectName(QStringLiteral("threshold.regionLevel"));
  level_->edit()->setAccessibleName(tr("Threshold of the selected region"));
  auto* head = new QHBoxLayout;
  head->addWidget(regionName_);
  head->addStretch();
  head->addWidget(level_);
  layout->addLayout(head);
  layout->addWidget(histogram_);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addWidget(regionAuto_);
  buttons->addWidget(allAuto_);
  layout->addLayout(buttons);
  table_->setObjectName(QStringLiteral("threshold.table"));
  table_->setAccessibleName(tr("Thresholds of the 64 regions"));
  table_->setToolTip(
      tr("The 64 thresholds, arranged as on the page. Enter a grey level from 0 to 255; Delete "
         "makes a region automatic again."));
  table_->horizontalHeader()->hide();
  table_->verticalHeader()->hide();
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  table_->verticalHeader()->setMinimumSectionSize(18);
  table_->verticalHeader()->setDefaultSectionSize(21);
  table_->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
  table_->horizontalHeader()->setMinimumSectionSize(20);
  table_->setFixedHeight(8 * 21 + 2);
  table_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  table_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  // The arrows walk the regions; Tab goes on to what follows, and is not caught in the 64 of them.
  table_->setTabKeyNavigation(false);
  table_->installEventFilter(this);
  layout->addWidget(table_);
  showRegions_->setObjectName(QStringLiteral("threshold.showRegions"));
  layout->addWidget(showRegions_);

  connect(histogram_, &RegionHistogram::dragStarted, this, [this] { gesture_ = session_.newGesture(); });
  connect(histogram_, &RegionHistogram::thresholdMoved, this,
          [this](double shown) { setRegion(view_.selectedRegion(), scale_.grey(shown), gesture_); });
  connect(level_, &NumberField::committed, this,
          [this](double shown) { setRegion(view_.selectedRegion(), scale_.grey(shown)); });
  connect(regionAuto_, &QPushButton::clicked, this, [this] { setRegion(view_.selectedRegion(), std::nullopt); });
  regionAuto_->setToolTip(tr("Makes the threshold of the selected region automatic, where it was set by hand."));
  allAuto_->setToolTip(tr("Makes all thresholds that were set by hand automatic."));
  connect(allAuto_, &QPushButton::clicked, this, &ThresholdPanel::setAllAutomatic);
  connect(table_, &QTableWidget::itemChanged, this, &ThresholdPanel::readCell);
  connect(table_, &QTableWidget::currentCellChanged, this, [this](int row, int column) {
    if (!filling_ && row >= 0 && table_->hasFocus()) view_.setSelectedRegion(row * kRegionsPerSide + column);
  });
  connect(table_, &QTableWidget::cellClicked, this,
          [this](int row, int column) { view_.setSelectedRegion(row * kRegionsPerSide + column); });
  connect(showRegions_, &QCheckBox::clicked, this, [this](bool on) { view_.choose(Layer::Regions, on); });
}

double ThresholdPanel::levelOf(int region) const {
  const auto& own = session_.recipe().threshold.grid[region];
  if (own) return *own;
  if (session_.recipe().threshold.mode == ThresholdMode::Manual) return session_.recipe().threshold.manualLevel;
  return session_.output().thresholds ? session_.output().thresholds->automatic[region] : 128.0;
}

void ThresholdPanel::setRegion(std::optional<int> region, std::optional<double> grey, GestureId gesture) {
  if (!region) return;
  Recipe after = session_.recipe();
  after.threshold.grid[*region] = grey;
  const QString place =
      tr("Threshold of region %1, %2").arg(*region / kRegionsPerSide + 1).arg(*region % kRegionsPerSide + 1);
  session_.change(place, std::move(after), gesture);
}

void ThresholdPanel::setAllAutomatic() {
  Recipe after = session_.recipe();
  after.threshold.grid.fill(std::nullopt);
  after.threshold.mode = ThresholdMode::Automatic;
  session_.change(tr("All thresholds automatic"), std::move(after));
}

void ThresholdPanel::readCell(QTableWidgetItem* item) {
  if (filling_) return;
  const int region = item->row() * kRegionsPerSide + item->column();
  bool ok = false;
  const double shown = item->text().trimmed().replace(QLatin1Char(','), QLatin1Char('.')).toDouble(&ok);
  const bool cleared = item->text().trimmed().isEmpty() || item->text().trimmed().startsWith(QLatin1Char('a'));
  if (ok)
    setRegion(region, scale_.grey(shown));
  else if (cleared)
    setRegion(region, std::nullopt);
  refreshTable();
}

bool ThresholdPanel::eventFilter(QObject* watched, QEvent* event) {
  if (watched == table_ && event->type() == QEvent::ShortcutOverride) {
    // Digits typed here are thresholds, not the keys of the six targets.
    const QString typed = static_cast<QKeyEvent*>(event)->text();
    if (!typed.isEmpty() && typed.at(0).isDigit()) event->accept();
  }
  if (watched == table_ && event->type() == QEvent::KeyPress) {
    const int pressed = static_cast<QKeyEvent*>(event)->key();
    if ((pressed == Qt::Key_Delete || pressed == Qt::Key_Backspace) && table_->currentItem()) {
      setRegion(table_->currentRow() * kRegionsPerSide + table_->currentColumn(), std::nullopt);
      return true;
    }
  }
  return QWidget::eventFilter(watched, event);
}

void ThresholdPanel::refresh() {
  const ThresholdParams& params = session_.recipe().threshold;
  editor_->setRowVisible("threshold.level", params.mode == ThresholdMode::Manual);
  editor_->setRowVisible("threshold.strength", params.mode == ThresholdMode::Automatic);
  const auto own =
      std::count_if(params.grid.begin(), params.grid.end(), [](const auto& cell) { return cell.has_value(); });
  allAuto_->setEnabled(own > 0);
  const auto& found = session_.output().thresholds;
  QString text = found ? QString::fromStdString(found->note) : QString();
  const double mm = session_.output().frame.mmPerPx;
  if (found && mm > 0.0 && (params.speckArea > 0 || params.holeArea > 0)) {
    if (!text.isEmpty()) text += QLatin1Char('\n');
    text += tr("Specks under %1 are dropped, holes under %2 filled.")
                .arg(areaText(params.speckArea * mm * mm), areaText(params.holeArea * mm * mm));
    if (session_.scan() && isScaleAssumed(*session_.scan(), session_.recipe()))
      text += tr(" These sizes assume %1 dpi: the file states no resolution.").arg(kAssumedDpi);
  }
  note_->setText(text);
  note_->setVisible(!note_->text().isEmpty());
  refreshRegion();
  refreshTable();
}

void ThresholdPanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  // The numbers hold the colours of the theme they were written in.
  if (event->type() == QEvent::PaletteChange) refreshTable();
}

void ThresholdPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refreshRegion();
}

void ThresholdPanel::refreshRegion() {
  scale_ = GreyScale(session_, view_);
  const auto selected = view_.selectedRegion();
  const bool has = selected && session_.hasScan();
  level_->setEnabled(has);
  regionAuto_->setEnabled(has && session_.recipe().threshold.grid[*selected].has_value());
  if (!has) {
    regionName_->setText(tr("Click a region").toUpper());
    level_->setEmpty(QStringLiteral("–"));
    histogram_->clear();
    return;
  }
  const int region = *selected;
  regionName_->setText(
      tr("Region %1, %2").arg(region / kRegionsPerSide + 1).arg(region % kRegionsPerSide + 1).toUpper());
  level_->setValue(scale_.shown(levelOf(region)));
  // Counting a region of a large scan takes a while: once, and only when it is looked at.
  if (!isVisible()) return;
  if (countedIn_.lock() != session_.scan() || countedRegion_ != region) {
    countedIn_ = session_.scan();
    countedRegion_ = region;
    counts_ = regionHistogram(session_.scan()->grey, region);
  }
  std::array<std::uint32_t, 256> shown{};
  const auto& page = session_.output().page;
  const bool isInverted = page && page->isInverted;  // then so are the levels
  for (std::size_t grey = 0; grey < counts_.size(); ++grey)
    shown[std::lround(scale_.shown(static_cast<double>(isInverted ? counts_.size() - 1 - grey : grey)))] +=
        counts_[grey];
  histogram_->show(shown, scale_.shown(levelOf(region)));
}

void ThresholdPanel::refreshTable() {
  const Theme& theme = themeOf(palette());
  filling_ = true;
  for (int region = 0; region < kRegions; ++region) {
    const int row = region / kRegionsPerSide, column = region % kRegionsPerSide;
    QTableWidgetItem* item = table_->item(row, column);
    if (!item) {
      item = new QTableWidgetItem;
      item->setTextAlignment(Qt::AlignCenter);
      table_->setItem(row, column, item);
    }
    const bool own = session_.recipe().threshold.grid[region].has_value();
    item->setText(session_.hasScan() || own ? QString::number(scale_.shown(levelOf(region)), 'f', 0)
                                            : QStringLiteral("–"));
    item->setForeground(own ? theme.accent : theme.text);
    item->setToolTip(own ? tr("Set by you") : tr("Automatic"));
    QFont font = table_->font();
    font.setBold(own);
    item->setFont(font);
  }
  if (const auto region = view_.selectedRegion())
    table_->setCurrentCell(*region / kRegionsPerSide, *region % kRegionsPerSide);
  filling_ = false;
}

}  // namespace batten
