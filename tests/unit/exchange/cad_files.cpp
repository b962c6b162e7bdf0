// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/exchange/cad_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>

namespace batten::test {
namespace {

std::vector<std::string> splitAt(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0;
  bool quoted = false;
  for (const char c : text) {
    if (c == '\'') quoted = !quoted;
    if (!quoted && c == '(') ++depth;
    if (!quoted && c == ')') --depth;
    if (c == separator && depth == 0 && !quoted)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

double real(std::string text) {
  std::replace(text.begin(), text.end(), 'D', 'E');
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  double value = std::nan("");
  in >> value;
  return value;
}

std::string inner(const std::string& text) {  // between the outer parentheses
  return text.substr(text.find('(') + 1, text.rfind(')') - text.find('(') - 1);
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \n\r\t"), last = text.find_last_not_of(" \n\r\t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

FoundCurve igesSpline(const std::vector<std::string>& p) {
  FoundCurve curve;
  const std::size_t upper = std::stoul(p[1]), degree = std::stoul(p[2]);
  curve.degree = static_cast<int>(degree);
  EXPECT_EQ(p[3], "1") << "in a plane";
  curve.closedFlag = p[4] == "1";
  const bool polynomial = p[5] == "1";
  curve.periodicFlag = p[6] == "1";
  std::size_t at = 7;
  for (std::size_t i = 0; i < upper + degree + 2; ++i) curve.knots.push_back(real(p[at++]));
  for (std::size_t i = 0; i <= upper; ++i) curve.weights.push_back(real(p[at++]));
  for (std::size_t i = 0; i <= upper; ++i, at += 3) {
    curve.points.emplace_back(real(p[at]), real(p[at + 1]));
    EXPECT_EQ(real(p[at + 2]), 0.0);
  }
  EXPECT_EQ(real(p[at]), curve.knots.front());
  EXPECT_EQ(real(p[at + 1]), curve.knots.back());
  EXPECT_EQ(real(p[at + 4]), 1.0) << "normal";
  if (polynomial) {
    for (const double w : curve.weights) EXPECT_EQ(w, 1.0);
    curve.weights.clear();
  }
  return curve;
}

}  // namespace

FoundFile parseIges(const std::string& text) {
  FoundFile file;
  std::istringstream lines(text);
  std::string global, parameters;
  int records = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    EXPECT_EQ(line.size(), 80u) << line;
    if (line.size() < 80) continue;
    if (line[72] == 'G') global += line.substr(0, 72);
    if (line[72] == 'P') parameters += trimmed(line.substr(0, 64));
    if (line[72] == 'P') {
      EXPECT_EQ(std::stoi(line.substr(73)), ++records);
    }
  }
  const std::vector<std::string> g = splitAt(global, ',');
  file.unit = g.size() > 15 ? trimmed(g[14]) : "";
  for (const std::string& entry : splitAt(parameters, ';')) {
    const std::vector<std::string> p = splitAt(entry, ',');
    FoundCurve curve;
    if (p[0] == "126") {
      curve = igesSpline(p);
    } else if (p[0] == "110") {
      curve.kind = FoundCurve::Kind::Line;
      curve.points = {{real(p[1]), real(p[2])}, {real(p[4]), real(p[5])}};
    } else if (p[0] == "100") {
      curve.kind = FoundCurve::Kind::Arc;
      curve.points = {{real(p[2]), real(p[3])}, {real(p[4]), real(p[5])}, {real(p[6]), real(p[7])}};
    } else {
      if (p[0] == "406" && p.size() == 3 && !file.curves.empty())
        file.curves.back().name = p[2].substr(p[2].find('H') + 1);
      continue;
    }
    file.curves.push_back(std::move(curve));
  }
  return file;
}

namespace {

class StepText {
 public:
  explicit StepText(const std::string& text) {
    std::string flat;
    for (const char c : text) flat += c == '\n' || c == '\r' ? ' ' : c;
    static const std::regex instance(R"(#(\d+) = (.*))");
    for (const std::string& statement : splitAt(flat.substr(flat.find("DATA;") + 5), ';')) {
      std::smatch match;
      const std::string line = trimmed(statement);
      if (std::regex_match(line, match, instance)) instances_[std::stoi(match[1])] = trimmed(match[2]);
    }
  }
  /// Name of the entity and its fields; those of a reference.
  std::string typeOf(const std::string& reference) const {
    const std::string text = at(reference);
    return trimmed(text.substr(0, text.find('(')));
  }
  std::vector<std::string> fieldsOf(const std::string& reference) const {
    std::vector<std::string> fields = splitAt(inner(at(reference)), ',');
    for (std::string& field : fields) field = trimmed(field);
    return fields;
  }
  std::string at(const std::string& reference) const {
    const auto found = instances_.find(std::stoi(trimmed(reference).substr(1)));
    return found == instances_.end() ? "" : found->second;
  }
  Vec2 point(const std::string& reference) const {
    const auto xyz = splitAt(inner(fieldsOf(reference)[1]), ',');
    EXPECT_EQ(real(xyz[2]), 0.0);
    return {real(xyz[0]), real(xyz[1])};
  }
  const std::map<int, std::string>& all() const { return instances_; }

 private:
  std::map<int, std::string> instances_;
};

std::string stepName(const std::string& field) { return field.substr(1, field.size() - 2); }

double parameterOf(const std::string& trim) {  // (PARAMETER_VALUE(x))
  return real(inner(inner(trim)));
}

void readKnots(const std::string& times, const std::string& values, FoundCurve& curve) {
  const auto counts = splitAt(inner(times), ','), knots = splitAt(inner(values), ',');
  ASSERT_EQ(counts.size(), knots.size());
  for (std::size_t i = 0; i < knots.size(); ++i)
    curve.knots.insert(curve.knots.end(), std::stoul(counts[i]), real(knots[i]));
}

FoundCurve stepCurve(const StepText& step, const std::string& reference) {
  FoundCurve curve;
  const std::string type = step.typeOf(reference);
  if (type.empty()) {  // a complex instance: a rational spline
    const std::string text = step.at(reference);
    const auto part = [&](const std::string& name) {
      const auto begin = text.find(name + "(");
      int depth = 0;
      for (std::size_t i = begin + name.size(); i < text.size(); ++i) {
        if (text[i] == '(') ++depth;
        if (text[i] == ')' && --depth == 0) return splitAt(inner(text.substr(begin, i - begin + 1)), ',');
      }
      return std::vector<std::string>();
    };
    const auto spline = part("B_SPLINE_CURVE");
    curve.degree = std::stoi(spline[0]);
    for (const auto& p : splitAt(inner(spline[1]), ',')) curve.points.push_back(step.point(p));
    const auto knots = part("B_SPLINE_CURVE_WITH_KNOTS");
    readKnots(knots[0], knots[1], curve);
    for (const auto& w : splitAt(inner(part("RATIONAL_B_SPLINE_CURVE")[0]), ',')) curve.weights.push_back(real(w));
    return curve;
  }
  const auto fields = step.fieldsOf(reference);
  curve.name = stepName(fields[0]);
  if (type == "B_SPLINE_CURVE_WITH_KNOTS") {
    curve.degree = std::stoi(fields[1]);
    for (const auto& p : splitAt(inner(fields[2]), ',')) curve.points.push_back(step.point(p));
    curve.closedFlag = fields[4] != ".F.";
    readKnots(fields[6], fields[7], curve);
    return curve;
  }
  const bool trimmedCurve = type == "TRIMMED_CURVE";
  const std::string basis = trimmedCurve ? fields[1] : reference;
  const auto b = step.fieldsOf(basis);
  const double from = trimmedCurve ? parameterOf(fields[2]) : 0.0,
               to = trimmedCurve ? parameterOf(fields[3]) : 2 * M_PI;
  if (step.typeOf(basis) == "LINE") {
    const auto vector = step.fieldsOf(b[2]);
    const auto ratios = splitAt(inner(step.fieldsOf(vector[1])[1]), ',');
    const Vec2 unit(real(ratios[0]), real(ratios[1])), origin = step.point(b[1]);
    curve.kind = FoundCurve::Kind::Line;
    curve.points = {origin + from * real(vector[2]) * unit, origin + to * real(vector[2]) * unit};
  } else if (step.typeOf(basis) == "CIRCLE") {
    const Vec2 centre = step.point(step.fieldsOf(b[1])[1]);
    const double radius = real(b[2]);
    curve.kind = FoundCurve::Kind::Arc;
    curve.points = {centre, centre + radius * Vec2(std::cos(from), std::sin(from)),
                    centre + radius * Vec2(std::cos(to), std::sin(to))};
  } else {
    ADD_FAILURE() << "unexpected entity " << type;
  }
  return curve;
}

}  // namespace

FoundFile parseStep(const std::string& text) {
  const StepText step(text);
  FoundFile file;
  for (const auto& [number, instance] : step.all()) {
    if (instance.find("CONVERSION_BASED_UNIT('INCH'") != std::string::npos) file.unit = "INCH";
    if (instance.find("SI_UNIT(.MILLI.,.METRE.)") != std::string::npos && file.unit.empty()) file.unit = "MM";
    if (!instance.starts_with("GEOMETRIC_CURVE_SET")) continue;
    const auto fields = step.fieldsOf("#" + std::to_string(number));
    for (const auto& element : splitAt(inner(fields[1]), ',')) file.curves.push_back(stepCurve(step, element));
  }
  return file;
}

}  // namespace batten::test
