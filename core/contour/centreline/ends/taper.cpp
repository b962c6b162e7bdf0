// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/ends/taper.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/contour/centreline/profile/stroke_profile.h"

namespace batten {
namespace {

constexpr double kTaperWidths = 6.0, kLeastTaperPx = 16.0;  // looked at inside the end of the skeleton
constexpr double kFarthestTaperPx = 30.0;                   // [px] beyond it, besides two widths
constexpr double kWide = 0.75, kThin = 0.25;                // shares of the whole width between which a taper is told,
constexpr double kTaperSpanWidths = 1.5, kTaperSpanPx = 2.5;  // and how far apart they lie: less is a cut or a cap
// A stroke of two runs of the pen loses one, then is cut off: the last of its taper goes as evenly as the whole.
constexpr double kNarrow = 0.35, kFine = 0.1;           // shares of the whole width between which that last lies
constexpr double kLeastEven = 0.2, kLeastFinePx = 3.0;  // how long it is at least, as a share of the whole taper
constexpr double kFitFrom = 0.6, kFitTo = 0.08;         // shares over which the tip is extrapolated
constexpr double kUnseenTipPx = 1.5;  // [px] of the last that is seen, blur and noise hide so much more
constexpr double kUnseenWidthPx = 0.45, kFarthestUnseenPx = 3.5;  // the line itself: ink so thin is as pale as paper
constexpr double kUncertainTipPx = 2.0;                           // standard deviation of a tip that is not known
constexpr double kGone = 0.05;                                    // share below which nothing is seen
constexpr double kSteersFrom = 0.2;                               // share from which on the middle of the ink is known
constexpr double kTaperSteering = 0.5;                            // of the step aside: the noise of a pixel counts half
constexpr double kWider = 1.5;                // times the width so far: no ink is looked for beside it
constexpr double kLargestTaperStepPx = 0.75;  // [px] aside, from one pixel to the next
constexpr double kTipJoinPx = 0.3;            // [px] nearer to the tip no point of its own is made
constexpr double kGrowsAgain = 0.2;           // share by which ink that widens is another stroke's

struct TaperStation {
  Vec2 at = Vec2::Zero();
  double share = 0.0;  // of the darkness of the whole stroke
  double dark = 0.0;   // of its contrast, on the course itself
};

struct TaperTrack {
  std::vector<TaperStation> stations;
  int first = 0;  // point of the course at the first of them
  int known = 0;  // stations that are points of the course
};

// The darkness of the ink across the course.
InkAcross acrossAt(const StrokeCourse& c, const Vec2& at, const Vec2& direction, double inkLevel, double widthPx,
                   const GreyImage& grey) {
  return inkAcross(profileAcross(grey, at, direction, c.profileHalf), widthPx, inkLevel);
}

// The largest mean over five stations.
double wholeDarkness(const std::vector<TaperStation>& stations) {
  constexpr int kMean = 5;  // stations: over them the noise of one counts little
  double most = 0.0;
  for (int i = 0; i + kMean <= std::ssize(stations); ++i) {
    double sum = 0.0;
    for (int k = i; k < i + kMean; ++k) sum += stations[k].share;
    most = std::max(most, sum / kMean);
  }
  return most;
}

// From inside the stroke along its course and on beyond, as long as its ink goes on and thins.
std::optional<TaperTrack> trackTaper(const StrokeCourse& c, const GreyImage& grey) {
  const int n = c.count();
  const double w = c.widthPx;
  const int hook = static_cast<int>(std::ceil(kHookWidths * w));
  const int back = std::max(kLeastBackPoints, static_cast<int>(std::lround(w)));
  TaperTrack track;
  track.first = std::max(0, n - hook - static_cast<int>(std::max(kLeastTaperPx, kTaperWidths * w)));
  if (n - hook - track.first < back + 2) return std::nullopt;
  const CoursePoint& inner = c.points[track.first];
  const double inkLevel = sampleGrey(grey, inner.base.x(), inner.base.y());
  for (int i = track.first; i < n - hook; ++i) {
    const CoursePoint& p = c.points[i];
    const InkAcross ink = acrossAt(c, p.base, p.tangent, inkLevel, w, grey);
    track.stations.push_back({p.base, ink.darkness, ink.middle});
  }
  track.known = static_cast<int>(track.stations.size());
  const double whole = wholeDarkness(track.stations);
  if (!(whole > 0.0)) return std::nullopt;
  const double contrast = track.stations.front().dark;
  if (!(contrast > 0.0)) return std::nullopt;
  for (TaperStation& s : track.stations) {
    s.share /= whole;
    s.dark /= contrast;
  }
  // Where it thins, the mask that the skeleton is of is a pixel or two wide.
  for (int i = track.known - 1; i >= back && track.stations[i].share < kFitFrom; --i) {
    const CoursePoint& p = c.points[track.first + i];
    const double local = std::min(1.0, kWider * std::max(kThin, track.stations[i].share)) * w;
    const InkAcross ink = acrossAt(c, p.base, p.tangent, inkLevel, local, grey);
    const double centre = ink.centre.value_or(0.0);  // without ink it stays
    if (std::abs(centre) >= kLargestTaperStepPx) continue;
    track.stations[i].at += centre * leftNormal(p.tangent);
    const InkAcross centred = acrossAt(c, track.stations[i].at, p.tangent, inkLevel, local, grey);
    track.stations[i].dark = std::max(track.stations[i].dark, centred.middle / contrast);
  }
  const double farthest = hook + kFarthestTaperPx + 2.0 * w;
  double least = track.stations.back().share;
  for (int step = 0; step < static_cast<int>(farthest); ++step) {
    const Vec2 last = track.stations.back().at;
    const Vec2 d = (last - track.stations[std::ssize(track.stations) - 1 - back].at).normalized();
    const InkAcross ink = acrossAt(c, last + d, d, inkLevel, std::clamp(kWider * least, 0.0, 1.0) * w, grey);
    const double share = ink.darkness / whole;
    if (share > least + kGrowsAgain) break;
    const bool steers = share > kSteersFrom;
    const double centre = ink.centre.value_or(0.0);  // without ink it goes straight on
    if (steers && std::abs(centre) > kLargestTaperStepPx) break;
    const Vec2 at = last + d + (steers ? kTaperSteering * centre : 0.0) * leftNormal(d);
    track.stations.push_back({at, share, ink.middle / contrast});
    least = std::min(least, share);
    if (share < kGone) break;
  }
  return track;
}

// The last station from which on the share stays below `share`, counted from the inside; nothing: it is never reached.
std::optional<int> lastAbove(const std::vector<TaperStation>& stations, double share) {
  for (int i = static_cast<int>(stations.size()) - 1; i >= 0; --i) {
    if (stations[i].share >= share) return i;
  }
  return std::nullopt;
}

// The last station at which ink is seen on the course itself.
std::optional<int> lastDark(const std::vector<TaperStation>& stations) {
  constexpr double kSeen = 0.12;  // of the contrast: less may be paper
  for (int i = static_cast<int>(stations.size()) - 1; i >= 0; --i) {
    if (stations[i].dark >= kSeen) return i;
  }
  return std::nullopt;
}

// Whether the shares rise again from `first` on: the ink goes on, or is another stroke's.
bool growsAgain(const std::vector<TaperStation>& stations, int first) {
  double least = stations[first].share;
  for (int i = first; i < std::ssize(stations); ++i) {
    if (stations[i].share > least + kGrowsAgain) return true;
    least = std::min(least, stations[i].share);
  }
  return false;
}

// The station, in fractions, at which the stroke has thinned to nothing.
std::optional<double> tipOf(const TaperTrack& track, double widthPx) {
  const std::vector<TaperStation>& stations = track.stations;
  if (stations.back().share > kThin) return std::nullopt;
  const std::optional<int> wide = lastAbove(stations, kWide), thin = lastAbove(stations, kThin),
                           from = lastAbove(stations, kFitFrom), to = lastAbove(stations, kFitTo);
  if (!wide || !thin || !from || !to) return std::nullopt;
  const int span = *thin - *wide;
  if (span <= kTaperSpanWidths * widthPx + kTaperSpanPx || *to - *from < 3 || growsAgain(stations, *wide))
    return std::nullopt;
  const std::optional<int> narrow = lastAbove(stations, kNarrow), fine = lastAbove(stations, kFine);
  if (!narrow || !fine || *fine - *narrow < std::max(kLeastFinePx, kLeastEven * span)) return std::nullopt;
  const std::optional<int> dark = lastDark(stations);
  if (!dark) return std::nullopt;
  // A line through the shares; the tip is taken half a standard deviation short: rather on ink than beyond.
  double sum = 0.0, sumI = 0.0, sumII = 0.0, sumS = 0.0, sumIS = 0.0, sumSS = 0.0;
  for (int i = *from; i <= *to; ++i) {
    const double share = stations[i].share;
    sum += 1.0;
    sumI += i;
    sumII += static_cast<double>(i) * i;
    sumS += share;
    sumIS += i * share;
    sumSS += share * share;
  }
  const double meanI = sumI / sum, meanS = sumS / sum, spread = sumII - sumI * meanI;
  const double slope = (sumIS - sumI * meanS) / spread;
  if (!(slope < 0.0)) return std::nullopt;
  const double tip = meanI - meanS / slope;
  const double variance = std::max(0.0, sumSS - sumS * meanS - slope * slope * spread) / std::max(1.0, sum - 2.0);
  if (tip < track.known - 1.0 - widthPx) return std::nullopt;  // the mask has more of it than a taper would leave
  const double deviation = std::sqrt(variance * (1.0 / sum + (tip - meanI) * (tip - meanI) / spread)) / -slope;
  if (deviation > kUncertainTipPx) return std::nullopt;
  // No farther beyond what was seen than an even taper would go.
  const double even = (*to - *from) * kFitTo / (kFitFrom - kFitTo);
  const double unseen = std::min(kFarthestUnseenPx, kUnseenWidthPx / (-slope * widthPx));
  return std::max(track.known - 1.0, std::min({tip - 0.5 * deviation, *to + even + kUnseenTipPx, *dark + unseen}));
}

}  // namespace

bool reachTaperTip(StrokeCourse& c, const GreyImage& grey) {
  const std::optional<TaperTrack> track = trackTaper(c, grey);
  if (!track) return false;
  const std::optional<double> tip = tipOf(*track, c.widthPx);
  if (!tip) return false;
  const std::vector<TaperStation>& stations = track->stations;
  const auto whole = static_cast<int>(*tip);  // the last whole station before the tip
  const std::optional<int> thinning = lastAbove(stations, kFitFrom);
  const int keep = std::min({track->known - 1, whole, thinning.value_or(whole)});
  std::vector<Vec2> tail;
  for (int i = keep + 1; i <= std::min(whole, static_cast<int>(stations.size()) - 1); ++i)
    tail.push_back(stations[i].at);
  // On to the tip itself, in the last direction.
  const int last = keep + static_cast<int>(tail.size());
  const Vec2 from = stations[last].at, out = (from - stations[std::max(0, last - kLeastBackPoints)].at).normalized();
  const double left = *tip - last;
  const int more = static_cast<int>(std::ceil(left - kTipJoinPx));
  for (int k = 1; k <= more; ++k) tail.push_back(from + left * k / more * out);
  const std::vector<float> widths = valuesOf(c, &CoursePoint::measuredWidth);
  replaceTail(c, track->first + keep + 1, tail);
  c.faint.insert(c.faint.end(), tail.begin(), tail.end());
  // The widths that the half levels gave stay; from there on it thins evenly.
  const int begin = track->first + keep;
  const int known = std::min(c.count(), track->first + track->known);
  for (int i = begin; i < known; ++i) c.points[i].measuredWidth = widths[i];
  const float lastWidth = c.points[known - 1].measuredWidth;
  for (int i = known; i < c.count(); ++i)
    c.points[i].measuredWidth =
        lastWidth * static_cast<float>(c.count() - 1 - i) / static_cast<float>(c.count() - known);
  return true;
}

}  // namespace batten
