// How persons are in a world: a choice of its server.
#pragma once

#include <cstdint>

#include "shared/base/kind_table.h"

namespace scree {

/// fly: they look on from anywhere. walk: they can have a body, which the server moves by their input, and
/// who has none edits nothing.
enum class Persons : uint8_t { fly = 0, walk = 1 };

struct PersonsRow {
  std::string_view name;
};

constexpr PersonsRow row_of(Persons persons) {
  switch (persons) {
    case Persons::fly:
      return {"fly"};
    case Persons::walk:
      return {"walk"};
  }
  return {};
}

}  // namespace scree
