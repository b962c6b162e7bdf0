// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/tone_grain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "core/base/interpolation.h"
#include "core/base/statistics.h"
#include "core/contour/ink/line_company.h"
#include "core/image/bits/bit_disc.h"

namespace batten {
namespace {

// [widths] Grain runs on by chance: after each width the next place of the paper is as likely bright as dark, and a way
// round is found for a few of them.
constexpr double kMostGrainWidths = 25.0;
constexpr double kMostBreadth = 2.0;       // [widths] the page is smoothed to one, in the middle of all short lines
constexpr double kGroundWidths = 8.0;      // [widths] from a line: its ground, several grains wide
constexpr double kClearWidths = 1.5;       // [widths] from its middle: beyond its blurred border
constexpr double kBesideLineWidths = 1.0;  // [widths] beyond its border: what lies beside it
constexpr double kBlurWidths = 0.4;        // [widths] standard deviation: about the profile of a line
// [standard deviations of a place] A line of grain is the darkest of some thousand ways over its ground, 3.5 of the
// deviations of its mean; that is half as large as of a place, four widths long or so; and pencil on the tooth of the
// paper varies up to twice as far to the dark side as to the bright.
constexpr double kStandsOut = 4.0;
constexpr double kWaysOverGround = 1000.0;
constexpr double kOneSigma = 0.841, kTwoSigma = 0.977;  // quantiles of a normal variable, 1 and 2 above its median
constexpr double kRoundingSigma = 0.29;                 // [grey] of what is rounded to whole levels
constexpr int kFewestCells = 60;                        // of a ground: the upper quantile is then not a single cell
// Of the contrast of the page's lines: pencil strokes of one hand differ by less, as in centreline.cpp.
constexpr double kAsDarkAsLines = 0.8;
constexpr double kFaintOnWhite = 0.2;  // of that contrast, where the ground of a line says nothing
constexpr int kMostRounds = 12;        // of taking lines out: a row of faint dashes would be eaten up from its ends

// [px] 0: not known.
double meanWidthOf(const Contour& line) {
  const std::vector<float> widths = strokeWidthsOf(line.points);
  double sum = 0.0;
  for (const float width : widths) sum += static_cast<double>(width);
  return widths.empty() ? 0.0 : std::max(1.0, sum / static_cast<double>(widths.size()));
}

// A page as its short lines see it: smoothed to their width, in cells of half of it.
struct LinesOnGround {
  double cellPx = 1.0, widthPx = 1.0;
  cv::Mat1f level;  // [grey]
  cv::Mat1b ink;    // not 0 on shapes and long lines: no ground

  double widthCells() const { return widthPx / cellPx; }
  cv::Point2d cellAt(const Vec2& px) const { return {px.x() / cellPx - 0.5, px.y() / cellPx - 0.5}; }
  std::vector<cv::Point> cellsOf(const Contour& c) const {
    std::vector<cv::Point> cells;
    for (const ContourPoint& p : c.points) {
      const cv::Point2d at = cellAt(p.at);
      const cv::Point cell(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)));
      if (cells.empty() || cells.back() != cell) cells.push_back(cell);
    }
    return cells;
  }
  double levelAt(const Vec2& px) const {
    const cv::Point2d at = cellAt(px);
    const BilinearPlace place(level.cols, level.rows, at.x, at.y);
    return place.of([&](int x, int y) { return static_cast<double>(level(y, x)); });
  }
};

cv::Mat1b inkOfLongLines(const LinesOnGround& page, const ContourSet& set, const std::vector<bool>& isShort) {
  constexpr int kThickest = 255;  // that OpenCV draws
  cv::Mat1b ink = cv::Mat1b::zeros(page.level.size()), shapes = ink.clone();
  std::vector<std::vector<cv::Point>> borders;
  for (std::size_t i = 0; i < set.contours.size(); ++i) {
    const Contour& c = set.contours[i];
    if (isShort[i] || c.points.empty()) continue;
    std::vector<cv::Point> cells = page.cellsOf(c);
    if (c.kind == ContourKind::Outline) {
      borders.push_back(std::move(cells));
      continue;
    }
    // The width, and a cell of blurred border at either side.
    const double thick = meanWidthOf(c) / page.cellPx + 2.0;
    cv::polylines(ink, cells, c.closed, 255, std::clamp(static_cast<int>(std::lround(thick)), 1, kThickest));
  }
  if (!borders.empty()) cv::fillPoly(shapes, borders, 255);
  cv::dilate(shapes, shapes, cv::Mat());
  return ink | shapes;
}

