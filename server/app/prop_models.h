// The models that show props (content/files/model_folder.h), as a live server has them: worlds and recordings
// have their names alone.
#pragma once

#include <string>
#include <vector>

#include "content/files/model_folder.h"
#include "server/command/refusal.h"
#include "server/publish/content_stream.h"
#include "server/world/tick_delta.h"
#include "shared/operation/request.h"

namespace scree {

/// Refuses an AddPropRequest whose model is not there; lets all others pass. `models` may be null: there are
/// none.
tl::expected<void, Refused> check_model(const Request& request, const ContentFiles* models);

/// Logs the name and the hash of each.
void tell_models(const std::vector<ModelFile>& models);

/// Logs how many of these props name models that are not there, and what to do.
void tell_missing_models(const std::vector<SpawnedProp>& props, const ContentFiles* models);

}  // namespace scree
