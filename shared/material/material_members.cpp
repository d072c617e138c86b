#include "shared/material/material_members.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <type_traits>
#include <utility>

#include "shared/base/near_name.h"

namespace scree {

namespace {

/// The member at the end of a path of pointers to members and of indices.
template <auto First, auto... Rest>
constexpr auto& member_at(auto& owner) {
  if constexpr (sizeof...(Rest) > 0)
    return member_at<Rest...>(member_at<First>(owner));
  else if constexpr (std::is_integral_v<decltype(First)>)
    return owner[First];
  else
    return owner.*First;
}

template <auto... Path>
struct NumberAt {
  template <typename Owner>
  static float get(const Owner& owner) {
    return member_at<Path...>(owner);
  }
  template <typename Owner>
  static void put(Owner& owner, float value) {
    member_at<Path...>(owner) = value + 0.0F;  // no negative zero, which has other bytes
  }
};

struct Bounds {
  float least;
  float most;
};
constexpr Bounds share{0.0F, 1.0F};
constexpr Bounds pressure{0.0F, 1.0e10F};

/// A row of a table of numbers.
template <typename Owner, auto... Path>
constexpr NumberMember<Owner> number(std::string_view name, Bounds bounds, std::string_view unit,
                                     std::string_view help) {
  return {name,
          bounds.least,
          bounds.most,
          unit,
          help,
          NumberAt<Path...>::template get<Owner>,
          NumberAt<Path...>::template put<Owner>};
}
template <auto... Path>
constexpr auto of_row = number<MaterialRow, Path...>;

constexpr std::array numbers{
    of_row<&MaterialRow::density_kg_m3>("density", {10.0F, 25000.0F}, "kg/m3", "mass of a volume"),
    of_row<&MaterialRow::friction>("friction", {0.0F, 2.0F}, "",
                                   "coefficient against itself; of two materials, the geometric mean counts"),
    of_row<&MaterialRow::restitution>(
        "restitution", {0.0F, 0.95F}, "",
        "share of the speed that a blow gives back; for two materials, the root of the product"),
    of_row<&MaterialRow::strength_m_s>("strength", {0.1F, 1000.0F}, "m/s",
                                       "change of speed in one contact that breaks a piece of 1 m³"),
    of_row<&MaterialRow::strength_by_size>(
        "strength_by_size", share, "",
        "how much sooner large pieces break: the strength falls by the volume to this power"),
    of_row<&MaterialRow::seed_density>("seed_density", {0.1F, 8.0F}, "",
                                       "seeds of a break, relative to rock: how finely it crumbles"),
    of_row<&MaterialRow::dent_resistance_j_m3>("dent_resistance", {1.0e3F, 1.0e11F}, "J/m3",
                                               "energy that presses a volume out of the ground"),
    of_row<&MaterialRow::bearing, &Bearing::pressed_pa>("bearing.pressed", {1.0F, pressure.most}, "Pa",
                                                        "pressure that a section carries from above"),
    of_row<&MaterialRow::bearing, &Bearing::hanging_pa>("bearing.hanging", pressure, "Pa",
                                                        "tension that it carries from below"),
    of_row<&MaterialRow::bearing, &Bearing::sideways_pa>("bearing.sideways", pressure, "Pa",
                                                         "shear that it carries from the side"),
    of_row<&MaterialRow::bearing, &Bearing::bending_pa>(
        "bearing.bending", pressure, "Pa",
        "tension at its edge, from the load's leverage, at which it breaks"),
    of_row<&MaterialRow::sound, &MaterialSound::pitch>("sound.pitch", {0.05F, 20.0F}, "",
                                                       "pitch, relative to rock of the same size"),
    of_row<&MaterialRow::sound, &MaterialSound::damping_s>("sound.damping_s", {0.005F, 5.0F}, "s",
                                                           "time in which a cube of 1 m falls to 1/e"),
    of_row<&MaterialRow::sound, &MaterialSound::noise>("sound.noise", share, "", "share of noise in a blow"),
    of_row<&MaterialRow::look, &MaterialLook::colour, 0>("look.colour.red", share, "", "linear, not sRGB"),
    of_row<&MaterialRow::look, &MaterialLook::colour, 1>("look.colour.green", share, "", "likewise"),
    of_row<&MaterialRow::look, &MaterialLook::colour, 2>("look.colour.blue", share, "", "likewise"),
    of_row<&MaterialRow::look, &MaterialLook::variation>("look.variation", share, "",
                                                         "of its brightness from place to place"),
    of_row<&MaterialRow::look, &MaterialLook::roughness>("look.roughness", share, "", "0: a mirror; 1: dull"),
    of_row<&MaterialRow::look, &MaterialLook::pattern_m>("look.pattern_m", {0.01F, 100.0F}, "m",
                                                         "scale of the pattern"),
    of_row<&MaterialRow::look, &MaterialLook::image_m>("look.image_m", {0.05F, 100.0F}, "m",
                                                       "side of the place that an image covers"),
};

constexpr Bounds layer_depth{0.0F, 50.0F};
constexpr std::array numbers_of_ground{
    number<GroundRows, &GroundRows::soil_depth_m>("soil_depth_m", layer_depth, "m",
                                                  "how deep the soil reaches below the undisturbed surface"),
    number<GroundRows, &GroundRows::cap_depth_m>("cap_depth_m", layer_depth, "m", "likewise, of the cap"),
};

template <auto... Path>
constexpr MaterialChoice choice(std::string_view name, std::string_view help) {
  using Kind = std::remove_cvref_t<decltype(member_at<Path...>(std::declval<MaterialRow&>()))>;
  return {name, kind_names<Kind>, help,
          [](const MaterialRow& row) { return static_cast<uint8_t>(member_at<Path...>(row)); },
          [](MaterialRow& row, uint8_t value) { member_at<Path...>(row) = static_cast<Kind>(value); }};
}

constexpr std::array choices{
    choice<&MaterialRow::breaks>("breaks", "how it comes apart"),
    choice<&MaterialRow::axis>("axis", "of the grain or across the slabs; y is up"),
    choice<&MaterialRow::look, &MaterialLook::pattern>("look.pattern", "procedural pattern of its surface"),
};

/// The shortest text that reads as the same float: "0.95", not "0.949999988".
std::string text_of(double value) {
  char text[48];
  for (int digits = 6; digits <= 9; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtof(text, nullptr) == static_cast<float>(value)) break;
  }
  return text;
}

template <typename Table>
std::vector<std::string> names_in(const Table& table) {
  std::vector<std::string> names;
  for (const auto& member : table) names.emplace_back(member.name);
  return names;
}

template <typename Table>
const auto* find_in(const Table& table, std::string_view name) {
  const auto found = std::ranges::find_if(table, [&](const auto& member) { return member.name == name; });
  return found == table.end() ? nullptr : &*found;
}

template <typename Table>
tl::unexpected<Error> no_member(const Table& table, const char* what, std::string_view name) {
  const size_t mistyped_max = std::clamp<size_t>(name.size() / 3, 1, 4);
  return fail("there is no " + std::string(what) + " '" + std::string(name) + "'" +
              did_you_mean(name, names_in(table), mistyped_max));
}

/// "density 30000 is over 25000 kg/m3"
template <typename Owner>
tl::unexpected<Error> beyond(const NumberMember<Owner>& member, double value, const char* is, float bound) {
  std::string words(member.name);
  for (const std::string& word : {text_of(value), std::string(is), text_of(bound), std::string(member.unit)})
    if (!word.empty()) words.append(1, ' ').append(word);
  return fail(std::move(words));
}

template <typename Owner>
Result<void> check(const NumberMember<Owner>& member, double value) {
  if (!std::isfinite(value)) return fail(std::string(member.name) + " must be a finite number");
  constexpr double float_max = std::numeric_limits<float>::max();
  const auto number = static_cast<float>(std::clamp(value, -float_max, float_max));
  if (number < member.least) return beyond(member, value, "is below", member.least);
  if (number > member.most) return beyond(member, value, "is over", member.most);
  return {};
}

}  // namespace

