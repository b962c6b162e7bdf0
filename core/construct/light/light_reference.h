// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// One sample of the curve that a light one is to stand for. Units of the curve.
struct LightSample {
  Vec2 point = Vec2::Zero();
  Vec2 tangent = Vec2::UnitX();  ///< Unit direction of travel.
  double kappa = 0.0;            ///< Signed curvature, positive to the left.
  double slope = 0.0;            ///< d kappa / ds.
  double s = 0.0;                ///< Arc length from the first sample.
  double u = 0.0;                ///< Parameter of the curve.
};

/// The nearest sample of a place and the place's coordinates there.
struct LightFoot {
  int index = 0;
  double offset = 0.0;  ///< Signed distance from the curve, positive on its left (second order in `along`).
  double along = 0.0;   ///< From the sample along its tangent.
};

/// A dense curve as samples at nearly equal steps: what a light curve is measured against. A closed one begins where
/// its curvature changes fastest, so that no extremum lies at the seam, and does not repeat its first sample.
class LightReference {
 public:
  /// @param step largest distance of two samples; they lie closer where the curve turns quickly. Absent when the curve
  /// has no length or a derivative that vanishes, or turns by more than 20 degrees at once (a corner): it then has no
  /// normal everywhere.
  /// Absent, too, when cancelled.
  /// @param diagonal of the whole that the curve is a section of; absent: its own.
  static std::optional<LightReference> make(const NurbsCurve&, bool closed, double step,
                                            std::optional<double> diagonal = {}, CancelCheck check = {});
  /// Of a smooth line of points at about even steps, with its direction and curvature by differences; a closed one does
  /// not repeat its first point. Absent when it has no length. @pre at least 5 points.
  static std::optional<LightReference> through(const std::vector<Vec2>& points, bool closed);

  const std::vector<LightSample>& samples() const { return samples_; }
  int size() const { return static_cast<int>(samples_.size()); }
  const LightSample& at(int i) const { return samples_[i]; }
  bool isClosed() const { return closed_; }
  double length() const { return length_; }
  double diagonal() const { return diagonal_; }      ///< Of the bounding box of the samples, or the one given.
  double largestKappa() const { return kappaMax_; }  ///< Largest |kappa|.

  /// The foot of a place, looked for from sample `hint` on, downhill only (both ways; around the seam where closed).
  LightFoot foot(const Vec2& place, int hint) const;
  /// Unit normal of the curve at a foot: the gradient of its `offset`.
  Vec2 normalAt(const LightFoot&) const;
  /// Sample nearest to arc length s (wrapped where closed, else clamped).
  int indexAt(double s) const;
  /// Linear between the samples; s wrapped where closed, else clamped.
  Vec2 pointAt(double s) const;

 private:
  LightReference() = default;
  /// Sets what is known of all samples together. False where they have no extent.
  bool measureWhole(std::optional<double> diagonal);
  bool addSpan(const NurbsCurve&, double from, double to, int steps);
  bool add(const NurbsCurve&, const LightSample& next, int depth);
  void beginWhereSteepest();

  std::vector<LightSample> samples_;
  /// Of the samples, side by side: the search for a foot reads nothing else of them, and every evaluation of a fit
  /// makes one for each of its places.
  std::vector<Vec2> points_;
  bool closed_ = false;
  double length_ = 0.0, diagonal_ = 0.0, kappaMax_ = 0.0;
};

}  // namespace batten
