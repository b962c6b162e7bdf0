// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/cad/step_records.h"

#include <QString>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace batten {
namespace {

constexpr int kDeepestList = 32;                 // limit of input
constexpr std::size_t kMostValues = 24'000'000;  // 1 GB; a file of 64 MB has fewer

bool isStepBlank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
bool isStepDigit(char c) { return c >= '0' && c <= '9'; }
bool isStepLetter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || isStepDigit(c) || c == '-';
}

class StepScanner {
 public:
  StepScanner(std::string_view text, const RunContext& context) : text_(text), context_(context) {}

  Result<StepRecords> read() {
    skip();
    if (!text_.substr(at_).starts_with("ISO-10303-21")) return damaged("it does not start like STEP");
    const auto data = text_.find("DATA;", at_);
    if (data == std::string_view::npos) return damaged("it has no data");
    at_ = data + 5;
    while (true) {
      skip();
      if (at_ >= text_.size()) return fail(ErrorCode::BadParameter, kEndIsMissing);
      if (text_.substr(at_).starts_with("ENDSEC;")) return std::move(out_);
      if (!readInstance()) return problem_ ? fail(*problem_) : damaged("an entry was expected");
      constexpr std::size_t kEvery = 4096;  // between two looks at whether the run was cancelled
      if (out_.order.size() % kEvery == 0 && context_.isCancelled()) return cancelled();
    }
  }

 private:
  // an error
  static constexpr const char* kEndIsMissing = "The STEP file cannot be read: its end is missing. Export it again.";

