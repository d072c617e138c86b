#include "client/render/methods.h"

#include <algorithm>
#include <array>

#include "client/render/grid/grid_method.h"
#include "client/render/grid/grid_shape.h"
#include "client/render/mesh/mesh_method.h"
#include "client/render/raymarch/raymarch_method.h"

namespace scree {
namespace {

std::optional<std::string> nothing_missing() {
  return std::nullopt;
}

constexpr std::array table{
    MethodEntry{"mesh", "cached surface nets of blocks of terrain, rebuilt where they change",
                nothing_missing, make_mesh_method},
    MethodEntry{"dual", "the same by dual contouring: sharp edges of the rock stay sharp", nothing_missing,
                make_dual_method},
    MethodEntry{"cubes", "the same by marching cubes", nothing_missing, make_cubes_method},
    MethodEntry{"raymarch", "rays through an atlas of bricks; edits do not slow it down", nothing_missing,
                make_raymarch_method},
    MethodEntry{"grid", "marching cubes by a geometry shader, from a grid of points about the camera",
                grid_method_missing, make_grid_method, grid_options},
};

}  // namespace

std::span<const MethodEntry> all_methods() {
  return table;
}

std::span<const DrawOption> options_of(const MethodEntry& entry) {
  return entry.options == nullptr ? std::span<const DrawOption>() : entry.options();
}

std::vector<const DrawOption*> all_draw_options() {
  std::vector<const DrawOption*> all;
  for (const MethodEntry& entry : table)
    for (const DrawOption& option : options_of(entry)) all.push_back(&option);
  return all;
}

const MethodEntry* method_named(std::string_view name) {
  const auto* found = std::ranges::find(table, name, &MethodEntry::name);
  return found == table.end() ? nullptr : found;
}

const MethodEntry& next_available(const MethodEntry& entry) {
  const auto at = static_cast<size_t>(&entry - table.data());
  for (size_t i = 1; i < table.size(); ++i) {
    const MethodEntry& other = table[(at + i) % table.size()];
    if (!other.missing()) return other;
  }
  return entry;
}

std::string describe_methods() {
  std::string text;
  for (const MethodEntry& entry : table) {
    text.append("  ").append(entry.name).append(entry.name.size() < 10 ? 10 - entry.name.size() : 1, ' ');
    text.append(entry.summary).append("\n");
  }
  return text;
}

}  // namespace scree
