// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/fair/sharp_features.h"
#include "core/construct/pieces.h"

namespace batten {

/// A piece cut where it turns too sharply for the fair fit: smooth stretches, each fitted for itself, and sharp
/// features. One of more than 1000 sharp features becomes one corner fill along its points, with a note. All in px.
class SmoothSections {
 public:
  SmoothSections(const ConstructPiece& piece, bool isStroke, const FairFitOptions&);

  bool hasSharpFeatures() const { return !sharp_.empty(); }
  /// The smooth stretches as pieces of their own.
  std::vector<ConstructPiece> stretches() const;
  /// Takes the fits of stretches(); where one has left its points further sharp features are noted. True when there
  /// are.
  bool check(std::vector<ConstructedPiece> fits, bool lastRound, CancelCheck run = {});
  /// The whole, made of the fits: stretches and sharp features in one curve, with the reports together; what is not
  /// near its points is replaced by a quintic through stations.
  Result<ConstructedPiece> joined(const RunContext&) &&;

 private:
  /// A fit that has left some of its points in the last round.
  struct OutlierFit {
    std::size_t fit = 0;
    PointDeviation deviation;
    std::vector<PointRange> outliers;
  };
  /// Of those fits only what is near the points; corner fills come between.
  void keepNear(const std::vector<OutlierFit>&, const std::vector<ConstructPiece>& pieces);
  /// Cuts the stretches and their fits where these are on their points. Unfinished when cancelled.
  void endOnPoints(CancelCheck run);
  Result<ConstructedPiece> joinedParts(const RunContext&);
  void noteUnmet(ConstructReport&) const;
  Result<ConstructedPiece> throughStations(const RunContext&) const;
  std::vector<PiecePoint> pointsOf(const PointRange&) const;

  const ConstructPiece& piece_;
  std::vector<PointRange> sharp_, smooth_;
  std::optional<std::size_t> scattered_;  ///< Sharp features of a piece that has too many to be taken apart.
  std::vector<ConstructedPiece> fits_;
};

}  // namespace batten
