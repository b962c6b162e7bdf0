// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/construct.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "core/base/parallel.h"
#include "core/construct/bezier/bezier_chain.h"
#include "core/construct/fair/fair_fit.h"
#include "core/construct/fit_start.h"
#include "core/construct/light/light_pieces.h"
#include "core/construct/nurbs/quintic_nurbs.h"
#include "core/construct/pixel_frame.h"
#include "core/construct/polygon/control_polygon.h"
#include "core/construct/typical/typical_chain.h"

namespace batten {

namespace {

Result<ConstructedPiece> constructPiece(const ConstructPiece& piece, const ConstructParams& params,
                                        const RunContext& context) {
  switch (params.method) {
    case ConstructMethod::ControlPolygon:
      return constructControlPolygon(piece, params, context);
    case ConstructMethod::Bezier:
      return constructBezierChain(piece, params, context);
    case ConstructMethod::Typical:
      return constructTypical(piece, params, context);
    case ConstructMethod::Fair:
    case ConstructMethod::Nurbs:
      break;
  }
  return constructQuinticNurbs(piece, params, context);
}

Result<std::vector<ConstructedPiece>> constructEach(const ConstructContour& contour, const ConstructParams& params,
                                                    const RunContext& context) {
  std::vector<Result<ConstructedPiece>> made(contour.pieces.size(), cancelled());
  parallelFor(context, static_cast<int>(made.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      made[i] = constructPiece(contour.pieces[i], params, context);
    }
  });
  if (context.isCancelled()) return cancelled();
  std::vector<ConstructedPiece> pieces;
  for (auto& piece : made) {
    if (!piece) return fail(std::move(piece.error()));
    pieces.push_back(std::move(*piece));
  }
  return pieces;
}

Result<std::vector<ConstructedPiece>> constructFromFit(const ConstructContour& contour, const ConstructParams& params,
                                                       const RunContext& context) {
  if (const auto fitted = onFairFit(contour, params, context)) return constructEach(*fitted, params, context);
  if (context.isCancelled()) return cancelled();
  auto pieces = constructEach(contour, params, context);
  if (!pieces) return pieces;
  for (ConstructedPiece& piece : *pieces) {
    if (piece.report.note.empty())
      piece.report.note = "Starts from the edge points, as the true and fair fit failed on this line.";
  }
  return pieces;
}

/// All in px.
Result<std::vector<ConstructedPiece>> constructInPixels(const ConstructContour& contour, const ConstructParams& params,
                                                        const RunContext& context) {
  if (params.method == ConstructMethod::Fair) {
    FairFitOptions options;
    options.extremumSignificance = params.extremumSignificance;
    options.knotRemovalTolerance = params.light ? ConstructParams{}.knotRemovalTolerance : params.knotRemovalTolerance;
    return fairFit(contour, options, context);
  }
  const bool onFit = params.start == ConstructStart::Fit && params.method != ConstructMethod::Typical;
  return onFit ? constructFromFit(contour, params, context) : constructEach(contour, params, context);
}

}  // namespace

Result<std::vector<ConstructedPiece>> construct(const ConstructContour& contour, const ConstructParams& params,
                                                const RunContext& context) {
  if (auto error = validate(params)) return fail(std::move(*error));
  if (!(contour.pixelMm > 0.0) || !std::isfinite(contour.pixelMm))
    return fail(ErrorCode::BadParameter, "The size of a pixel must be above 0 mm.");
  try {
    const ConstructContour px = inPixels(contour);
    auto made = constructInPixels(px, params, context);
    if (!made) return made;
    for (std::size_t i = 0; i < made->size(); ++i) {
      auto piece = inMillimetres(std::move((*made)[i]), px.pieces[i], contour.pieces[i], contour.pixelMm);
      if (!piece) return fail(std::move(piece.error()));
      (*made)[i] = std::move(*piece);
    }
    if (params.method != ConstructMethod::Fair || !params.light) return made;
    if (auto light = makePiecesLight(*made, contour, params, context); !light) return fail(light.error());
    return made;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "There is not enough memory to construct the curves.");
  }
}

}  // namespace batten
