// Clients of a whole server: messages of every kind in any order, whole, cut and damaged, connections that
// come, stall, leave and break, and ticks of the world between them.
//
// Holds: what the server sends can be decoded and applied, at every client; the mirrors' checks agree, and in
// the end the mirrors are the world as far as they hold it; the ledger balances.
#include <algorithm>
#include <array>

#include "content/files/palette_file.h"
#include "proto/codec.h"
#include "shared/base/check.h"
#include "tests/fuzz/support/any_question.h"
#include "tests/fuzz/support/any_request.h"
#include "tests/fuzz/support/any_rules_act.h"
#include "tests/fuzz/support/fuzz_server.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

constexpr Tick ticks_max = 48;
constexpr uint64_t work_max_us = 15'000;
const TerrainSource terrain{TerrainKind::flat, 1, 1.0F};

ChunkCoord any_chunk(FuzzInput& input) {
  const auto axis = [&] {
    return input.below(16) == 15 ? input.number<int32_t>() / 4096 : input.byte() % 7 - 3;
  };
  const int32_t x = axis();
  const int32_t y = axis();
  return {x, y, axis()};
}

std::vector<ChunkCoord> any_chunks(FuzzInput& input) {
  std::vector<ChunkCoord> chunks;
  for (uint32_t count = input.below(12); count > 0; --count) chunks.push_back(any_chunk(input));
  return chunks;
}

/// Its length in front, whatever the body is.
void send_body(FuzzClient& client, std::span<const uint8_t> body) {
  const auto length = static_cast<uint32_t>(body.size());
  const std::array<uint8_t, length_prefix_bytes> prefix = {
      static_cast<uint8_t>(length), static_cast<uint8_t>(length >> 8U), static_cast<uint8_t>(length >> 16U),
      static_cast<uint8_t>(length >> 24U)};
  client.link->send(prefix);
  client.link->send(body);
}

/// Whose ticket or world is meant; null: nobody's.
const FuzzClient* any_client(FuzzInput& input, FuzzServer& server) {
  const auto& clients = server.clients();
  return clients.empty() ? nullptr : clients[input.byte() % clients.size()].get();
}

HelloMessage any_hello(FuzzInput& input, FuzzServer& server) {
  HelloMessage hello;
  hello.client = "fuzz";
  hello.lacks_kernels = input.flag();
  hello.eye_m = input.place(40.0F);
  hello.interest_radius_m = input.coordinate(100.0F);
  const uint32_t token = input.below(8);
  if (token == 0) hello.token = input.text(limits::access_token_bytes_max);
  if (token == 1) hello.token = FuzzServer::admin_token;
  if (token == 7) hello.operations = input.below(operation_kinds + 1);
  const uint32_t before = input.below(8);
  if (const FuzzClient* other = before < 4 ? any_client(input, server) : nullptr) {
    if (before % 2 == 0) hello.ticket = other->ticket;
    if (before < 2) hello.world = other->world;
  }
  return hello;
}

/// An offer of chunks in order, which the client need not have.
OfferMessage any_offer(FuzzInput& input, FuzzServer& server) {
  const FuzzClient* const client = any_client(input, server);
  OfferMessage offer{client == nullptr ? 1 : client->world, any_chunks(input), {}};
  std::ranges::sort(offer.chunks);
  offer.chunks.erase(std::unique(offer.chunks.begin(), offer.chunks.end()), offer.chunks.end());
  for (const ChunkCoord chunk : offer.chunks) {
    const bool has = client != nullptr && client->mirror && input.flag();
    offer.hashes.push_back(has ? short_hash(client->mirror->field().chunk_hash(chunk)) : input.byte());
  }
  return offer;
}

AdminMessage any_admin(FuzzInput& input) {
  AdminMessage admin;
  admin.request = input.byte();
  if (input.below(4) != 0) admin.token = FuzzServer::admin_token;
  const std::string address = "10.0.0." + std::to_string(input.below(4));
  const uint64_t session = input.below(12);
  switch (input.below(11)) {
    case 10:
      admin.act =
          ListFlightRequest{any_number_as<FlightList>(input), input.byte(), input.number<uint16_t>() % 300U};
      break;
    case 9:
      admin.act = ControlRulesRequest{any_number_as<RulesControl>(input), "", input.text(64)};
      if (input.below(3) == 1)
        admin.act = HistoryRequest{input.place(64.0F), 4.0F, input.text(8), input.byte()};
      if (input.below(3) == 1)
        admin.act = UndoRequest{any_number_as<UndoMode>(input), input.text(8), input.byte()};
      break;
    case 0:
      admin.act = ListSessionsRequest{};
      break;
    case 7:
      admin.act = ListBodiesRequest{PlacesWithin{input.place(40.0F), input.place(40.0F)}, {input.byte()}};
      break;
    case 8:
      admin.act = ListJointsRequest{};
      break;
    case 1:
      admin.act = KickRequest{session, input.text(limits::admin_reason_bytes_max)};
      break;
    case 2:
      admin.act = BanRequest{session, session == 0 ? address : "", input.byte(), "fuzz"};
      break;
    case 3:
      admin.act = ListBansRequest{};
      break;
    case 4:
      admin.act = LiftBanRequest{input.flag() ? address : input.text(limits::address_bytes_max)};
      break;
    case 5:
      admin.act = ControlReplayRequest{ReplayPlay::play, 2.0F, ReplayMove::by_ticks, input.byte()};
      break;
    case 6:
      if (input.flag()) {
        admin.act = ListStoresRequest{};
        break;
      }
      [[fallthrough]];
    default:
      admin.act = SettingsRequest{any_settings(input)};
  }
  return admin;
}

