// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/intent_learning.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "core/contour/intent/intended_lines.h"

namespace batten::test {
namespace {

constexpr double kReachWidths = 2.0, kAlongCos = 0.8;  // of a piece's samples from the strokes that they are of
constexpr double kPure = 0.6;                          // of a bundle: less is of no group
constexpr double kRidge[kIntentRounds] = {1.0, 40.0, 40.0};
constexpr int kNewtonSteps = 60;
constexpr double kCautionStep = 0.5, kLeastCautionStep = 0.25;  // log-odds

struct Example {
  Eigen::VectorXd features;
  bool isOne = false;
  double weight = 1.0;
};

// The group of most samples of each piece; none: they lie on no stroke.
std::vector<std::optional<int>> groupsOf(const StrokePieceSet& set, const LearningPage& page) {
  std::vector<std::optional<int>> groups;
  for (const StrokePiece& piece : set.pieces) {
    std::map<int, int> votes;
    for (int k = 0; k < piece.strip.count(); ++k) {
      const Vec2 at = page.widthPx * piece.strip.samples[k].at;
      std::optional<int> best;
      double nearest = kReachWidths * page.widthPx;
      for (const StrokeDrawing::Stroke& s : page.drawing->strokes)
        for (std::size_t i = 0; i + 1 < s.points.size(); ++i) {
          const Vec2 along = s.points[i + 1] - s.points[i];
          const double length = along.norm();
          if (length <= 0.0 || std::abs(along.dot(piece.strip.samples[k].tangent)) < kAlongCos * length) continue;
          const double f = std::clamp((at - s.points[i]).dot(along) / (length * length), 0.0, 1.0);
          const double d = (at - s.points[i] - f * along).norm();
          if (d >= nearest) continue;
          nearest = d;
          best = s.cluster;
        }
      if (best) ++votes[*best];
    }
    std::optional<int> group;
    for (const auto& [name, count] : votes)
      if (!group || count > votes[*group]) group = name;
    groups.push_back(group);
  }
  return groups;
}

std::optional<int> groupOf(const std::vector<int>& pieces, const StrokePieceSet& set,
                           const std::vector<std::optional<int>>& groups) {
  std::map<int, double> samples;
  double all = 0.0;
  for (const int p : pieces) {
    all += set.pieces[p].strip.count();
    if (groups[p]) samples[*groups[p]] += set.pieces[p].strip.count();
  }
  for (const auto& [name, count] : samples)
    if (count >= kPure * all) return name;
  return std::nullopt;
}

// What one page shows in one round with given weights, labelled.
std::vector<Example> examplesOf(const LearningPage& page, const IntentWeights& weights, int round, bool isSide) {
  std::vector<SeenPair> pairs;
  StrokePieceSet set;
  intendedLines(page.lines, page.widthPx, {}, {}, {weights, &pairs, &set});
  const auto groups = groupsOf(set, page);
  std::vector<Example> examples;
  for (const SeenPair& pair : pairs) {
    if (pair.round != round || pair.isSide != isSide) continue;
    const auto a = groupOf(pair.piecesA, set, groups), b = groupOf(pair.piecesB, set, groups);
    if (!a || !b) continue;
    const auto n = static_cast<Eigen::Index>(pair.features.size());
    examples.push_back({Eigen::Map<const Eigen::VectorXd>(pair.features.data(), n), *a == *b});
  }
  for (Example& e : examples) e.weight = 10.0 / std::sqrt(std::max<double>(30.0, std::ssize(examples)));
  return examples;
}

// Logistic regression on standardized features with a ridge, by Newton's method with halved steps.
std::vector<double> regression(const std::vector<const Example*>& examples, double ridge) {
  const Eigen::Index rows = std::ssize(examples), columns = examples.front()->features.size();
  Eigen::MatrixXd x(rows, columns + 1);
  Eigen::VectorXd sign(rows), weight(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    x(i, 0) = 1.0;
    x.row(i).tail(columns) = examples[i]->features.transpose();
    sign[i] = examples[i]->isOne ? 1.0 : -1.0;
    weight[i] = examples[i]->weight;
  }
  Eigen::VectorXd mean = x.colwise().mean().transpose();
  mean[0] = 0.0;
  x.rowwise() -= mean.transpose();
  Eigen::VectorXd deviation = (x.array().square().colwise().mean()).sqrt().transpose();
  deviation[0] = 1.0;
  for (Eigen::Index k = 1; k <= columns; ++k)
    if (deviation[k] < 1e-6) deviation[k] = 1e9;  // a feature that never changes has no weight
  x.array().rowwise() /= deviation.transpose().array();
  Eigen::VectorXd penalty = Eigen::VectorXd::Constant(columns + 1, ridge);
  penalty[0] = 1e-9;
  const auto cost = [&](const Eigen::VectorXd& w) {
    const Eigen::ArrayXd z = sign.array() * (x * w).array();
    const Eigen::ArrayXd loss = (-z).max(0.0) + ((-z.abs()).exp() + 1.0).log();
    return (weight.array() * loss).sum() + 0.5 * (penalty.array() * w.array().square()).sum();
  };
  Eigen::VectorXd w = Eigen::VectorXd::Zero(columns + 1);
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Eigen::ArrayXd p = 1.0 / (1.0 + (sign.array() * (x * w).array()).exp());  // of the other label
    const Eigen::VectorXd gradient =
        x.transpose() * (-weight.array() * sign.array() * p).matrix() + (penalty.array() * w.array()).matrix();
    const Eigen::VectorXd curvature = weight.array() * p * (1.0 - p);
    Eigen::MatrixXd hessian = x.transpose() * curvature.asDiagonal() * x;
    hessian.diagonal() += penalty;
    const Eigen::VectorXd way = hessian.ldlt().solve(gradient);
    double part = 1.0;
    while (part > 1e-6 && cost(w - part * way) > cost(w)) part *= 0.5;
    w -= part * way;
    if ((part * way).norm() < 1e-8 * (1.0 + w.norm())) break;
  }
  w.array() /= deviation.array();
  w[0] -= w.tail(columns).dot(mean.tail(columns));
  return {w.data(), w.data() + w.size()};
}

}  // namespace

