// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/curve_plots.h"

#include <qcustomplot.h>

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/plots/plot_editing.h"
#include "ui/plots/plot_style.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {
constexpr double kMarkReachPx = 9.0;  // how near the mouse has to be to a mark
}

struct CurvePlots::State {
  explicit State(EditorSession& s) : session(s) {}
  EditorSession& session;
  PlotTab tab = PlotTab::Radius;
  PlotData data;
  std::optional<DataKey> dataKey;
  QButtonGroup* tabs = nullptr;
  QLabel* value = nullptr;
  QLabel *empty = nullptr, *quantity = nullptr;
  QCustomPlot* plot = nullptr;
  QCPItemStraightLine* cursor = nullptr;
  QSharedPointer<QCPAxisTicker> linearTicker;
  QSharedPointer<RoundLogTicker> logTicker;
  PlotEditing* editing = nullptr;
  bool isPending = false;
  double shownLength = -1.0;
  PlotTab shownTab = PlotTab::Radius;
  int shownCurve = -2;
};

CurvePlots::CurvePlots(EditorSession& session, QWidget* parent)
    : QWidget(parent), state_(std::make_unique<State>(session)) {
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
  refresh();
}

CurvePlots::~CurvePlots() = default;

QLayout* CurvePlots::makeHead() {
  State& d = *state_;
  auto* head = new QHBoxLayout;
  head->setContentsMargins(4, 2, 14, 0);
  head->setSpacing(2);
  d.tabs = new QButtonGroup(this);
  const struct {
    QString text, name, help;
  } tabs[] = {
      {tr("Radius over arc length"), QStringLiteral("plot.radius"),
       tr("Radius of curvature in mm, logarithmic; straight stretches are cut off at the top.")},
      {tr("Curvature"), QStringLiteral("plot.curvature"),
       tr("Signed curvature, 1/mm: positive where the curve turns left. The band is what the scan leaves open.")},
      {tr("Derivative"), QStringLiteral("plot.derivative"),
       tr("Magnitude of the first derivative: even is good parametrisation.")},
      {tr("Deviation"), QStringLiteral("plot.deviation"),
       tr("Distance of the scan's edge points and of the faired curve from the sketched curve, in mm.")}};
  for (int i = 0; i < 4; ++i) {
    auto* button = new QToolButton(this);
    button->setText(tabs[i].text);
    button->setObjectName(tabs[i].name);
    button->setToolTip(tabs[i].help);
    button->setAccessibleName(tabs[i].text);
    button->setCheckable(true);
    button->setProperty("tab", true);
    button->setFocusPolicy(Qt::TabFocus);
    // Wide enough for the bold state, so that the row does not jump.
    button->setMinimumWidth(QFontMetrics(uiFont(12, QFont::DemiBold)).horizontalAdvance(tabs[i].text) + 16);
    d.tabs->addButton(button, i);
    head->addWidget(button);
  }
  d.tabs->button(0)->setChecked(true);
  connect(d.tabs, &QButtonGroup::idClicked, this, [this](int id) { setTab(static_cast<PlotTab>(id)); });
  head->addStretch();
  d.value = new QLabel(this);
  d.value->setFont(uiFont(12));
  d.value->setForegroundRole(QPalette::PlaceholderText);
  head->addWidget(d.value);
  return head;
}

