// Binary glTF for tests.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace scree {

/// A file of that JSON and that buffer.
inline std::vector<uint8_t> glb_of(std::string json, const std::vector<uint8_t>& buffer) {
  while (json.size() % 4 != 0) json += ' ';
  std::vector<uint8_t> bytes;
  const auto word = [&](size_t number) {
    for (unsigned shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<uint8_t>(number >> shift));
  };
  word(0x46546C67);
  word(2);
  word(12 + 8 + json.size() + 8 + buffer.size());
  word(json.size());
  word(0x4E4F534A);
  bytes.insert(bytes.end(), json.begin(), json.end());
  word(buffer.size());
  word(0x004E4942);
  bytes.insert(bytes.end(), buffer.begin(), buffer.end());
  return bytes;
}

template <typename Number>
std::vector<uint8_t> bytes_of_numbers(const std::vector<Number>& numbers) {
  std::vector<uint8_t> bytes(numbers.size() * sizeof(Number));
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

/// A box about the origin, as 8 corners and 36 indices of 16 bits; without normals.
inline std::vector<uint8_t> box_buffer(std::array<float, 3> half_m) {
  std::vector<float> places;
  for (unsigned corner = 0; corner < 8; ++corner)
    for (unsigned axis = 0; axis < 3; ++axis)
      places.push_back((corner >> axis & 1U) != 0 ? half_m[axis] : -half_m[axis]);
  const std::vector<uint16_t> indices{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                      2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  std::vector<uint8_t> buffer = bytes_of_numbers(places);
  const std::vector<uint8_t> more = bytes_of_numbers(indices);
  buffer.insert(buffer.end(), more.begin(), more.end());
  return buffer;
}

/// The JSON of a file with that buffer. `node` has more members of its only node, with a comma before them.
inline std::string box_json(std::array<float, 3> colour, const std::string& node = "") {
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0{}}}],)"
      R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}}]}}],)"
      R"("materials":[{{"pbrMetallicRoughness":{{"baseColorFactor":[{},{},{},1]}}}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"}},)"
      R"({{"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}}],)"
      R"("bufferViews":[{{"buffer":0,"byteLength":96}},{{"buffer":0,"byteOffset":96,"byteLength":72}}],)"
      R"("buffers":[{{"byteLength":168}}]}})",
      node, colour[0], colour[1], colour[2]);
}

inline std::vector<uint8_t> box_glb(std::array<float, 3> colour, std::array<float, 3> half_m,
                                    const std::string& node = "") {
  return glb_of(box_json(colour, node), box_buffer(half_m));
}

}  // namespace scree
