// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/on_ink.h"

#include <algorithm>
#include <utility>

#include "core/image/bits/bit_disc.h"

namespace batten {
namespace {

constexpr double kLeastReachPx = 2.0;  // of thin lines, whose ink the mask may have lost in part
constexpr int kFewestOnInk = 3;        // points: a shorter part has no direction

enum class Ground { Ink, Bridge, Paper };

std::vector<Ground> groundUnder(const Contour& line, const BitImage& ink, double leastReachPx) {
  std::vector<Ground> ground;
  for (const ContourPoint& p : line.points) {
    const double reach = std::max(leastReachPx, 0.5 * static_cast<double>(p.widthPx.value_or(0.0f)));
    ground.push_back(anyInDisc(ink, p.at, reach) ? Ground::Ink : Ground::Paper);
  }
  for (const auto& [first, last] : line.bridges)
    std::fill(ground.begin() + first, ground.begin() + last + 1, Ground::Bridge);
  return ground;
}

// Points first .. last of a line, an open line with the bridges that lie within.
Contour partOf(const Contour& line, int first, int last) {
  Contour part = line;
  part.closed = false;
  part.endsInInk[0] = part.endsInInk[0] && first == 0;
  part.endsInInk[1] = part.endsInInk[1] && last + 1 == std::ssize(line.points);
  part.points.assign(line.points.begin() + first, line.points.begin() + last + 1);
  part.bridges.clear();
  for (const auto& [a, b] : line.bridges) {
    if (a > first && b < last) part.bridges.emplace_back(a - first, b - first);
  }
  measureContour(part);
  return part;
}

// A closed line opened at a point on paper, which becomes its first.
void openAt(Contour& line, std::vector<Ground>& ground, int first) {
  const int n = static_cast<int>(line.points.size());
  std::rotate(line.points.begin(), line.points.begin() + first, line.points.end());
  std::rotate(ground.begin(), ground.begin() + first, ground.end());
  line.bridges.clear();
  for (int i = 0; i < n; ++i) {
    if (ground[i] != Ground::Bridge) continue;
    int last = i;
    while (last + 1 < n && ground[last + 1] == Ground::Bridge) ++last;
    line.bridges.emplace_back(i, last);
    i = last;
  }
  line.closed = false;
}

}  // namespace

std::vector<Contour> keepOnInk(std::vector<Contour> lines, const BitImage& ink, double pixelsPerPx) {
  std::vector<Contour> kept;
  for (Contour& line : lines) {
    std::vector<Ground> ground = groundUnder(line, ink, kLeastReachPx * pixelsPerPx);
    const auto paper = std::find(ground.begin(), ground.end(), Ground::Paper);
    if (paper == ground.end()) {
      kept.push_back(std::move(line));
      continue;
    }
    if (line.closed) openAt(line, ground, static_cast<int>(paper - ground.begin()));
    const int n = static_cast<int>(ground.size());
    for (int i = 0; i < n; ++i) {
      if (ground[i] != Ground::Ink) continue;
      int last = i;  // of the ink reached without leaving it but for bridges
      for (int k = i; k < n && ground[k] != Ground::Paper; ++k) {
        if (ground[k] == Ground::Ink) last = k;
      }
      if (last - i + 1 >= kFewestOnInk) kept.push_back(partOf(line, i, last));
      i = last;
    }
  }
  return kept;
}

}  // namespace batten
