#include "shared/operation/store.h"

#include <algorithm>

#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {

namespace {

std::string hex_text(uint64_t number) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text(16, '0');
  for (size_t i = text.size(); i-- > 0; number >>= 4U) text[i] = digits[number & 0xFU];
  return text;
}

}  // namespace

StoreName store_of_person(uint64_t token_id, uint64_t session) {
  if (token_id != 0) return {StoreKind::token, token_id};
  return session == 0 ? worlds_store() : StoreName{StoreKind::session, session};
}

Result<void> validate(const StoreName& store) {
  TRY(validate_kind(store.kind, "kind of store"));
  if (traits_of(store.kind).has_number != (store.number != 0))
    return fail("a store of a person has the number of a token or of a session, and others have none");
  const size_t bytes = store.name.size();
  if (store.kind != StoreKind::named && bytes > 0) return fail("only a game's store has a name");
  if (store.kind != StoreKind::named) return {};
  if (bytes > 0 && bytes <= limits::store_name_bytes_max && !fault_of_text(store.name)) return {};
  return fail("the name of a store has 1 to " + std::to_string(limits::store_name_bytes_max) +
              " bytes of text");
}

std::string text_of(const StoreName& store) {
  switch (store.kind) {
    case StoreKind::own:
      return "your store";
    case StoreKind::world:
      return "the world's store";
    case StoreKind::token:
      return "the store of token " + hex_text(store.number);
    case StoreKind::session:
      return "the store of session " + std::to_string(store.number);
    case StoreKind::named:
      return "the store " + store.name;
  }
  return {};
}

void take_out(MaterialMasses& from, Material material, MassUnits mass) {
  const auto found = std::ranges::find(from, material, &MaterialMass::material);
  CHECK(found != from.end() && mass <= found->mass);
  found->mass -= mass;
  if (found->mass == 0) from.erase(found);
}

}  // namespace scree
