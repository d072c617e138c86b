// Makes the models of props ready to be drawn as their files come: a reader's work is for the pool's threads.
// One thread owns it.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "client/cache/received_content.h"
#include "client/render/scene/draw_method.h"
#include "client/render/scene/work_pool.h"
#include "shared/prop/model_mesh.h"

namespace scree {

/// Reads the bytes of a model's file, which are any; any thread. Null: nobody reads them.
using DecodeModel = Result<ModelMesh> (*)(std::span<const uint8_t>);

class ModelLoader {
 public:
  using Find = std::function<ReceivedContent::Bytes(const Digest&)>;

  /// `pool` must outlive it.
  ModelLoader(WorkPool& pool, DecodeModel decode);
  ~ModelLoader();

  /// Begins with what `find` has of the props' models, and takes in what is done. Whether meshes() are others
  /// than before. A file that cannot be read is not tried again.
  bool follow(const SceneProps& props, const Find& find);
  const ModelMeshes& meshes() const { return meshes_; }
  /// Whether no model of the props waits to be read. `settled`: no more files will come.
  bool complete(bool settled) const { return waiting_ == 0 && (settled || !lacks_); }
  /// Why files could not be read, each told once, for people.
  std::vector<std::string> drain_faults() { return std::exchange(faults_, {}); }

 private:
  struct Inbox;

  void begin(const Digest& model, const ReceivedContent::Bytes& file);
  bool take_in(const SceneProps& props);
  void make_room(const SceneProps& props);

  WorkPool& pool_;
  DecodeModel decode_;
  std::shared_ptr<Inbox> inbox_;
  std::set<Digest> begun_;
  size_t waiting_ = 0;
  bool lacks_ = false;  ///< the file of a model of the last props
  ModelMeshes meshes_;
  size_t bytes_ = 0;  ///< of meshes_
  std::vector<std::string> faults_;
};

}  // namespace scree
