// The members of a palette that are numbers or choices, by the names that files and commands know them by:
// one table of each, with bounds and units. Files, commands, validation and pages iterate over the tables.
//
// A dotted name leads into a group: "bearing.pressed". Numbers have the units of palette.h. Any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/base/result.h"
#include "shared/material/palette.h"

namespace scree {

/// Characters of a material's name. Above: refused, for lists and buttons show whole names.
inline constexpr size_t material_name_max = 32;

/// Refuses names but those of 1 to material_name_max characters of [a-z0-9_] that begin with a letter: they
/// stand in files, commands and messages without quotes.
Result<void> check_material_name(std::string_view name);

/// A number of `Owner`: a material's row, or the ground's rows.
template <typename Owner>
struct NumberMember {
  std::string_view name;
  float least;
  float most;
  std::string_view unit;  ///< empty: it has none
  std::string_view help;  ///< what it is, in a few words
  float (*get)(const Owner&);
  void (*put)(Owner&, float);  ///< of zeros, the positive one: equal palettes have equal bytes
};
using MaterialNumber = NumberMember<MaterialRow>;
using GroundNumber = NumberMember<GroundRows>;

/// A member of a row that is one of a few kinds. The value of a kind is its number.
struct MaterialChoice {
  std::string_view name;
  std::span<const std::string_view> values;
  std::string_view help;
  uint8_t (*get)(const MaterialRow&);
  void (*put)(MaterialRow&, uint8_t);
};

std::span<const MaterialNumber> material_numbers();
std::span<const GroundNumber> ground_numbers();
std::span<const MaterialChoice> material_choices();

/// Names of all numbers of a row, and of all choices, in the order of the tables.
std::vector<std::string> number_names();
std::vector<std::string> choice_names();

/// "density 30000 is over 25000 kg/m3". Refuses also what is not finite. Compares as float, which a row
/// keeps.
Result<void> check_number(const MaterialNumber& member, double value);
Result<void> check_number(const GroundNumber& member, double value);

/// Nothing where no number has the name.
std::optional<float> number_of(const MaterialRow& row, std::string_view member);
/// Refuses an unknown name, with the near one, and a value beyond the member's bounds. The row stays then.
Result<void> set_number(MaterialRow& row, std::string_view member, double value);

/// The same of choices, by the names of their values.
std::optional<std::string_view> choice_of(const MaterialRow& row, std::string_view member);
Result<void> set_choice(MaterialRow& row, std::string_view member, std::string_view value);

}  // namespace scree
