// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/svg_paths.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <optional>
#include <string_view>

namespace batten::test {
namespace {

using Map = Eigen::Transform<double, 2, Eigen::Affine>;

/// Numbers of a list with commas, blanks, or nothing between them.
class NumberReader {
 public:
  explicit NumberReader(std::string_view text) : text_(text) {}
  void skipBlanks() {
    while (at_ < text_.size() && (std::isspace(static_cast<unsigned char>(text_[at_])) || text_[at_] == ',')) ++at_;
  }
  bool atEnd() {
    skipBlanks();
    return at_ >= text_.size();
  }
  char peek() {
    skipBlanks();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  char take() { return text_[at_++]; }
  double number() {
    skipBlanks();
    const std::string rest(text_.substr(at_, 40));
    char* end = nullptr;
    const double value = std::strtod(rest.c_str(), &end);
    if (end == rest.c_str()) {
      at_ = text_.size();  // not a number: give up on the rest
      return 0.0;
    }
    at_ += end - rest.c_str();
    return value;
  }
  bool isNumber() {
    const char c = peek();
    return std::isdigit(static_cast<unsigned char>(c)) || c == '-' || c == '+' || c == '.';
  }
  bool flag() {  // of an arc: one digit, possibly with nothing after it
    skipBlanks();
    return at_ < text_.size() && text_[at_++] == '1';
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

std::optional<std::string> attribute(std::string_view tag, const std::string& name) {
  for (std::size_t from = 0; (from = tag.find(name, from)) != std::string_view::npos; ++from) {
    if (from == 0 || !std::isspace(static_cast<unsigned char>(tag[from - 1]))) continue;
    std::size_t at = from + name.size();
    while (at < tag.size() && std::isspace(static_cast<unsigned char>(tag[at]))) ++at;
    if (at >= tag.size() || tag[at] != '=') continue;
    const std::size_t quote = tag.find_first_of("\"'", at);
    if (quote == std::string_view::npos) return std::nullopt;
    const std::size_t end = tag.find(tag[quote], quote + 1);
    if (end == std::string_view::npos) return std::nullopt;
    return std::string(tag.substr(quote + 1, end - quote - 1));
  }
  return std::nullopt;
}

double lengthPx(const std::string& text) {
  char* unit = nullptr;
  const double value = std::strtod(text.c_str(), &unit);
  return std::strncmp(unit, "pt", 2) == 0 ? value * 4.0 / 3.0 : value;
}

Map transformOf(const std::string& text) {
  Map map = Map::Identity();
  std::size_t at = 0;
  while (true) {
    const std::size_t open = text.find('(', at), close = text.find(')', at);
    if (open == std::string::npos || close == std::string::npos) return map;
    const std::string name = text.substr(at, open - at);
    NumberReader in(std::string_view(text).substr(open + 1, close - open - 1));
    std::vector<double> v;
    while (!in.atEnd()) v.push_back(in.number());
    Map step = Map::Identity();
    if (name.find("matrix") != std::string::npos && v.size() == 6) {
      step.matrix() << v[0], v[2], v[4], v[1], v[3], v[5], 0, 0, 1;
    } else if (name.find("translate") != std::string::npos && !v.empty()) {
      step.translate(Vec2(v[0], v.size() > 1 ? v[1] : 0.0));
    } else if (name.find("scale") != std::string::npos && !v.empty()) {
      step.scale(Vec2(v[0], v.size() > 1 ? v[1] : v[0]));
    } else if (name.find("rotate") != std::string::npos && !v.empty()) {
      const Vec2 about = v.size() > 2 ? Vec2(v[1], v[2]) : Vec2(Vec2::Zero());
      step.translate(about).rotate(v[0] * std::numbers::pi / 180.0).translate(-about);
    }
    map = map * step;
    at = close + 1;
  }
}

SvgCubic lineTo(const Vec2& a, const Vec2& b) { return {{a, a + (b - a) / 3.0, a + (b - a) * (2.0 / 3.0), b}}; }

struct EllipticArc {
  Vec2 from, to;
  double rx, ry, rotationDeg;
  bool large, sweep;
};

/// As cubics of at most a quarter turn (SVG 1.1, appendix F.6).
void addArc(std::vector<SvgCubic>& out, const EllipticArc& arc) {
  const auto& [from, to, givenRx, givenRy, rotationDeg, large, sweep] = arc;
  double rx = std::abs(givenRx), ry = std::abs(givenRy);
  if (!(rx > 0.0) || !(ry > 0.0)) return out.push_back(lineTo(from, to));
  const Eigen::Rotation2Dd turn(rotationDeg * std::numbers::pi / 180.0);
  const Vec2 half = turn.inverse() * Vec2(0.5 * (from - to));
  const double over = std::pow(half.x() / rx, 2) + std::pow(half.y() / ry, 2);
  if (over > 1.0) rx *= std::sqrt(over), ry *= std::sqrt(over);
  const double rest = std::pow(half.x() / rx, 2) + std::pow(half.y() / ry, 2);
  if (!(rest > 0.0)) return;
  const double side = (large == sweep ? -1.0 : 1.0) * std::sqrt(std::max(0.0, 1.0 / rest - 1.0));
  const Vec2 inner = side * Vec2(rx * half.y() / ry, -ry * half.x() / rx);
  const Vec2 centre = turn * inner + 0.5 * (from + to);
  const auto angle = [&](const Vec2& p) { return std::atan2(p.y() / ry, p.x() / rx); };
  const double start = angle(half - inner);
  double span = angle(-half - inner) - start;
  if (sweep && span < 0.0) span += 2.0 * std::numbers::pi;
  if (!sweep && span > 0.0) span -= 2.0 * std::numbers::pi;
  const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(span) / (0.5 * std::numbers::pi) - 1e-9)));
  const double step = span / parts, handle = 4.0 / 3.0 * std::tan(0.25 * step);
  for (int i = 0; i < parts; ++i) {
    const double a = start + i * step, b = a + step;
    const Vec2 ends[2] = {{std::cos(a), std::sin(a)}, {std::cos(b), std::sin(b)}};
    const Vec2 ways[2] = {{-std::sin(a), std::cos(a)}, {-std::sin(b), std::cos(b)}};
    const Vec2 local[4] = {ends[0], ends[0] + handle * ways[0], ends[1] - handle * ways[1], ends[1]};
    SvgCubic cubic;
    for (int k = 0; k < 4; ++k) cubic.p[k] = centre + turn * Vec2(rx * local[k].x(), ry * local[k].y());
    out.push_back(cubic);
  }
}

class PathReader {
 public:
  PathReader(const std::string& data, std::string group) : in_(data), group_(std::move(group)) {}

