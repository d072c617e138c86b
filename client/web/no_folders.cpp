// A page has no files: what is kept of a server lies in memory alone, as where no folder is named.
#include "client/cache/cache_folder.h"
#include "client/cache/tile_folder.h"

namespace scree {

std::optional<CachedWorld> CacheFolder::read(const std::string&, std::optional<uint64_t>) const {
  return std::nullopt;
}

void CacheFolder::write(const std::string&, const CachedWorld&) const {}

void CacheFolder::bound() const {}

std::optional<std::vector<uint8_t>> TileFolder::read(const Digest&) const {
  return std::nullopt;
}

void TileFolder::write(const Digest&, const std::vector<uint8_t>&) const {}

}  // namespace scree
