// Meshes that lead to other files, and meshes that are nested, long or many beyond all use: each is refused
// by name in bounded time, and honest ones are read beside them.
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/holds.h"
#include "tests/support/test_folder.h"
#include "tests/support/written_gltf.h"
#include "tools/import/assimp/mesh_file.h"
#include "tools/import/files/solid_files.h"

namespace scree {
namespace {

const std::string one_node = R"([{"mesh":0}])";

class HostileMeshes : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_ / "given/parts");
    std::filesystem::create_directories(folder_ / "given/.hidden");
    for (const char* const name :
         {"secret.bin", "given/own.bin", "given/parts/own.bin", "given/.hidden/own.bin", "given/own.pem"})
      write_gltf_buffer(folder_ / name);
    std::filesystem::create_symlink(folder_ / "secret.bin", folder_ / "given/link.bin");
  }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / ("given/" + name), std::ios::binary) << text;
    return folder_ / ("given/" + name);
  }
  /// The refusal of the file; empty: it was read. A minute is a thousand times of what it takes.
  static std::string refusal(const std::string& path) {
    const auto began = std::chrono::steady_clock::now();
    const auto read = read_meshes(path, {}, {.time = std::chrono::minutes(1)});
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::minutes(1));
    return read ? std::string() : read.error().message;
  }
  std::string refusal(const std::string& name, const std::string& text) const {
    return refusal(write(name, text));
  }

  TestFolder folder_;
};

std::string repeated(const std::string& text, size_t times) {
  std::string all;
  all.reserve(text.size() * times);
  for (size_t i = 0; i < times; ++i) all += text;
  return all;
}

TEST_F(HostileMeshes, gltf_reads_buffers_of_its_own_folder_alone) {
  for (const char* const uri : {"own.bin", "./own.bin", "parts/own.bin", "parts/../own.bin"})
    EXPECT_EQ(refusal("a.gltf", gltf_of(one_node, uri)), "") << uri;
  const std::string secret = folder_ / "secret.bin";
  for (const std::string& uri : {std::string("../secret.bin"), std::string("../../../../../../etc/passwd"),
                                 std::string("parts/../../secret.bin"), std::string("link.bin"),
                                 std::string(".hidden/own.bin"), std::string("own.pem")}) {
    const std::string words = refusal("a.gltf", gltf_of(one_node, uri));
    EXPECT_TRUE(holds(words, "a.gltf: it names the file '")) << uri << ": " << words;
    EXPECT_TRUE(holds(words, "in its own folder")) << words;
  }
  EXPECT_NE(refusal("a.gltf", gltf_of(one_node, secret)), "") << "an absolute name is one within the folder";
}

TEST_F(HostileMeshes, obj_reads_materials_of_its_own_folder_alone) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  write("own.mtl", "newmtl rock\n");
  std::ofstream(folder_ / "secret.mtl") << "newmtl secret\n";
  EXPECT_EQ(refusal("a.obj", "mtllib own.mtl\nusemtl rock\n" + triangle), "");
  EXPECT_EQ(refusal("a.obj", "mtllib none.mtl\n" + triangle), "") << "colours are not needed";
  EXPECT_TRUE(holds(refusal("a.obj", "mtllib ../secret.mtl\n" + triangle), "it names the file '"));
  write("numbers.mtl", "newmtl rock\nKd 0.1 0.1 0.1\nKd\n");
  EXPECT_TRUE(holds(refusal("a.obj", "mtllib numbers.mtl\n" + triangle),
                    "numbers.mtl:3: 'Kd' stands without its numbers"));
}

TEST_F(HostileMeshes, a_file_is_read_as_its_name_says) {
  EXPECT_NE(refusal("a.stl", gltf_of(one_node, "../secret.bin")), "");
  EXPECT_NE(refusal("a.obj", gltf_of(one_node, "own.bin")), "");
}

