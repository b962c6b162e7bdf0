// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/colour/paper_colour.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/base/interpolation.h"
#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/solve/small_least_squares.h"

namespace batten {
namespace {

// of the smaller side; [px] bounds of a cell
constexpr int kCellsAcross = 48, kSmallestCellPx = 8, kLargestCellPx = 64;
constexpr double kFromRank = 0.6, kToRank = 0.95;  // of the pixels of a cell by grey: paper, without glare
constexpr double kPaperShare = 0.5;                // of the page's bright level: darker cells are no paper
constexpr int kFitRounds = 12;                     // of weighting cells anew
constexpr double kLeastSpread = 0.004;             // of a ratio: below it cells agree
constexpr double kInertia = 1e-3;                  // cells: what a round weighs that keeps the fit of the one before
constexpr float kLeastRatio = 0.05f;               // of a channel: paper is no darker
constexpr double kBrightRank = 0.9;                // of the cells, for the bright level of the page

using Sextet = Eigen::Matrix<double, 6, 1>;

struct CellColour {
  double grey = 0.0;
  std::array<double, 3> ratio{1.0, 1.0, 1.0};
  double u = 0.0, v = 0.0;
};

/// @param pixels scratch: grey and place of every pixel of the cell.
CellColour colourOfCell(const GreyImage& grey, const ColourImage& colour, const std::array<int, 4>& box,
                        std::vector<std::pair<std::uint16_t, Rgb8>>& pixels) {
  pixels.clear();
  for (int y = box[1]; y < box[3]; ++y) {
    for (int x = box[0]; x < box[2]; ++x) pixels.emplace_back(grey.row(y)[x], colour.row(y)[x]);
  }
  const auto count = std::ssize(pixels);
  const auto from = static_cast<std::ptrdiff_t>(kFromRank * static_cast<double>(count - 1));
  const auto to = std::max(from + 1, static_cast<std::ptrdiff_t>(kToRank * static_cast<double>(count)));
  const auto darker = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::nth_element(pixels.begin(), pixels.begin() + from, pixels.end(), darker);
  std::nth_element(pixels.begin() + from, pixels.begin() + (to - 1), pixels.end(), darker);
  double sum = 0.0;
  std::array<double, 3> channels{};
  for (auto it = pixels.begin() + from; it != pixels.begin() + to; ++it) {
    sum += it->first / GreyImage::kGreyUnit;
    channels[0] += it->second.red;
    channels[1] += it->second.green;
    channels[2] += it->second.blue;
  }
  CellColour cell;
  cell.grey = sum / static_cast<double>(to - from);
  if (sum > 0.0) {
    for (std::size_t k = 0; k < 3; ++k) cell.ratio[k] = channels[k] / sum;
  }
  cell.u = 0.5 * (box[0] + box[2]) / grey.width;
  cell.v = 0.5 * (box[1] + box[3]) / grey.height;
  return cell;
}

Sextet termsAt(double u, double v) { return (Sextet() << 1.0, u, v, u * u, u * v, v * v).finished(); }

/// The quadratic that most of the cells agree on (Cauchy weights, begun at their median).
std::array<double, 6> fitRatio(const std::vector<CellColour>& cells, std::size_t channel) {
  std::vector<double> values;
  values.reserve(cells.size());
  for (const CellColour& cell : cells) values.push_back(cell.ratio[channel]);
  Sextet fitted = Sextet::Zero();
  fitted[0] = upperMedian(values);
  for (int round = 0; round < kFitRounds; ++round) {
    std::vector<double> residuals;
    residuals.reserve(cells.size());
    for (const CellColour& cell : cells) residuals.push_back(cell.ratio[channel] - fitted.dot(termsAt(cell.u, cell.v)));
    const double spread = std::max(kLeastSpread, robustSigma(std::vector<double>(residuals)));
    SmallLeastSquares<6> fit;
    fit.hold(Sextet::Constant(kInertia), fitted);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const double away = residuals[i] / (2.0 * spread), weight = 1.0 / (1.0 + away * away);
      fit.add(termsAt(cells[i].u, cells[i].v), cells[i].ratio[channel], weight);
    }
    fitted = fit.solve();
  }
  std::array<double, 6> out{};
  std::copy(fitted.begin(), fitted.end(), out.begin());
  return out;
}

}  // namespace

