// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/curve_plots.h"

#include <qcustomplot.h>

#include <QLabel>
#include <QPainter>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/plots/plot_editing.h"
#include "ui/plots/plot_graphs.h"
#include "ui/plots/plot_head.h"
#include "ui/plots/plot_style.h"
#include "ui/plots/target_labels.h"
#include "ui/plots/value_text.h"
#include "ui/session/view/judged_view.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {
constexpr double kMarkReachPx = 9.0;                                     // how near the mouse has to be to a mark
constexpr int kLeftPx = 54, kTopPx = 18, kRightPx = 16, kBottomPx = 22;  // margins of the axes
constexpr int kLeastPlotPx = 200;  // lower, and neither curve nor targets can be read
constexpr int kGoodAxesPx = 200;   // where there is room
}  // namespace

struct CurvePlots::State {
  State(EditorSession& s, const ViewSettings& v) : session(s), view(v) {}
  EditorSession& session;
  const ViewSettings& view;
  PlotTab tab = PlotTab::Radius;
  PlotData data;
  std::optional<DataKey> dataKey;
  PlotHead* head = nullptr;
  QLabel *empty = nullptr, *quantity = nullptr;
  QCustomPlot* plot = nullptr;
  QCPItemStraightLine* cursor = nullptr;
  std::unique_ptr<TargetLabels> labels;
  QSharedPointer<QCPAxisTicker> linearTicker;
  QSharedPointer<LengthTicker> lengthTicker;
  QSharedPointer<RoundLogTicker> logTicker;
  PlotEditing* editing = nullptr;
  bool isPending = false;
  bool isReversed = false;            ///< By the user, against the way the curve lies on the drawing.
  std::optional<double> shownLength;  ///< None before the first data.
  PlotTab shownTab = PlotTab::Radius;
  std::optional<int> shownCurve;
  Judged shownJudged = Judged::Result;
  bool shownLinear = false;
};

CurvePlots::CurvePlots(EditorSession& session, const ViewSettings& view, QWidget* parent)
    : QWidget(parent), state_(std::make_unique<State>(session, view)) {
  setObjectName(QStringLiteral("plots"));
  build();
  applyTheme();
  for (const auto signal :
       {&EditorSession::scanOpened, &EditorSession::selectionChanged, &EditorSession::targetsChanged,
        &EditorSession::hoverChanged, &EditorSession::runFinished, &EditorSession::recipeChanged})
    connect(&session, signal, this, &CurvePlots::refreshSoon);
  connect(&session, &EditorSession::stageReady, this, [this](StageId stage) {
    if (stage == StageId::Curves || stage == StageId::Faired) refreshSoon();
  });
  connect(&session, &EditorSession::cursorChanged, this, &CurvePlots::showCursor);
  connect(&view, &ViewSettings::changed, this, [this] {
    if (judgedIn(state_->view) != state_->shownJudged || state_->view.radiusIsLinear() != state_->shownLinear)
      refreshSoon();
  });
  connect(&session, &EditorSession::selectionChanged, this, [this] { state_->isReversed = false; });
  refresh();
}

CurvePlots::~CurvePlots() = default;

void CurvePlots::build() {
  State& d = *state_;
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 1, 0, 0);
  layout->setSpacing(0);
  d.head = new PlotHead(this);
  layout->addWidget(d.head);
  connect(d.head, &PlotHead::chosen, this, &CurvePlots::setTab);
  connect(d.head, &PlotHead::reverseAsked, this, &CurvePlots::setReversed);
  d.plot = new QCustomPlot(this);
  d.plot->setObjectName(QStringLiteral("plot"));
  d.plot->setAccessibleName(tr("Plot over arc length of the selected curve"));
  d.plot->setMinimumHeight(kLeastPlotPx);
  d.plot->setAntialiasedElements(QCP::aeAll);
  d.plot->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  d.plot->axisRect()->setRangeDrag(Qt::Horizontal);
  d.plot->axisRect()->setRangeZoom(Qt::Horizontal);
  d.plot->axisRect()->setAutoMargins(QCP::msNone);
  d.plot->axisRect()->setMargins(QMargins(kLeftPx, kTopPx, kRightPx, kBottomPx));
  d.plot->setMouseTracking(true);
  d.plot->installEventFilter(this);
  // Installed last, so asked first.
  d.editing = new PlotEditing(d.session, d.plot, this);
  connect(d.editing, &PlotEditing::wholeAsked, this, &CurvePlots::resetView);
  d.linearTicker = QSharedPointer<PlainTicker>::create();
  d.lengthTicker = QSharedPointer<LengthTicker>::create();
  d.labels = std::make_unique<TargetLabels>(d.plot);
  d.logTicker = QSharedPointer<RoundLogTicker>::create();
  d.plot->xAxis->setTicker(d.lengthTicker);
  d.cursor = new QCPItemStraightLine(d.plot);
  d.cursor->setVisible(false);
  d.cursor->setLayer(QStringLiteral("overlay"));
  layout->addWidget(d.plot, 1);
  const auto overlay = [&d](const QString& text, int pixels, QPoint place) {
    auto* label = new QLabel(text, d.plot);
    label->setFont(uiFont(pixels));
    label->setForegroundRole(QPalette::PlaceholderText);
    label->setAttribute(Qt::WA_TransparentForMouseEvents);
    label->move(place);
    return label;
  };
  d.empty = overlay(tr("Select a curve to see its curvature."), 12, {kLeftPx, kTopPx + 2});
  // In the margin over the axis, where neither curves nor numbers pass.
  d.quantity = overlay({}, 11, {kLeftPx, 1});
  d.quantity->setObjectName(QStringLiteral("plot.quantity"));
  connect(d.plot->xAxis, QOverload<const QCPRange&>::of(&QCPAxis::rangeChanged), this, [this](const QCPRange& range) {
    const double length = state_->data.lengthMm;
    if (!(length > 0)) return;
    QCPRange kept = range.sanitizedForLinScale();
    const double size = std::clamp(kept.size(), length * 1e-3, length);
    kept.lower = std::clamp(kept.lower, 0.0, length - size);
    kept.upper = kept.lower + size;
    if (kept != range) return state_->plot->xAxis->setRange(kept);
    state_->labels->place();
  });
}

