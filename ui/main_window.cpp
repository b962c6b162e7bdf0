// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/main_window.h"

#include <QAction>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMimeData>
#include <QScreen>
#include <QScrollArea>
#include <QSplitter>
#include <QStackedWidget>
#include <QUndoStack>
#include <QUrl>
#include <QVBoxLayout>

#include "ui/canvas/curve_canvas.h"
#include "ui/main_window_parts.h"
#include "ui/new_drawing_dialog.h"
#include "ui/panels/controls/number_field.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/rail/stage_rail.h"
#include "ui/panels/rail/tool_list.h"
#include "ui/panels/stages/clean_up_panel.h"
#include "ui/panels/stages/corners_panel.h"
#include "ui/panels/stages/curves/curves_panel.h"
#include "ui/panels/stages/edges_panel.h"
#include "ui/panels/stages/export/export_panel.h"
#include "ui/panels/stages/fairing_panel.h"
#include "ui/panels/stages/scan_panel.h"
#include "ui/panels/stages/threshold_panel.h"
#include "ui/panels/targets/shape_window.h"
#include "ui/panels/targets/target_strip.h"
#include "ui/plots/curve_plots.h"
#include "ui/session/files/path_text.h"
#include "ui/setting_finder.h"
#include "ui/status_line.h"
#include "ui/top_bar.h"

