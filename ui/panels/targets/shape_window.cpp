// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/targets/shape_window.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QScreen>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/curve/curvature.h"
#include "core/fairing/profile/target_degrees.h"
#include "core/fairing/target_advice.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/segmented_control.h"
#include "ui/panels/targets/shape_view.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/edits/fairing_edits.h"
#include "ui/theme/minus_sign.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

QString number(double value, int decimals) { return withMinusSign(QString::number(value, 'f', decimals)); }

}  // namespace

ShapeWindow::ShapeWindow(EditorSession& session, QWidget* parent)
    : QDialog(parent),
      session_(session),
      first_(new QComboBox(this)),
      second_(new QComboBox(this)),
      quantity_(new SegmentedControl({tr("Radius"), tr("Curvature")}, this)),
      view_(new ShapeView(this)),
      figures_(new FigureTable(this)),
      table_(new FigureTable(this)),
      way_(note({}, this)),
      recommendation_(note({}, this)) {
  recommendation_->setObjectName(QStringLiteral("shapes.recommendation"));
  setObjectName(QStringLiteral("shapes"));
  setWindowTitle(tr("Compare shapes"));
  setMinimumWidth(548);
  first_->setObjectName(QStringLiteral("shapes.first"));
  second_->setObjectName(QStringLiteral("shapes.second"));
  first_->setAccessibleName(tr("First curve"));
  second_->setAccessibleName(tr("Second curve"));
  quantity_->setNames(QStringLiteral("shapes.quantity"), {QStringLiteral("radius"), QStringLiteral("curvature")});
  quantity_->setCurrent(0);
  figures_->setObjectName(QStringLiteral("shapes.figures"));
  table_->setObjectName(QStringLiteral("shapes.table"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(16, 14, 16, 16);
  layout->setSpacing(8);
  auto* choice = new QHBoxLayout;
  choice->setSpacing(8);
  choice->addWidget(first_, 1);
  choice->addWidget(new QLabel(tr("and"), this));
  choice->addWidget(second_, 1);
  layout->addLayout(choice);
  layout->addWidget(quantity_);
  layout->addWidget(view_, 1);
  layout->addWidget(way_);
  layout->addWidget(figures_);
  layout->addSpacing(6);
  layout->addWidget(caption(tr("Fairness of the selected curve"), this));
  layout->addWidget(table_);
  layout->addWidget(recommendation_);
  figures_->setHeader({}, {tr("radius"), tr("curvature")});
  table_->setHeader(tr("profile"), {tr("S"), tr("r"), tr("rms, %"), tr("needs, mm"), tr("extrema"), tr("AICc")});
  connect(first_, &QComboBox::currentIndexChanged, this, &ShapeWindow::compare);
  connect(second_, &QComboBox::currentIndexChanged, this, &ShapeWindow::compare);
  connect(quantity_, &SegmentedControl::chosen, this, [this](int index) {
    quantity_->setCurrent(index);
    compare();
  });
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::recipeChanged, &EditorSession::selectionChanged,
                            &EditorSession::targetsChanged, &EditorSession::runFinished})
    connect(&session_, signal, this, [this] {
      if (isVisible()) refill();
    });
}

void ShapeWindow::showEvent(QShowEvent* event) {
  QDialog::showEvent(event);
  refill();
}

std::vector<ShapeWindow::Entry> ShapeWindow::entries() const {
  std::vector<Entry> all;
  const auto curves = session_.curves();
  for (int i = 0; i < std::ssize(curves); ++i) {
    const TracedCurve& curve = curves[i];
    if (curve.sketched.isEmpty()) continue;
    all.push_back({Entry::Kind::Sketched, i});
    if (!curve.faired.isEmpty() && curve.fairingUsed.mode != FairingMode::None) all.push_back({Entry::Kind::Faired, i});
  }
  if (const auto targets = session_.targets(); targets && session_.selected()) {
    for (const TargetProfile& profile : targets->targets.profiles)
      if (profile.valid) all.push_back({Entry::Kind::Target, profile.degree});
  }
  return all;
}

QString ShapeWindow::nameOf(const Entry& entry) const {
  switch (entry.kind) {
    case Entry::Kind::Sketched:
      return tr("%1, sketched").arg(curveName(session_, entry.number));
    case Entry::Kind::Faired:
      return tr("%1, faired").arg(curveName(session_, entry.number));
    case Entry::Kind::Target:
      return tr("Target %1, %2").arg(entry.number).arg(degreeName(entry.number));
  }
  return {};
}

ShapeProfile ShapeWindow::profileOf(const Entry& entry) const {
  const TracedCurve* selected = session_.selected();
  if (entry.kind == Entry::Kind::Target) {
    const auto targets = session_.targets();
    if (!targets || !selected) return {};
    return shapeProfile(targets->targets.profiles[entry.number - 1], selected->closed,
                        selected->sketchedFigures.lengthMm, extent(selected->sketched));
  }
  const auto curves = session_.curves();
  if (entry.number < 0 || entry.number >= std::ssize(curves)) return {};
  const TracedCurve& curve = curves[entry.number];
  return shapeProfile(entry.kind == Entry::Kind::Faired ? curve.faired : curve.sketched, curve.closed);
}

