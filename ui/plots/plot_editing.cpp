// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/plot_editing.h"

#include <qcustomplot.h>

#include <QApplication>
#include <QMenu>
#include <algorithm>
#include <cmath>

#include "ui/session/edits/fairing_edits.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

// of the mouse, for points, splits and the line
constexpr double kReachPx = 9.0, kSplitReachPx = 5.0, kLineReachPx = 6.0;

}  // namespace

PlotEditing::PlotEditing(EditorSession& session, QCustomPlot* plot, QObject* parent)
    : QObject(parent), session_(session), plot_(plot) {
  plot_->installEventFilter(this);
}

bool PlotEditing::isEditable() const {
  return (tab_ == PlotTab::Curvature || tab_ == PlotTab::Radius) && data_.lengthMm > 0 && session_.selected();
}

void PlotEditing::show(const PlotData& data, PlotTab tab) {
  data_ = data;
  tab_ = tab;
  for (QObject* item : items_)
    if (auto* line = qobject_cast<QCPAbstractItem*>(item)) plot_->removeItem(line);
  items_.clear();
  const Theme& theme = themeOf(plot_->palette());
  const auto addGrip = [&](double s, double ratio, int height, const QColor& color) {
    auto* grip = new QCPItemRect(plot_);
    grip->topLeft->setTypeX(QCPItemPosition::ptPlotCoords);
    grip->topLeft->setTypeY(QCPItemPosition::ptAxisRectRatio);
    grip->bottomRight->setParentAnchor(grip->topLeft);
    grip->bottomRight->setType(QCPItemPosition::ptAbsolute);
    grip->topLeft->setCoords(s, ratio);
    grip->bottomRight->setCoords(5, height);
    grip->setPen(Qt::NoPen);
    grip->setBrush(color);
    items_.push_back(grip);
  };
  for (const double s : data.kept) addGrip(s, 1.0, -7, theme.good);
  for (const double s : data.splits) {
    auto* line = new QCPItemStraightLine(plot_);
    line->point1->setCoords(s, 1.0);
    line->point2->setCoords(s, 2.0);
    QPen pen(theme.text, 1);
    pen.setDashPattern({2, 3});
    line->setPen(pen);
    items_.push_back(line);
    addGrip(s, 0.0, 9, theme.text);
  }
  if (data.handles.empty()) return;
  QVector<double> s, value;
  for (const auto& [at, v] : data.handles) s << at, value << v;
  QCPGraph* points = plot_->addGraph();
  points->setData(s, value, true);
  points->setLineStyle(QCPGraph::lsNone);
  points->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(theme.amber, 1.6), QBrush(theme.panel), 8));
}

double PlotEditing::fractionAt(int x) const {
  return std::clamp(plot_->xAxis->pixelToCoord(x) / data_.lengthMm, 0.0, 1.0);
}

double PlotEditing::kappaAt(int y, double signOf) const {
  const double value = plot_->yAxis->pixelToCoord(y);
  if (tab_ == PlotTab::Curvature) return value;
  return std::copysign(1.0 / std::max(std::abs(value), 1e-9), signOf);
}

std::optional<int> PlotEditing::handleAt(const QPoint& position) const {
  std::optional<int> best;
  double nearest = kReachPx;
  for (std::size_t i = 0; i < data_.handles.size(); ++i) {
    const double distance = std::hypot(plot_->xAxis->coordToPixel(data_.handles[i].s) - position.x(),
                                       plot_->yAxis->coordToPixel(data_.handles[i].value) - position.y());
    if (distance < nearest) nearest = distance, best = static_cast<int>(i);
  }
  return best;
}

std::optional<int> PlotEditing::splitAt(const QPoint& position) const {
  std::optional<int> best;
  double nearest = kSplitReachPx;
  for (std::size_t i = 0; i < data_.splits.size(); ++i) {
    const double distance = std::abs(plot_->xAxis->coordToPixel(data_.splits[i]) - position.x());
    if (distance < nearest) nearest = distance, best = static_cast<int>(i);
  }
  return best;
}

