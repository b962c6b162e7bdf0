// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/cubic_chain.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace batten::test {
namespace {

constexpr int kPlaces = 40;  // of a cubic, where its distance is taken
constexpr int kSteps = 12;   // of Gauss-Newton

class CubicChain {
 public:
  CubicChain(const TruthPiece& piece, bool closed, double tolerance)
      : points_(piece.points), closed_(closed), tolerance_(tolerance) {
    if (closed) points_.insert(points_.end(), piece.points.begin(), piece.points.end());
    last_ = static_cast<int>(piece.points.size()) - (closed ? 0 : 1);
  }

  int controlPoints() const {
    int cubics = 0;
    for (int from = 0; from < last_; ++cubics) {
      int good = from + 1, bad = last_ + 1;
      for (int step = 64; good + step <= last_; step *= 2) {
        if (!fits(from, good + step)) {
          bad = good + step;
          break;
        }
        good += step;
      }
      if (bad > last_ && fits(from, last_)) good = last_;
      while (bad - good > 4) {
        const int middle = (good + std::min(bad, last_)) / 2;
        if (middle == good) break;
        (fits(from, middle) ? good : bad) = middle;
      }
      from = good;
    }
    return 3 * cubics + (closed_ ? 0 : 1);
  }

 private:
  const Vec2& at(int i) const { return points_[i]; }
  Vec2 tangent(int i) const {
    const int end = static_cast<int>(points_.size()) - 1;
    const bool inside = closed_ || (i > 0 && i < last_);
    const int a = inside || i > 0 ? std::max(0, i - 1) : 0, b = std::min(end, inside || i == 0 ? i + 1 : i);
    return (at(b) - at(a)).normalized();
  }

  /// Signed distances of places of the cubic from the line.
  Eigen::VectorXd offsets(int from, int to, const Eigen::Vector2d& handles) const {
    const Vec2 a = at(from), d = at(to), b = a + handles[0] * tangent(from), c = d - handles[1] * tangent(to);
    Eigen::VectorXd result(kPlaces);
    int foot = from;
    for (int k = 0; k < kPlaces; ++k) {
      const double t = (k + 0.5) / kPlaces, s = 1.0 - t;
      const Vec2 p = s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d;
      while (foot < to && (at(foot + 1) - p).squaredNorm() <= (at(foot) - p).squaredNorm()) ++foot;
      const Vec2 along = tangent(foot), away = p - at(foot);
      result[k] = along.x() * away.y() - along.y() * away.x();
    }
    return result;
  }

  bool fits(int from, int to) const {
    double length = 0.0;
    for (int i = from; i < to; ++i) length += (at(i + 1) - at(i)).norm();
    Eigen::Vector2d handles(length / 3.0, length / 3.0);
    for (int step = 0; step < kSteps; ++step) {
      const Eigen::VectorXd off = offsets(from, to, handles);
      if (off.cwiseAbs().maxCoeff() <= tolerance_) return true;
      Eigen::Matrix<double, kPlaces, 2> by;
      const double small = 1e-4 * length;
      for (int i = 0; i < 2; ++i) {
        Eigen::Vector2d moved = handles;
        moved[i] += small;
        by.col(i) = (offsets(from, to, moved) - off) / small;
      }
      Eigen::Matrix2d normal = by.transpose() * by;
      normal.diagonal().array() *= 1.0 + 1e-6;
      const Eigen::Vector2d way = normal.inverse() * (by.transpose() * off);
      if (!way.allFinite()) return false;
      handles -= way;
      handles = handles.cwiseMax(0.01 * length).cwiseMin(2.0 * length);
    }
    return offsets(from, to, handles).cwiseAbs().maxCoeff() <= tolerance_;
  }

  std::vector<Vec2> points_;
  bool closed_;
  double tolerance_;
  int last_ = 0;
};

}  // namespace

int cubicChainPoints(const TruthPiece& piece, bool closed, double tolerance) {
  return CubicChain(piece, closed, tolerance).controlPoints();
}

}  // namespace batten::test
