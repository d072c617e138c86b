// A running server's terrain, fetched as any client would: its edits by the mirror, and the tiles of its
// ground. What lies in the air is no terrain.
//
// The server says when a session has all edits within its interest (StatusMessage::chunks_waiting). A box
// that is larger than an interest is fetched by sessions one after the other, each around a part of it; so
// the parts are as of different ticks when the world changes meanwhile.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "client/connection/endpoint.h"
#include "shared/material/palette.h"
#include "tools/export/exported.h"

namespace scree {

struct LiveFetch {
  ServerEndpoint server;
  /// The box that is wanted, by the terrain without its edits. By default all edited terrain, and the whole
  /// of a ground that has an end. It is an error when edits lie beyond the interest of one session in its
  /// middle.
  std::function<Result<ChunkBox>(const Field& unedited)> box{};
  std::chrono::seconds within{600};
};

struct LiveTerrain {
  std::unique_ptr<Field> field;  ///< with the edits in the box, which needs no connection any more
  std::shared_ptr<const Palette> palette;
  ChunkBox box;
  Tick tick = 0;        ///< as of which its last part is
  size_t sessions = 0;  ///< that fetched it
};

/// `progress(part)`: from 0 to 1. The error says why: no connection, a refusal, or a time that was too short,
/// and what is missing.
Result<LiveTerrain> fetch_terrain(const LiveFetch& how, const std::function<void(double)>& progress);

}  // namespace scree
