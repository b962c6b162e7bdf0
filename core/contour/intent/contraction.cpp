// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/intent/contraction.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace batten {
namespace {

// Heaviest first; ties by the numbers of the nodes.
using Heaviest = std::tuple<double, int, int>;  // minus the weight, the nodes

class Contraction {
 public:
  Contraction(int nodes, const std::vector<WeightedPair>& pairs) : weights_(nodes), cluster_(nodes) {
    for (int i = 0; i < nodes; ++i) cluster_[i] = i;
    std::map<std::pair<int, int>, double> sums;
    std::vector<WeightedPair> ordered = pairs;
    for (WeightedPair& p : ordered)
      if (p.a > p.b) std::swap(p.a, p.b);
    std::sort(ordered.begin(), ordered.end(), [](const WeightedPair& p, const WeightedPair& q) {
      return std::tuple(p.a, p.b, p.weight) < std::tuple(q.a, q.b, q.weight);
    });
    for (const WeightedPair& p : ordered)
      if (p.a != p.b) sums[{p.a, p.b}] += p.weight;
    for (const auto& [nodesOf, weight] : sums) set(nodesOf.first, nodesOf.second, weight);
  }

  std::vector<int> run(const RunContext& context) {
    while (!queue_.empty() && std::get<0>(*queue_.begin()) < 0.0 && !context.isCancelled()) {
      const auto [weight, a, b] = *queue_.begin();
      join(a, b);
    }
    std::vector<int> numbers(cluster_.size());
    std::map<int, int> names;
    for (int i = 0; i < std::ssize(cluster_); ++i)
      numbers[i] = names.try_emplace(root(i), static_cast<int>(names.size())).first->second;
    return numbers;
  }

 private:
  int root(int i) {
    while (cluster_[i] != i) i = cluster_[i] = cluster_[cluster_[i]];
    return i;
  }
  static Heaviest entry(int a, int b, double weight) { return {-weight, std::min(a, b), std::max(a, b)}; }
  void set(int a, int b, double weight) {
    weights_[a][b] = weights_[b][a] = weight;
    queue_.insert(entry(a, b, weight));
  }
  void unset(int a, int b) {
    queue_.erase(entry(a, b, weights_[a].at(b)));
    weights_[a].erase(b);
    weights_[b].erase(a);
  }
  // The second becomes part of the first.
  void join(int a, int b) {
    unset(a, b);
    cluster_[b] = a;
    const std::map<int, double> others = weights_[b];
    for (const auto& [other, weight] : others) {
      unset(b, other);
      const auto found = weights_[a].find(other);
      const double before = found != weights_[a].end() ? found->second : 0.0;
      if (found != weights_[a].end()) unset(a, other);
      set(a, other, before + weight);
    }
  }

  std::vector<std::map<int, double>> weights_;
  std::set<Heaviest> queue_;
  std::vector<int> cluster_;
};

}  // namespace

std::vector<int> contractGreedily(int nodes, const std::vector<WeightedPair>& pairs, const RunContext& context) {
  return Contraction(nodes, pairs).run(context);
}

}  // namespace batten