void CurvePlots::build() {
  State& d = *state_;
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 1, 0, 0);
  layout->setSpacing(0);
  layout->addLayout(makeHead());
  d.plot = new QCustomPlot(this);
  d.plot->setObjectName(QStringLiteral("plot"));
  d.plot->setAccessibleName(tr("Plot over arc length of the selected curve"));
  d.plot->setMinimumHeight(60);
  d.plot->setAntialiasedElements(QCP::aeAll);
  d.plot->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  d.plot->axisRect()->setRangeDrag(Qt::Horizontal);
  d.plot->axisRect()->setRangeZoom(Qt::Horizontal);
  d.plot->axisRect()->setAutoMargins(QCP::msNone);
  d.plot->axisRect()->setMargins(QMargins(54, 6, 16, 22));
  d.plot->setMouseTracking(true);
  d.plot->installEventFilter(this);
  // Installed last, so asked first.
  d.editing = new PlotEditing(d.session, d.plot, this);
  connect(d.editing, &PlotEditing::wholeAsked, this, &CurvePlots::resetView);
  d.linearTicker = QSharedPointer<QCPAxisTicker>::create();
  d.linearTicker->setTickCount(4);
  d.logTicker = QSharedPointer<RoundLogTicker>::create();
  d.plot->xAxis->setTicker(QSharedPointer<LengthTicker>::create());
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
  d.empty = overlay(tr("Select a curve to see its curvature."), 12, {54, 8});
  d.quantity = overlay({}, 11, {56, 3});
  d.quantity->setObjectName(QStringLiteral("plot.quantity"));
  // Curves and grid pass behind the name of the axis.
  d.quantity->setAutoFillBackground(true);
  d.quantity->setBackgroundRole(QPalette::Base);
  d.quantity->setContentsMargins(2, 0, 4, 0);
  connect(d.plot->xAxis, QOverload<const QCPRange&>::of(&QCPAxis::rangeChanged), this, [this](const QCPRange& range) {
    const double length = state_->data.lengthMm;
    if (!(length > 0)) return;
    QCPRange kept = range.sanitizedForLinScale();
    const double size = std::clamp(kept.size(), length * 1e-3, length);
    kept.lower = std::clamp(kept.lower, 0.0, length - size);
    kept.upper = kept.lower + size;
    if (kept != range) state_->plot->xAxis->setRange(kept);
  });
}

PlotTab CurvePlots::tab() const { return state_->tab; }

void CurvePlots::setTab(PlotTab tab) {
  state_->tab = tab;
  state_->tabs->button(static_cast<int>(tab))->setChecked(true);
  refresh();
}

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
  const Theme& theme = themeOf(palette());
  // Measuring deviations takes hundreds of nearest points; they only change with the curve.
  const DataKey key{d.session.output().faired, d.session.output().pieces, d.session.selectedCurve(), d.tab};
  if (d.tab != PlotTab::Deviation || !d.dataKey || !(*d.dataKey == key)) d.data = plotData(d.session, d.tab);
  d.dataKey = key;
  d.plot->clearGraphs();
  d.empty->setVisible(d.data.isEmpty());
  d.empty->setText(d.session.curves().empty() ? tr("No curve yet.") : tr("Select a curve to see its curvature."));
  d.empty->adjustSize();
  d.plot->xAxis->setVisible(!d.data.isEmpty());
  d.plot->yAxis->setVisible(!d.data.isEmpty());
  d.plot->yAxis->setScaleType(d.data.logarithmic ? QCPAxis::stLogarithmic : QCPAxis::stLinear);
  d.plot->yAxis->setTicker(d.data.logarithmic ? QSharedPointer<QCPAxisTicker>(d.logTicker) : d.linearTicker);
  d.plot->yAxis->setNumberFormat(QStringLiteral("g"));
  d.plot->yAxis->setNumberPrecision(3);
  d.quantity->setVisible(!d.data.isEmpty());
  d.quantity->setText(quantityText(d.tab));
  d.quantity->adjustSize();
  addBand();
  for (const PlotSeries& series : d.data.series) {
    QCPGraph* graph = d.plot->addGraph();
    graph->setData(QVector<double>(series.s.begin(), series.s.end()),
                   QVector<double>(series.value.begin(), series.value.end()), true);
    graph->setPen(penOf(series.role, theme));
    if (series.role == PlotRole::Joint) {
      graph->setLineStyle(QCPGraph::lsNone);
      graph->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDisc, theme.text, theme.panel, 5.0));
    }
    graph->setAntialiased(true);
  }
  addMarks();
  d.editing->show(d.data, d.tab);
  const bool sameView = d.shownTab == d.tab && d.shownCurve == d.session.selectedCurve() &&
                        std::abs(d.shownLength - d.data.lengthMm) < 0.2 * std::abs(d.shownLength);
  const QCPRange shown = d.plot->xAxis->range();
  const bool wasWhole = shown.lower <= 0.0 && std::abs(shown.upper - d.shownLength) < 1e-6 * d.shownLength;
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
  showCursor();
}

