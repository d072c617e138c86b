#include "client/viewer/session/model_loader.h"

#include <gtest/gtest.h>

#include "client/render/scene/limits.h"
#include "content/model/glb.h"
#include "tests/support/holds.h"
#include "tests/support/patience.h"
#include "tests/support/prop_world.h"
#include "tests/support/written_glb.h"

namespace scree {
namespace {

class ModelLoaderTest : public testing::Test {
 protected:
  void put(PieceId id, const Digest& model) {
    Prop prop = crate();
    prop.model = model;
    props_[id] = {std::make_shared<const Prop>(prop), {}};
  }
  /// Until nothing waits. Whether there are other meshes.
  bool follow() {
    bool is_new = loader_.follow(props_, [&](const Digest& model) {
      const auto found = files_.find(model);
      return found == files_.end() ? nullptr : std::make_shared<const std::vector<uint8_t>>(found->second);
    });
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (!loader_.complete(true) && std::chrono::steady_clock::now() < deadline) {
      wait_a_moment();
      is_new = loader_.follow(props_, [](const Digest&) { return nullptr; }) || is_new;
    }
    return is_new;
  }

  std::map<Digest, std::vector<uint8_t>> files_;
  SceneProps props_;
  WorkPool pool_{1};
  ModelLoader loader_{pool_, read_glb};
};

TEST_F(ModelLoaderTest, reads_what_has_come_and_tells_once_what_is_bad) {
  put(1, {1});
  put(2, {2});
  EXPECT_FALSE(follow());
  EXPECT_FALSE(loader_.complete(false)) << "files may come";
  EXPECT_TRUE(loader_.complete(true));
  files_[{1}] = box_glb({1, 0, 0}, {0.5F, 0.5F, 0.5F});
  files_[{2}] = {1, 2, 3};
  EXPECT_TRUE(follow());
  ASSERT_TRUE(loader_.meshes().contains({1}));
  EXPECT_EQ(loader_.meshes().at({1})->triangles(), 12U);
  EXPECT_FALSE(loader_.meshes().contains({2}));
  const std::vector<std::string> faults = loader_.drain_faults();
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_TRUE(holds(faults.front(), hex_of({2})) && holds(faults.front(), "no binary glTF"))
      << faults.front();
  EXPECT_FALSE(follow());
  EXPECT_TRUE(loader_.drain_faults().empty());
  EXPECT_TRUE(loader_.complete(false));
}

TEST_F(ModelLoaderTest, what_no_prop_has_makes_room) {
  // 4096 nodes of a mesh of 24 triangles are 1.6 MiB each.
  std::string nodes = R"({"children":[1)";
  for (int i = 2; i < 4096; ++i) nodes += "," + std::to_string(i);
  nodes += "]}";
  for (int i = 1; i < 4096; ++i) nodes += R"(,{"mesh":0})";
  std::string json = box_json({1, 0, 0});
  json.replace(json.find(R"({"mesh":0})"), 10, nodes);
  const std::vector<uint8_t> file = glb_of(json, box_buffer({0.5F, 0.5F, 0.5F}));
  const size_t bytes = read_glb(file)->bytes();
  const size_t most = limits::model_meshes_bytes_max / bytes;
  for (size_t i = 0; i <= most; ++i) {
    const Digest name{static_cast<uint8_t>(i), static_cast<uint8_t>(i >> 8U), 3};
    files_[name] = file;
    put(static_cast<PieceId>(i), name);
  }
  follow();
  EXPECT_EQ(loader_.meshes().size(), most);
  const auto faults = loader_.drain_faults();
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_TRUE(holds(faults.front(), "limits.model_meshes_bytes_max"));
  props_.clear();
  files_[{9, 9, 9}] = file;
  put(1, {9, 9, 9});
  EXPECT_TRUE(follow());
  EXPECT_EQ(loader_.meshes().size(), 1U);
  EXPECT_TRUE(loader_.meshes().contains({9, 9, 9}));
}

}  // namespace
}  // namespace scree
