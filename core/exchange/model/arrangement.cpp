// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/arrangement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/curve_start.h"
#include "core/curve/knot_operations.h"
#include "core/exchange/model/cad_drawing.h"
#include "core/exchange/model/export_check.h"
#include "core/exchange/model/line_joining.h"

namespace batten {
namespace {

constexpr double kOnTop = 1e-7;  ///< Of the size of a curve: how near it lies to one that it lies on top of.
constexpr int kTopSamples = 17;
constexpr double kSteps = 1e6;  ///< Lengths that differ by less than a millionth are alike.

/// One curve of the document, to be compared with the others.
struct Candidate {
  std::size_t line = 0, piece = 0;
  const NurbsCurve* curve = nullptr;
  Vec2 across = Vec2::Zero();       ///< Unit vector across the chord.
  double below = 0.0, above = 0.0;  ///< Of the control points along it.
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  long size = 0;  ///< Logarithm of the length, rounded, so that the last digits put no curve before its like.
};

Candidate candidateOf(const NurbsCurve& curve, std::size_t line, std::size_t piece) {
  Candidate candidate{.line = line, .piece = piece, .curve = &curve};
  candidate.low = candidate.high = curve.controlPoints()[0];
  candidate.size = std::lround(kSteps * std::log(std::max(ArcLength(curve).total(), kOnTop)));
  const Vec2 chord = curve.controlPoints().back() - curve.controlPoints().front();
  candidate.across = chord.norm() > 0.0 ? Vec2(leftNormal(chord) / chord.norm()) : Vec2(1.0, 0.0);
  candidate.below = candidate.above = candidate.across.dot(candidate.low);
  for (const Vec2& p : curve.controlPoints()) {
    candidate.below = std::min(candidate.below, candidate.across.dot(p));
    candidate.above = std::max(candidate.above, candidate.across.dot(p));
    candidate.low = candidate.low.cwiseMin(p);
    candidate.high = candidate.high.cwiseMax(p);
  }
  return candidate;
}

bool liesOn(const std::vector<CurveSample>& samples, const NurbsCurve& other, double near) {
  return std::all_of(samples.begin(), samples.end(),
                     [&](const CurveSample& sample) { return closestPoint(other, sample.point).distance <= near; });
}

/// Asked first, as it is cheap: no curve leaves the box of its control points, nor the strip along its chord that holds
/// them.
bool canLieOn(const std::vector<CurveSample>& samples, const Candidate& longer, double near) {
  return std::all_of(samples.begin(), samples.end(), [&](const CurveSample& sample) {
    const double across = longer.across.dot(sample.point);
    return (sample.point - longer.low).minCoeff() >= -near && (longer.high - sample.point).minCoeff() >= -near &&
           across >= longer.below - near && across <= longer.above + near;
  });
}

/// Curves by squares of the page that are as large as the curve, so that those that may lie under a place are known
/// without looking at all of them.
class CurveSquares {
 public:
  void add(const Candidate& one) {
    const int level = levelOf(one);
    levels_.insert(level);
    squares_[keyOf(level, one.low, 0, 0)].push_back(&one);
  }
  /// Whether `isIt(candidate)` holds for one whose box may hold the place.
  template <class IsIt>
  bool anyAt(const Vec2& place, const IsIt& isIt) const {
    for (const int level : levels_) {
      for (int square = 0; square < 9; ++square) {
        const auto found = squares_.find(keyOf(level, place, square % 3 - 1, square / 3 - 1));
        if (found != squares_.end() && std::any_of(found->second.begin(), found->second.end(), isIt)) return true;
      }
    }
    return false;
  }

 private:
  using Key = std::array<std::int64_t, 3>;
  static constexpr double kLeastSquareMm = 1e-6, kRoom = 1.01;  ///< The latter for rounding at the border of a box.

  /// The square's side is the power of two above the box.
  static int levelOf(const Candidate& one) {
    return std::ilogb(std::max(kRoom * (one.high - one.low).maxCoeff(), kLeastSquareMm)) + 1;
  }
  static Key keyOf(int level, const Vec2& place, int right, int up) {
    const double side = std::ldexp(1.0, level);
    constexpr double kFarthest = 1e15;
    const auto numberOf = [&](double v) {
      return static_cast<std::int64_t>(std::clamp(std::floor(v / side), -kFarthest, kFarthest));
    };
    return {level, numberOf(place.x()) + right, numberOf(place.y()) + up};
  }

