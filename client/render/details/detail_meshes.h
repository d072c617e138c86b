// The shapes of details, made once: a tuft of grass, a bush, a stone. Sizes in parts of a detail's; y is up.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "client/render/details/detail.h"

namespace scree {

struct DetailVertex {
  glm::vec3 place{0.0F};
  std::array<int8_t, 4> normal{};  ///< in 127ths; of a blade the way to its edge; the last: how bright
};

struct DetailMesh {
  std::vector<DetailVertex> vertices;
  std::vector<uint16_t> corners;  ///< three a triangle
};

DetailMesh detail_mesh(DetailKind kind);

}  // namespace scree
