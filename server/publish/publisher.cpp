#include "server/publish/publisher.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "proto/codec.h"
#include "proto/operation_codec.h"
#include "server/publish/chunks_near.h"
#include "server/publish/interest_filter.h"
#include "server/world/material_settings.h"
#include "server/world/world.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

Motions no_motions(const PublisherConfig& config) {
  return {motion_rules(config.tick_rate_hz, config.ticks_per_transform), config.terrain.voxel_size_m};
}

}  // namespace

Publisher::Publisher(const PublisherConfig& config, Workers& workers)
    : config_(config),
      rates_{config.tick_rate_hz, config.ticks_per_transform, config.heartbeat_s},
      workers_(workers),
      motions_(no_motions(config)),
      ground_(config.terrain),
      tiles_(config.terrain.heights),
      content_(config.palette, config.images, config.models),
      queries_(config.terrain, config.tick_rate_hz, state_),
      pager_(config.chunks),
      board_(config.tick_rate_hz) {}

ClientFeed* Publisher::find(uint64_t session) {
  const auto client = clients_.find(session);
  return client == clients_.end() ? nullptr : &client->second;
}

void Publisher::join(uint64_t session, glm::vec3 eye_m, float radius_m, size_t operations, bool offers,
                     uint64_t party) {
  leave(session);
  ClientFeed client(session, party != 0 ? party : session, eye_m, radius_m, operations);
  if (offers) client.offer().await(rates_.ticks_of(limits::offer_wait_s));
  clients_.emplace(session, std::move(client));
}

void Publisher::offer(uint64_t session, const OfferMessage& offer) {
  if (ClientFeed* client = find(session))
    client->offer().accept(offer, rates_.ticks_of(limits::offer_seconds_max));
}

void Publisher::leave(uint64_t session) {
  subscribe_physics(session, false);
  clients_.erase(session);
  cursors_.erase(session);
  ground_.leave(session);
  tiles_.leave(session);
  content_.leave(session);
  queries_.leave(session);
  scan_turns_.leave(session);
}

void Publisher::set_interest(uint64_t session, glm::vec3 eye_m, float radius_m) {
  if (ClientFeed* client = find(session)) client->view().set_interest(eye_m, radius_m);
}

void Publisher::set_cursor(PlayerCursor cursor, uint64_t party) {
  const uint64_t session = cursor.session;
  if (clients_.contains(session)) cursors_.insert_or_assign(session, PartyCursor{std::move(cursor), party});
}

void Publisher::set_control_refusal(uint64_t session, const std::string& refusal) {
  if (ClientFeed* client = find(session)) client->replay().set_control_refusal(refusal);
}

void Publisher::set_team(uint64_t session, const std::string& team, bool meets) {
  if (ClientFeed* client = find(session)) client->game().set_own(team, meets);
}

void Publisher::set_store(uint64_t session, const StoreName& own) {
  if (ClientFeed* client = find(session)) client->store().set_own(own);
}

void Publisher::want_stones(uint64_t session, bool wanted) {
  if (ClientFeed* client = find(session)) client->stones().want(wanted);
}

void Publisher::subscribe_physics(uint64_t session, bool physics) {
  ClientFeed* const client = find(session);
  if (client != nullptr && client->physics_feed().set_physics(physics))
    physics_subscribers_ += physics ? 1 : -1;
}

void Publisher::subscribe_contacts(uint64_t session, float least_j) {
  if (ClientFeed* const client = find(session)) client->physics_feed().set_contacts(least_j);
}

void Publisher::repair(uint64_t session, const RepairMessage& request) {
  ClientFeed* const client = find(session);
  if (client == nullptr) return;
  const size_t count = std::min(request.chunks.size(), request.hashes.size());
  for (size_t i = 0; i < count; ++i) {
    const ChunkCoord chunk = request.chunks[i];
    // A chunk that the client does not hold is being streamed already, or none of its business.
    if (!client->view().held().contains(chunk)) continue;
    if (state_.hash_at(chunk, request.tick) == request.hashes[i]) continue;
    client->repair(chunk);
    ++stats_.repairs;
  }
}

bool Publisher::ask_ground(uint64_t session, const AskGroundMessage& request) {
  ClientFeed* const client = find(session);
  return client == nullptr || ground_.ask(session, client->outlet().party(), request.chunks);
}

bool Publisher::ask_tiles(uint64_t session, const AskTilesMessage& request) {
  ClientFeed* const client = find(session);
  return client == nullptr || tiles_.ask(session, client->outlet().party(), request, client->view());
}