  std::vector<SvgPath> read() {
    char command = '\0';
    while (!in_.atEnd()) {
      if (!in_.isNumber()) {
        command = in_.take();
      } else if (command == '\0') {
        break;
      }
      step(command);
      // Further pairs after a move are lines.
      if (command == 'M') command = 'L';
      if (command == 'm') command = 'l';
      if (command == 'z' || command == 'Z') command = '\0';
    }
    finish(false);
    return std::move(paths_);
  }

 private:
  Vec2 point(bool relative) {
    const double x = in_.number(), y = in_.number();
    return relative ? Vec2(here_ + Vec2(x, y)) : Vec2(x, y);
  }
  void add(const SvgCubic& cubic) {
    segments_.push_back(cubic);
    here_ = cubic.p[3];
  }
  void finish(bool closed) {
    if (closed && !segments_.empty() && (here_ - start_).norm() > 1e-6) add(lineTo(here_, start_));
    if (!segments_.empty()) paths_.push_back({group_, std::move(segments_), closed});
    segments_.clear();
    here_ = start_;
  }
  void step(char command) {
    const bool relative = std::islower(static_cast<unsigned char>(command)) != 0;
    const Vec2 from = here_;
    switch (std::tolower(static_cast<unsigned char>(command))) {
      case 'm': {
        const Vec2 to = point(relative);
        finish(false);
        here_ = start_ = to;
        break;
      }
      case 'l':
        add(lineTo(from, point(relative)));
        break;
      case 'h':
        add(lineTo(from, Vec2(in_.number() + (relative ? from.x() : 0.0), from.y())));
        break;
      case 'v':
        add(lineTo(from, Vec2(from.x(), in_.number() + (relative ? from.y() : 0.0))));
        break;
      case 'c':
      case 's': {
        const bool smooth = std::tolower(static_cast<unsigned char>(command)) == 's';
        const Vec2 mirrored = segments_.empty() ? from : Vec2(2.0 * from - segments_.back().p[2]);
        const Vec2 a = smooth ? mirrored : point(relative), b = point(relative), to = point(relative);
        add({{from, a, b, to}});
        break;
      }
      case 'q': {
        const Vec2 a = point(relative), to = point(relative);
        add({{from, from + (a - from) * (2.0 / 3.0), to + (a - to) * (2.0 / 3.0), to}});
        break;
      }
      case 'a': {
        const double rx = in_.number(), ry = in_.number(), turn = in_.number();
        const bool large = in_.flag(), sweep = in_.flag();
        const Vec2 to = point(relative);
        addArc(segments_, {from, to, rx, ry, turn, large, sweep});
        here_ = to;
        break;
      }
      case 'z':
        finish(true);
        break;
      default:
        while (in_.isNumber()) in_.number();  // a command not known here
    }
  }

