// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/number_option.h"

#include <optional>

#include "core/base/number_text.h"
#include "core/base/shown_text.h"

namespace batten::cli {
namespace {

template <typename Number, typename Read>
CLI::Option* addRead(CLI::App& app, const std::string& name, const std::function<void(Number)>& set,
                     const NumberRange& range, const std::string& help, Read read) {
  const auto take = [=](const std::string& text) {
    const std::optional<Number> number = read(text);
    // NaN lies in no range.
    const bool isWithin = number && *number >= range.least && *number <= range.most;
    if (!isWithin) throw CLI::ValidationError(name + " takes " + range.what + ", not " + quotedText(text));
    set(*number);
  };
  return app.add_option_function<std::string>(name, take, help);
}

}  // namespace

CLI::Option* addNumber(CLI::App& app, const std::string& name, const std::function<void(double)>& set,
                       const NumberRange& range, const std::string& help) {
  return addRead<double>(app, name, set, range, help, numberFromText);
}

CLI::Option* addInteger(CLI::App& app, const std::string& name, const std::function<void(int)>& set,
                        const NumberRange& range, const std::string& help) {
  return addRead<int>(app, name, set, range, help, integerFromText);
}

}  // namespace batten::cli