std::vector<IntentWeights> crossValidatedWeights(const std::vector<LearningPage>& pages, int folds) {
  std::vector<IntentWeights> ofFold(folds, learnedWeights());
  for (int round = 0; round < kIntentRounds; ++round) {
    for (const bool isSide : {true, false}) {
      std::vector<std::vector<Example>> examples;
      for (std::size_t i = 0; i < pages.size(); ++i)
        examples.push_back(examplesOf(pages[i], ofFold[i % folds], round, isSide));
      for (int fold = 0; fold < folds; ++fold) {
        std::vector<const Example*> others;
        for (std::size_t i = 0; i < pages.size(); ++i)
          for (const Example& e : examples[i])
            if (folds == 1 || static_cast<int>(i % folds) != fold) others.push_back(&e);
        if (others.empty()) continue;
        RoundWeights& learned = ofFold[fold][round];
        (isSide ? learned.side : learned.end) = regression(others, kRidge[round]);
      }
    }
  }
  std::vector<IntentWeights> ofPage;
  for (std::size_t i = 0; i < pages.size(); ++i) ofPage.push_back(ofFold[i % folds]);
  return ofPage;
}

IntentWeights tunedCautions(IntentWeights weights, const std::function<double(const IntentWeights&)>& score) {
  double best = score(weights);
  for (double step = kCautionStep; step >= kLeastCautionStep; step *= 0.5) {
    for (int round = kIntentRounds - 1; round >= 0; --round) {
      for (double RoundWeights::*number :
           {&RoundWeights::sideCaution, &RoundWeights::endCaution, &RoundWeights::sideFactor}) {
        for (const double way : {step, -step}) {
          for (IntentWeights tried = weights; true; weights = tried) {
            tried[round].*number += way;
            const double reached = score(tried);
            if (reached <= best) break;
            best = reached;
          }
        }
      }
    }
  }
  return weights;
}

void printWeights(const IntentWeights& weights) {
  const auto numbers = [](const std::vector<double>& all) {
    for (const double w : all) std::printf("%.4f, ", w);
  };
  for (const RoundWeights& round : weights) {
    std::printf("      {.side = {");
    numbers(round.side);
    std::printf("},\n       .end = {");
    numbers(round.end);
    std::printf("},\n       .sideCaution = %g,\n       .endCaution = %g,\n       .sideFactor = %g},\n",
                round.sideCaution, round.endCaution, round.sideFactor);
  }
}

}  // namespace batten::test
