// Models of props: what is read of binary glTF, and what a hostile file costs, which is nothing.
#include "content/model/glb.h"

#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <utility>

#include "content/files/model_folder.h"
#include "content/limits.h"
#include "crypto/sha256.h"
#include "tests/support/holds.h"
#include "tests/support/test_folder.h"
#include "tests/support/written_glb.h"

namespace scree {
namespace {

constexpr std::array<float, 3> amber{0.64F, 0.25F, 0.0F}, unit_half{0.5F, 0.5F, 0.5F};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// The error of a box whose JSON has `to` in place of `from`.
std::string fault_of(const std::string& from, const std::string& to) {
  const auto mesh = read_glb(glb_of(replaced(box_json(amber), from, to), box_buffer(unit_half)));
  return mesh ? "" : mesh.error().message;
}

/// How many triangles look away from the origin.
size_t outward(const ModelMesh& mesh) {
  size_t count = 0;
  for (size_t i = 0; i < mesh.corners.size(); i += 3) {
    const glm::vec3 a = mesh.vertices[mesh.corners[i]].place_m,
                    b = mesh.vertices[mesh.corners[i + 1]].place_m,
                    c = mesh.vertices[mesh.corners[i + 2]].place_m;
    count += glm::dot(glm::cross(b - a, c - a), a + b + c) > 0.0F ? 1 : 0;
  }
  return count;
}

TEST(Glb, a_box_is_its_triangles_in_its_colour) {
  const auto mesh = read_glb(box_glb(amber, {0.5F, 1.0F, 0.25F}));
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->vertices.size(), 8U);
  EXPECT_EQ(mesh->triangles(), 12U);
  EXPECT_EQ(outward(*mesh), 12U);
  EXPECT_EQ(mesh->vertices[0].place_m, glm::vec3(-0.5F, -1.0F, -0.25F));
  EXPECT_EQ(mesh->vertices[0].colour, (std::array<uint8_t, 4>{204, 128, 0, 0}));
  EXPECT_EQ(mesh->vertices[0].normal, (std::array<int8_t, 4>{}));
  EXPECT_NEAR(mesh->reach_m, 1.1456F, 1e-3F);
}

TEST(Glb, nodes_move_turn_scale_and_mirror) {
  const auto moved = read_glb(box_glb(amber, unit_half, R"(,"translation":[1,2,3],"scale":[2,1,1])"));
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_EQ(moved->vertices[0].place_m, glm::vec3(0.0F, 1.5F, 2.5F));
  const auto turned =
      read_glb(box_glb(amber, {0.5F, 0.25F, 0.25F}, R"(,"rotation":[0,0,0.70710678,0.70710678])"));
  ASSERT_TRUE(turned) << turned.error().message;
  EXPECT_NEAR(glm::distance(turned->vertices[1].place_m, glm::vec3(0.25F, 0.5F, -0.25F)), 0.0F, 1e-5F);
  const auto mirrored = read_glb(box_glb(amber, unit_half, R"(,"scale":[-1,1,1])"));
  ASSERT_TRUE(mirrored) << mirrored.error().message;
  EXPECT_EQ(outward(*mirrored), 12U);
  const auto matrix = read_glb(box_glb(amber, unit_half, R"(,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,4,5,6,1])"));
  ASSERT_TRUE(matrix) << matrix.error().message;
  EXPECT_EQ(matrix->vertices[7].place_m, glm::vec3(4.5F, 5.5F, 6.5F));
}

TEST(Glb, normals_and_colours_of_vertices_are_read) {
  std::vector<uint8_t> buffer =
      bytes_of_numbers<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 2, 0, 3, 4});
  for (const uint8_t byte : {255, 0, 0, 255, 0, 64, 0, 255, 0, 0, 255, 255}) buffer.push_back(byte);
  const std::string json =
      R"({"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,)"
      R"("NORMAL":1,"COLOR_0":2}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},)"
      R"({"bufferView":2,"componentType":5121,"count":3,"type":"VEC4"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36},)"
      R"({"buffer":0,"byteOffset":72,"byteLength":12}],"buffers":[{"byteLength":84}]})";
  const auto mesh = read_glb(glb_of(json, buffer));
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangles(), 1U);
  EXPECT_EQ(mesh->vertices[1].normal, (std::array<int8_t, 4>{0, 0, 127, 0}));
  EXPECT_EQ(mesh->vertices[2].normal, (std::array<int8_t, 4>{0, 76, 102, 0}));
  EXPECT_EQ(mesh->vertices[0].colour, (std::array<uint8_t, 4>{255, 0, 0, 0}));
  EXPECT_EQ(mesh->vertices[1].colour, (std::array<uint8_t, 4>{0, 128, 0, 0}));
}

