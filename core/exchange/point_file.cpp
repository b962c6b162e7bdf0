// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/point_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/conventions.h"
#include "core/base/json_text.h"
#include "core/base/number_text.h"
#include "core/curve/line_names.h"
#include "core/exchange/model/file_text.h"
#include "core/exchange/text/csv_writer.h"

namespace batten {
namespace {

using PointJson = nlohmann::ordered_json;

tl::unexpected<Error> noPoints(const std::string& what) {
  return fail(ErrorCode::BadParameter, "The points cannot be read: " + what + ".");
}

std::string lowered(std::string_view text) {
  std::string result(trimmed(text));
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// Whether the row is numbers with decimal commas parted by blanks, "1,5 2,5": every comma stands between two digits.
bool hasDecimalCommas(std::string_view row) {
  const auto isDigit = [&](std::size_t i) {
    return i < row.size() && std::isdigit(static_cast<unsigned char>(row[i])) != 0;
  };
  if (row.find(' ') == std::string_view::npos) return false;
  for (auto at = row.find(','); at != std::string_view::npos; at = row.find(',', at + 1)) {
    if (at == 0 || !isDigit(at - 1) || !isDigit(at + 1)) return false;
  }
  return true;
}

/// What parts the fields, by the first row that is read: semicolons, tabs, commas or blanks.
char separatorOf(std::string_view row) {
  for (const char separator : {';', '\t'}) {
    if (row.find(separator) != std::string_view::npos) return separator;
  }
  return row.find(',') != std::string_view::npos && !hasDecimalCommas(row) ? ',' : ' ';
}

/// Where the columns stand.
struct Columns {
  std::size_t x = 0, y = 1;
  std::optional<std::size_t> line, piece, along;  ///< Of Batten's own: the arc length along the piece.
};

class TableReader {
 public:
  explicit TableReader(const RunContext& context) : context_(context) {}

  Result<PointFile> read(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // of UTF-8, before the text
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    for (std::size_t row = 1; !text.empty(); ++row) {
      const auto end = text.find('\n');
      const std::string_view line = trimmed(text.substr(0, end));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      constexpr std::size_t kEvery = 4096;  // between two looks at whether the run was cancelled
      if (row % kEvery == 0 && context_.isCancelled()) return cancelled();
      if (line.starts_with('#')) {
        takeComment(line);
        continue;
      }
      if (line.empty()) {
        endLine();
        continue;
      }
      if (auto taken = takeRow(line, row); !taken) return fail(taken.error());
      isCut_ = columns_.piece && end == std::string_view::npos;
    }
    endLine();
    // Batten ends every row of its own files.
    if (isCut_) return noPoints("its last row is cut off: the file is incomplete");
    if (columns_.piece && statedRows_ && *statedRows_ != rows_) {
      out_.notes.push_back("the file states " + std::to_string(*statedRows_) + " rows but holds " +
                           std::to_string(rows_) + ": it may be incomplete");
    }
    return std::move(out_);
  }

 private:
  std::vector<std::string> fieldsOf(std::string_view line) {
    if (separator_ == 0) separator_ = separatorOf(line);
    if (separator_ == ',') return csvFields(line);
    std::vector<std::string> fields;
    while (!line.empty()) {
      const auto end = line.find(separator_);
      const std::string_view field = trimmed(line.substr(0, end));
      line.remove_prefix(end == std::string_view::npos ? line.size() : end + 1);
      if (separator_ != ' ' || !field.empty()) fields.emplace_back(field);
    }
    return fields;
  }
  std::optional<double> numberOf(std::string field) const {
    if (separator_ != ',') std::replace(field.begin(), field.end(), ',', '.');
    return numberFromText(field);
  }

  Result<void> takeRow(std::string_view line, std::size_t row) {
    const std::vector<std::string> fields = fieldsOf(line);
    if (isFirst_) width_ = fields.size();
    if (fields.size() < width_) {
      return noPoints("row " + std::to_string(row) + " holds " + std::to_string(fields.size()) + " of " +
                      std::to_string(width_) + " fields: the file is incomplete or damaged");
    }
    const std::size_t last = std::max(columns_.x, columns_.y);
    const auto x = fields.size() > last ? numberOf(fields[columns_.x]) : std::nullopt;
    const auto y = x ? numberOf(fields[columns_.y]) : std::nullopt;
    if (!y && isFirst_) {
      isFirst_ = false;
      return takeNames(fields, row);
    }
    isFirst_ = false;
    if (!y) return noPoints("row " + std::to_string(row) + " does not hold x and y as numbers");
    ++rows_;
    const std::string name = columns_.line && fields.size() > *columns_.line ? fields[*columns_.line] : std::string();
    const std::string piece =
        columns_.piece && fields.size() > *columns_.piece ? fields[*columns_.piece] : std::string();
    const auto along =
        columns_.along && fields.size() > *columns_.along ? numberOf(fields[*columns_.along]) : std::nullopt;
    // One line of the same name behind the other: its arc length begins anew.
    const bool isAnew = !pieces_.empty() &&
                        (pieces_.back() == piece ? along && along_ && *along <= *along_
                                                 : std::find(pieces_.begin(), pieces_.end(), piece) != pieces_.end());
    if (!line_.points.empty() && (name != line_.name || isAnew)) endLine();
    along_ = along;
    line_.name = name;
    const Vec2 at(*x, *y);
    const bool isAgain = !line_.points.empty() && line_.points.back() == at;
    if (pieces_.empty() || pieces_.back() != piece) {
      // A piece begins where the one before it ends, so its first row repeats the last one.
      const int corner = static_cast<int>(line_.points.size()) - (isAgain ? 1 : 0);
      if (!line_.points.empty() && (line_.corners.empty() || corner > line_.corners.back()))
        line_.corners.push_back(corner);
      pieces_.push_back(piece);
    }
    if (!isAgain) line_.points.push_back(at);
    return {};
  }

  Result<void> takeNames(const std::vector<std::string>& fields, std::size_t row) {
    std::optional<std::size_t> x, y;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::string name = lowered(fields[i]);
      if (name == "u_start") return noPoints("it holds coefficients of polynomials");
      const bool isAlone =
          name.size() == 1 || (name.size() > 1 && std::isalpha(static_cast<unsigned char>(name[1])) == 0);
      if (!x && isAlone && name[0] == 'x') x = i, takeUnit(name);
      if (!y && isAlone && name[0] == 'y') y = i;
      if (name == "piece") columns_.piece = i;
      if (name.starts_with("s_")) columns_.along = i;
      if (!columns_.line && (name == "curve" || name == "line" || name == "name")) columns_.line = i;
    }
    if (!x || !y) return noPoints("row " + std::to_string(row) + " holds neither numbers nor columns x and y");
    columns_.x = *x;
    columns_.y = *y;
    // Only beside the name of a line they are Batten's.
    if (!columns_.line) columns_.piece.reset();
    if (!columns_.piece) columns_.along.reset();
    return {};
  }
  /// "x_mm", "x [in]", "x (cm)".
  void takeUnit(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalpha(c) == 0; }, ' ');
    const std::string_view unit = trimmed(std::string_view(name).substr(1));
    out_.mmPerUnit = millimetresOfUnit(unit);
  }
  void endLine() {
    auto& points = line_.points;
    constexpr std::size_t kLeastLoop = 4;  // a triangle and its first point again
    if (points.size() >= kLeastLoop && points.front() == points.back()) {
      points.pop_back();
      line_.closed = true;
      std::erase_if(line_.corners, [&](int corner) { return corner >= std::ssize(points); });
      if (!line_.corners.empty() && line_.corners.front() != 0) line_.corners.insert(line_.corners.begin(), 0);
    }
    if (columns_.piece && line_.name.starts_with(kLineIdBegin) && line_.name.find(kSketchedIdEnd) != std::string::npos)
      line_.layer = kSketchedLayer;
    if (pieces_.size() == 1 && !pieces_.front().empty()) line_.name = pieces_.front();
    if (points.size() >= 2) {
      for (std::size_t part = 0; part < pieces_.size() && columns_.piece; ++part)
        out_.parts.push_back({out_.lines.size(), part, pieces_[part]});
      out_.lines.push_back(std::move(line_));
    } else if (!points.empty()) {
      ++out_.left;
    }
    pieces_.clear();
    along_.reset();
    line_ = {};
  }
  /// Batten states in a comment how many rows its file has.
  void takeComment(std::string_view comment) {
    const auto at = comment.find(kRowsStated);
    if (at == std::string_view::npos) return;
    std::string_view count = comment.substr(at + kRowsStated.size());
    count = count.substr(0, count.find_first_not_of("0123456789"));
    if (const auto rows = integerFromText(count)) statedRows_ = *rows;
  }

