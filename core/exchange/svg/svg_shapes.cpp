// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/svg/svg_shapes.h"

#include <Eigen/LU>
#include <QByteArray>
#include <QXmlStreamReader>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>

#include "core/base/angle.h"
#include "core/base/conventions.h"
#include "core/base/number_text.h"
#include "core/curve/knot_operations.h"
#include "core/exchange/model/cad_shape.h"
#include "core/exchange/svg/svg_path_data.h"
#include "core/exchange/svg/svg_writer.h"

namespace batten {
namespace {

std::string withoutBlanks(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t' || c == '\n'; });
  return text;
}

constexpr double kPxPerInch = 96.0;        // of CSS
constexpr int kDeepestElement = 256;       // limit of input
constexpr double kSmoothRad = kRadPerDeg;  // a turn that is no corner

struct Affine {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Vec2 offset = Vec2::Zero();
  /// What is drawn within: first `inner`, then this.
  Affine over(const Affine& inner) const { return {linear * inner.linear, linear * inner.offset + offset}; }
};

/// One of "translate(…)", "rotate(…)" …; nothing if it is none.
std::optional<Affine> affineOf(std::string_view name, const std::vector<double>& n) {
  Affine one;
  const std::size_t count = n.size();
  if (name == "matrix" && count == 6) {
    one.linear << n[0], n[2], n[1], n[3];
    one.offset = {n[4], n[5]};
  } else if (name == "translate" && (count == 1 || count == 2)) {
    one.offset = {n[0], count == 2 ? n[1] : 0.0};
  } else if (name == "scale" && (count == 1 || count == 2)) {
    one.linear = Vec2(n[0], count == 2 ? n[1] : n[0]).asDiagonal();
  } else if (name == "rotate" && (count == 1 || count == 3)) {
    const double a = n[0] * kRadPerDeg;
    one.linear << std::cos(a), -std::sin(a), std::sin(a), std::cos(a);
    if (count == 3) one.offset = Vec2(n[1], n[2]) - one.linear * Vec2(n[1], n[2]);
  } else if (name == "skewX" && count == 1) {
    one.linear(0, 1) = std::tan(n[0] * kRadPerDeg);
  } else if (name == "skewY" && count == 1) {
    one.linear(1, 0) = std::tan(n[0] * kRadPerDeg);
  } else {
    return std::nullopt;
  }
  return one;
}

std::optional<Affine> transformOf(std::string_view text) {
  Affine all;
  while (!(text = trimmed(text)).empty()) {
    if (text.front() == ',') {
      text.remove_prefix(1);
      continue;
    }
    const auto open = text.find('('), close = text.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) return std::nullopt;
    std::string_view inside = text.substr(open + 1, close - open - 1);
    std::vector<double> numbers;
    while (const auto value = takeSvgNumber(inside)) numbers.push_back(*value);
    const auto one = affineOf(trimmed(text.substr(0, open)), numbers);
    if (!one || !trimmed(inside).empty()) return std::nullopt;
    all = all.over(*one);
    text.remove_prefix(close + 1);
  }
  return all;
}

/// A length in mm; nothing for percents, which depend on a window, and for what is none.
std::optional<double> lengthMm(std::string_view text) {
  const auto value = takeSvgNumber(text);
  if (!value) return std::nullopt;
  const std::string_view unit = trimmed(text);
  const double perPx = kMillimetresPerInch / kPxPerInch;
  if (unit.empty() || unit == "px") return *value * perPx;
  if (unit == "mm") return *value;
  if (unit == "cm") return *value * 10.0;
  if (unit == "in") return *value * kMillimetresPerInch;
  if (unit == "pt") return *value * kMillimetresPerInch / 72.0;
  if (unit == "pc") return *value * kMillimetresPerInch / 6.0;
  if (unit == "Q") return *value / 4.0;
  return std::nullopt;
}

class ShapesReader {
 public:
  ShapesReader(std::string_view text, const RunContext& context)
      : xml_(QByteArray::fromRawData(text.data(), static_cast<qsizetype>(text.size()))), context_(context) {}

  Result<SvgShapes> read() {
    for (std::size_t count = 0; !xml_.atEnd(); ++count) {
      constexpr std::size_t kEvery = 1024;  // between two looks at whether the run was cancelled
      if (count % kEvery == 0 && context_.isCancelled()) return cancelled();
      const auto token = xml_.readNext();
      if (token == QXmlStreamReader::EndElement && !frames_.empty()) frames_.pop_back();
      if (token != QXmlStreamReader::StartElement) continue;
      if (frames_.size() >= kDeepestElement) return damaged("its elements are nested more than 256 deep");
      if (auto taken = begin(); !taken) return fail(taken.error());
    }
    if (xml_.hasError()) return damaged("it is damaged (" + xml_.errorString().toStdString() + ")");
    if (!sawSvg_) return damaged("it is not an SVG");
    return std::move(out_);
  }

