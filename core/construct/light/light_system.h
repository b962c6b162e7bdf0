// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/construct/light/bezier_spans.h"
#include "core/construct/light/light_fit.h"
#include "core/construct/light/light_matrix.h"
#include "core/construct/light/light_rows.h"
#include "core/construct/light/span_system.h"
#include "core/construct/light/switch_places.h"

namespace batten {

/// Weights of the rows; they change from phase to phase.
struct LightWeights {
  double offset = 1.0;  ///< Of offset / tolerance.
  double wall = 0.0;    ///< Of what lies beyond .96 of the tolerance.
  double signs = 0.0;   ///< Of wrong signs of the curvature's slope and of the curvature.
  double ends = 0.3;    ///< Of held tangents and curvatures.
};

/// The rows of one fit at one shape: residuals, and their Gauss-Newton system. A fit evaluates them hundreds of times:
/// matrix and gradient are written into memory that its caller keeps.
class LightSystem {
 public:
  LightSystem(const LightReference&, const LightAsk&, const LightShape& start);

  struct Cost {
    double squares = 0.0;    ///< Half of it is what is minimised.
    double worst = 0.0;      ///< Largest |offset|.
    double wrongSign = 0.0;  ///< Largest row of wrong sign, without its growing weight.
    double ends = 0.0;       ///< Largest row of a held end, as weighed in the second phase.
    bool sound = true;       ///< All finite.
  };
  /// Residuals at a shape; remembers the places for `gauss`.
  Cost evaluate(const LightShape&, const LightWeights&);
  /// Matrix and gradient at the shape evaluated last. Unknowns: x and y of every control point, then the span lengths'
  /// logarithms where there is more than one span; pinned ones have a unit diagonal and no gradient.
  void gauss(const LightShape&, const LightWeights&, LightMatrix& matrix, Eigen::VectorXd& gradient);
  Eigen::Index unknowns() const { return unknowns_; }
  Eigen::Index firstLength() const { return firstLength_; }

 private:
  struct Place {
    PlaceState state;
    LightFoot foot;
    double scale = 0.0;         ///< Length of the span over 2 pi: the wave that its spans can follow.
    int hint = 0;               ///< Sample to look for the foot from.
    signed char slopeSign = 0;  ///< 0: free.
    signed char kappaSign = 0;
  };

  void placesOf(const LightShape&, int span);
  void findFeet();
  void chooseSigns();
  void chooseKappaSigns();
  double rowsOf(const Place&, const LightWeights&, Cost&) const;
  double endRows(const LightShape&, const LightWeights&, Cost&);
  void addSpan(const LightShape&, const LightWeights&, int span, LightMatrix&, Eigen::VectorXd&);
  void differentiate(const LightShape&, int span);
  void differentiateByLengths(const LightShape&, int span);
  void scatter(const LightShape&, int span, LightMatrix&, Eigen::VectorXd&) const;
  void addPlace(const Place&, const LightWeights&);
  void addEnds(const LightShape&, const LightWeights&, int span);
  PlaceState endState(const LightShape&, bool atEnd) const;
  LightHold holdAt(bool atEnd) const { return atEnd ? ask_.end : ask_.start; }
  const std::optional<CurvatureRange>& rangeAt(bool atEnd) const { return atEnd ? ask_.endRange : ask_.startRange; }
  bool isFree(bool atEnd) const { return holdAt(atEnd) == LightHold::Position && !rangeAt(atEnd); }

  const LightReference& reference_;
  const LightAsk ask_;
  PlaceTable table_;
  PlaceTable::Place ends_[2];
  int perSpan_ = 0;
  std::vector<Place> places_;
  std::vector<double> lengths_, rising_, falling_;
  std::vector<std::array<Vec2, kSpanPoints>> beziers_;  ///< Of every span, at the shape evaluated last.
  SpanSystem local_;
  double meanSpeed_ = 1.0;
  SwitchPlaces switches_, kappaSwitches_;
  Eigen::Index unknowns_ = 0, firstLength_ = 0;
};

}  // namespace batten