LinesOnGround linesOnGround(const ContourSet& set, const std::vector<bool>& isShort, const GreyImage& grey,
                            double widthPx) {
  LinesOnGround page;
  const int cellPx = std::max(1, static_cast<int>(0.5 * widthPx));
  page.cellPx = cellPx;
  page.widthPx = widthPx;
  const cv::Size size(grey.width / cellPx, grey.height / cellPx);
  const cv::Mat whole(grey.height, grey.width, CV_16U, const_cast<std::uint16_t*>(grey.pixels.data()));
  cv::Mat reduced;
  cv::resize(whole(cv::Rect(0, 0, size.width * cellPx, size.height * cellPx)), reduced, size, 0, 0, cv::INTER_AREA);
  reduced.convertTo(page.level, CV_32F, 1.0 / GreyImage::kGreyUnit);
  cv::GaussianBlur(page.level, page.level, {}, kBlurWidths * page.widthCells());
  page.ink = inkOfLongLines(page, set, isShort);
  return page;
}

struct GroundCell {
  float x, y, level;
};

// The light on a ground: a plane below its bright side, where no ink is. [grey: at 0, by x, by y]
std::array<double, 3> lightOn(const std::vector<GroundCell>& ground) {
  constexpr int kRounds = 3;      // of weights from the plane before: one settles most of it
  constexpr double kBelow = 0.1;  // weight of what is darker than the plane, which may be ink
  cv::Vec3d plane(0.0, 0.0, 0.0);
  for (int round = 0; round < kRounds; ++round) {
    cv::Matx33d normal = cv::Matx33d::zeros();
    cv::Vec3d right(0.0, 0.0, 0.0);
    for (const GroundCell& cell : ground) {
      const cv::Vec3d row(1.0, static_cast<double>(cell.x), static_cast<double>(cell.y));
      const double level = static_cast<double>(cell.level);
      const double weight = round > 0 && level < plane.dot(row) ? kBelow : 1.0;
      normal += weight * row * row.t();
      right += weight * level * row;
    }
    plane = normal.solve(right, cv::DECOMP_SVD);
  }
  return {plane[0], plane[1], plane[2]};
}

// By how many standard deviations of its ground a line is darker than the ground, both measured from a plane.
double overNoise(const std::vector<GroundCell>& ground, const GroundCell& line, const std::array<double, 3>& plane) {
  const auto above = [&plane](const GroundCell& cell) {
    return static_cast<double>(cell.level) - plane[0] - plane[1] * static_cast<double>(cell.x) -
           plane[2] * static_cast<double>(cell.y);
  };
  std::vector<double> levels;
  levels.reserve(ground.size());
  for (const GroundCell& cell : ground) levels.push_back(above(cell));
  // Where clean paper shows, both lie on it.
  const double one = lowerQuantile(levels, kOneSigma), two = lowerQuantile(levels, kTwoSigma);
  const double sigma = std::max(kRoundingSigma, two - one);
  return (one - sigma - above(line)) / sigma;
}

// A line, in the mean along it, against the ground. Absent: there is no ground.
std::optional<double> overGround(const Contour& c, const LinesOnGround& page) {
  const auto reach = static_cast<int>(kGroundWidths * page.widthCells());
  std::vector<cv::Point> cells = page.cellsOf(c);
  cv::Rect box = cv::boundingRect(cells);
  box = cv::Rect(box.x - reach, box.y - reach, box.width + 2 * reach, box.height + 2 * reach) &
        cv::Rect({0, 0}, page.level.size());
  if (box.empty()) return std::nullopt;
  for (cv::Point& cell : cells) cell -= box.tl();
  cv::Mat1b own = cv::Mat1b::zeros(box.size());
  cv::polylines(own, cells, c.closed, 255);
  cv::Mat1f distance;
  cv::distanceTransform(own == 0, distance, cv::DIST_L2, cv::DIST_MASK_3);
  std::vector<GroundCell> ground;
  GroundCell sum{0.0f, 0.0f, 0.0f};
  int count = 0;
  for (int j = 0; j < box.height; ++j) {
    for (int i = 0; i < box.width; ++i) {
      const GroundCell cell{static_cast<float>(i), static_cast<float>(j), page.level(box.y + j, box.x + i)};
      const auto off = static_cast<double>(distance(j, i));
      if (off > kClearWidths * page.widthCells() && off < reach && page.ink(box.y + j, box.x + i) == 0)
        ground.push_back(cell);
      if (own(j, i) != 0) sum = {sum.x + cell.x, sum.y + cell.y, sum.level + cell.level}, ++count;
    }
  }
  if (std::ssize(ground) < kFewestCells || count == 0) return std::nullopt;
  const auto n = static_cast<float>(count);
  const GroundCell line{sum.x / n, sum.y / n, sum.level / n};
  // Slanting light is no grain; but where little paper shows, its slant is not known.
  return std::max(overNoise(ground, line, {}), overNoise(ground, line, lightOn(ground)));
}

