// MagicaVoxel files, made chunk by chunk for tests.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace scree {

class VoxBytes {
 public:
  using Attributes = std::map<std::string, std::string>;

  static std::string number(int64_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>((value >> (8 * i)) & 255);
    return bytes;
  }
  static std::string attributes(const Attributes& all) {
    std::string bytes = number(static_cast<int64_t>(all.size()));
    for (const auto& [name, value] : all)
      bytes += number(static_cast<int64_t>(name.size())) + name + number(static_cast<int64_t>(value.size())) +
               value;
    return bytes;
  }
  void chunk(const std::string& id, const std::string& content) {
    chunks_ += id + number(static_cast<int64_t>(content.size())) + number(0) + content;
  }
  /// Voxels are x, y, z and colour.
  void model(const std::array<int, 3>& size, const std::vector<std::array<int, 4>>& voxels) {
    chunk("SIZE", number(size[0]) + number(size[1]) + number(size[2]));
    std::string content = number(static_cast<int64_t>(voxels.size()));
    for (const auto& voxel : voxels)
      for (const int part : voxel) content += static_cast<char>(part);
    chunk("XYZI", content);
  }
  void transform(int id, int child, const Attributes& frame, const Attributes& own = {}, int layer = -1) {
    chunk("nTRN", number(id) + attributes(own) + number(child) + number(-1) + number(layer) + number(1) +
                      attributes(frame));
  }
  void group(int id, const std::vector<int>& children) {
    std::string content = number(id) + attributes({}) + number(static_cast<int64_t>(children.size()));
    for (const int child : children) content += number(child);
    chunk("nGRP", content);
  }
  void shape(int id, int model) {
    chunk("nSHP", number(id) + attributes({}) + number(1) + number(model) + attributes({}));
  }
  std::string file(int version = 150) const {
    return "VOX " + number(version) + "MAIN" + number(0) + number(static_cast<int64_t>(chunks_.size())) +
           chunks_;
  }

 private:
  std::string chunks_;
};

}  // namespace scree
