#include "tools/import/bricks_import.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>

#include "content/builtin_palette.h"
#include "ground/ground_writer.h"
#include "shared/base/limits.h"
#include "shared/field/mass.h"
#include "shared/field/redistance.h"
#include "shared/material/palette.h"
#include "tools/import/chunk_pyramid.h"
#include "tools/import/level_ground.h"
#include "tools/import/limits.h"
#include "tools/import/solid_materials.h"

namespace scree {

namespace {

/// Where two solids touch, their common face is inside, however it is rounded. Voxels.
constexpr float seam_voxels = 0.001F;

constexpr float voxel_default_m = 0.25F;

/// The grounds that take part: what the solids stand on, and what a client makes without stored chunks.
struct Grounds {
  TerrainSource under;
  TerrainSource bare;
};

VoxelBox box_of(ChunkCoord chunk) {
  const VoxelCoord first = first_voxel(chunk);
  return {first, first + VoxelCoord{chunk_size, chunk_size, chunk_size}};
}

Result<VoxelBox> box_of(const std::vector<std::unique_ptr<Solid>>& solids, float voxel_size_m) {
  std::optional<VoxelBox> box;
  for (const auto& solid : solids) {
    if (solid->box().empty()) return fail("it has no rock at all");
    box = box ? hull_of(*box, solid->box()) : solid->box();
  }
  if (!box) return fail("there is nothing to import");
  TRY(layout_around(*box, voxel_size_m));
  return *box;
}

/// The cell of level rock that reaches as far as the voxels of a box do, from the origin on.
float cell_around(const VoxelBox& box, float voxel_size_m) {
  const int side = std::max({std::abs(box.lo.x), std::abs(box.hi.x), std::abs(box.lo.z), std::abs(box.hi.z)});
  return std::clamp(2.0F * static_cast<float>(side) * voxel_size_m, limits::height_cell_min_m,
                    limits::height_cell_max_m);
}

/// The level of rock where nothing else is said, in steps of heights.
Result<Grounds> grounds_of(const BricksImport& how, const std::vector<std::unique_ptr<Solid>>& solids,
                           const VoxelBox& box, float voxel_size_m) {
  Grounds grounds;
  grounds.under.voxel_size_m = grounds.bare.voxel_size_m = voxel_size_m;
  grounds.under.rows = grounds.bare.rows = how.palette->ground;
  if (how.on != nullptr) {
    grounds.under.heights = how.on;
    grounds.bare.heights = std::make_shared<BareGround>(how.on);
    return grounds;
  }
  double level_m = std::numeric_limits<double>::infinity();
  for (const auto& solid : solids)
    level_m = std::min(level_m, solid->lowest_m() + static_cast<double>(voxel_size_m));
  level_m = how.level_m.value_or(level_m);
  constexpr auto most_m = static_cast<double>(limits::height_max_m);
  if (!(std::abs(level_m) <= most_m))
    return fail(
        fmt::format("the level rock below lies at {:.4g} m, beyond ± {:.0f} m (limits.height_max_m); choose "
                    "another height (--level) or place (--at)",
                    level_m, most_m));
  const float cell_m = cell_around(box, voxel_size_m);
  const MaterialHeights none{-limits::world_half_height_m, limits::world_half_height_m};
  grounds.under.heights = grounds.bare.heights = std::make_shared<LevelGround>(
      static_cast<int32_t>(std::lround(level_m * height_steps_per_m)), cell_m, how.layers.value_or(none));
  return grounds;
}

class Importer {
 public:
  Importer(const std::vector<std::unique_ptr<Solid>>& solids, const BricksImport& how, Grounds grounds)
      : solids_(solids),
        how_(how),
        grounds_(std::move(grounds)),
        under_(grounds_.under),
        bare_(grounds_.bare) {
    under_.bound_generated(fields_bytes_max);
    bare_.bound_generated(fields_bytes_max);
  }

  const Grounds& grounds() const { return grounds_; }
  double volume_m3() const {
    const auto voxel_m = static_cast<double>(grounds_.bare.voxel_size_m);
    return static_cast<double>(mass_) / units_per_voxel * voxel_m * voxel_m * voxel_m;
  }

