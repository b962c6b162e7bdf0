// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/svg/svg_path_data.h"

#include <Eigen/LU>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "core/base/angle.h"
#include "core/curve/knot_operations.h"
#include "core/exchange/model/cad_shape.h"

namespace batten {
namespace {

bool isPathBlank(char c) { return c == ' ' || c == ',' || c == '\n' || c == '\r' || c == '\t' || c == '\f'; }

double chordOf(const Vec2& a, const Vec2& b) { return std::max((b - a).norm(), 1e-300); }

class PathReader {
 public:
  explicit PathReader(std::string_view data) : rest_(data) {}

  std::optional<std::vector<SvgSubpath>> read() {
    char command = 0;
    while (true) {
      while (!rest_.empty() && isPathBlank(rest_.front())) rest_.remove_prefix(1);
      if (rest_.empty()) break;
      if (std::isalpha(static_cast<unsigned char>(rest_.front())) != 0) {
        command = rest_.front();
        rest_.remove_prefix(1);
      } else if (command == 0 || command == 'Z' || command == 'z') {
        return std::nullopt;
      } else if (command == 'M' || command == 'm') {
        command = command == 'M' ? 'L' : 'l';  // what follows the first place of a move are lines
      }
      if (!isMoved_ && command != 'M' && command != 'm') return std::nullopt;
      if (!step(command)) return std::nullopt;
    }
    end(false);
    return std::move(parts_);
  }

 private:
  bool step(char command) {
    const bool isOwn = command >= 'a';  // relative to where the pen is
    const Vec2 base = isOwn ? at_ : Vec2::Zero();
    switch (isOwn ? command - 'a' + 'A' : command) {
      case 'M': {
        const auto to = point(base);
        if (!to) return false;
        end(false);
        at_ = start_ = *to;
        isMoved_ = true;
        return true;
      }
      case 'Z':
        if (at_ != start_) line(start_);
        end(true);
        at_ = start_;
        return true;
      case 'L': {
        const auto to = point(base);
        return to && line(*to);
      }
      case 'H': {
        const auto x = takeSvgNumber(rest_);
        return x && line(Vec2(base.x() + *x, at_.y()));
      }
      case 'V': {
        const auto y = takeSvgNumber(rest_);
        return y && line(Vec2(at_.x(), base.y() + *y));
      }
      case 'C': {
        const auto a = point(base), b = point(base), to = point(base);
        return a && b && to && cubic(*a, *b, *to);
      }
      case 'S': {
        const Vec2 a = lastHandle_ ? Vec2(2.0 * at_ - *lastHandle_) : at_;
        const auto b = point(base), to = point(base);
        return b && to && cubic(a, *b, *to);
      }
      case 'Q': {
        const auto handle = point(base), to = point(base);
        return handle && to && quadratic(*handle, *to);
      }
      case 'T': {
        const Vec2 handle = lastQuadratic_ ? Vec2(2.0 * at_ - *lastQuadratic_) : at_;
        const auto to = point(base);
        return to && quadratic(handle, *to);
      }
      case 'A':
        return arc(base);
      default:
        return false;
    }
  }

  std::optional<Vec2> point(const Vec2& base) {
    const auto x = takeSvgNumber(rest_);
    const auto y = x ? takeSvgNumber(rest_) : std::nullopt;
    return y ? std::optional(Vec2(base + Vec2(*x, *y))) : std::nullopt;
  }
  /// 0 or 1, which may stand right before the next number.
  std::optional<bool> flag() {
    while (!rest_.empty() && isPathBlank(rest_.front())) rest_.remove_prefix(1);
    if (rest_.empty() || (rest_.front() != '0' && rest_.front() != '1')) return std::nullopt;
    const bool isSet = rest_.front() == '1';
    rest_.remove_prefix(1);
    return isSet;
  }