void PaperColour::ratiosOfRow(int y, int width, int height, std::array<std::vector<float>, 3>& out) const {
  const double v = (y + 0.5) / height;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& c = ratio[k];
    out[k].resize(width);
    const auto start = static_cast<float>(c[0] + v * (c[2] + v * c[5]));
    const auto slope = static_cast<float>((c[1] + v * c[4]) / width);
    const auto bend = static_cast<float>(c[3] / width / width);
    float* row = out[k].data();
    for (int x = 0; x < width; ++x) {
      const float at = static_cast<float>(x) + 0.5f;
      row[x] = std::max(kLeastRatio, start + at * (slope + at * bend));
    }
  }
}

float PaperColour::levelAt(int x, int y) const {
  const auto size = static_cast<float>(cellPx);
  const BilinearPlace place(columns, rows, (static_cast<float>(x) + 0.5f) / size - 0.5f,
                            (static_cast<float>(y) + 0.5f) / size - 0.5f);
  // Every pixel of a page is asked for: in single precision, and exact at both ends without branches.
  return place.of([&](int i, int j) { return level[std::ptrdiff_t{j} * columns + i]; },
                  [](float a, float b, float share) { return (1.0f - share) * a + share * b; });
}

PaperColour measurePaperColour(const GreyImage& grey, const ColourImage& colour, const RunContext& context) {
  PaperColour paper;
  paper.cellPx = std::clamp(std::min(grey.width, grey.height) / kCellsAcross, kSmallestCellPx, kLargestCellPx);
  paper.columns = (grey.width + paper.cellPx - 1) / paper.cellPx;
  paper.rows = (grey.height + paper.cellPx - 1) / paper.cellPx;
  std::vector<CellColour> cells(std::ptrdiff_t{paper.columns} * paper.rows);
  parallelFor(context, paper.rows, 1, [&](int begin, int end) {
    std::vector<std::pair<std::uint16_t, Rgb8>> pixels;
    for (int j = begin; j < end; ++j) {
      for (int i = 0; i < paper.columns; ++i) {
        const std::array<int, 4> box{i * paper.cellPx, j * paper.cellPx, std::min((i + 1) * paper.cellPx, grey.width),
                                     std::min((j + 1) * paper.cellPx, grey.height)};
        cells[std::ptrdiff_t{j} * paper.columns + i] = colourOfCell(grey, colour, box, pixels);
      }
    }
  });
  if (context.isCancelled()) return paper;
  paper.bright.assign(cells.size(), 0.0f);
  for (int j = 0; j < paper.rows; ++j) {
    for (int i = 0; i < paper.columns; ++i) {
      float& most = paper.bright[std::ptrdiff_t{j} * paper.columns + i];
      for (int y = std::max(0, j - 1); y <= std::min(paper.rows - 1, j + 1); ++y) {
        for (int x = std::max(0, i - 1); x <= std::min(paper.columns - 1, i + 1); ++x)
          most = std::max(most, static_cast<float>(cells[std::ptrdiff_t{y} * paper.columns + x].grey));
      }
    }
  }
  // A cell without paper of its own takes what is around.
  constexpr float kOwnPaper = 0.9f;
  for (std::size_t i = 0; i < cells.size(); ++i)
    paper.level.push_back(static_cast<float>(cells[i].grey) >= kOwnPaper * paper.bright[i]
                              ? static_cast<float>(cells[i].grey)
                              : paper.bright[i]);
  std::vector<float> levels = paper.bright;
  const double most = static_cast<double>(lowerQuantile(levels, kBrightRank));
  std::erase_if(cells, [&](const CellColour& cell) { return cell.grey < kPaperShare * most; });
  for (auto& ratio : paper.ratio) ratio[0] = 1.0;
  if (cells.empty()) return paper;
  levels.clear();
  for (const CellColour& cell : cells) levels.push_back(static_cast<float>(cell.grey));
  paper.paperLevel = static_cast<double>(upperMedian(levels));
  for (std::size_t k = 0; k < 3; ++k) paper.ratio[k] = fitRatio(cells, k);
  return paper;
}

}  // namespace batten
