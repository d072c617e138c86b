#include "server/publish/publisher.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "proto/codec.h"
#include "proto/operation_codec.h"
#include "server/publish/limits.h"
#include "server/publish/watching.h"
#include "server/world/world.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

Motions no_motions(const PublisherConfig& config) {
  return {motion_rules(config.tick_rate_hz, config.ticks_per_transform), config.terrain.voxel_size_m};
}

/// Bricks that may be patched: they are much, so who reads slowly gets none, and later the chunks as they are
/// then. By a slow link they have the room that is left.
size_t patches_for(const Backlog& backlog) {
  if (!backlog.reads_along()) return 0;
  if (!backlog.is_slow()) return limits::patch_bricks_max;
  return static_cast<size_t>(std::max<int64_t>(0, backlog.room_bytes())) / limits::patch_brick_bytes;
}

}  // namespace

PublisherStats& PublisherStats::operator+=(const PublisherStats& other) {
  sent_bytes += other.sent_bytes;
  frame_bytes += other.frame_bytes;
  transform_bytes += other.transform_bytes;
  chunk_bytes += other.chunk_bytes;
  kept_bytes += other.kept_bytes;
  chunks_kept += other.chunks_kept;
  piece_bytes += other.piece_bytes;
  ground_bytes += other.ground_bytes;
  tile_bytes += other.tile_bytes;
  operations += other.operations;
  operation_bytes += other.operation_bytes;
  repairs += other.repairs;
  resets += other.resets;
  return *this;
}

Publisher::Publisher(const PublisherConfig& config, Workers& workers)
    : config_(config),
      workers_(workers),
      motions_(no_motions(config)),
      ground_(config.terrain),
      tiles_(config.terrain.heights),
      clock_(config.tick_rate_hz) {}

void Publisher::join(uint64_t session, glm::vec3 eye_m, float radius_m, size_t operations, bool offers) {
  leave(session);
  Client client{session, ClientView(eye_m, radius_m, operations)};
  if (offers) client.offer.await(ticks_of(limits::offer_wait_s));
  clients_.emplace(session, std::move(client));
}

void Publisher::offer(uint64_t session, const OfferMessage& offer) {
  const auto client = clients_.find(session);
  if (client != clients_.end()) client->second.offer.take(offer, ticks_of(limits::offer_seconds_max));
}

void Publisher::leave(uint64_t session) {
  watch(session, false);
  clients_.erase(session);
  cursors_.erase(session);
  ground_.leave(session);
  tiles_.leave(session);
}

void Publisher::set_interest(uint64_t session, glm::vec3 eye_m, float radius_m) {
  const auto client = clients_.find(session);
  if (client != clients_.end()) client->second.view.set_interest(eye_m, radius_m);
}

void Publisher::set_cursor(PlayerCursor cursor) {
  if (clients_.contains(cursor.session)) cursors_.insert_or_assign(cursor.session, std::move(cursor));
}

void Publisher::watch(uint64_t session, bool physics) {
  const auto client = clients_.find(session);
  if (client == clients_.end() || client->second.watches == physics) return;
  client->second.watches = physics;
  watchers_ += physics ? 1 : -1;
}

void Publisher::repair(uint64_t session, const RepairMessage& request) {
  const auto found = clients_.find(session);
  if (found == clients_.end()) return;
  Client& client = found->second;
  const size_t count = std::min(request.chunks.size(), request.hashes.size());
  for (size_t i = 0; i < count; ++i) {
    const ChunkCoord chunk = request.chunks[i];
    if (!client.view.held().contains(chunk)) continue;  // being streamed already, or none of its business
    if (state_.hash_at(chunk, request.tick) == request.hashes[i]) continue;
    client.view.distrust(chunk);
    ++client.repairs;
    ++stats_.repairs;
  }
}

bool Publisher::ask_ground(uint64_t session, const AskGroundMessage& request) {
  return !clients_.contains(session) || ground_.ask(session, request.chunks);
}

bool Publisher::ask_tiles(uint64_t session, const AskTilesMessage& request) {
  const auto client = clients_.find(session);
  return client == clients_.end() || tiles_.ask(session, request, client->second.view);
}

const ClientView* Publisher::view(uint64_t session) const {
  const auto client = clients_.find(session);
  return client == clients_.end() ? nullptr : &client->second.view;
}

