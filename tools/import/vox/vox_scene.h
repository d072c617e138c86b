// A MagicaVoxel file as its bytes have it: models, colours, and the nodes that place models. The form is of
// versions 150 and 200. Internal to import/vox.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "shared/base/result.h"

namespace scree {

struct VoxModel {
  std::array<int, 3> size{};
  /// Place and colour of each voxel, as in the file: z points up; colours are 1 to 255.
  std::vector<std::array<uint8_t, 4>> voxels;
};

/// A turn: axis `axis[i]` of what is turned becomes axis i, mirrored if `negative[i]`.
struct VoxTurn {
  std::array<int, 3> axis{0, 1, 2};
  std::array<bool, 3> negative{};
};

struct VoxNode {
  enum class Kind : uint8_t { transform, group, shape };
  Kind kind = Kind::group;
  std::vector<int32_t> children{};  ///< nodes; of a shape: models, of which the first counts
  VoxTurn turn{};
  std::array<int64_t, 3> move{};
  int32_t layer = -1;
  bool hidden = false;
};

struct VoxScene {
  std::vector<VoxModel> models;
  std::map<int32_t, VoxNode> nodes;  ///< none: the models lie at the origin
  std::set<int32_t> hidden_layers;
  std::array<std::array<uint8_t, 4>, 256> colours{};  ///< sRGB; number 0 is no colour
  std::map<int, std::string> names;                   ///< of colours
};

/// The error says what is wrong with the bytes.
Result<VoxScene> parse_vox(std::span<const uint8_t> bytes);

}  // namespace scree
