// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curves/pin_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/curve/closest_point.h"
#include "core/curve/variation_energy.h"
#include "ui/panels/controls/lines_note.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/stages/curves/method_table.h"
#include "ui/session/background/background_worker.h"

namespace batten {
namespace {

ComparedFigures figuresOf(const TracedCurve& curve) {
  const CurveFigures& f = curve.sketchedFigures;
  return {f.fromPoints.rms, f.fromPoints.max, f.controlPoints, f.extrema, variationEnergy(curve.sketched)};
}

/// How a pinned curve was made: in its own way or the common one.
ConstructMethod methodOf(const PinnedResult& pinned, const TracedCurve& curve) {
  const auto owners = assignChoices(*pinned.pieces, pinned.recipe.choices).ofPiece;
  const auto own = owners[curve.piece];
  return own ? pinned.recipe.choices[*own].method.value_or(pinned.recipe.construct.method)
             : pinned.recipe.construct.method;
}

}  // namespace

QString unevennessText(double energy) {
  // Asking for three digits gives 1e+03 from here on: one notation for all that is larger.
  if (!(energy >= 999.5)) return QString::number(energy, 'g', 3);
  static constexpr char16_t kRaised[] = u"⁰¹²³⁴⁵⁶⁷⁸⁹";  // digits of an exponent
  int exponent = static_cast<int>(std::floor(std::log10(energy)));
  double digits = energy / std::pow(10.0, exponent);
  if (digits >= 9.995) digits /= 10.0, ++exponent;
  QString power;
  for (const QChar digit : QString::number(exponent)) power += QChar(kRaised[digit.digitValue()]);
  return QStringLiteral("%1 · 10%2").arg(digits, 0, 'f', 2).arg(power);
}

Comparison compare(const TracedCurve& pinned, const TracedCurve& now) {
  Comparison result{figuresOf(pinned), figuresOf(now), 0.0};
  const NurbsCurve &a = now.sketched, &b = pinned.sketched;
  result.apartMm = std::max(deviation(a, b).max, deviation(b, a).max);
  return result;
}

PinPanel::PinPanel(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      pin_(plainButton(tr("Pin this result"), QStringLiteral("pin.set"), this)),
      unpin_(plainButton(tr("Unpin"), QStringLiteral("pin.clear"), this)),
      what_(new LinesNote(2, this)),
      figures_(new FigureTable(this)),
      worker_(std::make_unique<BackgroundWorker>()) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  layout->addWidget(caption(tr("Compare"), this));
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(pin_);
  buttons->addWidget(unpin_);
  buttons->addStretch();
  layout->addLayout(buttons);
  layout->addWidget(what_);
  figures_->setObjectName(QStringLiteral("pin.figures"));
  figures_->setHeader(tr("Selected curve"), {tr("pinned"), tr("now")});
  pin_->setToolTip(tr("Keeps this result as a dashed violet line for comparison  (A)"));
  connect(pin_, &QPushButton::clicked, &session_, &EditorSession::pin);
  connect(unpin_, &QPushButton::clicked, &session_, &EditorSession::unpin);
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::selectionChanged, &EditorSession::runFinished,
                            &EditorSession::pinChanged})
    connect(&session_, signal, this, &PinPanel::refresh);
  refresh();
}

PinPanel::~PinPanel() = default;

QWidget* PinPanel::figures() const { return figures_; }

void PinPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

void PinPanel::refresh() {
  const auto pinned = session_.pinned();
  const TracedCurve* now = session_.selected();
  const TracedCurve* before = session_.pinnedOf(session_.selectedCurve());
  pin_->setEnabled(session_.output().faired && !session_.isStale(StageId::Faired));
  pin_->setText(pinned ? tr("Pin the current result") : tr("Pin this result"));
  unpin_->setVisible(pinned != nullptr);
  figures_->setVisible(now && before);
  what_->setText(
      !pinned ? tr("Pin a result to compare it with another method or setting.")
      : before || !now
          ? tr("Pinned: %1").arg(label(before ? methodOf(*pinned, *before) : pinned->recipe.construct.method))
          : tr("The pinned result has no curve here."));
  const int request = ++request_;
  if (!now || !before || !isVisible()) return;
  // Shared constants: the copies keep what the job reads.
  worker_->start([this, pinnedCurve = *before, nowCurve = *now, request](const CancelToken& token) {
    const Comparison result = compare(pinnedCurve, nowCurve);
    if (token.isCancelled()) return;
    inbox_.post([this, result, request] {
      if (request_ == request) show(result);
    });
  });
}

void PinPanel::show(const Comparison& c) {
  const auto count = [](int n) { return QString::number(n); };
  figures_->setRows(
      {{tr("Rms deviation"),
        {{shortMillimetres(c.pinned.rmsMm)}, {shortMillimetres(c.now.rmsMm)}},
        tr("Root mean square of the distances of the line's points.")},
       {tr("Largest deviation"),
        {{shortMillimetres(c.pinned.maxMm)}, {shortMillimetres(c.now.maxMm)}},
        tr("Largest distance of a point of the line from the curve.")},
       {tr("Control points"), {{count(c.pinned.controlPoints)}, {count(c.now.controlPoints)}}, {}},
       {tr("Curvature extrema"),
        {{count(c.pinned.extrema)}, {count(c.now.extrema)}},
        tr("Local maxima and minima of the curvature: fewer is fairer.")},
       {tr("Unevenness (no unit)"),
        {{unevennessText(c.pinned.energy)}, {unevennessText(c.now.energy)}},
        tr("Integral of the squared rate of change of curvature, independent of size: 0 for a "
           "circle, smaller is fairer.")},
       {tr("Apart"), {{}, {shortMillimetres(c.apartMm)}}, tr("Largest distance between the two curves.")}});
}

}  // namespace batten
