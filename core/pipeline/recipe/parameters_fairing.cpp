// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/parameters_fairing.h"

#include "core/pipeline/recipe/parameter_builders.h"
#include "core/pipeline/recipe/profile_text.h"

namespace batten::table {
namespace {

/// The end condition as one choice: each step holds what the one before holds, and more.
template <class Field>
Parameter holdParameter(Words words, Field field) {
  return choice<EndHold>(StageId::Faired, std::move(words),
                         {{"position", "Position", {false, false}},
                          {"tangent", "Tangent", {true, false}},
                          {"curvature", "Tangent and curvature", {true, true}}},
                         field);
}

Parameter profileParameter() {
  Parameter p = described(StageId::Faired,
                          {"fairing.profile", "Drawn profile", "",
                           "Drawn target: pairs of arc length fraction (0 to 1) and curvature in 1/mm, such as "
                           "\"0:0.01 0.5:0.02 1:0.01\", joined by a smooth curve."},
                          ParameterType::Text);
  p.get = [](const Recipe& r) { return profileToText(r.fairing.profile); };
  p.set = [name = p.name](Recipe& r, std::string_view text) -> Result<void> {
    auto profile = profileFromText(text);
    if (!profile) return refuse(name, text, profile.error().message);
    r.fairing.profile = std::move(*profile);
    return {};
  };
  return p;
}

Parameter alphaParameter() {
  Parameter p = described(StageId::Faired,
                          {"fairing.alpha", "Alpha", "",
                           "Log-aesthetic target: the exponent for which radius^alpha is linear in arc length, -3 "
                           "to 6: -1 clothoid, 0 Nielsen's spiral, 1 logarithmic spiral, 2 involute; auto: best fit "
                           "of each span.",
                           true},
                          ParameterType::Text);
  p.get = [](const Recipe& r) { return r.fairing.alpha ? numberToText(*r.fairing.alpha) : std::string("auto"); };
  p.set = [name = p.name](Recipe& r, std::string_view text) -> Result<void> {
    const std::string_view word = trimmed(text);
    if (word == "auto") {
      r.fairing.alpha.reset();
      return {};
    }
    const auto value = numberFromText(word);
    if (!value || !(*value >= kLeastAlpha && *value <= kMostAlpha))
      return refuse(name, text, "it must be auto or a number from -3 to 6");
    r.fairing.alpha = *value;
    return {};
  };
  return p;
}

Parameter keepExtremaParameter() {
  Parameter p = described(StageId::Faired,
                          {"fairing.keep_extrema", "Extrema to keep", "",
                           "Monotone: number of curvature extrema to keep; 0 is monotone from end to end, fewest "
                           "(-1) keeps as few as the tolerance allows."},
                          ParameterType::Integer);
  setRange(p, {static_cast<double>(numberOf(KeptExtrema{})), 99.0, 1.0});
  p.minimumWord = "fewest";
  p.get = [](const Recipe& r) { return std::to_string(numberOf(r.fairing.keepExtrema)); };
  p.set = [name = p.name, least = p.minimum, most = p.maximum, expected = rangeText(p)](
              Recipe& r, std::string_view text) -> Result<void> {
    const auto value = integerFromText(text);
    if (!value || *value < least || *value > most) return refuse(name, text, expected);
    r.fairing.keepExtrema = keptExtremaOf(*value);
    return {};
  };
  return p;
}

void appendModeAndTarget(std::vector<Parameter>& table) {
  constexpr StageId kFaired = StageId::Faired;  // a short name for the entries below
  table.push_back(choice<FairingMode>(
      kFaired,
      {"fairing.mode", "Fairing", "",
       "None; towards a curvature profile; smooth: least variation of curvature within the tolerance; "
       "monotone curvature between few extrema; or without short waves."},
      {{"none", "None", FairingMode::None},
       {"target", "Target", FairingMode::Target},
       {"tolerance", "Smooth", FairingMode::Tolerance},
       {"monotone", "Monotone", FairingMode::Monotone},
       {"lowpass", "Low-pass", FairingMode::LowPass}},
      [](auto& r) -> auto& { return r.fairing.mode; }));
  table.push_back(choice<FairingTarget>(
      kFaired,
      {"fairing.target", "Target", "",
       "Degree of the curvature profile; auto is the recommended one, drawn the one in "
       "fairing.profile, log-aesthetic a power of the radius linear in arc length. A higher "
       "degree follows the sketch more closely."},
      {{"auto", "Recommended", FairingTarget::Recommended},
       {"1", "Degree 1", FairingTarget::Degree1},
       {"2", "Degree 2", FairingTarget::Degree2},
       {"3", "Degree 3", FairingTarget::Degree3},
       {"4", "Degree 4", FairingTarget::Degree4},
       {"5", "Degree 5", FairingTarget::Degree5},
       {"6", "Degree 6", FairingTarget::Degree6},
       {"drawn", "Drawn", FairingTarget::Drawn},
       {"log-aesthetic", "Log-aesthetic", FairingTarget::LogAesthetic}},
      [](auto& r) -> auto& { return r.fairing.target; }));
  table.push_back(choice<TargetChoice>(
      kFaired,
      {"fairing.choose", "Recommended target", "",
       "How the recommended target is chosen: the simplest one reached within the tolerance "
       "without added extrema, or the one with the highest similarity S, as in the papers; S "
       "mostly rises with the degree.",
       true},
      {{"simplest", "Simplest", TargetChoice::Simplest}, {"similarity", "Highest S (paper)", TargetChoice::Similarity}},
      [](auto& r) -> auto& { return r.fairing.targetChoice; }));
}

void appendToleranceAndMeans(std::vector<Parameter>& table) {
  constexpr StageId kFaired = StageId::Faired;  // a short name for the entries below
  table.push_back(real(
      kFaired,
      {"fairing.tolerance", "Tolerance", "mm",
       "Maximum distance of the faired curve from the sketched one. Larger: fairer, less faithful."},
      {0.001, kLargestToleranceMm, 0.01, 3, true}, [](auto& r) -> auto& { return r.fairing.toleranceMm; }));
  table.push_back(choice<TolerancePolicy>(
      kFaired,
      {"fairing.spend", "Use the tolerance", "",
       "Smooth: as needed removes only extrema that the line does not support; all of it smooths "
       "as far as the tolerance allows."},
      {{"needed", "As needed", TolerancePolicy::AsNeeded}, {"all", "All of it", TolerancePolicy::All}},
      [](auto& r) -> auto& { return r.fairing.tolerancePolicy; }));
  table.push_back(choice<FairingMeans>(
      kFaired,
      {"fairing.moves", "Move", "",
       "Target and low-pass: move all control points, or only change the edge lengths of a "
       "Bézier path; edge directions are kept."},
      {{"points", "Control points", FairingMeans::ControlPoints}, {"edges", "Edge lengths", FairingMeans::EdgeLengths}},
      [](auto& r) -> auto& { return r.fairing.means; }));
  table.push_back(profileParameter());
  table.push_back(alphaParameter());
  table.push_back(keepExtremaParameter());
  table.push_back(real(
      kFaired,
      {"fairing.lowpass", "Wavelength", "mm",
       "Low-pass: curvature waves of this length are halved, shorter ones removed. Larger is "
       "smoother."},
      {0.1, 10000.0, 0.1, 1, true}, [](auto& r) -> auto& { return r.fairing.lowPassMm; }));
}

void appendProfiles(std::vector<Parameter>& table) {
  constexpr StageId kFaired = StageId::Faired;  // a short name for the entries below
  table.push_back(choice<TargetSpans>(
      kFaired,
      {"fairing.spans", "Spans", "",
       "One polynomial between consecutive significant curvature extrema, or one for the whole "
       "curve, as in the papers. Radius profiles and edge lengths always have one."},
      {{"natural", "Natural", TargetSpans::Natural}, {"whole", "Whole curve", TargetSpans::Whole}},
      [](auto& r) -> auto& { return r.fairing.targets.spans; }));
  table.push_back(choice<TargetQuantity>(
      kFaired,
      {"fairing.quantity", "Profile of", "",
       "What the profile describes: curvature (also through inflections) or radius, as in the papers.", true},
      {{"curvature", "Curvature", TargetQuantity::Curvature}, {"radius", "Radius", TargetQuantity::Radius}},
      [](auto& r) -> auto& { return r.fairing.targets.quantity; }));
  table.push_back(boolean(
      kFaired,
      {"fairing.monotone", "Monotone profiles", "",
       "Makes the profiles monotone, so that they add no curvature extrema. Off: plain "
       "polynomials, as in the papers.",
       true},
      [](auto& r) -> auto& { return r.fairing.targets.monotone; }));
  table.push_back(integer(
      kFaired,
      {"fairing.samples", "Samples", "",
       "Number of sample points at which the curve is compared with the profile. Larger is slower.", true},
      {101, 2001, 20}, [](auto& r) -> auto& { return r.fairing.targets.samples; }));
  table.push_back(holdParameter(
      {"fairing.hold_start", "Hold at start", "", "What fairing holds fixed at the start of an open curve."},
      [](auto& r) -> auto& { return r.fairing.startHold; }));
  table.push_back(holdParameter(
      {"fairing.hold_end", "Hold at end", "", "What fairing holds fixed at the end of an open curve."},
      [](auto& r) -> auto& { return r.fairing.endHold; }));
}

}  // namespace

std::vector<Parameter> fairingParameters() {
  std::vector<Parameter> table;
  appendModeAndTarget(table);
  appendToleranceAndMeans(table);
  appendProfiles(table);
  return table;
}

}  // namespace batten::table