bool Publisher::ask_content(uint64_t session, const AskContentMessage& request) {
  ClientFeed* const client = find(session);
  return client == nullptr || content_.ask(session, client->outlet().party(), request);
}

tl::expected<void, Refused> Publisher::ask_query(uint64_t session, const QueryMessage& query) {
  ClientFeed* const client = find(session);
  if (client == nullptr) return {};
  return queries_.ask(session, client->outlet().party(), query);
}

const ClientView* Publisher::view(uint64_t session) const {
  const auto client = clients_.find(session);
  return client == clients_.end() ? nullptr : &client->second.view();
}

void Publisher::begin(const TickDelta& keyframe) {
  CHECK_EQ(state_.tick(), 0U, "the world begins once");
  CHECK(clients_.empty());
  state_.apply(keyframe);
  queries_.restart();
  take_palette(keyframe);
  motions_.track(keyframe, state_, rates_.has_poses(keyframe.tick));
}

std::vector<Outgoing> Publisher::publish(const TickDelta& delta,
                                         const std::function<Backlog(uint64_t)>& backlog) {
  out_.clear();
  const bool restarted = state_.tick() != 0 && delta.tick != state_.tick() + 1;
  if (restarted) restart();
  const ChunkSet unedited = unedited_before(delta, state_);
  if (!restarted) queries_.before(delta);
  state_.apply(delta);
  if (restarted)
    queries_.restart();
  else
    queries_.after(delta);
  pager_.page_in(state_);
  motions_.track(delta, state_, rates_.has_poses(delta.tick));
  const TickChanges changes(delta, unedited, state_, motions_, config_.terrain);
  board_.add(delta);
  count_operations(delta);
  cache_.start_tick();
  allow_scans();
  serve_all(changes, backlog);
  take_palette(delta);
  for (const ChunkCoord chunk : queries_.needed()) state_.use(chunk);
  pager_.page(state_, cache_);
  CHECK(stats_.transform_bytes <= stats_.frame_bytes);
  CHECK(stats_.frame_bytes + stats_.chunk_bytes + stats_.kept_bytes + stats_.piece_bytes +
            stats_.ground_bytes + stats_.tile_bytes + stats_.content_bytes <=
        stats_.sent_bytes);
  return std::exchange(out_, {});
}

ListedWorld Publisher::listed() const {
  auto palette = config_.palette == nullptr ? nullptr : palette_with(config_.palette, state_.settings());
  return {state_, motions_, std::move(palette), config_.terrain.voxel_size_m, rates_};
}

AdminListMessage Publisher::list(const ListBodiesRequest& request) const {
  return list_bodies(listed(), request);
}

AdminListMessage Publisher::list(const ListJointsRequest& request) const {
  return list_joints(listed(), request);
}

AdminListMessage Publisher::list(const ListStoresRequest&) const {
  AdminListMessage list;
  for (const auto& [store, masses] : state_.stores()) list.stores.push_back({store, masses});
  return list;
}

AdminListMessage Publisher::list(const ListRegionMassesRequest& request) const {
  AdminListMessage list;
  if (state_.region_masses() == nullptr) return list;
  const std::vector<Region>& regions = *state_.regions();
  for (const RegionMass& mass : *state_.region_masses()) {
    const bool asked = request.region.empty() || std::ranges::any_of(regions, [&](const Region& region) {
                         return region.id == mass.origin.region && region.name == request.region;
                       });
    if (asked) list.region_masses.push_back(mass);
  }
  return list;
}

/// Settings say which numbers of the palette stand. Clients are told after the tick's frames.
void Publisher::take_palette(const TickDelta& delta) {
  if (delta.settings.empty() || !content_.take_settings(delta.settings)) return;
  ServedPart part;
  const SharedBytes news = share(PaletteChangedMessage{*content_.palette()});
  for (auto& [session, client] : clients_) client.outlet().send(news, part);
  add(std::move(part));
}

/// A keyframe begins another past.
void Publisher::restart() {
  state_ = PublishedState();
  motions_ = no_motions(config_);
  for (auto& [session, client] : clients_) client.reset_soon();
}