  tl::unexpected<Error> damaged(const std::string& what) const {
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size())), '\n');
    return fail(ErrorCode::BadParameter,
                "The STEP file cannot be read: line " + std::to_string(line) + ": " + what + ".");
  }
  bool wrong(const std::string& what) {
    if (!problem_) problem_ = damaged(what).value();
    return false;
  }

  void skip() {
    while (at_ < text_.size()) {
      if (isStepBlank(text_[at_])) {
        ++at_;
      } else if (text_.substr(at_).starts_with("/*")) {
        const auto end = text_.find("*/", at_ + 2);
        at_ = end == std::string_view::npos ? text_.size() : end + 2;
      } else {
        return;
      }
    }
  }
  bool take(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  std::string_view word() {
    skip();
    const std::size_t begin = at_;
    while (at_ < text_.size() && isStepLetter(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  std::optional<std::uint64_t> id() {
    if (!take('#')) return std::nullopt;
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    constexpr std::uint64_t kMost = std::uint64_t{1} << 53;  // a reference is kept as a number
    if (error != std::errc() || value >= kMost) return std::nullopt;
    at_ = end - text_.data();
    return value;
  }

  /// "#12=LINE('',#13,#14);" or "#12=(A()B(1.));"
  bool readInstance() {
    const auto number = id();
    if (!number || !take('=')) return wrong("an entry was expected");
    StepInstance instance{static_cast<std::uint32_t>(out_.records.size()), 0};
    const bool isComplex = take('(');
    do {
      const std::string_view type = word();
      if (type.empty() || !take('(')) return wrong("an entry has no type");
      StepRecord record{type, 0, 0};
      if (!readList(record.first, record.count)) return wrong("the values of an entry are invalid");
      out_.records.push_back(record);
      ++instance.count;
    } while (isComplex && !take(')'));
    if (!take(';')) return wrong("an entry does not end");
    if (!out_.instances.emplace(*number, instance).second) return wrong("two entries have the same number");
    out_.order.push_back(*number);
    return true;
  }

  /// Values up to the closing bracket. Those of one list come to lie side by side, behind those of the lists in it.
  bool readList(std::uint32_t& first, std::uint32_t& count) {
    if (++depth_ > kDeepestList) return wrong("its lists are nested too deeply");
    const std::size_t begin = open_.size();
    if (!take(')')) {
      do {
        StepValue value;
        if (!readValue(value)) return false;
        open_.push_back(value);
        if (out_.lists.size() + open_.size() > kMostValues) return wrong("it is too large");
      } while (take(','));
      if (!take(')')) return wrong("a list does not end");
    }
    first = static_cast<std::uint32_t>(out_.lists.size());
    count = static_cast<std::uint32_t>(open_.size() - begin);
    out_.lists.insert(out_.lists.end(), open_.begin() + static_cast<std::ptrdiff_t>(begin), open_.end());
    open_.resize(begin);
    --depth_;
    return true;
  }

  bool readValue(StepValue& value) {
    skip();
    if (at_ >= text_.size()) return wrong("the file ends within an entry");
    const char c = text_[at_];
    if (c == '$' || c == '*') {
      ++at_;
      return true;
    }
    if (c == '\'') return readText(value);
    if (c == '"') return readBinary(value);
    if (c == '(') {
      ++at_;
      value.kind = StepValue::Kind::List;
      return readList(value.first, value.count);
    }
    if (c == '#') {
      const auto number = id();
      if (!number) return wrong("a reference is invalid");
      value.kind = StepValue::Kind::Reference;
      value.number = static_cast<double>(*number);
      return true;
    }
    if (c == '.') {
      ++at_;
      value.kind = StepValue::Kind::Word;
      value.text = word();
      return take('.') || wrong("a word does not end");
    }
    if (isStepDigit(c) || c == '-' || c == '+') return readNumber(value);
    value.text = word();
    if (value.text.empty() || !take('(')) return wrong("a value is invalid");
    value.kind = StepValue::Kind::List;
    return readList(value.first, value.count);
  }

  bool readText(StepValue& value) {
    const std::size_t begin = ++at_;
    while (true) {
      const auto end = text_.find('\'', at_);
      if (end == std::string_view::npos) return wrong("a text does not end");
      at_ = end + 1;
      if (at_ >= text_.size() || text_[at_] != '\'') {
        value.kind = StepValue::Kind::Text;
        value.text = text_.substr(begin, end - begin);
        return true;
      }
      ++at_;
    }
  }
  bool readBinary(StepValue& value) {
    const auto end = text_.find('"', at_ + 1);
    if (end == std::string_view::npos) return wrong("a value does not end");
    value.text = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return true;
  }
  bool readNumber(StepValue& value) {
    if (text_[at_] == '+') ++at_;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value.number);
    if (error != std::errc() || !std::isfinite(value.number)) return wrong("a number is invalid");
    value.kind = StepValue::Kind::Number;
    at_ = end - text_.data();
    return true;
  }

  std::string_view text_;
  const RunContext& context_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::vector<StepValue> open_;  ///< Of the lists that are being read.
  StepRecords out_;
  std::optional<Error> problem_;
};

}  // namespace

Result<StepRecords> readStepRecords(std::string_view text, const RunContext& context) {
  return StepScanner(text, context).read();
}

std::string stepText(std::string_view written) {
  QString text = QString::fromUtf8(written.data(), static_cast<qsizetype>(written.size()));
  text.replace(QLatin1String("''"), QLatin1String("'"));
  QString plain;
  for (qsizetype at = 0; at < text.size();) {
    bool isHex = false;
    if (text.mid(at, 3) == QLatin1String("\\X\\")) {
      const ushort letter = text.mid(at + 3, 2).toUShort(&isHex, 16);
      if (isHex) plain += QChar(letter), at += 5;
    } else if (text.mid(at, 4) == QLatin1String("\\X2\\")) {
      const qsizetype end = text.indexOf(QLatin1String("\\X0\\"), at);
      isHex = end > at;
      for (qsizetype k = at + 4; isHex && k + 4 <= end; k += 4) plain += QChar(text.mid(k, 4).toUShort(nullptr, 16));
      if (isHex) at = end + 4;
    }
    if (!isHex) plain += text[at++];
  }
  return plain.toStdString();
}

}  // namespace batten
