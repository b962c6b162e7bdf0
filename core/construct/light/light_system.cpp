// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_system.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace batten {
namespace {

constexpr double kWallAt = 0.96;          // of the reach: the places of a fit miss part of the largest offset
constexpr double kSignFactor = 3.0;       // of every row of signs
constexpr double kSignLimit = 50.0;       // rows grow like their root beyond
constexpr double kEvenWeight = 0.02;      // of the speed's relative difference from its mean
constexpr double kRidge = 1e-4;           // of the logarithms of the span lengths
constexpr double kHeldEnds = 3.0;         // of held ends in the second phase
constexpr double kDifferenceStep = 1e-6;  // of a span length, for the derivative of the Bezier points

// Places of a span at which a fit looks: of few spans each carries more of the curve's shape.
constexpr int kPlacesOfOneSpan = 28, kPlacesOfTwoSpans = 16, kPlacesOfMore = 10;

int placesPerSpan(int spans) { return spans == 1 ? kPlacesOfOneSpan : spans == 2 ? kPlacesOfTwoSpans : kPlacesOfMore; }

}  // namespace

LightSystem::LightSystem(const LightReference& reference, const LightAsk& ask, const LightShape& start)
    : reference_(reference), ask_(ask) {
  const int spans = start.spans();
  perSpan_ = placesPerSpan(spans);
  table_ = placeTable(start.degree, perSpan_);
  ends_[0] = bernsteinPlace(start.degree, 0.0);
  ends_[1] = bernsteinPlace(start.degree, 1.0);
  places_.resize(spans * perSpan_);
  rising_.resize(places_.size());
  falling_.resize(places_.size());
  beziers_.resize(spans);
  firstLength_ = 2 * static_cast<Eigen::Index>(start.points.size());
  unknowns_ = firstLength_ + (spans > 1 ? spans : 0);
  // Starts lie where equal shares of the length and the domain meet.
  const std::vector<double> lengths = start.lengths();
  double total = 0.0, from = 0.0;
  for (const double l : lengths) total += l;
  for (int span = 0; span < spans; ++span) {
    const double share = lengths[span] / total;
    for (int k = 0; k < perSpan_; ++k) {
      Place& place = places_[span * perSpan_ + k];
      place.hint = reference.indexAt((from + share * table_.places[k].at) * reference.length());
    }
    from += share;
  }
}

void LightSystem::placesOf(const LightShape& shape, int span) {
  std::array<Vec2, kSpanPoints>& bezier = beziers_[span];
  const auto points = shape.pointsOf(span);
  bezierOfSpan(shape.degree, shape.knotsOf(span, lengths_), points, bezier);
  const double length = lengths_[span];
  double speeds = 0.0;
  const int first = span * perSpan_;
  for (int k = 0; k < perSpan_; ++k) {
    Place& place = places_[first + k];
    const PlaceTable::Place& table = table_.places[k];
    const PlaceSums sums = sumPoints(table.columns, bezier, shape.degree + 1);
    double scale = 1.0;
    for (std::size_t order = 0; order < 4; ++order) {
      place.state.d[order] = scale * Vec2(sums[2 * order], sums[2 * order + 1]);
      scale /= length;
    }
    completePlace(place.state);
    speeds += place.state.speed;
  }
  const double scale = speeds / perSpan_ * length / (2.0 * std::numbers::pi);
  for (int k = 0; k < perSpan_; ++k) places_[first + k].scale = scale;
}

void LightSystem::findFeet() {
  for (Place& place : places_) {
    place.foot = reference_.foot(place.state.d[0], place.hint);
    place.hint = place.foot.index;
  }
}

void LightSystem::chooseSigns() {
  if (!ask_.firstSlope) return;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    const double weight = place.state.speed * place.scale * place.scale;
    const double up = std::max(0.0, place.state.slope), down = std::max(0.0, -place.state.slope);
    rising_[i] = weight * up * up;
    falling_[i] = weight * down * down;
  }
  const auto& signs = switches_.choose(rising_, falling_, static_cast<int>(*ask_.firstSlope), ask_.changes);
  for (std::size_t i = 0; i < places_.size(); ++i) places_[i].slopeSign = signs[i];
}

void LightSystem::chooseKappaSigns() {
  if (!ask_.firstKappa) return;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    const double weight = place.state.speed * place.scale;
    const double left = std::max(0.0, place.state.kappa), right = std::max(0.0, -place.state.kappa);
    rising_[i] = weight * left * left;
    falling_[i] = weight * right * right;
  }
  const auto& signs = kappaSwitches_.choose(rising_, falling_, static_cast<int>(*ask_.firstKappa), ask_.inflections,
                                            SwitchPlaces::Changes::AtMost, reference_.isClosed());
  for (std::size_t i = 0; i < places_.size(); ++i) places_[i].kappaSign = signs[i];
}

