// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/border_fit.h"

#include <algorithm>
#include <cmath>

#include "core/curve/cubic.h"

namespace batten {
namespace {

constexpr int kFitRounds = 4;           ///< Of handles and parameters in turn.
constexpr int kFootRoundsOfBorder = 3;  ///< From one fit to the next parameters move little.
/// [rad] A cubic that turns farther fits badly.
constexpr double kMostTurnRad = 1.75;

constexpr double kNothing = 1e-3;  ///< Of the tolerance: shorter steps are rounding and would only tangle.

/// Fits cubics to the places of one smooth stretch.
class StretchFit {
 public:
  StretchFit(const std::vector<BorderPlace>& border, double tolerance, CancelCheck check, CubicRun& run)
      : border_(border), tolerance_(tolerance), check_(check), run_(run) {}

  /// The places [first, last], split by halves where one cubic is not enough.
  void add(std::size_t first, std::size_t last) {
    const Vec2 chord = border_[last].at - border_[first].at;
    if (last == first || check_.isCancelled()) return;
    if (last == first + 1) {
      const double third = chord.norm() / 3.0;
      put({border_[first].at, border_[first].at + third * border_[first].along,
           border_[last].at - third * border_[last].along, border_[last].at});
      return;
    }
    if (turnOver(first, last) <= kMostTurnRad) {
      const CubicBezier cubic = fitted(first, last);
      if (error_ <= tolerance_) {
        put(cubic);
        return;
      }
    }
    const std::size_t middle = first + (last - first) / 2;
    add(first, middle);
    add(middle, last);
  }

 private:
  void put(const CubicBezier& c) {
    if ((c[3] - run_.end()).norm() > kNothing * tolerance_) run_.cubics.push_back({c[1], c[2], c[3]});
  }

  double turnOver(std::size_t first, std::size_t last) const {
    double turn = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      const Vec2 &a = border_[i].along, &b = border_[i + 1].along;
      turn += std::abs(std::atan2(cross(a, b), a.dot(b)));
    }
    return turn;
  }

  /// The lengths of both handles by least squares over the places; sets the error.
  CubicBezier fitted(std::size_t first, std::size_t last) {
    const BorderPlace &from = border_[first], &to = border_[last];
    std::vector<double> t{0.0};
    for (std::size_t i = first + 1; i <= last; ++i) t.push_back(t.back() + (border_[i].at - border_[i - 1].at).norm());
    const double length = t.back();
    for (double& one : t) one /= length;
    CubicBezier cubic{};
    for (int round = 0; round < kFitRounds; ++round) {
      double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0;
      for (std::size_t i = first + 1; i < last; ++i) {
        const double u = t[i - first], r = 1.0 - u;
        // Only what is aside of the border counts: where along it a parameter lies is free.
        const Vec2 normal = leftNormal(border_[i].along);
        const double a = 3 * r * r * u * from.along.dot(normal), b = -3 * r * u * u * to.along.dot(normal);
        const Vec2 ends = r * r * (1.0 + 2.0 * u) * from.at + u * u * (1.0 + 2.0 * r) * to.at;
        const double rest = (border_[i].at - ends).dot(normal);
        aa += a * a;
        ab += a * b;
        bb += b * b;
        ra += a * rest;
        rb += b * rest;
      }
      const double determinant = aa * bb - ab * ab;
      double left = length / 3.0, right = length / 3.0;
      if (determinant > 1e-12 * aa * bb) {
        left = (bb * ra - ab * rb) / determinant;
        right = (aa * rb - ab * ra) / determinant;
      }
      if (!(left > 0.0 && left < length && right > 0.0 && right < length)) left = right = length / 3.0;
      cubic = {from.at, from.at + left * from.along, to.at - right * to.along, to.at};
      error_ = 0.0;
      for (std::size_t i = first + 1; i < last; ++i) {
        double& place = t[i - first];
        place = cubicFoot(cubic, border_[i].at, place, kFootRoundsOfBorder);
        error_ = std::max(error_, (border_[i].at - cubicPoint(cubic, place)).norm());
      }
      if (error_ <= 0.5 * tolerance_) break;
    }
    return cubic;
  }

  const std::vector<BorderPlace>& border_;
  double tolerance_;
  CancelCheck check_;
  CubicRun& run_;
  double error_ = 0.0;
};

}  // namespace

CubicRun fittedBorder(const std::vector<BorderPlace>& border, double tolerance, CancelCheck check) {
  CubicRun run;
  if (border.size() < 2) return run;
  run.start = border.front().at;
  StretchFit fit(border, tolerance, check, run);
  std::size_t first = 0;
  for (std::size_t i = 1; i <= border.size(); ++i) {
    if (i < border.size() && !border[i].begins) continue;
    fit.add(first, i - 1);
    // A stretch that begins elsewhere is led to by a line.
    if (i < border.size()) {
      const Vec2 from = border[i - 1].at, to = border[i].at;
      if ((to - from).norm() > kNothing * tolerance)
        run.cubics.push_back({from + (to - from) / 3.0, to - (to - from) / 3.0, to});
      first = i;
    }
  }
  return run;
}

}  // namespace batten
