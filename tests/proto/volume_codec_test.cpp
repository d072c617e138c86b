// Pieces of several materials as bytes: all that operations make is taken, and what no encoder writes is
// refused.
#include <gtest/gtest.h>

#include "proto/operation_codec.h"
#include "shared/base/random.h"
#include "shared/operation/operation.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/wire_samples.h"

namespace scree {
namespace {

/// The volume's voxels are of ice and soil in turns.
Volume mixed_volume() {
  Volume volume = samples::volume();
  volume.materials.box = volume.window.box;
  for (size_t i = 0; i < volume.window.codes.size(); ++i)
    volume.materials.each.push_back(i % 2 == 0 ? material::ice : material::soil);
  volume.masses = {{material::soil, 12000}, {material::ice, 345}};
  return volume;
}

std::string refusal_of(const Volume& volume) {
  const Result<Volume> decoded = decode_volume(encode_volume(volume));
  return decoded ? std::string() : decoded.error().message;
}

TEST(VolumeCodec, a_piece_of_several_materials_survives) {
  const Volume sent = mixed_volume();
  const Result<Volume> got = decode_volume(encode_volume(sent));
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_EQ(got->masses, sent.masses);
  EXPECT_EQ(got->materials.each, sent.materials.each);
  EXPECT_TRUE(got->materials.box == sent.materials.box);
}

TEST(VolumeCodec, a_list_of_one_material_is_refused) {
  Volume volume = mixed_volume();
  volume.masses = {{material::soil, volume.mass}};
  EXPECT_NE(refusal_of(volume).find("lists one material"), std::string::npos) << refusal_of(volume);
  volume.materials.each.clear();
  volume.materials.all = material::soil;
  EXPECT_NE(refusal_of(volume).find("lists one material"), std::string::npos) << refusal_of(volume);
}

struct Found {
  size_t mixed = 0;
  size_t masses_elsewhere = 0;  ///< have mass of a material that none of their voxels is of
};

void expect_taken(const PieceTable& pieces, Found& found) {
  for (const auto& [id, volume] : pieces) {
    const Result<Volume> got = decode_volume(encode_volume(*volume));
    ASSERT_TRUE(got) << got.error().message;
    EXPECT_EQ(got->masses, volume->masses);
    if (volume->masses.empty()) continue;
    ++found.mixed;
    const auto& each = volume->materials.each;
    for (const MaterialMass& one : volume->masses)
      if (std::ranges::find(each, one.material) == each.end()) {
        ++found.masses_elsewhere;
        break;
      }
  }
}

/// Balls and patches of any material.
TEST(VolumeCodec, every_piece_that_operations_make_is_taken) {
  Found found;
  Random random(5);
  for (int round = 0; round < 6; ++round) {
    MapField field(flat_terrain);
    PieceTable pieces;
    for (int i = 0; i < 12; ++i) {
      const glm::vec3 at(random.unit() * 6.0F, random.unit() * 3.0F, random.unit() * 6.0F);
      apply(FillOperation{sphere(at, 0.4F + random.unit()), static_cast<Material>(random.below(12))}, field,
            pieces);
      apply(PaintOperation{sphere(at, 0.3F), static_cast<Material>(random.below(12))}, field, pieces);
    }
    PieceId next = 1;
    for (const Cutter cutter : all_kinds<Cutter>) {
      const glm::vec3 at(random.unit() * 6.0F, random.unit() * 3.0F, random.unit() * 6.0F);
      apply(CarveOperation{.shape = sphere(at, 1.4F),
                           .seeds = 8,
                           .random_seed = next,
                           .impact_m = at,
                           .first_piece = next,
                           .cutter = cutter},
            field, pieces);
      next += 8;
    }
    expect_taken(pieces, found);
    if (pieces.empty()) continue;
    const PieceId largest =
        std::ranges::max_element(pieces, {}, [](const auto& p) { return p.second->mass; })->first;
    apply(ShatterOperation{largest, SeedPattern::uniform, 6, 3, pieces.at(largest)->centre_voxels, 1000},
          field, pieces);
    expect_taken(pieces, found);
  }
  EXPECT_GT(found.mixed, 50U);
  EXPECT_GT(found.masses_elsewhere, 0U) << "what was cut beside a piece counts for some piece, too";
}

}  // namespace
}  // namespace scree
