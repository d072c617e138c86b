#include "server/app/prop_models.h"

#include <fmt/format.h>
#include <set>

#include "server/log/log.h"

namespace scree {

namespace {

bool is_missing(const Prop& prop, const ContentFiles* models) {
  return prop.model && (models == nullptr || !models->contains(*prop.model));
}

}  // namespace

tl::expected<void, Refused> check_model(const Request& request, const ContentFiles* models) {
  const auto* const add = std::get_if<AddPropRequest>(&request);
  if (add == nullptr || !is_missing(add->prop, models)) return {};
  return refuse(Refusal::model_missing,
                fmt::format("this server has no model {}: put its file into the server's folder of models "
                            "(--models) and start it again, or leave the model out",
                            hex_of(*add->prop.model)));
}

void tell_models(const std::vector<ModelFile>& models) {
  for (const ModelFile& model : models)
    log_of(LogPart::content)
        .info("model {}: {}, {} triangles, {} KiB", hex_of(model.digest), model.name, model.triangles,
              (model.bytes + 1023) / 1024);
}

void tell_missing_models(const std::vector<SpawnedProp>& props, const ContentFiles* models) {
  std::set<Digest> missing;
  size_t count = 0;
  for (const SpawnedProp& spawned : props) {
    if (!is_missing(*spawned.prop, models)) continue;
    missing.insert(*spawned.prop->model);
    ++count;
  }
  if (missing.empty()) return;
  log_of(LogPart::content)
      .warn(
          "{} props of this world name {} models that are not here, and clients draw their parts: give the "
          "folder "
          "of the models (--models); the first is {}",
          count, missing.size(), hex_of(*missing.begin()));
}

}  // namespace scree