  bool add(Result<NurbsCurve> segment, const Vec2& to) {
    lastHandle_.reset();
    lastQuadratic_.reset();
    if (segment && to.allFinite()) part_.segments.push_back(std::move(*segment));
    at_ = to;
    return to.allFinite();
  }
  bool line(const Vec2& to) {
    const double length = chordOf(at_, to);
    if (to == at_) return add(fail(ErrorCode::NoCurve, ""), to);
    return add(NurbsCurve::make(1, {0.0, 0.0, length, length}, {at_, to}), to);
  }
  bool cubic(const Vec2& a, const Vec2& b, const Vec2& to) {
    const double l = chordOf(at_, a) + chordOf(a, b) + chordOf(b, to);
    if (a == at_ && b == at_ && to == at_) return add(fail(ErrorCode::NoCurve, ""), to);
    if (!add(NurbsCurve::make(3, {0.0, 0.0, 0.0, 0.0, l, l, l, l}, {at_, a, b, to}), to)) return false;
    lastHandle_ = b;
    return true;
  }
  bool quadratic(const Vec2& handle, const Vec2& to) {
    const Vec2 a = at_ + 2.0 / 3.0 * (handle - at_), b = to + 2.0 / 3.0 * (handle - to);
    if (!cubic(a, b, to)) return false;
    lastHandle_.reset();
    lastQuadratic_ = handle;
    return true;
  }
  bool arc(const Vec2& base) {
    const auto rx = takeSvgNumber(rest_);
    const auto ry = rx ? takeSvgNumber(rest_) : std::nullopt;
    const auto turned = ry ? takeSvgNumber(rest_) : std::nullopt;
    const auto large = turned ? flag() : std::nullopt;
    const auto sweep = large ? flag() : std::nullopt;
    const auto to = sweep ? point(base) : std::nullopt;
    if (!to) return false;
    if (*rx == 0.0 || *ry == 0.0) return line(*to);
    auto curve = svgArc({at_, *to, Vec2(std::abs(*rx), std::abs(*ry)), *turned * kRadPerDeg, *large, *sweep});
    return add(curve ? Result<NurbsCurve>(std::move(*curve)) : fail(ErrorCode::NoCurve, ""), *to);
  }
  void end(bool closed) {
    part_.closed = closed;
    if (!part_.segments.empty()) parts_.push_back(std::move(part_));
    part_ = {};
    lastHandle_.reset();
    lastQuadratic_.reset();
  }

  std::string_view rest_;
  Vec2 at_ = Vec2::Zero(), start_ = Vec2::Zero();
  std::optional<Vec2> lastHandle_, lastQuadratic_;
  bool isMoved_ = false;
  SvgSubpath part_;
  std::vector<SvgSubpath> parts_;
};

}  // namespace

std::optional<double> takeSvgNumber(std::string_view& text) {
  while (!text.empty() && isPathBlank(text.front())) text.remove_prefix(1);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(end - text.data());
  return value;
}

std::optional<NurbsCurve> svgArc(const SvgArc& arc) {
  if (arc.from == arc.to) return std::nullopt;
  Eigen::Matrix2d turn;
  turn << std::cos(arc.turnedRad), -std::sin(arc.turnedRad), std::sin(arc.turnedRad), std::cos(arc.turnedRad);
  const Vec2 half = turn.transpose() * (0.5 * (arc.from - arc.to));
  const Vec2 unit = half.cwiseQuotient(arc.radii);
  const double reach = unit.squaredNorm();  // above 1: the radii are too small and grow
  const Vec2 radii = arc.radii * (reach > 1.0 ? std::sqrt(reach) : 1.0);
  const Vec2 own = half.cwiseQuotient(radii);
  const double away =
      std::sqrt(std::max(0.0, 1.0 / own.squaredNorm() - 1.0)) * (arc.isLarge == arc.isClockwise ? -1.0 : 1.0);
  const Vec2 centre = away * Vec2(own.y(), -own.x());  // in the unit circle's frame
  const Vec2 first = own - centre, last = -own - centre;
  double sweep = std::atan2(cross(first, last), first.dot(last));
  if (arc.isClockwise && sweep < 0.0) sweep += kFullTurnRad;
  if (!arc.isClockwise && sweep > 0.0) sweep -= kFullTurnRad;
  const double from = std::atan2(first.y(), first.x());
  auto circle = curveOf(CadArc{Vec2::Zero(), 1.0, sweep > 0.0 ? from : from + sweep, std::abs(sweep)});
  if (!circle) return std::nullopt;
  const Eigen::Matrix2d linear = turn * radii.asDiagonal();
  if (!(std::abs(linear.determinant()) > 0.0)) return std::nullopt;
  const Vec2 middle = 0.5 * (arc.from + arc.to) + linear * centre;
  NurbsCurve curve = circle->mapped(linear, middle);
  if (sweep < 0.0) curve = reversed(curve);
  // Ends are the places that the path names.
  std::vector<Vec2> points(curve.controlPoints().begin(), curve.controlPoints().end());
  points.front() = arc.from;
  points.back() = arc.to;
  auto exact = NurbsCurve::make(curve.degree(), {curve.knots().begin(), curve.knots().end()}, std::move(points),
                                {curve.weights().begin(), curve.weights().end()});
  return exact ? std::optional(std::move(*exact)) : std::nullopt;
}

std::optional<std::vector<SvgSubpath>> readSvgPath(std::string_view data) { return PathReader(data).read(); }

}  // namespace batten
