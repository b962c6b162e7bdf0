// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/render_page.h"

#include <turbojpeg.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

namespace batten::test {
namespace {

std::size_t at(int x, int y, int width) { return std::ptrdiff_t{y} * width + x; }

/// Adds the signed area that an edge leaves to its right, per pixel row (cover and area accumulation).
void addEdge(std::vector<double>& cells, int width, int height, Vec2 a, Vec2 b) {
  if (a.y() == b.y()) return;
  const double sign = a.y() < b.y() ? 1.0 : -1.0;
  if (sign < 0) std::swap(a, b);
  const double slope = (b.x() - a.x()) / (b.y() - a.y());
  for (int y = std::max(0, static_cast<int>(std::floor(a.y()))); y < height && y < b.y(); ++y) {
    const double y0 = std::max(a.y(), static_cast<double>(y)), y1 = std::min(b.y(), y + 1.0);
    if (y1 <= y0) continue;
    double x0 = a.x() + (y0 - a.y()) * slope, x1 = a.x() + (y1 - a.y()) * slope;
    if (x0 > x1) std::swap(x0, x1);
    const double dy = sign * (y1 - y0), span = x1 - x0;
    for (int x = std::max(0, static_cast<int>(std::floor(x0))); x < width && x <= x1; ++x) {
      // Part of the edge inside this column, and the area it leaves to the right within the pixel.
      const double l = std::max(x0, static_cast<double>(x)), r = std::min(x1, x + 1.0);
      const double part = span > 1e-12 ? std::max(0.0, r - l) / span : 1.0;
      const double mean = span > 1e-12 ? 0.5 * (l + r) : x0;
      cells[at(x, y, width + 1)] += dy * part * (x + 1.0 - mean);
      cells[at(x + 1, y, width + 1)] += dy * part * (mean - x);
    }
  }
}

void blurRows(std::vector<float>& image, int width, int height, const std::vector<double>& kernel, bool columns) {
  const int radius = static_cast<int>(kernel.size()) - 1, outer = columns ? width : height,
            inner = columns ? height : width;
  std::vector<float> line(inner);
  for (int o = 0; o < outer; ++o) {
    const auto index = [&](int i) { return columns ? at(o, i, width) : at(i, o, width); };
    for (int i = 0; i < inner; ++i) line[i] = image[index(i)];
    for (int i = 0; i < inner; ++i) {
      double sum = kernel[0] * line[i];
      for (int k = 1; k <= radius; ++k)
        sum += kernel[k] * (line[std::max(0, i - k)] + line[std::min(inner - 1, i + k)]);
      image[index(i)] = static_cast<float>(sum);
    }
  }
}

void blur(std::vector<float>& image, int width, int height, double sigma) {
  if (sigma <= 0.0) return;
  std::vector<double> kernel;
  for (int k = 0; k <= static_cast<int>(std::ceil(4.0 * sigma)); ++k)
    kernel.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
  double sum = -kernel[0];
  for (const double v : kernel) sum += 2.0 * v;
  for (double& v : kernel) v /= sum;
  blurRows(image, width, height, kernel, false);
  blurRows(image, width, height, kernel, true);
}

}  // namespace

void throughJpeg(GreyImage& grey, int quality) {
  std::vector<unsigned char> page(grey.pixels.size());
  for (std::size_t i = 0; i < page.size(); ++i) page[i] = static_cast<unsigned char>(grey.pixels[i] / 257);
  const tjhandle writer = tjInitCompress(), reader = tjInitDecompress();
  unsigned char* file = nullptr;
  unsigned long size = 0;
  const bool isDone =
      tjCompress2(writer, page.data(), grey.width, 0, grey.height, TJPF_GRAY, &file, &size, TJSAMP_GRAY, quality,
                  TJFLAG_ACCURATEDCT) == 0 &&
      tjDecompress2(reader, file, size, page.data(), grey.width, 0, grey.height, TJPF_GRAY, TJFLAG_ACCURATEDCT) == 0;
  tjFree(file);
  tjDestroy(writer);
  tjDestroy(reader);
  if (!isDone) throw std::runtime_error("the page does not go through JPEG");
  for (std::size_t i = 0; i < page.size(); ++i) grey.pixels[i] = static_cast<std::uint16_t>(page[i] * 257);
}

PageStyle cleanPage() { return {}; }
PageStyle scannedPage(std::uint32_t seed) { return {255, 140, 30, 0, 0.8, 6, 4, seed, 0}; }
PageStyle darkPage(std::uint32_t seed) { return {190, 40, 0, 20, 0.8, 2, 0, seed, 0}; }
PageStyle varyingPage(std::uint32_t seed) { return {230, 120, 0, 120, 0.8, 2, 0, seed, 0, 12, 40}; }
PageStyle gradatedPage(std::uint32_t seed) { return {250, 150, 30, 0, 1.2, 5, 0, seed, 0}; }

std::vector<float> fillCoverage(const std::vector<Vec2>& outline, int width, int height) {
  std::vector<double> cells(std::ptrdiff_t{width + 1} * height, 0.0);
  for (std::size_t i = 0; i < outline.size(); ++i)
    addEdge(cells, width, height, outline[i], outline[(i + 1) % outline.size()]);
  std::vector<float> coverage(std::ptrdiff_t{width} * height);
  for (int y = 0; y < height; ++y) {
    double sum = 0.0;
    for (int x = 0; x < width; ++x) {
      sum += cells[at(x, y, width + 1)];
      coverage[at(x, y, width)] = static_cast<float>(std::min(1.0, std::abs(sum)));
    }
  }
  return coverage;
}

std::vector<float> strokeCoverage(const std::vector<Vec2>& outline, bool closed, double widthPx, int width,
                                  int height) {
  // Distance to the dense polyline, by splatting: coverage of a straight edge at that distance (box-filtered by a
  // ramp).
  std::vector<float> distance(std::ptrdiff_t{width} * height, 1e9f);
  const double half = 0.5 * widthPx, reach = half + 1.5;
  const std::size_t count = outline.size() - (closed ? 0 : 1);
  Vec2 from = outline[0];
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 to = outline[(i + 1) % outline.size()];
    if ((to - from).norm() < 0.5 && i + 1 < count) continue;  // half a pixel per facet is far below the accuracy needed
    const Vec2 d = to - from;
    for (int y = std::max(0, static_cast<int>(std::min(from.y(), to.y()) - reach));
         y <= std::min(height - 1.0, std::max(from.y(), to.y()) + reach); ++y) {
      for (int x = std::max(0, static_cast<int>(std::min(from.x(), to.x()) - reach));
           x <= std::min(width - 1.0, std::max(from.x(), to.x()) + reach); ++x) {
        const Vec2 p = Vec2(x + 0.5, y + 0.5) - from;
        const double f = std::clamp(p.dot(d) / std::max(1e-12, d.squaredNorm()), 0.0, 1.0);
        float& cell = distance[at(x, y, width)];
        cell = std::min(cell, static_cast<float>((p - f * d).norm()));
      }
    }
    from = to;
  }
  for (float& d : distance) d = static_cast<float>(std::clamp(half + 0.5 - d, 0.0, 1.0));
  return distance;
}

