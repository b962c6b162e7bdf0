// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/profile_text.h"

#include <algorithm>

#include "core/base/number_text.h"

namespace batten {

std::string profileToText(std::span<const ProfilePoint> profile) {
  if (profile.empty()) return "none";
  std::string text;
  for (const ProfilePoint& p : profile) {
    if (!text.empty()) text.push_back(' ');
    text.append(numberToText(p.fraction)).append(1, ':').append(numberToText(p.kappa));
  }
  return text;
}

Result<std::vector<ProfilePoint>> profileFromText(std::string_view text) {
  // end of a message
  constexpr const char* kExpected =
      "it must be pairs of arc length fraction and curvature such as \"0:0.01 1:0.02\", or none";
  constexpr std::string_view kBlank = " \t\n,;";  // between pairs
  std::vector<ProfilePoint> profile;
  if (trimmed(text) == "none") return profile;
  for (std::size_t at = text.find_first_not_of(kBlank); at < text.size(); at = text.find_first_not_of(kBlank, at)) {
    const std::size_t end = std::min(text.find_first_of(kBlank, at), text.size());
    const std::string_view pair = text.substr(at, end - at);
    const std::size_t colon = pair.find(':');
    if (colon == std::string_view::npos) return fail(ErrorCode::BadParameter, kExpected);
    const auto fraction = numberFromText(pair.substr(0, colon)), kappa = numberFromText(pair.substr(colon + 1));
    if (!fraction || !kappa) return fail(ErrorCode::BadParameter, kExpected);
    profile.push_back({*fraction, *kappa});
    at = end;
  }
  if (profile.empty()) return fail(ErrorCode::BadParameter, kExpected);
  if (const auto wrong = validateProfile(profile)) {
    std::string reason = wrong->message;
    if (!reason.empty() && reason.back() == '.') reason.pop_back();
    return fail(ErrorCode::BadParameter, reason);
  }
  return profile;
}

}  // namespace batten
