// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/label/label_vote.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/solve/small_least_squares.h"

namespace batten {
namespace {

constexpr double kLetterOfPage = 0.25;  // [page diagonals] larger pieces are no letters
constexpr double kLetterRadii = 4.0;    // smaller pieces, against their largest disc, are dots
constexpr double kLetterLength = 40.0;  // [pen widths] four or five lines of a letter, each of at most ten
// [pen widths] three strokes with paper between them, as an E has, are so high. What is lower is a dash or a letter
// lying down, and as large as it is long; what is as high is a row of joined letters, each about as wide as high.
constexpr double kLetterHeight = 5.0;
constexpr double kBroadUnevenness = 0.075;  // median that one pen leaves unexplained in an alphabet
constexpr double kLeastUnevenness = 0.02;   // of a piece whose widths are held against their directions
constexpr double kHairWidths = 0.5;         // of the pen of a piece: thinner paths are hairs
constexpr double kLeastBroadPx = 4.5;  // of the page: below it the grid of pixels is as large as the contrast of a nib
// The widths of a narrow pen also vary by its raster, the paper and the photograph, those of a nib by direction: by .6
// to .9 of their variance on rendered alphabets, .2 at most in handwriting with felt pens and pencils. Letters that are
// hardly larger than the pen is wide are blots, and are read by their outline.
constexpr double kNarrowPens = 3.0;  // [least broad pens]
constexpr double kLeastByDirection = 0.4;
constexpr double kUnevenHandwriting = 0.2;  // a pen never leaves more unexplained: such letters were filled in
constexpr double kSlenderWidths = 4.0;      // [pen widths] of the size of letters
constexpr int kLeastVoters = 5;             // pieces: fewer are no lettering
// Of the letters of an alphabet two in five to half are one line (C, I, L, S, Z); strokes that thin out are, all of
// them.
constexpr double kOneLineShare = 0.75;

// Of the area of the letters: from here to a half, neither strokes nor shapes have it, and every piece keeps its label.
constexpr double kFewShapes = 0.4;

// Widths along strokes against their directions: those of a nib or a brush go with the direction, as a + b cos 2t +
// c sin 2t, and what a felt pen or the grain varies by does not.
class WidthByDirection {
 public:
  void add(const Vec2& tangent, double widthPx) {
    const double c = tangent.x() * tangent.x() - tangent.y() * tangent.y(), s = 2.0 * tangent.x() * tangent.y();
    fit_.add({1.0, c, s}, widthPx);
    squares_ += widthPx * widthPx;
  }
  void add(const WidthByDirection& other) {
    fit_.add(other.fit_);
    squares_ += other.squares_;
  }
  // 0..1: of the variance of the widths what their direction explains.
  double explained() const {
    const double count = fit_.normal()(0, 0);
    if (!(count > 0.0)) return 0.0;
    const Eigen::Vector3d& right = fit_.right();
    const double all = squares_ - right[0] * right[0] / count;
    SmallLeastSquares<3> held = fit_;
    held.hold(Eigen::Vector3d::Constant(kPrior * count));
    const double left = squares_ - right.dot(held.solve());
    return all > 0.0 ? std::clamp(1.0 - left / all, 0.0, 1.0) : 0.0;
  }

