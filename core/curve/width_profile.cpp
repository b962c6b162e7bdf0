// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/width_profile.h"

#include <algorithm>
#include <cmath>

namespace batten {

double WidthProfile::at(double s) const {
  const auto above = std::upper_bound(samples.begin(), samples.end(), s,
                                      [](double place, const WidthSample& sample) { return place < sample.s; });
  if (above == samples.begin()) return samples.front().width;
  if (above == samples.end()) return samples.back().width;
  const WidthSample &a = *(above - 1), &b = *above;
  return std::lerp(a.width, b.width, (s - a.s) / (b.s - a.s));
}

WidthFigures figuresOf(const WidthProfile& profile) {
  const auto& samples = profile.samples;
  WidthFigures figures{samples.front().width, samples.front().width, samples.front().width};
  double area = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    figures.least = std::min(figures.least, samples[i].width);
    figures.largest = std::max(figures.largest, samples[i].width);
    area += 0.5 * (samples[i].width + samples[i - 1].width) * (samples[i].s - samples[i - 1].s);
  }
  if (profile.length() > 0.0) figures.mean = area / profile.length();
  return figures;
}

WidthProfile reversed(const WidthProfile& profile) {
  WidthProfile other = profile;
  std::reverse(other.samples.begin(), other.samples.end());
  for (WidthSample& sample : other.samples) sample.s = profile.length() - sample.s;
  return other;
}

WidthProfile startedAt(const WidthProfile& profile, double s) {
  const double length = profile.length();
  if (!(s > 0.0 && s < length)) return profile;
  const double seam = profile.at(s);
  WidthProfile other{{{0.0, seam}}, profile.tolerance};
  for (const WidthSample& sample : profile.samples)
    if (sample.s > s) other.samples.push_back({sample.s - s, sample.width});
  // The old end is the old start: once only.
  for (std::size_t i = 1; i < profile.samples.size() && profile.samples[i].s < s; ++i)
    other.samples.push_back({profile.samples[i].s - s + length, profile.samples[i].width});
  other.samples.push_back({length, seam});
  return other;
}

WidthProfile scaled(const WidthProfile& profile, double scale) {
  WidthProfile other = profile;
  other.tolerance *= scale;
  for (WidthSample& sample : other.samples) sample = {sample.s * scale, sample.width * scale};
  return other;
}

bool isValid(const WidthProfile& profile) {
  const auto& samples = profile.samples;
  if (samples.size() < 2 || samples.front().s != 0.0 || !std::isfinite(profile.tolerance) || profile.tolerance < 0.0)
    return false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!std::isfinite(samples[i].s) || !std::isfinite(samples[i].width) || samples[i].width < 0.0) return false;
    if (i > 0 && !(samples[i].s > samples[i - 1].s)) return false;
  }
  return true;
}

}  // namespace batten
