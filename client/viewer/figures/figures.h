// Other persons as figures: bodies that stand under their eyes, walk, and look where they aim. Follows their
// cursors smoothly, and the bodies of those on foot.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "client/render/scene/contact.h"
#include "client/render/scene/limb.h"
#include "client/render/scene/line_list.h"
#include "client/viewer/figures/person_colours.h"
#include "proto/messages.h"
#include "shared/field/field.h"

namespace scree {

/// What is known of persons beside their cursors.
struct PersonFacts {
  std::map<uint64_t, glm::vec3> feet_m;  ///< of those whose bodies are known, by session
  const Field* field = nullptr;          ///< on which others may stand; null: they fly
  const PersonColours* colours = nullptr;
};

/// Adds somebody on foot, whose body is there. Who tells no cursor looks ahead.
void add_body(PersonFacts& facts, std::vector<PlayerCursor>& cursors, uint64_t session, const Pose& body);

class Figures {
 public:
  /// The cursors as last told; a person that is not among them is gone. `now_s`: never backwards.
  void step(const std::vector<PlayerCursor>& cursors, double now_s, const PersonFacts& facts = {});

  struct Figure {
    std::string name;
    glm::vec3 eye_m{0.0F};
    glm::vec3 aim_m{0.0F};
    double since_s = 0.0;    ///< of the last step
    bool on_foot = false;    ///< it has a body in the world
    bool stands = false;     ///< or it flies
    float walked_m = 0.0F;   ///< over the ground, forwards
    float speed_m_s = 0.0F;  ///< over the ground
    LineColour colour{};     ///< white where none is known
  };
  /// By session.
  const std::map<uint64_t, Figure>& all() const { return figures_; }
  /// Where a name belongs, over the head: parts of the picture's width and height, from its upper left;
  /// nothing behind the eye.
  static std::optional<glm::vec2> place_of_name(const Figure& figure, const glm::mat4& view_projection);
  /// Adds a cross where each aims.
  void add_to(LineList& lines) const;
  /// Their bodies, or those alone that are on foot; not of one that the eye is in, or through whose eye one
  /// looks.
  std::vector<Limb> limbs(glm::vec3 eye_m, std::optional<uint64_t> looked_through, bool on_foot_alone) const;
  /// Where those bodies darken the ground that they stand on.
  void add_to(std::vector<Contact>& contacts) const;

 private:
  static void walk(Figure& figure, const Figure& before, float passed_s);

  std::map<uint64_t, Figure> figures_;
};

}  // namespace scree
