#include "client/viewer/session/whereabouts.h"

namespace scree {

void Whereabouts::step(Camera& camera, const FlyInput& input, float elapsed_s, ViewerSession& session,
                       double now_s) {
  if (session.mirror() == nullptr || session.persons_walk()) feet_.stop();
  if (session.mirror() == nullptr || !session.persons_walk()) served_feet_.stop();
  if (input.move != glm::vec3(0.0F)) eye_.end();
  move(camera, input, elapsed_s, session, now_s);
  session.stand_at(feet_m(session));
}

std::optional<glm::vec3> Whereabouts::feet_m(ViewerSession& session) const {
  if (eye_.follows()) return std::nullopt;
  if (feet_.walks()) return feet_.feet_m();
  const WalkPrediction* const foreseen = served_feet_.walks() ? session.foreseen_walk() : nullptr;
  if (foreseen == nullptr || !foreseen->on_foot()) return std::nullopt;
  return foreseen->walker().feet_m();
}

void Whereabouts::move(Camera& camera, const FlyInput& input, float elapsed_s, ViewerSession& session,
                       double now_s) {
  if (eye_.follows()) return eye_.step(camera, session.figures(now_s), now_s);
  if (served_feet_.walks()) return served_feet_.step(camera, input, elapsed_s, session, now_s);
  if (!feet_.walks()) return fly(camera, input, elapsed_s);
  feet_.step(camera, input, elapsed_s, session.scene(now_s));
}

void Whereabouts::walk_or_fly(const Camera& camera, ViewerSession& session, double now_s) {
  if (session.mirror() == nullptr) return;
  if (session.persons_walk()) return served_feet_.change(session, now_s);
  feet_.change(camera);
}

bool Whereabouts::follow_next_eye(ViewerSession& session, double now_s) {
  const Figures& figures = session.figures(now_s);
  eye_.next(figures);
  feet_.stop();
  return !figures.all().empty();
}

}  // namespace scree