/// All that the clients have in common is ready; what is only read from here on is safe to share.
void Publisher::serve_all(const TickChanges& changes, const std::function<Backlog(uint64_t)>& backlog) {
  std::vector<ClientFeed*> clients;
  clients.reserve(clients_.size());
  eyes_m_.clear();
  for (auto& [session, client] : clients_) {
    clients.push_back(&client);
    eyes_m_.push_back(client.view().eye_m());
  }
  const StatusMessage status = this->status();
  const ServedTick tick{changes, cache_, status, cursors_, rates_};
  std::vector<ServedPart> parts(Workers::parts_of(clients.size(), limits::sessions_per_part));
  const auto serve_some = [&](size_t index, std::span<ClientFeed*> some) {
    ServedPart part;
    for (ClientFeed* client : some) client->serve(tick, backlog(client->outlet().session()), part);
    parts[index] = std::move(part);
  };
  workers_.share(std::span(clients), limits::sessions_per_part, serve_some);
  for (ServedPart& part : parts) add(std::move(part));
}

ClientView* Publisher::reader(uint64_t session, const Backlog& backlog) {
  ClientFeed& client = clients_.at(session);
  const bool reads_along = !client.stopped() && backlog.reads_along();
  return reads_along && client.outlet().has_room() ? &client.view() : nullptr;
}

/// The first is allowed whatever it costs.
void Publisher::allow_scans() {
  for (auto& [session, client] : clients_) {
    const bool wants = client.view().wants_scan(state_.tick());
    client.allow_scan(!wants);
    if (wants)
      scan_turns_.wait(session, client.outlet().party());
    else
      scan_turns_.leave(session);
  }
  scan_turns_.begin();
  for (uint64_t looked_at = 0; looked_at < limits::scanned_chunks_per_tick && !scan_turns_.empty();) {
    ClientFeed& client = clients_.at(scan_turns_.next());
    client.allow_scan(true);
    const double places = places_near(client.view().radius_m(), config_.terrain.voxel_size_m);
    const auto cost = 1 + static_cast<uint64_t>(std::min<double>(places, state_.chunks().size()));
    scan_turns_.charge(cost, FairTurns::Then::leaves);
    looked_at += cost;
  }
  scan_turns_.end();
}

/// The tick's frames do not count on ground and tiles; the next ones do. Content decides nothing.
std::vector<Outgoing> Publisher::stream(const std::function<Backlog(uint64_t)>& backlog) {
  ServedPart part;
  const auto reader_of = [&](uint64_t session) { return reader(session, backlog(session)); };
  const auto send_to = [&](uint64_t session, const SharedBytes& bytes) {
    Outlet& outlet = clients_.at(session).outlet();
    outlet.send(bytes, part);
    return outlet.has_room();
  };
  ground_.serve(reader_of, [&](uint64_t session, const SharedBytes& bytes) {
    part.stats.ground_bytes += bytes->size();
    return send_to(session, bytes);
  });
  tiles_.serve(reader_of, [&](uint64_t session, const SharedBytes& bytes) {
    part.stats.tile_bytes += bytes->size();
    return send_to(session, bytes);
  });
  const auto room_of = [&](uint64_t session) -> size_t {
    if (reader_of(session) == nullptr) return 0;
    const Outlet& outlet = clients_.at(session).outlet();
    return outlet.is_slow() ? static_cast<size_t>(std::max<int64_t>(1, outlet.room_bytes()))
                            : limits::content_part_bytes_max;
  };
  content_.serve(room_of, [&](uint64_t session, const SharedBytes& bytes) {
    part.stats.content_bytes += bytes->size();
    return send_to(session, bytes);
  });
  part.paged = queries_.serve(reader_of, send_to);
  add(std::move(part));
  return std::exchange(out_, {});
}

void Publisher::add(ServedPart&& part) {
  out_.insert(out_.end(), std::make_move_iterator(part.out.begin()), std::make_move_iterator(part.out.end()));
  stats_ += part.stats;
  for (const ChunkCoord chunk : part.used) state_.use(chunk);
  pager_.want(part.paged);
}

void Publisher::count_operations(const TickDelta& delta) {
  for (const AppliedOperation& applied : delta.operations) {
    ++stats_.operations[applied.operation];
    stats_.operation_bytes[applied.operation] += operation_bytes(applied.operation);
  }
}

std::vector<Outgoing> Publisher::answer(const TickDelta& delta,
                                        const std::function<ServerLatency(const Reply&)>& latency) {
  ServedPart replies;
  for (const Reply& reply : delta.replies) {
    ClientFeed* const client = find(reply.session);
    if (client == nullptr) continue;
    client->outlet().send(
        share(ReplyMessage{reply.request, reply.refusal, reply.pieces, refusal_name(reply), latency(reply),
                           delta.tick, reply.painted, reply.prop, reply.joint, reply.mass}),
        replies);
  }
  add(std::move(replies));
  return std::exchange(out_, {});
}

}  // namespace scree
