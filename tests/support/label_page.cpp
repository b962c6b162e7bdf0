// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/label_page.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/ink_page.h"
#include "tests/support/render_page.h"

namespace batten::test {
namespace {

constexpr int kPageWidth = 1200, kPageHeight = 900;
using Random = std::mt19937;

double uniform(Random& random, double from, double to) {
  return from + (to - from) * static_cast<double>(random() >> 5) / static_cast<double>(1u << 27);
}

bool isWithin(const std::vector<Vec2>& outline, const Vec2& p) {
  bool in = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vec2 &a = outline[i], &b = outline[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      in = !in;
  }
  return in;
}

std::vector<Vec2> cubic(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 80; ++i) {
    const double t = i / 80.0, u = 1.0 - t;
    points.push_back(u * u * u * a + 3 * u * u * t * b + 3 * u * t * t * c + t * t * t * d);
  }
  return points;
}

std::vector<Vec2> arc(const Vec2& centre, double rx, double ry, double fromDeg, double toDeg) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 40; ++i) {
    const double t = (fromDeg + (toDeg - fromDeg) * i / 40.0) * std::numbers::pi / 180.0;
    points.push_back(centre + Vec2(rx * std::cos(t), ry * std::sin(t)));
  }
  return points;
}

// A gentle random curve in a box.
std::vector<Vec2> wave(Random& random, const Vec2& corner, const Vec2& size) {
  const auto in = [&](double x) { return Vec2(corner + Vec2(x * size.x(), uniform(random, 0.1, 0.9) * size.y())); };
  const Vec2 a = in(0.05), b = in(0.35), c = in(0.65), d = in(0.95);
  return cubic(a, b, c, d);
}

// A blob, or a polygon, with `holes` round holes.
std::vector<std::vector<Vec2>> solid(Random& random, const Vec2& centre, double radius, bool hole) {
  std::vector<Vec2> outline;
  if (random() % 2 == 0) {
    const double a = uniform(random, 0.05, 0.2), b = uniform(random, 0.03, 0.1), f = uniform(random, 0.0, 6.0);
    for (int i = 0; i < 180; ++i) {
      const double t = i * std::numbers::pi / 90.0;
      outline.push_back(centre + radius * (1.0 + a * std::cos(2 * t + f) + b * std::cos(3 * t)) *
                                     Vec2(std::cos(t), std::sin(t)));
    }
  } else {
    const int n = 4 + static_cast<int>(random() % 3);
    const double f = uniform(random, 0.0, 6.0);
    for (int i = 0; i < n; ++i) {
      const double t = f + 2.0 * i * std::numbers::pi / n;
      outline.push_back(centre + radius * uniform(random, 0.85, 1.1) * Vec2(std::cos(t), std::sin(t)));
    }
  }
  std::vector<std::vector<Vec2>> outlines = {outline};
  if (hole)
    outlines.push_back(circle(centre + 0.15 * radius * Vec2(uniform(random, -1, 1), uniform(random, -1, 1)),
                              uniform(random, 0.2, 0.3) * radius));
  return outlines;
}

LabelPage mixedPage(unsigned seed) {
  Random random(seed);
  LabelPage page(kPageWidth, kPageHeight);
  const double pen = uniform(random, 2.0, 6.0);
  for (int cell = 0; cell < 12; ++cell) {
    const Vec2 corner(20.0 + 295.0 * (cell % 4), 20.0 + 295.0 * (cell / 4)), centre = corner + Vec2(135, 135);
    switch (cell % 6) {
      case 0:
      case 3:
        for (int i = 0; i < 3; ++i) {
          page.begin(false);
          page.line(wave(random, corner, {270, 270}), i == 0 ? uniform(random, 2.0, 9.0) : pen);
        }
        break;
      case 1:
      case 4: {
        const double radius = uniform(random, 40.0, 70.0);
        page.begin(true);
        page.area(solid(random, centre, radius, cell % 6 == 1));
        for (int i = 0; i < 2; ++i) {
          const double t = uniform(random, 0.0, 1.2) + 3.0 * i;
          const Vec2 out(std::cos(t), std::sin(t));
          page.begin(false);
          page.line(cubic(centre + 0.8 * radius * out, centre + 1.2 * radius * out,
                          centre + 1.5 * radius * out + 15.0 * leftNormal(out), centre + 132.0 * out),
                    pen);
        }
        break;
      }
      case 2:
        page.begin(true);
        page.area(solid(random, centre - Vec2(40, 40), uniform(random, 30.0, 60.0), true));
        for (int i = 0; i < 6; ++i) {
          page.begin(true);
          page.area({circle(corner + Vec2(30 + 40.0 * i, 230), pen * uniform(random, 0.8, 1.8))});
        }
        break;
      default:
        page.begin(false);
        page.line(wave(random, corner, {270, 270}), pen);
        page.begin(false);
        page.line(arc(centre, 90, 60, 0, 360), pen);
    }
  }
  return page;
}

