// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/cad/iges_records.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/base/number_text.h"

namespace batten {
namespace {

constexpr std::size_t kSectionColumn = 72;  // the letter of the section
constexpr std::size_t kDataColumns = 64;    // of a line of parameters
constexpr std::size_t kFieldColumns = 8;    // of a line of the directory
constexpr int kLongestString = 1 << 20;     // characters: limit of input

std::string_view fieldOf(std::string_view line, std::size_t index) {
  return line.substr(index * kFieldColumns, kFieldColumns);
}

/// A field of the directory: blank is 0.
std::optional<int> wholeOf(std::string_view field) {
  field = trimmed(field);
  return field.empty() ? std::optional(0) : integerFromText(field);
}

/// Splits parameters; strings are "4Htext" and may hold delimiters.
class ParameterSplitter {
 public:
  ParameterSplitter(char delimiter, char end) : delimiter_(delimiter), end_(end) {}

  /// The parameters up to the end of the record; nothing if it has none.
  std::optional<std::vector<std::string>> split(std::string_view text) const {
    std::vector<std::string> fields;
    while (true) {
      std::size_t length = 0;
      if (const auto string = stringAt(text)) {
        if (string->length > text.size() - string->begin) return std::nullopt;
        fields.emplace_back(text.substr(string->begin, string->length));
        length = string->begin + string->length;
      } else {
        length = std::min(text.find(delimiter_), text.find(end_));
        if (length == std::string_view::npos) return std::nullopt;
        fields.emplace_back(trimmed(text.substr(0, length)));
      }
      text.remove_prefix(length);
      while (text.starts_with(' ')) text.remove_prefix(1);
      if (text.empty()) return std::nullopt;
      const char mark = text.front();
      text.remove_prefix(1);
      if (mark == end_) return fields;
      if (mark != delimiter_) return std::nullopt;
    }
  }

 private:
  struct StringField {
    std::size_t begin = 0, length = 0;
  };
  /// Where the characters of a string begin and how many it says it has, be they there or not; nothing for a number.
  static std::optional<StringField> stringAt(std::string_view text) {
    std::size_t at = 0;
    while (at < text.size() && text[at] == ' ') ++at;
    std::size_t count = 0;
    const std::size_t digits = at;
    while (at < text.size() && text[at] >= '0' && text[at] <= '9' && count < kLongestString)
      count = 10 * count + (text[at++] - '0');
    if (at == digits || at >= text.size() || text[at] != 'H') return std::nullopt;
    return StringField{at + 1, count};
  }
  char delimiter_, end_;
};

/// "1H,,1H;,…": the two marks come first, as strings, or are left out.
Result<void> readGlobal(const std::string& text, IgesRecords& records) {
  std::string_view rest = text;
  const auto mark = [&](char& value) {
    if (rest.starts_with("1H") && rest.size() > 2) {
      value = rest[2];
      rest.remove_prefix(3);
    }
    if (!rest.empty() && rest.front() == records.delimiter) rest.remove_prefix(1);
  };
  mark(records.delimiter);
  mark(records.end);
  const auto fields = ParameterSplitter(records.delimiter, records.end).split(rest);
  if (!fields) return igesDamaged(1, "the global section does not end");
  records.global = *fields;
  return {};
}

Result<void> addEntry(std::string_view first, std::string_view second, std::size_t line, IgesRecords& records) {
  IgesDirectoryEntry entry;
  entry.line = line;
  int matrix = 0;
  const std::array<std::pair<std::string_view, int*>, 7> fields{{{fieldOf(first, 0), &entry.type},
                                                                 {fieldOf(first, 1), &entry.parameterLine},
                                                                 {fieldOf(first, 4), &entry.level},
                                                                 {fieldOf(first, 6), &matrix},
                                                                 {fieldOf(first, 8), &entry.status},
                                                                 {fieldOf(second, 3), &entry.parameterLines},
                                                                 {fieldOf(second, 4), &entry.form}}};
  for (const auto& [field, value] : fields) {
    const auto number = wholeOf(field);
    if (!number) return igesDamaged(line, "an entry of the directory is not a number");
    *value = *number;
  }
  if (matrix != 0) entry.matrix = matrix;
  entry.label = trimmed(fieldOf(second, 7));
  records.entries.push_back(std::move(entry));
  return {};
}

}  // namespace

tl::unexpected<Error> igesDamaged(std::size_t line, const std::string& what) {
  return fail(ErrorCode::BadParameter,
              "The IGES file cannot be read: line " + std::to_string(line) + ": " + what + ".");
}

std::optional<double> igesNumber(std::string_view field) {
  field = trimmed(field);
  if (field.empty()) return 0.0;
  std::array<char, 64> buffer;
  if (field.size() > buffer.size()) return std::nullopt;
  if (field.front() == '+') field.remove_prefix(1);
  std::transform(field.begin(), field.end(), buffer.begin(), [](char c) { return c == 'D' || c == 'd' ? 'E' : c; });
  const char* const end = buffer.data() + field.size();
  double value = 0.0;
  const auto read = std::from_chars(buffer.data(), end, value);
  return read.ec == std::errc() && read.ptr == end && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

Result<IgesRecords> readIgesRecords(std::string_view text) {
  IgesRecords records;
  std::string global;
  std::string_view pending;  // the first line of a directory entry
  std::size_t number = 0;
  bool sawStart = false, sawEnd = false;
  while (!text.empty() && !sawEnd) {
    const auto lineEnd = text.find('\n');
    std::string_view line = text.substr(0, lineEnd);
    text.remove_prefix(lineEnd == std::string_view::npos ? text.size() : lineEnd + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++number;
    if (trimmed(line).empty()) continue;
    if (line.size() <= kSectionColumn) return igesDamaged(number, "it is shorter than a line of IGES");
    switch (line[kSectionColumn]) {
      case 'S':
        sawStart = true;
        break;
      case 'G':
        global += line.substr(0, kSectionColumn);
        break;
      case 'D':
        if (pending.empty()) {
          pending = line;
        } else {
          if (auto added = addEntry(pending, line, number - 1, records); !added) return fail(added.error());
          pending = {};
        }
        break;
      case 'P':
        records.data.push_back(line.substr(0, kDataColumns));
        break;
      case 'T':
        sawEnd = true;
        break;
      default:
        return igesDamaged(number, "it belongs to no section");
    }
    if (!sawStart && !sawEnd) return igesDamaged(number, "it does not start like IGES");
  }
  if (!sawEnd)
    return fail(ErrorCode::BadParameter, "The IGES file cannot be read: its end is missing. Export it again.");
  if (auto read = readGlobal(global, records); !read) return fail(read.error());
  return records;
}

Result<std::vector<std::string>> parametersOf(const IgesRecords& records, const IgesDirectoryEntry& entry,
                                              std::size_t& charactersLeft) {
  const auto lines = static_cast<std::ptrdiff_t>(records.data.size());
  const std::ptrdiff_t first = entry.parameterLine - 1, last = first + std::max(entry.parameterLines, 1);
  if (first < 0 || last > lines) return igesDamaged(entry.line, "its parameters are missing");
  std::string text;
  for (std::ptrdiff_t i = first; i < last; ++i) {
    const std::string_view line = records.data[i];
    if (line.size() > charactersLeft) return igesDamaged(entry.line, "several entries overlap");
    charactersLeft -= line.size();
    text += line;
  }
  auto fields = ParameterSplitter(records.delimiter, records.end).split(text);
  if (!fields) return igesDamaged(entry.line, "its parameters do not end");
  return std::move(*fields);
}

}  // namespace batten