  const RunContext& context_;
  char separator_ = 0;
  bool isFirst_ = true, isCut_ = false;
  std::size_t width_ = 0;  ///< Fields of the first row.
  int rows_ = 0;
  std::optional<int> statedRows_;
  std::optional<double> along_;
  Columns columns_;
  std::vector<std::string> pieces_;  ///< Of the line that is read, by name.
  ImportedLine line_;
  PointFile out_;
};

bool isPair(const PointJson& json) {
  return json.is_array() && json.size() == 2 && json[0].is_number() && json[1].is_number();
}

Result<std::vector<Vec2>> pointsOf(const PointJson& list) {
  std::vector<Vec2> points;
  if (!list.is_array()) return noPoints("a line is not a list of points");
  for (const PointJson& pair : list) {
    if (!isPair(pair)) return noPoints("a point is not a pair of numbers");
    points.emplace_back(pair[0].get<double>(), pair[1].get<double>());
    if (!points.back().allFinite()) return noPoints("a number is not finite");
  }
  return points;
}

Result<void> addLine(const PointJson& json, PointFile& file) {
  ImportedLine line;
  const bool isNamed = json.is_object();
  if (isNamed && json.contains("name") && json["name"].is_string()) line.name = json["name"].get<std::string>();
  if (isNamed && json.contains("closed") && json["closed"].is_boolean()) line.closed = json["closed"].get<bool>();
  if (isNamed && !json.contains("points")) return noPoints("a line has no points");
  auto points = pointsOf(isNamed ? json["points"] : json);
  if (!points) return fail(points.error());
  constexpr std::size_t kLeastLoop = 4;  // a triangle and its first point again
  if (points->size() >= kLeastLoop && points->front() == points->back()) line.closed = true;
  if (line.closed && points->size() > 1 && points->front() == points->back()) points->pop_back();
  line.points = std::move(*points);
  if (line.points.size() < 2) {
    ++file.left;
  } else {
    file.lines.push_back(std::move(line));
  }
  return {};
}

}  // namespace

