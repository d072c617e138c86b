// The drawing of a session: the renderer, and the method that draws its world. Needs the GL context current.
#pragma once

#include <memory>

#include "client/render/method_switch.h"
#include "client/render/renderer.h"
#include "client/render/scene/work_pool.h"
#include "client/viewer/session/image_loader.h"
#include "client/viewer/session/model_loader.h"
#include "client/viewer/session/viewer_session.h"

namespace scree {

class View {
 public:
  /// Fails without a suitable OpenGL, or without a feature that the method needs.
  /// Without a decoder, materials show their colours instead of their images, and props their parts instead
  /// of their models.
  static Result<std::unique_ptr<View>> create(const MethodEntry& method, float view_radius_m,
                                              DecodeImage decode = nullptr,
                                              DecodeModel decode_model = nullptr);
  ~View();

  /// Takes in a step of the session.
  Result<void> follow(const SessionStep& step, ViewerSession& session, const Camera& camera, double now_s);

  /// Where the program has no threads: does work of drawing for so many seconds (WorkPool::run_for()). True:
  /// there is more.
  bool work_for(double seconds) { return pool_.run_for(seconds); }
  double work_worst_ms() const { return pool_.worst_ms(); }

  /// Draws so finely, and so far.
  void set_fineness(const Fineness& fineness, float view_radius_m);

  MethodSwitch& methods() { return methods_; }
  /// Whether no image of a material waits to be decoded.
  bool images_complete() const { return images_.complete(); }
  ModelLoader& models() { return models_; }
  Renderer& renderer() { return *renderer_; }

 private:
  View(std::unique_ptr<Renderer> renderer, const MethodEntry& method, float view_radius_m, DecodeImage decode,
       DecodeModel decode_model);

  std::unique_ptr<Renderer> renderer_;
  WorkPool pool_;
  MethodSwitch methods_;
  ImageLoader images_;
  ModelLoader models_;
};

}  // namespace scree