  std::set<int> levels_;
  std::map<Key, std::vector<const Candidate*>> squares_;
};

/// Line and piece of the curves that lie on top of another one.
Result<std::set<std::pair<std::size_t, std::size_t>>> curvesOnTop(const ExportDocument& document,
                                                                  const RunContext& context) {
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < document.curves.size(); ++i)
    for (std::size_t k = 0; k < document.curves[i].pieces.size(); ++k)
      all.push_back(candidateOf(document.curves[i].pieces[k].curve, i, k));
  // Of two alike the earlier one stays, so it comes first; a longer one comes before what lies on it.
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.size > b.size; });
  std::set<std::pair<std::size_t, std::size_t>> found;
  CurveSquares kept;
  for (const Candidate& one : all) {
    if (context.isCancelled()) return cancelled();
    const double near = kOnTop * extent(*one.curve);
    const auto samples = sampleByArcLength(*one.curve, kTopSamples);
    const bool isOnTop = kept.anyAt(samples.front().point, [&](const Candidate* other) {
      return document.curves[other->line].layer == document.curves[one.line].layer && canLieOn(samples, *other, near) &&
             liesOn(samples, *other->curve, near);
    });
    if (isOnTop)
      found.insert({one.line, one.piece});
    else
      kept.add(one);
  }
  return found;
}

/// A closed line begun where the user wants it.
Result<void> begin(ExportCurve& line) {
  if (!line.closed || !line.startMm) return {};
  const Vec2 wanted = *std::exchange(line.startMm, std::nullopt);
  for (ExportPiece& piece : line.pieces) piece.keepsDirection = true;
  if (line.pieces.size() == 1) {
    NurbsCurve& curve = line.pieces[0].curve;
    const double u = closestPoint(curve, wanted).u;
    auto turned = startedAt(curve, u);
    if (!turned) return fail(turned.error());
    if (auto& width = line.pieces[0].width) width = startedAt(*width, ArcLength(curve).at(u));
    curve = std::move(*turned);
    return {};
  }
  const auto first = std::min_element(line.pieces.begin(), line.pieces.end(), [&](const auto& a, const auto& b) {
    return (a.curve.point(a.curve.start()) - wanted).norm() < (b.curve.point(b.curve.start()) - wanted).norm();
  });
  std::rotate(line.pieces.begin(), first, line.pieces.end());
  return {};
}

void reverseIfMarked(ExportPiece& piece) {
  if (piece.direction && piece.direction->isReversed) {
    piece.curve = reversed(piece.curve);
    if (piece.width) piece.width = reversed(*piece.width);
  }
  piece.keepsDirection = piece.keepsDirection || piece.direction.has_value();
  piece.direction.reset();
}

/// The whole line runs as the latest mark on it says.
void reverseIfMarked(ExportCurve& line) {
  std::optional<PieceDirection> latest;
  for (const ExportPiece& piece : line.pieces)
    if (piece.direction && (!latest || piece.direction->mark > latest->mark)) latest = piece.direction;
  if (latest && latest->isReversed) std::reverse(line.pieces.begin(), line.pieces.end());
  for (ExportPiece& piece : line.pieces) {
    piece.direction = latest;
    reverseIfMarked(piece);
  }
}

/// Every piece as a line of its own.
void takeApart(const ExportCurve& line, std::vector<ExportCurve>& lines) {
  const ExportCurve bare = withoutPieces(line);
  for (std::size_t k = 0; k < line.pieces.size(); ++k) {
    ExportCurve& own = lines.emplace_back(bare);
    own.pieces = {line.pieces[k]};
    if (line.pieces.size() > 1) {
      own.id.append(".").append(std::to_string(k + 1));
      own.pieces[0].name = entityName(line, k);
      own.name.clear();
    }
    reverseIfMarked(own.pieces[0]);
    own.closed = isLoop(own.pieces);
  }
}

/// The line without its doubles: in as many parts as are left between them.
std::vector<ExportCurve> without(const ExportCurve& line, const std::set<std::pair<std::size_t, std::size_t>>& onTop,
                                 std::size_t number) {
  const ExportCurve bare = withoutPieces(line);
  std::vector<ExportCurve> parts;
  bool continues = false;
  for (std::size_t k = 0; k < line.pieces.size(); ++k) {
    const bool stays = !onTop.contains({number, k});
    if (stays && !continues) {
      ExportCurve& part = parts.emplace_back(bare);
      if (parts.size() > 1) part.id.append("-").append(std::to_string(parts.size()));
    }
    if (stays) parts.back().pieces.push_back(line.pieces[k]);
    continues = stays;
  }
  for (ExportCurve& part : parts) part.closed = line.closed && part.pieces.size() == line.pieces.size();
  return parts;
}

}  // namespace

Result<Arrangement> arranged(const ExportDocument& document, bool joined, const RunContext& context) {
  const auto onTop = curvesOnTop(document, context);
  if (!onTop) return fail(onTop.error());
  Arrangement result{document, 0, static_cast<int>(onTop->size())};
  result.document.curves.clear();
  for (std::size_t i = 0; i < document.curves.size(); ++i) {
    std::vector<ExportCurve> parts = without(document.curves[i], *onTop, i);
    result.lines += parts.empty() ? 0 : 1;
    for (ExportCurve& line : parts) {
      if (auto begun = begin(line); !begun) return fail(begun.error());
      if (joined) {
        reverseIfMarked(line);
        result.document.curves.push_back(std::move(line));
      } else {
        takeApart(line, result.document.curves);
      }
    }
  }
  if (joined) result.document.curves = joinedLines(std::move(result.document.curves));
  return result;
}

}  // namespace batten
