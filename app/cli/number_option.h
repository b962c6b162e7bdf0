// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace batten::cli {

/// What an option takes, and how its error says so: "a number from 1 to 100000".
struct NumberRange {
  double least = 0.0, most = 0.0;
  std::string what;
};

/// Adds an option of a number, in the notation of recipe and --set: no hexadecimal, no empty text, no NaN, which
/// CLI11 would take by itself.
CLI::Option* addNumber(CLI::App&, const std::string& name, const std::function<void(double)>& set, const NumberRange&,
                       const std::string& help);
/// The same of a whole number.
CLI::Option* addInteger(CLI::App&, const std::string& name, const std::function<void(int)>& set, const NumberRange&,
                        const std::string& help);

}  // namespace batten::cli
