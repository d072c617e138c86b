// Props on the GPU: a mesh for each shape that their parts have, and an instance for each part, which look as
// their rows of the palette say. A prop whose model is there is one instance of that instead. Needs the GL
// context current, the destructor too.
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
#include "shared/prop/model_mesh.h"

namespace scree {

class PropViews {
 public:
  /// Shows exactly these props, where they are now. New shapes are uploaded: the cost grows with their
  /// number. Fails when a shader does; the first props link them.
  Result<void> show(const SceneProps& props);

  /// The models that are there from now on, for the next show().
  void set_models(const ModelMeshes& models);

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
    std::optional<gl::Program> models;  ///< once one was to be drawn
    bool models_fail = false;
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
    gl::Buffer indices;  ///< of a model alone
    GLsizei corners = 0;
    float reach_m = 0.0F;             ///< likewise
    std::vector<Instance> instances;  ///< of one pass
  };
  struct View {
    std::shared_ptr<const Prop> prop;
    Pose pose;
    float reach_m = 0.0F;
    std::vector<std::shared_ptr<Shape>> shapes;  ///< of its parts; none where a model shows it
    std::shared_ptr<Shape> model;                ///< null: its parts show it
  };
  struct PartHash {
    size_t operator()(const PropPart& part) const;
  };

  static Result<Programs> link();
  static std::shared_ptr<Shape> upload(const PropPart& part);
  static std::shared_ptr<Shape> upload(const ModelMesh& mesh);
  View view_of(const SceneProp& shown);
  std::shared_ptr<Shape> shape_of(const PropPart& part);
  std::shared_ptr<Shape> model_of(const Prop& prop);
  bool can_draw_models();
  void add_instances(PieceId id, const View& view, const Palette& palette);
  const gl::Program& surface_program(const DrawPass& pass);
  static void use(const gl::Program& program, const DrawPass& pass);
  static bool begin_instances(Shape& shape);
  void draw_models(const DrawPass& pass);

  std::optional<Programs> programs_;
  std::map<PieceId, View> views_;
  /// By parts as they are without their place in the prop. A shape lives as long as a view has it.
  std::unordered_map<PropPart, std::weak_ptr<Shape>, PartHash> shapes_;
  ModelMeshes meshes_;
  bool models_are_new_ = false;                          ///< views may take them
  std::map<Digest, std::weak_ptr<Shape>> model_shapes_;  ///< likewise
};

}  // namespace scree
