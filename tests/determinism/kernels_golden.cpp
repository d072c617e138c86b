// Prints a hash of what each field kernel computes on fixed inputs, one "name hash" a line. The output must
// be the same from every compiler at every optimisation (tests/determinism/CMakeLists.txt).
#include <algorithm>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "shared/base/random.h"
#include "shared/falling/island_search.h"
#include "shared/field/edit.h"
#include "shared/field/redistance.h"
#include "shared/field/terrain.h"
#include "shared/fracture/conform_cutter.h"
#include "shared/fracture/seeds.h"
#include "shared/fracture/slice_cutter.h"
#include "shared/operation/operation.h"
#include "shared/recombine/stamp_method.h"
#include "tests/determinism/golden.h"
#include "tests/support/memory_heights.h"

namespace scree {
namespace {

/// Some rock with a surface through it: canyon terrain around the top of the ground at (x, z).
Window terrain_window(float x_m, float z_m, int side) {
  const TerrainSource source{TerrainKind::canyon, 7, 0.25F};
  MapField field(source);
  const float y_m = ground_height_m(source, x_m, z_m);
  const VoxelCoord lo{static_cast<int>(x_m / 0.25F) - side / 2, static_cast<int>(y_m / 0.25F) - side / 2,
                      static_cast<int>(z_m / 0.25F) - side / 2};
  return gather(field, {lo, lo + VoxelCoord{side, side, side}});
}

glm::vec3 centre(const Window& window) {
  const VoxelCoord c = window.box.lo + window.box.hi;
  return glm::vec3(static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)) * 0.5F;
}

std::vector<std::pair<std::string, Shape>> shapes_around(glm::vec3 c) {
  Shape rounded = box(c, {5.3F, 4.1F, 3.7F});
  rounded.radius_m = 1.25F;
  return {{"sphere", sphere(c, 6.3F)},
          {"box", box(c, {6.5F, 4.25F, 5.1F})},
          {"rounded_box", rounded},
          {"capsule", capsule(c - glm::vec3(5.0F, 2.0F, 1.0F), c + glm::vec3(4.0F, 3.0F, 2.5F), 3.3F)},
          {"crater", crater(c + glm::vec3(0.3F, -0.2F, 0.1F), 10.0F)},
          {"large_crater", crater(c - glm::vec3(0.3F, 9.2F, 7.1F), 27.0F)}};
}

void print_generate() {
  for (const TerrainKind kind : {TerrainKind::flat, TerrainKind::noise, TerrainKind::canyon}) {
    for (const uint32_t random_seed : {1U, 77U}) {
      const TerrainSource source{kind, random_seed, 0.25F};
      GoldenHash digest;
      for (const ChunkCoord chunk : {ChunkCoord{0, 0, 0}, ChunkCoord{-1, 0, 2}, ChunkCoord{3, -1, -4},
                                     ChunkCoord{-7, 1, 5}, ChunkCoord{120, 0, -333}}) {
        const GeneratedChunk generated = generate_chunk(source, chunk);
        for (int i = 0; i < 64; ++i)
          digest.add(brick_hash(brick_in_chunk(chunk, i), *generated.bricks[static_cast<size_t>(i)]));
      }
      for (int i = 0; i < 8; ++i)
        digest.add(ground_height_m(source, 13.7F * static_cast<float>(i), -5.3F * static_cast<float>(i)));
      digest.print("generate_" + std::string(name_of(kind)) + "_" + std::to_string(random_seed));
    }
  }
}

void print_heights() {
  const auto model = std::make_shared<const MemoryHeights>(300, 200, 3.7F, rough_height);
  for (const float voxel_m : {0.25F, 0.3F, 2.0F, 16.0F}) {
    const TerrainSource source{TerrainKind::flat, 1, voxel_m, model};
    GoldenHash digest;
    for (int x = -2; x < 2; ++x)
      for (int y = 0; y < 4; ++y) {
        const ChunkCoord chunk{x, y, 1 - x};
        const GeneratedChunk generated = generate_chunk(source, chunk);
        for (int i = 0; i < 64; ++i)
          digest.add(brick_hash(brick_in_chunk(chunk, i), *generated.bricks[static_cast<size_t>(i)]));
        digest.add(floor_m(source, x, y));
      }
    for (int i = 0; i < 8; ++i)
      digest.add(ground_height_m(source, 113.7F * static_cast<float>(i - 4), -55.3F * static_cast<float>(i)));
    digest.print("heights_" + std::to_string(static_cast<int>(voxel_m * 100.0F)));
  }
}

void print_edits() {
  const Window before = terrain_window(3.0F, 11.0F, 40);
  for (const auto& [name, shape] : shapes_around(centre(before))) {
    GoldenHash carved, filled, extracted;
    Window window = before;
    carve(window, codes_of(shape, window.box));
    carved.add(window);
    carved.print("carve_" + name);
    window = before;
    fill(window, codes_of(shape, window.box));
    filled.add(window);
    filled.print("fill_" + name);
    extracted.add(extract(before, codes_of(shape, before.box)));
    extracted.print("extract_" + name);
  }
}

void print_redistance() {
  Window window = terrain_window(-9.0F, 4.0F, 32);
  Random random(5);
  std::vector<float> levels;
  for (Code& code : window.codes) {
    levels.push_back(decode(code) * (0.5F + random.unit()));
    code = static_cast<Code>(code / 2);  // every distance wrong, every sign right
  }
  GoldenHash digest;
  redistance(window);
  digest.add(window);
  distances_from_levels(levels, window);
  digest.add(window);
  digest.print("redistance");
}

void print_sample() {
  MapField field({TerrainKind::canyon, 7, 0.25F});
  Random random(11);
  GoldenHash digest;
  for (int i = 0; i < 500; ++i) {
    // Braces: arguments in parentheses are evaluated in whatever order the compiler likes.
    const glm::vec3 p{random.unit() * 60.0F - 30.0F, random.unit() * 40.0F, random.unit() * 60.0F - 30.0F};
    const FieldSample found = sample(field, p);
    digest.add(found.distance_voxels);
    digest.add(found.gradient);
    if (i % 10 == 0) digest.add(trace(field, p, {0.0F, -1.0F, 0.0F}, 100.0F).value_or(-1.0F));
  }
  digest.print("sample_and_trace");
}

struct Fracture {
  Window before;
  Window after;
  Window volume;
  std::vector<glm::vec3> seeds;
  Cut cut;
};

Fracture fracture(Cutter cutter, SeedPattern pattern, uint32_t count, GoldenHash& digest) {
  Fracture result;
  result.before = terrain_window(3.0F, 11.0F, 32);
  const glm::vec3 c = centre(result.before);
  const Shape shape = sphere(c, 8.0F);
  result.volume = extract(result.before, codes_of(shape, result.before.box));
  result.after = result.before;
  carve(result.after, codes_of(shape, result.after.box));
  result.seeds = scatter_seeds(result.volume, pattern, count, 99, c);
  for (const glm::vec3& seed : result.seeds) digest.add(seed);
  result.cut = cut_volume(cutter, result.volume, result.before, result.after, result.seeds);
  return result;
}

Fracture fracture(SeedPattern pattern, uint32_t count, GoldenHash& digest) {
  return fracture(Cutter::field, pattern, count, digest);
}

void print_fracture() {
  for (const SeedPattern pattern : {SeedPattern::uniform, SeedPattern::radial}) {
    for (const uint32_t count : {1U, 8U, 64U}) {
      GoldenHash digest;
      digest.add(fracture(pattern, count, digest).cut);
      digest.print(std::string(pattern == SeedPattern::uniform ? "cut_uniform_" : "cut_radial_") +
                   std::to_string(count));
    }
  }
}

void print_seed_patterns() {
  const Window rock = terrain_window(3.0F, 11.0F, 32);
  GoldenHash digest;
  for (const uint32_t count : {5U, 300U})
    for (const glm::vec3& seed : scatter_seeds(rock, SeedPattern::clustered, count, 17, centre(rock)))
      digest.add(seed);
  std::vector<glm::vec3> points;
  for (int i = 0; i < 50; ++i) {
    const auto along = static_cast<float>(i);
    points.push_back(centre(rock) + glm::vec3(0.4F, -0.5F, 0.1F) * along);
  }
  for (const glm::vec3& seed : authored_seeds(rock, points, 17)) digest.add(seed);
  digest.print("seeds_clustered_authored");
}

void print_polygon_cutters() {
  const auto print = [](Cutter cutter, const PolygonCutting& cutting, const char* name) {
    GoldenHash digest;
    const Fracture fractured = fracture(cutter, SeedPattern::radial, 40, digest);
    digest.add(fractured.cut);
    for (const PolygonMesh& part : cut_polygons(cutting, fractured.volume, fractured.seeds).parts)
      for (const glm::dvec3& vertex : part.vertices)
        for (int i = 0; i < 3; ++i) digest.add(std::bit_cast<uint64_t>(vertex[i]));
    digest.print(name);
  };
  print(Cutter::slice, slice_cutting, "cut_slice");
  print(Cutter::conform, conform_cutting, "cut_conform");
}

void print_poses() {
  Random random(21);
  GoldenHash digest;
  for (int i = 0; i < 1000; ++i) {
    const Pose pose = dequantise(some_pose({100.0F, -20.0F, 3.0F}, random));
    digest.add(pose);
    const QuantisedPose again = quantise(pose);
    for (const int32_t part : {again.x, again.y, again.z}) digest.add(static_cast<uint64_t>(part));
    digest.add(uint64_t{again.rotation});
  }
  digest.print("poses");
}

void print_stamp(StampMethod method, const std::string& name) {
  constexpr float voxel_size_m = 0.25F;
  GoldenHash unused, digest;
  const Fracture fractured = fracture(SeedPattern::uniform, 8, unused);
  MapField field({TerrainKind::canyon, 7, voxel_size_m});
  Random random(31);
  for (const CutPiece& piece : fractured.cut.pieces) {
    const glm::vec3 place_m = piece.volume.centre_voxels * voxel_size_m;
    const QuantisedPose pose = some_pose(place_m, random);
    Window window = gather(field, stamp_box(method, piece.volume, pose, voxel_size_m));
    const StampPlan plan = plan_stamp(method, window, piece.volume, pose, voxel_size_m, piece.volume.mass);
    digest.add(static_cast<uint64_t>(plan.shift));
    digest.add(static_cast<uint64_t>(plan.gain));
    stamp(method, window, piece.volume, pose, voxel_size_m, plan.shift);
    digest.add(window);
  }
  digest.print("plan_and_" + name);
}

void print_shatter(Cutter cutter, const std::string& name) {
  MapField field({TerrainKind::canyon, 3, 0.25F});
  PieceTable pieces;
  const glm::vec3 ground(9.0F, ground_height_m(field.source(), 9.0F, 4.0F), 4.0F);
  apply(CarveOperation{sphere(ground, 2.0F), SeedPattern::uniform, 3, 5, ground, 1}, field, pieces);
  GoldenHash digest;
  const PieceTable parents = pieces;
  for (const auto& [id, parent] : parents) {
    const glm::vec3 impact = parent->centre_voxels - glm::vec3(0.0F, 3.0F, 0.0F);
    const Applied applied =
        apply(ShatterOperation{id, SeedPattern::radial, 8, id, impact, id * 100, cutter}, field, pieces);
    digest.add(static_cast<uint64_t>(applied.dust));
    for (const CreatedPiece& child : applied.created) digest.add(*pieces.at(child.id));
  }
  digest.print(name);
}

/// Natural breaks: of terrain, and of the largest piece of it.
void print_natural(Cutter cutter) {
  const TerrainSource source{TerrainKind::canyon, 3, 0.25F};
  GoldenHash digest;
  for (const uint32_t seeds : {1U, 5U, 60U}) {
    MapField field(source);
    PieceTable pieces;
    const glm::vec3 ground(9.0F, ground_height_m(source, 9.0F, 4.0F), 4.0F);
    const Applied carved =
        apply(CarveOperation{sphere(ground, 2.0F), SeedPattern::natural, seeds, 5, ground, 1, cutter}, field,
              pieces);
    const auto largest = std::ranges::max_element(
        pieces, {}, [](const auto& piece) { return std::pair(piece.second->mass, piece.first); });
    const Applied broken = apply(ShatterOperation{largest->first, SeedPattern::natural, 20, 7,
                                                  largest->second->centre_voxels, 1000, cutter},
                                 field, pieces);
    digest.add(static_cast<uint64_t>(carved.dust));
    digest.add(static_cast<uint64_t>(broken.dust));
    for (const auto& [id, piece] : pieces) {
      digest.add(uint64_t{id});
      digest.add(*piece);
    }
    std::vector<const Volume*> parts;
    for (const auto& [id, piece] : pieces) parts.push_back(piece.get());
    for (const SeedsDue& due : seeds_due(parts, SeedPattern::radial, ground / 0.25F))
      digest.add(std::bit_cast<uint64_t>(due.share));
  }
  digest.print("natural_" + std::string(name_of(cutter)));
}

/// Posts, their feet carved away: found, and lifted.
void print_islands() {
  MapField field({TerrainKind::noise, 5, 0.25F});
  PieceTable pieces;
  GoldenHash digest;
  for (PieceId id = 1; id <= 4; ++id) {
    const float x_m = 5.0F * static_cast<float>(id);
    const glm::vec3 foot(x_m, ground_height_m(field.source(), x_m, 2.0F), 2.0F);
    const glm::vec3 top = foot + glm::vec3(0.4F, 4.0F, 0.3F);
    apply(FillOperation{capsule(foot, top, 0.5F + 0.1F * static_cast<float>(id))}, field, pieces);
    const Applied cut =
        apply(CarveOperation{sphere(foot, 1.4F), SeedPattern::uniform, 1, id, foot, id * 10}, field, pieces);
    IslandSearch search(field, cut.changed);
    for (size_t bricks = 5; !search.advance(bricks); bricks = 5) {
    }
    for (const Island& island : search.islands()) {
      const Applied lifted = apply(IslandOperation{island.box, island.start, id * 10 + 5}, field, pieces);
      digest.add(static_cast<uint64_t>(lifted.terrain_gain));
      for (const CreatedPiece& piece : lifted.created) digest.add(*pieces.at(piece.id));
    }
    digest.add(field.hash());
  }
  digest.print("islands");
}

/// A cliff of gravel at the foot of a hill, as far as it slides.
void print_slides() {
  const TerrainSource source{TerrainKind::noise, 5, 0.25F};
  MapField field(source);
  PieceTable pieces;
  const glm::vec3 foot(3.0F, ground_height_m(source, 3.0F, 2.0F), 2.0F);
  constexpr Material gravel{7};
  apply(FillOperation{box(foot + glm::vec3(0.0F, 1.0F, 0.0F), {1.3F, 2.1F, 1.7F}), gravel}, field, pieces);
  const VoxelCoord middle{12, static_cast<int>(foot.y / 0.25F), 8};
  const SlideOperation slide{
      {middle - VoxelCoord{16, 20, 16}, middle + VoxelCoord{16, 28, 16}}, gravel, 48, 2};
  GoldenHash digest;
  for (int i = 0; i < 12; ++i) {
    digest.add(static_cast<uint64_t>(apply(slide, field, pieces).changed.size()));
    digest.add(field.hash());
  }
  digest.print("slides");
}

/// Carves, fills, and stamps or discards what was carved, through apply() alone, as a session does: one of
/// before voxels had materials, whose recordings must stay what they are.
void print_session(TerrainKind kind) {
  const TerrainSource source{kind, 3, 0.25F};
  MapField field(source);
  PieceTable pieces;
  Random random(41);
  GoldenHash digest;
  PieceId next_piece = 1;
  for (int round = 0; round < 6; ++round) {
    const glm::vec2 at{random.unit() * 12.0F - 6.0F, random.unit() * 12.0F - 6.0F};
    const glm::vec3 ground(at.x, ground_height_m(source, at.x, at.y), at.y);
    const Applied carved = apply(CarveOperation{sphere(ground, 1.5F + random.unit()), SeedPattern::radial, 12,
                                                random.next(), ground, next_piece},
                                 field, pieces);
    next_piece += static_cast<PieceId>(carved.created.size());
    digest.add(static_cast<uint64_t>(carved.terrain_gain));
    digest.add(static_cast<uint64_t>(carved.dust));
    apply(FillOperation{capsule(ground, ground + glm::vec3(2.0F, 1.0F, 0.5F), 0.7F)}, field, pieces);
    while (pieces.size() > 3) {
      const PieceId id = pieces.begin()->first;
      if (random.below(8) == 0)
        apply(DiscardOperation{id}, field, pieces);
      else
        apply(StampOperation{id,
                             some_pose(ground, random),
                             static_cast<int32_t>(random.below(32)) - 8,
                             StampMethod::stamp,
                             {},
                             Brings::nothing},
              field, pieces);
      digest.add(field.hash());
    }
  }
  digest.print("session_" + std::string(name_of(kind)));
}

}  // namespace
}  // namespace scree

int main() {
  scree::print_generate();
  scree::print_heights();
  scree::print_edits();
  scree::print_redistance();
  scree::print_sample();
  scree::print_poses();
  scree::print_fracture();
  scree::print_polygon_cutters();
  scree::print_stamp(scree::StampMethod::stamp, "stamp");
  scree::print_stamp(scree::StampMethod::slices, "slices");
  scree::print_stamp(scree::StampMethod::sphere, "sphere");
  scree::print_stamp(scree::StampMethod::facets, "facets");
  scree::print_seed_patterns();
  scree::print_shatter(scree::Cutter::field, "shatter");
  scree::print_shatter(scree::Cutter::slice, "shatter_slice");
  scree::print_shatter(scree::Cutter::conform, "shatter_conform");
  for (const scree::Cutter cutter : scree::all_kinds<scree::Cutter>) scree::print_natural(cutter);
  scree::print_islands();
  scree::print_slides();
  for (const auto kind : {scree::TerrainKind::flat, scree::TerrainKind::noise, scree::TerrainKind::canyon})
    scree::print_session(kind);
  scree::print_materials();
  scree::print_queries();
  return 0;
}
