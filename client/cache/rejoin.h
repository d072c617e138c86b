// How a client comes back to a server: it keeps the world's edited chunks, offers them when it connects
// again, and its session goes on by the ticket of the last welcome (proto/join.proto). What it keeps outlives
// the program when there is a folder for it.
//
// Outlives the mirrors that it makes. One thread at a time: open() may run on another one while there is no
// connection.
#pragma once

#include <future>
#include <memory>
#include <string>
#include <vector>

#include "client/cache/cache_folder.h"
#include "client/cache/chunk_cache.h"
#include "client/cache/received_content.h"
#include "client/cache/received_tiles.h"
#include "client/connection/server_channel.h"
#include "client/mirror/mirror.h"

namespace scree {

struct CacheConfig {
  std::string folder{};  ///< empty: kept until the program ends
  size_t bytes_max = 0;  ///< of the chunks in memory, and of all files
  bool images = false;   ///< those of the palette's rows are wanted
  bool models = false;   ///< those of props are wanted
};

class Rejoin {
 public:
  /// Without a bound, nothing is kept, and nothing offered.
  explicit Rejoin(const CacheConfig& config);
  /// Waits for a file that is being written.
  ~Rejoin() = default;

  /// The first messages of a connection.
  struct Opening {
    HelloMessage hello;
    std::vector<ClientMessage> then;
  };
  /// Puts ticket and offer to the hello, for the server of that address. Reads files; writes what was kept
  /// before.
  Opening open(const std::string& address, HelloMessage hello);
  /// The mirror for a new connection, which began with what open() last said.
  std::unique_ptr<Mirror> begin(ServerChannel& connection);

  /// Call before the mirror applies the message, and after: chunks that it forgets are kept, and offered
  /// again when they are to come again. The error: a tile of the ground that cannot be one; the connection is
  /// of no more use.
  Result<void> before(const ServerMessage& message, Mirror& mirror);
  void after(const ServerMessage& message, Mirror& mirror, ServerChannel& connection);
  /// The palette, the image or the model that is whole with this message.
  std::optional<Digest> take_content(const ServerMessage& message);
  /// A prop that is here has this model.
  void want_model(const Digest& model) {
    if (config_.models) content_.want_model(model);
  }
  /// Sends the interest, and an offer of what is kept of what comes into it.
  void follow(glm::vec3 eye_m, float radius_m, Mirror& mirror, ServerChannel& connection);
  /// Call often: asks for tiles of the ground that were missed and for content, packs a few chunks, and
  /// writes the file from time to time, on another thread. Seconds, of any origin.
  void tend(double now_s, Mirror& mirror, ServerChannel& connection);
  /// Whether the ground within the interest is known, as far as its heights go.
  bool has_near_ground() const { return tiles_ == nullptr || tiles_->has_near(eye_m_, radius_m_); }
  /// Keeps all that the mirror holds: its connection is lost.
  void store(Mirror& mirror);
  /// Writes what is kept. Returns when it is written.
  void save();
  /// Before the program ends: keeps and writes what the mirror holds, if there is a folder. May be null.
  void finish(Mirror* mirror);

  /// The place of the interest.
  glm::vec3 eye_m() const { return eye_m_; }
  const ChunkCache& cache() const { return cache_; }
  /// Null when the ground has no tiles.
  const ReceivedTiles* tiles() const { return tiles_.get(); }
  /// The palette and its images.
  const ReceivedContent& content() const { return content_; }

 private:
  bool enabled() const { return config_.bytes_max != 0; }
  void load(std::optional<uint64_t> world);
  OfferMessage next_offer(const std::unordered_set<ChunkCoord, CoordHash>& held);
  void offer(const Mirror& mirror, ServerChannel& connection);
  WelcomeMessage with_ground(const WelcomeMessage& welcome);
  void ask_for_tiles(ServerChannel& connection);
  void ask_for_content(ServerChannel& connection);
  void store_chunks(double now_s, Mirror& mirror);

  CacheConfig config_;
  CacheFolder folder_;
  ChunkCache cache_;
  std::string address_;
  uint64_t world_ = 0;  ///< of the cache; 0: not known
  float voxel_size_m_ = 0.0F;
  std::shared_ptr<ReceivedTiles> tiles_;  ///< of the ground; kept for the next connection
  ReceivedContent content_;
  std::string ticket_;
  glm::vec3 eye_m_{0.0F};
  float radius_m_ = 0.0F;
  bool at_spawn_ = false;            ///< the next welcome says where the eye is
  std::vector<ChunkCoord> offered_;  ///< last, as far as the server may still know of it
  bool changed_ = false;             ///< since the last write
  std::vector<ChunkCoord> to_pack_;
  double next_store_s_ = 0.0;
  std::future<void> writing_;
};

}  // namespace scree
