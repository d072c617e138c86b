// Kernels on terrain and pieces of several materials.
#include "shared/operation/operation.h"
#include "tests/determinism/golden.h"

namespace scree {
namespace {

void add(const Volume& volume, GoldenHash& digest) {
  digest.add(volume);
  for (size_t i = 0; i < volume.window.codes.size(); ++i)
    digest.add(uint64_t{row_number(volume.materials.at(i))});
  for (const MaterialMass& one : masses_of(volume)) {
    digest.add(uint64_t{row_number(one.material)});
    digest.add(static_cast<uint64_t>(one.mass));
  }
}

/// Rubble of the first twelve rows, in the rows after them, with fills of several sizes.
RubbleRows some_rubble() {
  RubbleRows rows;
  rows.any = true;
  for (size_t i = 0; i < 12; ++i) {
    rows.rubble[i] = static_cast<Material>(12 + i);
    rows.stones[12 + i] = static_cast<Material>(i);
    rows.fill[12 + i] = static_cast<uint8_t>(i % 3 == 0 ? 79 : 70 + i);
  }
  return rows;
}

/// A wall of two materials on soil: carved, broken, merged by each method, painted, with all that follows.
void print_materials(TerrainKind kind, const Rubble& rubble, const std::string& name) {
  TerrainSource source{kind, 3, 0.25F};
  source.rubble = rubble;
  MapField field(source);
  PieceTable pieces;
  Random random(43);
  GoldenHash digest;
  PieceId next_piece = 1;
  constexpr Material brick{7}, concrete{6}, glass{9};
  for (const StampMethod method : all_kinds<StampMethod>) {
    const float x_m = 11.0F * static_cast<float>(method);
    const glm::vec3 foot(x_m, ground_height_m(source, x_m, 1.0F), 1.0F);
    apply(FillOperation{box(foot, {2.0F, 2.1F, 0.6F}), brick}, field, pieces);
    apply(FillOperation{box(foot + glm::vec3(0.0F, 2.3F, 0.0F), {2.0F, 0.4F, 0.6F}), concrete}, field,
          pieces);
    apply(PaintOperation{sphere(foot + glm::vec3(0.6F, 1.0F, 0.0F), 0.7F), glass}, field, pieces);
    const glm::vec3 blow = foot + glm::vec3(0.2F, 1.0F, 0.4F);
    const Applied carved =
        apply(CarveOperation{sphere(blow, 1.7F), SeedPattern::radial, 9, random.next(), blow, next_piece},
              field, pieces);
    next_piece += 9;
    for (const CreatedPiece& piece : carved.created) add(*pieces.at(piece.id), digest);
    const PieceId broken = pieces.begin()->first;
    apply(ShatterOperation{broken, SeedPattern::uniform, 3, 7, pieces.at(broken)->centre_voxels, next_piece},
          field, pieces);
    next_piece += 3;
    while (!pieces.empty()) {
      const PieceId id = pieces.begin()->first;
      const Applied merged = apply(
          StampOperation{id, some_pose(blow, random), static_cast<int32_t>(random.below(32)) - 8, method},
          field, pieces);
      for (const MaterialFlow& flow : merged.flows) {
        digest.add(uint64_t{row_number(flow.material)});
        digest.add(static_cast<uint64_t>(flow.terrain));
      }
      digest.add(field.hash());
    }
  }
  digest.print(name + "_" + std::string(name_of(kind)));
}

}  // namespace

void print_materials() {
  for (const TerrainKind kind : {TerrainKind::flat, TerrainKind::noise, TerrainKind::canyon})
    print_materials(kind, Rubble(), "materials");
  for (const TerrainKind kind : {TerrainKind::flat, TerrainKind::canyon})
    print_materials(kind, Rubble(some_rubble()), "rubble");
}

}  // namespace scree
