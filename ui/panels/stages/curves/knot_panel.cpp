// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curves/knot_panel.h"

#include <QCheckBox>
#include <QFontMetrics>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/parameter_editor.h"
#include "ui/panels/stages/curves/knot_gallery.h"
#include "ui/panels/stages/curves/knot_strip.h"
#include "ui/session/background/background_worker.h"
#include "ui/theme/theme.h"

namespace batten {

QString knotText(const std::vector<double>& knots) {
  QStringList words;
  for (const auto& column : knotColumns(knots)) {
    const QString value = QString::number(column.value, 'g', 12);
    words << (column.times > 1 ? value + QChar(0x00D7) + QString::number(column.times) : value);
  }
  return words.join(QLatin1Char(' '));
}

KnotPanel::KnotPanel(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent),
      session_(session),
      editor_(new ParameterEditor(session,
                                  {"construct.degree", "construct.removal", "construct.removal_step",
                                   "construct.removal_tolerance", "construct.knots"},
                                  this)),
      counts_(note({}, this)),
      warning_(note({}, this)),
      strip_(new KnotStrip(this)),
      text_(note({}, this)),
      uniform_(new QCheckBox(tr("Show the uniform curve too"), this)),
      worker_(std::make_unique<BackgroundWorker>()) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  counts_->setObjectName(QStringLiteral("knots.counts"));
  text_->setObjectName(QStringLiteral("knots.text"));
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  text_->setToolTip(
      tr("Knot values; ×3 means multiplicity 3. A knot of multiplicity equal to the degree makes "
         "a sharp corner."));
  layout->addWidget(editor_);
  layout->addWidget(counts_);
  layout->addWidget(caption(tr("Knot vector"), this));
  layout->addWidget(strip_);
  layout->addWidget(text_);
  layout->addWidget(warning_);
  uniform_->setObjectName(QStringLiteral("knots.uniform"));
  uniform_->setToolTip(
      tr("Draws the same points with equal knots as a thin amber line: without repeated knots the corners are lost."));
  layout->addWidget(uniform_);
  auto* all = plainButton(tr("Compare all degrees…"), QStringLiteral("knots.compare"), this);
  all->setToolTip(tr("Degrees 2 to 5 with uniform and with repeated knots, side by side."));
  layout->addWidget(all, 0, Qt::AlignLeft);
  connect(all, &QPushButton::clicked, this, &KnotPanel::openGallery);
  connect(uniform_, &QCheckBox::toggled, &view, &ViewSettings::setShowsUniformKnots);
  connect(&view, &ViewSettings::changed, this, [this, &view] { uniform_->setChecked(view.showsUniformKnots()); });
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::recipeChanged, &EditorSession::selectionChanged,
                            &EditorSession::runFinished})
    connect(&session_, signal, this, &KnotPanel::refresh);
  refresh();
}

KnotPanel::~KnotPanel() = default;

void KnotPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

void KnotPanel::refresh() {
  const ConstructParams params = session_.recipe().construct;
  editor_->setRowVisible("construct.removal_step", params.removal == PointRemoval::Step);
  editor_->setRowVisible("construct.removal_tolerance", params.removal == PointRemoval::Tolerance);
  const TracedCurve* curve = session_.selected();
  const int request = ++request_;
  if (!curve) return show(nullptr);
  if (!isVisible() || session_.isStale(StageId::Segments)) return;
  worker_->start(
      [this, output = session_.output(), contour = curve->contour, params, request](const CancelToken& token) {
        auto result = std::make_shared<Result>();
        result->line = linePolygon(lineInput(output, contour), params);
        if (auto made = polygonCurve(result->line, params.degree, params.knots)) result->curve = std::move(*made);
        if (token.isCancelled()) return;
        inbox_.post([this, request, shared = std::shared_ptr<const Result>(result)] {
          if (request_ == request) show(shared);
        });
      });
}

void KnotPanel::show(const std::shared_ptr<const Result>& result) {
  if (!result || result->line.points.empty()) {
    counts_->setText(tr("No line selected."));
    strip_->setKnots({});
    text_->clear();
    warning_->hide();
    return;
  }
  const LinePolygon& line = result->line;
  const int kept = static_cast<int>(line.points.size());
  const int added = result->curve ? result->curve->added : 0;
  QString counts = tr("%1 points, %2 kept").arg(grouped(line.before), grouped(kept));
  if (added > 0) counts += tr(", %1 doubled between close corners").arg(added);
  counts_->setText(counts + QStringLiteral(" · ") +
                   counted(static_cast<qint64>(line.sharp.size()), tr("1 corner"), tr("%1 corners")));
  const std::vector<double> knots = result->curve ? result->curve->knots : std::vector<double>{};
  strip_->setKnots(knots);
  const QString whole = knotText(knots);
  // The picture tells the whole; the text is cut where it would push everything else out of sight.
  constexpr int kMostLetters = 220;
  text_->setText(whole.size() <= kMostLetters
                     ? whole
                     : whole.left(whole.lastIndexOf(QLatin1Char(' '), kMostLetters)) + QStringLiteral(" …"));
  text_->setProperty("whole", whole);
  const bool breaks = session_.recipe().construct.knots == SharpKnots::Order && !line.sharp.empty();
  warning_->setText(breaks ? tr("Multiplicity equal to the order, as in the paper, breaks the curve just before each "
                                "corner.")
                           : QString());
  warning_->setVisible(breaks);
  if (gallery_) gallery_->setLine(line, session_.recipe().construct.knots);
}

void KnotPanel::openGallery() {
  if (!gallery_) gallery_ = new KnotGallery(session_, this);
  gallery_->show();
  gallery_->raise();
  gallery_->activateWindow();
  refresh();
}

}  // namespace batten
