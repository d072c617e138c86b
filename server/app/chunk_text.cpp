#include "server/app/chunk_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <vector>

#include "server/store/world_file.h"
#include "shared/field/field.h"

namespace scree {

namespace {

template <typename Tag>
std::string coord_text(const Coord<Tag>& c) {
  return fmt::format("({}, {}, {})", c.x, c.y, c.z);
}

void append_codes(std::string& text, const BrickPatch& patch) {
  for (int y = brick_size - 1; y >= 0; --y) {
    fmt::format_to(std::back_inserter(text), "  y = {}\n", first_voxel(patch.coord).y + y);
    for (int x = 0; x < brick_size; ++x) {
      for (int z = 0; z < brick_size; ++z) {
        const Code code = patch.brick.codes[static_cast<size_t>(Brick::index(x, y, z))];
        if (code == code_solid)
          text += "    #";
        else if (code == code_air)
          text += "    .";
        else
          fmt::format_to(std::back_inserter(text), "{:5}", int{code});
      }
      text += '\n';
    }
  }
}

/// "the ground's materials", "material 3", or how many voxels are of each: "300 of the ground's, 212 of 3".
std::string materials_text(const BrickMaterials& materials) {
  if (materials.is_ground()) return "the ground's materials";
  if (materials.is_uniform()) return fmt::format("material {}", row_number(material_of(materials.uniform())));
  const VoxelMaterials voxels = materials.unpacked();
  std::string text;
  for (const VoxelMaterial value : materials.list()) {
    const auto count = std::ranges::count(voxels, value);
    const std::string of =
        value == ground_own ? "the ground's" : std::to_string(row_number(material_of(value)));
    text += fmt::format("{}{} of {}", text.empty() ? "" : ", ", count, of);
  }
  return text;
}

}  // namespace

std::string chunk_text(ChunkCoord chunk, std::span<const BrickPatch> bricks) {
  std::vector<const BrickPatch*> ordered;
  for (const BrickPatch& patch : bricks) ordered.push_back(&patch);
  std::ranges::sort(ordered, {}, [](const BrickPatch* patch) { return patch->coord; });
  std::string text = fmt::format("chunk {}: {} edited bricks; all others are the ground's\n",
                                 coord_text(chunk), bricks.size());
  for (const BrickPatch* patch : ordered) {
    const Brick* uniform = uniform_equivalent(patch->brick);
    fmt::format_to(std::back_inserter(text), "brick {}: {}, hash {:016x}{}\n", coord_text(patch->coord),
                   materials_text(patch->materials), brick_hash(patch->coord, patch->brick, patch->materials),
                   uniform == nullptr        ? ""
                   : uniform == &air_brick() ? ", all air"
                                             : ", all rock");
    if (uniform == nullptr) append_codes(text, *patch);
  }
  return text;
}

Result<std::string> saved_chunk_text(const std::string& path, ChunkCoord chunk) {
  const auto file = TRY(WorldFile::open(path));
  const auto row = TRY(file->read_chunk(chunk));
  return chunk_text(chunk, row ? row->bricks : std::vector<BrickPatch>());
}

}  // namespace scree
