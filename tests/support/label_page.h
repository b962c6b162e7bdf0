// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/vec2.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten::test {

/// A rendered page of which every pixel is known to be of a stroke, of a shape or paper.
class LabelPage {
 public:
  LabelPage(int width, int height);

  /// What is painted from here on is one object: a stroke or a shape. Shapes count where both lie.
  void begin(bool isShape);
  /// A line with round ends whose width runs evenly from `from` to `to`. [px]
  void line(const std::vector<Vec2>& points, double from, double to);
  void line(const std::vector<Vec2>& points, double width) { line(points, width, width); }
  /// A line of a nib of this length and thickness, held at an angle to the x axis. [px, rad]
  void nib(const std::vector<Vec2>& points, double length, double thickness, double angleRad);
  /// A filled area with holes (even-odd).
  void area(const std::vector<std::vector<Vec2>>& outlines);

  /// Ink as a scan with blur .8 px and noise gives it at half its contrast.
  BitImage ink(unsigned seed) const;
  GreyImage grey(unsigned seed) const;

  struct Score {
    double strokes = 1.0, shapes = 1.0;  ///< Share of the ink of each kind that has the right label.
    bool hasStrokes = false, hasShapes = false;
    double objects = 1.0;  ///< Share of the objects of which 80 % have the right label.
    double balanced() const;
  };
  Score score(const BitImage& ink, const BitImage& shapes) const;

 private:
  void paint(int x, int y, double cover);
  void capsule(const Vec2& a, const Vec2& b, double ra, double rb);

  struct Pixel {
    float cover = 0.0f;
    int object = -1;
    bool isShape = false;
  };
  int width_, height_;
  std::vector<Pixel> pixels_;
  std::vector<bool> isShape_;
};

std::vector<Vec2> circle(const Vec2& centre, double radius);

struct LabelScene {
  std::string name;
  std::function<LabelPage(unsigned seed)> make;
};
/// Mixed pages, crossings of two widths, tapered strokes, solids with lines, alphabets of one pen and of a broad nib in
/// three sizes each.
std::vector<LabelScene> labelScenes();

}  // namespace batten::test