  Result<ChunkPyramid::Level> finest(const VoxelBox& box, const std::function<void(double)>& progress) {
    std::set<ChunkCoord> surface;
    for (const auto& solid : solids_) {
      const auto chunks = solid->surface_chunks();
      surface.insert(chunks.begin(), chunks.end());
    }
    std::set<ChunkCoord> candidates = how_.exact ? exact_chunks() : with_interior(surface, box);
    if (how_.on != nullptr)
      for (const TileKey key : how_.on->chunks())
        if (key.level == 0) candidates.insert(chunk_of(key));
    ChunkPyramid::Level level;
    size_t done = 0;
    for (const ChunkCoord chunk : candidates) {
      GeneratedChunk made =
          how_.exact ? exact_chunk(chunk) : chunk_with_solids(chunk, surface.contains(chunk));
      if (!same_bricks(made, bare_.chunk_bricks(chunk).generated))
        level.emplace(chunk, std::make_shared<const GeneratedChunk>(std::move(made)));
      if (level.size() > limits::import_chunks_max)
        return fail(
            fmt::format("more than {} chunks of {} voxels a side have to be stored "
                        "(limits.import_chunks_max); larger voxels (--voxel-size) make fewer",
                        limits::import_chunks_max, chunk_size));
      progress(0.8 * static_cast<double>(++done) / static_cast<double>(candidates.size()));
    }
    TRY(check_is_rock());
    if (volume_m3() < how_.least_m3)
      return fail(fmt::format(
          "voxels of {} m hold {:.3g} m³ of it, not half: it is thinner than they are; --voxel-size makes "
          "smaller ones",
          grounds_.bare.voxel_size_m, volume_m3()));
    if (level.empty())
      return fail("all of it lies inside the rock of the ground, so it would not be visible");
    return level;
  }

 private:
  static constexpr size_t fields_bytes_max = size_t{16} << 20U;

  Result<void> check_is_rock() const {
    if (mass_ > 0 || how_.exact) return {};
    return fail(
        fmt::format("voxels of {} m hold no rock of it: it encloses none, as an open sheet that is closed by "
                    "winding numbers (--sheet), or is thinner than they are (--voxel-size)",
                    grounds_.bare.voxel_size_m));
  }

  /// And the chunks that are all rock, where the ground is not.
  std::set<ChunkCoord> with_interior(const std::set<ChunkCoord>& surface, const VoxelBox& box) {
    std::set<ChunkCoord> chunks = surface;
    constexpr VoxelCoord middle{chunk_size / 2, chunk_size / 2, chunk_size / 2};
    for_each_chunk(box, [&](ChunkCoord chunk) {
      if (surface.contains(chunk)) return;
      for (const auto& solid : solids_)
        if (solid->is_inside(first_voxel(chunk) + middle)) {
          chunks.insert(chunk);
          return;
        }
    });
    return chunks;
  }

  std::set<ChunkCoord> exact_chunks() const {
    std::set<ChunkCoord> chunks;
    for_each_chunk({first_voxel(how_.exact->lo), first_voxel(how_.exact->hi)},
                   [&](ChunkCoord chunk) { chunks.insert(chunk); });
    return chunks;
  }

  GeneratedChunk exact_chunk(ChunkCoord chunk) {
    Window window(box_of(chunk));
    std::vector<float> levels(window.codes.size());
    solids_.front()->read_levels(window.box, levels);
    std::ranges::transform(levels, window.codes.begin(), [](float level) { return encode(level); });
    mass_ += mass_of(window);
    GeneratedChunk made = split_into_bricks(window, chunk);
    ChunkMaterials materials;
    for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i)
      materials[static_cast<size_t>(i)] = with_otherwise(solids_.front()->materials(brick_in_chunk(chunk, i)),
                                                         *made.bricks[static_cast<size_t>(i)]);
    made.stored_materials = stored_materials_of(materials);
    return made;
  }

  /// Rock for which an export says nothing is of the material that was asked for.
  BrickMaterials with_otherwise(const BrickMaterials& own, const Brick& brick) const {
    if (!how_.material) return own;
    VoxelMaterials voxels = own.unpacked();
    for (size_t i = 0; i < voxels.size(); ++i)
      if (voxels[i] == ground_own && brick.codes[i] < 0) voxels[i] = said(*how_.material);
    return BrickMaterials(voxels);
  }

  std::shared_ptr<const GeneratedChunk> stored_below(ChunkCoord chunk) const {
    return stored_chunk(under_.source(), chunk).chunk;
  }

  GeneratedChunk chunk_with_solids(ChunkCoord chunk, bool has_surface) {
    SolidRock rock{solids_, nullptr, {box_of(chunk)}, how_.material};
    if (!has_surface) {
      const auto owner = std::ranges::find_if(
          solids_, [&](const auto& solid) { return solid->is_inside(first_voxel(chunk)); });
      if (owner == solids_.end()) {
        GeneratedChunk below = copy_of(under_.chunk_bricks(chunk).generated);
        if (stored_below(chunk) == nullptr) below.stored_materials = nullptr;
        return below;
      }
      mass_ += MassUnits{chunk_size} * chunk_size * chunk_size * units_per_voxel;
      GeneratedChunk made = uniform_chunk(solid_brick());
      rock.owners.all = static_cast<uint32_t>(owner - solids_.begin());
      made.stored_materials = united_materials(made, chunk, rock, stored_below(chunk).get());
      return made;
    }
    const VoxelBox box = box_of(chunk).grown(chunk_apron);
    rock.owners.box = box;
    std::vector<float> levels = levels_of_solids(box, rock.owners);
    Window solids(box);
    rock.codes = &solids;
    distances_from_levels(levels, solids);
    mass_ += mass_of(part_of(solids, box_of(chunk)));
    Window together = gather(under_, box);
    unite(solids, levels, together);
    GeneratedChunk made = split_into_bricks(together, chunk);
    made.stored_materials = united_materials(made, chunk, rock, stored_below(chunk).get());
    return made;
  }

