// scree-import as a program: what it writes never takes the place of what it reads, and its exit status.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "ground/ground_file.h"
#include "tests/support/run_program.h"
#include "tests/support/test_folder.h"
#include "tests/support/vox_bytes.h"

namespace scree {
namespace {

class ImportProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::copy_file(SCREE_SOURCE_DIR "/tests/data/rasters/south_up.tif", hill_);
    bytes_ = std::filesystem::file_size(hill_);
  }
  static std::pair<int, std::string> run(const std::string& arguments) {
    return run_program(std::string(SCREE_IMPORT_PROGRAM) + " " + arguments);
  }
  void expect_one_file(const std::string& arguments) const {
    const auto [code, said] = run(arguments);
    EXPECT_EQ(code, 1) << said;
    EXPECT_NE(said.find("are one file"), std::string::npos) << said;
  }

  TestFolder folder_;
  const std::string hill_ = folder_ / "hill.tif";
  uintmax_t bytes_ = 0;
};

TEST_F(ImportProgram, never_writes_over_what_it_reads) {
  const std::string ground = folder_ / "hill.ground", house = folder_ / "house.obj";
  std::filesystem::copy_file(SCREE_SOURCE_DIR "/tests/data/import/house_one.obj", house);
  expect_one_file(hill_ + " -o " + (folder_ / "./hill.tif"));
  expect_one_file(hill_ + " -o " + ground + " --preview " + hill_);
  expect_one_file(hill_ + " -o " + ground + " --preview " + ground);
  expect_one_file(house + " -o " + house);
  EXPECT_EQ(std::filesystem::file_size(hill_), bytes_);
  EXPECT_EQ(run(hill_ + " -o " + ground).first, 0);
  expect_one_file(house + " -o " + ground + " --on " + ground);
}

TEST_F(ImportProgram, takes_a_palette_a_map_and_voxels) {
  VoxBytes vox;
  vox.model({2, 1, 1}, {{0, 0, 0, 1}, {1, 0, 0, 2}});
  std::ofstream(folder_ / "a.vox", std::ios::binary) << vox.file();
  std::ofstream(folder_ / "p.toml") << "[ground]\nbulk = \"chalk\"\nsoil = \"chalk\"\ncap = \"chalk\"\n"
                                       "[[material]]\nname = \"chalk\"\n[[material]]\nname = \"flint\"\n";
  std::ofstream(folder_ / "m") << "1 = flint\n";
  const std::string ground = folder_ / "a.ground",
                    from = (folder_ / "a.vox") + " -o " + ground + " --level -9";
  const auto [code, said] =
      run(from + " --materials " + (folder_ / "p.toml") + " --material-map " + (folder_ / "m"));
  EXPECT_EQ(code, 0) << said;
  const auto file = GroundFile::open(ground);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ((*file)->palette()->names(),
            (std::vector<std::string_view>{"chalk", "flint", "chalk_rubble", "flint_rubble", "vox_2",
                                           "vox_2_rubble"}));
  const auto [refused, why] = run(from + " --material marble");
  EXPECT_EQ(refused, 1);
  EXPECT_NE(why.find("'marble' is no material of the palette; it has rock, soil, ice"), std::string::npos)
      << why;
  EXPECT_EQ(run(hill_ + " -o " + ground + " --cover " + hill_).first, 2) << "a cover needs a map";
}

TEST_F(ImportProgram, refuses_options_that_do_nothing) {
  const std::string mesh = SCREE_SOURCE_DIR "/tests/data/import/house_one.obj",
                    to = " -o " + (folder_ / "a.ground");
  std::ofstream(folder_ / "m") << "1 = snow\n";
  const std::string map = folder_ / "m";
  for (const auto& [arguments, words] :
       {std::pair(mesh + to + " --cover " + hill_ + " --cover-map " + map,
                  "--cover is only for elevation models"),
        std::pair(mesh + to + " --grid a", "--grid is only for OpenVDB files"),
        std::pair(hill_ + to + " --material rock", "--material is only for solids"),
        std::pair(hill_ + to + " --material-map " + map, "--material-map is only for solids"),
        std::pair(hill_ + to + " --palette 3", "--palette is only for meshes and MagicaVoxel files"),
        std::pair(hill_ + to + " --voxel-size 1", "--voxel-size is only for solids and for a cover")}) {
    const auto [code, said] = run(arguments);
    EXPECT_EQ(code, 1) << arguments;
    EXPECT_NE(said.find(words), std::string::npos) << said;
  }
}

/// A box of 400 m, whose surface is 42 million voxels: a second is not enough for it, and enough to read it.
TEST_F(ImportProgram, ends_at_its_limit_of_time_and_leaves_nothing) {
  const std::string box = folder_ / "box.obj", ground = folder_ / "box.ground";
  std::ofstream(box) << "v 0 0 0\nv 400 0 0\nv 400 400 0\nv 0 400 0\nv 0 0 400\nv 400 0 400\nv 400 400 400\n"
                        "v 0 400 400\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const auto [code, said] = run(box + " -o " + ground + " --voxel-size 0.15 --time-max 1 --memory-max 8192");
  EXPECT_EQ(code, 1) << said;
  EXPECT_NE(said.find("within 1 s (--time-max)"), std::string::npos) << said;
  for (const auto& left : std::filesystem::directory_iterator(folder_ / "."))
    EXPECT_EQ(left.path().filename().string().find(".ground"), std::string::npos) << left.path();
}

TEST_F(ImportProgram, refuses_numbers_that_are_none) {
  for (const char* option :
       {"--time-max=nan", "--cell=nan", "--zero=inf", "--voxel-size=-nan", "--level=inf", "--at=0,nan,0"}) {
    const auto [code, said] = run(hill_ + " -o " + (folder_ / "hill.ground") + " " + option);
    EXPECT_EQ(code, 2) << option << ": " << said;
  }
}

TEST_F(ImportProgram, prints_names_that_are_no_text) {
  const auto [code, said] = run(hill_ + " -o " + (folder_ / "hill_\xFF.ground"));
  EXPECT_EQ(code, 0) << said;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "hill_\xFF.ground"));
}

}  // namespace
}  // namespace scree