TEST(Glb, what_is_no_such_file_is_refused) {
  const std::vector<uint8_t> good = box_glb(amber, unit_half);
  for (size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(read_glb(std::span(good).first(size))) << size << " bytes";
  EXPECT_TRUE(
      holds(read_glb(std::vector<uint8_t>(limits::model_bytes_max + 1)).error().message, "more than 4 MiB"));
  EXPECT_TRUE(
      holds(read_glb(glb_of(std::string((1U << 20U) + 4, '['), {})).error().message, "more than 1024 KiB"));
  EXPECT_TRUE(holds(read_glb(glb_of(std::string(1U << 20U, '['), {})).error().message, "damaged"));
}

TEST(Glb, a_hostile_scene_is_refused_with_its_reason) {
  const std::vector<std::array<std::string, 3>> faults{
      {R"("count":8)", R"("count":9)", "beyond its buffer"},
      {R"("count":8)", R"("count":4194304)", "beyond its buffer"},
      {R"("count":8)", R"("count":-1)", "count"},
      {R"("count":8)", R"("count":1e99)", "count"},
      {R"("count":36)", R"("count":35)", "multiple of three"},
      {R"("count":8)", R"("count":7)", "index without its vertex"},
      {R"("byteOffset":96)", R"("byteOffset":97)", "beyond its buffer"},
      {R"("byteLength":96)", R"("byteLength":95)", "beyond its buffer"},
      {R"("componentType":5126)", R"("componentType":5130)", "type"},
      {R"("componentType":5126)", R"("componentType":5125)", "positions"},
      {R"("componentType":5123)", R"("componentType":5126)", "beyond its buffer"},
      {R"("type":"VEC3")", R"("type":"MAT4")", "vectors"},
      {R"("bufferView":0)", R"("bufferView":2)", "bufferViews[2]"},
      {R"("bufferView":0)", R"("sparse":{},"bufferView":0)", "sparse"},
      {R"("buffer":0)", R"("buffer":1)", "another buffer"},
      {R"([{"byteLength":168)", R"([{"uri":"/etc/passwd","byteLength":168)", "another file"},
      {R"("mesh":0)", R"("mesh":1)", "meshes[1]"},
      {R"("mesh":0)", R"("mesh":0,"children":[0])", "met twice"},
      {R"("mesh":0)", R"("mesh":0,"children":[4096])", "4096 nodes"},
      {R"("mesh":0)", R"("mesh":0,"children":{"a":1})", "no list"},
      {R"("mesh":0)", R"("mesh":0,"translation":[1,2])", "3 numbers"},
      {R"("mesh":0)", R"("mesh":0,"scale":[1e30,1,1])", "beyond"},
      {R"("mesh":0)", R"("mesh":0,"translation":[32,0,0])", "farther than 32 m"},
      {R"("mesh":0)", R"("name":"nothing")", "no whole triangles"},
      {R"("indices":1)", R"("indices":1,"mode":1)", "triangles alone"},
      {R"("indices":1)", R"("indices":0)", "indices"},
      {R"("material":0)", R"("material":7)", "materials[7]"},
      {R"("scene":0)", R"("scene":3)", "scenes[3]"},
      {R"("scene":0)", R"("extensionsRequired":["KHR_draco_mesh_compression"])", "extension"},
  };
  for (const auto& [from, to, words] : faults) {
    const std::string fault = fault_of(from, to);
    EXPECT_TRUE(holds(fault, words)) << to << ": " << fault;
  }
  std::vector<uint8_t> buffer = box_buffer(unit_half);
  std::memset(buffer.data(), 0xFF, 4);  // no number
  EXPECT_TRUE(holds(read_glb(glb_of(box_json(amber), buffer)).error().message, "farther"));
}

TEST(Glb, a_mesh_that_many_nodes_have_is_bounded) {
  std::string nodes = R"({"children":[1)";
  for (int i = 2; i < 4096; ++i) nodes += "," + std::to_string(i);
  nodes += "]}";
  for (int i = 1; i < 4096; ++i) nodes += R"(,{"mesh":0})";
  const std::string json = replaced(box_json(amber), R"("nodes":[{"mesh":0}])", "\"nodes\":[" + nodes + "]");
  const auto many = read_glb(glb_of(json, box_buffer(unit_half)));
  ASSERT_TRUE(many) << many.error().message;
  EXPECT_EQ(many->triangles(), 4095U * 12U);
  const auto with_primitives = [&](int count, const std::string& scene) {
    std::string primitives;
    for (int i = 1; i < count; ++i) primitives += R"({"attributes":{"POSITION":0},"indices":1},)";
    const auto mesh = read_glb(glb_of(replaced(scene, R"("primitives":[)", R"("primitives":[)" + primitives),
                                      box_buffer(unit_half)));
    return mesh ? "" : mesh.error().message;
  };
  EXPECT_EQ(with_primitives(2, json), "");
  EXPECT_TRUE(holds(with_primitives(3, json), "limits.model_triangles_max"));
  EXPECT_TRUE(holds(with_primitives(5, replaced(json, R"("count":36)", R"("count":3)")),
                    "limits.model_vertices_max"));
}

TEST(ModelFolder, files_are_there_by_their_hashes_and_bad_ones_are_named) {
  const TestFolder folder;
  EXPECT_TRUE(holds(read_model_folder(folder / "none").error().message, "No such file"));
  EXPECT_TRUE(holds(read_model_folder(folder / "").error().message, "no model in it"));
  const std::vector<uint8_t> box = box_glb(amber, unit_half);
  const auto write = [&](const std::string& name, const std::vector<uint8_t>& bytes) {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  write("b.glb", box);
  write("a.glb", box_glb({0, 0, 0}, unit_half));
  write("notes.txt", {1});
  const auto read = read_model_folder(folder / "");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->files.size(), 2U);
  EXPECT_EQ(read->files[0].name, "a.glb");
  EXPECT_EQ(read->files[1].digest, sha256(box));
  EXPECT_EQ(read->files[1].triangles, 12U);
  EXPECT_EQ(read->contents->at(sha256(box)), box);
  write("c.glb", std::vector<uint8_t>(limits::model_bytes_max + 1));
  const auto large = read_model_folder(folder / "");
  ASSERT_FALSE(large);
  EXPECT_TRUE(holds(large.error().message, "c.glb: ") &&
              holds(large.error().message, "limits.model_bytes_max"));
}

}  // namespace
}  // namespace scree
