#include "tests/fuzz/support/fuzz_server.h"

#include <spdlog/spdlog.h>

#include "shared/base/check.h"

namespace scree {

namespace {

/// Ticks within which a client that reads has been sent all that it follows.
constexpr int settling_ticks = 12;

NetConfig net_config(const TerrainSource& terrain) {
  spdlog::set_level(spdlog::level::off);
  NetConfig config;
  config.terrain = terrain;
  config.service.sessions_max = 6;
  config.admin_token = FuzzServer::admin_token;
  config.web.on = false;  // what a server sends is the protocol
  return config;
}

WorldConfig world_config(const TerrainSource& terrain) {
  WorldConfig config;
  config.terrain = terrain;
  config.service.sessions_max = 6;
  return config;
}

}  // namespace

void FuzzClient::receive() {
  reader_.push(link->drain_arrived());
  for (;;) {
    const auto body = reader_.next();
    CHECK(body.has_value());
    if (!body->has_value()) return;
    const auto message = decode_server(**body);
    if (!message) std::fprintf(stderr, "the server sent: %s\n", message.error().message.c_str());
    CHECK(message.has_value());
    if (records) received.emplace_back((**body).begin(), (**body).end());
    apply(*message);
  }
}

void FuzzClient::apply(const ServerMessage& message) {
  if (const auto* welcome = std::get_if<WelcomeMessage>(&message)) {
    CHECK(!mirror);
    mirror.emplace(*welcome);
    ticket = welcome->ticket;
    world = welcome->world;
    return;
  }
  if (std::holds_alternative<RefusalMessage>(message)) refused = true;
  if (!mirror || refused) return;
  const auto applied = mirror->apply(message);
  if (!applied && offers) return link->end(true);  // a liar harms itself
  if (!applied) std::fprintf(stderr, "a mirror cannot go on: %s\n", applied.error().message.c_str());
  CHECK(applied.has_value());
  CHECK(offers || mirror->mismatches() == 0);
  if (!offers) return;
  if (const auto repair = mirror->next_repair_request()) send(*repair);
}

FuzzServer::FuzzServer(const TerrainSource& terrain)
    : world_(world_config(terrain)), host_(net_config(world_.config().terrain), commands_) {
  CHECK(host_.listen().has_value());
}

/// What waits in a link holds its session.
FuzzServer::~FuzzServer() {
  host_.shut_down();
  pump();
  for (const auto& client : clients_) client->link->close();
}

FuzzClient* FuzzServer::connect(uint32_t address) {
  if (clients_.size() == clients_max) return nullptr;
  auto client = std::make_unique<FuzzClient>("10.0.0." + std::to_string(address));
  if (!host_.enter(client->link)) return nullptr;
  clients_.push_back(std::move(client));
  return clients_.back().get();
}

void FuzzServer::pump(size_t bytes) {
  for (bool moved = true; moved;) {
    moved = false;
    for (const auto& client : clients_) moved = client->link->pump(bytes) || moved;
  }
  for (const auto& client : clients_) client->receive();
}

void FuzzServer::tick(bool more) {
  world_.want_physics(host_.figures().wants_physics());
  const std::vector<Command> commands = commands_.drain();
  const auto delta = world_.step(commands);
  work_us_ += delta->work.estimate_us;
  host_.publish(*delta, instant(0.0), more);
  pump();
}

void FuzzServer::check_mirrors() {
  for (const auto& client : clients_) client->link->read_on(true);
  pump();
  for (int i = 0; i < settling_ticks; ++i) tick();
  for (const auto& client : clients_) {
    if (!client->joined() || client->refused || client->offers || client->link->closed()) continue;
    Mirror& mirror = *client->mirror;
    CHECK(!mirror.next_repair_request());
    for (const ChunkCoord chunk : mirror.held_chunks())
      CHECK(mirror.field().chunk_hash(chunk) == world_.field().chunk_hash(chunk));
  }
}

}  // namespace scree
