// glTF for tests: a triangle, its nodes, and the place of its points.
#pragma once

#include <fstream>
#include <string>

namespace scree {

/// A tetrahedron of 4 m, whose buffer is that of a URI: 12 numbers of points, 12 short ones of corners.
inline std::string gltf_of(const std::string& nodes, const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[4,4,4]},)"
         R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)"
         R"("buffers":[{"byteLength":72,"uri":")" +
         uri + R"("}]})";
}

/// The bytes of that buffer.
inline void write_gltf_buffer(const std::string& path) {
  const float points[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4};
  const uint16_t corners[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(points), sizeof points);
  file.write(reinterpret_cast<const char*>(corners), sizeof corners);
}

}  // namespace scree