void ShapeWindow::refill() {
  const auto chosen = [this](const QComboBox* box) {
    const int index = box->currentIndex();
    return index >= 0 && index < std::ssize(entries_) ? std::optional(entries_[index]) : std::nullopt;
  };
  const auto first = chosen(first_), second = chosen(second_);
  entries_ = entries();
  const auto targets = session_.targets();
  const Entry selected{Entry::Kind::Sketched, session_.selectedCurve().value_or(0)};
  const Entry recommended{Entry::Kind::Target, targets ? targets->recommendedDegree.value_or(0) : 0};
  const auto fill = [this](QComboBox* box, const std::optional<Entry>& kept, const Entry& otherwise) {
    const QSignalBlocker quiet(box);
    box->clear();
    for (const Entry& entry : entries_) box->addItem(nameOf(entry));
    auto at = kept ? std::find(entries_.begin(), entries_.end(), *kept) : entries_.end();
    if (at == entries_.end()) at = std::find(entries_.begin(), entries_.end(), otherwise);
    box->setCurrentIndex(at == entries_.end() ? (entries_.empty() ? -1 : 0) : static_cast<int>(at - entries_.begin()));
  };
  fill(first_, first, selected);
  fill(second_, second, recommended);
  compare();
  refreshTable();
  fitHeight();
}

// Notes that wrap ask for more height than the layout's smallest size, which counts them as one line.
void ShapeWindow::fitHeight() {
  constexpr int kFramePx = 48;  // of title bar and frame, on any desktop
  const int room = screen()->availableGeometry().height() - kFramePx;
  const int needed = std::min(layout()->totalHeightForWidth(width()), room);
  if (height() < needed) resize(width(), needed);
}

void ShapeWindow::compare() {
  const int a = first_->currentIndex(), b = second_->currentIndex();
  if (a < 0 || b < 0 || std::max(a, b) >= std::ssize(entries_)) {
    view_->show({}, true);
    figures_->setRows({{tr("No curve yet"), {{QStringLiteral("–")}, {QStringLiteral("–")}}, {}}});
    return;
  }
  const ShapeComparison found = compareShapes(profileOf(entries_[a]), profileOf(entries_[b]));
  view_->show(found, quantity_->current() != 1);
  QStringList ways;
  if (found.mirrored) ways << tr("mirrored");
  if (found.reversed) ways << tr("reversed");
  if (found.shift > 0) ways << tr("with another start point");
  figures_->setRows({{tr("Similarity S"),
                      {{number(found.similarity, 4)}, {number(found.curvatureSimilarity, 4)}},
                      tr("1 is the same shape, independent of size, position and rotation. Any two curves that "
                         "bend to one side come close to 1, so check r too.")},
                     {tr("Pearson r"),
                      {{number(found.pearson, 4)}, {number(found.curvaturePearson, 4)}},
                      tr("The same after subtracting the means: 0 is no correlation, -1 the opposite profile.")}});
  way_->setText(
      ways.isEmpty()
          ? tr("Both in their own direction, rescaled to equal length and mean radius.")
          : tr("Rescaled to one length and one mean size; the second curve %1.").arg(ways.join(QStringLiteral(", "))));
}

void ShapeWindow::refreshTable() {
  const auto targets = session_.targets();
  const bool isFound = targets && targets->recommendedDegree;
  const int nearest = isFound ? targets->recommendedDegree.value() : 1;
  const bool isAdvised = isFound && isAdvisable(*targets, nearest, fairingAsked(session_).toleranceMm);
  std::vector<FigureTable::Row> rows;
  for (int degree = 1; targets && degree <= kMostTargetDegree; ++degree) {
    const int at = degree - 1;
    const TargetProfile& p = targets->targets.profiles[at];
    const QString none = QStringLiteral("–");
    const auto& faired = targets->faired[at];
    const bool isNeedKnown = faired && faired->report.neededMm;
    QString name = QStringLiteral("%1 %2").arg(degree).arg(degreeName(degree));
    if (isAdvised && degree == nearest) name += QStringLiteral(" ✓");
    const bool usable = p.valid && p.aicc;
    rows.push_back({name,
                    {{p.valid ? number(p.similarity, 5) : none},
                     {p.valid ? number(p.pearson, 3) : none},
                     {p.valid ? number(p.rmsPercent, 1) : none},
                     {isNeedKnown ? number(faired->report.neededMm.value_or(0.0), 3) : none,
                      faired && !faired->report.withinTolerance},
                     {faired ? QString::number(faired->report.extremaAfter) : none},
                     {usable ? number(*p.aicc, 1) : none}},
                    p.valid ? (p.isMonotone ? tr("Monotone profile.") : tr("This profile is not monotone."))
                            : QString::fromStdString(p.problem)});
  }
  if (rows.empty()) rows.push_back({tr("No curve selected"), {}, {}});
  table_->setRows(std::move(rows));
  recommendation_->setText(
      isAdvised
          ? tr("✓ recommended: the lowest degree that is met within the tolerance without an additional extremum. "
               "S alone cannot choose, as it mostly rises with the degree.")
      : isFound ? tr("Closest profile: %1 (smallest AICc). It is not recommended because it exceeds the "
                     "tolerance, adds extrema, moves nothing or is too dissimilar.")
                      .arg(degreeName(nearest))
                : QString());
}

}  // namespace batten
