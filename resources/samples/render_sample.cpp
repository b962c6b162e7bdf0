// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the sample sketch of the program: a pencil side view of a coupe on gradated, slightly grainy paper, as a
// designer would scan it. Everything is computed here, so that no drawing of anyone else has to ship, and from a fixed
// seed, so that every build has the same picture.
//
//   render_sample OUT.png [WIDTH_PX]        default 1754 (A4 across at 150 dpi)

#include <QImage>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace {

constexpr double kPageWidthMm = 297.0;
constexpr double kPageHeightMm = 210.0;

struct Point {
  double x, y;
};

/// Value noise: smooth pseudo-random numbers in 0..1 that depend on the place alone.
double hashed(int x, int y, std::uint32_t seed) {
  std::uint32_t h =
      static_cast<std::uint32_t>(x) * 0x9E3779B1u ^ static_cast<std::uint32_t>(y) * 0x85EBCA77u ^ seed * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return (h ^ (h >> 15)) / 4294967296.0;
}

double valueNoise(double x, double y, std::uint32_t seed) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double u = smooth(x - fx), v = smooth(y - fy);
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
  const double top = std::lerp(hashed(ix, iy, seed), hashed(ix + 1, iy, seed), u);
  const double bottom = std::lerp(hashed(ix, iy + 1, seed), hashed(ix + 1, iy + 1, seed), u);
  return std::lerp(top, bottom, v);
}

/// A smooth line through points (centripetal Catmull-Rom is too lively for a car: natural cubic spline over chord
/// length).
std::vector<Point> splineThrough(const std::vector<Point>& p, double stepMm) {
  const std::size_t n = p.size();
  std::vector<double> t(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) t[i] = t[i - 1] + std::hypot(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y);
  const auto secondDerivatives = [&](auto value) {
    std::vector<double> m(n, 0.0), c(n, 0.0), d(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double left = t[i] - t[i - 1], right = t[i + 1] - t[i];
      const double diagonal = 2.0 * (left + right) - left * c[i - 1];
      c[i] = right / diagonal;
      d[i] =
          (6.0 * ((value(i + 1) - value(i)) / right - (value(i) - value(i - 1)) / left) - left * d[i - 1]) / diagonal;
    }
    for (std::size_t i = n - 1; i-- > 1;) m[i] = d[i] - c[i] * m[i + 1];
    return m;
  };
  const auto mx = secondDerivatives([&](std::size_t i) { return p[i].x; });
  const auto my = secondDerivatives([&](std::size_t i) { return p[i].y; });
  std::vector<Point> line;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = t[i + 1] - t[i];
    const int steps = std::max(2, static_cast<int>(std::ceil(h / stepMm)));
    for (int k = 0; k < steps; ++k) {
      const double b = static_cast<double>(k) / steps, a = 1.0 - b, q = h * h / 6.0;
      const double wa = (a * a * a - a) * q, wb = (b * b * b - b) * q;
      line.push_back({a * p[i].x + b * p[i + 1].x + wa * mx[i] + wb * mx[i + 1],
                      a * p[i].y + b * p[i + 1].y + wa * my[i] + wb * my[i + 1]});
    }
  }
  line.push_back(p.back());
  return line;
}

std::vector<Point> arc(Point centre, double radius, double fromDeg, double toDeg) {
  std::vector<Point> line;
  const int steps = static_cast<int>(std::abs(toDeg - fromDeg) * radius / 10.0) + 16;
  for (int i = 0; i <= steps; ++i) {
    const double a = std::lerp(fromDeg, toDeg, static_cast<double>(i) / steps) * std::numbers::pi / 180.0;
    line.push_back({centre.x + radius * std::cos(a), centre.y + radius * std::sin(a)});
  }
  return line;
}