  /// The least of all solids' levels. A voxel's owner is the solid with the least one.
  std::vector<float> levels_of_solids(const VoxelBox& box, SolidOwners& owners) const {
    std::vector<float> levels(Window::count(box), std::numeric_limits<float>::max());
    std::vector<float> own(levels.size());
    if (solids_.size() > 1) owners.each.resize(levels.size());
    for (size_t n = 0; n < solids_.size(); ++n) {
      if (common(solids_[n]->box().grown(chunk_apron), box).empty()) continue;
      solids_[n]->read_levels(box, own);
      const float seam = solids_.size() > 1 ? seam_voxels : 0.0F;
      for (size_t i = 0; i < levels.size(); ++i) {
        if (own[i] - seam >= levels[i]) continue;
        levels[i] = own[i] - seam;
        if (!owners.each.empty()) owners.each[i] = static_cast<uint32_t>(n);
      }
    }
    return levels;
  }

  /// `ground` becomes the union with the solids. Where they are far, it keeps its codes.
  static void unite(const Window& solids, std::vector<float>& levels, Window& ground) {
    if (std::ranges::all_of(ground.codes, [](Code code) { return code == code_air; })) {
      ground.codes = solids.codes;
      return;
    }
    for (size_t i = 0; i < levels.size(); ++i)
      levels[i] =
          std::min(levels[i], decode(ground.codes[i]) - (levels[i] < band_voxels ? seam_voxels : 0.0F));
    Window united(ground.box);
    distances_from_levels(levels, united);
    for (size_t i = 0; i < levels.size(); ++i)
      if (solids.codes[i] != code_air) ground.codes[i] = std::min(united.codes[i], ground.codes[i]);
  }

  const std::vector<std::unique_ptr<Solid>>& solids_;
  const BricksImport& how_;
  const Grounds grounds_;
  MapField under_;
  MapField bare_;
  MassUnits mass_ = 0;
};

/// Level rock that reaches as far as the stored chunks do: so a ground has the same size when it comes back
/// from an export, whose box is that of the chunks.
TerrainSource level_around(const TerrainSource& bare, const BrickLayout& chunks) {
  const HeightLayout& level = bare.heights->layout();
  const float cell_m = cell_around({first_voxel(chunks.lo), first_voxel(chunks.hi)}, chunks.voxel_size_m);
  TerrainSource fitted = bare;
  fitted.heights = std::make_shared<LevelGround>(level.lowest, cell_m, level.layers);
  return fitted;
}

Result<std::unique_ptr<GroundWriter>> begin_file(const std::string& path, const TerrainSource& bare,
                                                 const BricksImport& how) {
  HeightLayout layout = bare.heights->layout();
  const float zero_m = how.on != nullptr ? how.on->header().zero_m : 0.0F;
  auto writer = GroundWriter::create(path, layout, zero_m, *how.palette);
  TRY(writer);
  if (how.on != nullptr) {
    (*writer)->copy_heights(*how.on);
  } else {
    const std::vector<int32_t> row(static_cast<size_t>(layout.columns), layout.lowest);
    for (int z = 0; z < layout.rows; ++z) (*writer)->add_row(row);
  }
  return writer;
}

}  // namespace

Result<BricksImported> import_bricks(const std::vector<std::unique_ptr<Solid>>& solids,
                                     const std::string& path, const BricksImport& given,
                                     const std::function<void(double)>& progress) {
  BricksImport how = given;
  const auto below = how.on != nullptr ? how.on->palette() : shared_builtin_palette();
  if (how.palette == nullptr) how.palette = below;
  if (how.on != nullptr) TRY(validate_change(*below, *how.palette));
  const bool on_bricks = how.on != nullptr && how.on->bricks();
  const float voxel_size_m =
      how.voxel_size_m.value_or(on_bricks ? how.on->bricks()->voxel_size_m : voxel_default_m);
  if (on_bricks && how.on->bricks()->voxel_size_m != voxel_size_m)
    return fail(fmt::format("the bricks of the ground below have voxels of {} m, not {} m",
                            how.on->bricks()->voxel_size_m, voxel_size_m));
  const auto box = TRY(box_of(solids, voxel_size_m));
  auto grounds = TRY(grounds_of(how, solids, box, voxel_size_m));
  Importer importer(solids, how, std::move(grounds));
  auto level = TRY(importer.finest(box, progress));
  BricksImported imported;
  imported.chunks = level.size();
  imported.volume_m3 = importer.volume_m3();
  ChunkPyramid pyramid(importer.grounds().bare, std::move(level));
  const TerrainSource& bare = importer.grounds().bare;
  auto writer = TRY(begin_file(path, how.on != nullptr ? bare : level_around(bare, pyramid.layout()), how));
  writer->begin_chunks(pyramid.layout());
  pyramid.write(*writer);
  progress(1.0);
  const auto header = TRY(writer->finish());
  imported.header = header;
  imported.bytes = writer->bytes();
  return imported;
}

}  // namespace scree
