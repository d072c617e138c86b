// A host with a rule of its own: nobody carves within 10 m of its tower. It runs a server, and a client on
// loopback that asks for one carve there and one beyond.
#include <chrono>
#include <cstdio>
#include <glm/geometric.hpp>
#include <variant>

#include "client/connection/connection.h"
#include "server/app/live_server.h"

using namespace scree;

/// The rule: before each tick, on the thread that simulates.
void protect_tower(const World&, TickCommands& commands) {
  constexpr float protected_m = 10.0F;
  for (size_t i = 0; i < commands.all().size(); ++i) {
    const auto* const carve = std::get_if<CarveRequest>(&commands.all()[i].body);
    if (carve != nullptr && glm::length(centre_of(carve->shape)) < protected_m)
      commands.refuse(i, "the tower's ground is protected", "protected");
  }
}

int main() {
  LiveConfig config;
  config.world.terrain = {TerrainKind::flat, 1, 0.25F};
  config.pacing = Pacing::by_hand;
  config.hooks.before = protect_tower;
  const auto server = LiveServer::start(config);
  if (!server) return std::printf("no server: %s\n", server.error().message.c_str()), 1;

  ServerEndpoint endpoint;
  endpoint.port = (*server)->port();
  const HelloMessage hello{protocol_version, "guest", {0.0F, 2.0F, 0.0F}, 64.0F};
  const auto client = Connection::connect(endpoint, hello, std::chrono::seconds(10));
  if (!client) return std::printf("no client: %s\n", client.error().message.c_str()), 1;
  for (const uint32_t request : {1U, 2U}) {
    CarveMessage carve;
    carve.request = request;
    carve.shape = sphere({request == 1 ? 2.0F : 30.0F, 0.0F, 0.0F}, 2.0F);
    (*client)->send(carve);
  }

  int replies = 0;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (replies < 2 && std::chrono::steady_clock::now() < deadline) {
    (*server)->step_once();
    for (const Received& received : (*client)->poll())
      if (const auto* const reply = std::get_if<ReplyMessage>(&received.message)) {
        ++replies;
        if (reply->refusal.empty())
          std::printf("carve %u: %u pieces\n", reply->request, reply->pieces);
        else
          std::printf("carve %u: refused (%s): %s\n", reply->request, reply->refusal_name.c_str(),
                      reply->refusal.c_str());
      }
  }
  return replies == 2 ? 0 : 1;
}
