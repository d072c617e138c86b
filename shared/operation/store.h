// Stores: what was dug out of the world, and has not been placed again. Whose a store is, and what it holds.
//
// A store is of a person, of a name that the game gives, or of the world as a whole. A person is known by the
// access token, which survives a restart and which nobody else can show; who has none, by the session. A name
// that a person says of itself opens no store: anybody could say it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "shared/base/kind_table.h"
#include "shared/base/result.h"
#include "shared/field/material_window.h"
#include "shared/operation/store_limits.h"

namespace scree {

/// The numbers are those on the wire and in files.
enum class StoreKind : uint8_t {
  own,      ///< in requests alone: of who asks
  world,    ///< of the world as a whole
  token,    ///< of the person with the access token of that id
  session,  ///< of the person of that session, who has no token
  named,    ///< of a name that the game gives
};

struct StoreKindRow {
  std::string_view name;
  bool has_number = false;
  bool is_persons = false;
};

constexpr StoreKindRow row_of(StoreKind kind) {
  switch (kind) {
    case StoreKind::own:
      return {.name = "own"};
    case StoreKind::world:
      return {.name = "world"};
    case StoreKind::token:
      return {.name = "token", .has_number = true, .is_persons = true};
    case StoreKind::session:
      return {.name = "session", .has_number = true, .is_persons = true};
    case StoreKind::named:
      return {.name = "named"};
  }
  return {};
}

/// Whose a store is.
struct StoreName {
  StoreKind kind = StoreKind::own;
  uint64_t number = 0;  ///< of a token or a session; else 0
  std::string name{};   ///< of a named one; else empty

  bool operator==(const StoreName&) const = default;
  bool operator<(const StoreName& other) const {
    return std::tie(kind, number, name) < std::tie(other.kind, other.number, other.name);
  }
};

inline StoreName worlds_store() {
  return {StoreKind::world};
}
inline StoreName named_store(std::string name) {
  return {StoreKind::named, 0, std::move(name)};
}
/// The store of a person: by its token's id, which is 0 where it has none, or else by its session. Session 0
/// is the server itself, whose store is the world's.
StoreName store_of_person(uint64_t token_id, uint64_t session);

/// Refuses what names no store.
Result<void> validate(const StoreName& store);

/// "the world's store", "the store red", "the store of session 7", "the store of token 00000000000000ab",
/// "your store".
std::string text_of(const StoreName& store);

/// What a store holds. Each mass is greater than 0; none: there is no such store any more.
struct StoreContent {
  StoreName store;
  MaterialMasses masses;

  bool operator==(const StoreContent&) const = default;
};

/// Takes a mass out of a list, which must have as much of the material.
void take_out(MaterialMasses& from, Material material, MassUnits mass);

}  // namespace scree
