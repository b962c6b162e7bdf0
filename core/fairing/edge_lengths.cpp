// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/edge_lengths.h"

#include <algorithm>
#include <cmath>

#include "core/solve/residual_blocks.h"

namespace batten {

namespace {

/// Weight of a pinned end against a curvature misfit of the largest wanted value.
constexpr double kPinned = 1e4;
/// Keeps lengths that the curvature does not tell where they are.
constexpr double kStay = 1e-4;

/// Arc lengths at the samples by the trapezoid rule on ten times as many.
std::vector<double> lengthsAt(const Quintic& q, int samples) {
  constexpr int kFine = 10;  // steps from sample to sample
  std::vector<double> lengths = {0.0};
  double length = 0.0, before = evaluate(q, 0.0).first.norm();
  const double step = 1.0 / ((samples - 1) * kFine);
  for (int i = 1; i <= (samples - 1) * kFine; ++i) {
    const double speed = evaluate(q, i * step).first.norm();
    length += 0.5 * step * (before + speed);
    before = speed;
    if (i % kFine == 0) lengths.push_back(length);
  }
  return lengths;
}

struct Edges {
  std::array<Vec2, 5> directions;
  std::array<double, 5> lengths;
};

std::optional<Edges> edgesOf(const Quintic& q) {
  Edges edges;
  for (std::size_t i = 0; i < 5; ++i) {
    const Vec2 edge = q[i + 1] - q[i];
    edges.lengths[i] = edge.norm();
    if (!(edges.lengths[i] > 0.0) || !std::isfinite(edges.lengths[i])) return std::nullopt;
    edges.directions[i] = edge / edges.lengths[i];
  }
  return edges;
}

Quintic withLengths(const Vec2& start, const Edges& edges, std::span<const double> logFactors) {
  Quintic q;
  q[0] = start;
  for (std::size_t i = 0; i < 5; ++i)
    q[i + 1] = q[i] + edges.lengths[i] * std::exp(logFactors[i]) * edges.directions[i];
  return q;
}

/// The nearest lengths whose polygon ends exactly at `end`: what the weight of the pinned end left open. Directions
/// stay, so that neighbours keep their common tangent. Unchanged for a straight polygon, which cannot be led sideways.
Quintic endedAt(const Vec2& end, const Quintic& q, const Edges& edges) {
  const Vec2 gap = end - q[5];
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Vec2& d : edges.directions) xx += d.x() * d.x(), xy += d.x() * d.y(), yy += d.y() * d.y();
  const double determinant = xx * yy - xy * xy;
  Quintic result = q;
  if (determinant > 1e-9) {
    const Vec2 m((yy * gap.x() - xy * gap.y()) / determinant, (xx * gap.y() - xy * gap.x()) / determinant);
    for (std::size_t i = 0; i < 5; ++i) {
      const double length = (q[i + 1] - q[i]).norm() + edges.directions[i].dot(m);
      result[i + 1] = result[i] + length * edges.directions[i];
    }
  }
  result[5] = end;
  return result;
}

bool bendsBothWays(const Edges& edges) {
  double least = 0.0, most = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double turn = cross(edges.directions[i], edges.directions[i + 1]);
    least = std::min(least, turn);
    most = std::max(most, turn);
  }
  return least < -1e-6 && most > 1e-6;
}

/// One piece towards its wanted values at the samples.
BlockSolution solvePiece(const Quintic& q, const Edges& edges, std::span<const double> wanted, double scale, bool pin,
                         const RunContext& context) {
  const auto n = static_cast<int>(wanted.size());
  const double share = 1.0 / std::sqrt(static_cast<double>(n)), size = (q[5] - q[0]).norm() + edges.lengths[0];
  ResidualBlock block;
  block.columns = {0, 1, 2, 3, 4};
  block.size = n + 5 + (pin ? 2 : 0);
  block.evaluate = [&, n, share, size, pin](std::span<const double> x, std::span<double> r) {
    const Quintic moved = withLengths(q[0], edges, x);
    for (int i = 0; i < n; ++i) {
      r[i] = share * (evaluate(moved, static_cast<double>(i) / (n - 1)).curvature() - wanted[i]) / scale;
    }
    for (std::size_t i = 0; i < 5; ++i) r[n + i] = kStay * x[i];
    if (!pin) return;
    const Vec2 away = kPinned / size * (moved[5] - q[5]);
    r[n + 5] = away.x();
    r[n + 6] = away.y();
  };
  return minimiseBlocks(Eigen::VectorXd::Zero(5), Eigen::VectorXd::Ones(5), std::array{block}, context);
}

double squaredMisfit(const Quintic& q, std::span<const double> wanted, double scale) {
  double sum = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(wanted.size() - 1);
    sum += std::pow((evaluate(q, t).curvature() - wanted[i]) / scale, 2);
  }
  return sum / static_cast<double>(wanted.size());
}

}  // namespace

EdgeLengthResult followCurvature(std::span<const Quintic> path, const SpecifiedCurvature& wanted,
                                 const EdgeLengthOptions& options, const RunContext& context) {
  EdgeLengthResult result;
  result.path.assign(path.begin(), path.end());
  result.why = Termination::Converged;
  const int samples = std::clamp(options.samples, 6, 501);
  double total = 0.0, scale = 0.0;
  std::vector<std::vector<double>> lengths, values;
  for (const Quintic& q : path) {
    if (context.isCancelled()) return result;
    lengths.push_back(lengthsAt(q, samples));
    total += lengths.back().back();
  }
  if (!(total > 0.0) || !std::isfinite(total)) {
    result.why = Termination::Degenerate;
    return result;
  }
  double before = 0.0;
  for (const auto& along : lengths) {
    auto& row = values.emplace_back();
    for (const double s : along) {
      row.push_back(wanted((before + s) / total));
      scale = std::max(scale, std::abs(row.back()));
    }
    before += along.back();
  }
  scale = std::max(scale, 1e-9 / total);
  Vec2 shift = Vec2::Zero();
  for (std::size_t k = 0; k < path.size() && !context.isCancelled(); ++k) {
    Quintic& q = result.path[k];
    result.misfitBefore += squaredMisfit(q, values[k], scale);
    for (Vec2& p : q) p += shift;
    const Vec2 end = q[5];
    const auto edges = edgesOf(q);
    if (edges && !bendsBothWays(*edges)) {
      const auto solved = solvePiece(q, *edges, values[k], scale, options.pinEnds, context);
      result.iterations += solved.run.iterations;
      if (solved.run.why != Termination::Converged) result.why = solved.run.why;
      if (solved.x.allFinite()) q = withLengths(q[0], *edges, std::span(solved.x.data(), 5));
      if (options.pinEnds) q = endedAt(end, q, *edges);
      shift += q[5] - end;
    }
    result.misfitAfter += squaredMisfit(q, values[k], scale);
  }
  for (std::size_t k = 0; k + 1 < result.path.size(); ++k) equaliseJoint(result.path[k], result.path[k + 1]);
  result.misfitBefore = std::sqrt(result.misfitBefore / static_cast<double>(path.size()));
  result.misfitAfter = std::sqrt(result.misfitAfter / static_cast<double>(path.size()));
  return result;
}

}  // namespace batten
