// Imports of meshes and of OpenVDB files: volumes against the meshes' own, what is repaired and said, exports
// that come back the same, and bad files.
#include "tools/import/files/solid_files.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

#include "shared/field/material_window.h"
#include "tests/support/box_solid.h"
#include "tests/support/test_folder.h"
#include "tools/export/mesh_export.h"
#include "tools/export/vdb/vdb_export.h"
#include "tools/import/mesh/triangle_mesh.h"

namespace scree {
namespace {

constexpr double torus_m3 = 2.0 * std::numbers::pi * std::numbers::pi * 6.0 * 2.0 * 2.0;

/// A ring of radius 6 m around the y axis, as thick as said; inside out if wanted.
TriangleMesh torus(double thick_m, bool inverted = false) {
  TriangleMesh mesh;
  constexpr uint32_t n = 64, m = 48;
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t j = 0; j < m; ++j) {
      const double a = 2.0 * std::numbers::pi * i / n, b = 2.0 * std::numbers::pi * j / m;
      const double r = 6.0 + thick_m * std::cos(b);
      mesh.points.emplace_back(r * std::cos(a), 10.0 + thick_m * std::sin(b), r * std::sin(a));
    }
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    mesh.triangles.push_back(inverted ? std::array{c, b, a} : std::array{a, b, c});
  };
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t j = 0; j < m; ++j) {
      const uint32_t a = i * m + j, b = (i + 1) % n * m + j, c = (i + 1) % n * m + (j + 1) % m,
                     d = i * m + (j + 1) % m;
      add(a, d, c);
      add(a, c, b);
    }
  return mesh;
}