LabelPage crossPage(unsigned seed) {
  Random random(seed);
  LabelPage page(kPageWidth, kPageHeight);
  for (int i = 0; i < 10; ++i) {
    page.begin(false);
    page.line(wave(random, {20, 20}, {1160, 860}), i % 2 == 0 ? 3.0 : uniform(random, 6.0, 9.0));
  }
  return page;
}

LabelPage taperPage(unsigned seed) {
  Random random(seed);
  LabelPage page(kPageWidth, kPageHeight);
  for (int i = 0; i < 12; ++i) {
    page.begin(false);
    const Vec2 corner(20.0 + 295.0 * (i % 4), 20.0 + 295.0 * (i / 4));
    page.line(wave(random, corner, {270, 270}), 1.6, uniform(random, 4.0, 8.0));
  }
  return page;
}

LabelPage solidPage(unsigned seed) {
  Random random(seed);
  LabelPage page(kPageWidth, kPageHeight);
  const double pen = uniform(random, 2.5, 6.0);
  std::vector<Vec2> centres;
  for (int i = 0; i < 6; ++i) {
    centres.push_back(
        {180.0 + 400.0 * (i % 3) + uniform(random, -40, 40), 220.0 + 440.0 * (i / 3) + uniform(random, -50, 50)});
    page.begin(true);
    page.area(solid(random, centres.back(), uniform(random, 45.0, 95.0), i % 2 == 0));
  }
  const auto join = [&](int a, int b) {
    const Vec2 d = centres[b] - centres[a];
    page.begin(false);
    const Vec2 side = uniform(random, -0.3, 0.3) * leftNormal(d);
    // From within one solid to within the other, clear of holes in their middles.
    page.line(
        cubic(centres[a] + 0.12 * d, centres[a] + 0.35 * d + side, centres[b] - 0.35 * d + side, centres[b] - 0.12 * d),
        pen);
  };
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {0, 3}, {3, 4}, {4, 5}, {2, 5}, {1, 4}}) join(a, b);
  page.begin(false);
  page.line(arc({600, 450}, 520, 380, 0, 360), pen);
  return page;
}

using Letter = std::vector<std::vector<Vec2>>;

// Letters in a box 0..0.7 wide and 0..1 high, y down.
std::vector<Letter> alphabet() {
  const auto l = [](double x0, double y0, double x1, double y1) { return std::vector<Vec2>{{x0, y0}, {x1, y1}}; };
  const auto bowl = [](double x, double y, double r, double h) { return arc({x, y}, r, h, -90, 90); };
  return {{l(0, 1, 0.35, 0), l(0.35, 0, 0.7, 1), l(0.12, 0.65, 0.58, 0.65)},
          {arc({0.38, 0.5}, 0.38, 0.5, -45, -315)},
          {l(0, 0, 0, 1), bowl(0.1, 0.5, 0.5, 0.5), l(0, 0, 0.1, 0), l(0, 1, 0.1, 1)},
          {l(0, 0, 0, 1), l(0, 0, 0.6, 0), l(0, 0.5, 0.5, 0.5), l(0, 1, 0.6, 1)},
          {l(0, 0, 0, 1), l(0.65, 0, 0.65, 1), l(0, 0.5, 0.65, 0.5)},
          {l(0, 0, 0, 1), l(0.6, 0, 0, 0.55), l(0.2, 0.4, 0.65, 1)},
          {l(0, 0, 0, 1), l(0, 1, 0.55, 1)},
          {l(0, 1, 0, 0), l(0, 0, 0.65, 1), l(0.65, 1, 0.65, 0)},
          {arc({0.36, 0.5}, 0.36, 0.5, 0, 360)},
          {l(0, 0, 0, 1), bowl(0.2, 0.27, 0.35, 0.27), l(0, 0, 0.2, 0), l(0, 0.54, 0.2, 0.54), l(0.2, 0.54, 0.6, 1)},
          {arc({0.32, 0.26}, 0.28, 0.26, -20, -250), arc({0.32, 0.75}, 0.3, 0.25, -100, 160)},
          {l(0, 0, 0.7, 0), l(0.35, 0, 0.35, 1)},
          {l(0, 0, 0, 0.7), arc({0.32, 0.68}, 0.32, 0.32, 180, 0), l(0.64, 0.7, 0.64, 0)},
          {l(0, 0, 0.35, 1), l(0.35, 1, 0.7, 0)},
          {l(0, 0, 0.65, 1), l(0.65, 0, 0, 1)},
          {l(0, 0, 0.6, 0), l(0.6, 0, 0, 1), l(0, 1, 0.6, 1)}};
}

