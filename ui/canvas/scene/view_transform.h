// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPoint>
#include <QPointF>
#include <QRect>
#include <QRectF>
#include <QSize>

#include "core/base/vec2.h"

namespace batten {

/// Where the image lies in the view: a zoom [device px per image px] and the place of the image's origin, always a
/// whole device pixel, so that rendered tiles can be reused while panning. Widget coordinates are device px / ratio.
class ViewTransform {
 public:
  static constexpr double kMaxZoom = 64.0;  // device px for one of the page
  static constexpr int kFitMarginPx = 24;   ///< [widget px] left free around a fitted image, less in a low view.

  void setImageSize(QSize size) { image_ = size; }
  void setViewSize(QSize device, double ratio);
  QSize imageSize() const { return image_; }
  QSize viewSize() const { return view_; }  ///< [device px]
  double ratio() const { return ratio_; }
  double zoom() const { return zoom_; }
  QPoint origin() const { return origin_; }  ///< [device px] of the image's upper left corner.

  void fit();
  /// The smallest zoom offered: half of the fitted one, or 1 for tiny images.
  double minZoom() const;
  /// Zooms to `zoom` (bounded) while the image place under `anchor` [widget px] stays where it is.
  void zoomAt(double zoom, QPointF anchor);
  /// Moves the picture by widget px; part of the image always stays in view.
  void pan(QPointF widgetDelta);
  QPointF centre() const { return {view_.width() / ratio_ / 2.0, view_.height() / ratio_ / 2.0}; }

  QPointF toWidget(const Vec2& imagePx) const;
  Vec2 toImage(QPointF widget) const;
  /// Image px per widget px: turns screen distances into image distances.
  double imagePerWidget() const { return ratio_ / zoom_; }
  QRectF visibleImage() const;

 private:
  double fittedZoom() const;
  void keepInView();

  QSize image_{0, 0}, view_{1, 1};
  double ratio_ = 1.0, zoom_ = 1.0;
  QPoint origin_{0, 0};
  QPointF remainder_{0, 0};  ///< Of pans smaller than a device pixel.
};

/// Whether a place lies in a box, or beside it by no more than the margin, all in one unit.
bool isWithin(const QRectF& box, const Vec2& place, double margin);

}  // namespace batten
