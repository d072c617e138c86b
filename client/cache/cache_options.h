// The options by which a client is told what it may keep.
#pragma once

#include "client/cache/rejoin.h"
#include "shared/base/result.h"

namespace CLI {
class App;
}

namespace scree {

/// Declares --cache and --cache-mib, with their names in the environment. Outlives the parsing.
class CacheOptions {
 public:
  /// `mib`: unless told otherwise; 0: no files.
  CacheOptions(CLI::App& app, CacheConfig& config, size_t mib);
  CacheOptions(const CacheOptions&) = delete;
  CacheOptions& operator=(const CacheOptions&) = delete;

  /// After the parsing.
  void complete();
  /// Then: makes the folder. The error says why nothing can be kept in files; what is in memory is, all the
  /// same.
  Result<void> try_folder() const;

 private:
  CacheConfig& config_;
  size_t mib_;
};

}  // namespace scree
