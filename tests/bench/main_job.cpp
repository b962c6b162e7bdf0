// SPDX-License-Identifier: GPL-3.0-or-later
// Prints what the main job reaches, figure by figure beside its limit: the worst of the seeds.
//
//   bench_main_job [SEEDS]

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/bench/job_figures.h"

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 3;
  std::vector<batten::test::JobFigure> worst;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto figures = batten::test::mainJob(static_cast<std::uint32_t>(seed));
    if (worst.empty()) worst = figures;
    for (std::size_t i = 0; i < worst.size(); ++i) worst[i].value = std::max(worst[i].value, figures[i].value);
  }
  int missed = 0;
  for (const auto& figure : worst) {
    missed += figure.isMet() ? 0 : 1;
    std::printf("%-17s %-55s %8.4f  limit %5.2f  %s\n", figure.scene.c_str(), figure.what.c_str(), figure.value,
                figure.limit, figure.isMet() ? "met" : "MISSED");
  }
  std::printf("%d of %zu met, the worst of %d seeds\n", static_cast<int>(worst.size()) - missed, worst.size(), seeds);
  return 0;
}