LabelPage lettersPage(unsigned seed, double height, bool broad) {
  Random random(seed);
  LabelPage page(kPageWidth, kPageHeight);
  const std::vector<Letter> letters = alphabet();
  const double pen = broad ? height * uniform(random, 0.13, 0.25) : std::max(2.0, height * uniform(random, 0.07, 0.11));
  const double angle = -uniform(random, 0.55, 0.8);
  const double step = 1.25 * height, line = 1.6 * height;
  const int perRow = static_cast<int>((kPageWidth - 2.0 * height) / step);
  const int rows = std::min(4, static_cast<int>((kPageHeight - height) / line));
  for (int i = 0; i < perRow * rows; ++i) {
    const Vec2 corner(height + step * (i % perRow), 0.6 * height + line * (i / perRow));
    page.begin(broad);
    const double slant = uniform(random, -0.05, 0.05);
    for (const std::vector<Vec2>& stroke : letters[random() % letters.size()]) {
      std::vector<Vec2> points;
      for (const Vec2& p : stroke) points.push_back(corner + height * Vec2(p.x() - slant * p.y(), p.y()));
      if (broad) {
        page.nib(points, pen, std::max(1.5, 0.15 * pen), angle);
      } else {
        page.line(points, pen);
      }
    }
  }
  return page;
}

}  // namespace

std::vector<Vec2> circle(const Vec2& centre, double radius) {
  std::vector<Vec2> points;
  for (int i = 0; i < 120; ++i) {
    const double t = i * std::numbers::pi / 60.0;
    points.push_back(centre + radius * Vec2(std::cos(t), std::sin(t)));
  }
  return points;
}

LabelPage::LabelPage(int width, int height) : width_(width), height_(height), pixels_(std::ptrdiff_t{width} * height) {}

void LabelPage::begin(bool isShape) { isShape_.push_back(isShape); }

void LabelPage::paint(int x, int y, double cover) {
  Pixel& p = pixels_[y * width_ + x];
  p.cover = std::max(p.cover, static_cast<float>(cover));
  if (cover < 0.3 || p.isShape) return;
  p.isShape = isShape_.back();
  p.object = static_cast<int>(isShape_.size()) - 1;
}

void LabelPage::capsule(const Vec2& a, const Vec2& b, double ra, double rb) {
  const double r = std::max(ra, rb) + 1.0;
  const int x0 = std::max(0, static_cast<int>(std::min(a.x(), b.x()) - r));
  const int x1 = std::min(width_ - 1, static_cast<int>(std::max(a.x(), b.x()) + r));
  const int y0 = std::max(0, static_cast<int>(std::min(a.y(), b.y()) - r));
  const int y1 = std::min(height_ - 1, static_cast<int>(std::max(a.y(), b.y()) + r));
  const Vec2 d = b - a;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Vec2 p(x + 0.5, y + 0.5);
      const double t = d.squaredNorm() > 0.0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
      const double cover = ra + (rb - ra) * t - (p - a - t * d).norm() + 0.5;
      if (cover > 0.0) paint(x, y, std::min(1.0, cover));
    }
  }
}