std::optional<double> millimetresOfUnit(std::string_view unit) {
  if (unit == "mm") return 1.0;
  if (unit == "cm") return 10.0;
  if (unit == "m") return 1000.0;
  if (unit == "in" || unit == "inch") return kMillimetresPerInch;
  return std::nullopt;
}

Result<PointFile> readPointTable(std::string_view text, const RunContext& context) {
  if (text.empty()) return noPoints("the file is empty");
  if (text.find('\0') != std::string_view::npos) return noPoints("the file is not text");
  auto file = TableReader(context).read(text);
  if (file && file->lines.empty()) return fail(ErrorCode::NoCurve, "There is no line of two or more points in it.");
  return file;
}

Result<PointFile> readPointJson(std::string_view text, const RunContext& context) {
  const auto json = parseJson(text, context);
  if (!json && json.error().code == ErrorCode::Cancelled) return cancelled();
  if (!json) return noPoints(json.error().message);
  PointFile file;
  try {
    const PointJson* lines = &*json;
    if (json->is_object()) {
      if (json->contains("unit")) {
        if (!(*json)["unit"].is_string()) return noPoints("its unit is not text");
        file.mmPerUnit = millimetresOfUnit((*json)["unit"].get<std::string>());
        if (!file.mmPerUnit) return noPoints("its unit is not mm, cm, m or in");
      }
      if (!json->contains("lines")) return noPoints("it has no \"lines\"");
      lines = &(*json)["lines"];
    }
    if (!lines->is_array()) return noPoints("it is no list of lines");
    if (!lines->empty() && isPair((*lines)[0])) {
      if (auto added = addLine(*lines, file); !added) return fail(added.error());
    } else {
      for (const PointJson& line : *lines) {
        if (auto added = addLine(line, file); !added) return fail(added.error());
      }
    }
  } catch (const PointJson::exception& e) {
    auto error = noPoints("it is not complete");
    error.value().detail = e.what();
    return error;
  }
  if (file.lines.empty()) return fail(ErrorCode::NoCurve, "There is no line of two or more points in it.");
  return file;
}

}  // namespace batten
