// A session like those of the paper's program: one world, stepped in this process, and a camera that draws it
// without a window. Draw and update are measured apart. Needs the stage's GL context current.
#pragma once

#include <memory>
#include <vector>

#include "bench/support/followed_pieces.h"
#include "bench/support/stage.h"
#include "client/render/methods.h"
#include "server/world/world.h"
#include "studies/paper/findings/findings.h"
#include "studies/paper/plan.h"

namespace scree::paper {

inline constexpr float view_radius_m = 48.0F;

/// The paper's kind of terrain.
WorldConfig session_config();
/// From near the ground, so that the smallest grid reaches it.
Camera near_camera();
/// From farther off: pieces that fly do not fill the picture.
Camera far_camera();
/// From so high above the origin that it is outside of the rock in the paper's own noise as well.
Camera high_camera();
/// Where the first two cameras look, at the ground, and pieces are made. x and z in metres.
inline constexpr glm::vec2 session_middle_m{0.0F, -9.0F};

class PaperSession {
 public:
  PaperSession(Stage& stage, const WorldConfig& config, PictureSize picture, const Camera& camera);
  /// The bricks that this session edited are unedited ones to the methods that were shown().
  ~PaperSession();
  PaperSession(const PaperSession&) = delete;
  PaperSession& operator=(const PaperSession&) = delete;

  /// The method draws this session from now on, and must outlive it. Loads all that it shows; `pool` is the
  /// method's.
  void show(DrawMethod& method, WorkPool& pool);
  /// Steps the world: the time since the session's start is of this tick's beginning. A refused command ends
  /// the program.
  SessionTick& step(std::span<const Command> commands);
  /// Draws the last tick by a method that was shown(); milliseconds until the GPU has finished.
  Result<double> draw(DrawMethod& method);

  World& world() { return world_; }
  /// All ticks so far.
  std::vector<SessionTick>& ticks() { return ticks_; }

 private:
  void apply(const TickDelta& delta);

  Stage& stage_;
  World world_;
  PictureSize picture_;
  Camera camera_;
  std::vector<DrawMethod*> methods_;
  FollowedPieces pieces_;
  std::vector<BrickCoord> edited_;
  std::vector<SessionTick> ticks_;
};

/// Made and warm: its shaders are compiled when it returns.
Result<std::unique_ptr<DrawMethod>> make_method(std::string_view name, WorkPool& pool);

/// The world as a client sees it after a long look: the ground about the middle is generated.
void generate_around(World& world);

/// A carve of a ball about the ground's surface at the place, as the session's user makes it.
Command carve_at(const World& world, glm::vec2 place_m, float radius_m, uint32_t seeds,
                 float blast_speed_m_s);

}  // namespace scree::paper