void LabelPage::line(const std::vector<Vec2>& points, double from, double to) {
  const auto n = static_cast<double>(points.size() - 1);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto at = [&](std::size_t k) { return 0.5 * (from + (to - from) * static_cast<double>(k) / n); };
    capsule(points[i], points[i + 1], at(i), at(i + 1));
  }
}

void LabelPage::nib(const std::vector<Vec2>& points, double length, double thickness, double angleRad) {
  const Vec2 half = 0.5 * (length - thickness) * Vec2(std::cos(angleRad), std::sin(angleRad));
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec2 d = points[i + 1] - points[i];
    const int steps = std::max(1, static_cast<int>(2.0 * d.norm()));
    for (int k = 0; k <= steps; ++k) {
      const Vec2 at = points[i] + d * (static_cast<double>(k) / steps);
      capsule(at - half, at + half, 0.5 * thickness, 0.5 * thickness);
    }
  }
}

void LabelPage::area(const std::vector<std::vector<Vec2>>& outlines) {
  constexpr int kSub = 4;
  Vec2 low = outlines[0][0], high = low;
  for (const Vec2& p : outlines[0]) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  for (int y = std::max(0, static_cast<int>(low.y())); y <= std::min(height_ - 1, static_cast<int>(high.y())); ++y) {
    for (int x = std::max(0, static_cast<int>(low.x())); x <= std::min(width_ - 1, static_cast<int>(high.x())); ++x) {
      int in = 0;
      for (int k = 0; k < kSub * kSub; ++k) {
        const Vec2 p(x + (k % kSub + 0.5) / kSub, y + (k / kSub + 0.5) / kSub);
        bool inside = false;
        for (const auto& outline : outlines) inside = inside != isWithin(outline, p);
        in += inside ? 1 : 0;
      }
      if (in > 0) paint(x, y, static_cast<double>(in) / (kSub * kSub));
    }
  }
}

GreyImage LabelPage::grey(unsigned seed) const {
  std::vector<float> cover;
  for (const Pixel& p : pixels_) cover.push_back(p.cover);
  return renderPage(std::move(cover), width_, height_, penPage(6.0, seed)).grey;
}

BitImage LabelPage::ink(unsigned seed) const { return penInk(grey(seed)); }

double LabelPage::Score::balanced() const {
  if (!hasStrokes) return shapes;
  if (!hasShapes) return strokes;
  return 0.5 * (strokes + shapes);
}

LabelPage::Score LabelPage::score(const BitImage& ink, const BitImage& shapes) const {
  struct Count {
    int all = 0, right = 0;
    double share() const { return all > 0 ? static_cast<double>(right) / all : 1.0; }
  };
  std::vector<Count> object(isShape_.size());
  Count kind[2];
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Pixel& p = pixels_[y * width_ + x];
      if (!ink.at(x, y) || p.object < 0) continue;
      const int right = shapes.at(x, y) == p.isShape ? 1 : 0;
      for (Count* c : {&object[p.object], &kind[p.isShape ? 1 : 0]}) {
        ++c->all;
        c->right += right;
      }
    }
  }
  Score s;
  s.strokes = kind[0].share();
  s.shapes = kind[1].share();
  s.hasStrokes = kind[0].all > 0;
  s.hasShapes = kind[1].all > 0;
  Count objects;
  for (const Count& c : object) {
    if (c.all == 0) continue;
    ++objects.all;
    objects.right += c.share() >= 0.8 ? 1 : 0;
  }
  s.objects = objects.share();
  return s;
}

std::vector<LabelScene> labelScenes() {
  std::vector<LabelScene> scenes = {
      {"mixed", mixedPage}, {"solid", solidPage}, {"taper", taperPage}, {"cross", crossPage}};
  for (const auto& [name, height] : {std::pair{"mono S", 22.0}, {"mono M", 50.0}, {"mono L", 120.0}})
    scenes.push_back({name, [height = height](unsigned seed) { return lettersPage(seed, height, false); }});
  for (const auto& [name, height] : {std::pair{"nib S", 32.0}, {"nib M", 60.0}, {"nib L", 140.0}})
    scenes.push_back({name, [height = height](unsigned seed) { return lettersPage(seed, height, true); }});
  return scenes;
}

}  // namespace batten::test