Scan renderPage(std::vector<float> coverage, int width, int height, const PageStyle& style) {
  blur(coverage, width, height, style.blurPx);
  std::mt19937 random(style.seed);
  std::normal_distribution<double> normal;
  Scan scan;
  scan.grey = GreyImage(width, height);
  scan.info = {"PNG", width, height, 1, 8, 1, 300.0, {}};
  scan.dpi = 300.0;
  scan.path = "rendered.png";
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = (x + 0.5) / width;
      double paper = std::lerp(style.paperLeft, style.paperRight, u);
      if (style.texture > 0.0)
        paper += style.texture * std::sin(0.021 * x + 1.3 * std::sin(0.017 * y)) * std::sin(0.019 * y);
      const double contrast =
          style.contrastRight > 0.0 ? std::lerp(style.contrast, style.contrastRight, u) : style.contrast;
      const double noise = style.noiseRight >= 0.0 ? std::lerp(style.noise, style.noiseRight, u) : style.noise;
      const double ink = contrast > 0.0 ? paper - contrast : style.inkLevel * (0.6 + 0.4 * paper / 255.0);
      const double c = coverage[at(x, y, width)];
      const double value = paper * (1.0 - c) + ink * c + noise * normal(random);
      scan.grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(std::round(value), 0.0, 255.0)) * 257);
    }
  }
  if (style.jpegQuality > 0) throughJpeg(scan.grey, style.jpegQuality);
  scan.fileHash = sha256(std::as_bytes(std::span(scan.grey.pixels)));
  return scan;
}

}  // namespace batten::test