bool PlotEditing::isOverAxes(const QPoint& position) const {
  constexpr int kAround = static_cast<int>(kReachPx);  // beside the axes a point can still be taken
  return plot_->axisRect()->rect().adjusted(-kAround, -kAround, kAround, kAround).contains(position);
}

bool PlotEditing::isOnTarget(const QPoint& position) const {
  const double s = plot_->xAxis->pixelToCoord(position.x());
  for (const PlotSeries& series : data_.series) {
    if (series.role != PlotRole::ChosenTarget && series.role != PlotRole::DrawnTarget) continue;
    if (series.points.empty()) continue;
    const double y = plot_->yAxis->coordToPixel(series.at(s));
    if (std::abs(y - position.y()) < kLineReachPx) return true;
  }
  return false;
}

bool PlotEditing::press(const QMouseEvent& event) {
  const QPoint at = event.position().toPoint();
  if (event.button() != Qt::LeftButton || !isOverAxes(at)) return false;
  pressedAt_ = at;
  hasMoved_ = false;
  if (index_ = handleAt(at); index_) {
    dragged_ = Dragged::Handle;
  } else if (index_ = splitAt(at); index_) {
    dragged_ = Dragged::Split;
  } else if (isOnTarget(at)) {
    // The target becomes a drawn one with a point under the mouse.
    std::vector<ProfilePoint> profile = profileToBeginWith(session_);
    const double f = fractionAt(at.x());
    double spacing = 1.0;
    for (std::size_t i = 0; i < profile.size(); ++i) {
      const double distance = std::abs(profile[i].fraction - f);
      if (distance < spacing) spacing = distance, index_ = static_cast<int>(i);
    }
    if (!index_) return false;
    const bool isNear = spacing * plot_->axisRect()->width() < 2.0 * kReachPx;
    if (!isNear) {
      const auto above = std::upper_bound(profile.begin(), profile.end(), f,
                                          [](double x, const ProfilePoint& p) { return x < p.fraction; });
      const double sign = profile[*index_].kappa;
      index_ = static_cast<int>(profile.insert(above, {f, kappaAt(at.y(), sign)}) - profile.begin());
    }
    dragged_ = Dragged::Handle;
    gesture_ = session_.newGesture();
    drawTarget(session_, std::move(profile), gesture_);
    return true;
  } else {
    return false;
  }
  gesture_ = session_.newGesture();
  return true;
}

void PlotEditing::drag(const QPoint& position) {
  hasMoved_ = hasMoved_ || (position - pressedAt_).manhattanLength() >= QApplication::startDragDistance();
  if (!hasMoved_ && dragged_ == Dragged::Split) return;
  if (dragged_ == Dragged::Split) return moveSplit(session_, *index_, fractionAt(position.x()), gesture_);
  std::vector<ProfilePoint> profile = fairingAsked(session_).profile;
  const std::size_t at = index_.value_or(0);
  if (!index_ || at >= profile.size()) return;
  // Points keep their order; the first and last of an open curve stay at its ends.
  const double gap = 1e-3;
  const double low = at == 0 ? 0.0 : profile[at - 1].fraction + gap,
               high = at + 1 == profile.size() ? 1.0 : profile[at + 1].fraction - gap;
  const bool isEnd =
      (at == 0 && profile[at].fraction <= 0.0) || (at + 1 == profile.size() && profile[at].fraction >= 1.0);
  if (!isEnd && low < high) profile[at].fraction = std::clamp(fractionAt(position.x()), low, high);
  const QRect inside = plot_->axisRect()->rect();
  profile[at].kappa = kappaAt(std::clamp(position.y(), inside.top(), inside.bottom()), profile[at].kappa);
  drawTarget(session_, std::move(profile), gesture_);
}

QString PlotEditing::hintAt(const QPoint& position) const {
  if (!isEditable() || !isOverAxes(position)) return {};
  if (handleAt(position)) return tr("Drag the point to shape the target; right-click removes it.");
  if (splitAt(position)) return tr("Drag the split along the curve; click it to join the adjacent spans.");
  if (isOnTarget(position)) return tr("Drag the target to draw your own.");
  return {};
}

