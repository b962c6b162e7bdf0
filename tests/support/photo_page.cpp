// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/photo_page.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/base/angle.h"

namespace batten::test {
namespace {

constexpr int kSubsamples = 16;     // of a pixel, no two in one row or column of it
constexpr int kLatticeStep = 7;     // has no divisor in common with their number
constexpr double kPhotoInk = 25.0;  // [grey]
constexpr double kFilmDiagonal = 43.27;

}  // namespace

PhotoCamera::PhotoCamera(const PhotoPose& pose, int widthPx, int heightPx)
    : pose_(pose), width_(widthPx), height_(heightPx) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const double focal = pose.focal35Mm / kFilmDiagonal * std::hypot(widthPx, heightPx);
  const Eigen::Matrix3d turn = (AngleAxisd(pose.rollDeg * kRadPerDeg, Vector3d::UnitZ()) *
                                AngleAxisd(pose.tiltDeg * kRadPerDeg, Vector3d::UnitX()) *
                                AngleAxisd(pose.panDeg * kRadPerDeg, Vector3d::UnitY()))
                                   .toRotationMatrix();
  const double away = focal * pose.heightMm / (pose.fill * heightPx);
  const Vector3d middle(0.5 * pose.widthMm, 0.5 * pose.heightMm, 0.0);
  Eigen::Matrix3d plane, lens;
  plane << turn.col(0), turn.col(1), Vector3d(0, 0, away) - turn * middle;
  lens << focal, 0, 0.5 * widthPx, 0, focal, 0.5 * heightPx, 0, 0, 1;
  forth_ = lens * plane;
  back_ = forth_.inverse();
}

Vec2 PhotoCamera::toPicture(const Vec2& mm) const { return (forth_ * mm.homogeneous()).hnormalized(); }
Vec2 PhotoCamera::toSheet(const Vec2& px) const { return (back_ * px.homogeneous()).hnormalized(); }

SheetCorners PhotoCamera::corners() const {
  const double w = pose_.widthMm, h = pose_.heightMm;
  return {toPicture({0, 0}), toPicture({w, 0}), toPicture({w, h}), toPicture({0, h})};
}

Scan renderPhoto(const PhotoCamera& camera, const std::function<double(const Vec2&)>& darkness,
                 const PhotoStyle& style) {
  Scan scan;
  scan.grey = GreyImage(camera.widthPx(), camera.heightPx());
  if (style.isColour) scan.colour = ColourImage(camera.widthPx(), camera.heightPx());
  std::mt19937 random(style.seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const double w = camera.pose().widthMm, h = camera.pose().heightMm;
  for (int y = 0; y < camera.heightPx(); ++y) {
    for (int x = 0; x < camera.widthPx(); ++x) {
      double onSheet = 0.0, sum = 0.0;
      for (int k = 0; k < kSubsamples; ++k) {
        const Vec2 px(x + (k + 0.5) / kSubsamples, y + (k * kLatticeStep % kSubsamples + 0.5) / kSubsamples);
        const Vec2 mm = camera.toSheet(px);
        if (mm.x() < 0.0 || mm.y() < 0.0 || mm.x() > w || mm.y() > h) continue;
        onSheet += 1.0;
        sum += style.paper + darkness(mm) * (kPhotoInk - style.paper);
      }
      onSheet /= kSubsamples;
      const double paper = sum / kSubsamples;
      const double rough = std::lerp(style.tableRough, style.noise, onSheet) * normal(random);
      const double grey = std::clamp(paper + (1.0 - onSheet) * style.table + rough, 0.0, 255.0);
      scan.grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(grey * GreyImage::kGreyUnit));
      if (!style.isColour) continue;
      const double warm = 25.0 * (1.0 - onSheet);
      const auto byte = [](double v) { return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 255.0))); };
      scan.colour.row(y)[x] = {byte(grey + warm), byte(grey), byte(grey - warm)};
    }
  }
  scan.info.format = "PNG";
  scan.info.width = camera.widthPx();
  scan.info.height = camera.heightPx();
  return scan;
}

}  // namespace batten::test