 private:
  static tl::unexpected<Error> damaged(const std::string& what) {
    return fail(ErrorCode::BadParameter, "The SVG cannot be read: " + what + ".");
  }
  std::string text(const char* name) const {
    return xml_.attributes().value(QLatin1String(name)).toString().toStdString();
  }
  /// A length in user units; absent: `otherwise`.
  double number(const char* name, double otherwise = 0.0) const {
    const std::string whole = text(name);
    std::string_view rest = whole;
    const auto value = takeSvgNumber(rest);
    if (!value) return otherwise;
    const bool isPlain = trimmed(rest).empty();
    return isPlain ? *value : lengthMm(whole).value_or(otherwise) * kPxPerInch / kMillimetresPerInch;
  }

  Result<void> begin() {
    const std::string name = xml_.name().toString().toStdString();
    Frame frame = frames_.empty() ? Frame{} : frames_.back();
    static const std::set<std::string> kHidden = {"defs",           "clipPath", "mask",  "symbol", "marker",
                                                  "pattern",        "metadata", "style", "script", "linearGradient",
                                                  "radialGradient", "filter",   "glyph", "font",   "foreignObject"};
    frame.isHidden = frame.isHidden || kHidden.contains(name) || text("display") == "none" ||
                     withoutBlanks(text("style")).find("display:none") != std::string::npos;
    // The picture of a stroke: the curve is the path in its middle.
    frame.isHidden = frame.isHidden || !text((std::string("batten:") + kWidthOf).c_str()).empty();
    if (name == "svg" && !sawSvg_) {
      sawSvg_ = true;
      frame.toMm = pageTransform();
    }
    const auto own = transformOf(text("transform"));
    if (!own && !frame.isHidden) {
      ++out_.left;
      frame.isHidden = true;
    }
    if (own) frame.toMm = frame.toMm.over(*own);
    if (name == "g" && text("inkscape:groupmode") == "layer") frame.layer = text("inkscape:label");
    frames_.push_back(frame);
    if (sawSvg_ && !frame.isHidden) takeShape(name, frame.toMm);
    return {};
  }

  /// From user units to mm, y up; the page's lower left corner is the origin.
  Affine pageTransform() {
    const auto width = lengthMm(text("width")), height = lengthMm(text("height"));
    const std::string box = text("viewBox");
    std::string_view rest = box;
    std::vector<double> view;
    while (const auto value = takeSvgNumber(rest)) view.push_back(*value);
    if (view.size() != 4 || !(view[2] > 0.0) || !(view[3] > 0.0)) view.clear();
    const double perPx = kMillimetresPerInch / kPxPerInch;
    out_.hasSize = width.has_value() && height.has_value();
    Vec2 scale = Vec2::Constant(perPx);
    Vec2 page(width.value_or(0.0), height.value_or(0.0));
    if (!view.empty()) {
      if (width && *width > 0.0) scale.x() = *width / view[2];
      if (height && *height > 0.0) scale.y() = *height / view[3];
      if (!width || !height) scale = Vec2::Constant(width ? scale.x() : height ? scale.y() : perPx);
      if (!height) page.y() = view[3] * scale.y();
      if (!width) page.x() = view[2] * scale.x();
    }
    Vec2 shift = Vec2::Zero();
    if (!view.empty()) {
      if (!text("preserveAspectRatio").starts_with("none")) {
        scale = Vec2::Constant(scale.minCoeff());
        shift = 0.5 * (page - Vec2(view[2], view[3]).cwiseProduct(scale));  // in the middle, as it is by itself
      }
      shift -= Vec2(view[0], view[1]).cwiseProduct(scale);
    }
    out_.mmPerUnit = scale.minCoeff();
    Affine flipped;
    flipped.linear = Vec2(scale.x(), -scale.y()).asDiagonal();
    flipped.offset = {shift.x(), page.y() - shift.y()};
    return flipped;
  }

  void takeShape(const std::string& name, const Affine& toMm) {
    static const std::set<std::string> kLeft = {"text", "image", "use"};
    if (kLeft.contains(name)) ++out_.left;
    std::optional<std::vector<SvgSubpath>> parts;
    if (name == "path") parts = readSvgPath(text("d"));
    if (name == "polyline" || name == "polygon") parts = readSvgPath(polylineData(name == "polygon"));
    if (name == "line") parts = readSvgPath(lineData());
    if (name == "rect") parts = readSvgPath(rectangleData());
    if (name == "circle" || name == "ellipse") parts = roundShape(name == "circle");
    static const std::set<std::string> kShapes = {"path", "polyline", "polygon", "line", "rect", "circle", "ellipse"};
    if (!kShapes.contains(name)) return;
    if (!parts || !(std::abs(toMm.linear.determinant()) > 0.0)) {
      ++out_.left;
      return;
    }
    for (const SvgSubpath& part : *parts) addLine(part, toMm);
  }

