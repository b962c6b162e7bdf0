// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/scan_panel.h"

#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>
#include <cmath>

#include "core/base/conventions.h"
#include "core/base/number_text.h"
#include "core/image/ruling/ruling_count.h"
#include "core/pipeline/run/pipeline.h"
#include "ui/panels/controls/number_field.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/parameter_editor.h"
#include "ui/panels/controls/stage_panel.h"
#include "ui/panels/stages/import_units.h"
#include "ui/panels/stages/rectify_controls.h"
#include "ui/panels/stages/scale_controls.h"
#include "ui/session/edits/ink_edits.h"
#include "ui/session/text/page_text.h"
#include "ui/theme/theme.h"

namespace batten {

ToneSwatch::ToneSwatch(QWidget* parent) : QWidget(parent) {
  setFixedHeight(52);
  setToolTip(tr("Grey tones of the scan, above, and how the log transform shows them, below."));
  setAccessibleName(tr("Tones before and after the log transform"));
}

void ToneSwatch::show(const LogParams& params) {
  params_ = {true, params.factor};
  update();
}

void ToneSwatch::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  const auto tones = toneTable(params_);
  const int label = 40;
  painter.setFont(uiFont(11));
  for (int row = 0; row < 2; ++row) {
    const QRect box(label, row * 26 + 2, width() - label, 22);
    painter.setPen(theme.mute);
    painter.drawText(QRect(0, box.top(), label, box.height()), Qt::AlignVCenter | Qt::AlignLeft,
                     row == 0 ? tr("Scan") : tr("Log"));
    QImage ramp(256, 1, QImage::Format_RGB32);
    for (int grey = 0; grey < 256; ++grey) {
      const int tone = row == 0 ? grey : tones[grey];
      ramp.setPixel(grey, 0, qRgb(tone, tone, tone));
    }
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(box, ramp);
    painter.setPen(theme.line);
    painter.drawRect(box.adjusted(0, 0, -1, -1));
  }
}

ScanPanel::ScanPanel(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent),
      session_(session),
      facts_(new FigureTable(this)),
      pageName_(new QLabel(tr("Page"), this)),
      page_(new NumberField(this)),
      pdfName_(new QLabel(tr("Drawn at"), this)),
      pdfDpi_(new NumberField(this)),
      dpi_(new NumberField(this)),
      scaleNote_(note({}, this)),
      fromFile_(linkButton(tr("Use the file's resolution"), QStringLiteral("scan.dpiFromFile"), this)),
      swatch_(new ToneSwatch(this)),
      paperNote_(note({}, this)),
      inkBox_(new QWidget(this)),
      pickInk_(plainButton(tr("Pick an ink"), QStringLiteral("scan.pickInk"), this)) {
  auto* column = panelColumn(this, tr("Scan"));
  column->addWidget(facts_);
  buildPages();
  // Before the scale, which a sheet that was photographed at an angle gets from it.
  column->addWidget(new RectifyControls(session_, view, this));
  buildScale(view);
  column->addWidget(caption(tr("Tones"), this));
  column->addWidget(new ParameterEditor(session, {"log.enabled", "log.factor"}, this));
  column->addWidget(swatch_);
  buildPaper(view);
  column->addStretch();
  connect(&session_, &EditorSession::scanOpened, this, &ScanPanel::refresh);
  connect(&session_, &EditorSession::recipeChanged, this, &ScanPanel::refresh);
  connect(&session_, &EditorSession::stageReady, this, &ScanPanel::refreshPaper);
  refresh();
}

QVBoxLayout* ScanPanel::column() const { return static_cast<QVBoxLayout*>(layout()); }

void ScanPanel::buildPages() {
  auto* pages = new QGridLayout;
  pages->setHorizontalSpacing(8);
  pages->setColumnStretch(0, 1);
  const auto addField = [&](QLabel* title, NumberField* field, int row, const QString& what, const QString& called,
                            const QString& name) {
    title->setToolTip(what);
    field->setToolTip(what);
    field->setDecimals(0);
    field->setStep(1.0);
    field->setFixedWidth(92);
    field->edit()->setObjectName(called);
    field->edit()->setAccessibleName(name);  // the action finder lists it
    pages->addWidget(title, row, 0);
    pages->addWidget(field, row, 1);
  };
  addField(pageName_, page_, 0, tr("The open page of the file. Each page is a separate drawing with its own recipe."),
           QStringLiteral("scan.page"), tr("Page of the file"));
  addField(pdfName_, pdfDpi_, 1, tr("Rendering resolution of the PDF page. Its size in mm does not change."),
           QStringLiteral("scan.pdfDpi"), tr("Rendering resolution of the PDF"));
  pdfDpi_->setRange(20.0, 4800.0);
  pdfDpi_->setUnit(tr("dpi"));
  column()->addLayout(pages);
  connect(page_, &NumberField::committed, this, [this](double value) {
    PageChoice choice = session_.recipe().scanPage;
    choice.number = static_cast<int>(value);
    if (choice != session_.recipe().scanPage) emit pageChosen(choice);
  });
  connect(pdfDpi_, &NumberField::committed, this, [this](double value) {
    PageChoice choice = session_.recipe().scanPage;
    choice.pdfDpi = value;
    if (choice != session_.recipe().scanPage) emit pageChosen(choice);
  });
}