std::vector<Outgoing> Publisher::publish(const TickDelta& delta,
                                         const std::function<Backlog(uint64_t)>& backlog) {
  out_.clear();
  const bool restarted = state_.tick() != 0 && delta.tick != state_.tick() + 1;
  if (restarted) {
    state_ = PublishedState();
    motions_ = no_motions(config_);
    for (auto& [session, client] : clients_) client.reset_due = true;
  }
  // TickChanges must know the chunks edited before this tick: it reads the old state here, and refers to the
  // same object after apply(), so that no copy is needed.
  const TickChanges changes(delta, state_, state_, motions_, config_.terrain);
  state_.apply(delta);
  take_chunks();
  motions_.track(delta, state_, has_poses(delta.tick));
  clock_.add(delta.times, delta.work);
  count_operations(delta);
  cache_.start_tick();
  serve_all(changes, backlog);
  Part rest;
  stream_ground(backlog, rest);
  stream_tiles(backlog, rest);
  add(std::move(rest));
  page_out();
  CHECK(stats_.transform_bytes <= stats_.frame_bytes);
  CHECK(stats_.frame_bytes + stats_.chunk_bytes + stats_.kept_bytes + stats_.piece_bytes +
            stats_.ground_bytes + stats_.tile_bytes <=
        stats_.sent_bytes);
  return std::exchange(out_, {});
}

/// All that the clients have in common is ready; what is only read from here on is safe to share.
void Publisher::serve_all(const TickChanges& changes, const std::function<Backlog(uint64_t)>& backlog) {
  std::vector<Client*> clients;
  clients.reserve(clients_.size());
  eyes_m_.clear();
  for (auto& [session, client] : clients_) {
    clients.push_back(&client);
    eyes_m_.push_back(client.view.eye_m());
  }
  status_ = status();
  std::vector<Part> parts(Workers::parts_of(clients.size(), limits::sessions_per_part));
  const auto serve_some = [&](size_t index, std::span<Client*> some) {
    Part part;
    for (Client* client : some) serve(*client, changes, backlog(client->session), part);
    parts[index] = std::move(part);
  };
  workers_.share(std::span(clients), limits::sessions_per_part, serve_some);
  for (Part& part : parts) add(std::move(part));
}

void Publisher::add(Part&& part) {
  out_.insert(out_.end(), std::make_move_iterator(part.out.begin()), std::make_move_iterator(part.out.end()));
  stats_ += part.stats;
  for (const ChunkCoord chunk : part.used) state_.use(chunk);
  paged_.insert(paged_.end(), part.paged.begin(), part.paged.end());
}

void Publisher::count_operations(const TickDelta& delta) {
  for (const AppliedOperation& applied : delta.operations) {
    ++stats_.operations[applied.operation];
    stats_.operation_bytes[applied.operation] += operation_bytes(applied.operation);
  }
}

/// Whether the client gets a frame in this tick. A stopped client that has read everything starts again.
bool Publisher::ready(Client& client, size_t backlog_bytes, Part& part) {
  if (!client.stopped && backlog_bytes > limits::outbox_resync_bytes) client.stopped = true;
  if (client.stopped) {
    if (backlog_bytes != 0) return false;
    client.stopped = false;
    client.reset_due = true;
    ++part.stats.resets;
  }
  if (client.reset_due) {
    client.reset_due = false;
    client.view.reset();
    client.offer.forget();
    client.last_frame = 0;
    send(client, share(ResetMessage{}), part);
  }
  return true;
}

void Publisher::serve(Client& client, const TickChanges& changes, const Backlog& backlog, Part& part) {
  if (!ready(client, backlog.bytes, part)) return;
  const Tick tick = changes.delta.tick;
  const bool reads_along = backlog.reads_along();
  client.room_bytes = backlog.room_bytes();
  client.is_slow = backlog.is_slow();
  const bool with_poses = reads_along && has_poses(tick);
  if (!send_frame(client, changes, {with_poses, patches_for(backlog)}, part)) return;
  if (changes.delta.playback) send_replay(client, changes.delta, reads_along, part);
  // Pieces first: by a slow link, chunks take all the room there is, and what merges unknown pieces comes as
  // bricks.
  if (with_poses) stream_pieces(client, part);
  if (reads_along) stream_chunks(client, changes, part);
  if (status_due(client, tick)) send_status(client, part);
  if (!reads_along) return;
  if (tick % ticks_per_watch == 0) send_cursors(client, part);
  if (client.watches && changes.delta.physics) send_physics(client, *changes.delta.physics, part);
}