namespace batten {
MainWindow::MainWindow() : parts_(std::make_unique<Parts>()) {
  // Before the first widget: sizes follow from the font.
  applyTheme(storedTheme());
  setObjectName(QStringLiteral("mainWindow"));
  setWindowTitle(QStringLiteral("Batten"));
  setWindowIcon(QIcon(QStringLiteral(":/icons/batten.svg")));
  setAcceptDrops(true);
  setMinimumSize(960, 600);
  // The window manager's title bar needs room too, or the status line falls off a small screen.
  constexpr int kTitleBar = 48;
  resize(QSize(1440, 900).boundedTo(screen()->availableSize() - QSize(0, kTitleBar)));
  makeActions();
  makeMenus();
  auto* whole = new QWidget(this);
  auto* column = new QVBoxLayout(whole);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  const TopBar::Actions bar{action(ActionId::Undo),       action(ActionId::Redo),    action(ActionId::ShowScan),
                            action(ActionId::ShowComb),   action(ActionId::ZoomFit), action(ActionId::ZoomActual),
                            action(ActionId::FindAction), action(ActionId::Export)};
  parts_->topBar = new TopBar(view_, bar, parts_->mainMenu, parts_->layersMenu, whole);
  parts_->topBar->setObjectName(QStringLiteral("topBar"));
  parts_->errors = new ErrorStrip(whole);
  parts_->rail = new StageRail(session_, whole);
  parts_->rail->setObjectName(QStringLiteral("stageRail"));
  QList<QAction*> tools;
  // Corners of the sheet and inks have a button in the Scan panel, and are set once a drawing at most.
  for (const Tool tool : kTools)
    if (tool != Tool::Sheet && tool != Tool::Ink) tools.append(action(toolAction(tool)));
  parts_->rail->layout()->addWidget(new ToolList(tools, parts_->rail));
  column->addWidget(parts_->topBar);
  auto* row = new QHBoxLayout;
  row->setSpacing(0);
  column->addLayout(row, 1);
  row->addWidget(parts_->rail);
  row->addWidget(makeCentre(whole), 1);
  row->addWidget(makeInspector(whole));
  parts_->status = new StatusLine(session_, whole);
  parts_->errors->layOver(parts_->canvas);
  column->addWidget(parts_->status);
  setCentralWidget(whole);
  // The settings at hand follow the drawing; what leads elsewhere comes last.
  tabAsLaidOut({parts_->canvas, parts_->errors, parts_->inspector, parts_->strip, parts_->plots, parts_->status,
                parts_->rail, parts_->topBar});
  parts_->finder = new CommandPalette(whole);
  parts_->journal = std::make_unique<RecipeJournal>(session_, journalFolder());
  parts_->opening = std::make_unique<OpeningGuard>(session_);
  connectSession();
  connectActions();
  connectLayers();
  loadSettings();
  refreshActions();
  refreshTitle();
  setStage(PanelStage::Scan);
  parts_->canvas->setFocus();
}

MainWindow::~MainWindow() {
  // The widgets refer to the session and the view settings, which go before the base class would delete its children.
  session_.disconnect(this);
  session_.undoStack()->disconnect(this);
  view_.disconnect(this);
  delete parts_->shapes.data();
  delete centralWidget();
}

QWidget* MainWindow::makeCentre(QWidget* whole) {
  Parts& p = *parts_;
  p.splitter = new QSplitter(Qt::Vertical, whole);
  p.splitter->setHandleWidth(1);
  p.splitter->setObjectName(QStringLiteral("centreSplitter"));
  p.canvas = new CurveCanvas(session_, view_, p.splitter);
  p.canvas->setObjectName(QStringLiteral("canvas"));
  p.canvas->setAccessibleName(tr("Drawing"));
  auto* lower = new QWidget(p.splitter);
  auto* layout = new QVBoxLayout(lower);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  p.strip = new TargetStrip(session_, lower);
  p.plots = new CurvePlots(session_, view_, lower);
  layout->addWidget(p.strip);
  layout->addWidget(p.plots, 1);
  p.lower = lower;
  p.splitter->addWidget(p.canvas);
  p.splitter->addWidget(lower);
  p.splitter->setStretchFactor(0, 1);
  p.splitter->setStretchFactor(1, 0);
  p.splitter->setChildrenCollapsible(false);
  connect(p.splitter, &QSplitter::splitterMoved, this, [this] {
    if (parts_->plots->isVisible()) parts_->lowerPx = parts_->lower->height();
  });
  return p.splitter;
}

// A widget that comes to another parent is styled anew, with all that it holds: so each is made with the one it keeps.
QWidget* MainWindow::makeInspector(QWidget* whole) {
  Parts& p = *parts_;
  auto* frame = new HairlineFrame(whole);
  auto* layout = new QVBoxLayout(frame);
  layout->setContentsMargins(1, 0, 0, 0);
  p.inspector = new QStackedWidget(frame);
  p.inspector->setObjectName(QStringLiteral("inspector"));
  layout->addWidget(p.inspector);
  frame->setFixedWidth(301);
  p.settings = new SettingFinder(this);
  connect(p.settings, &SettingFinder::stageAsked, this, &MainWindow::setStage);
  // `make` is given the parent of the panel.
  const auto add = [&](PanelStage stage, const auto& make) {
    auto* scroll = new QScrollArea(p.inspector);
    scroll->setWidgetResizable(true);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setFocusPolicy(Qt::NoFocus);
    p.inspector->addWidget(scroll);
    auto* panel = make(scroll->viewport());
    panel->setObjectName(QStringLiteral("panel.") + key(stage));
    scroll->setWidget(panel);
    p.settings->add(stage, scroll);
    // Keys typed after Enter are the drawing's.
    for (auto* field : panel->template findChildren<NumberField*>())
      connect(field, &NumberField::entered, p.canvas, [this] { parts_->canvas->setFocus(Qt::OtherFocusReason); });
    return panel;
  };
  p.scanPanel = add(PanelStage::Scan, [this](QWidget* in) { return new ScanPanel(session_, view_, in); });
  add(PanelStage::Threshold, [this](QWidget* in) { return new ThresholdPanel(session_, view_, in); });
  add(PanelStage::CleanUp, [this](QWidget* in) { return new CleanUpPanel(session_, in); });
  add(PanelStage::Edges, [this](QWidget* in) { return new EdgesPanel(session_, view_, in); });
  add(PanelStage::Corners, [this](QWidget* in) { return new CornersPanel(session_, view_, in); });
  auto* curves = add(PanelStage::Curves, [this](QWidget* in) { return new CurvesPanel(session_, view_, in); });
  auto* fairing = add(PanelStage::Fairing, [this](QWidget* in) { return new FairingPanel(session_, in); });
  p.exportPanel = add(PanelStage::Export, [this](QWidget* in) { return new ExportPanel(session_, in); });
  connect(p.scanPanel, &ScanPanel::pageChosen, this, &MainWindow::openPage);
  connect(curves, &CurvesPanel::helpAsked, this, &MainWindow::showHelp);
  connect(fairing, &FairingPanel::comparisonAsked, this, &MainWindow::showShapes);
  return frame;
}

void MainWindow::connectSession() {
  Parts& p = *parts_;
  connect(p.rail, &StageRail::chosen, this, &MainWindow::enterStage);
  connect(p.canvas, &CurveCanvas::zoomChanged, p.topBar, &TopBar::setZoom);
  connect(p.canvas, &CurveCanvas::zoomChanged, p.status, &StatusLine::setZoom);
  connect(p.canvas, &CurveCanvas::hovered, p.status, &StatusLine::setPlace);
  connect(p.canvas, &CurveCanvas::hint, p.status, &StatusLine::setHint);
  connect(p.strip, &TargetStrip::hint, p.status, &StatusLine::setHint);
  connect(p.plots, &CurvePlots::directionChanged, p.strip, &TargetStrip::setRunsLeft);
  connect(p.plots, &CurvePlots::hint, p.status, &StatusLine::setHint);
  connect(p.status, &StatusLine::scaleAsked, this, [this] {
    setStage(PanelStage::Scan);
    parts_->scanPanel->focusResolution();
  });
  connect(p.exportPanel, &ExportPanel::failed, this,
          [this](const Error& error) { showProblem(error, FailureOrigin::Export); });
  connect(p.exportPanel, &ExportPanel::said, this,
          [this](const QString& text) { parts_->status->showMessage(text, {}, {}); });
  connect(p.exportPanel, &ExportPanel::exported, p.rail, &StageRail::setExported);
  connect(&p.threadShortage, &ThreadShortage::changed, this, [this](bool isShort) {
    const QString text = tr("Nothing can be computed now: the system has no threads left. Close other programs.");
    parts_->status->setTrouble(StatusLine::Trouble::Threads, isShort ? text : QString());
  });
  connect(p.journal.get(), &RecipeJournal::failingChanged, this, [this](bool isFailing) {
    const QString text = tr("Save the recipe soon: a crash would lose this work, as %1 cannot be written.");
    parts_->status->setTrouble(StatusLine::Trouble::Journal,
                               isFailing ? text.arg(shownPath(journalFolder())) : QString());
  });
  connect(p.errors, &ErrorStrip::actionPressed, this, [this] {
    if (const auto remedy = parts_->remedy) remedy();
  });
  connect(p.errors, &ErrorStrip::dismissed, this, [this] {
    if (const auto dismissal = std::exchange(parts_->dismissal, {})) dismissal();
    refreshActions();
  });
  connect(&session_, &EditorSession::failed, this, &MainWindow::showProblem);
  connect(&session_, &EditorSession::failureCleared, this, [this] {
    // Messages of a run are cleared by the next run; other messages stay until dismissed.
    if (parts_->problemOrigin == FailureOrigin::Run) leaveProblem();
  });
  connect(&session_, &EditorSession::scanOpened, this, &MainWindow::scanOpened);
  connect(session_.undoStack(), &QUndoStack::cleanChanged, this, &MainWindow::refreshTitle);
  connect(&session_, &EditorSession::recipeChanged, this, &MainWindow::refreshTitle);
  connect(&session_, &EditorSession::workingChanged, this, &MainWindow::refreshActions);
  connect(&session_, &EditorSession::pinChanged, this, &MainWindow::refreshActions);
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::recipeChanged, &EditorSession::runFinished,
                            &EditorSession::selectionChanged, &EditorSession::targetsChanged})
    connect(&session_, signal, this, &MainWindow::refreshActions);
  connect(&session_, &EditorSession::selectionChanged, this, [this] {
    if (view_.tool() == usualTool(stage())) parts_->status->updateStageHint(stageHint());
  });
  connect(&session_, &EditorSession::busyChanged, this, &MainWindow::refreshActions);
  connect(session_.undoStack(), &QUndoStack::indexChanged, this, &MainWindow::refreshActions);
}

