// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/raster_layer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "ui/canvas/scene/canvas_colors.h"

namespace batten {
namespace {

QRgb mix(QRgb below, QRgb above, int share256) {
  const auto part = [share256](int b, int a) { return b + (((a - b) * share256) >> 8); };
  return qRgb(part(qRed(below), qRed(above)), part(qGreen(below), qGreen(above)), part(qBlue(below), qBlue(above)));
}

/// Half-open range of image pixels that a screen pixel covers, at least one, within 0..size; empty outside.
struct Cover {
  int first = 0, last = 0;
};
Cover coverOf(int device, double zoom, int size) {
  const double from = device / zoom, to = (device + 1) / zoom;
  if (to <= 0.0 || from >= size) return {};
  if (zoom >= 1.0) {
    const int at = std::clamp(static_cast<int>(std::floor((device + 0.5) / zoom)), 0, size - 1);
    return {at, at + 1};
  }
  const int first = std::clamp(static_cast<int>(std::floor(from)), 0, size - 1);
  return {first, std::clamp(static_cast<int>(std::floor(to)), first + 1, size)};
}

/// How bits are laid over a page.
struct BitInk {
  QRgb color = 0;
  double opacity = 1.0, thinGain = 1.0;  ///< thinGain: ink of less than a device pixel is darkened by this.
};

void renderBits(const BitImage& bits, double zoom, const QRect& device, const BitInk& with, QImage& out) {
  std::vector<Cover> columns(device.width());
  for (int i = 0; i < device.width(); ++i) columns[i] = coverOf(device.x() + i, zoom, bits.width);
  std::vector<int> ink(columns.size());
  for (int j = 0; j < device.height(); ++j) {
    const Cover rows = coverOf(device.y() + j, zoom, bits.height);
    if (rows.first == rows.last) continue;
    std::fill(ink.begin(), ink.end(), 0);
    for (int y = rows.first; y < rows.last; ++y)
      for (std::size_t i = 0; i < columns.size(); ++i)
        if (columns[i].first != columns[i].last) ink[i] += inkInRow(bits, y, columns[i].first, columns[i].last);
    auto* line = reinterpret_cast<QRgb*>(out.scanLine(j));
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (ink[i] == 0) continue;
      const int area = (columns[i].last - columns[i].first) * (rows.last - rows.first);
      const double share = std::min(1.0, with.thinGain * ink[i] / area) * with.opacity;
      line[i] = mix(line[i], with.color, static_cast<int>(256.0 * share));
    }
  }
}

/// The scan in its own colours: tones and paper are read from grey values.
bool isShownInColour(const RasterContent& content) {
  return !content.tones && !content.paper && content.pyramid && !content.pyramid->scan->colour.isEmpty();
}

/// What a picture of grey values looks like after tones and paper. @param grey of the rectangle, row by row.
void shadeGrey(const RasterContent& content, double zoom, const QRect& device, const std::vector<std::uint8_t>& grey,
               std::vector<QRgb>& out) {
  std::array<QRgb, 256> palette{};
  for (std::size_t v = 0; v < palette.size(); ++v) {
    const int tone = content.tones ? (*content.tones)[v] : static_cast<int>(v);
    palette[v] = qRgb(tone, tone, tone);
  }
  std::ptrdiff_t at = 0;
  for (int j = 0; j < device.height(); ++j) {
    const double y = (device.y() + j + 0.5) / zoom;
    for (int i = 0; i < device.width(); ++i, ++at) {
      int value = grey[at];
      if (content.paper) {
        const double paper = std::max(1.0, content.paper->at((device.x() + i + 0.5) / zoom, y));
        value = static_cast<int>(std::min(255.0, 255.0 * value / paper + 0.5));
      }
      out[at] = palette[value];
    }
  }
}

void renderPage(const RasterContent& content, double zoom, const QRect& device, QImage& out) {
  std::vector<QRgb> picture;
  if (content.showsPicture && content.pyramid) {
    picture.resize(std::ptrdiff_t{device.width()} * device.height());
    if (isShownInColour(content)) {
      sampleColours(*content.pyramid, zoom, device, picture.data());
    } else {
      std::vector<std::uint8_t> grey(picture.size());
      sampleGrey(*content.pyramid, zoom, device, grey.data());
      shadeGrey(content, zoom, device, grey, picture);
    }
  }
  const QRgb desk = colors::desk(content.isDark);
  for (int j = 0; j < device.height(); ++j) {
    auto* line = reinterpret_cast<QRgb*>(out.scanLine(j));
    const double y = (device.y() + j + 0.5) / zoom;
    const bool onRow = y >= 0.0 && y < content.pageHeight;
    for (int i = 0; i < device.width(); ++i) {
      const double x = (device.x() + i + 0.5) / zoom;
      const bool onPage = onRow && x >= 0.0 && x < content.pageWidth;
      line[i] = !onPage ? desk : picture.empty() ? colors::kPaper : picture[std::ptrdiff_t{j} * device.width() + i];
    }
  }
}

}  // namespace

int inkInRow(const BitImage& bits, int y, int x0, int x1) {
  const std::uint64_t* row = bits.row(y);
  int count = 0;
  while (x0 < x1) {
    const int bit = x0 & 63, length = std::min(64 - bit, x1 - x0);
    const std::uint64_t mask = length == 64 ? ~std::uint64_t{0} : ((std::uint64_t{1} << length) - 1) << bit;
    count += std::popcount(row[x0 >> 6] & mask);
    x0 += length;
  }
  return count;
}

QImage renderRaster(const RasterContent& content, double zoom, const QRect& device) {
  QImage out(device.size(), QImage::Format_RGB32);
  if (out.isNull()) return out;
  renderPage(content, zoom, device, out);
  const bool overPicture = content.showsPicture && content.pyramid;
  if (content.mask)
    renderBits(*content.mask, zoom * content.maskFactor, device,
               overPicture ? BitInk{colors::kMask, 0.72} : BitInk{qRgb(24, 24, 24)}, out);
  const double thinGain = std::max(1.0, 0.7 / zoom);
  if (content.missed) renderBits(*content.missed, zoom, device, {colors::kMissed, 0.95, thinGain}, out);
  if (content.edges) renderBits(*content.edges, zoom, device, {colors::kEdges, 0.9, thinGain}, out);
  return out;
}

}  // namespace batten
