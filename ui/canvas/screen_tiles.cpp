// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/screen_tiles.h"

#include <algorithm>
#include <vector>

#include "core/base/parallel.h"

namespace batten {
namespace {

int floorDiv(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

}  // namespace

void ScreenTiles::paint(QPainter& painter, const ViewTransform& view, const RasterContent& content) {
  if (zoom_ != view.zoom() || !(content_ == content)) {
    tiles_.clear();
    zoom_ = view.zoom();
    content_ = content;
  }
  ++clock_;
  const QRect seen(-view.origin(), view.viewSize());
  const int x0 = floorDiv(seen.left(), kTile), x1 = floorDiv(seen.right(), kTile);
  const int y0 = floorDiv(seen.top(), kTile), y1 = floorDiv(seen.bottom(), kTile);
  std::vector<std::pair<Key, QImage*>> missing;
  std::vector<std::pair<Key, Entry*>> visible;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      Entry& entry = tiles_[{x, y}];
      entry.used = clock_;
      visible.push_back({{x, y}, &entry});
      if (entry.image.isNull()) missing.push_back({{x, y}, &entry.image});
    }
  parallelFor(RunContext{}, static_cast<int>(missing.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto& [key, image] = missing[i];
      *image = renderRaster(content_, zoom_, QRect(key.first * kTile, key.second * kTile, kTile, kTile));
    }
  });
  rendered_ += missing.size();
  for (const auto& [key, entry] : visible)
    painter.drawImage(view.origin() + QPoint(key.first * kTile, key.second * kTile), entry->image);
  // Room for two screens: panning back and forth finds its tiles again.
  const std::size_t limit = 2 * visible.size() + 16;
  if (tiles_.size() > limit) {
    std::vector<std::pair<std::uint64_t, Key>> ages;
    for (const auto& [key, entry] : tiles_) ages.emplace_back(entry.used, key);
    std::sort(ages.begin(), ages.end());
    for (std::size_t i = 0; i + limit < ages.size(); ++i) tiles_.erase(ages[i].second);
  }
}

}  // namespace batten