PlotTab CurvePlots::tab() const { return state_->tab; }

int CurvePlots::goodHeight() const {
  return minimumSizeHint().height() - kLeastPlotPx + kTopPx + kGoodAxesPx + kBottomPx;
}

void CurvePlots::setTab(PlotTab tab) {
  state_->tab = tab;
  state_->head->setTab(tab);
  refresh();
}

void CurvePlots::setReversed(bool reversed) {
  state_->isReversed = reversed;
  refresh();
}

bool CurvePlots::isReversed() const { return state_->isReversed; }

bool CurvePlots::runsLeft() const { return state_->plot->xAxis->rangeReversed(); }

void CurvePlots::applyTheme() {
  State& d = *state_;
  const Theme& theme = themeOf(palette());
  d.plot->setBackground(theme.panel);
  for (QCPAxis* axis : {d.plot->xAxis, d.plot->yAxis}) {
    axis->setBasePen(Qt::NoPen);
    axis->setTickPen(Qt::NoPen);
    axis->setSubTickPen(Qt::NoPen);
    axis->setTickLabelFont(uiFont(11));
    axis->setTickLabelColor(theme.mute);
    axis->setTickLabelPadding(6);
    axis->grid()->setPen(QPen(theme.line, 1));
    axis->grid()->setZeroLinePen(QPen(theme.mute, 1));
    axis->grid()->setSubGridVisible(false);
    axis->grid()->setAntialiased(false);
  }
  d.plot->xAxis->grid()->setVisible(false);
  QColor line = theme.accent;
  line.setAlphaF(0.6F);
  d.cursor->setPen(QPen(line, 1));
}

void CurvePlots::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() != QEvent::PaletteChange && event->type() != QEvent::StyleChange) return;
  if (!state_->plot) return;
  applyTheme();
  refreshSoon();
}

void CurvePlots::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refreshSoon();
}

void CurvePlots::refreshSoon() {
  if (state_->isPending) return;
  state_->isPending = true;
  QTimer::singleShot(0, this, [this] {
    state_->isPending = false;
    if (isVisible()) refresh();
  });
}

void CurvePlots::refresh() {
  State& d = *state_;
  refreshData();
  showAxes();
  d.plot->clearGraphs();
  drawGraphs(*d.plot, d.data, d.tab, themeOf(palette()));
  d.editing->show(d.data, d.tab);
  refreshView();
  d.labels->show(d.data);
  showCursor();
}

void CurvePlots::refreshData() {
  State& d = *state_;
  // Measuring deviations takes hundreds of nearest points; they only change with the curve.
  const DataKey key{d.session.output().faired, d.session.output().pieces, d.session.selectedCurve(), d.tab,
                    judgedIn(d.view)};
  if (d.tab != PlotTab::Deviation || !d.dataKey || !(*d.dataKey == key))
    d.data = plotData(d.session, d.tab, key.judged, d.view.radiusIsLinear());
  d.shownLinear = d.view.radiusIsLinear();
  d.dataKey = key;
  d.shownJudged = key.judged;
}

void CurvePlots::showAxes() {
  State& d = *state_;
  const bool runsLeft = d.data.runsLeft != d.isReversed;
  const bool isReversedNow = d.plot->xAxis->rangeReversed() != runsLeft;
  d.plot->xAxis->setRangeReversed(runsLeft);
  if (isReversedNow) emit directionChanged(runsLeft);
  d.lengthTicker->setReversed(runsLeft);
  d.head->setReversed(d.isReversed);
  d.empty->setVisible(d.data.isEmpty());
  d.empty->setText(d.session.curves().empty() ? tr("No curve yet.") : tr("Select a curve to see its curvature."));
  d.empty->adjustSize();
  d.plot->xAxis->setVisible(!d.data.isEmpty());
  d.plot->yAxis->setVisible(!d.data.isEmpty());
  d.plot->yAxis->setScaleType(d.data.logarithmic ? QCPAxis::stLogarithmic : QCPAxis::stLinear);
  d.plot->yAxis->setTicker(d.data.logarithmic ? QSharedPointer<QCPAxisTicker>(d.logTicker) : d.linearTicker);
  d.quantity->setVisible(!d.data.isEmpty());
  d.quantity->setText(quantityText(d.tab));
  d.quantity->adjustSize();
}