// [grey] How much darker a line is than what lies beside it.
double contrastOfLine(const Contour& c, const LinesOnGround& page) {
  const double aside = 0.5 * meanWidthOf(c) + kBesideLineWidths * page.widthPx;
  const auto step = static_cast<std::ptrdiff_t>(std::max(1.0, 0.5 * page.widthPx));
  const std::ptrdiff_t last = std::ssize(c.points) - 1;
  double sum = 0.0;
  int count = 0;
  for (std::ptrdiff_t i = 0; i <= last; i += step) {
    const Vec2& at = c.points[i].at;
    const Vec2 along = c.points[std::min(last, i + step)].at - c.points[std::max<std::ptrdiff_t>(0, i - step)].at;
    if (!(along.norm() > 0.0)) continue;
    const Vec2 away = aside * leftNormal(along.normalized());
    sum += 0.5 * (page.levelAt(at + away) + page.levelAt(at - away)) - page.levelAt(at);
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

// Chance turns a line of grain every few widths: three times in a row it does not lead it straight on.
bool isStraight(const Contour& c, double widthPx) {
  constexpr double kLeastWidths = 12.0, kMostOffWidths = 0.5;  // from end to end; from the chord, root mean square
  if (c.closed) return false;
  const Vec2& from = c.points.front().at;
  const Vec2 chord = c.points.back().at - from;
  if (!(chord.norm() >= kLeastWidths * widthPx)) return false;
  const Vec2 across = leftNormal(chord.normalized());
  double sum = 0.0;
  for (const ContourPoint& p : c.points) sum += std::pow(across.dot(p.at - from), 2);
  return std::sqrt(sum / static_cast<double>(c.points.size())) <= kMostOffWidths * widthPx;
}

// Of the long lines of the page, in the middle. Absent: there are none.
std::optional<double> usualContrastOfLines(const ContourSet& set, const std::vector<bool>& isShort,
                                           const LinesOnGround& page) {
  std::vector<double> contrasts;
  for (std::size_t i = 0; i < set.contours.size(); ++i) {
    const Contour& c = set.contours[i];
    if (!isShort[i] && c.kind == ContourKind::Centreline) contrasts.push_back(contrastOfLine(c, page));
  }
  return contrasts.empty() ? std::nullopt : std::optional(upperMedian(contrasts));
}

// The lines that are short and narrow enough for grain.
struct ShortLines {
  std::vector<bool> isShort;
  double widthPx = 0.0;  // of them, in the middle; 0: there are none
};
ShortLines shortLinesOf(const ContourSet& set) {
  ShortLines lines;
  std::vector<double> widths;
  for (const Contour& c : set.contours) {
    lines.isShort.push_back(c.kind == ContourKind::Centreline && c.points.size() > 1 &&
                            c.lengthPx < kMostGrainWidths * meanWidthOf(c));
    if (lines.isShort.back()) widths.push_back(meanWidthOf(c));
  }
  if (widths.empty()) return lines;
  lines.widthPx = upperMedian(widths);
  // Broad lines would be held against their own insides.
  for (std::size_t i = 0; i < set.contours.size(); ++i)
    if (meanWidthOf(set.contours[i]) > kMostBreadth * lines.widthPx) lines.isShort[i] = false;
  return lines;
}

// Whether the scanner has made the paper white: what is left of its tooth stands out then.
bool isClipped(const LinesOnGround& page) {
  constexpr float kWhite = 252.0f;  // [grey] JPEG leaves it a little below 255
  const cv::Mat1b white = page.level > kWhite;
  return 2 * cv::countNonZero(white) > page.level.rows * page.level.cols;
}

// [standard deviations of a place] The darkest of n lines of grain is the darkest of n times as many ways.
double standsOutOf(std::ptrdiff_t lines) {
  return kStandsOut * std::sqrt(std::log(kWaysOverGround * static_cast<double>(lines)) / std::log(kWaysOverGround));
}

// What tells a faint line: how far it stands out of its ground, and whether it is far fainter than the long lines.
struct Faintness {
  double over = 0.0;
  bool isFarFainter = false;
};

// Of the lines that are fainter than the long lines; the others have none.
std::vector<std::optional<Faintness>> faintLines(const ContourSet& set, const ShortLines& lines, const GreyImage& grey,
                                                 bool isPencil, const RunContext& context) {
  std::vector<std::optional<Faintness>> faint(set.contours.size());
  const LinesOnGround page = linesOnGround(set, lines.isShort, grey, lines.widthPx);
  const std::optional<double> usual = usualContrastOfLines(set, lines.isShort, page);
  const bool isWhite = isPencil && isClipped(page);
  for (std::size_t i = 0; i < set.contours.size() && usual && !context.isCancelled(); ++i) {
    const Contour& c = set.contours[i];
    if (!lines.isShort[i] || c.traceMode || isStraight(c, lines.widthPx)) continue;
    const double contrast = contrastOfLine(c, page);
    if (contrast >= kAsDarkAsLines * *usual) continue;
    const std::optional<double> over = overGround(c, page);
    if (over) faint[i] = {*over, isWhite && contrast < kFaintOnWhite * *usual};
  }
  return faint;
}

}  // namespace

std::vector<bool> linesOfGrain(const ContourSet& set, const GreyImage& grey, bool isPencil, const RunContext& context) {
  std::vector<bool> isGrain(set.contours.size(), false);
  const ShortLines lines = shortLinesOf(set);
  if (grey.isUniform || !(lines.widthPx > 0.0) || context.isCancelled()) return isGrain;
  if (std::min(grey.width, grey.height) < kGroundWidths * lines.widthPx) return isGrain;
  const std::vector<std::optional<Faintness>> faint = faintLines(set, lines, grey, isPencil, context);
  double standsOut = kStandsOut;
  bool isRaised = false;
  for (int round = 0; round < kMostRounds && !context.isCancelled(); ++round) {
    // Grain is no company: without it others have none either.
    bool isChanged = false;
    const LineCompany company(set, isGrain, lines.widthPx);
    for (int i = 0; i < std::ssize(set.contours) && !context.isCancelled(); ++i) {
      const bool isFaint = faint[i] && (faint[i]->over < standsOut || faint[i]->isFarFainter);
      if (!isFaint || isGrain[i] || company.isOneOf(i)) continue;
      isGrain[i] = isChanged = true;
    }
    if (isChanged) continue;
    // On a page that is full of it the darkest of all stands out farther than the darkest of one ground.
    const std::ptrdiff_t many = std::ranges::count(isGrain, true);
    if (std::exchange(isRaised, true) || many < 2) break;
    standsOut = standsOutOf(many);
  }
  return isGrain;
}

void dropGrain(ContourSet& set, const GreyImage& grey, bool isPencil, const std::optional<BitImage>& painted,
               const RunContext& context) {
  constexpr double kOnPaintPx = 1.5;  // the pixel of a place and its eight neighbours
  std::vector<bool> isGrain(set.contours.size(), false);
  try {
    isGrain = linesOfGrain(set, grey, isPencil, context);
  } catch (const cv::Exception&) {  // too little memory: the lines stay as they are
  }
  std::vector<Contour> kept;
  for (std::size_t i = 0; i < isGrain.size(); ++i) {
    Contour& c = set.contours[i];
    const bool isPainted = isGrain[i] && painted && anyInDisc(*painted, placeOnInk(c), kOnPaintPx);
    if (!isGrain[i] || isPainted) kept.push_back(std::move(c));
  }
  set.report.droppedGrain += static_cast<int>(set.contours.size() - kept.size());
  set.contours = std::move(kept);
}

}  // namespace batten
