// The options that drawing methods have of their own, such as the cells of a grid. A method declares each as
// a value; panels, command lines and settings' files are made from the declarations, and hand the chosen
// values to every method (DrawMethod::set_options). No GL.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace scree {

/// A choice among a few values. Options are static: what refers to one may keep its address and its texts.
struct DrawOption {
  /// The method's name, a dash, and its own: "grid-scale". On a command line it follows "--"; files have it
  /// with underscores, the environment in capitals after "SCREE_".
  std::string_view name;
  std::string_view label;                   ///< on a panel
  std::string_view unit;                    ///< on a panel, after a number
  std::string_view help;                    ///< one line, for people
  std::span<const int> values;              ///< that it may have, in order
  std::span<const std::string_view> names;  ///< of the values; empty: they are numbers
  int usual = 0;                            ///< one of the values

  bool is_number() const { return names.empty(); }
};

/// A value of the option, as people write it.
std::string text_of(const DrawOption& option, int value);
/// Nothing if the option has no such value.
std::optional<int> value_of(const DrawOption& option, std::string_view text);
/// The place among the option's values of one of them.
size_t index_of(const DrawOption& option, int value);
/// All values, for a message: "uniform or growing".
std::string describe_values(const DrawOption& option);

/// The name with underscores, as a key in a file.
std::string key_of(const DrawOption& option);
/// The name of the environment's variable.
std::string variable_of(const DrawOption& option);

/// The values of all options, the usual ones unless they are set.
class DrawOptionValues {
 public:
  int of(const DrawOption& option) const;
  /// `value` is one of the option's.
  void set(const DrawOption& option, int value);

  bool operator==(const DrawOptionValues&) const = default;

 private:
  std::map<std::string_view, int> unusual_;  ///< by the option's name
};

}  // namespace scree
