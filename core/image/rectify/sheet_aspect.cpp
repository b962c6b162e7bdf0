// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/rectify/sheet_aspect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/angle.h"
#include "core/image/rectify/sheet_map.h"

namespace batten {
namespace {

constexpr double kFilmDiagonalMm = 43.27;  // of 36 x 24 mm, to which focal lengths are related
constexpr double kUsualFocal35Mm = 27.0;   // main camera of a telephone
constexpr double kUsualSpread = 0.25;      // of its logarithm: 21 to 35 mm
constexpr double kStatedSpread = 0.03;     // the file's is rounded, and the picture cropped a little by stabilisation
constexpr double kSkewSpreadRad = 0.2 * kRadPerDeg;  // lens distortion, corners set by hand
constexpr double kFarthestLog = 1.5;                 // of the logarithm of the focal length
constexpr int kFocalSteps = 600;                     // of it: 0.5 % each

/// Whether a picture is as a camera makes it, and not a part of one, to which the file's focal length belongs no more.
bool isWholePicture(const PictureView& view) {
  constexpr double kSameShape = 0.01;  // share by which a picture may differ from the shape of a camera
  const double shape =
      static_cast<double>(std::max(view.widthPx, view.heightPx)) / std::min(view.widthPx, view.heightPx);
  return std::ranges::any_of(std::array{4.0 / 3.0, 3.0 / 2.0, 16.0 / 9.0},
                             [&](double camera) { return std::abs(shape - camera) <= kSameShape * camera; });
}

struct Agreement {
  double logAspect = 0.0, misfit = 0.0;  ///< Misfit: in squares of its spread.
};
struct SeenFrom {
  double aspect = 1.0, skewRad = 0.0;
};

/// What the rectangle would be, seen by a camera of this focal length.
SeenFrom seenFrom(const Eigen::Matrix3d& map, double focalPx) {
  const auto ray = [&](int column) {
    return Eigen::Vector3d(map(0, column) / focalPx, map(1, column) / focalPx, map(2, column));
  };
  const Eigen::Vector3d across = ray(0), down = ray(1);
  const double cosine = across.dot(down) / (across.norm() * down.norm());
  return {across.norm() / down.norm(), std::asin(std::clamp(cosine, -1.0, 1.0))};
}

}  // namespace

SheetAspect sheetAspect(const SheetCorners& cornersPx, const PictureView& view) {
  SheetCorners centred = cornersPx;
  for (Vec2& corner : centred) corner -= 0.5 * Vec2(view.widthPx, view.heightPx);
  const Eigen::Matrix3d map = SheetMap(centred, 1.0, 1.0).matrix();
  const double diagonal = std::hypot(view.widthPx, view.heightPx);
  const double likelyPx = view.focal35Mm.value_or(kUsualFocal35Mm) / kFilmDiagonalMm * diagonal;
  const double spread = view.focal35Mm && isWholePicture(view) ? kStatedSpread : kUsualSpread;
  // The mean over all focal lengths, weighted by how well they agree with the angles and with what is usual.
  std::vector<Agreement> all;
  for (int i = -kFocalSteps; i <= kFocalSteps; ++i) {
    const double logarithm = kFarthestLog * i / kFocalSteps;
    const SeenFrom seen = seenFrom(map, likelyPx * std::exp(logarithm));
    all.push_back(
        {std::log(seen.aspect), std::pow(logarithm / spread, 2) + std::pow(seen.skewRad / kSkewSpreadRad, 2)});
  }
  const double least = std::ranges::min_element(all, {}, &Agreement::misfit)->misfit;
  double weights = 0.0, sum = 0.0, squares = 0.0;
  for (const auto& [logAspect, misfit] : all) {
    const double weight = std::exp(-0.5 * (misfit - least));
    weights += weight;
    sum += weight * logAspect;
    squares += weight * logAspect * logAspect;
  }
  const double mean = sum / weights;
  return {std::exp(mean), std::sqrt(std::max(0.0, squares / weights - mean * mean))};
}

}  // namespace batten
