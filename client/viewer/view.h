// What is drawn of a session: the renderer and the method that draws its world. Needs the GL context current.
#pragma once

#include <memory>

#include "client/render/draw_method.h"
#include "client/render/renderer.h"
#include "client/render/work_pool.h"
#include "client/viewer/session.h"

namespace scree {

class View {
 public:
  static Result<std::unique_ptr<View>> create(float view_radius_m);
  ~View();

  /// Takes in a step of the session. After a reconnection the old world stays in sight until the new one is
  /// loaded.
  Result<void> follow(const SessionStep& step, Session& session, const Camera& camera, double now_s);

  /// Null before the first world.
  DrawMethod* method() { return shown_.get(); }
  /// What is shown is the session's world, all of it within the view radius; and in its newest state.
  bool loaded() const { return shown_ && !next_ && shown_->loaded(); }
  bool complete() const { return loaded() && shown_->complete(); }
  Renderer& renderer() { return *renderer_; }

 private:
  View(std::unique_ptr<Renderer> renderer, float view_radius_m);

  float view_radius_m_;
  std::unique_ptr<Renderer> renderer_;
  WorkPool pool_;
  std::unique_ptr<DrawMethod> shown_;
  std::unique_ptr<DrawMethod> next_;  ///< of a new world, not yet loaded
};

}  // namespace scree
