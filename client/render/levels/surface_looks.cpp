#include "client/render/levels/surface_looks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace scree {
namespace {

constexpr int worn_steps = 15;

glm::vec3 normal_of(const SurfaceVertex& vertex) {
  return glm::vec3(vertex.normal[0], vertex.normal[1], vertex.normal[2]) / 127.0F;
}

SurfaceVertex mean_of(const SurfaceVertex& a, const SurfaceVertex& b) {
  SurfaceVertex mean = a;
  const glm::vec3 sum = normal_of(a) + normal_of(b);
  const glm::vec3 normal = sum / std::max(glm::length(sum), 1e-3F) * 127.0F;
  for (size_t i = 0; i < 3; ++i) {
    mean.position[i] = static_cast<uint16_t>((a.position[i] + b.position[i] + 1) / 2);
    mean.normal[i] = static_cast<int8_t>(std::lround(normal[static_cast<int>(i)]));
  }
  mean.openness = static_cast<uint8_t>((a.openness + b.openness + 1) / 2);
  const auto part = [](const SurfaceVertex& v, int shift) {
    return (static_cast<uint8_t>(v.before) >> shift) & worn_steps;
  };
  const int gone = (part(a, 0) + part(b, 0) + 1) / 2, come = (part(a, 4) + part(b, 4) + 1) / 2;
  mean.before = static_cast<Code>(static_cast<uint8_t>(gone | come << 4));
  return mean;
}

/// Vertices of a mesh, of which some are made of others.
class Parted {
 public:
  Parted(SurfaceMesh& mesh, const std::vector<bool>& coarse) : mesh_(mesh), coarse_(coarse) {}

  uint32_t between(uint32_t a, uint32_t b, uint8_t look) {
    if (a > b) std::swap(a, b);
    return made({a, b, look}, [&] {
      SurfaceVertex mean = mean_of(mesh_.vertices[a], mesh_.vertices[b]);
      if (is_coarse(a) && is_coarse(b)) {
        for (size_t i = 0; i < 3; ++i)
          mean.position[i] = coarse_mean(mesh_.vertices[a].position[i], mesh_.vertices[b].position[i]);
      }
      return mean;
    });
  }
  /// The middle of a triangle, no two of whose corners look alike.
  uint32_t middle(const std::array<uint32_t, 3>& corners, uint8_t look) {
    const auto& all = mesh_.vertices;
    SurfaceVertex vertex = mean_of(mean_of(all[corners[0]], all[corners[1]]), all[corners[2]]);
    for (size_t i = 0; i < 3; ++i)
      vertex.position[i] = static_cast<uint16_t>(
          (all[corners[0]].position[i] + all[corners[1]].position[i] + all[corners[2]].position[i]) / 3);
    vertex.look = look;
    mesh_.vertices.push_back(vertex);
    return static_cast<uint32_t>(mesh_.vertices.size() - 1);
  }
  uint8_t look(uint32_t vertex) const { return mesh_.vertices[vertex].look; }

 private:
  struct Key {
    uint32_t a, b;
    uint8_t look;
    auto operator<=>(const Key&) const = default;
  };
  template <typename Make>
  uint32_t made(const Key& key, Make&& make) {
    const auto [found, is_new] = made_.try_emplace(key, static_cast<uint32_t>(mesh_.vertices.size()));
    if (!is_new) return found->second;
    SurfaceVertex vertex = make();
    vertex.look = key.look;
    mesh_.vertices.push_back(vertex);
    return found->second;
  }

  bool is_coarse(uint32_t vertex) const { return vertex < coarse_.size() && coarse_[vertex]; }
  /// As mean_of() rounds in steps of twice the size.
  static uint16_t coarse_mean(int a, int b) { return static_cast<uint16_t>((a / 2 + b / 2 + 1) / 2 * 2); }

  SurfaceMesh& mesh_;
  const std::vector<bool>& coarse_;
  std::map<Key, uint32_t> made_;
};

/// The corner that looks unlike the others, which are alike.
void part_two(Parted& parted, const std::array<uint32_t, 3>& t, size_t odd, std::vector<uint32_t>& to) {
  const uint32_t a = t[odd], b = t[(odd + 1) % 3], c = t[(odd + 2) % 3];
  const uint8_t one = parted.look(a), other = parted.look(b);
  const uint32_t ab = parted.between(a, b, one), ca = parted.between(c, a, one);
  const uint32_t ba = parted.between(a, b, other), ac = parted.between(c, a, other);
  to.insert(to.end(), {a, ab, ca, ba, b, c, ba, c, ac});
}

void part_three(Parted& parted, const std::array<uint32_t, 3>& t, std::vector<uint32_t>& to) {
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
    const uint8_t look = parted.look(a);
    const uint32_t ab = parted.between(a, b, look), ca = parted.between(c, a, look);
    const uint32_t middle = parted.middle(t, look);
    to.insert(to.end(), {a, ab, middle, a, middle, ca});
  }
}

}  // namespace

Code packed_worn(int worn) {
  const int size = std::min(std::abs(worn), worn_all);
  const int step = (size * worn_steps + worn_all / 2) / worn_all;
  return static_cast<Code>(static_cast<uint8_t>(worn < 0 ? step : step << 4));
}

int unpacked_worn(Code packed) {
  const int bits = static_cast<uint8_t>(packed);
  return ((bits >> 4) - (bits & worn_steps)) * worn_all / worn_steps;
}

void set_looks(SurfaceMesh& mesh, const Window& now, const LookWindow& looks, const IsCut& is_cut) {
  if (looks.is_ground()) return;
  const glm::vec3 origin(mesh.origin.x, mesh.origin.y, mesh.origin.z);
  for (SurfaceVertex& vertex : mesh.vertices) {
    const glm::vec3 in_mesh(vertex.position[0], vertex.position[1], vertex.position[2]);
    const glm::vec3 p = origin + in_mesh / surface_steps_per_voxel;
    const Look look = looks.at(beneath(now, p));
    vertex.look = look.bare != look.shown && is_cut(vertex, p) ? look.bare : look.shown;
  }
}

void part_looks(SurfaceMesh& mesh, const std::vector<bool>& coarse) {
  const auto look = [&](uint32_t vertex) { return mesh.vertices[vertex].look; };
  const auto parts = [&](const uint32_t* t) { return look(t[0]) != look(t[1]) || look(t[0]) != look(t[2]); };
  Parted parted(mesh, coarse);
  std::vector<uint32_t> more;
  size_t kept = 0;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const uint32_t* at = &mesh.indices[i];
    if (!parts(at)) {
      std::copy_n(at, 3, &mesh.indices[kept]);
      kept += 3;
      continue;
    }
    const std::array<uint32_t, 3> t{at[0], at[1], at[2]};
    const std::array<uint8_t, 3> l{look(t[0]), look(t[1]), look(t[2])};
    if (l[0] != l[1] && l[1] != l[2] && l[2] != l[0])
      part_three(parted, t, more);
    else
      part_two(parted, t, l[1] == l[2] ? 0 : (l[0] == l[2] ? 1 : 2), more);
  }
  mesh.indices.resize(kept);
  mesh.indices.insert(mesh.indices.end(), more.begin(), more.end());
}

}  // namespace scree
