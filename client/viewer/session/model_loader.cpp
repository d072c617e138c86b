#include "client/viewer/session/model_loader.h"

#include <mutex>

#include "client/render/scene/limits.h"

namespace scree {

namespace {

constexpr size_t faults_max = 16;

}  // namespace

struct ModelLoader::Inbox {
  struct Done {
    Digest model;
    Result<ModelMesh> mesh;
  };
  std::mutex mutex;
  std::vector<Done> done;
};

ModelLoader::ModelLoader(WorkPool& pool, DecodeModel decode)
    : pool_(pool), decode_(decode), inbox_(std::make_shared<Inbox>()) {}

ModelLoader::~ModelLoader() = default;

void ModelLoader::begin(const Digest& model, const ReceivedContent::Bytes& file) {
  begun_.insert(model);
  ++waiting_;
  pool_.submit(WorkPool::Urgency::load, [inbox = inbox_, decode = decode_, model, file] {
    Inbox::Done done{model, decode(*file)};
    const std::lock_guard lock(inbox->mutex);
    inbox->done.push_back(std::move(done));
  });
}

/// Forgets what no prop has that is here.
void ModelLoader::make_room(const SceneProps& props) {
  std::set<Digest> named;
  for (const auto& [id, shown] : props)
    if (shown.prop->model) named.insert(*shown.prop->model);
  for (auto known = begun_.begin(); known != begun_.end();) {
    if (named.contains(*known)) {
      ++known;
      continue;
    }
    if (const auto mesh = meshes_.find(*known); mesh != meshes_.end()) {
      bytes_ -= mesh->second->bytes();
      meshes_.erase(mesh);
    }
    known = begun_.erase(known);
  }
}

bool ModelLoader::take_in(const SceneProps& props) {
  std::vector<Inbox::Done> done;
  {
    const std::lock_guard lock(inbox_->mutex);
    std::swap(done, inbox_->done);
  }
  bool is_new = false;
  for (Inbox::Done& each : done) {
    --waiting_;
    if (!begun_.contains(each.model) || meshes_.contains(each.model)) continue;  // it was forgotten meanwhile
    if (each.mesh && bytes_ + each.mesh->bytes() > limits::model_meshes_bytes_max) {
      make_room(props);
      is_new = true;
    }
    const bool fits = each.mesh && bytes_ + each.mesh->bytes() <= limits::model_meshes_bytes_max;
    if (!fits && faults_.size() >= faults_max) continue;  // nobody wants to know
    if (!fits) {
      faults_.push_back("props are drawn by their parts, for their model " + hex_of(each.model) +
                        " cannot be shown: " +
                        (each.mesh ? "all models together are too large (limits.model_meshes_bytes_max)"
                                   : each.mesh.error().message));
      continue;
    }
    bytes_ += each.mesh->bytes();
    meshes_[each.model] = std::make_shared<const ModelMesh>(std::move(*each.mesh));
    is_new = true;
  }
  return is_new;
}

bool ModelLoader::follow(const SceneProps& props, const Find& find) {
  if (decode_ == nullptr) return false;
  lacks_ = false;
  if (waiting_ == 0 && begun_.size() > limits::models_known_max) make_room(props);
  for (const auto& [id, shown] : props) {
    const std::optional<Digest>& model = shown.prop->model;
    if (!model || begun_.contains(*model)) continue;
    if (const ReceivedContent::Bytes file = find(*model))
      begin(*model, file);
    else
      lacks_ = true;
  }
  return waiting_ != 0 && take_in(props);
}

}  // namespace scree
