// MagicaVoxel files that are cut short, too large, or whose nodes go round: each is refused in words.
#include <gtest/gtest.h>

#include "tests/support/vox_bytes.h"
#include "tools/import/vox/limits.h"
#include "tools/import/vox/vox_bricks.h"

namespace scree {
namespace {

Result<VoxBricks> read(const std::string& file) {
  const auto scene = parse_vox({reinterpret_cast<const uint8_t*>(file.data()), file.size()});
  return scene ? placed_voxels(*scene) : tl::unexpected(scene.error());
}

std::string refusal(const std::string& file) {
  const auto bricks = read(file);
  return bricks ? std::string() : bricks.error().message;
}

void expect_refusal(const std::string& file, const std::string& words) {
  const std::string said = refusal(file);
  EXPECT_NE(said.find(words), std::string::npos) << "'" << said << "' is without '" << words << "'";
}

VoxBytes with_model() {
  VoxBytes vox;
  vox.model({3, 4, 5}, {{0, 0, 0, 1}, {2, 3, 4, 255}});
  return vox;
}

VoxBytes whole_scene() {
  VoxBytes vox = with_model();
  vox.transform(0, 1, {});
  vox.group(1, {2});
  vox.transform(2, 3, {{"_r", "17"}, {"_t", "-3 40 -100"}}, {{"_name", "part"}}, 0);
  vox.shape(3, 0);
  vox.chunk("RGBA", std::string(1024, '\x7F'));
  vox.chunk("LAYR", VoxBytes::number(0) + VoxBytes::attributes({{"_name", "one"}}) + VoxBytes::number(-1));
  vox.chunk("NOTE", VoxBytes::number(1) + VoxBytes::number(5) + "bones");
  vox.chunk("MATL", VoxBytes::number(255) + VoxBytes::attributes({{"_name", "glass"}}));
  vox.chunk("rOBJ", "of how it is drawn");
  return vox;
}

TEST(HostileVox, a_file_cut_at_any_byte_is_refused_in_words) {
  const std::string whole = whole_scene().file(200);
  EXPECT_EQ(refusal(whole), "");
  for (size_t at = 0; at < whole.size(); ++at) {
    const std::string said = refusal(whole.substr(0, at));
    EXPECT_NE(said, "") << "cut at " << at;
  }
}

/// What is changed may still be a file; it never does more than be read.
TEST(HostileVox, a_file_with_any_byte_changed_is_read_or_refused) {
  const std::string whole = whole_scene().file();
  for (size_t at = 0; at < whole.size(); ++at)
    for (const char to : {'\x00', '\x01', '\x7F', '\x80', '\xFF'}) {
      std::string changed = whole;
      changed[at] = to;
      const auto bricks = read(changed);
      EXPECT_TRUE(bricks || !bricks.error().message.empty()) << at;
    }
}

TEST(HostileVox, foreign_files_and_other_versions_are_named) {
  expect_refusal("", "not a MagicaVoxel file");
  expect_refusal("solid cube", "not a MagicaVoxel file");
  expect_refusal(with_model().file(99), "version 99");
  expect_refusal(VoxBytes().file(), "no model");
  std::string no_main = with_model().file();
  no_main[8] = 'X';
  expect_refusal(no_main, "main chunk");
}

TEST(HostileVox, models_that_are_none_are_named) {
  VoxBytes vox;
  vox.model({257, 1, 1}, {});
  expect_refusal(vox.file(), "limits.vox_side_max");
  vox = {};
  vox.model({0, 1, 1}, {});
  expect_refusal(vox.file(), "limits.vox_side_max");
  vox = {};
  vox.model({1, 1, 1}, {{1, 0, 0, 3}});
  expect_refusal(vox.file(), "outside of its model");
  vox = {};
  vox.model({1, 1, 1}, {{0, 0, 0, 0}});
  expect_refusal(vox.file(), "colour 0");
  vox = {};
  vox.chunk("XYZI", VoxBytes::number(0));
  expect_refusal(vox.file(), "no size");
  vox = with_model();
  vox.chunk("SIZE", VoxBytes::number(1) + VoxBytes::number(1) + VoxBytes::number(1));
  expect_refusal(vox.file(), "no voxels");
  vox = {};
  vox.chunk("SIZE", VoxBytes::number(1) + VoxBytes::number(1) + VoxBytes::number(1));
  vox.chunk("XYZI", VoxBytes::number(0x7FFFFFFF));
  EXPECT_NE(refusal(vox.file()), "") << "voxels that are promised take no memory";
}

TEST(HostileVox, nodes_that_go_round_or_nowhere_are_named) {
  VoxBytes vox = with_model();
  vox.transform(0, 1, {});
  vox.group(1, {0});
  expect_refusal(vox.file(), "node 0 is below itself");
  vox = with_model();
  for (int i = 0; i < 70; ++i) vox.group(i, {i + 1});
  vox.shape(70, 0);
  expect_refusal(vox.file(), "its nodes are nested more than 64 deep (limits.vox_depth_max)");
  vox = with_model();
  vox.transform(0, 7, {});
  expect_refusal(vox.file(), "node 7");
  vox = with_model();
  vox.transform(0, 1, {});
  vox.shape(1, 1);
  expect_refusal(vox.file(), "names model 1, and has 1");
  vox = with_model();
  vox.shape(1, 0);
  expect_refusal(vox.file(), "none of number 0");
  vox = with_model();
  vox.shape(0, 0);
  vox.shape(0, 0);
  expect_refusal(vox.file(), "one number");
}

/// Each group has the next one twice.
TEST(HostileVox, copies_without_end_are_refused_in_bounded_time) {
  VoxBytes vox = with_model();
  for (int i = 0; i < 40; ++i) vox.group(i, {i + 1, i + 1});
  vox.shape(40, 0);
  expect_refusal(vox.file(), "limits.vox_visits_max");
  VoxBytes far = with_model();
  for (int i = 0; i < 40; ++i) far.transform(i, i + 1, {{"_t", "1000000 0 0"}});
  far.shape(40, 0);
  expect_refusal(far.file(), "limits.vox_far_max");
}

TEST(HostileVox, turns_and_places_that_are_none_are_named) {
  for (const char* turn : {"5", "3", "128", "-4", "x", ""}) {
    VoxBytes vox = with_model();
    vox.transform(0, 1, {{"_r", turn}});
    vox.shape(1, 0);
    expect_refusal(vox.file(),
                   "node 0: its attribute _r is '" + std::string(turn) + "', which is not a turn");
  }
  for (const char* place : {"1 2", "1 2 3 4", "a b c", "", "99999999 0 0"}) {
    VoxBytes vox = with_model();
    vox.transform(0, 1, {{"_t", place}});
    vox.shape(1, 0);
    expect_refusal(vox.file(), "node 0: its attribute _t is '" + std::string(place) + "', which is ");
  }
}

}  // namespace
}  // namespace scree
