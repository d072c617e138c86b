// Lines over the picture: borders, interest, bodies, contacts.
#pragma once

#include "client/render/scene/line_list.h"
#include "client/viewer/session/viewer_session.h"

namespace scree {

/// The shown parts. Interest, chunks and pieces are those of the client; physics is that of the server.
struct OverlayChoice {
  bool shown = false;
  bool interest = true;
  bool chunks = true;
  bool pieces = true;
  bool physics = true;

  bool operator==(const OverlayChoice&) const = default;
};

/// Green: chunks that follow the server and hold edits; grey: the chunk around the eye. White: interest, as a
/// circle at the eye's height. Yellow: boxes of pieces' volumes, air and all.
void add_borders(LineList& lines, ViewerSession& session, const OverlayChoice& choice, glm::vec3 eye_m,
                 double now_s);

/// The joints of what is shown, which are a part of the scene.
void add_joints_of(ViewerSession& session, LineList& lines, glm::vec3 eye_m, double now_s);

/// Hulls that collide: orange while awake, blue asleep, violet for islands. Red: contacts, along their
/// normals, longer for stronger ones. Magenta: bricks of unfinished searches for islands.
void add_physics(LineList& lines, const PhysicsMessage& physics, const Scene& scene);

}  // namespace scree
