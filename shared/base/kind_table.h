// Tables of kinds: materials, shapes, seed patterns, kinds of terrain, and the methods to choose between.
//
// A kind is an enum whose numbers, 0, 1, 2 …, are those on the wire and in recordings. Its table is a
// function `constexpr Row row_of(Kind)` beside the enum: a switch with a row for each kind, so that a kind
// without a row does not compile (-Werror=switch), and an empty row for any other number. A row has at least
// a name. Codecs, validation, options and shaders iterate over the table or ask it; none of them names the
// last kind.
//
// To add a kind, add an enumerator, its row, and its case in the functions that switch over the kind; the
// compiler names these. A kind that crosses the wire also has a value in proto/scree.proto:
// proto/wire_values.cpp compares their number, a test their names.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "shared/base/check.h"
#include "shared/base/listed.h"
#include "shared/base/result.h"

namespace scree {

template <typename Kind>
concept HasRows = std::is_same_v<std::underlying_type_t<Kind>, uint8_t> && requires(Kind kind) {
  std::string_view(row_of(kind).name);
};

/// Kinds 0 … kind_count − 1 are known.
template <HasRows Kind>
inline constexpr size_t kind_count = [] {
  size_t count = 0, rows = 0;
  for (size_t number = 0; number <= UINT8_MAX; ++number) {
    if (row_of(static_cast<Kind>(number)).name.empty()) continue;
    count = number + 1;
    ++rows;
  }
  if (count != rows) throw "the numbers of the kinds have a gap";  // ends the compilation
  return count;
}();

template <HasRows Kind>
inline constexpr auto all_kinds = [] {
  std::array<Kind, kind_count<Kind>> kinds{};
  for (size_t i = 0; i < kinds.size(); ++i) kinds[i] = static_cast<Kind>(i);
  return kinds;
}();

/// The kinds that `keeps` is true of, in order.
template <HasRows Kind, bool (*keeps)(Kind)>
inline constexpr auto kinds_that = [] {
  std::array<Kind, static_cast<size_t>(std::ranges::count_if(all_kinds<Kind>, keeps))> kinds{};
  std::ranges::copy_if(all_kinds<Kind>, kinds.begin(), keeps);
  return kinds;
}();

template <HasRows Kind>
inline constexpr auto kind_rows = [] {
  std::array<decltype(row_of(Kind{})), kind_count<Kind>> rows{};
  for (size_t i = 0; i < rows.size(); ++i) rows[i] = row_of(static_cast<Kind>(i));
  return rows;
}();

template <HasRows Kind>
inline constexpr auto kind_names = [] {
  std::array<std::string_view, kind_count<Kind>> names{};
  for (size_t i = 0; i < names.size(); ++i) names[i] = row_of(static_cast<Kind>(i)).name;
  return names;
}();

template <HasRows Kind>
constexpr bool is_known(Kind kind) {
  return static_cast<size_t>(kind) < kind_count<Kind>;
}

/// The row of a known kind.
template <HasRows Kind>
constexpr const auto& traits_of(Kind kind) {
  CHECK(is_known(kind));
  return kind_rows<Kind>[static_cast<size_t>(kind)];
}

/// The name of a known kind.
template <HasRows Kind>
constexpr std::string_view name_of(Kind kind) {
  return traits_of(kind).name;
}

template <HasRows Kind>
constexpr std::optional<Kind> kind_named(std::string_view name) {
  for (const Kind kind : all_kinds<Kind>)
    if (name_of(kind) == name) return kind;
  return std::nullopt;
}

/// Refuses a number that has no row: "the material is not a known one (rock, soil or ice)".
template <HasRows Kind>
Result<void> validate_kind(Kind kind, std::string_view what) {
  if (is_known(kind)) return {};
  return fail("the " + std::string(what) + " is not a known one (" + listed(kind_names<Kind>) + ")");
}

}  // namespace scree