void CurvePlots::addBand() {
  State& d = *state_;
  const Theme& theme = themeOf(palette());
  if (d.data.bandS.size() < 2) return;
  QCPGraph* low = d.plot->addGraph();
  QCPGraph* high = d.plot->addGraph();
  const auto vector = [](const std::vector<double>& v) { return QVector<double>(v.begin(), v.end()); };
  low->setData(vector(d.data.bandS), vector(d.data.bandLow), true);
  high->setData(vector(d.data.bandS), vector(d.data.bandHigh), true);
  low->setPen(Qt::NoPen);
  high->setPen(Qt::NoPen);
  QColor fill = theme.mute;
  fill.setAlphaF(0.18F);
  high->setBrush(fill);
  high->setChannelFillGraph(low);
}

void CurvePlots::addMarks() {
  State& d = *state_;
  const Theme& theme = themeOf(palette());
  for (const ExtremumMark& mark : d.data.marks) {
    QColor faint = theme.accent;
    faint.setAlphaF(0.4F);
    const QColor line = mark.wantedToKeep ? theme.amber : mark.isKept ? theme.accent : theme.mute;
    const QColor fill = !mark.isKept ? theme.panel : mark.isCertain ? theme.accent : faint;
    QCPGraph* graph = d.plot->addGraph();
    graph->setData({mark.s}, {mark.kappa}, true);
    graph->setLineStyle(QCPGraph::lsNone);
    graph->setScatterStyle(
        QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(line, mark.wantedToKeep ? 2.2 : 1.5), fill, 9));
    graph->setAntialiasedScatters(true);
  }
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
  d.cursor->setVisible(s.has_value() && !d.data.isEmpty());
  d.value->clear();
  if (s && !d.data.isEmpty()) {
    d.cursor->point1->setCoords(*s, d.data.low);
    d.cursor->point2->setCoords(*s, d.data.high);
    QString text = tr("s %1 mm").arg(*s, 0, 'f', 1);
    for (const PlotRole role : {PlotRole::Faired, PlotRole::Sketched}) {
      const auto series = std::find_if(d.data.series.begin(), d.data.series.end(),
                                       [role](const PlotSeries& one) { return one.role == role; });
      if (series == d.data.series.end()) continue;
      const auto at = std::lower_bound(series->s.begin(), series->s.end(), *s);
      const auto i = std::min<std::size_t>(static_cast<std::size_t>(at - series->s.begin()), series->s.size() - 1);
      const QString number = QString::number(series->value[i], 'g', 4);
      switch (d.tab) {
        case PlotTab::Radius:
          text += tr(" · R %1 mm").arg(number);
          break;
        case PlotTab::Curvature:
          text += tr(" · κ %1 /mm").arg(number);
          break;
        case PlotTab::Derivative:
          text += tr(" · |R'| %1").arg(number);
          break;
        case PlotTab::Deviation:
          text += tr(" · %1 mm").arg(number);
          break;
      }
      break;
    }
    d.value->setText(text);
  }
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
      if (mark || editing.isEmpty()) d.plot->setCursor(mark ? Qt::PointingHandCursor : Qt::ArrowCursor);
      const QString otherwise =
          tr("The cursor is the same place on the drawing. Wheel zooms, drag pans, double click shows all, right click "
             "edits the target.");
      emit hint(mark ? mark->text : !editing.isEmpty() ? editing : otherwise);
    }
    if (event->type() == QEvent::MouseButtonPress) {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      const ExtremumMark* mark = mouse->button() == Qt::LeftButton ? markAt(mouse->position()) : nullptr;
      if (mark) {
        toggleExtremum(d.session, d.session.selectedCurve(), mark->note);
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