void MainWindow::newDrawing() {
  NewDrawingDialog dialog(this);
  if (dialog.exec() == QDialog::Accepted) beginDrawing(dialog.recipe());
}

PanelStage MainWindow::stage() const { return parts_->rail->current(); }

QString MainWindow::stageHint() const {
  return batten::hint(stage(), session_.hasScan(), session_.selectedCurve().has_value());
}

void MainWindow::setStage(PanelStage stage) {
  parts_->rail->setCurrent(stage);
  enterStage(stage);
}

void MainWindow::enterStage(PanelStage stage) {
  // The stack would hand the keys on to the first number of the next panel, where a tool's letter would be lost.
  const QWidget* holder = focusWidget();
  if (holder && parts_->inspector->isAncestorOf(holder)) parts_->canvas->setFocus(Qt::OtherFocusReason);
  parts_->inspector->setCurrentIndex(static_cast<int>(stage));
  parts_->status->setStageHint(stageHint());
  showLayersOf(stage);
  // What is not compared is not drawn over: a faired curve in Export would look like a pinned one.
  view_.setComparesPinned(stage == PanelStage::Curves || stage == PanelStage::Fairing);
  parts_->topBar->setExportIsPrimary(stage != PanelStage::Export);
  view_.setShowsMaskUncleaned(stage == PanelStage::Threshold);
  view_.setTool(usualTool(stage));
  parts_->showsLowerHere = false;
  fitLower();
}

