// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/piece_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/number_text.h"
#include "core/curve/line_names.h"
#include "core/polyline/point_grid.h"

namespace batten {
namespace {

/// [px] Thresholds and filters move a line by less; as for choices (piece_choices).
constexpr double kNumberReachPx = 8.0;
/// [px] A line that lies where it lay, but for rounding and the spacing of its points.
constexpr double kSamePlaceReachPx = 1.5;
/// Of the places of a line: a crossing line meets one of them, a part that deserves the number two.
constexpr int kFewestPlaces = 2;
/// Noted along a line, in the middle of as many equal parts: none lies at an end, where other lines begin.
constexpr int kPlacesNoted = 5;
/// Lines that are gone may come back. So many are remembered; those that went first are forgotten first.
constexpr std::ptrdiff_t kMostGone = 5000;
constexpr double kPlaceRoundingPx = 0.1;  // places are stored in the recipe as short numbers
const std::string kCurveNameBegin = "Curve ";

std::vector<Vec2> placesOf(const Piece& piece) {
  std::vector<Vec2> places;
  const auto count = std::ssize(piece.points);
  std::optional<std::ptrdiff_t> last;
  for (int k = 0; k < kPlacesNoted; ++k) {
    const std::ptrdiff_t i = (2 * k + 1) * count / (2 * kPlacesNoted);
    if (last == i || i >= count) continue;
    last = i;
    const Vec2 p = piece.points[i].at / kPlaceRoundingPx;
    places.push_back(kPlaceRoundingPx * Vec2(std::round(p.x()), std::round(p.y())));
  }
  return places;
}

/// What speaks for giving the number of a known curve to a piece.
struct NumberClaim {
  std::size_t known = 0, piece = 0;
  int near = 0, within = 0;  ///< Places of the curve on the piece, within the two reaches.
};

/// The piece nearest to each place of the known curves.
class PlaceOwners {
 public:
  explicit PlaceOwners(const std::vector<NumberedCurve>& curves) {
    for (std::size_t known = 0; known < curves.size(); ++known) {
      for (const Vec2& p : curves[known].placesPx) {
        grid_.add(p, places_.size());
        places_.push_back({p, known});
      }
    }
  }

  void look(const Piece& piece, std::size_t index) {
    for (const PiecePoint& point : piece.points) {
      grid_.around(point.at, [&](std::size_t at) {
        NotedPlace& place = places_[at];
        const double distance = (place.at - point.at).norm();
        if (distance > kNumberReachPx || distance >= place.distance) return;
        place.distance = distance;
        place.piece = index;
      });
    }
  }

  std::vector<NumberClaim> claims() const {
    std::map<std::pair<std::size_t, std::size_t>, NumberClaim> found;
    for (const NotedPlace& place : places_) {
      if (!place.piece) continue;
      NumberClaim& claim =
          found.try_emplace({place.known, *place.piece}, NumberClaim{place.known, *place.piece}).first->second;
      ++claim.within;
      if (place.distance <= kSamePlaceReachPx) ++claim.near;
    }
    std::vector<NumberClaim> list;
    list.reserve(found.size());
    for (const auto& [pair, claim] : found) list.push_back(claim);
    return list;
  }

 private:
  struct NotedPlace {
    Vec2 at;
    std::size_t known;
    double distance = std::numeric_limits<double>::infinity();
    std::optional<std::size_t> piece{};
  };
  std::vector<NotedPlace> places_;
  PointGrid<std::size_t> grid_{kNumberReachPx};
};

/// The numbers that pieces have from known curves.
struct KeptNumbers {
  std::vector<std::optional<int>> ofPiece;
  std::vector<bool> isThere;  ///< The known curves that have a piece.
};

KeptNumbers keptNumbers(const PieceSet& set, const std::vector<NumberedCurve>& known, const RunContext& context) {
  KeptNumbers kept{std::vector<std::optional<int>>(set.pieces.size()), std::vector<bool>(known.size(), false)};
  if (known.empty()) return kept;
  PlaceOwners owners(known);
  for (std::size_t piece = 0; piece < set.pieces.size(); ++piece) {
    if (context.isCancelled()) return kept;
    owners.look(set.pieces[piece], piece);
  }
  std::vector<NumberClaim> claims = owners.claims();
  std::sort(claims.begin(), claims.end(), [&](const NumberClaim& a, const NumberClaim& b) {
    return std::tuple(-a.near, -a.within, known[a.known].number, a.piece) <
           std::tuple(-b.near, -b.within, known[b.known].number, b.piece);
  });
  for (const NumberClaim& claim : claims) {
    const NumberedCurve& curve = known[claim.known];
    const int asked = std::min(kFewestPlaces, static_cast<int>(curve.placesPx.size()));
    if (claim.within < asked || kept.ofPiece[claim.piece] || kept.isThere[claim.known]) continue;
    kept.ofPiece[claim.piece] = curve.number;
    kept.isThere[claim.known] = true;
  }
  return kept;
}

}  // namespace

PieceNumbers numberPieces(const PieceSet& set, const CurveNumbers& known, const RunContext& context) {
  PieceNumbers result;
  const KeptNumbers kept = keptNumbers(set, known.curves, context);
  if (context.isCancelled()) return {{}, known};
  result.known.lastGiven = known.lastGiven;
  for (const NumberedCurve& curve : known.curves)
    result.known.lastGiven = std::max(result.known.lastGiven, curve.number);
  for (std::size_t piece = 0; piece < set.pieces.size(); ++piece) {
    result.ofPiece.push_back(kept.ofPiece[piece] ? *kept.ofPiece[piece] : ++result.known.lastGiven);
    if (!set.pieces[piece].points.empty())
      result.known.curves.push_back({result.ofPiece[piece], placesOf(set.pieces[piece])});
  }
  std::sort(result.known.curves.begin(), result.known.curves.end(),
            [](const NumberedCurve& a, const NumberedCurve& b) { return a.number < b.number; });
  const std::ptrdiff_t present = std::ssize(result.known.curves);
  for (std::size_t i = 0; i < known.curves.size() && std::ssize(result.known.curves) < present + kMostGone; ++i)
    if (!kept.isThere[i]) result.known.curves.push_back(known.curves[i]);
  return result;
}

std::string curveName(int number) { return kCurveNameBegin + std::to_string(number); }

std::optional<int> numberOfCurveName(std::string_view name) {
  constexpr int kMostNumber = 1'000'000;  // limit of input
  if (!name.starts_with(kCurveNameBegin)) return std::nullopt;
  const auto number = integerFromText(name.substr(kCurveNameBegin.size()));
  return number && *number >= 1 && *number <= kMostNumber && curveName(*number) == name ? number : std::nullopt;
}

bool isMadeName(std::string_view name) {
  if (numberOfCurveName(name)) return true;
  if (!name.starts_with(kLineIdBegin)) return false;
  name.remove_prefix(kLineIdBegin.size());
  std::string rest(name);
  if (const auto at = rest.find(kSketchedIdEnd); at != std::string::npos) rest.erase(at, kSketchedIdEnd.size());
  // "-2" and ".2" stand behind the number where a line was written in parts.
  return !rest.empty() && rest.find_first_not_of("0123456789-.") == std::string::npos &&
         integerFromText(std::string_view(rest).substr(0, rest.find_first_of("-.")));
}

}  // namespace batten
