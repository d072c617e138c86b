#include "client/render/details/detail_meshes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace scree {
namespace {

constexpr float full_turn = 2.0F * std::numbers::pi_v<float>;

/// The same row of numbers each time, 0 to 1.
class ShapeDraws {
 public:
  float next() {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<float>(state_ >> 8U) / 16777216.0F;
  }
  glm::vec3 direction() {
    const float y = 2.0F * next() - 1.0F, angle = full_turn * next(), flat = std::sqrt(1.0F - y * y);
    return {flat * std::cos(angle), y, flat * std::sin(angle)};
  }

 private:
  uint32_t state_ = 20;
};

void add_vertex(DetailMesh& mesh, glm::vec3 place, glm::vec3 normal, float bright) {
  const auto byte = [](float part) { return static_cast<int8_t>(std::lround(127.0F * part)); };
  mesh.vertices.push_back({place, {byte(normal.x), byte(normal.y), byte(normal.z), byte(bright)}});
}

void add_triangle(DetailMesh& mesh, size_t a, size_t b, size_t c) {
  for (const size_t corner : {a, b, c}) mesh.corners.push_back(static_cast<uint16_t>(corner));
}

/// Blades that bend outwards: two cuts across each, and a tip. In place of normals they have the ways to
/// their edges.
DetailMesh tuft() {
  constexpr int blades = 13;
  DetailMesh mesh;
  ShapeDraws draws;
  for (int i = 0; i < blades; ++i) {
    const float angle = full_turn * (static_cast<float>(i) + 0.7F * draws.next()) / blades;
    const glm::vec3 out(std::cos(angle), 0.0F, std::sin(angle)), across(-out.z, 0.0F, out.x);
    const glm::vec3 root = out * (0.62F * std::sqrt(draws.next()));
    const float high = 0.55F + 0.45F * draws.next(), bend = 0.15F + 0.55F * draws.next();
    const glm::vec3 wide = (across + 0.5F * (draws.next() - 0.5F) * out) * (0.020F + 0.014F * draws.next());
    const glm::vec3 middle = root + out * (0.30F * bend) + glm::vec3(0.0F, 0.6F * high, 0.0F);
    const glm::vec3 tip = root + out * bend + glm::vec3(0.0F, high, 0.0F);
    const glm::vec3 side = glm::normalize(wide);
    const size_t first = mesh.vertices.size();
    add_vertex(mesh, root - wide, -side, 0.55F);
    add_vertex(mesh, root + wide, side, 0.55F);
    add_vertex(mesh, middle - wide * 0.75F, -0.8F * side, 0.85F);
    add_vertex(mesh, middle + wide * 0.75F, 0.8F * side, 0.85F);
    add_vertex(mesh, tip, glm::vec3(0.0F), 1.0F);
    add_triangle(mesh, first, first + 1, first + 2);
    add_triangle(mesh, first + 2, first + 1, first + 3);
    add_triangle(mesh, first + 2, first + 3, first + 4);
  }
  return mesh;
}

/// Leaves about a dome, darker where they are low or within.
DetailMesh dome_of_leaves() {
  constexpr int leaves = 150;
  DetailMesh mesh;
  ShapeDraws draws;
  for (int i = 0; i < leaves; ++i) {
    glm::vec3 out = draws.direction();
    out.y = std::abs(out.y) * 1.1F - 0.25F;
    const float deep = std::sqrt(draws.next());
    const glm::vec3 middle = glm::vec3(out.x, 0.40F + 0.85F * out.y, out.z) * (0.14F + 0.38F * deep);
    // Leaves turn to the light, each its own way.
    const glm::vec3 face = glm::normalize(out + 0.7F * draws.direction());
    const glm::vec3 across = glm::normalize(glm::cross(face, draws.direction() + glm::vec3(0.01F)));
    const glm::vec3 along = glm::cross(across, face);
    const float size = 0.06F + 0.05F * draws.next();
    const glm::vec3 normal = glm::normalize(out + glm::vec3(0.0F, 0.35F, 0.0F) + 0.3F * draws.direction());
    const float bright =
        (0.35F + 0.65F * deep) * (0.55F + 0.45F * std::min(1.0F, 2.0F * std::max(middle.y, 0.0F)));
    const size_t first = mesh.vertices.size();
    add_vertex(mesh, middle - across * size - along * (0.6F * size), normal, bright * 0.9F);
    add_vertex(mesh, middle + across * size - along * (0.6F * size), normal, bright * 0.9F);
    add_vertex(mesh, middle + along * (1.2F * size), normal, bright);
    add_triangle(mesh, first, first + 1, first + 2);
  }
  return mesh;
}

/// A ball of eighty faces, cut by planes into a stone with ridges.
DetailMesh broken_stone() {
  const float g = 0.5F + 0.5F * std::sqrt(5.0F);
  std::vector<glm::vec3> points;
  for (const float a : {-1.0F, 1.0F})
    for (const float b : {-g, g}) points.insert(points.end(), {{a, b, 0.0F}, {0.0F, a, b}, {b, 0.0F, a}});
  for (glm::vec3& point : points) point = glm::normalize(point);
  std::vector<std::array<size_t, 3>> faces;
  const auto is_edge = [&](size_t a, size_t b) { return glm::dot(points[a], points[b]) > 0.4F; };
  for (size_t a = 0; a < points.size(); ++a)
    for (size_t b = a + 1; b < points.size(); ++b)
      for (size_t c = b + 1; c < points.size(); ++c) {
        if (!is_edge(a, b) || !is_edge(b, c) || !is_edge(a, c)) continue;
        const bool outwards =
            glm::dot(glm::cross(points[b] - points[a], points[c] - points[a]), points[a]) > 0.0F;
        faces.push_back(outwards ? std::array{a, b, c} : std::array{a, c, b});
      }
  // Two faces share an edge: its middle may be there.
  const auto half = [&](size_t a, size_t b) {
    const glm::vec3 middle = glm::normalize(points[a] + points[b]);
    const auto known =
        std::ranges::find_if(points, [&](glm::vec3 p) { return glm::dot(p, middle) > 0.999F; });
    const auto at = static_cast<size_t>(known - points.begin());
    if (known == points.end()) points.push_back(middle);
    return at;
  };
  DetailMesh mesh;
  const std::vector<std::array<size_t, 3>> large = faces;
  for (const auto& [a, b, c] : large) {
    const size_t ab = half(a, b), bc = half(b, c), ca = half(c, a);
    add_triangle(mesh, a, ab, ca);
    add_triangle(mesh, b, bc, ab);
    add_triangle(mesh, c, ca, bc);
    add_triangle(mesh, ab, bc, ca);
  }
  ShapeDraws draws;
  std::array<glm::vec3, 9> cuts{};
  for (glm::vec3& cut : cuts) cut = draws.direction() * (0.62F + 0.25F * draws.next());
  for (const glm::vec3& point : points) {
    glm::vec3 place = point * (0.94F + 0.06F * draws.next());
    for (const glm::vec3& cut : cuts) {
      const float far = glm::length(cut), over = glm::dot(place, cut / far) - far;
      if (over > 0.0F) place -= cut / far * over;
    }
    add_vertex(mesh, place * glm::vec3(0.55F, 0.42F, 0.48F), point, 1.0F);
  }
  return mesh;
}

}  // namespace

DetailMesh detail_mesh(DetailKind kind) {
  switch (kind) {
    case DetailKind::grass:
      return tuft();
    case DetailKind::bush:
      return dome_of_leaves();
    case DetailKind::stone:
      return broken_stone();
  }
  return {};
}

}  // namespace scree