// What a stage works on is shown while it is open and what hides it is not; what the user switches stays as he left it.
void MainWindow::showLayersOf(PanelStage stage) {
  for (const Parts::StageLayer& one : parts_->stageLayers)
    if (view_.isVisible(one.layer) == one.during) view_.setVisible(one.layer, one.before);
  parts_->stageLayers.clear();
  const auto turn = [this](bool on, std::initializer_list<Layer> layers) {
    for (const Layer layer : layers) {
      if (view_.isVisible(layer) == on) continue;
      parts_->stageLayers.push_back({layer, !on, on});
      view_.setVisible(layer, on);
    }
  };
  // Marks that a click changes are shown where curves are judged, not where they would be in the way.
  if (stage != PanelStage::Curves && stage != PanelStage::Fairing) turn(false, {Layer::Extrema});
  switch (stage) {
    case PanelStage::Scan:
      parts_->log = session_.recipe().log;
      if (parts_->log.enabled) turn(true, {Layer::LogImage});
      turn(false, {Layer::Curve, Layer::Faired, Layer::Comb, Layer::Corners});
      break;
    case PanelStage::Threshold:
      turn(true, {Layer::Mask, Layer::Regions});
      turn(false, {Layer::Curve, Layer::Faired, Layer::Comb, Layer::Corners});
      break;
    case PanelStage::CleanUp:
      turn(true, {Layer::Mask});
      turn(false, {Layer::Curve, Layer::Faired, Layer::Comb, Layer::Corners});
      break;
    case PanelStage::Edges:
      turn(true, {Layer::Edges, Layer::Curve, Layer::Fallback, Layer::Junctions});
      turn(false, {Layer::Faired, Layer::Comb});
      showStrokes(true);
      break;
    case PanelStage::Corners:
      turn(true, {Layer::Corners, Layer::Curve});
      turn(false, {Layer::Faired, Layer::Comb});
      showRoundings();
      break;
    case PanelStage::Curves:
      turn(true, {Layer::Curve});
      turn(false, {Layer::Faired});
      break;
    case PanelStage::Fairing:
      turn(true, {Layer::Curve, Layer::Faired});
      break;
    case PanelStage::Export:
      turn(true, {Layer::Faired});
      turn(false, {Layer::Comb});
      break;
  }
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->source() != nullptr) return;  // a curve that is being dragged out of this window
  const auto urls = event->mimeData()->urls();
  if (!urls.isEmpty() && urls.first().isLocalFile()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  const auto urls = event->mimeData()->urls();
  if (urls.isEmpty() || !urls.first().isLocalFile()) return;
  event->acceptProposedAction();
  openPath(pathText(urls.first()));
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!maybeDiscard()) return event->ignore();
  saveSettings();
  session_.cancel();
  QMainWindow::closeEvent(event);
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  fitLowerSoon();
}

// What had the keyboard has gone: it goes back to the drawing, whose keys are the tools', not into the next number.
bool MainWindow::focusNextPrevChild(bool next) {
  const QWidget* holder = focusWidget();
  if (!holder || (holder->isVisible() && holder->isEnabled())) return QMainWindow::focusNextPrevChild(next);
  parts_->canvas->setFocus(Qt::OtherFocusReason);
  return true;
}

void MainWindow::changeEvent(QEvent* event) {
  QMainWindow::changeEvent(event);
  if (event->type() == QEvent::ActivationChange && !isActiveWindow()) view_.setScanOnly(false);
}

}  // namespace batten