 private:
  static constexpr double kPrior = 1e-9;  // of lines of one direction alone
  SmallLeastSquares<3> fit_;
  double squares_ = 0.0;
};

// What the vote looks at in one piece.
struct Voter {
  std::size_t piece = 0;
  int widthBin = 0, sizeBin = 0, meanBin = 0;  // half octaves: of the largest disc, of the piece, of the mean width
  double area = 0.0, uneven = 0.0, penPx = 0.0, widestPx = 0.0, sizePx = 0.0, widthsLong = 0.0;
  bool isMostlyShape = false, isOneLine = false;
  WidthByDirection widths;
};

// Area that one width, the pen's, leaves unexplained in the whole piece, of all.
double unevennessOf(const LabelledPiece& piece, const InkGraph& graph) {
  double off = 0.0, all = 0.0;
  for (const int path : piece.paths) {
    for (const int chain : graph.paths()[path].chains) {
      for (const InkPixel& p : graph.chains()[chain].pixels) {
        if (p.inJunction) continue;
        off += std::max(0.0, std::abs(p.widthPx() - piece.mainPenPx) - 1.0);
        all += std::max(p.widthPx(), piece.mainPenPx);
      }
    }
  }
  return all > 0.0 ? off / all : 0.0;
}

WidthByDirection widthsByDirection(const LabelledPiece& piece, const InkGraph& graph) {
  constexpr int kTangentPx = 4;  // along the chain, to either side
  WidthByDirection widths;
  for (const int path : piece.paths) {
    for (const int chain : graph.paths()[path].chains) {
      const std::vector<InkPixel>& pixels = graph.chains()[chain].pixels;
      for (int i = kTangentPx; i + kTangentPx < std::ssize(pixels); ++i) {
        const Vec2 along = pixels[i + kTangentPx].centre() - pixels[i - kTangentPx].centre();
        if (!pixels[i].inJunction && along.norm() > 0.0) widths.add(along.normalized(), pixels[i].widthPx());
      }
    }
  }
  return widths;
}

std::optional<Voter> voterOf(const LabelledPiece& piece, const InkGraph& graph, double pageDiagonalPx) {
  const double w = piece.x1 - piece.x0, h = piece.y1 - piece.y0, diagonal = std::hypot(w, h);
  const double size = std::min(w, h) >= kLetterHeight * piece.mainPenPx ? std::sqrt(2.0) * std::min(w, h) : diagonal;
  if (size >= kLetterOfPage * pageDiagonalPx || size <= kLetterRadii * piece.largestRadiusPx || piece.paths.empty())
    return {};
  Voter v;
  v.widthBin = static_cast<int>(std::floor(2.0 * std::log2(std::max(1.0, piece.largestRadiusPx))));
  v.sizeBin = static_cast<int>(std::floor(2.0 * std::log2(std::max(1.0, size))));
  v.area = static_cast<double>(piece.areaPx);
  v.penPx = piece.mainPenPx;
  v.widestPx = piece.widestPx();
  v.sizePx = size;
  double pathsPx = 0.0;
  int lines = 0;
  for (const int number : piece.paths) {
    pathsPx += graph.paths()[number].lengthPx;
    // Hairs of a brush and of rough borders are no lines of a letter.
    const InkPath& s = graph.paths()[number];
    if (!s.widthPx || *s.widthPx < kHairWidths * piece.mainPenPx) continue;
    v.widthsLong += s.lengthPx / piece.mainPenPx;
    ++lines;
  }
  v.isOneLine = lines == 1;
  v.meanBin = static_cast<int>(std::floor(2.0 * std::log2(std::max(1.0, v.area / std::max(1.0, pathsPx)))));
  // Of joined letters, what one letter has.
  v.uneven = v.widthsLong * size / diagonal < kLetterLength ? unevennessOf(piece, graph) : 0.0;
  if (v.uneven >= kLeastUnevenness) v.widths = widthsByDirection(piece, graph);
  return v;
}

struct Tally {
  int voters = 0, oneLine = 0;
  double area = 0.0, pen = 0.0, shape = 0.0;
  std::vector<std::pair<double, double>> uneven;  // and the area
  WidthByDirection widths;
  void add(const Voter& v) {
    ++voters;
    oneLine += v.isOneLine ? 1 : 0;
    area += v.area;
    uneven.emplace_back(v.uneven, v.area);
    pen += v.area * v.penPx;
    widths.add(v.widths);
    shape += v.isMostlyShape ? v.area : 0.0;
  }
  void add(const Tally& t) {
    voters += t.voters;
    oneLine += t.oneLine;
    area += t.area;
    uneven.insert(uneven.end(), t.uneven.begin(), t.uneven.end());
    pen += t.pen;
    widths.add(t.widths);
    shape += t.shape;
  }
};

std::optional<InkLabel> decide(const Voter& voter, const Tally& t, double leastBroadPx) {
  if (t.voters < kLeastVoters || t.area <= 0.0) return {};
  // A pixel of every width counts as even (unevennessOf).
  const double limit = kBroadUnevenness * (1.0 - t.area / t.pen);
  const bool mayBeLetters = t.oneLine < kOneLineShare * t.voters;
  const double uneven = weightedMedian(t.uneven).value_or(0.0);
  const bool isHandwriting = t.pen < kNarrowPens * leastBroadPx * t.area && uneven < kUnevenHandwriting &&
                             voter.sizePx > kSlenderWidths * voter.penPx && t.widths.explained() < kLeastByDirection;
  const bool mayBeBroad = t.pen >= leastBroadPx * t.area && !isHandwriting;
  if (mayBeLetters && uneven >= limit && mayBeBroad) return InkLabel::Shape;
  if (2.0 * t.shape > t.area) return InkLabel::Shape;
  // Where lines of the pen of the others cross the ink is no wider: a scribbled blot among letters is none of them.
  if (voter.isMostlyShape && voter.widestPx > coreWidth(t.pen / t.area)) return {};
  if (t.shape < kFewShapes * t.area && voter.widthsLong < kLetterLength) return InkLabel::Stroke;
  return {};
}

}  // namespace

void voteAmongAlike(std::vector<PieceVote>& votes, const InkGraph& graph, const PiecesOfPage& page,
                    double pageDiagonalPx, double pixelsPerPx) {
  std::vector<Voter> voters;
  std::map<std::array<int, 3>, Tally> bins;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    std::optional<Voter> voter = voterOf(page.pieces[i], graph, pageDiagonalPx);
    if (!voter) continue;
    voter->piece = i;
    voter->isMostlyShape = votes[i].isMostlyShape;
    bins[{voter->widthBin, voter->sizeBin, voter->meanBin}].add(*voter);
    voters.push_back(*voter);
  }
  for (const Voter& v : voters) {
    // Half an octave of both widths and one of size about the voter: letters of a felt pen and words of a fine one may
    // hold the same disc where lines of the latter meet, but they are not alike.
    Tally near;
    for (int w = v.widthBin - 1; w <= v.widthBin + 1; ++w) {
      for (int s = v.sizeBin - 2; s <= v.sizeBin + 2; ++s) {
        for (int m = v.meanBin - 1; m <= v.meanBin + 1; ++m) {
          if (const auto bin = bins.find({w, s, m}); bin != bins.end()) near.add(bin->second);
        }
      }
    }
    votes[v.piece].decision = decide(v, near, kLeastBroadPx * pixelsPerPx);
  }
}

}  // namespace batten
