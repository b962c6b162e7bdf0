// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_posterior.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "core/base/hot_loop.h"
#include "core/solve/banded_cholesky.h"

namespace batten {
namespace {

constexpr double kShortestCutoffPx = 24.0, kCutoffStep = 1.15;  // the first candidate, and each over the one before
constexpr double kLongestCutoffPx = 1400.0;                     // what the local prior smooths at most
constexpr double kOrdinaryBlocks = 4.0, kOrdinaryVariance = 1.25e-3;  // [px^2] of a mean over 8 px: .01 px^2 px
constexpr double kAverageReach = 3.0;  // standard deviations: beyond, the weights are below 1 %
constexpr double kJitter = 1e-13;      // of the diagonal: makes a matrix definite that is so but for rounding
constexpr int kMeasuredStep = 3;       // of the candidates for the cut-off

double cutoffWeight(double cutoffPx) { return std::pow(cutoffPx / (2.0 * std::numbers::pi), 8); }

/// out[i] = the sum of kernel[|k|] * v[i + k], |k| <= radius, over `weight`.
BATTEN_HOT_LOOP void averageInside(const double* v, int count, const double* kernel, int radius, double weight,
                                   double* __restrict out) {
  constexpr int kLanes = 8;  // sums side by side, independent of each other: what vectors are filled with
  int i = radius;
  for (; i + kLanes <= count - radius; i += kLanes) {
    double sums[kLanes] = {};
    for (int k = -radius; k <= radius; ++k) {
      const double w = kernel[k < 0 ? -k : k];
      const double* from = v + i + k;
      for (int lane = 0; lane < kLanes; ++lane) sums[lane] += w * from[lane];
    }
    for (int lane = 0; lane < kLanes; ++lane) out[i + lane] = sums[lane] / weight;
  }
  for (; i < count - radius; ++i) {
    double sum = 0.0;
    for (int k = -radius; k <= radius; ++k) sum += kernel[k < 0 ? -k : k] * v[i + k];
    out[i] = sum / weight;
  }
}

/// Gaussian average along the piece; open ends: over what there is. smoothValues() mirrors instead, which would count
/// the stations next to an end twice in their own prior.
std::vector<double> averagedAlong(const std::vector<double>& v, double sigma, bool closed) {
  const int n = static_cast<int>(v.size());
  const int radius = std::min(static_cast<int>(std::ceil(kAverageReach * sigma)), closed ? (n - 1) / 2 : n - 1);
  std::vector<double> kernel(radius + 1);
  for (int k = 0; k <= radius; ++k) kernel[k] = std::exp(-0.5 * k * k / (sigma * sigma));
  std::vector<double> out(v.size());
  double all = 0.0;
  for (int k = -radius; k <= radius; ++k) all += kernel[std::abs(k)];
  averageInside(v.data(), n, kernel.data(), radius, all, out.data());
  for (int i = 0; i < n; ++i) {
    if (i == radius && n > 2 * radius) i = n - radius;
    if (i >= n) break;
    double sum = 0.0, weight = 0.0;
    for (int k = -radius; k <= radius; ++k) {
      int j = i + k;
      if (closed) j = (j + n) % n;
      if (j < 0 || j >= n) continue;
      const double w = kernel[std::abs(k)];
      sum += w * v[j];
      weight += w;
    }
    out[i] = sum / weight;
  }
  return out;
}

bool assemble(FairPosterior& p, BandedCholesky& cholesky, const FairFrame& frame, double s0) {
  p.a = BandedMatrix(frame.h.size(), BandRow::kHalfWidth, frame.h.isCyclic());
  p.a.add(frame.h, 1.0 / s0);
  p.b = frame.g / s0;
  p.constant = 0.0;
  for (const FairBlock& block : frame.blocks) {
    p.constant += frame.blockLength * block.weight * block.offset * block.offset / s0;
  }
  for (std::size_t j = 0; j < frame.penalty.size(); ++j) {
    const FrameStation& station = frame.penalty[j];
    const double w = frame.cell / p.tau2[j];
    p.a.addOuter(station.bendRow, w);
    addTo(p.b, station.bendRow, -w * station.bend);
    p.constant += w * station.bend * station.bend;
  }
  if (!cholesky.factor(p.a)) {
    for (int i = 0; i < p.a.size(); ++i) p.a.entry(i, 0) *= 1.0 + kJitter;
    if (!cholesky.factor(p.a)) return false;
  }
  p.mean = cholesky.solve(p.b);
  p.covariance = cholesky.inverseBand();
  return p.mean.allFinite();
}

/// Both figures are smooth in the logarithm of the cut-off: every third is measured, the others are interpolated
/// (cubic, in logarithms).
void fillBetween(CutoffTable& table) {
  constexpr int kLast = CutoffTable::kCount - 1;  // number of the longest cut-off
  static_assert(kLast % kMeasuredStep == 0);
  for (int k = 0; k < CutoffTable::kCount; ++k) {
    if (k % kMeasuredStep == 0) continue;
    const int first = std::clamp(k / kMeasuredStep - 1, 0, kLast / kMeasuredStep - 3) * kMeasuredStep;
    double rss = 0.0, dof = 0.0;
    bool valid = true;
    for (int i = 0; i < 4; ++i) {
      const int node = first + i * kMeasuredStep;
      valid = valid && table.valid[node] && table.rss[node] > 0.0;
      if (!valid) break;
      double weight = 1.0;
      for (int j = 0; j < 4; ++j) {
        const double place = first + j * kMeasuredStep;
        if (j != i) weight *= (k - place) / (node - place);
      }
      rss += weight * std::log(table.rss[node]);
      dof += weight * std::log(table.dof[node]);
    }
    if (!valid) continue;
    table.rss[k] = std::exp(rss);
    table.dof[k] = std::exp(dof);
    table.valid[k] = table.dof[k] < table.blocks;
  }
}

}  // namespace

double CutoffTable::cutoffPx(int k) { return kShortestCutoffPx * std::pow(kCutoffStep, k); }

CutoffTable cutoffTable(const FairFrame& frame, CancelCheck check) {
  CutoffTable table;
  table.blocks = static_cast<int>(frame.blocks.size());
  BandedMatrix q(frame.h.size(), BandRow::kHalfWidth, frame.h.isCyclic());
  Eigen::VectorXd toward = Eigen::VectorXd::Zero(frame.g.size());
  for (const FrameStation& station : frame.penalty) {
    q.addOuter(station.bendRow, frame.cell);
    addTo(toward, station.bendRow, -frame.cell * station.bend);
  }
  BandedCholesky cholesky;
  for (int k = 0; k < CutoffTable::kCount && !check.isCancelled(); k += kMeasuredStep) {
    const double lambda = cutoffWeight(CutoffTable::cutoffPx(k));
    BandedMatrix m = frame.h;
    m.add(q, lambda);
    if (!cholesky.factor(m)) continue;
    const Eigen::VectorXd c = cholesky.solve(frame.g + lambda * toward);
    const BandedMatrix inverse = cholesky.inverseBand();
    for (const FairBlock& block : frame.blocks) {
      const double e = block.offset - dot(block.row, c);
      table.rss[k] += block.weight * e * e;
      table.dof[k] += frame.blockLength * block.weight * BandedCholesky::quadratic(inverse, block.row);
    }
    table.valid[k] = std::isfinite(table.rss[k]) && table.dof[k] > 0.0 && table.dof[k] < table.blocks;
  }
  fillBetween(table);
  return table;
}

CutoffChoice chooseCutoffs(const std::vector<std::optional<CutoffTable>>& tables, std::span<const double> leastVariance,
                           double gamma) {
  CutoffChoice choice;
  choice.k.resize(tables.size());
  for (int round = 0; round < 3; ++round) {
    double rss = 0.0, freedom = 0.0;
    for (std::size_t i = 0; i < tables.size(); ++i) {
      choice.k[i].reset();
      if (!tables[i]) continue;
      const CutoffTable& t = *tables[i];
      double best = 0.0;
      const double variance = std::max(choice.blockVariance, leastVariance[i]);
      for (int k = 0; k < CutoffTable::kCount; ++k) {
        if (!t.valid[k]) continue;
        const double left = t.blocks - t.dof[k];
        const double score = round == 0       ? t.rss[k] / (left * left)
                             : variance > 0.0 ? t.rss[k] / variance + gamma * t.dof[k]
                                              : t.rss[k];
        if (!choice.k[i] || score < best) {
          best = score;
          choice.k[i] = k;
        }
      }
      if (!choice.k[i]) continue;
      rss += t.rss[*choice.k[i]];
      freedom += t.blocks - t.dof[*choice.k[i]];
    }
    // What a few blocks say of the noise is a matter of luck: an ordinary scan counts as some more of them.
    choice.blockVariance =
        freedom > 0.0 ? (rss + kOrdinaryBlocks * kOrdinaryVariance) / (freedom + kOrdinaryBlocks) : 0.0;
  }
  return choice;
}

std::vector<double> uniformPrior(const FairFrame& frame, double s0, double cutoffPx) {
  return std::vector<double>(frame.penalty.size(), s0 / cutoffWeight(cutoffPx));
}

std::optional<FairPosterior> localPosterior(const FairFrame& frame, double s0, std::vector<double> tau2, int rounds,
                                            double widthPx, CancelCheck check) {
  FairPosterior p;
  p.tau2 = std::move(tau2);
  p.s0 = s0;
  BandedCholesky cholesky;
  const double least = s0 / cutoffWeight(kLongestCutoffPx);
  for (int round = 0; round <= rounds; ++round) {
    if (check.isCancelled() || !assemble(p, cholesky, frame, s0)) return std::nullopt;
    if (round == rounds) break;
    std::vector<double> v;
    for (const FrameStation& station : frame.penalty) {
      const double bend = station.bend + dot(station.bendRow, p.mean);
      const double variance = std::max(0.0, BandedCholesky::quadratic(p.covariance, station.bendRow));
      v.push_back(frame.cell * (bend * bend + variance));
    }
    p.tau2 = averagedAlong(v, widthPx / frame.cell, frame.h.isCyclic());
    for (double& t : p.tau2) t = std::max(t, least);
  }
  return p;
}

}  // namespace batten
