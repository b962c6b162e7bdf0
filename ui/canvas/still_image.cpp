// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/still_image.h"

#include "core/image/log_transform.h"
#include "ui/canvas/layers/comb_layer.h"
#include "ui/canvas/layers/compare_layer.h"
#include "ui/canvas/layers/deviation_layer.h"
#include "ui/canvas/layers/faired_layer.h"
#include "ui/canvas/layers/fallback_layer.h"
#include "ui/canvas/layers/invented_layer.h"
#include "ui/canvas/layers/segment_layer.h"
#include "ui/canvas/layers/sketched_layer.h"
#include "ui/canvas/layers/stroke_layer.h"
#include "ui/session/explanation_source.h"
#include "ui/session/growing_player.h"
#include "ui/session/runs/coarse_runner.h"

namespace batten {

RasterContent rasterContent(const CanvasScene& scene) {
  RasterContent content;
  content.isDark = scene.palette.color(QPalette::Window).lightness() < 128;
  const auto scan = scene.session.scan();
  if (!scan) return content;
  content.pyramid = scene.pyramid;
  content.pageWidth = scan->grey.width;
  content.pageHeight = scan->grey.height;
  const bool isLog = scene.view.isVisible(Layer::LogImage) && !scene.view.isScanOnly();
  content.showsPicture = scene.view.isVisible(Layer::Scan) || isLog || scene.view.isScanOnly();
  if (isLog) content.tones = toneTable({true, scene.session.recipe().log.factor});
  if (scene.view.isScanOnly()) return content;
  const PipelineOutput& output = scene.session.output();
  if (scene.view.isVisible(Layer::Paper) && output.thresholds && !output.thresholds->paper.isEmpty())
    content.paper = std::shared_ptr<const PaperBackground>(output.thresholds, &output.thresholds->paper);
  if (scene.view.isVisible(Layer::Mask)) {
    const auto coarse = scene.session.coarseInk();
    if (coarse) content.maskFactor = coarse->factor;
    const auto& filtered = coarse ? coarse->filtered : output.filtered;
    if (filtered && !scene.view.showsMaskUncleaned())
      content.mask = std::shared_ptr<const BitImage>(filtered, &filtered->ink);
    else
      content.mask = coarse ? coarse->binary : output.binary;
  }
  if (scene.view.isVisible(Layer::Edges)) content.edges = output.edges;
  if (scene.view.isVisible(Layer::Explained)) {
    if (const auto explanation = scene.session.explanation().found())
      content.missed = std::shared_ptr<const BitImage>(explanation, &explanation->missedInk);
  }
  return content;
}

void StillImage::paint(QPainter& painter, const CanvasScene& scene) {
  refresh(scene);
  if (!still_.isNull()) painter.drawImage(QPointF(0, 0), still_);
}

StillImage::LinesKey StillImage::linesKeyOf(const CanvasScene& scene) {
  LinesKey key;
  key.origin = scene.transform.origin();
  key.size = scene.transform.viewSize();
  key.zoom = scene.transform.zoom();
  key.ratio = scene.transform.ratio();
  if (scene.view.isScanOnly()) return key;
  for (std::size_t i = 0; i < kLayers.size(); ++i) key.layers |= scene.view.isVisible(kLayers[i]) ? 1 << i : 0;
  key.combScale = scene.view.combScale();
  key.isRadius = scene.view.combShowsRadius();
  key.combDensity = scene.view.combDensity();
  key.selected = scene.session.selectedCurve();
  key.isGrowing = scene.session.growing().isOpen();
  key.shapes = scene.shapes.get();
  key.combs = scene.combs.get();
  key.overlay = scene.overlay.get();
  if (scene.view.isVisible(Layer::Segments)) key.segments = scene.session.output().segments.get();
  if (scene.view.isVisible(Layer::Strokes) || scene.view.isVisible(Layer::Fallback))
    key.contours = scene.session.output().contours.get();
  if (scene.view.isVisible(Layer::Explained)) key.explanation = scene.session.explanation().found().get();
  return key;
}

void StillImage::refreshLines(const CanvasScene& scene, const LinesKey& key) {
  if (!lines_.isNull() && key == linesKey_) return;
  linesKey_ = key;
  if (lines_.size() != key.size) lines_ = QImage(key.size, QImage::Format_ARGB32_Premultiplied);
  if (lines_.isNull()) return;
  lines_.setDevicePixelRatio(key.ratio);
  lines_.fill(Qt::transparent);
  if (scene.view.isScanOnly()) return;
  QPainter painter(&lines_);
  paintUniform(painter, scene);
  if (scene.view.isVisible(Layer::Strokes)) paintStrokes(painter, scene);
  if (scene.view.isVisible(Layer::Fallback)) paintFallback(painter, scene);
  if (scene.view.isVisible(Layer::Segments)) paintSegments(painter, scene);
  if (scene.view.isVisible(Layer::Curve)) paintSketched(painter, scene);
  if (scene.view.isVisible(Layer::Faired)) paintFaired(painter, scene);
  paintPinned(painter, scene);
  if (scene.areCombsShown()) paintCombs(painter, scene);
  if (scene.view.isVisible(Layer::Deviation)) paintDeviation(painter, scene);
  if (scene.view.isVisible(Layer::Explained)) paintInvented(painter, scene);
}

void StillImage::refresh(const CanvasScene& scene) {
  const StillKey key{rasterContent(scene), linesKeyOf(scene)};
  if (!still_.isNull() && key == stillKey_) return;
  refreshLines(scene, key.lines);
  if (still_.size() != key.lines.size) still_ = QImage(key.lines.size, QImage::Format_RGB32);
  if (still_.isNull()) return;
  still_.setDevicePixelRatio(1.0);
  {
    QPainter painter(&still_);
    tiles_.paint(painter, scene.transform, key.raster);
    if (!lines_.isNull()) {
      lines_.setDevicePixelRatio(1.0);
      painter.drawImage(QPoint(0, 0), lines_);
    }
  }
  still_.setDevicePixelRatio(key.lines.ratio);
  stillKey_ = key;
}

}  // namespace batten
