// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/construct.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "core/base/parallel.h"
#include "core/construct/bezier_chain.h"
#include "core/construct/control_polygon.h"
#include "core/construct/fair_fit.h"
#include "core/construct/fit_start.h"
#include "core/construct/quintic_nurbs.h"
#include "core/construct/typical_curve.h"

namespace batten {

namespace {

std::optional<Error> outside(const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return std::nullopt;
  return Error{ErrorCode::BadParameter,
               std::string(field) + " is " + std::to_string(value) + "; it must lie between " + std::to_string(low) +
                   " and " + std::to_string(high) + ".",
               {}};
}

Result<ConstructedPiece> constructPiece(const ConstructPiece& piece, double pixelMm, const ConstructParams& params,
                                        const RunContext& context) {
  switch (params.method) {
    case ConstructMethod::ControlPolygon:
      return constructControlPolygon(piece, pixelMm, params, context);
    case ConstructMethod::Bezier:
      return constructBezierChain(piece, pixelMm, params, context);
    case ConstructMethod::Typical:
      return constructTypical(piece, pixelMm, params, context);
    case ConstructMethod::Fair:
    case ConstructMethod::Nurbs:
      break;
  }
  return constructQuinticNurbs(piece, pixelMm, params, context);
}

Result<std::vector<ConstructedPiece>> constructEach(const ConstructContour& contour, const ConstructParams& params,
                                                    const RunContext& context) {
  std::vector<Result<ConstructedPiece>> made(contour.pieces.size(), cancelled());
  parallelFor(context, static_cast<int>(made.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      made[at] = constructPiece(contour.pieces[at], contour.pixelMm, params, context);
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
    if (piece.report.note.empty()) piece.report.note = "Starts from the line itself: it allows no true and fair fit.";
  }
  return pieces;
}

}  // namespace

std::optional<Error> validate(const ConstructParams& params) {
  if (auto error = outside("construct.derivative_magnitude", params.derivativeMagnitude, 0.1, 3.0)) return error;
  if (auto error = outside("construct.degree", params.degree, 2, 5)) return error;
  if (auto error = outside("construct.removal_step", params.removalStepPx, 0.0, 200.0)) return error;
  if (auto error = outside("construct.removal_tolerance", params.removalTolerancePx, 0.0, 50.0)) return error;
  if (auto error = outside("construct.closeness", params.closenessPx, 0.0, 50.0)) return error;
  if (auto error = outside("construct.lowpass", params.lowPass, 0.0, 8.0)) return error;
  if (auto error = outside("construct.growing_stop", params.growingStopDeg, 0.2, 20.0)) return error;
  if (auto error = outside("construct.reduce", params.reduceShare, 0.0, 1.0)) return error;
  return outside("construct.keep_extrema", params.keepExtremaCost, 1.0, 1000.0);
}

Result<std::vector<ConstructedPiece>> construct(const ConstructContour& contour, const ConstructParams& params,
                                                const RunContext& context) {
  if (auto error = validate(params)) return fail(std::move(*error));
  if (params.method == ConstructMethod::Fair) {
    FairFitOptions options;
    options.keepExtremaCost = params.keepExtremaCost;
    options.reduceShare = params.reduceShare;
    return fairFit(contour, options, context);
  }
  try {
    if (params.start == ConstructStart::Fit && params.method != ConstructMethod::Typical) {
      return constructFromFit(contour, params, context);
    }
    return constructEach(contour, params, context);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "There is not enough memory to construct the curves.");
  }
}

}  // namespace batten
