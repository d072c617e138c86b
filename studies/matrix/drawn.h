// Drawing a session of the matrix: what its frames cost by a method, and how far the picture is from the
// field.
#pragma once

#include <array>
#include <memory>

#include "bench/support/stage.h"
#include "client/render/methods.h"
#include "studies/matrix/session.h"

namespace scree {

/// How it is drawn.
struct DrawPlan {
  Quality quality = Quality::medium;
  int width = 640;
  int height = 360;
  Tick ticks_per_frame = 20;  ///< frames are drawn at some ticks alone: they take much longer than ticks
};

/// Milliseconds of a frame.
struct DrawnFrame {
  double update_ms = 0.0;  ///< the method's first update, as a viewer calls it once a frame
  double shown_ms = 0.0;   ///< until all changes are in the picture
  double draw_ms = 0.0;    ///< until the GPU has finished
};

/// Follows a session by a method. Needs the GL context current.
class SessionDrawer {
 public:
  static Result<std::unique_ptr<SessionDrawer>> create(Stage& stage, const MethodEntry& entry,
                                                       const DrawPlan& plan);

  /// Takes in what changed since the last call, and draws all of it.
  Result<DrawnFrame> frame(MatrixSession& session);
  /// The memory of the method, on the CPU's side and on the GPU's.
  double memory_mib() const;
  Result<Image> picture();
  /// RMS distance of the drawn terrain from the field, along rays, in voxels, 3 at most, without outlines;
  /// and the share of pixels, outlines included, at which one lies three voxels before the other, in percent.
  /// Nearer than half the view radius, beyond which levels are coarser. The field is traced by the CPU. From
  /// now on no pieces are drawn.
  struct Difference {
    double depth_voxels = 0.0;
    double silhouette_percent = 0.0;
  };
  Result<Difference> difference(MatrixSession& session);

 private:
  SessionDrawer(Stage& stage, std::unique_ptr<DrawMethod> method, const DrawPlan& plan);

  Stage& stage_;
  std::unique_ptr<DrawMethod> method_;
  DrawPlan plan_;
};

/// A session drawn by a method, by medians over its frames; its ticks by their mean.
struct DrawnFigures {
  double frame_ms = 0.0;  ///< update and drawing
  double update_ms = 0.0;
  double shown_ms = 0.0;
  double fresh_ms = 0.0;    ///< drawing before the first blow
  double flight_ms = 0.0;   ///< drawing while pieces are alive
  double settled_ms = 0.0;  ///< drawing at the end
  double tick_ms = 0.0;     ///< of this session
  double memory_mib = 0.0;  ///< of the method, at the end
  double depth_voxels = 0.0;
  double silhouette_percent = 0.0;

  static constexpr auto fields() {
    using F = FigureField<DrawnFigures>;
    return std::array{F{"frame_ms", &DrawnFigures::frame_ms},
                      F{"update_ms", &DrawnFigures::update_ms},
                      F{"shown_ms", &DrawnFigures::shown_ms},
                      F{"fresh_ms", &DrawnFigures::fresh_ms},
                      F{"flight_ms", &DrawnFigures::flight_ms},
                      F{"settled_ms", &DrawnFigures::settled_ms},
                      F{"tick_ms", &DrawnFigures::tick_ms},
                      F{"memory_mib", &DrawnFigures::memory_mib},
                      F{"depth_voxels", &DrawnFigures::depth_voxels},
                      F{"silhouette_percent", &DrawnFigures::silhouette_percent}};
  }
};

struct DrawnExtras {
  bool judged = false;       ///< with the difference from the field, which takes seconds
  Image* picture = nullptr;  ///< takes a picture with pieces in flight
};

Result<DrawnFigures> measure_drawn(Stage& stage, const MethodEntry& entry, const Simulated& simulated,
                                   const SessionPlan& plan, const DrawnExtras& extras);

}  // namespace scree
