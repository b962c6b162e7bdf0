// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/scene/view_transform.h"

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

/// Of the lesser side of the view, around a fitted image at most: over targets and plots, height is dear.
constexpr double kFitMarginShare = 0.04;

}  // namespace

void ViewTransform::setViewSize(QSize device, double ratio) {
  view_ = device.expandedTo({1, 1});
  ratio_ = ratio > 0.0 ? ratio : 1.0;
}

double ViewTransform::fittedZoom() const {
  if (image_.isEmpty()) return 1.0;
  const double margin =
      2.0 * std::min(kFitMarginPx * ratio_, kFitMarginShare * std::min(view_.width(), view_.height()));
  const double w = std::max(view_.width() - margin, 0.25 * view_.width());
  const double h = std::max(view_.height() - margin, 0.25 * view_.height());
  return std::min({w / image_.width(), h / image_.height(), kMaxZoom});
}

double ViewTransform::minZoom() const { return std::min(1.0, 0.5 * fittedZoom()); }

void ViewTransform::fit() {
  zoom_ = fittedZoom();
  origin_ = {static_cast<int>(std::lround((view_.width() - image_.width() * zoom_) / 2.0)),
             static_cast<int>(std::lround((view_.height() - image_.height() * zoom_) / 2.0))};
  remainder_ = {};
}

void ViewTransform::zoomAt(double zoom, QPointF anchor) {
  if (!std::isfinite(zoom)) return;
  const Vec2 place = toImage(anchor);
  zoom_ = std::clamp(zoom, minZoom(), kMaxZoom);
  origin_ = {static_cast<int>(std::lround(anchor.x() * ratio_ - place.x() * zoom_)),
             static_cast<int>(std::lround(anchor.y() * ratio_ - place.y() * zoom_))};
  remainder_ = {};
  keepInView();
}

void ViewTransform::pan(QPointF widgetDelta) {
  remainder_ += widgetDelta * ratio_;
  const QPoint step(static_cast<int>(std::lround(remainder_.x())), static_cast<int>(std::lround(remainder_.y())));
  remainder_ -= QPointF(step);
  origin_ += step;
  keepInView();
}

void ViewTransform::keepInView() {
  const auto bounded = [](int origin, double extent, int view) {
    const int keep = static_cast<int>(std::min(64.0, extent / 2.0));
    return std::clamp(origin, keep - static_cast<int>(extent), view - keep);
  };
  origin_ = {bounded(origin_.x(), image_.width() * zoom_, view_.width()),
             bounded(origin_.y(), image_.height() * zoom_, view_.height())};
}

QPointF ViewTransform::toWidget(const Vec2& imagePx) const {
  return {(imagePx.x() * zoom_ + origin_.x()) / ratio_, (imagePx.y() * zoom_ + origin_.y()) / ratio_};
}

Vec2 ViewTransform::toImage(QPointF widget) const {
  return {(widget.x() * ratio_ - origin_.x()) / zoom_, (widget.y() * ratio_ - origin_.y()) / zoom_};
}

QRectF ViewTransform::visibleImage() const {
  const Vec2 from = toImage({0.0, 0.0});
  return {from.x(), from.y(), view_.width() / zoom_, view_.height() / zoom_};
}

bool isWithin(const QRectF& box, const Vec2& place, double margin) {
  return place.x() >= box.left() - margin && place.x() <= box.right() + margin && place.y() >= box.top() - margin &&
         place.y() <= box.bottom() + margin;
}

}  // namespace batten
