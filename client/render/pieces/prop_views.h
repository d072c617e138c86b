// Props on the GPU: a mesh for each shape that their parts have, and an instance for each part. They look as
// their rows of the palette say. Needs the GL context current, the destructor too.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "client/render/gl/gl.h"
#include "client/render/scene/draw_method.h"
#include "shared/base/result.h"
#include "shared/material/palette.h"

namespace scree {

class PropViews {
 public:
  /// Shows exactly these props, where they are now. New shapes are uploaded: the cost grows with their
  /// number. Fails when a shader does; the first props link them.
  Result<void> show(const SceneProps& props);

  /// What touches the pass's view; nothing without props. The palette is the one that the pass's table of
  /// materials has.
  void draw(const DrawPass& pass, const Palette& palette);

  size_t count() const { return views_.size(); }

 private:
  struct Programs {
    gl::Program shadow;
    gl::Program materials;
    std::optional<gl::Program> images;  ///< once it was asked for
    bool images_fail = false;
  };
  /// As client/shaders/prop.vert takes it.
  struct Instance {
    glm::vec3 place_m;
    float tint;
    glm::vec4 rotation;
    glm::vec3 pattern_m;
    float look;
  };
  struct Shape {
    gl::VertexArray array;
    gl::Buffer vertices;
    gl::Buffer instance_buffer;
    GLsizei corners = 0;
    std::vector<Instance> instances;  ///< of one pass
  };
  struct View {
    std::shared_ptr<const Prop> prop;
    Pose pose;
    float reach_m = 0.0F;
    std::vector<std::shared_ptr<Shape>> shapes;  ///< of its parts
  };
  struct PartHash {
    size_t operator()(const PropPart& part) const;
  };

  static Result<Programs> link();
  static std::shared_ptr<Shape> upload(const PropPart& part);
  View view_of(const SceneProp& shown);
  std::shared_ptr<Shape> shape_of(const PropPart& part);
  void add_instances(PieceId id, const View& view, const Palette& palette);
  const gl::Program& use(const DrawPass& pass);

  std::optional<Programs> programs_;
  std::map<PieceId, View> views_;
  /// By parts as they are without their place in the prop. A shape lives as long as a view has it.
  std::unordered_map<PropPart, std::weak_ptr<Shape>, PartHash> shapes_;
};

}  // namespace scree