void ScanPanel::buildScale(ViewSettings& view) {
  column()->addWidget(caption(tr("Scale"), this));
  auto* scale = new QGridLayout;
  scale->setHorizontalSpacing(8);
  scale->setColumnStretch(0, 1);
  auto* name = new QLabel(tr("Resolution"), this);
  const QString help = tr("Pixels of the scan per inch. All lengths in mm depend on it.");
  name->setToolTip(help);
  dpi_->setToolTip(help);
  dpi_->setRange(10.0, 10000.0);
  dpi_->setDecimals(0);
  dpi_->setStep(1.0);
  dpi_->setUnit(tr("dpi"));
  dpi_->setFixedWidth(92);
  dpi_->edit()->setObjectName(QStringLiteral("scan.dpi"));
  dpi_->edit()->setAccessibleName(tr("Resolution in dpi"));
  scale->addWidget(name, 0, 0);
  scale->addWidget(dpi_, 0, 1);
  column()->addLayout(scale);
  column()->addWidget(scaleNote_);
  column()->addWidget(fromFile_, 0, Qt::AlignLeft);
  column()->addWidget(new ScaleControls(session_, view, this));
  auto* units = new ImportUnits(session_, this);
  connect(units, &ImportUnits::failed, scaleNote_,
          [this](const Error& error) { scaleNote_->setText(QString::fromStdString(error.message)); });
  column()->addWidget(units);
  connect(dpi_, &NumberField::committed, this, [this](double value) { setDpi(value); });
  connect(fromFile_, &QPushButton::clicked, this, [this] { setDpi(std::nullopt); });
}

void ScanPanel::buildPaper(ViewSettings& view) {
  column()->addWidget(caption(tr("Paper"), this));
  column()->addWidget(new ParameterEditor(
      session_,
      {"paper.lines", "paper.colour", "paper.rulings", "paper.sheet", "paper.shading", "paper.flatten", "paper.folds"},
      this));
  paperNote_->setObjectName(QStringLiteral("scan.paperNote"));
  column()->addWidget(paperNote_);
  new QGridLayout(inkBox_);
  inkBox_->layout()->setContentsMargins(0, 0, 0, 0);
  inkBox_->setObjectName(QStringLiteral("scan.inks"));
  column()->addWidget(inkBox_);
  pickInk_->setCheckable(true);
  pickInk_->setToolTip(
      tr("Click an ink on the drawing to exclude it, or to trace it again; Shift+click traces it alone  (I)"));
  column()->addWidget(pickInk_, 0, Qt::AlignLeft);
  connect(pickInk_, &QPushButton::clicked, this, [&view](bool on) { view.setTool(on ? Tool::Ink : Tool::Select); });
  connect(&view, &ViewSettings::toolChanged, pickInk_, [this](Tool tool) { pickInk_->setChecked(tool == Tool::Ink); });
  column()->addWidget(new ParameterEditor(session_, {"inks.keep", "inks.drop", "inks.range"}, this));
}

void ScanPanel::focusResolution() {
  dpi_->edit()->setFocus(Qt::ShortcutFocusReason);
  dpi_->edit()->selectAll();
}

void ScanPanel::setDpi(std::optional<double> dpi) {
  Recipe after = session_.recipe();
  setResolution(after, dpi);
  session_.change(tr("Resolution"), std::move(after));
}

void ScanPanel::refreshPage(const Scan* scan) {
  const bool hasPages = scan != nullptr && scan->pages > 1, isPdf = scan != nullptr && scan->info.format == "PDF";
  pageName_->setVisible(hasPages);
  page_->setVisible(hasPages);
  pdfName_->setVisible(isPdf);
  pdfDpi_->setVisible(isPdf);
  if (hasPages) {
    pageName_->setText(tr("Page of %1").arg(scan->pages));
    page_->setRange(1.0, static_cast<double>(scan->pages));
    page_->setValue(static_cast<double>(scan->page.number));
  }
  if (isPdf) pdfDpi_->setValue(scan->page.pdfDpi);
}

void ScanPanel::refreshPaper() {
  QStringList said;
  const auto& page = session_.output().page;
  if (page && page->isInverted) said << tr("The lines are brighter than the paper: the page was inverted.");
  if (page && page->colouredShare > 0.0)
    said << tr("Coloured ink was made darker on %1 % of the page.")
                .arg(QString::fromStdString(percentText(page->colouredShare)));
  // Families of one direction, as lines and their margin, are counted together.
  for (const bool runsDown : {false, true}) {
    const int count = page ? ruledLines(page->rulings, runsDown) : 0;
    if (count == 1)
      said << (runsDown ? tr("A vertical ruled line was removed.") : tr("A horizontal ruled line was removed."));
    else if (count > 1)
      said << (runsDown ? tr("%1 vertical ruled lines were removed.") : tr("%1 horizontal ruled lines were removed."))
                  .arg(count);
  }
  if (page && !page->dots.empty()) said << tr("%1 dots of dotted paper were removed.").arg(page->dots.size());
  if (page && page->bindingHoles > 0) said << tr("%1 binding holes were removed.").arg(page->bindingHoles);
  if (page && page->shadedShare > 0.0)
    said << tr("Shading on %1 % of the page was left out.").arg(QString::fromStdString(percentText(page->shadedShare)));
  if (page && page->sheet && !session_.scan()->rectification)
    said << tr("%1 % of the picture is outside the sheet and was cut off.")
                .arg(100.0 * page->sheet->outsideShare, 0, 'f', 0);
  refreshInks();
  paperNote_->setText(said.join(QLatin1Char(' ')));
  paperNote_->setVisible(!said.isEmpty());
}

