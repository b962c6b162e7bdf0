// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/stroke_drawing.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>
#include <sstream>

#include "core/base/statistics.h"
#include "core/polyline/polyline_tools.h"

namespace batten::test {
namespace {

constexpr double kPxPerUnit = 4.0, kMarginUnits = 20.0;
constexpr double kDotWidths = 1.5;  // shorter strokes cannot be followed
constexpr int kNeighbours = 40, kMiddleNeighbours = 24;
constexpr double kSameWay = 0.8, kAboutSameWay = 0.5, kLyingOver = 0.9;
constexpr double kLeastShare = 0.12;  // of a stroke on a curve: less is none
constexpr double kMostlyOver = 0.8;   // of a stroke within half a width of another: one cannot tell them apart

struct SampledPolyline {
  std::vector<Vec2> at, tangent;
  double length = 0.0;
};

// Points every `step`, and directions over a short base.
std::optional<SampledPolyline> sampled(const std::vector<Vec2>& given, double step) {
  std::vector<Vec2> v;
  for (const Vec2& p : given)
    if (v.empty() || (p - v.back()).norm() > 1e-9) v.push_back(p);
  if (v.size() < 2) return std::nullopt;
  const std::vector<double> arc = cumulativeLength(v);
  SampledPolyline s;
  s.length = arc.back();
  const int n = std::max(2, static_cast<int>(std::lround(s.length / step)) + 1);
  std::size_t i = 0;
  for (int k = 0; k < n; ++k) {
    const double wanted = s.length * k / (n - 1);
    while (i + 2 < v.size() && arc[i + 1] < wanted) ++i;
    s.at.push_back(v[i] + (wanted - arc[i]) / (arc[i + 1] - arc[i]) * (v[i + 1] - v[i]));
  }
  const int reach = std::max(1, std::min(3, (n - 1) / 2));
  for (int k = 0; k < n; ++k) {
    const Vec2 way = s.at[std::min(k + reach, n - 1)] - s.at[std::max(k - reach, 0)];
    s.tangent.push_back(way / std::max(way.norm(), 1e-9));
  }
  return s;
}

// The nearest points, the nearest first.
std::vector<std::pair<double, int>> nearest(const std::vector<Vec2>& points, const Vec2& at, int count) {
  std::vector<std::pair<double, int>> all;
  all.reserve(points.size());
  for (int i = 0; i < std::ssize(points); ++i) all.emplace_back((points[i] - at).squaredNorm(), i);
  const auto end = all.begin() + std::min<std::ptrdiff_t>(count, std::ssize(all));
  std::partial_sort(all.begin(), end, all.end());
  all.erase(end, all.end());
  for (auto& [d, i] : all) d = std::sqrt(d);
  return all;
}

}  // namespace

std::optional<StrokeDrawing> StrokeDrawing::read(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::stringstream all;
  all << in.rdbuf();
  const std::string text = all.str();
  const auto at = text.find('@');
  if (at == std::string::npos) return std::nullopt;
  StrokeDrawing drawing;
  drawing.name = file.stem().string();
  drawing.widthPx = std::stod(text.substr(at + 1)) * kPxPerUnit;
  for (auto open = text.find('{'); open != std::string::npos; open = text.find('{', open + 1)) {
    std::string body = text.substr(open + 1, text.find('}', open) - open - 1);
    for (auto mark = body.find('@'); mark != std::string::npos; mark = body.find('@')) {
      body.erase(mark, body.find_first_of(" \t\r\n", mark) - mark);
    }
    std::replace(body.begin(), body.end(), '#', ' ');
    std::istringstream words(body);
    int number = 0;
    Stroke stroke;
    words >> number >> stroke.cluster;
    double x = 0.0, y = 0.0, pressure = 0.0;
    while (words >> x >> y >> pressure) stroke.points.emplace_back(x, y);
    if (!stroke.points.empty()) drawing.strokes.push_back(std::move(stroke));
  }
  if (drawing.strokes.empty()) return std::nullopt;
  Vec2 low = drawing.strokes[0].points[0], high = low;
  for (const Stroke& s : drawing.strokes)
    for (const Vec2& p : s.points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  const Vec2 margin(kMarginUnits, kMarginUnits);
  const Vec2 size = kPxPerUnit * (high - low + 2.0 * margin);
  drawing.pageWidth = static_cast<int>(size.x());
  drawing.pageHeight = static_cast<int>(size.y());
  for (Stroke& s : drawing.strokes)
    for (Vec2& p : s.points) p = kPxPerUnit * (p - low + margin);
  return drawing;
}

Scan StrokeDrawing::page() const {
  constexpr int kShift = 4;  // bits of a fraction of a pixel
  constexpr double kFraction = 16.0, kDpi = 300.0;
  cv::Mat paper(pageHeight, pageWidth, CV_8UC1, cv::Scalar(255));
  for (const Stroke& s : strokes) {
    std::vector<cv::Point> line;
    for (const Vec2& p : s.points)
      line.emplace_back(static_cast<int>(std::lround(p.x() * kFraction)),
                        static_cast<int>(std::lround(p.y() * kFraction)));
    cv::polylines(paper, line, false, cv::Scalar(0), std::max(1, static_cast<int>(std::lround(widthPx))), cv::LINE_AA,
                  kShift);
  }
  Scan scan = blankScan(pageWidth, pageHeight, kDpi);
  scan.grey = GreyImage(pageWidth, pageHeight);  // one row a line, to be drawn on
  scan.info.format = "PNG";
  for (int y = 0; y < pageHeight; ++y)
    for (int x = 0; x < pageWidth; ++x)
      scan.grey.row(y)[x] = static_cast<std::uint16_t>(paper.at<std::uint8_t>(y, x) * GreyImage::kGreyUnit);
  return scan;
}

bool StrokeFigures::isCountRight() const { return std::abs(curves - clusters) <= 0.1 * clusters; }

StrokeJudge::StrokeJudge(const StrokeDrawing& drawing)
    : width_(drawing.widthPx), step_(std::max(4.0, drawing.widthPx)) {
  for (const StrokeDrawing::Stroke& s : drawing.strokes) {
    const auto line = sampled(s.points, step_);
    if (!line || line->length < kDotWidths * width_) continue;
    for (std::size_t i = 0; i < line->at.size(); ++i) samples_.push_back({line->at[i], line->tangent[i], strokes_});
    cluster_.push_back(s.cluster);
    ++strokes_;
  }
  findMiddles();
  findHidden();
}

// Every sample moves across the line to the mean of its cluster's strokes there, one crossing a stroke, twice.
void StrokeJudge::findMiddles() {
  std::map<int, std::vector<int>> members;
  for (int i = 0; i < std::ssize(samples_); ++i) {
    samples_[i].middle = samples_[i].at;
    members[cluster_[samples_[i].stroke]].push_back(i);
  }
  for (const auto& [cluster, own] : members) {
    std::vector<Vec2> at;
    for (const int i : own) at.push_back(samples_[i].at);
    std::vector<double> gaps;
    for (const int i : own) {
      for (const auto& [d, k] : nearest(at, samples_[i].at, kMiddleNeighbours)) {
        const Sample& other = samples_[own[k]];
        if (other.stroke == samples_[i].stroke || std::abs(other.tangent.dot(samples_[i].tangent)) <= kSameWay)
          continue;
        gaps.push_back(d);
        break;
      }
    }
    const double least = 2.5 * width_;
    const double reach = gaps.empty() ? least : std::max(least, 1.5 * lowerQuantile(gaps, 0.9));
    for (int round = 0; round < 2; ++round) {
      std::vector<Vec2> moved;
      for (const int i : own) {
        const Sample& s = samples_[i];
        const Vec2 normal = leftNormal(s.tangent);
        std::map<int, std::pair<double, int>> crossings;
        for (const int k : own) {
          const Vec2 way = samples_[k].at - s.middle;
          if (way.norm() > reach || std::abs(way.dot(s.tangent)) >= step_ ||
              std::abs(samples_[k].tangent.dot(s.tangent)) <= kSameWay)
            continue;
          auto& [sum, count] = crossings[samples_[k].stroke];
          sum += way.dot(normal);
          ++count;
        }
        double sum = 0.0;
        for (const auto& [stroke, c] : crossings) sum += c.first / c.second;
        moved.push_back(crossings.empty() ? s.middle
                                          : Vec2(s.middle + sum / static_cast<double>(crossings.size()) * normal));
      }
      for (std::size_t k = 0; k < own.size(); ++k) samples_[own[k]].middle = moved[k];
    }
  }
}

void StrokeJudge::findHidden() {
  const double reach = std::max(0.5 * width_, 0.6 * step_);
  std::vector<std::map<int, int>> over(strokes_);
  std::vector<int> count(strokes_);
  for (const Sample& s : samples_) {
    ++count[s.stroke];
    std::set<int> here;
    for (const Sample& other : samples_)
      if ((other.at - s.at).squaredNorm() <= reach * reach && std::abs(other.tangent.dot(s.tangent)) > kLyingOver)
        here.insert(other.stroke);
    for (const int other : here) ++over[s.stroke][other];
  }
  hidden_.assign(strokes_, std::vector<bool>(strokes_, false));
  for (int a = 0; a < strokes_; ++a)
    for (const auto& [b, n] : over[a])
      if (a != b && n > kMostlyOver * count[a]) hidden_[a][b] = hidden_[b][a] = true;
}

namespace {

// Of the curves that a stroke lies on, those that have enough of it; none where they have less than half of it.
void keepLargeShares(std::vector<std::map<int, double>>& share, const std::vector<double>& count) {
  for (int s = 0; s < std::ssize(share); ++s) {
    double sum = 0.0;
    for (auto& [c, part] : share[s]) part /= count[s];
    std::erase_if(share[s], [](const auto& e) { return e.second < kLeastShare; });
    for (const auto& [c, part] : share[s]) sum += part;
    if (sum < 0.5) share[s].clear();
    for (auto& [c, part] : share[s]) part /= sum;
  }
}

}  // namespace

void StrokeJudge::countPairs(const std::vector<std::map<int, double>>& share, StrokeFigures& f) const {
  double right = 0.0, wrong = 0.0, missed = 0.0;
  for (int a = 0; a < strokes_; ++a)
    for (int b = a + 1; b < strokes_; ++b) {
      double together = 0.0;
      for (const auto& [c, part] : share[a]) {
        const auto other = share[b].find(c);
        if (other != share[b].end()) together += std::min(part, other->second);
      }
      const bool isOne = cluster_[a] == cluster_[b], isFoundOne = together >= 0.5;
      if (isOne && isFoundOne) ++right;
      if (isOne && !isFoundOne) ++missed;
      if (!isOne && isFoundOne && !hidden_[a][b]) ++wrong;
    }
  f.precision = right + wrong > 0.0 ? right / (right + wrong) : 1.0;
  f.recall = right + missed > 0.0 ? right / (right + missed) : 1.0;
  f.f1 = f.precision + f.recall > 0.0 ? 2.0 * f.precision * f.recall / (f.precision + f.recall) : 0.0;
}

StrokeFigures StrokeJudge::judge(const std::vector<std::vector<Vec2>>& curvesPx) const {
  std::vector<Vec2> at, tangent;
  std::vector<int> curve;
  for (int c = 0; c < std::ssize(curvesPx); ++c) {
    const auto line = sampled(curvesPx[c], 0.7 * step_);
    if (!line) continue;
    at.insert(at.end(), line->at.begin(), line->at.end());
    tangent.insert(tangent.end(), line->tangent.begin(), line->tangent.end());
    curve.resize(at.size(), c);
  }
  StrokeFigures f;
  f.curves = static_cast<int>(curvesPx.size());
  f.clusters = static_cast<int>(std::set<int>(cluster_.begin(), cluster_.end()).size());
  if (at.empty()) return f;
  std::vector<std::map<int, double>> share(strokes_);
  std::vector<double> count(strokes_);
  std::vector<double> distances;
  for (const Sample& s : samples_) {
    ++count[s.stroke];
    const double reach = 1.3 * (s.middle - s.at).norm() + 2.5 * width_;
    int straight = -1, oblique = -1;
    for (const auto& [d, k] : nearest(at, s.at, kNeighbours)) {
      if (d > reach) break;
      const double along = std::abs(tangent[k].dot(s.tangent));
      if (straight < 0 && along > kSameWay) straight = k;
      if (oblique < 0 && along > kAboutSameWay) oblique = k;
    }
    const int hit = straight >= 0 ? straight : oblique;
    if (hit < 0) continue;
    share[s.stroke][curve[hit]] += 1.0;
    for (const auto& [d, k] : nearest(at, s.middle, kNeighbours)) {
      if (std::abs(tangent[k].dot(s.tangent)) <= kSameWay) continue;
      distances.push_back(d / width_);
      break;
    }
  }
  keepLargeShares(share, count);
  countPairs(share, f);
  if (!distances.empty()) {
    for (const double d : distances) f.meanWidths += d / static_cast<double>(distances.size());
    f.p95Widths = lowerQuantile(distances, 0.95);
  }
  return f;
}

}  // namespace batten::test