TriangleMesh block(glm::dvec3 lo, glm::dvec3 hi) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.emplace_back((i & 4) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y,
                             (i & 1) != 0 ? hi.z : lo.z);
  for (const auto& [a, b, c, d] : std::initializer_list<std::array<uint32_t, 4>>{
           {0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

void add_mesh(TriangleMesh& to, const TriangleMesh& more) {
  const auto first = static_cast<uint32_t>(to.points.size());
  to.points.insert(to.points.end(), more.points.begin(), more.points.end());
  for (const auto& t : more.triangles) to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

class SolidFiles : public ::testing::Test {
 protected:
  std::string written(const std::string& name, const std::vector<TriangleMesh>& meshes) const {
    std::ofstream out(folder_ / name);
    size_t first = 1;
    for (const TriangleMesh& mesh : meshes) {
      out << "o part" << first << "\n";
      for (const auto& p : mesh.points) out << fmt::format("v {} {} {}\n", p.x, p.y, p.z);
      for (const auto& t : mesh.triangles)
        out << fmt::format("f {} {} {}\n", t[0] + first, t[1] + first, t[2] + first);
      first += mesh.points.size();
    }
    return folder_ / name;
  }
  BricksImported import(const SolidsRead& read, const std::string& name) const {
    BricksImport how{.level_m = read.level_m.value_or(0.0), .layers = read.layers, .exact = read.exact};
    const auto imported = import_bricks(read.solids, folder_ / name, how, [](double) {});
    EXPECT_TRUE(imported) << imported.error().message;
    return imported ? *imported : BricksImported{};
  }
  double volume_of(const std::vector<TriangleMesh>& meshes, const std::string& said) const {
    const auto read = read_solids({written("mesh.obj", meshes)}, {});
    EXPECT_TRUE(read) << read.error().message;
    std::string all;
    for (const std::string& line : read->said) all += line + "\n";
    EXPECT_NE(all.find(said), std::string::npos) << all;
    return import(*read, "mesh.ground").volume_m3;
  }
  std::string refusal(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    const auto read = read_solids({folder_ / name}, {});
    return read ? std::string("none") : read.error().message;
  }

  TestFolder folder_;
};

TEST_F(SolidFiles, meshes_have_their_own_volume_within_a_hundredth) {
  EXPECT_NEAR(volume_of({torus(2.0)}, ", closed, 471"), torus_m3, 0.01 * torus_m3);
  TriangleMesh shell = torus(2.0);
  add_mesh(shell, torus(1.5, true));
  const double shell_m3 = torus_m3 * (1.0 - 1.5 * 1.5 / 4.0);
  EXPECT_NEAR(volume_of({shell}, "closed"), shell_m3, 0.01 * shell_m3) << "0.5 m thick, hollow";
  const TriangleMesh a = block({-5, 3, -5}, {5, 9, 5}), b = block({0, 4, 0}, {8, 12, 8});
  EXPECT_NEAR(volume_of({a, b}, "closed"), 987.0, 9.87) << "they overlap by 125 m³";
  TriangleMesh both = a;
  add_mesh(both, b);
  EXPECT_NEAR(volume_of({both}, "closed"), 987.0, 9.87) << "as one mesh, too";
}

TEST_F(SolidFiles, meshes_inside_out_or_with_holes_are_repaired_and_named) {
  EXPECT_NEAR(volume_of({torus(2.0, true)}, "1 of 1 parts had their inside outside"), torus_m3,
              0.01 * torus_m3);
  TriangleMesh holes = torus(2.0);
  holes.triangles.erase(holes.triangles.begin() + 3000, holes.triangles.begin() + 3040);
  holes.triangles.erase(holes.triangles.begin() + 200, holes.triangles.begin() + 260);
  EXPECT_NEAR(volume_of({holes}, "not closed: 104 open edges"), torus_m3, 0.01 * torus_m3);
}

TEST_F(SolidFiles, blocks_that_touch_become_one_without_a_seam) {
  const double together = volume_of({block({0, 3, 0}, {4, 7, 4}), block({4, 3, 0}, {8, 7, 4})}, "closed");
  EXPECT_NEAR(together, 128.0, 1.28);
  const auto file = GroundFile::open(folder_ / "mesh.ground");
  ASSERT_TRUE(file);
  MapField field({.heights = *file});
  EXPECT_EQ(field.brick(brick_of(VoxelCoord{16, 20, 8})).codes[static_cast<size_t>(Brick::index(0, 4, 0))],
            code_solid)
      << "the face between them is deep inside";
}

TEST_F(SolidFiles, what_is_exported_comes_back_as_the_same_ground) {
  const auto hills = written_ground(folder_ / "hills.ground", 30, 20, 2.0F);
  TriangleMesh soil = torus(2.0);
  const auto first = read_solids({written("soil.obj", {soil, block({-20, 3, -20}, {-14, 9, -12})})}, {});
  ASSERT_TRUE(first);
  const Digest name = name_of(import(*first, "first.ground").header);
  const auto file = GroundFile::open(folder_ / "first.ground");
  ASSERT_TRUE(file);
  MapField field({.heights = *file});
  const auto box = whole_of(field);
  ASSERT_TRUE(box);
  const auto exported = export_vdb(field, builtin_palette(), *box, folder_ / "world.vdb", [](double) {});
  ASSERT_TRUE(exported) << exported.error().message;
  EXPECT_GT(exported->active_voxels, 10'000U);
  const auto back = read_solids({folder_ / "world.vdb"}, {});
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_TRUE(back->exact.has_value());
  EXPECT_EQ(name_of(import(*back, "second.ground").header), name);
  // Elsewhere, it is sampled: a volume alike, not the same codes.
  SolidsImport moved;
  moved.place.at_m = {0.1, 0.07, 0.03};
  const auto resampled = read_solids({folder_ / "world.vdb"}, moved);
  ASSERT_TRUE(resampled && !resampled->exact);
}

TEST_F(SolidFiles, an_export_that_cuts_level_rock_comes_back_as_the_same_file) {
  const auto first = read_solids({written("hut.obj", {block({-4, -2, -3}, {4, 5, 3})})}, {});
  ASSERT_TRUE(first);
  const Digest name = name_of(import(*first, "first.ground").header);
  const auto file = GroundFile::open(folder_ / "first.ground");
  ASSERT_TRUE(file);
  MapField field({.heights = *file});
  const auto box = whole_of(field);
  ASSERT_TRUE(box && box->lo.y < 0);
  ASSERT_TRUE(export_vdb(field, builtin_palette(), *box, folder_ / "hut.vdb", [](double) {}));
  const auto back = read_solids({folder_ / "hut.vdb"}, {});
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(name_of(import(*back, "second.ground").header), name);
}

TEST_F(SolidFiles, edits_and_paint_are_exported_with_the_ground) {
  const auto read = read_solids({written("block.obj", {block({-4, 3, -4}, {4, 11, 4})})}, {});
  ASSERT_TRUE(read);
  import(*read, "block.ground");
  const auto file = GroundFile::open(folder_ / "block.ground");
  ASSERT_TRUE(file);
  MapField field({.heights = *file});
  const BrickCoord hole{0, 3, 0}, painted{-1, 3, 0};
  field.set_brick(hole, air_brick());
  field.set_materials(painted, BrickMaterials(said(material::ice)));
  ASSERT_TRUE(export_vdb(field, builtin_palette(), *whole_of(field), folder_ / "edited.vdb", [](double) {}));
  const auto back = read_solids({folder_ / "edited.vdb"}, {});
  ASSERT_TRUE(back) << back.error().message;
  import(*back, "edited.ground");
  const auto edited = GroundFile::open(folder_ / "edited.ground");
  ASSERT_TRUE(edited);
  const TerrainSource source{.heights = *edited};
  MapField again(source);
  EXPECT_EQ(again.brick(hole), air_brick());
  for_each_chunk(whole_of(field)->voxels(), [&](ChunkCoord chunk) {
    for (int i = 0; i < 64; ++i)
      ASSERT_EQ(again.brick(brick_in_chunk(chunk, i)), field.brick(brick_in_chunk(chunk, i)));
  });
  EXPECT_EQ(material_at(again, {-0.5F, 6.5F, 0.5F}), material::ice);
}

TEST_F(SolidFiles, exported_meshes_are_closed_and_have_the_rock_s_volume) {
  const auto read = read_solids({written("ring.obj", {torus(2.0)})}, {});
  ASSERT_TRUE(read);
  import(*read, "ring.ground");
  const auto file = GroundFile::open(folder_ / "ring.ground");
  ASSERT_TRUE(file);
  MapField field({.heights = *file});
  const ChunkBox box = chunks_of({-15.9F, 0.1F, -15.9F}, {15.9F, 15.9F, 15.9F}, 0.25F);
  for (const char* name : {"out.ply", "out.obj"}) {
    const auto exported = export_mesh(field, builtin_palette(), box, folder_ / name, [](double) {});
    ASSERT_TRUE(exported) << exported.error().message;
    const auto back = read_solids({folder_ / name}, {});
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_NE(back->said.front().find(", closed"), std::string::npos) << back->said.front();
    EXPECT_NEAR(back->meshes_volume_m3, exported->volume_m3, 1e-3 * exported->volume_m3);
  }
}

TEST_F(SolidFiles, that_are_none_are_refused_in_words) {
  const auto says = [](const std::string& words, const char* part) {
    return words.find(part) != std::string::npos ? std::string() : words;
  };
  EXPECT_EQ(says(refusal("garbage.vdb", "this is no vdb file at all"), "not an OpenVDB file"), "");
  EXPECT_EQ(says(refusal("empty.vdb", ""), "not an OpenVDB file"), "");
  EXPECT_EQ(says(refusal("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "triangle"), "");
  EXPECT_EQ(says(refusal("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "not a number"), "");
  EXPECT_EQ(says(refusal("huge.obj",
                         "v 0 0 0\nv 1e6 0 0\nv 0 1e6 0\nv 0 0 1e6\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n"),
                 "limits.world_half_width_m"),
            "");
  EXPECT_EQ(says(refusal("text.ply", "ply\nformat ascii 1.0\nelement vertex 99999999999\nend_header\n"),
                 "promises more 'vertex'"),
            "");
  const auto none = read_solids({folder_ / "missing.stl"}, {});
  EXPECT_FALSE(none);
}

TEST_F(SolidFiles, vdb_files_cut_short_anywhere_are_refused) {
  const auto read = read_solids({written("block.obj", {block({-4, 3, -4}, {4, 11, 4})})}, {});
  ASSERT_TRUE(read);
  import(*read, "block.ground");
  const auto file = GroundFile::open(folder_ / "block.ground");
  ASSERT_TRUE(file);
  MapField field({.heights = *file});
  ASSERT_TRUE(export_vdb(field, builtin_palette(), *whole_of(field), folder_ / "whole.vdb", [](double) {}));
  const uintmax_t size = std::filesystem::file_size(folder_ / "whole.vdb");
  for (uintmax_t cut = 0; cut < size; cut += size / 12) {
    std::filesystem::copy_file(folder_ / "whole.vdb", folder_ / "cut.vdb",
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(folder_ / "cut.vdb", cut);
    EXPECT_FALSE(read_solids({folder_ / "cut.vdb"}, {})) << "of " << cut << " bytes";
  }
}

}  // namespace
}  // namespace scree
