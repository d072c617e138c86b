// What happens to pieces, from how they move on the screen: those that appear cracked off, those whose speed
// jumps struck something, those that end became ground. Props that are moved by nothing else strike, too. A
// break that was predicted happens once: what the server's pieces do when they take the place of predicted
// ones is no event. Time is an argument (seconds).
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "client/render/scene/draw_method.h"
#include "client/viewer/events/piece_event.h"

namespace scree {

class PieceEventDetector {
 public:
  /// What happened since the last step, the greatest impulse first, at most
  /// limits::piece_events_per_step_max. Nothing of a world that is shown for the first time, or after a gap.
  std::vector<PieceEvent> step(const Scene& scene, double now_s, const Palette& palette = *plain_palette());
  /// Another world, or another moment of it.
  void begin() { known_.reset(); }

 private:
  struct Known {
    glm::vec3 place_m{0.0F};
    glm::vec3 speed_m_s{0.0F};
    float size_m = 0.0F;
    float mass_kg = 0.0F;
    Material material{};
    bool moved = false;    ///< its speed is known
    bool is_prop = false;  ///< that came and goes without an event
  };
  using Table = std::map<PieceId, Known>;

  static Known seen(const ScenePiece& piece, float voxel_m, const Palette& palette);
  static Known seen(const Prop& prop);
  static Known moved_on(const Known& before, glm::vec3 place_m, float elapsed_s);
  /// Nothing elapsed: what was known says nothing of their speed.
  void follow_props(const SceneProps& props, std::optional<float> elapsed_s, const Palette& palette,
                    Table& now, std::vector<PieceEvent>& events) const;
  static PieceEvent event_of(PieceEventKind kind, PieceId id, const Known& piece, float change_m_s,
                             const Palette& palette);
  /// The change of speed by a blow; nothing without one.
  static std::optional<float> blow_of(const Known& before, const Known& now, float elapsed_s);
  bool replaces_predicted(PieceId id, const ScenePieces& pieces) const;

  std::optional<Table> known_;
  double last_s_ = 0.0;
};

}  // namespace scree