QueryMessage any_query(FuzzInput& input, uint32_t number) {
  QueryMessage query{number, input.below(4) == 3 ? input.below(64) : 0, {}};
  for (uint32_t count = input.below(5); count > 0; --count) {
    Question question{any_asked(input)};
    question.mask.terrain = input.below(4) != 3;
    if (input.below(16) == 15) question.mask.except = {input.byte()};
    query.questions.push_back(question);
  }
  return query;
}

ClientMessage any_store_message(FuzzInput& input, uint32_t number) {
  const PieceId piece = input.byte();
  Request asked = any_store_request(input, piece);
  if (const auto* transfer = std::get_if<TransferRequest>(&asked)) return TransferMessage{*transfer, number};
  if (auto* place = std::get_if<PlaceRequest>(&asked)) {
    place->shape = known(place->shape);
    return PlaceMessage{*place, number};
  }
  auto& dig = std::get<DigRequest>(asked);
  dig.shape = known(dig.shape);
  return DigMessage{dig, number};
}

ClientMessage any_message(FuzzInput& input, FuzzServer& server) {
  switch (input.below(15)) {
    case 0:
      return any_hello(input, server);
    case 1:
      return InterestMessage{input.place(80.0F), input.coordinate(100.0F)};
    case 2: {
      RepairMessage repair{input.byte(), any_chunks(input), {}};
      for (size_t i = 0; i < repair.chunks.size(); ++i) repair.hashes.push_back(input.byte());
      return repair;
    }
    case 3:
      return AckMessage{input.number<uint64_t>()};
    case 4:
      return CursorMessage{input.place(40.0F), input.place(40.0F)};
    case 5:
      return PhysicsSubscriptionMessage{input.flag()};
    case 6:
      return AskGroundMessage{any_chunks(input)};
    case 7:
      return any_admin(input);
    case 8:
      return any_offer(input, server);
    case 9:
      return GoodbyeMessage{};
    case 10: {
      AskTilesMessage request;
      for (const ChunkCoord any : any_chunks(input)) request.wanted.push_back({any.y, any.x, any.z});
      request.held = request.wanted;
      return request;
    }
    case 12:
      return AskHealthMessage{};
    case 13: {
      AskContentMessage request;
      for (uint32_t count = input.below(8); count > 0; --count)
        request.wanted.push_back(input.flag() ? palette_digest(*shared_builtin_palette())
                                              : Digest{static_cast<uint8_t>(input.byte())});
      return request;
    }
    case 11:
      return SayMessage{input.text(limits::line_bytes_max)};
    default: {
      const uint32_t kind = input.below(8);
      const uint32_t number = input.byte();
      if (kind == 0) return FillMessage{{known(any_shape(input)), any_fill(input)}, number};
      if (kind == 2) return any_query(input, number);
      if (kind == 1 && input.flag()) return RulesMessage{{any_rules_act(input)}, number};
      if (kind == 1) return PaintMessage{{known(any_shape(input)), any_material(input)}, number};
      if (kind == 3 && input.flag()) return ChannelMessage{any_channel_data(input)};
      if (kind == 3) return CutOutMessage{{known(any_shape(input))}, number};
      if (kind == 4) return ReleaseMessage{{input.byte()}, number};
      if (kind == 6) return AddPieceMessage{any_added_piece(input), number};
      if (kind == 7 && input.flag()) return SetRegionMessage{{any_region(input), 1.0F}, number};
      if (kind == 7 && input.below(4) == 0) return StandMessage{any_stand(input), number};
      if (kind == 7) return WalkMessage{any_walk(input), number};
      if (kind == 7 && input.flag()) return any_store_message(input, number);
      CarveMessage carve{known(any_carve(input)), number};
      if (kind == 5) carve.piece = input.byte();
      return carve;
    }
  }
}

void act(FuzzInput& input, FuzzServer& server) {
  const uint32_t kind = input.below(16);
  if (kind == 0 || server.clients().empty()) {
    FuzzClient* client = server.connect(input.below(4));
    if (client != nullptr && input.below(4) != 0) client->send(any_hello(input, server));
    return;
  }
  FuzzClient& client = *server.clients()[input.byte() % server.clients().size()];
  switch (kind) {
    case 1:
      return send_body(client, input.packet());
    case 2:
      return client.link->send(input.packet());
    case 3:
      return client.link->end(input.flag());
    case 4:
      client.reads = !client.reads;
      return client.link->read_on(client.reads);
    case 5:
      return server.pump(1 + input.byte());
    case 6:
    case 7:
    case 8:
      return server.tick(input.below(4) == 3);
    default:
      break;
  }
  const ClientMessage message = any_message(input, server);
  client.offers = client.offers || std::holds_alternative<OfferMessage>(message);
  client.send(message);
}

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scree;
  FuzzInput input(data, size);
  FuzzServer server(terrain);
  while (!input.at_end() && server.ticks() < ticks_max && server.work_us() < work_max_us) act(input, server);
  server.tick();
  server.check_mirrors();
  return 0;
}