namespace {

struct SignRow {
  double residual = 0.0, weight = 0.0;  ///< Unweighted residual (>= 0); the derivative counts `weight` times.
};
/// What is missing to the right sign; beyond a limit it grows like its root only (Huber).
SignRow signRow(double amount, double margin) {
  const double missing = margin - amount;
  if (!(missing > 0.0)) return {};
  return {missing, missing > kSignLimit ? kSignLimit / missing : 1.0};
}
double squareOf(const SignRow& row) {
  if (row.residual <= kSignLimit) return row.residual * row.residual;
  return kSignLimit * (2.0 * row.residual - kSignLimit);
}

}  // namespace

double LightSystem::rowsOf(const Place& place, const LightWeights& weights, Cost& cost) const {
  const double e = place.foot.offset / ask_.tolerance, l = place.scale;
  cost.worst = std::max(cost.worst, std::abs(place.foot.offset));
  const double beyond = std::max(0.0, std::abs(e) - kWallAt * ask_.reach);
  const double uneven = place.state.speed / meanSpeed_ - 1.0;
  double sum = weights.offset * weights.offset * e * e + weights.wall * weights.wall * beyond * beyond +
               kEvenWeight * kEvenWeight * uneven * uneven;
  const auto sign = [&](int wanted, double amount) {
    if (wanted == 0) return;
    const SignRow row = signRow(wanted * amount, ask_.signMargin);
    cost.wrongSign = std::max(cost.wrongSign, kSignFactor * row.residual);
    sum += weights.signs * weights.signs * kSignFactor * kSignFactor * squareOf(row);
  };
  sign(place.slopeSign, place.state.slope * l * l * l / ask_.tolerance);
  sign(place.kappaSign, place.state.kappa * l * l / ask_.tolerance);
  return sum;
}

PlaceState LightSystem::endState(const LightShape& shape, bool atEnd) const {
  const int span = atEnd ? shape.spans() - 1 : 0;
  std::array<Vec2, kSpanPoints> bezier;
  const auto points = shape.pointsOf(span);
  bezierOfSpan(shape.degree, shape.knotsOf(span, lengths_), points, bezier);
  PlaceState state;
  double scale = 1.0;
  for (std::size_t order = 0; order < 4; ++order) {
    Vec2 sum = Vec2::Zero();
    for (int j = 0; j <= shape.degree; ++j) {
      sum += ends_[atEnd ? 1 : 0].rows[order][j] * bezier[j];
    }
    state.d[order] = scale * sum;
    scale /= lengths_[span];
  }
  completePlace(state);
  return state;
}

double LightSystem::endRows(const LightShape& shape, const LightWeights& weights, Cost& cost) {
  double sum = 0.0;
  for (const bool atEnd : {false, true}) {
    const LightHold hold = holdAt(atEnd);
    if (shape.closed || isFree(atEnd)) continue;
    const PlaceState state = endState(shape, atEnd);
    const LightSample& wanted = atEnd ? reference_.samples().back() : reference_.samples().front();
    const double l = (atEnd ? places_.back() : places_.front()).scale;
    const auto row = [&](double residual) {
      cost.ends = std::max(cost.ends, kHeldEnds * std::abs(residual));
      sum += weights.ends * weights.ends * residual * residual;
    };
    if (hold != LightHold::Position) row(state.d[1].dot(leftNormal(wanted.tangent)) / state.speed * l / ask_.tolerance);
    if (hold == LightHold::Curvature) row((state.kappa - wanted.kappa) * l * l / ask_.tolerance);
    if (const auto& range = rangeAt(atEnd)) row(range->beyond(state.kappa) * l * l / ask_.tolerance);
  }
  return sum;
}

LightSystem::Cost LightSystem::evaluate(const LightShape& shape, const LightWeights& weights) {
  lengths_ = shape.lengths();
  for (int span = 0; span < shape.spans(); ++span) placesOf(shape, span);
  meanSpeed_ = 0.0;
  for (const Place& place : places_) meanSpeed_ += place.state.speed / static_cast<double>(places_.size());
  Cost cost;
  if (!(meanSpeed_ > 0.0) || !std::isfinite(meanSpeed_)) {
    cost.sound = false;
    return cost;
  }
  findFeet();
  chooseSigns();
  chooseKappaSigns();
  for (const Place& place : places_) cost.squares += rowsOf(place, weights, cost);
  cost.squares /= static_cast<double>(places_.size());
  cost.squares += endRows(shape, weights, cost);
  if (shape.spans() > 1) {
    for (const double q : shape.logLengths) cost.squares += kRidge * q * q;
  }
  cost.sound = std::isfinite(cost.squares) && std::isfinite(cost.worst);
  return cost;
}

