// Other persons as figures: a body under the eye, looking where they aim. Follows their cursors smoothly.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "client/render/scene/line_list.h"
#include "proto/messages.h"

namespace scree {

class Figures {
 public:
  /// The cursors as last told; a person that is not among them is gone. `now_s`: never backwards.
  void step(const std::vector<PlayerCursor>& cursors, double now_s);

  struct Figure {
    std::string name;
    glm::vec3 eye_m{0.0F};
    glm::vec3 aim_m{0.0F};
    double since_s = 0.0;  ///< of the last step
  };
  /// By session.
  const std::map<uint64_t, Figure>& all() const { return figures_; }
  /// Where a name belongs, over the head: parts of the picture's width and height, from its upper left;
  /// nothing behind the eye.
  static std::optional<glm::vec2> place_of_name(const Figure& figure, const glm::mat4& view_projection);
  /// Adds them as bodies, and a cross where each aims; not the body of one that the eye is in, or through
  /// whose eye one looks.
  void add_to(LineList& lines, glm::vec3 eye_m, std::optional<uint64_t> looked_through = {}) const;

 private:
  std::map<uint64_t, Figure> figures_;
};

/// A figure's colour: always the same of a session.
LineColour colour_of_person(uint64_t session);

}  // namespace scree