  std::string polylineData(bool closed) const {
    const std::string points = text("points");
    return points.empty() ? std::string() : "M" + points + (closed ? "Z" : "");
  }
  std::string lineData() const {
    return "M" + numberToText(number("x1")) + "," + numberToText(number("y1")) + "L" + numberToText(number("x2")) +
           "," + numberToText(number("y2"));
  }
  std::string rectangleData() const {
    const double x = number("x"), y = number("y"), w = number("width"), h = number("height");
    if (!(w > 0.0) || !(h > 0.0)) return {};
    const bool hasX = !text("rx").empty(), hasY = !text("ry").empty();
    const double rx = std::min(0.5 * w, hasX ? number("rx") : hasY ? number("ry") : 0.0);
    const double ry = std::min(0.5 * h, hasY ? number("ry") : hasX ? number("rx") : 0.0);
    const auto at = [](double a, double b) { return numberToText(a) + "," + numberToText(b) + " "; };
    if (!(rx > 0.0) || !(ry > 0.0)) return "M" + at(x, y) + "L" + at(x + w, y) + at(x + w, y + h) + at(x, y + h) + "Z";
    const std::string bend = "A" + at(rx, ry) + "0 0 1 ";
    return "M" + at(x + rx, y) + "L" + at(x + w - rx, y) + bend + at(x + w, y + ry) + "L" + at(x + w, y + h - ry) +
           bend + at(x + w - rx, y + h) + "L" + at(x + rx, y + h) + bend + at(x, y + h - ry) + "L" + at(x, y + ry) +
           bend + at(x + rx, y) + "Z";
  }
  std::optional<std::vector<SvgSubpath>> roundShape(bool isCircle) const {
    const Vec2 centre(number("cx"), number("cy"));
    const Vec2 radii = isCircle ? Vec2::Constant(number("r")) : Vec2(number("rx"), number("ry"));
    if (!(radii.minCoeff() > 0.0)) return std::vector<SvgSubpath>();
    const auto unit = curveOf(CadArc{Vec2::Zero(), 1.0, 0.0, kFullTurnRad});
    if (!unit) return std::nullopt;
    return std::vector<SvgSubpath>{{{unit->mapped(radii.asDiagonal(), centre)}, true}};
  }

  /// Segments that go on in the same direction become one curve; the others stay apart.
  void addLine(const SvgSubpath& part, const Affine& toMm) {
    std::vector<NurbsCurve> segments;
    for (const NurbsCurve& segment : part.segments) segments.push_back(segment.mapped(toMm.linear, toMm.offset));
    ImportedLine line;
    const std::string label = text("inkscape:label");  // as the user called it; ids are mostly made up
    line.name = label.empty() ? text("id") : label;
    line.layer = frames_.back().layer;
    line.closed = part.closed;
    for (std::size_t i = 0; i < segments.size();) {
      std::size_t end = i + 1;
      while (end < segments.size() && continues(segments[end - 1], segments[end])) ++end;
      const std::span<const NurbsCurve> run(segments.data() + i, end - i);
      constexpr double kGap = 1e-9;  // of the size: rounding
      auto joined = run.size() == 1 ? Result<NurbsCurve>(run.front()) : joinAtCorners(run, kGap * sizeOf(run));
      if (joined) {
        line.curves.push_back({std::move(*joined)});
      } else {
        for (const NurbsCurve& segment : run) line.curves.push_back({segment});
      }
      i = end;
    }
    if (!line.curves.empty()) out_.lines.push_back(std::move(line));
  }
  static double sizeOf(std::span<const NurbsCurve> run) {
    double size = 0.0;
    for (const NurbsCurve& curve : run) {
      for (const Vec2& p : curve.controlPoints()) size = std::max(size, p.cwiseAbs().maxCoeff());
    }
    return size;
  }
  static bool continues(const NurbsCurve& before, const NurbsCurve& behind) {
    if (before.degree() != 3 || behind.degree() != 3 || before.isRational() || behind.isRational()) return false;
    const Vec2 in = before.derivatives(before.end(), 1)[1], out = behind.derivatives(behind.start(), 1)[1];
    return in.dot(out) > 0.0 && std::abs(cross(in, out)) <= kSmoothRad * in.norm() * out.norm();
  }

  struct Frame {
    Affine toMm;
    bool isHidden = false;
    std::string layer;  ///< Of Inkscape: a group that says so.
  };
  QXmlStreamReader xml_;
  const RunContext& context_;
  std::vector<Frame> frames_;
  bool sawSvg_ = false;
  SvgShapes out_;
};

}  // namespace

Result<SvgShapes> readSvgShapes(std::string_view text, const RunContext& context) {
  return ShapesReader(text, context).read();
}

}  // namespace batten