std::span<const MaterialNumber> material_numbers() {
  return numbers;
}

std::span<const GroundNumber> ground_numbers() {
  return numbers_of_ground;
}

std::span<const MaterialChoice> material_choices() {
  return choices;
}

std::vector<std::string> number_names() {
  return names_in(numbers);
}

std::vector<std::string> choice_names() {
  return names_in(choices);
}

Result<void> check_number(const MaterialNumber& member, double value) {
  return check(member, value);
}

Result<void> check_number(const GroundNumber& member, double value) {
  return check(member, value);
}

std::optional<float> number_of(const MaterialRow& row, std::string_view member) {
  const MaterialNumber* found = find_in(numbers, member);
  return found == nullptr ? std::nullopt : std::optional(found->get(row));
}

Result<void> set_number(MaterialRow& row, std::string_view member, double value) {
  const MaterialNumber* found = find_in(numbers, member);
  if (found == nullptr) return no_member(numbers, "number", member);
  TRY(check(*found, value));
  found->put(row, static_cast<float>(value));
  return {};
}

std::optional<std::string_view> choice_of(const MaterialRow& row, std::string_view member) {
  const MaterialChoice* found = find_in(choices, member);
  if (found == nullptr || found->get(row) >= found->values.size()) return std::nullopt;
  return found->values[found->get(row)];
}

Result<void> set_choice(MaterialRow& row, std::string_view member, std::string_view value) {
  const MaterialChoice* found = find_in(choices, member);
  if (found == nullptr) return no_member(choices, "choice", member);
  const auto at = std::ranges::find(found->values, value);
  if (at == found->values.end())
    return fail(std::string(member) + " '" + std::string(value) + "' is not " + listed(found->values));
  found->put(row, static_cast<uint8_t>(at - found->values.begin()));
  return {};
}

}  // namespace scree
