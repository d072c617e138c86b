#include "tools/scenes/scene.h"

#include <algorithm>
#include <array>

#include "shared/base/listed.h"
#include "tools/scenes/grounds.h"
#include "tools/scenes/store.h"
#include "tools/scenes/street.h"
#include "tools/scenes/structures.h"

namespace scree {

namespace {

constexpr std::array rows{
    SceneRow{"plain", "flat ground, nothing else", plain_scene},
    SceneRow{"cliffs", "a cliff with two caves under roofs on pillars", cliffs_scene},
    SceneRow{"arch", "a beam on two posts", arch_scene},
    SceneRow{"tower", "a slender tower with a heavy top", tower_scene},
    SceneRow{"bridge", "a deck from the canyon's cliff to a butte", bridge_scene},
    SceneRow{"quarry", "terraces of rock, soil and ice in layers", quarry_scene},
    SceneRow{"city", "a block of houses, imported from closed meshes", city_scene},
    SceneRow{"maunga-whau", "the crater of a volcano, from an elevation model", maunga_whau_scene},
    SceneRow{"street", "houses of twelve materials: bricks, concrete, steel, glass, timber and more",
             street_scene},
    SceneRow{"store", "crates, barrels, balls and a table on a dock and on a wall", store_scene},
};

}  // namespace

std::span<const SceneRow> all_scenes() {
  return rows;
}

const SceneRow* scene_named(std::string_view name) {
  const auto found = std::ranges::find(rows, name, &SceneRow::name);
  return found == rows.end() ? nullptr : &*found;
}

std::string scene_names() {
  std::array<std::string_view, rows.size()> names;
  std::ranges::transform(rows, names.begin(), &SceneRow::name);
  return listed(names);
}

}  // namespace scree
