// Lines in the world, to be drawn over it: outlines of shapes, boxes, borders; and triangles, for what is
// solid and not rock. No GL. Metres.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/field/shape.h"

namespace scree {

/// Bytes red, green, blue, alpha: as they lie in memory.
struct LineColour {
  uint8_t red = 255;
  uint8_t green = 255;
  uint8_t blue = 255;
  uint8_t alpha = 255;
};

struct LineVertex {
  glm::vec3 place_m;
  LineColour colour;
};

/// As a side of that normal (unit) looks in the sun.
LineColour shaded(LineColour colour, glm::vec3 normal);

class LineList {
 public:
  void line(glm::vec3 from_m, glm::vec3 to_m, LineColour colour);
  /// The twelve edges of a box, turned about the origin and then moved.
  void box(glm::vec3 lo_m, glm::vec3 hi_m, LineColour colour, glm::quat turn = {1.0F, 0.0F, 0.0F, 0.0F},
           glm::vec3 move_m = glm::vec3(0.0F));
  /// About `axis` (unit).
  void circle(glm::vec3 centre_m, glm::vec3 axis, float radius_m, LineColour colour);
  void tube(glm::vec3 from_m, glm::vec3 to_m, float radius_m, LineColour colour);
  void shape(const Shape& shape, LineColour colour);
  /// Three short lines that cross.
  void cross(glm::vec3 place_m, float half_m, LineColour colour);

  /// Filled, seen from both sides; its colours are those of the screen, and opaque.
  void triangle(glm::vec3 a_m, glm::vec3 b_m, glm::vec3 c_m, LineColour colour);

  /// It has as many sides, shaded as by the sun, and is open at its ends. Without a length there is none.
  void cylinder(glm::vec3 from_m, glm::vec3 to_m, float radius_m, int sides, LineColour colour);

  /// Two a line. Beyond limits::lines_max nothing is added.
  std::span<const LineVertex> vertices() const { return vertices_; }
  /// Three a triangle, with the same bound.
  std::span<const LineVertex> corners() const { return corners_; }
  void clear() {
    vertices_.clear();
    corners_.clear();
  }

 private:
  std::vector<LineVertex> vertices_;
  std::vector<LineVertex> corners_;
};

}  // namespace scree