class Sheet {
 public:
  Sheet(int width, int height)
      : width_(width),
        height_(height),
        scale_(width / kPageWidthMm),
        graphite_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0f) {}

  /// A pencil line: pressure swells and fades a little, the hand wavers by hundredths of a millimetre.
  void pencil(const std::vector<Point>& line, double widthMm, double darkness, std::uint32_t seed,
              double waverMm = 0.03) {
    double along = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const double length = std::hypot(line[i + 1].x - line[i].x, line[i + 1].y - line[i].y);
      if (length <= 0.0) continue;
      const double nx = -(line[i + 1].y - line[i].y) / length, ny = (line[i + 1].x - line[i].x) / length;
      const double waver = (valueNoise(along / 22.0, 0.5, seed) - 0.5) * 2.0 * waverMm;
      const double pressure = 0.82 + 0.36 * (valueNoise(along / 14.0, 7.5, seed) - 0.5);
      segment({line[i].x + nx * waver, line[i].y + ny * waver},
              {line[i + 1].x + nx * waver, line[i + 1].y + ny * waver}, widthMm * (0.9 + 0.2 * pressure),
              darkness * pressure);
      along += length;
    }
  }

  QImage finish() const {
    QImage image(width_, height_, QImage::Format_Grayscale8);
    for (int y = 0; y < height_; ++y) {
      auto* row = image.scanLine(y);
      for (int x = 0; x < width_; ++x) row[x] = static_cast<unsigned char>(std::clamp(level(x, y), 0.0, 255.0) + 0.5);
    }
    const int dotsPerMeter = static_cast<int>(std::lround(scale_ * 1000.0));
    image.setDotsPerMeterX(dotsPerMeter);
    image.setDotsPerMeterY(dotsPerMeter);
    return image;
  }

 private:
  void segment(Point a, Point b, double widthMm, double darkness) {
    const double ax = a.x * scale_, ay = a.y * scale_, bx = b.x * scale_, by = b.y * scale_;
    const double radius = 0.5 * widthMm * scale_, soft = 0.75;
    const double reach = radius + 2.0 * soft;
    const int x0 = std::max(0, static_cast<int>(std::min(ax, bx) - reach)),
              x1 = std::min(width_ - 1, static_cast<int>(std::max(ax, bx) + reach) + 1);
    const int y0 = std::max(0, static_cast<int>(std::min(ay, by) - reach)),
              y1 = std::min(height_ - 1, static_cast<int>(std::max(ay, by) + reach) + 1);
    const double dx = bx - ax, dy = by - ay, squared = dx * dx + dy * dy;
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double px = x + 0.5 - ax, py = y + 0.5 - ay;
        const double f = squared > 0.0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0.0;
        const double distance = std::hypot(px - f * dx, py - f * dy);
        const double cover = 1.0 / (1.0 + std::exp((distance - radius) / (0.4 * soft)));
        float& cell =
            graphite_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
        cell = std::max(cell, static_cast<float>(cover * darkness));
      }
    }
  }

  /// Grey level of a pixel: gradated paper, its tooth, the graphite that the tooth took, and the scanner's noise.
  double level(int x, int y) const {
    const double u = (x + 0.5) / width_, v = (y + 0.5) / height_;
    const double paper = 247.0 - 62.0 * u * u - 16.0 * v + 5.0 * (valueNoise(5.0 * u, 5.0 * v, 11) - 0.5);
    const double mmX = x / scale_, mmY = y / scale_;
    const double tooth = 0.6 * valueNoise(mmX / 0.22, mmY / 0.22, 21) + 0.4 * valueNoise(mmX / 0.11, mmY / 0.11, 22);
    const double taken =
        graphite_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)] *
        std::clamp(0.62 + 0.62 * tooth, 0.0, 1.0);
    const double noise = (hashed(x, y, 31) + hashed(x, y, 32) + hashed(x, y, 33) - 1.5) * 5.0;
    return paper * (1.0 - std::min(0.94, taken)) + (tooth - 0.5) * 5.0 + noise;
  }

  int width_, height_;
  double scale_;
  std::vector<float> graphite_;
};

