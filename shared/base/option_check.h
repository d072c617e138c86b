// Checks of what a program is told by its options, before it does anything: for CLI::Option::check(). Each
// says what is wrong, or nothing.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

/// The text is a finite number within the bounds: no "nan", which no comparison refuses, and no sign that a
/// number without one would take for a very large one.
struct NumberWithin {
  double least = 0.0;
  double most = 0.0;
  bool whole = false;

  std::string operator()(const std::string& text) const;
  /// For the help.
  std::string says() const;
};

/// A whole number within the bounds. `whole_most`: those of 64 bits, as far as a double counts exactly.
NumberWithin whole_within(double least, double most);
inline constexpr double whole_most = 9007199254740992.0;

/// Adds the check to a CLI::Option.
template <typename Option>
Option* bounded(Option* option, const NumberWithin& check) {
  return option->check(check, check.says());
}

/// Refuses an option or an argument without a word in it: a mistake, as of a script whose variable is not
/// set.
template <typename App>
void refuse_empty(App& app) {
  for (auto* option : app.get_options())
    if (option->get_expected_min() > 0 && option->get_type_size() > 0)
      option->check([](const std::string& value) { return value.empty() ? "must not be empty" : ""; }, "");
}

/// What is wrong with a number that is none, or without an end; nothing with any other text.
std::string check_finite(const std::string& text);

/// Refuses "nan" and "inf" for all options of numbers with fractions: comparisons, as those of CLI11's
/// checks, pass nan.
template <typename App>
void refuse_not_finite(App& app) {
  for (auto* option : app.get_options())
    if (option->get_type_name().find("FLOAT") != std::string::npos) option->check(check_finite, "");
}

/// A file can be written where the path says. What is there stays, and nothing is left behind.
Result<void> can_be_written(const std::string& path);

/// The same, for an option.
std::string check_writable(const std::string& path);
/// For an option of a program that renames its finished file to the path: a device or a pipe stays.
std::string check_replaceable(const std::string& path);

}  // namespace scree