TEST_F(HostileMeshes, what_is_nested_too_deep_is_refused_by_name) {
  const auto chain = [](size_t nodes) {
    std::string all = "[";
    for (size_t i = 1; i < nodes; ++i) all += fmt::format(R"({{"children":[{}]}},)", i);
    return all + R"({"mesh":0}])";
  };
  EXPECT_EQ(refusal("a.gltf", gltf_of(chain(500), "own.bin")), "");
  EXPECT_TRUE(
      holds(refusal("a.gltf", gltf_of(chain(200'000), "own.bin")), "nodes are nested more than 512 deep"));
  EXPECT_TRUE(holds(refusal("a.gltf", repeated("[", 2'000'000)), "brackets are nested 2000000 deep"));
  EXPECT_TRUE(
      holds(refusal("a.gltf", R"({"extras":)" + repeated("{\"a\":", 200'000)), "brackets are nested"));
  const std::string json = gltf_of(chain(600), "own.bin");
  const std::string head("glTF\2\0\0\0\0\0\0\0\0\0\xF0\0JSON", 20);
  EXPECT_TRUE(holds(refusal("a.glb", head + json), "nested more than 512 deep"));
  const auto collada = [](const std::string& within) {
    return "<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\">" + within + "</COLLADA>";
  };
  const size_t deep = 300'000;
  const std::string nodes = repeated("<node>", deep) + repeated("</node>", deep);
  EXPECT_TRUE(holds(refusal("a.dae", collada(nodes)), "elements are nested 300001 deep"));
  EXPECT_TRUE(
      holds(refusal("a.dae", collada(repeated("<n a='/>'><!--</n>-->", deep))), "elements are nested"));
  EXPECT_TRUE(holds(refusal("a.dae", "<!DOCTYPE a [<!ENTITY b \"c\">]>" + collada("")), "document type"));
  EXPECT_TRUE(
      holds(refusal("a.fbx", "; FBX 7.4.0 project file\n" + repeated("A: {\n", deep)), "braces are nested"));
}

TEST_F(HostileMeshes, records_of_binary_fbx_are_counted) {
  const size_t deep = 100'000, head = 13;
  std::string file("Kaydara FBX Binary  \0\x1A\0\xE8\x1C\0\0", 27);
  const auto end = static_cast<uint32_t>(file.size() + 2 * deep * head);
  std::string record(head, '\0');
  std::memcpy(record.data(), &end, sizeof end);
  file += repeated(record, deep) + std::string(deep * head, '\0');
  EXPECT_TRUE(holds(refusal("a.fbx", file), "records are nested 100000 deep"));
}

TEST_F(HostileMeshes, nodes_of_gltf_are_neither_a_circle_nor_without_number) {
  EXPECT_TRUE(holds(refusal("a.gltf", gltf_of(R"([{"children":[1]},{"children":[0],"mesh":0}])", "own.bin")),
                    "in a circle"));
  std::string doubled = "[";
  for (int i = 1; i < 60; ++i) doubled += fmt::format(R"({{"children":[{},{}]}},)", i, i);
  EXPECT_TRUE(holds(refusal("a.gltf", gltf_of(doubled + R"({"mesh":0}])", "own.bin")),
                    "come to more than 1048576 (limits.scene_nodes_max)"));
}

TEST_F(HostileMeshes, a_polygon_has_at_most_so_many_corners) {
  const auto polygon = [](int corners, int times) {
    std::string all, face = "f";
    for (int i = 0; i < corners; ++i) {
      all += fmt::format("v {:.4f} {:.4f} 0\n", std::cos(i * 2.0 * M_PI / corners),
                         std::sin(i * 2.0 * M_PI / corners));
      face += fmt::format(" {}", i + 1);
    }
    for (int i = 0; i < times; ++i) all += face + "\n";
    return all;
  };
  EXPECT_EQ(refusal("a.obj", polygon(1000, 1)), "");
  EXPECT_TRUE(holds(refusal("a.obj", polygon(100'000, 1)), "a polygon of 100000 corners: at most 10000"));
  EXPECT_TRUE(holds(refusal("a.obj", polygon(9'000, 6)), "limits.polygon_work_max"));
}

TEST_F(HostileMeshes, loose_triangles_are_refused_at_once_whatever_the_rule_of_sheets) {
  std::string all;
  for (int i = 0; i < 10'000; ++i) {
    const int x = i % 100, z = i / 100;
    all += fmt::format("v {} {} {}\nv {} {} {}\nv {} {} {}\nf -3 -2 -1\n", x, i % 7, z, x, i % 7, z + 0.9,
                       x + 0.9, i % 5, z);
  }
  const std::string path = write("loose.obj", all);
  const auto words = [&](SheetRule rule) {
    const auto read = read_solids({path}, {.sheet = rule, .reader = {.time = std::chrono::minutes(1)}});
    return read ? std::string() : read.error().message;
  };
  EXPECT_TRUE(holds(words(SheetRule::refuse), "10000 of its 10000 parts are open sheets"));
  EXPECT_TRUE(holds(words(SheetRule::down), "more than 4096 of its parts are open sheets"));
  EXPECT_TRUE(holds(words(SheetRule::close), "more than 4096 of its parts have holes"));
  EXPECT_TRUE(holds(words(SheetRule::drop), "nothing of it is left"));
}

TEST_F(HostileMeshes, a_pipe_is_no_file) {
  for (const char* const name : {"a.obj", "a.ply", "a.vdb"}) {
    const std::string pipe = folder_ / (std::string("given/") + name);
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const auto read = read_solids({pipe}, {});
    ASSERT_FALSE(read);
    EXPECT_TRUE(holds(read.error().message, "it is a pipe, not a file")) << read.error().message;
  }
}

}  // namespace
}  // namespace scree