void drawCoupe(Sheet& sheet) {
  const double step = 0.4;
  const Point frontWheel{80.0, 140.0}, rearWheel{214.0, 140.0};
  const double arch = 21.5, wheel = 19.0;
  // The silhouette: nose, hood, windscreen, roof, fast back, tail; then the tail's corner and the sill with its arches.
  const std::vector<Point> upper = {{33.0, 133.0}, {33.5, 123.0}, {38.0, 113.5}, {52.0, 107.0}, {76.0, 101.5},
                                    {104.0, 96.0}, {122.0, 86.5}, {142.0, 77.5}, {164.0, 75.0}, {188.0, 78.5},
                                    {214.0, 88.5}, {236.0, 98.0}, {252.0, 103.0}};
  sheet.pencil(splineThrough(upper, step), 0.75, 0.95, 1);
  sheet.pencil(splineThrough({{252.0, 103.0}, {257.0, 114.0}, {258.0, 126.0}, {254.5, 138.0}}, step), 0.75, 0.95, 2);
  sheet.pencil(splineThrough({{254.5, 138.0}, {245.0, 140.2}, {rearWheel.x + arch, rearWheel.y}}, step), 0.7, 0.9, 3);
  sheet.pencil(arc(rearWheel, arch, 0.0, -180.0), 0.7, 0.92, 4);
  sheet.pencil(
      splineThrough({{rearWheel.x - arch, rearWheel.y}, {147.0, 141.2}, {frontWheel.x + arch, frontWheel.y}}, step),
      0.7, 0.92, 5);
  sheet.pencil(arc(frontWheel, arch, 0.0, -180.0), 0.7, 0.92, 6);
  sheet.pencil(splineThrough({{frontWheel.x - arch, frontWheel.y}, {44.0, 139.5}, {33.0, 133.0}}, step), 0.7, 0.9, 7);
  for (const Point& c : {frontWheel, rearWheel}) {
    sheet.pencil(arc(c, wheel, 0.0, 360.0), 0.6, 0.85, 8);
    sheet.pencil(arc(c, 0.62 * wheel, 0.0, 360.0), 0.45, 0.6, 9);
  }
  // Glass house and shoulder line.
  sheet.pencil(
      splineThrough({{113.0, 96.0}, {126.0, 88.2}, {143.0, 81.2}, {163.0, 79.2}, {184.0, 82.5}, {203.0, 91.0}}, step),
      0.5, 0.75, 10);
  sheet.pencil(splineThrough({{113.0, 96.0}, {140.0, 95.2}, {172.0, 94.0}, {203.0, 91.0}}, step), 0.5, 0.75, 11);
  sheet.pencil(splineThrough({{45.0, 116.0}, {80.0, 111.5}, {130.0, 108.0}, {185.0, 105.5}, {245.0, 108.0}}, step), 0.4,
               0.6, 12);
  // A few loose hatching strokes under the car: gradated shading that must not become a line.
  for (int i = 0; i < 26; ++i) {
    const double x = 48.0 + 8.0 * i + 2.0 * hashed(i, 1, 40);
    sheet.pencil({{x, 166.0}, {x + 9.0, 160.5 + hashed(i, 2, 40)}}, 1.6, 0.10 + 0.05 * hashed(i, 3, 40),
                 50u + static_cast<std::uint32_t>(i), 0.1);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int width = argc > 2 ? std::atoi(argv[2]) : 1754;
  if (argc < 2 || width < 200 || width > 20000) {
    std::fputs("usage: render_sample OUT.png [WIDTH_PX 200..20000]\n", stderr);
    return 2;
  }
  Sheet sheet(width, static_cast<int>(std::lround(width * kPageHeightMm / kPageWidthMm)));
  drawCoupe(sheet);
  if (!sheet.finish().save(QString::fromLocal8Bit(argv[1]), "PNG")) {
    std::fputs("render_sample: the picture could not be written\n", stderr);
    return 5;
  }
  return 0;
}
