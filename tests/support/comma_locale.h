// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <clocale>
#include <locale>
#include <string>

namespace batten::test {

/// Numbers as in a language with commas for points and points between thousands, whether or not the machine knows one.
class Continental : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Streams write 1.234,5 while it lives, on every machine; where a language with commas is installed, printf() and
/// strtod() follow it too.
class CommaLocale {
 public:
  CommaLocale()
      : c_(std::setlocale(LC_ALL, nullptr)),
        streams_(std::locale::global(std::locale(std::locale::classic(), new Continental))) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "fr_FR.utf8", "nl_NL.UTF-8"})
      if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  ~CommaLocale() {
    std::locale::global(streams_);
    std::setlocale(LC_ALL, c_.c_str());
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

 private:
  std::string c_;
  std::locale streams_;
};

}  // namespace batten::test
