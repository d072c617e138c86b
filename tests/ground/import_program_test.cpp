// scree-import as a program: what it writes never takes the place of what it reads, and its exit status.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/run_program.h"
#include "tests/support/test_folder.h"

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

TEST_F(ImportProgram, prints_names_that_are_no_text) {
  const auto [code, said] = run(hill_ + " -o " + (folder_ / "hill_\xFF.ground"));
  EXPECT_EQ(code, 0) << said;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "hill_\xFF.ground"));
}

}  // namespace
}  // namespace scree