void LightSystem::addPlace(const Place& place, const LightWeights& weights) {
  const double tau = ask_.tolerance, l = place.scale;
  const PlaceTable::Place& table = table_.places[(&place - places_.data()) % perSpan_];
  const double e = place.foot.offset / tau, beyond = std::max(0.0, std::abs(e) - kWallAt * ask_.reach);
  const double wall = beyond > 0.0 ? weights.wall * weights.wall : 0.0, offset = weights.offset * weights.offset;
  const DerivativeGradients across{reference_.normalAt(place.foot) / tau, Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
  local_.add(table, place.state, across, local_.share * (offset + wall),
             local_.share * (offset * e + wall * std::copysign(beyond, e)));
  const auto sign = [&](int wanted, double amount, double factor, DerivativeGradients gradients) {
    const SignRow row = signRow(wanted * amount, ask_.signMargin);
    if (row.weight == 0.0) return;
    const double weight = local_.share * row.weight * std::pow(weights.signs * kSignFactor, 2);
    for (Vec2& g : gradients) g *= -wanted * factor;
    local_.add(table, place.state, gradients, weight, weight * row.residual);
  };
  if (weights.signs > 0.0) {
    const double slopeFactor = l * l * l / tau, kappaFactor = l * l / tau;
    if (place.slopeSign != 0 && place.slopeSign * place.state.slope * slopeFactor < ask_.signMargin) {
      sign(place.slopeSign, place.state.slope * slopeFactor, slopeFactor, slopeGradient(place.state));
    }
    if (place.kappaSign != 0 && place.kappaSign * place.state.kappa * kappaFactor < ask_.signMargin) {
      sign(place.kappaSign, place.state.kappa * kappaFactor, kappaFactor, kappaGradient(place.state));
    }
  }
  DerivativeGradients speed = speedGradient(place.state);
  speed[1] /= meanSpeed_;
  const double even = local_.share * kEvenWeight * kEvenWeight;
  local_.add(table, place.state, speed, even, even * (place.state.speed / meanSpeed_ - 1.0));
}

void LightSystem::addEnds(const LightShape& shape, const LightWeights& weights, int span) {
  for (const bool atEnd : {false, true}) {
    if (shape.closed || span != (atEnd ? shape.spans() - 1 : 0) || isFree(atEnd)) continue;
    const PlaceState state = endState(shape, atEnd);
    const LightSample& wanted = atEnd ? reference_.samples().back() : reference_.samples().front();
    const PlaceTable::Place& table = ends_[atEnd ? 1 : 0];
    const double l = (atEnd ? places_.back() : places_.front()).scale, weight = weights.ends * weights.ends;
    const auto row = [&](double residual, double factor, DerivativeGradients gradients) {
      for (Vec2& g : gradients) g *= factor;
      local_.add(table, state, gradients, weight, weight * residual * factor);
    };
    const Vec2 across = leftNormal(wanted.tangent);
    if (holdAt(atEnd) != LightHold::Position)
      row(state.d[1].dot(across) / state.speed, l / ask_.tolerance, tangentGradient(state, across));
    if (holdAt(atEnd) == LightHold::Curvature) {
      row(state.kappa - wanted.kappa, l * l / ask_.tolerance, kappaGradient(state));
    }
    const double beyond = rangeAt(atEnd) ? rangeAt(atEnd)->beyond(state.kappa) : 0.0;
    if (beyond != 0.0) row(beyond, l * l / ask_.tolerance, kappaGradient(state));
  }
}

void LightSystem::differentiate(const LightShape& shape, int span) {
  const int degree = shape.degree;
  local_.degree = degree;
  local_.length = lengths_[span];
  local_.share = 1.0 / static_cast<double>(places_.size());
  local_.lengthCount = 0;
  if (shape.spans() > 1) differentiateByLengths(shape, span);
  local_.begin();
}

void LightSystem::differentiateByLengths(const LightShape& shape, int span) {
  const int degree = shape.degree, spans = shape.spans();
  SpanDependence& by = local_.dependence;
  std::array<Eigen::Array<double, kXLanes, 1>, kSpanPoints> unit, matrix;
  for (std::size_t j = 0; j < kSpanPoints; ++j) {
    unit[j].setZero();
    unit[j][static_cast<Eigen::Index>(j)] = 1.0;
  }
  const SpanKnots knots = shape.knotsOf(span, lengths_);
  bezierOfSpan(degree, knots, unit, matrix);
  for (int k = 0; k <= degree; ++k) {
    for (int j = 0; j < kXLanes; ++j) by.byPoint[k][j] = matrix[k][j];
  }
  KnotLanes lanes;
  for (int k = 0; k < 2 * degree; ++k) lanes[k].fill(knots[k]);
  const bool all = shape.closed && spans < kLengthsOfSpan;
  for (int k = all ? 0 : -kLengthReach; k <= (all ? spans - 1 : kLengthReach); ++k) {
    const int other = shape.closed ? ((span + k) % spans + spans) % spans : span + k;
    if (other < 0 || other >= spans) continue;
    double& length = lengths_[other];
    const double before = length;
    length = before * (1.0 + kDifferenceStep);
    const SpanKnots moved = shape.knotsOf(span, lengths_);
    length = before;
    const int at = local_.lengthCount++;
    for (int i = 0; i < 2 * degree; ++i) lanes[i][at] = moved[i];
    if (other == span) local_.ownLength = at;
    local_.lengthIndex[at] = other;
  }
  const std::array<Vec2, kSpanPoints>& here = beziers_[span];
  bezierOfLanes(degree, lanes, shape.pointsOf(span), by.xByLength, by.yByLength);
  for (int j = 0; j <= degree; ++j) {
    for (double& x : by.xByLength[j]) x = (x - here[j].x()) / kDifferenceStep;
    for (double& y : by.yByLength[j]) y = (y - here[j].y()) / kDifferenceStep;
  }
}

void LightSystem::scatter(const LightShape& shape, int span, LightMatrix& matrix, Eigen::VectorXd& gradient) const {
  std::array<Eigen::Index, SpanSystem::kMost> target{};
  for (int j = 0; j <= shape.degree; ++j) {
    const std::size_t point = shape.pointOf(span, j);
    const bool pinned = !shape.closed && (point == 0 || point + 1 == shape.points.size());
    target[2 * j] = pinned ? -1 : 2 * static_cast<Eigen::Index>(point);
    target[2 * j + 1] = pinned ? -1 : target[2 * j] + 1;
  }
  for (int i = 0; i < local_.lengthCount; ++i) {
    target[2 * (shape.degree + 1) + i] = firstLength_ + local_.lengthIndex[i];
  }
  const int used = local_.used();
  std::array<int, SpanSystem::kMost> lane{};
  for (int i = 0; i < used; ++i) lane[i] = local_.lane(i);
  const auto& squares = local_.squares();
  for (int c = 0; c < used; ++c) {
    const Eigen::Index column = target[c];
    if (column < 0) continue;
    gradient[column] += local_.gradient()[lane[c]];
    for (int r = c; r < used; ++r) {
      const Eigen::Index row = target[r];
      if (row < 0) continue;
      // A closed curve of few spans comes to some of its points twice.
      const double times = row == column && r != c ? 2.0 : 1.0;
      matrix.add(row, column, times * squares[lane[r]][lane[c]]);
    }
  }
}

void LightSystem::addSpan(const LightShape& shape, const LightWeights& weights, int span, LightMatrix& matrix,
                          Eigen::VectorXd& gradient) {
  differentiate(shape, span);
  for (int k = 0; k < perSpan_; ++k) addPlace(places_[span * perSpan_ + k], weights);
  addEnds(shape, weights, span);
  local_.sumAndCarry();
  scatter(shape, span, matrix, gradient);
}

void LightSystem::gauss(const LightShape& shape, const LightWeights& weights, LightMatrix& matrix,
                        Eigen::VectorXd& gradient) {
  matrix.setZero();
  gradient.setZero();
  for (int span = 0; span < shape.spans(); ++span) addSpan(shape, weights, span, matrix, gradient);
  if (!shape.closed) {
    for (const Eigen::Index i : {Eigen::Index{0}, Eigen::Index{1}, firstLength_ - 2, firstLength_ - 1}) {
      matrix.add(i, i, 1.0);  // nothing was added for them
    }
  }
  for (Eigen::Index i = firstLength_; i < unknowns_; ++i) {
    matrix.add(i, i, kRidge);
    gradient[i] += kRidge * shape.logLengths[i - firstLength_];
  }
}

}  // namespace batten
