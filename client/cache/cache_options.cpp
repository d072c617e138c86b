#include "client/cache/cache_options.h"

#include <CLI/CLI.hpp>

#include "client/cache/limits.h"
#include "shared/base/option_check.h"
#include "shared/base/xdg_folder.h"

namespace scree {

CacheOptions::CacheOptions(CLI::App& app, CacheConfig& config, size_t mib) : config_(config), mib_(mib) {
  config_.folder = xdg_folder("XDG_CACHE_HOME", ".cache");
  app.add_option(
         "--cache", config_.folder,
         "folder that keeps the edited terrain of visited servers, so that the next visit needs less data")
      ->envname("SCREE_CACHE")
      ->capture_default_str();
  bounded(app.add_option("--cache-mib", mib_, "limit of the files in that folder, MiB; 0: no files"),
          whole_within(0, limits::cache_mib_max))
      ->envname("SCREE_CACHE_MIB")
      ->capture_default_str();
}

/// Without files, what is in memory is for lost connections.
void CacheOptions::complete() {
  if (mib_ == 0) config_.folder.clear();
  config_.bytes_max = (mib_ == 0 ? limits::cache_mib_default : mib_) << 20U;
}

Result<void> CacheOptions::try_folder() const {
  const Result<void> usable = CacheFolder(config_.folder, config_.bytes_max).try_writing();
  if (!usable) return fail("nothing will be kept for the next visit (--cache): " + usable.error().message);
  return {};
}

}  // namespace scree