/// Whether the client gets a frame of this tick though nothing happened for it.
bool Publisher::frame_due(const Client& client, Tick tick) const {
  return client.last_frame == 0 || tick >= client.last_frame + ticks_of(config_.heartbeat_s) ||
         status_due(client, tick);
}

bool Publisher::send_frame(Client& client, const TickChanges& changes, FrameScope scope, Part& part) {
  FrameSelection selection = client.view.select_frame(changes, scope);
  const Tick tick = changes.delta.tick;
  if (selection.is_empty() && !frame_due(client, tick)) return true;
  client.last_frame = tick;
  const EncodeCache::Frame& frame = cache_.frame(std::move(selection), changes);
  if (frame.bytes->size() > limits::message_bytes_max) {
    // A frame of this size must not cross the wire: the client is reset, and gets the state in small
    // messages.
    client.reset_due = true;
    return false;
  }
  part.stats.frame_bytes += frame.bytes->size();
  part.stats.transform_bytes += frame.transform_bytes;
  send(client, frame.bytes, part);
  return true;
}

void Publisher::send_cursors(Client& client, Part& part) {
  std::vector<PlayerCursor> now =
      cursors_for(client.session, cursors_, client.view.eye_m(), client.view.radius_m());
  if (now == client.cursors) return;
  client.cursors = now;
  send(client, share(CursorsMessage{std::move(now)}), part);
}

void Publisher::send_physics(Client& client, const PhysicsMessage& physics, Part& part) {
  constexpr int64_t budget = limits::physics_bytes_per_tick * int64_t{ticks_per_watch};
  client.physics_credit_bytes = std::min(client.physics_credit_bytes + budget, budget);
  if (client.physics_credit_bytes <= 0 || client.room_bytes <= 0) return;
  const PhysicsMessage near =
      physics_for(physics, state_, config_.terrain.voxel_size_m, client.view.eye_m(), client.view.radius_m());
  const SharedBytes bytes = share(near);
  client.physics_credit_bytes -= size_of(bytes);
  send(client, bytes, part);
}

std::vector<Outgoing> Publisher::answer(const TickDelta& delta,
                                        const std::function<ServerLatency(const Reply&)>& latency) {
  Part replies;
  for (const Reply& reply : delta.replies) {
    const auto client = clients_.find(reply.session);
    if (client == clients_.end()) continue;
    const std::string name = reply.reason ? std::string(name_of(*reply.reason)) : std::string();
    send(client->second,
         share(ReplyMessage{reply.request, reply.refusal, reply.pieces, name, latency(reply), delta.tick}),
         replies);
  }
  add(std::move(replies));
  return std::exchange(out_, {});
}

StatusMessage Publisher::status() const {
  StatusMessage status;
  status.tick = state_.tick();
  status.clients = static_cast<uint32_t>(clients_.size());
  status.pieces = static_cast<uint32_t>(state_.pieces().size());
  status.ledger_terrain = state_.ledger().terrain;
  status.ledger_pieces = state_.ledger().pieces;
  status.ledger_dust = state_.ledger().dust;
  status.ledger_poured = state_.ledger().poured;
  status.ledger_moved = state_.ledger().moved;
  status.tick_median_ms = clock_.median_ms();
  status.tick_worst_ms = clock_.worst_ms();
  status.stages = clock_.stages();
  status.work = clock_.work();
  status.pieces_made = state_.pieces_made();
  status.pieces_merged = state_.pieces_merged();
  status.field_hash = state_.field_hash();
  status.settings = state_.settings();
  status.latency = latency_;
  status.saving = saving_.how;
  status.saved_tick = saving_.tick;
  status.paging = saving_.paging;
  for (size_t i = 0; i < refusal_reasons; ++i) {
    const auto reason = static_cast<Refusal>(i);
    if (refusals_.of(reason) > 0)
      status.refusals.push_back({std::string(name_of(reason)), refusals_.of(reason)});
  }
  return status;
}

void Publisher::send_status(Client& client, Part& part) {
  StatusMessage status = status_;
  status.sent_bytes = client.sent_bytes;
  status.repairs = client.repairs;
  status.chunks_waiting = static_cast<uint32_t>(client.view.chunks_waiting());
  send(client, share(status), part);
}

void Publisher::send(Client& client, SharedBytes bytes, Part& part) {
  client.sent_bytes += bytes->size();
  client.room_bytes -= size_of(bytes);
  part.stats.sent_bytes += bytes->size();
  part.out.push_back({client.session, std::move(bytes)});
}

}  // namespace scree
