// SPDX-License-Identifier: GPL-3.0-or-later
#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QMenu>
#include <QSplitter>
#include <QUndoStack>
#include <algorithm>
#include <utility>

#include "core/fairing/profile/target_degrees.h"
#include "ui/canvas/curve_canvas.h"
#include "ui/main_window_parts.h"
#include "ui/panels/rail/stage_of_change.h"
#include "ui/panels/stages/export/export_panel.h"
#include "ui/panels/targets/shape_window.h"
#include "ui/plots/curve_plots.h"
#include "ui/session/edits/direction_edits.h"
#include "ui/session/edits/piece_choice.h"
#include "ui/session/edits/region_edits.h"
#include "ui/session/view/change_view.h"
#include "ui/setting_finder.h"
#include "ui/status_line.h"
#include "ui/top_bar.h"

namespace batten {

QAction* MainWindow::action(ActionId id) const { return parts_->actions.value(static_cast<int>(id)); }

void MainWindow::makeActions() {
  for (const ActionInfo& info : actionCatalog()) {
    QAction* made = makeAction(info.id, this);
    parts_->actions.insert(static_cast<int>(info.id), made);
    addAction(made);
  }
  auto* tools = new QActionGroup(this);
  for (const Tool tool : kTools) tools->addAction(action(toolAction(tool)));
  const auto own = [this](const QString& text, const QString& name, const QString& help, const QKeySequence& keys) {
    auto* made = new QAction(text, this);
    made->setObjectName(name);
    made->setStatusTip(help);
    made->setToolTip(help);
    made->setShortcut(keys);
    addAction(made);
    parts_->ownActions.append(made);
    return made;
  };
  for (const PanelStage stage : kPanelStages) {
    auto* made = own(tr("Stage: %1").arg(label(stage)), QStringLiteral("go-") + key(stage),
                     tr("Show the settings of this stage."),
                     QKeySequence(QStringLiteral("F%1").arg(static_cast<int>(stage) + 2)));
    // F2 to F9; F10 opens the menu.
    connect(made, &QAction::triggered, this, [this, stage] { setStage(stage); });
  }
  const struct {
    PlotTab tab;
    QString text;
  } plots[] = {{PlotTab::Radius, tr("Plot: radius")},
               {PlotTab::Curvature, tr("Plot: curvature")},
               {PlotTab::CurvatureSlope, tr("Plot: curvature slope")},
               {PlotTab::Speed, tr("Plot: parameter speed")},
               {PlotTab::Deviation, tr("Plot: deviation")}};
  for (const auto& plot : plots)
    connect(own(plot.text, {}, tr("Show this plot of the selected curve."), {}), &QAction::triggered, this,
            [this, tab = plot.tab] { parts_->plots->setTab(tab); });
  connect(own(tr("Plot: reverse"), QStringLiteral("reverse-plot"), tr("Reverse the plot of the selected curve."), {}),
          &QAction::triggered, this, [this] { parts_->plots->setReversed(!parts_->plots->isReversed()); });
  connect(own(tr("Compare shapes"), QStringLiteral("compare-shapes"),
              tr("Similarity of two curves, independent of size and position."), {}),
          &QAction::triggered, this, &MainWindow::showShapes);
  parts_->foldAction = own(tr("Targets and plots"), QStringLiteral("fold-plots"),
                           tr("Show or hide the six targets and the plot. They open in stages Curves and Fairing."),
                           QKeySequence(QStringLiteral("P")));
  parts_->foldAction->setCheckable(true);
  connect(parts_->foldAction, &QAction::triggered, this, &MainWindow::foldLower);
  connect(
      own(tr("Help on this stage"), QStringLiteral("help-stage"), tr("Explains this stage."), QKeySequence(Qt::Key_F1)),
      &QAction::triggered, this, [this] { showHelp(key(stage())); });
  connect(own(tr("All help pages"), QStringLiteral("help-contents"), tr("First page of the help."), {}),
          &QAction::triggered, this, [this] { showHelp(QStringLiteral("index")); });
  connect(own(tr("Keys and mouse"), QStringLiteral("help-keys"), tr("Every shortcut, and what the mouse does."), {}),
          &QAction::triggered, this, [this] { showHelp(QStringLiteral("keys")); });
  connect(own(tr("About Batten"), QStringLiteral("about"), tr("Version, licence and libraries."), {}),
          &QAction::triggered, this, [this] { showHelp(QStringLiteral("about")); });
  auto* menuKey = own(tr("Open the menu"), QStringLiteral("open-menu"), tr("Open the menu at the top left."),
                      QKeySequence(Qt::Key_F10));
  connect(menuKey, &QAction::triggered, this, [this] { parts_->topBar->openMenu(); });
}

void MainWindow::showShapes() {
  if (!parts_->shapes) {
    parts_->shapes = new ShapeWindow(session_, this);
    connect(parts_->shapes, &QDialog::finished, this, &MainWindow::followTargets);
  }
  parts_->shapes->show();
  followTargets();
  parts_->shapes->raise();
}

void MainWindow::makeMenus() {
  Parts& p = *parts_;
  p.mainMenu = new QMenu(this);
  p.mainMenu->setObjectName(QStringLiteral("mainMenu"));
  p.layersMenu = new QMenu(this);
  p.recentMenu = new QMenu(tr("Open recent"), this);
  p.recentMenu->setObjectName(QStringLiteral("recentMenu"));
  connect(p.recentMenu, &QMenu::aboutToShow, this, &MainWindow::refreshRecent);
  const auto ownNamed = [&p](const QString& name) {
    for (QAction* one : p.ownActions)
      if (one->objectName() == name) return one;
    return static_cast<QAction*>(nullptr);
  };
  for (const ActionMenu menu :
       {ActionMenu::File, ActionMenu::Edit, ActionMenu::View, ActionMenu::Tools, ActionMenu::Fairing}) {
    QMenu* sub = p.mainMenu->addMenu(label(menu));
    for (const ActionInfo& info : actionCatalog()) {
      if (info.menu != menu || info.isHeld) continue;
      if (info.id == ActionId::ShowScan || info.id == ActionId::Quit || info.id == ActionId::CancelWork)
        sub->addSeparator();
      sub->addAction(action(info.id));
      if (info.id == ActionId::OpenScan) sub->addMenu(p.recentMenu);
      if (info.id == ActionId::SaveRecipeAs) sub->addSeparator();
      if (layerOf(info.id)) p.layersMenu->addAction(action(info.id));
    }
    if (menu == ActionMenu::Fairing) sub->addAction(ownNamed(QStringLiteral("compare-shapes")));
    if (menu != ActionMenu::View) continue;
    sub->addSeparator();
    sub->addAction(p.foldAction);
    QMenu* theme = sub->addMenu(tr("Theme"));
    auto* group = new QActionGroup(theme);
    const std::pair<ThemeChoice, QString> themes[] = {{ThemeChoice::System, tr("Follow the desktop")},
                                                      {ThemeChoice::Light, tr("Light")},
                                                      {ThemeChoice::Dark, tr("Dark")}};
    for (const auto& [choice, text] : themes) {
      auto* entry = group->addAction(text);
      entry->setCheckable(true);
      entry->setObjectName(QStringLiteral("theme-%1").arg(static_cast<int>(choice)));
      entry->setStatusTip(tr("Colours of the window."));
      theme->addAction(entry);
      connect(entry, &QAction::triggered, this, [this, choice = choice] { setThemeChoice(choice); });
      auto* found = new QAction(tr("Theme: %1").arg(text), this);
      found->setStatusTip(tr("Colours of the window."));
      connect(found, &QAction::triggered, entry, &QAction::trigger);
      p.ownActions.append(found);
    }
  }
  QMenu* help = p.mainMenu->addMenu(tr("Help"));
  for (const char* name : {"help-stage", "help-contents", "help-keys", "about"})
    help->addAction(ownNamed(QString::fromLatin1(name)));
  help->insertAction(help->actions().last(), action(ActionId::FindAction));
}

void MainWindow::connectActions() {
  for (const ActionInfo& info : actionCatalog()) {
    if (layerOf(info.id) || toolOf(info.id) || info.isHeld) continue;
    connect(action(info.id), &QAction::triggered, this, [this, id = info.id] { trigger(id); });
  }
}

void MainWindow::trigger(ActionId id) {
  if (const auto degree = targetOf(id)) return applyTarget(*degree);
  switch (id) {
    case ActionId::NewDrawing:
      return newDrawing();
    case ActionId::Pin:
      return session_.pinned() ? session_.unpin() : session_.pin();
    case ActionId::OpenScan:
      return chooseScan();
    case ActionId::ImportCurves:
      return chooseImport();
    case ActionId::PasteScan:
      return pasteScan();
    case ActionId::OpenRecipe:
      return chooseRecipe();
    case ActionId::SaveRecipe:
      return void(saveRecipe());
    case ActionId::SaveRecipeAs:
      return void(saveRecipeAs());
    case ActionId::Export:
      return setStage(PanelStage::Export);
    case ActionId::CopySvg:
      return parts_->exportPanel->copy();
    case ActionId::ReverseCurve:
      return reverseCurve(session_, session_.selectedCurve());
    case ActionId::Quit:
      return void(close());
    case ActionId::Undo:
      return stepBack(true);
    case ActionId::Redo:
      return stepBack(false);
    case ActionId::NextCurve:
      return walkCurves(1);
    case ActionId::PreviousCurve:
      return walkCurves(-1);
    case ActionId::CancelWork:
      leaveProblem();
      return session_.cancel();
    case ActionId::ComputeAgain:
      return session_.computeAgain();
    case ActionId::FindAction:
      return findAction();
    case ActionId::ZoomFit:
      return parts_->canvas->zoomFit();
    case ActionId::ZoomActual:
      return parts_->canvas->zoomActual();
    case ActionId::ZoomIn:
      return parts_->canvas->zoomBy(1.25);
    case ActionId::ZoomOut:
      return parts_->canvas->zoomBy(0.8);
    case ActionId::ClearRegions:
      return clearRegions(session_);
    default:
      return;
  }
}

// A digit that slips changes nothing where nobody sees it.
void MainWindow::applyTarget(int degree) {
  if (isLowerWanted()) return chooseTarget(session_, targetOfDegree(degree));
  parts_->status->showMessage(tr("Targets are applied where they are shown: in Curves and Fairing, or after P."));
}

// While edges are worked on, gaps that were bridged are shown, and of merged strokes the room within which they lay.
// Only a new reason shows them: what the user hides stays so, of bridges also when the stage is left and entered again.
void MainWindow::showStrokes(bool isEntering) {
  using For = Parts::StrokesFor;
  const auto& lines = session_.output().contours;
  const bool isBridging = lines && bridgeCount(*lines) > 0 && !parts_->hidesBridges;
  const For now = session_.recipe().edges.mergeWidths > 0.0 || session_.recipe().edges.intent ? For::Merges
                  : isBridging                                                                ? For::Bridges
                                                                                              : For::Nothing;
  const For before = std::exchange(parts_->strokesFor, now);
  if (stage() != PanelStage::Edges || (now == before && !isEntering)) return;
  showHere(Layer::Strokes, now != For::Nothing);
}

// What the user has switched on himself is not switched off.
void MainWindow::showHere(Layer layer, bool on) {
  const auto is = [layer](const Parts::StageLayer& one) { return one.layer == layer; };
  const bool switched = std::any_of(parts_->stageLayers.begin(), parts_->stageLayers.end(), is);
  if (on && !view_.isVisible(layer)) {
    parts_->stageLayers.push_back({layer, false, true});
    view_.setVisible(layer, true);
  } else if (!on && switched) {
    std::erase_if(parts_->stageLayers, is);
    view_.setVisible(layer, false);
  }
}

// A factor that is moved shows what it does, with or without the tick.
void MainWindow::showLog() {
  const LogParams now = session_.recipe().log, before = std::exchange(parts_->log, now);
  if (!(now == before)) showHere(Layer::LogImage, now.enabled || now.factor != before.factor);
}

// A rounding is seen on the curve as it will be exported; without one that would only hide the sketched one.
void MainWindow::showRoundings() {
  const auto& marks = session_.recipe().cornerMarks;
  const bool isRounding =
      std::any_of(marks.begin(), marks.end(), [](const CornerMark& mark) { return mark.roundMm > 0.0; });
  const auto entry = std::find_if(parts_->stageLayers.begin(), parts_->stageLayers.end(),
                                  [](const Parts::StageLayer& one) { return one.layer == Layer::Faired; });
  // Without an entry the user has switched the layer himself.
  if (entry == parts_->stageLayers.end()) return;
  entry->during = isRounding;
  view_.setVisible(Layer::Faired, isRounding);
}

void MainWindow::connectLayers() {
  connect(&session_, &EditorSession::recipeChanged, this, [this] {
    showStrokes(false);
    if (stage() == PanelStage::Corners) showRoundings();
    if (stage() == PanelStage::Scan) showLog();
  });
  connect(&session_, &EditorSession::stageReady, this, [this](StageId ready) {
    if (ready == StageId::Contours) showStrokes(false);
  });
  const auto follow = [this] {
    for (const Layer layer : kLayers) action(showAction(layer))->setChecked(view_.isVisible(layer));
    session_.setEdgesWanted(view_.isVisible(Layer::Edges));
  };
  for (const Layer layer : kLayers) {
    connect(action(showAction(layer)), &QAction::triggered, this, [this, layer](bool on) { view_.choose(layer, on); });
  }
  connect(&view_, &ViewSettings::chosen, this, [this](Layer layer) {
    std::erase_if(parts_->stageLayers, [layer](const Parts::StageLayer& one) { return one.layer == layer; });
    // Told before the layer is switched: what is visible now is being hidden.
    if (layer == Layer::Strokes && view_.isVisible(layer)) parts_->hidesBridges = true;
  });
  for (const Tool tool : kTools)
    connect(action(toolAction(tool)), &QAction::triggered, this, [this, tool] {
      // What the pen draws, and which line is meant, can only be seen where curves are shown.
      if (tool == Tool::Pen && !view_.isVisible(Layer::Curve)) setStage(PanelStage::Edges);
      if (tool == Tool::Junctions || tool == Tool::Paint) setStage(PanelStage::Edges);
      if (tool == Tool::Scale || tool == Tool::Sheet || tool == Tool::Ink) setStage(PanelStage::Scan);
      if (tool == Tool::Direction && !view_.isVisible(Layer::Curve) && !view_.isVisible(Layer::Faired))
        setStage(PanelStage::Export);
      if (tool == Tool::Lines && !view_.isVisible(Layer::Curve) && !view_.isVisible(Layer::Faired))
        setStage(PanelStage::Curves);
      view_.setTool(tool);
    });
  connect(&view_, &ViewSettings::changed, this, follow);
  connect(&view_, &ViewSettings::toolChanged, this, [this](Tool tool) {
    action(toolAction(tool))->setChecked(true);
    const bool areCurvesShown = view_.isVisible(Layer::Curve) || view_.isVisible(Layer::Faired);
    if (tool == usualTool(stage()))
      parts_->status->setStageHint(stageHint());
    else if (tool == Tool::Select && !areCurvesShown)
      parts_->status->setStageHint(tr("No curves are shown in this stage."));
    else
      parts_->status->setStageHint(actionInfo(toolAction(tool)).help);
  });
  action(toolAction(view_.tool()))->setChecked(true);
  follow();
}

void MainWindow::refreshActions() {
  QUndoStack& undo = *session_.undoStack();
  const auto allow = [this](ActionId id, bool isPossible, const QString& whyNot) {
    action(id)->setEnabled(isPossible);
    setWhyNot(*action(id), whyNot);
  };
  const auto describe = [&](ActionId id, const QString& verb, const QString& what, bool isPossible,
                            const QString& whyNot) {
    allow(id, isPossible, whyNot);
    action(id)->setText(what.isEmpty() ? verb : verb + QStringLiteral(": ") + what);
  };
  describe(ActionId::Undo, tr("Undo"), undo.undoText(), undo.canUndo(), tr("Nothing to undo."));
  describe(ActionId::Redo, tr("Redo"), undo.redoText(), undo.canRedo(), tr("Nothing was undone."));
  for (const ActionId id :
       {ActionId::ToolPen, ActionId::ToolScale, ActionId::SaveRecipe, ActionId::SaveRecipeAs, ActionId::Export,
        ActionId::ZoomFit, ActionId::ZoomActual, ActionId::ZoomIn, ActionId::ZoomOut})
    allow(id, session_.hasScan(), tr("Needs an open drawing."));
  allow(ActionId::ClearRegions, !session_.recipe().regions.empty(), tr("No region is drawn."));
  const bool curves = !session_.curves().empty();
  const QString noCurves = tr("Needs a curve; there is none yet.");
  for (const ActionId id : {ActionId::NextCurve, ActionId::PreviousCurve, ActionId::CopySvg, ActionId::ToolDirection})
    allow(id, curves, noCurves);
  allow(ActionId::ReverseCurve, session_.selected() != nullptr, tr("No curve is selected."));
  allow(ActionId::Pin, curves || session_.pinned(), noCurves);
  action(ActionId::Pin)->setChecked(session_.pinned() != nullptr);
  for (int degree = 1; degree <= kMostTargetDegree; ++degree)
    allow(static_cast<ActionId>(static_cast<int>(ActionId::Target1) + degree - 1), curves, noCurves);
  allow(ActionId::CancelWork, session_.isWorking() || !parts_->errors->isHidden(), tr("Nothing is running."));
  allow(ActionId::ComputeAgain, session_.isStopped(), tr("Nothing was stopped."));
}

void MainWindow::findAction() {
  QList<QAction*> all;
  for (const ActionInfo& info : actionCatalog())
    if (!info.isHeld && info.id != ActionId::FindAction) all.append(action(info.id));
  parts_->finder->open(all + parts_->ownActions + parts_->settings->actions());
}

void MainWindow::walkCurves(int step) {
  const int count = static_cast<int>(session_.curves().size());
  const auto now = session_.selectedCurve();
  if (count == 0) return;
  // None selected: the first, or the last.
  session_.selectCurve(now ? (*now + step + count) % count : step > 0 ? 0 : count - 1);
}

// What a step changed may lie in another stage, where nobody looks: it is named, and one press away.
void MainWindow::stepBack(bool isUndo) {
  QUndoStack& stack = *session_.undoStack();
  const QString what = isUndo ? stack.undoText() : stack.redoText();
  const Recipe before = session_.recipe();
  const SuggestionSettings suggestedBy = suggestionSettings(view_);
  isUndo ? stack.undo() : stack.redo();
  auto changed = stageOfChange(before, session_.recipe());
  if (!changed && !(suggestedBy == suggestionSettings(view_))) changed = PanelStage::Corners;
  if (!changed) return;
  if (*changed == stage())
    return parts_->status->showMessage((isUndo ? tr("Undone: %1.") : tr("Redone: %1.")).arg(what));
  const QString text = isUndo ? tr("Undone in %1: %2.") : tr("Redone in %1: %2.");
  parts_->status->showMessage(text.arg(label(*changed), what), tr("Show"), [this, to = *changed] { setStage(to); });
}

void MainWindow::showHelp(const QString& page) {
  if (!parts_->help) parts_->help = new HelpWindow(this);
  parts_->help->open(page);
}

}  // namespace batten