namespace {

QIcon inkIcon(const Rgb8& colour) {
  QPixmap swatch(14, 14);
  swatch.fill(QColor(colour.red, colour.green, colour.blue));
  return QIcon(swatch);
}

}  // namespace

/// One button for every ink of the page; pressed in is traced. Made anew only for other inks, so that the focus stays.
void ScanPanel::refreshInks() {
  const auto& page = session_.output().page;
  const std::vector<FoundInk> inks = page && page->inks.size() > 1 ? page->inks : std::vector<FoundInk>{};
  if (inks != shownInks_) {
    qDeleteAll(inkBox_->findChildren<QPushButton*>(QString(), Qt::FindDirectChildrenOnly));
    shownInks_ = inks;
    auto* grid = static_cast<QGridLayout*>(inkBox_->layout());
    for (std::size_t i = 0; i < inks.size(); ++i) {
      const FoundInk& ink = inks[i];
      auto* button = new QPushButton(inkIcon(ink.shown), inkName(ink.colour), inkBox_);
      button->setObjectName(QStringLiteral("scan.ink%1").arg(i));
      button->setCheckable(true);
      button->setToolTip(tr("%1 % of the ink on the page. Press to exclude this ink; press again to trace it.")
                             .arg(100.0 * ink.share, 0, 'f', 0));
      connect(button, &QPushButton::clicked, this,
              [this, colour = ink.colour](bool isTraced) { setInkDropped(session_, colour, !isTraced); });
      grid->addWidget(button, static_cast<int>(i) / 2, static_cast<int>(i) % 2);
    }
  }
  const auto buttons = inkBox_->findChildren<QPushButton*>(QString(), Qt::FindDirectChildrenOnly);
  for (QPushButton* button : buttons) {
    const int i = button->objectName().mid(8).toInt();
    if (i < std::ssize(inks)) button->setChecked(isTraced(inks[i].colour, session_.recipe().preparation.inks));
  }
  inkBox_->setVisible(!inks.empty());
  pickInk_->setVisible(session_.hasScan() && !session_.scan()->colour.isEmpty());
}

void ScanPanel::refresh() {
  refreshPaper();
  swatch_->show(session_.recipe().log);
  refreshPage(session_.scan().get());
  dpi_->setEnabled(session_.hasScan());
  if (!session_.hasScan()) {
    facts_->setRows({});
    dpi_->setEmpty(QStringLiteral("–"));
    scaleNote_->setText(tr("Open a scan: PNG, JPEG, TIFF, PDF, JPEG 2000, BMP, WebP or PNM."));
    fromFile_->hide();
    return;
  }
  const Scan& scan = *session_.scan();
  const PageFrame frame = frameFor(scan, session_.recipe());
  const QString size = QStringLiteral("%1 × %2").arg(grouped(frame.widthPx), grouped(frame.heightPx));
  const QString paper = pageSizeText(frame);
  const bool assumed = isScaleAssumed(scan, session_.recipe());
  const QString depth = tr("%1, %2 bit").arg(QString::fromStdString(scan.info.format)).arg(scan.info.bitsPerChannel);
  facts_->setRows(
      {{tr("File"), {{depth}}, QString::fromStdString(scan.path)},
       {tr("Size, px"), {{size}}, tr("Width and height of the upright picture.")},
       {tr("Size, mm"), {{assumed ? tr("not known yet") : paper, assumed}}, tr("Calculated from the resolution.")}});
  const auto own = session_.recipe().dpi;
  if (const auto stated = own ? own : scan.dpi) {
    dpi_->setDecimals(resolutionText(*stated).contains(QLatin1Char('.')) ? 1 : 0);
    dpi_->setValue(*stated);
  } else {
    dpi_->setEmpty(QStringLiteral("–"));
  }
  fromFile_->setVisible(own.has_value());
  fromFile_->setText(scan.dpi ? tr("Use the file's %1 dpi").arg(resolutionText(*scan.dpi))
                              : tr("Forget this resolution"));
  if (assumed)
    scaleNote_->setText(tr("The file states no resolution; %1 dpi is assumed. Enter the scanner's dpi to get true "
                           "lengths.")
                            .arg(kAssumedDpi, 0, 'f', 0));
  else
    scaleNote_->setText(session_.recipe().scaleLine ? tr("Measured on the drawing.")
                        : own                       ? tr("Set by you.")
                                                    : tr("Stated by the file."));
}

}  // namespace batten