bool PlotEditing::move(const QMouseEvent& event) {
  const QPoint at = event.position().toPoint();
  if (isDragging()) {
    drag(at);
    return true;
  }
  const QString text = hintAt(at);
  plot_->setCursor(text.isEmpty()                 ? Qt::ArrowCursor
                   : splitAt(at) && !handleAt(at) ? Qt::SizeHorCursor
                                                  : Qt::PointingHandCursor);
  return false;
}

void PlotEditing::openMenu(const QPoint& position) {
  const double f = fractionAt(position.x());
  auto* menu = new QMenu(plot_);
  menu->setObjectName(QStringLiteral("plot.menu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  const auto add = [menu](const QString& text, const char* name, const auto& act) {
    QAction* action = menu->addAction(text);
    action->setObjectName(QString::fromLatin1(name));
    QObject::connect(action, &QAction::triggered, menu, act);
  };
  const auto split = splitAt(position), handle = handleAt(position);
  if (split) {
    add(tr("Join the spans here"), "plot.removeSplit", [this, at = *split] { joinAtSplit(session_, at); });
  } else {
    add(tr("Split the target here"), "plot.split", [this, f] { addSplit(session_, f); });
  }
  if (!data_.splits.empty()) add(tr("Join all spans"), "plot.removeSplits", [this] { joinAllSpans(session_); });
  if (!hasNaturalSpans(session_))
    add(tr("Natural spans again"), "plot.splitNaturally", [this] { splitNaturally(session_); });
  if (fairingAsked(session_).mode == FairingMode::Monotone) {
    add(tr("Keep the extremum here"), "plot.keep", [this, f] { keepExtremum(session_, f); });
    if (!data_.kept.empty())
      add(tr("Keep extrema by number again"), "plot.keepByNumber", [this] { keepByNumber(session_); });
  }
  menu->addSeparator();
  if (!isTargetDrawn(session_)) {
    add(tr("Draw the target"), "plot.draw", [this] { drawTarget(session_, profileToBeginWith(session_)); });
  } else {
    std::vector<ProfilePoint> profile = profileToBeginWith(session_);
    if (handle && profile.size() > 2) {
      profile.erase(profile.begin() + *handle);
      add(tr("Remove this point"), "plot.removePoint", [this, profile] { drawTarget(session_, profile); });
    } else if (!handle) {
      const auto above = std::upper_bound(profile.begin(), profile.end(), f,
                                          [](double x, const ProfilePoint& p) { return x < p.fraction; });
      profile.insert(above, {f, drawnProfile(profile, session_.selected()->closed).curvatureAt(f)});
      add(tr("Add a point here"), "plot.addPoint", [this, profile] { drawTarget(session_, profile); });
    }
    add(tr("Back to the six targets"), "plot.forget", [this] { forgetDrawnTarget(session_); });
  }
  menu->addSeparator();
  add(tr("Show the whole curve"), "plot.whole", [this] { emit wholeAsked(); });
  menu->popup(plot_->mapToGlobal(position));
}

bool PlotEditing::eventFilter(QObject* watched, QEvent* event) {
  if (watched != plot_ || !isEditable()) return QObject::eventFilter(watched, event);
  switch (event->type()) {
    case QEvent::MouseButtonPress: {
      const auto& mouse = *static_cast<QMouseEvent*>(event);
      if (mouse.button() == Qt::RightButton) {
        openMenu(mouse.position().toPoint());
        return true;
      }
      return press(mouse);
    }
    case QEvent::MouseMove:
      return move(*static_cast<QMouseEvent*>(event));
    case QEvent::MouseButtonRelease:
      if (!isDragging()) break;
      if (dragged_ == Dragged::Split && !hasMoved_) joinAtSplit(session_, *index_);
      dragged_ = Dragged::Nothing;
      index_.reset();
      gesture_.reset();
      return true;
    default:
      break;
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace batten
