#include "client/cache/rejoin.h"

#include <algorithm>
#include <utility>

#include "client/cache/limits.h"
#include "proto/limits.h"
#include "shared/base/limits.h"

namespace scree {

Rejoin::Rejoin(const CacheConfig& config)
    : config_(config),
      folder_(config.folder, config.bytes_max),
      cache_(config.bytes_max),
      content_(TileFolder(config.bytes_max != 0 ? config.folder : std::string(), content_extension,
                          limits::content_bytes_max),
               config.images) {}

void Rejoin::load(std::optional<uint64_t> world) {
  const auto cached = folder_.read(address_, world);
  if (!cached) return;
  world_ = cached->world;
  voxel_size_m_ = cached->voxel_size_m;
  cache_ = ChunkCache(config_.bytes_max);
  cache_.load(cached->chunks);
}

Rejoin::Opening Rejoin::open(const std::string& address, HelloMessage hello) {
  save();
  address_ = address;
  if (enabled() && world_ == 0) load(std::nullopt);
  eye_m_ = hello.eye_m;
  radius_m_ = hello.interest_radius_m;
  at_spawn_ = hello.at_spawn;
  hello.ticket = ticket_;
  Opening opening{std::move(hello), {}};
  offered_.clear();
  if (world_ == 0) return opening;
  OfferMessage offer = next_offer({});
  if (offer.chunks.empty()) return opening;
  opening.hello.world = world_;
  opening.then.emplace_back(std::move(offer));
  return opening;
}

/// Tiles that came by an earlier connection are not asked for again.
WelcomeMessage Rejoin::with_ground(const WelcomeMessage& welcome) {
  WelcomeMessage grounded = welcome;
  if (!welcome.heights) {
    tiles_.reset();
  } else if (tiles_ == nullptr || tiles_->ground() != *welcome.heights) {
    tiles_ = std::make_shared<ReceivedTiles>(*welcome.heights,
                                             TileFolder(enabled() ? folder_.path() : std::string()));
  } else {
    tiles_->begin_session();
  }
  grounded.terrain.heights = tiles_;
  return grounded;
}

void Rejoin::ask_for_tiles(ServerChannel& connection) {
  if (tiles_ == nullptr) return;
  const AskTilesMessage request = tiles_->next_request(eye_m_, radius_m_);
  if (!request.wanted.empty() || !request.held.empty()) connection.send(request);
}

void Rejoin::ask_for_content(ServerChannel& connection) {
  const AskContentMessage request = content_.next_request();
  if (!request.wanted.empty()) connection.send(request);
}

std::optional<Digest> Rejoin::take_content(const ServerMessage& message) {
  if (const auto* changed = std::get_if<PaletteChangedMessage>(&message))
    content_.change_palette(changed->palette);
  if (const auto* part = std::get_if<ContentMessage>(&message)) return content_.accept(*part);
  return std::nullopt;
}

std::unique_ptr<Mirror> Rejoin::begin(ServerChannel& connection) {
  const WelcomeMessage welcome = with_ground(connection.welcome());
  if (std::exchange(at_spawn_, false) && welcome.spawn) eye_m_ = welcome.spawn->eye_m;
  ask_for_tiles(connection);
  content_.begin_session(welcome.palette);
  ask_for_content(connection);
  ticket_ = welcome.ticket;
  to_pack_.clear();
  if (!enabled()) return std::make_unique<Mirror>(welcome);
  if (welcome.world != world_) {
    world_ = 0;
    offered_.clear();
    cache_ = ChunkCache(config_.bytes_max);
    load(welcome.world);
  }
  world_ = welcome.world;
  voxel_size_m_ = welcome.terrain.voxel_size_m;
  auto mirror = std::make_unique<Mirror>(welcome, [this](ChunkCoord chunk) { return cache_.find(chunk); });
  offer(*mirror, connection);
  return mirror;
}

/// Empty when the server knows all of it.
OfferMessage Rejoin::next_offer(const std::unordered_set<ChunkCoord, CoordHash>& held) {
  // Whose place is not known yet offers what it has, wherever that is.
  const float radius_m = at_spawn_ ? 2.0F * limits::world_half_width_m : radius_m_ + limits::offer_margin_m;
  OfferMessage offer = cache_.offer(eye_m_, radius_m, voxel_size_m_, held);
  offer.world = world_;
  if (std::ranges::includes(offered_, offer.chunks)) return {};
  offered_ = offer.chunks;
  return offer;
}

void Rejoin::offer(const Mirror& mirror, ServerChannel& connection) {
  const OfferMessage offer = next_offer(mirror.held_chunks());
  if (!offer.chunks.empty()) connection.send(offer);
}

Result<void> Rejoin::before(const ServerMessage& message, Mirror& mirror) {
  if (const auto* tile = std::get_if<TileMessage>(&message)) {
    if (tiles_ == nullptr) return fail("a tile of a ground that has none");
    TRY(tiles_->accept(*tile));
    if (tiles_->tiles_received() % limits::tiles_between_bounds == 0) folder_.bound();
  }
  if (!enabled()) return {};
  if (std::holds_alternative<ResetMessage>(message)) store(mirror);
  const auto* frame = std::get_if<FrameMessage>(&message);
  if (frame == nullptr) return {};
  if (!frame->dropped_chunks.empty()) offered_.clear();
  for (const ChunkCoord chunk : frame->dropped_chunks)
    if (mirror.held_chunks().contains(chunk)) changed_ = cache_.store(mirror.field(), chunk) || changed_;
  return {};
}

void Rejoin::after(const ServerMessage& message, Mirror& mirror, ServerChannel& connection) {
  if (!enabled() || !std::holds_alternative<ResetMessage>(message)) return;
  offered_.clear();
  offer(mirror, connection);
}

void Rejoin::follow(glm::vec3 eye_m, float radius_m, Mirror& mirror, ServerChannel& connection) {
  eye_m_ = eye_m;
  radius_m_ = radius_m;
  connection.send(InterestMessage{eye_m, radius_m});
  if (enabled()) offer(mirror, connection);
}

void Rejoin::tend(double now_s, Mirror& mirror, ServerChannel& connection) {
  ask_for_tiles(connection);
  ask_for_content(connection);
  store_chunks(now_s, mirror);
}

void Rejoin::store_chunks(double now_s, Mirror& mirror) {
  if (!enabled()) return;
  for (size_t packed = 0; packed < limits::chunks_packed_at_once && !to_pack_.empty();) {
    const ChunkCoord chunk = to_pack_.back();
    to_pack_.pop_back();
    if (!mirror.held_chunks().contains(chunk) || !cache_.store(mirror.field(), chunk)) continue;
    changed_ = true;
    ++packed;
  }
  if (!to_pack_.empty() || now_s < next_store_s_) return;
  if (next_store_s_ > 0.0) {
    to_pack_.assign(mirror.held_chunks().begin(), mirror.held_chunks().end());
    const bool busy =
        writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
    if (changed_ && !busy && !config_.folder.empty()) {
      changed_ = false;
      writing_ = std::async(std::launch::async, [folder = folder_, address = address_,
                                                 cached = CachedWorld{world_, voxel_size_m_, cache_.all()}] {
        folder.write(address, cached);
      });
    }
  }
  next_store_s_ = now_s + limits::cache_interval_s;
}

void Rejoin::store(Mirror& mirror) {
  if (!enabled()) return;
  size_t packed = 0;
  for (const ChunkCoord chunk : mirror.held_chunks()) {
    if (packed == limits::chunks_packed_at_end) break;
    packed += cache_.store(mirror.field(), chunk) ? 1 : 0;
  }
  changed_ = changed_ || packed > 0;
}

void Rejoin::finish(Mirror* mirror) {
  if (config_.folder.empty()) return;
  if (mirror != nullptr) store(*mirror);
  save();
}

void Rejoin::save() {
  if (writing_.valid()) writing_.get();
  if (!changed_ || world_ == 0) return;
  changed_ = false;
  folder_.write(address_, {world_, voxel_size_m_, cache_.all()});
}

}  // namespace scree
