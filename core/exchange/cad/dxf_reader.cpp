// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/cad/dxf_reader.h"

#include <QString>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/angle.h"
#include "core/base/conventions.h"
#include "core/curve/knot_operations.h"

namespace batten {
namespace {

struct Tag {
  int code = 0;
  std::string_view value;
  std::size_t line = 0;
};
/// The tags of one entity, from its 0 to the next.
using Tags = std::vector<Tag>;

std::string_view trimmedLine(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

template <class Number>
std::optional<Number> numberOf(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

tl::unexpected<Error> damaged(std::size_t line, const std::string& what) {
  return fail(ErrorCode::BadParameter, "The DXF cannot be read: line " + std::to_string(line) + ": " + what + ".");
}

/// Text with \U+XXXX as UTF-8.
std::string plainText(std::string_view text) {
  QString result = QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
  for (qsizetype at = result.indexOf(QLatin1String("\\U+")); at >= 0;
       at = result.indexOf(QLatin1String("\\U+"), at + 1)) {
    bool isHex = false;
    const ushort unit = result.mid(at + 3, 4).toUShort(&isHex, 16);
    if (isHex) result.replace(at, 7, QChar(unit));
  }
  return result.toStdString();
}

/// Splits a file into its tags, pair of lines by pair.
class TagReader {
 public:
  explicit TagReader(std::string_view text) : rest_(text) {}

  /// The next tag, nothing at the end of the file. Comments come like any other.
  Result<std::optional<Tag>> next() {
    if (trimmedLine(rest_).empty()) return std::optional<Tag>();
    const std::size_t line = line_ + 1;
    const auto code = numberOf<int>(trimmedLine(takeLine()));
    if (!code) return damaged(line, "a group code was expected");
    if (rest_.empty()) return damaged(line_, "the file ends within an entry");
    return std::optional(Tag{*code, trimmedLine(takeLine()), line});
  }

 private:
  std::string_view takeLine() {
    const auto end = rest_.find('\n');
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    return line;
  }
  std::string_view rest_;
  std::size_t line_ = 0;
};

/// The numbers of one entity by group code.
class Entity {
 public:
  explicit Entity(const Tags& tags) : tags_(tags) {}

  std::size_t line() const { return tags_.front().line; }
  std::string_view type() const { return tags_.front().value; }
  std::string textOf(int code) const {
    const auto found = find(code);
    return found == tags_.end() ? std::string() : plainText(found->value);
  }
  /// The name that Batten wrote behind its mark; the texts of other programs are none.
  std::string name() const {
    constexpr int kApplication = 1001, kText = 1000;  // codes of groups
    const auto own = std::find_if(tags_.begin(), tags_.end(),
                                  [](const Tag& tag) { return tag.code == kApplication && tag.value == "BATTEN"; });
    return own != tags_.end() && std::next(own) != tags_.end() && std::next(own)->code == kText
               ? plainText(std::next(own)->value)
               : std::string();
  }
  /// The first number of the code; `absent` if there is none; nothing if it is no number.
  std::optional<double> real(int code, std::optional<double> absent = {}) const {
    const auto found = find(code);
    return found == tags_.end() ? absent : numberOf<double>(found->value);
  }
  std::optional<int> whole(int code, std::optional<int> absent = {}) const {
    const auto found = find(code);
    return found == tags_.end() ? absent : numberOf<int>(found->value);
  }
  /// All numbers of a code in order; absent if one is not a number.
  std::optional<std::vector<double>> allNumbers(int code) const {
    std::vector<double> values;
    for (const Tag& tag : tags_) {
      if (tag.code >= 1000) break;  // extended data
      if (tag.code != code) continue;
      const auto value = numberOf<double>(tag.value);
      if (!value) return std::nullopt;
      values.push_back(*value);
    }
    return values;
  }
  std::optional<Vec2> point(int code) const {
    const auto x = real(code), y = real(code + 10);
    return x && y ? std::optional(Vec2(*x, *y)) : std::nullopt;
  }
  const Tags& tags() const { return tags_; }
  /// Drawn on the back of the plane: x and angles are mirrored.
  bool isMirrored() const { return real(230, 1.0).value_or(1.0) < 0.0; }

 private:
  Tags::const_iterator find(int code) const {
    return std::find_if(tags_.begin(), tags_.end(), [&](const Tag& tag) { return tag.code == code; });
  }
  const Tags& tags_;
};

std::optional<CadShape> lineOf(const Entity& entity) {
  const auto from = entity.point(10), to = entity.point(11);
  if (!from || !to || *from == *to) return std::nullopt;
  return CadLine{*from, *to};
}

std::optional<CadShape> arcOf(const Entity& entity, bool whole) {
  const auto centre = entity.point(10);
  const auto radius = entity.real(40);
  if (!centre || !radius || !(*radius > 0.0)) return std::nullopt;
  if (whole) return CadArc{*centre, *radius, 0.0, 2.0 * std::numbers::pi};
  const auto start = entity.real(50), end = entity.real(51);
  if (!start || !end) return std::nullopt;
  const double turns = std::fmod(*end - *start, 360.0);
  const double sweep = turns > 0.0 ? turns : turns + 360.0;
  return CadArc{*centre, *radius, *start * kRadPerDeg, sweep * kRadPerDeg};
}

std::optional<CadShape> splineOf(const Entity& entity) {
  const auto degree = entity.whole(71);
  auto knots = entity.allNumbers(40), weights = entity.allNumbers(41);
  const auto x = entity.allNumbers(10), y = entity.allNumbers(20);
  if (!degree || !knots || !weights || !x || !y || x->size() != y->size() || x->empty()) return std::nullopt;
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < x->size(); ++i) points.emplace_back((*x)[i], (*y)[i]);
  auto made = NurbsCurve::make(*degree, std::move(*knots), std::move(points), std::move(*weights));
  if (!made) return std::nullopt;
  return std::move(*made);
}

/// An ellipse as a circle or arc seen from the side: an affine map of the rational quadratics.
std::optional<CadShape> ellipseOf(const Entity& entity) {
  const auto centre = entity.point(10), major = entity.point(11);
  const auto ratio = entity.real(40), start = entity.real(41, 0.0), end = entity.real(42, 2.0 * std::numbers::pi);
  if (!centre || !major || !ratio || !start || !end) return std::nullopt;
  if (!(major->norm() > 0.0) || !(*ratio > 0.0) || !(*ratio <= 1.0 + 1e-9)) return std::nullopt;
  constexpr double kFullTurn = 2.0 * std::numbers::pi;  // rad
  const double turns = std::fmod(*end - *start, kFullTurn);
  const auto unit = curveOf(CadArc{Vec2::Zero(), 1.0, *start, turns > 1e-12 ? turns : turns + kFullTurn});
  if (!unit) return std::nullopt;
  Eigen::Matrix2d axes;
  axes << major->x(), -*ratio * major->y(), major->y(), *ratio * major->x();
  return unit->mapped(axes, *centre);
}

std::optional<CadShape> lightPolylineOf(const Entity& entity) {
  CadPolyline line;
  const auto flags = entity.whole(70, 0);
  if (!flags) return std::nullopt;
  line.closed = (*flags & 1) != 0;
  std::optional<double> x;
  for (const Tag& tag : entity.tags()) {
    if (tag.code >= 1000) break;
    if (tag.code != 10 && tag.code != 20 && tag.code != 42) continue;
    const auto value = numberOf<double>(tag.value);
    if (!value) return std::nullopt;
    if (tag.code == 10) x = value;
    if (tag.code == 20 && x) line.vertices.push_back({Vec2(*x, *value)});
    if (tag.code == 42 && !line.vertices.empty()) line.vertices.back().bulge = *value;
  }
  if (line.vertices.size() < 2) return std::nullopt;
  return line;
}

std::optional<CadShape> shapeOf(const Entity& entity) {
  if (entity.isMirrored()) return std::nullopt;
  if (entity.type() == "LINE") return lineOf(entity);
  if (entity.type() == "ARC" || entity.type() == "CIRCLE") return arcOf(entity, entity.type() == "CIRCLE");
  if (entity.type() == "SPLINE") return splineOf(entity);
  if (entity.type() == "ELLIPSE") return ellipseOf(entity);
  if (entity.type() == "LWPOLYLINE") return lightPolylineOf(entity);
  return std::nullopt;
}

std::optional<double> millimetresOf(int insUnits) {
  switch (insUnits) {
    case 1:
      return kMillimetresPerInch;
    case 2:
      return 12.0 * kMillimetresPerInch;
    case 3:
      return 63360.0 * kMillimetresPerInch;  // mile
    case 4:
      return 1.0;
    case 5:
      return 10.0;
    case 6:
      return 1000.0;
    case 7:
      return 1e6;
    case 8:
      return 1e-6 * kMillimetresPerInch;
    case 9:
      return 1e-3 * kMillimetresPerInch;
    case 10:
      return 36.0 * kMillimetresPerInch;
    case 11:
      return 1e-7;
    case 12:
      return 1e-6;
    case 13:
      return 0.001;
    case 14:
      return 100.0;
    case 15:
      return 1e4;
    case 16:
      return 1e5;
    case 21:
      return 1200.0 / 3937.0 * 1000.0;  // foot of the surveyors of the USA
    default:
      return std::nullopt;
  }
}

class Reader {
 public:
  explicit Reader(std::string_view text) : tags_(text) {}

  Result<CadDrawing> read() {
    Tags entity;
    while (true) {
      auto tag = tags_.next();
      if (!tag) return fail(tag.error());
      if (!*tag || (*tag)->code == 0) {
        take(entity);
        entity.clear();
        if (*tag && (*tag)->value == "EOF") sawEnd_ = true;
        if (!*tag) break;
      }
      if ((*tag)->code == 999) {
        comment((*tag)->value);
        continue;
      }
      if (entity.empty() && (*tag)->code != 0) return damaged((*tag)->line, "it does not start like a DXF");
      entity.push_back(**tag);
    }
    if (!sawSection_) return damaged(1, "it is not a DXF");
    if (!sawEnd_) return fail(ErrorCode::BadParameter, "The DXF cannot be read: its end is missing. Export it again.");
    return std::move(drawing_);
  }

 private:
  void comment(std::string_view text) {
    if (text == "Batten, unit mm") drawing_.mmPerUnit = 1.0;
    if (text == "Batten, unit inch") drawing_.mmPerUnit = kMillimetresPerInch;
  }

  void header(const Tags& tags) {
    for (std::size_t i = 0; i + 1 < tags.size(); ++i) {
      if (tags[i].code != 9 || tags[i].value != "$INSUNITS") continue;
      if (const auto units = numberOf<int>(tags[i + 1].value)) drawing_.mmPerUnit = millimetresOf(*units);
    }
  }

  void take(const Tags& tags) {
    if (tags.empty()) return;
    const Entity entity(tags);
    const std::string_view type = entity.type();
    if (type == "SECTION") {
      section_ = entity.textOf(2);
      sawSection_ = true;
      if (section_ == "HEADER") header(tags);
      return;
    }
    if (type == "ENDSEC") {
      endPolyline();
      section_.clear();
    }
    if (section_ != "ENTITIES") return;
    if (type == "VERTEX" && polyline_) return vertex(entity);
    endPolyline();
    if (type == "POLYLINE") return beginPolyline(entity);
    if (type == "SEQEND" || type == "POINT" || type == "TEXT" || type == "MTEXT" || type == "VIEWPORT") return;
    push(entity, shapeOf(entity));
  }

  void push(const Entity& entity, std::optional<CadShape> shape) {
    if (!shape) {
      ++drawing_.left;
      return;
    }
    drawing_.entities.push_back({entity.name(), entity.textOf(8), std::move(*shape)});
  }

  void beginPolyline(const Entity& entity) {
    constexpr int kMeshes = 16 | 64;  // flags of polylines that are none
    const auto flags = entity.whole(70, 0);
    polyline_ = CadEntity{entity.name(), entity.textOf(8), CadPolyline{{}, flags && (*flags & 1) != 0}};
    polylineIsWrong_ = !flags || (*flags & kMeshes) != 0 || entity.isMirrored();
  }
  void vertex(const Entity& entity) {
    constexpr int kFrame = 16;  // a control point of a curve that the other vertices follow
    const auto at = entity.point(10);
    const auto bulge = entity.real(42, 0.0);
    const auto flags = entity.whole(70, 0);
    if (!at || !bulge || !flags) {
      polylineIsWrong_ = true;
      return;
    }
    if ((*flags & kFrame) == 0) std::get<CadPolyline>(polyline_->shape).vertices.push_back({*at, *bulge});
  }
  void endPolyline() {
    if (!polyline_) return;
    if (polylineIsWrong_ || std::get<CadPolyline>(polyline_->shape).vertices.size() < 2) {
      ++drawing_.left;
    } else {
      drawing_.entities.push_back(std::move(*polyline_));
    }
    polyline_.reset();
  }

  TagReader tags_;
  CadDrawing drawing_;
  std::string section_;
  std::optional<CadEntity> polyline_;
  bool polylineIsWrong_ = false, sawSection_ = false, sawEnd_ = false;
};

}  // namespace

Result<CadDrawing> readDxf(std::string_view text) {
  if (text.starts_with("AutoCAD Binary DXF"))
    return fail(ErrorCode::BadParameter, "This is a binary DXF. Save it as ASCII DXF.");
  return Reader(text).read();
}

}  // namespace batten