  NumberReader in_;
  std::string group_;
  Vec2 here_ = Vec2::Zero(), start_ = Vec2::Zero();
  std::vector<SvgCubic> segments_;
  std::vector<SvgPath> paths_;
};

struct Level {
  Map map = Map::Identity();
  std::string group;
};

Map pictureMap(std::string_view tag) {
  const auto box = attribute(tag, "viewBox"), width = attribute(tag, "width"), height = attribute(tag, "height");
  Map map = Map::Identity();
  if (!box || !width || !height) return map;
  NumberReader in(*box);
  const double x = in.number(), y = in.number(), w = in.number(), h = in.number();
  if (!(w > 0.0) || !(h > 0.0)) return map;
  map.scale(Vec2(lengthPx(*width) / w, lengthPx(*height) / h)).translate(Vec2(-x, -y));
  return map;
}

}  // namespace

Vec2 SvgCubic::at(double t) const {
  const double u = 1.0 - t;
  return u * u * u * p[0] + 3.0 * u * u * t * p[1] + 3.0 * u * t * t * p[2] + t * t * t * p[3];
}
Vec2 SvgCubic::derivative(double t) const {
  const double u = 1.0 - t;
  return 3.0 * (u * u * (p[1] - p[0]) + 2.0 * u * t * (p[2] - p[1]) + t * t * (p[3] - p[2]));
}
Vec2 SvgCubic::second(double t) const {
  return 6.0 * ((1.0 - t) * (p[2] - 2.0 * p[1] + p[0]) + t * (p[3] - 2.0 * p[2] + p[1]));
}

double svgWidthPx(const std::string& text) {
  const std::size_t open = text.find("<svg"), close = text.find('>', std::min(open, text.size()));
  if (close == std::string::npos) return 0.0;
  const auto width = attribute(std::string_view(text).substr(open, close - open), "width");
  return width ? lengthPx(*width) : 0.0;
}

std::vector<SvgPath> readSvgPaths(const std::string& text) {
  std::vector<SvgPath> all;
  std::vector<Level> levels(1);
  for (std::size_t open = 0; (open = text.find('<', open)) != std::string::npos;) {
    if (text.compare(open, 4, "<!--") == 0) {
      const std::size_t end = text.find("-->", open);
      if (end == std::string::npos) break;
      open = end;
      continue;
    }
    const std::size_t close = text.find('>', open);
    if (close == std::string::npos) break;
    const std::string_view tag = std::string_view(text).substr(open + 1, close - open - 1);
    open = close;
    const std::string_view name = tag.substr(0, tag.find_first_of(" \t\r\n/"));
    if (tag.starts_with("/g")) {
      if (levels.size() > 1) levels.pop_back();
      continue;
    }
    Level level = levels.back();
    if (name == "svg") level.map = level.map * pictureMap(tag);
    if (const auto map = attribute(tag, "transform")) level.map = level.map * transformOf(*map);
    if (name == "g") {
      if (const auto id = attribute(tag, "id")) level.group = *id;
      if (!tag.ends_with("/")) levels.push_back(level);
    } else if (name == "svg") {
      levels.back() = level;
    } else if (name == "path") {
      for (SvgPath& path : PathReader(attribute(tag, "d").value_or(""), level.group).read()) {
        for (SvgCubic& cubic : path.segments)
          for (Vec2& p : cubic.p) p = level.map * p;
        all.push_back(std::move(path));
      }
    }
  }
  return all;
}

}  // namespace batten::test
