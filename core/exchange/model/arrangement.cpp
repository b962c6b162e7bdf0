// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/arrangement.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curve_start.h"
#include "core/curve/knot_operations.h"
#include "core/exchange/model/cad_drawing.h"
#include "core/exchange/model/curves_on_top.h"
#include "core/exchange/model/export_check.h"
#include "core/exchange/model/line_joining.h"

namespace batten {
namespace {

/// A closed line begun where the user wants it.
Result<void> begin(ExportCurve& line) {
  if (!line.closed || !line.startMm) return {};
  const Vec2 wanted = *std::exchange(line.startMm, std::nullopt);
  for (ExportPiece& piece : line.pieces) piece.keepsDirection = true;
  if (line.pieces.size() == 1) {
    NurbsCurve& curve = line.pieces[0].curve;
    const double u = closestPoint(curve, wanted).u;
    auto begun = startedAt(curve, u);
    if (!begun) return fail(begun.error());
    if (auto& width = line.pieces[0].width) width = startedAt(*width, ArcLength(curve).at(u));
    curve = std::move(*begun);
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
std::vector<ExportCurve> without(const ExportCurve& line, const PiecesOnTop& onTop, std::size_t number) {
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
  const auto onTop = piecesOnTop(document, context);
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
