// Sentences of imports of solids that once were untrue, each with a file of its kind.
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/holds.h"
#include "tests/support/test_folder.h"
#include "tools/import/files/solid_files.h"

namespace scree {
namespace {

class ImportWords : public ::testing::Test {
 protected:
  std::string written(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  /// All that is said, or the refusal.
  static std::string words(const std::string& path, const SolidsImport& how = {}) {
    const auto read = read_solids({path}, how);
    if (!read) return read.error().message;
    std::string said;
    for (const std::string& line : read->said) said += line + "\n";
    return said;
  }

  TestFolder folder_;
};

TEST_F(ImportWords, letters_of_two_bytes_are_named) {
  const std::string box = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
  for (const bool little : {false, true}) {
    std::string wide = little ? "\xFF\xFE" : "\xFE\xFF";
    for (const char letter : box) {
      if (!little) wide += '\0';
      wide += letter;
      if (little) wide += '\0';
    }
    for (const std::string& bytes : {wide, wide.substr(2)}) {
      const std::string said = words(written("wide.obj", bytes));
      EXPECT_TRUE(holds(said, "its letters are not UTF-8")) << said;
    }
  }
}

TEST_F(ImportWords, a_file_without_any_surface_holds_no_sheets) {
  const std::string said = words(written("none.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n"));
  EXPECT_FALSE(holds(said, "--sheet")) << said;
  EXPECT_TRUE(holds(said, "none of its triangles has an area")) << said;
}

TEST_F(ImportWords, a_sheet_that_encloses_nothing_is_not_said_to_lie_in_the_ground) {
  const auto read = read_solids({written("plane.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 4 3 2\n")},
                                {.sheet = SheetRule::close});
  ASSERT_TRUE(read) << read.error().message;
  const auto made = import_bricks(read->solids, folder_ / "plane.ground", {}, [](double) {});
  ASSERT_FALSE(made);
  EXPECT_TRUE(holds(made.error().message, "hold no rock of it")) << made.error().message;
}

TEST_F(ImportWords, rock_around_what_encloses_nothing_is_no_percentage) {
  SolidsRead read;
  read.meshes = read.parts = 2;
  read.meshes_volume_m3 = 1.0e-15;
  EXPECT_TRUE(holds(words_on_difference(read, 32.0).value_or(""), "the meshes enclose none by themselves"));
  read.meshes_volume_m3 = 30.0;
  EXPECT_TRUE(holds(words_on_difference(read, 32.0).value_or(""), "6.7 % more than the meshes"));
  read.meshes = read.parts = 0;
  read.volumes = 1;
  read.meshes_volume_m3 = 0.0;
  read.volumes_volume_m3 = 40.0;
  EXPECT_TRUE(holds(words_on_difference(read, 32.0).value_or(""), "20 % less than the volumes' voxels"));
}

TEST_F(ImportWords, faces_that_assimp_leaves_out_are_said) {
  const std::string gltf =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
      R"({"attributes":{"POSITION":1},"indices":0}]}],"accessors":[{"bufferView":0,"componentType":5123,)"
      R"("count":6,"type":"SCALAR"},{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3","min":[0,)"
      R"(0,0],"max":[1,0,1]}],"bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,)"
      R"("byteLength":36}],"buffers":[{"byteLength":48,"uri":"data:application/octet-stream;base64,)"
      R"(AAABAAIAAAACAAkAAAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/"}]})";
  const std::string said = words(written("face.gltf", gltf), {.sheet = SheetRule::close});
  EXPECT_TRUE(holds(said, "assimp warns: Some faces had out-of-range indices")) << said;
}

}  // namespace
}  // namespace scree