void CurvePlots::refreshView() {
  State& d = *state_;
  const double before = d.shownLength.value_or(0.0);
  const bool sameView = d.shownLength && d.shownTab == d.tab && d.shownCurve == d.session.selectedCurve() &&
                        std::abs(before - d.data.lengthMm) < 0.2 * before;
  const QCPRange shown = d.plot->xAxis->range();
  const bool wasWhole = shown.lower <= 0.0 && std::abs(shown.upper - before) < 1e-6 * before;
  d.shownTab = d.tab;
  d.shownCurve = d.session.selectedCurve();
  d.shownLength = d.data.lengthMm;
  // While a point is dragged the axes stay, or it would run away from the mouse.
  if (sameView && d.editing->isDragging())
    d.plot->replot(QCustomPlot::rpQueuedReplot);
  else if (sameView && !wasWhole)
    d.plot->yAxis->setRange(d.data.low, d.data.high);
  else
    resetView();
}

const ExtremumMark* CurvePlots::markAt(const QPointF& place) const {
  const State& d = *state_;
  const ExtremumMark* best = nullptr;
  double least = kMarkReachPx;
  for (const ExtremumMark& mark : d.data.marks) {
    const double distance = std::hypot(d.plot->xAxis->coordToPixel(mark.s) - place.x(),
                                       d.plot->yAxis->coordToPixel(mark.kappa) - place.y());
    if (distance > least) continue;
    least = distance;
    best = &mark;
  }
  return best;
}

QPointF CurvePlots::markPlace(int note) const {
  for (const ExtremumMark& mark : state_->data.marks)
    if (mark.note == note)
      return {state_->plot->xAxis->coordToPixel(mark.s), state_->plot->yAxis->coordToPixel(mark.kappa)};
  return {-1.0, -1.0};
}

std::pair<double, double> CurvePlots::shownLengths() const {
  const QCPRange range = state_->plot->xAxis->range();
  return {range.lower, range.upper};
}

void CurvePlots::resetView() {
  State& d = *state_;
  if (d.data.isEmpty()) return;
  d.plot->xAxis->setRange(0, d.data.lengthMm);
  d.plot->yAxis->setRange(d.data.low, d.data.high);
  d.plot->replot(QCustomPlot::rpQueuedReplot);
}

void CurvePlots::showCursor() {
  State& d = *state_;
  const auto s = d.session.cursor();
  const bool isShown = s.has_value() && !d.data.isEmpty();
  d.cursor->setVisible(isShown);
  if (isShown) {
    d.cursor->point1->setCoords(*s, d.data.low);
    d.cursor->point2->setCoords(*s, d.data.high);
  }
  const TracedCurve* curve = d.session.selected();
  d.head->setValue(isShown && curve ? valueText(d.data, d.tab, *s, judgedCurve(*curve, judgedIn(d.view))) : QString());
  d.plot->replot(QCustomPlot::rpQueuedReplot);
}

bool CurvePlots::eventFilter(QObject* watched, QEvent* event) {
  State& d = *state_;
  if (watched == d.plot && !d.data.isEmpty()) {
    if (event->type() == QEvent::MouseMove) {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      const double s = d.plot->xAxis->pixelToCoord(mouse->position().x());
      d.session.setCursor(s >= 0 && s <= d.data.lengthMm ? std::optional(s) : std::nullopt);
      const ExtremumMark* mark = markAt(mouse->position());
      d.plot->setToolTip(mark ? mark->text : QString());
      const QString editing = d.editing->hintAt(mouse->position().toPoint());
      if (mark || editing.isEmpty()) d.plot->setCursor(mark && mark->note ? Qt::PointingHandCursor : Qt::ArrowCursor);
      const QString otherwise =
          tr("The cursor marks the same point on the drawing. The wheel zooms, dragging pans, "
             "double-click shows all, right-click edits the target.");
      emit hint(mark ? mark->text : !editing.isEmpty() ? editing : otherwise);
    }
    if (event->type() == QEvent::MouseButtonPress) {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      const ExtremumMark* mark = mouse->button() == Qt::LeftButton ? markAt(mouse->position()) : nullptr;
      if (mark && mark->note) {
        toggleExtremum(d.session, d.session.selectedCurve(), *mark->note);
        return true;
      }
    }
    if (event->type() == QEvent::Leave) {
      d.session.setCursor(std::nullopt);
      emit hint({});
    }
    if (event->type() == QEvent::MouseButtonDblClick) resetView();
  }
  return QWidget::eventFilter(watched, event);
}

void CurvePlots::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.fillRect(rect(), theme.panel);
  painter.fillRect(0, 0, width(), 1, theme.line);
}

}  // namespace batten
