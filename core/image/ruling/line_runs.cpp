// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/line_runs.h"

#include <algorithm>

namespace batten {
namespace {

constexpr double kLeastGapPx = 3.0, kLeastGap = 0.2;  // [px], of the spacing: shorter ones are worn places of a line
constexpr double kMostOtherInk = 1.5;                 // of the spacing
constexpr double kMostOther = 0.3;                    // of all the ink on the course

struct CourseRun {
  int from = 0, to = 0;
};

// Runs of ink, those joined that only a worn place parts.
std::vector<CourseRun> runsOf(const std::vector<char>& inked, double leastGapPx) {
  std::vector<CourseRun> runs;
  for (int i = 0; i < std::ssize(inked); ++i) {
    if (inked[i] == 0) continue;
    if (runs.empty() || i - runs.back().to >= leastGapPx) runs.push_back({i, i});
    runs.back().to = i + 1;
  }
  return runs;
}

}  // namespace

std::vector<char> otherInkOnLine(const std::vector<char>& inked, double spacingPx) {
  const std::vector<CourseRun> runs = runsOf(inked, std::max(kLeastGapPx, kLeastGap * spacingPx));
  std::vector<char> other(inked.size(), 0);
  int all = 0, lone = 0;
  for (int i = 0; i < std::ssize(runs); ++i) {
    const int length = runs[i].to - runs[i].from;
    all += length;
    // The first and the last may be where the line itself begins and ends.
    if (i == 0 || i + 1 == std::ssize(runs) || length >= kMostOtherInk * spacingPx) continue;
    lone += length;
    std::fill(other.begin() + runs[i].from, other.begin() + runs[i].to, 1);
  }
  if (lone > kMostOther * all) std::fill(other.begin(), other.end(), 0);
  return other;
}

}  // namespace batten
