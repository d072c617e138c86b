// Writes the first inputs of each target's corpus, from messages of every kind, a session of a real server
// with two clients, and a recording of it: fuzz_seeds FOLDER. What fuzzing adds to them is found by the
// fuzzer.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "auth/access_token.h"
#include "auth/base64url.h"
#include "ground/ground_file.h"
#include "ground/ground_writer.h"
#include "proto/operation_codec.h"
#include "server/formats/bus_codec.h"
#include "server/formats/world_codec.h"
#include "server/store/recording.h"
#include "server/store/recording_writer.h"
#include "shared/base/random.h"
#include "shared/recombine/stamp_plan.h"
#include "tests/fuzz/support/any_request.h"
#include "tests/fuzz/support/fuzz_server.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/support/vox_bytes.h"
#include "tests/support/wire_samples.h"
#include "tests/support/written_glb.h"

namespace scree {
namespace {

using Bytes = std::vector<uint8_t>;

const TerrainSource terrain{TerrainKind::flat, 1, 1.0F};
constexpr size_t seed_bytes_max = 4096;  // as of tools/scripts/fuzz.sh
constexpr int session_ticks = 150;
constexpr uint64_t body_seeds = 8;
constexpr int body_seed_bytes = 400;

/// The other way round than FuzzInput.
class Seed {
 public:
  Seed& byte(uint8_t value) {
    bytes.push_back(value);
    return *this;
  }
  Seed& raw(std::span<const uint8_t> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return *this;
  }
  Seed& packet(std::span<const uint8_t> body) {
    byte(static_cast<uint8_t>(body.size())).byte(static_cast<uint8_t>(body.size() >> 8U));
    return raw(body);
  }
  Seed& text(const std::string& more) {
    return raw({reinterpret_cast<const uint8_t*>(more.data()), more.size()});
  }

  Bytes bytes;
};

class Corpora {
 public:
  explicit Corpora(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void add(const std::string& target, const Bytes& bytes) {
    if (bytes.size() > seed_bytes_max) return;
    std::filesystem::create_directories(folder_ / target);
    const std::string name = "seed-" + std::to_string(++written_[target]);
    std::ofstream(folder_ / target / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  void print() const {
    for (const auto& [target, count] : written_) std::printf("%s: %d inputs\n", target.c_str(), count);
  }

 private:
  std::filesystem::path folder_;
  std::map<std::string, int> written_;
};

Bytes body_of(const ServerMessage& message) {
  const Bytes framed = encode(message);
  return {framed.begin() + length_prefix_bytes, framed.end()};
}
Bytes body_of(const ClientMessage& message) {
  const Bytes framed = encode(message);
  return {framed.begin() + length_prefix_bytes, framed.end()};
}

HelloMessage hello(bool lacks_kernels) {
  return {.client = "seeds",
          .eye_m = {0.0F, 2.0F, 0.0F},
          .interest_radius_m = 64.0F,
          .lacks_kernels = lacks_kernels};
}

CarveMessage carve(float x_m, uint32_t number) {
  CarveRequest carve;
  carve.shape = sphere({x_m, 0.0F, 16.0F}, 2.5F);
  carve.seeds = 5;
  carve.random_seed = number;
  carve.impact_m = {x_m, 2.0F, 16.0F};
  return {carve, number};
}

/// What the clients of a session say, by tick.
std::vector<std::vector<ClientMessage>> conversation() {
  std::vector<std::vector<ClientMessage>> said(session_ticks);
  said[1] = {carve(16.0F, 1)};
  said[4] = {FillMessage{{box({21.0F, 1.0F, 16.0F}, {1.0F, 2.0F, 1.0F})}, 2}, AckMessage{3}};
  said[8] = {PaintMessage{{sphere({16.0F, 0.0F, 16.0F}, 3.0F), material::ice}, 3},
             CursorMessage{{0.0F, 2.0F, 0.0F}, {1.0F, 0.0F, 0.0F}}};
  said[12] = {carve(21.0F, 4), AskGroundMessage{{{0, 0, 0}, {1, -1, 0}}}};
  said[20] = {InterestMessage{{80.0F, 2.0F, 0.0F}, 40.0F}};
  said[30] = {InterestMessage{{0.0F, 2.0F, 0.0F}, 64.0F}, RepairMessage{3, {{0, 0, 0}}, {7}}};
  said[40] = {AdminMessage{5, FuzzServer::admin_token, SettingsRequest{{{"recombine", "slices"}}}}};
  said[60] = {AdminMessage{6, FuzzServer::admin_token, ListSessionsRequest{}},
              PhysicsSubscriptionMessage{true}};
  return said;
}

void write_messages(Corpora& corpora) {
  const Bytes greeting = encode(ClientMessage(hello(false)));
  for (const ClientMessage& message : samples::client_messages())
    corpora.add("client_messages", Seed().byte(40).raw(greeting).raw(encode(message)).bytes);
  for (const ServerMessage& message : samples::server_messages())
    corpora.add("server_messages", body_of(message));
}

void write_packed(Corpora& corpora) {
  const FrameMessage frame = samples::frame();
  const Bytes parts[] = {encode_operations(frame.operations), encode_operation(frame.operations.front()),
                         encode_bricks(frame.patches), encode_volume(samples::volume()), frame.transforms};
  for (uint8_t i = 0; i < std::size(parts); ++i) corpora.add("packed", Seed().byte(i).raw(parts[i]).bytes);
  for (const Operation& operation : frame.operations)
    corpora.add("packed", Seed().byte(1).raw(encode_operation(operation)).bytes);
}

/// A session as the actions of the target `server`, and what its clients received as those of `mirror`.
void write_session(Corpora& corpora) {
  FuzzServer server(terrain);
  Seed actions;
  for (uint8_t i = 0; i < 2; ++i) {
    FuzzClient* client = server.connect(i);
    client->records = true;
    client->send(hello(i == 1));
    actions.byte(0).byte(i).byte(0).byte(1).byte(i).packet(body_of(ClientMessage(hello(i == 1))));
  }
  for (const auto& said : conversation()) {
    for (const ClientMessage& message : said) {
      server.clients()[0]->send(message);
      actions.byte(1).byte(0).packet(body_of(message));
    }
    server.pump();
    server.tick();
    actions.byte(6).byte(0).byte(0);
  }
  corpora.add("server", actions.bytes);
  for (const auto& client : server.clients()) {
    Seed mirror;  // flat, its seed, 1 m, 60 Hz, poses every third tick
    mirror.byte(0).byte(1).byte(1).byte(50).byte(2);
    for (const Bytes& body : client->received) {
      corpora.add("server_messages",
                  body.size() < 600 && body.size() > 40 ? body : Bytes(seed_bytes_max + 1));
      const auto message = decode_server(body);
      if (message && std::holds_alternative<WelcomeMessage>(*message)) continue;
      if (mirror.bytes.size() + body.size() + 3 < seed_bytes_max) mirror.byte(1).packet(body);
    }
    corpora.add("mirror", mirror.bytes);
  }
}

/// A piece is stamped in the air, and gains more than its mass and all dust.
RecordedFrame hostile_frame() {
  RecordedFrame frame;
  frame.tick = 1;
  frame.operations = {CarveOperation{.shape = sphere({16.0F, 0.0F, 16.0F}, 2.5F), .first_piece = 1},
                      StampOperation{.piece = 1,
                                     .pose = quantise({{16.0F, 20.0F, 16.0F}}),
                                     .shift = stamp_shift_max,
                                     .method = StampMethod::sphere}};
  return frame;
}

void write_recording(Corpora& corpora) {
  WorldConfig config;
  config.terrain = terrain;
  World world(config);
  const ScratchFile file("seeds");
  const RecordingHeader header{"seeds", config};
  RecordedHeader without_palette = to_recorded(header);
  without_palette.palette = nullptr;  // which would be most of a seed
  auto writer = RecordingWriter::create(file.path(), header);
  Seed rows;
  const auto row = [&](uint8_t table, Tick tick, const Bytes& data) {
    rows.byte(table).byte(static_cast<uint8_t>(tick)).packet(data);
    corpora.add("packed", Seed().byte(static_cast<uint8_t>(5 + table)).raw(data).bytes);
  };
  rows.byte(1).byte(3);
  row(0, 0, encode(without_palette));
  Seed hostile = rows, told;
  PublishedState state;
  for (Tick tick = 1; tick <= 4; ++tick) {
    std::vector<Command> commands;
    if (tick == 2)
      commands = {{1, 1, carve(16.0F, 1)}, {2, 1, FillRequest{sphere({20.0F, 1.0F, 16.0F}, 1.0F)}}};
    const auto delta = world.step(commands);
    row(1, tick, encode(to_recorded(*delta, state)));
    if (tick > 1) told.byte(0).byte(0).packet(encode_told(to_recorded(*delta, state)));
    if (!commands.empty()) row(3, tick, encode(std::span<const Command>(commands)));
    state.apply(*delta);
    if (tick == 1) {
      const Bytes keyframe = encode(
          ToldKeyframe{1, encode(without_palette), encode(to_recorded_keyframe(state.as_delta())), {}, {}});
      told.byte(3).byte(1).packet(encode(ToldPart{3, 1, 0, 1, keyframe}));
    }
    if (tick == 2)
      corpora.add("packed", Seed().byte(7).raw(encode(to_recorded_keyframe(state.as_delta()))).bytes);
    (void)(*writer)->add(*delta, commands);
  }
  (void)(*writer)->finish();
  corpora.add("recording", rows.bytes);
  told.byte(4).byte(0).packet(encode(ToldWhole{3, 9, 1}));
  corpora.add("bus", told.byte(5).byte(0).packet(encode(PipeMessage{3, 9, 1, {4, 5}, true})).bytes);
  const Bytes frame = encode(hostile_frame());
  corpora.add("recording", hostile.byte(1).byte(1).packet(frame).bytes);
}

/// A world with pieces in the air, whole and by its rows; and a ground.
void write_saved_values(Corpora& corpora) {
  const auto add = [&](uint8_t decoder, const Bytes& data) {
    corpora.add("kept", Seed().byte(decoder).raw(data).bytes);
  };
  WorldConfig config;
  config.terrain = terrain;
  World world(config);
  add(0, encode(world.snapshot()));
  CarveRequest small = carve(16.0F, 1);
  small.shape = sphere({16.0F, 0.0F, 16.0F}, 1.5F);
  small.seeds = 2;
  const Command blow{1, 1, small};
  world.step({&blow, 1});
  for (int tick = 0; tick < 4; ++tick) world.step({});
  const WorldSnapshot value = world.snapshot();
  add(0, encode(value));
  add(1, encode(WorldHeader{.world = 1, .config = value.moment.config}));
  const BrickPatch& brick = value.bricks.front();
  const uint64_t hash = brick_hash(brick.coord, brick.brick, brick.materials);
  add(2, encode(WorldChunk{chunk_of(brick.coord), value.moment.tick, hash, {brick}, 1000}));
  for (const PieceRecord& piece : value.moment.pieces) add(3, encode(piece));
  add(4, encode(value.moment));

  const ScratchFile file("seeds");
  auto writer = GroundWriter::create(file.path(), {20, 14, 2.0F, 0, 0, {5.0F, 60.0F}}, 0.0F);
  std::vector<int32_t> row(20);
  for (int z = 0; z < 14; ++z) {
    for (int x = 0; x < 20; ++x) row[static_cast<size_t>(x)] = 40 * x + (z > 7 ? 900 : 0);
    (*writer)->add_row(row);
  }
  (void)(*writer)->finish();
  std::ifstream written(file.path(), std::ios::binary);
  add(5, {std::istreambuf_iterator<char>(written), {}});
  const auto ground = GroundFile::open(file.path());
  add(6, (*ground)->packed((*ground)->layout().top()));
}

/// Any bytes are a world with bodies.
void write_bodies(Corpora& corpora) {
  for (uint64_t seed = 1; seed <= body_seeds; ++seed) {
    Random random(seed);
    Seed bytes;
    for (int i = 0; i < body_seed_bytes; ++i) bytes.byte(static_cast<uint8_t>(random.below(256)));
    corpora.add("bodies", bytes.bytes);
  }
}

void write_texts(Corpora& corpora) {
  const SigningKey key = SigningKey::generate();
  const AccessToken token{77, Role::builder, 1'600'000'000, 1'700'000'000, "Ann", "canyon"};
  const std::string texts[] = {"Ann \xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80 \xE2\x80\xAE",
                               "c2NyZWU",
                               *sign(token, key),
                               id_text(77),
                               "30d",
                               "2001:db8::1",
                               "10.0.0.1 0 too loud\n2001:db8::/64 1700000000 bot\n",
                               "# revoked\n00000000000000ff\n4d00000000000000 # Ann\n"};
  for (uint8_t i = 0; i < std::size(texts); ++i) corpora.add("texts", Seed().byte(i).text(texts[i]).bytes);
  for (const char* address : {"::ffff:10.0.0.1", "127.0.0.1", "::1", "2001:db8:1:2::/64", "fe80::1%2"})
    corpora.add("texts", Seed().byte(5).text(address).bytes);
}

/// Requests, and a WebSocket with a message in parts, a ping, a close, and what is refused.
void write_web(Corpora& corpora) {
  constexpr uint8_t any_bytes = 0, get = 1, head = 2, handshake = 3, frame = 4;
  for (const char* text :
       {"GET /../a?b HTTP/1.1\r\nHost: a\r\nAccept-Encoding: br, gzip;q=0\r\nIf-None-Match: *\r\n\r\n",
        "GET /session HTTP/1.1\r\nHost: a:4177\r\nOrigin: https://a:4177\r\nConnection: keep-alive, "
        "Upgrade\r\n"
        "Upgrade: websocket\r\nSec-WebSocket-Version: 8\r\nSec-WebSocket-Key: "
        "AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n",
        "POST / HTTP/1.0\r\nContent-Length: 3\r\nAuthorization: Bearer a\r\n\r\nabc"}) {
    const std::string bytes = text;
    corpora.add(
        "web",
        Seed().byte(any_bytes).packet({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}).bytes);
  }
  Seed asks;
  asks.byte(get).byte(4).text("file").byte(head).byte(get).byte(0).byte(handshake);
  corpora.add("web", asks.bytes);
  const auto with_frame = [&](uint8_t opcode, uint8_t fin, uint8_t unmasked, size_t bytes) {
    asks.byte(frame).byte(opcode).byte(fin).byte(unmasked).byte(0).packet(Bytes(bytes, opcode));
    corpora.add("web", asks.bytes);
  };
  with_frame(2, 0, 0, 5);
  with_frame(0, 1, 0, 300);
  with_frame(9, 1, 0, 3);
  with_frame(2, 1, 0, 2000);
  with_frame(8, 1, 0, 2);
  asks = Seed().byte(handshake);
  with_frame(2, 1, 7, 4);
  asks = Seed().byte(handshake);
  with_frame(1, 1, 0, 4);
}

void write_config(Corpora& corpora) {
  const WorldConfig defaults;
  std::string file;
  for (const Setting& row : settings())
    file += std::string(row.name) + " = \"" + row.print(defaults) + "\"\n";
  corpora.add("config", Seed().text("\n" + file).bytes);
  for (const Setting& row : settings())
    corpora.add("config",
                Seed().text("--" + std::string(row.name) + "=" + row.print(defaults) + "\n\n").bytes);
  corpora.add("config", Seed()
                            .text("--port=0\n--bind\n0.0.0.0\n--anonymous=viewer\n--ticks=5\n\n"
                                  "terrain = 'noise'\nseed = 7\nvoxel-size = 0.25\ntick-rate = 60\n"
                                  "admin-token = \"a-long-token\"\nlog = \"off\"\nduration = 1.5\n")
                            .bytes);
  corpora.add("config", Seed()
                            .text("--host\nlocalhost\n--port\n4177\n--tls\n--token\nabcdefgh\n\n"
                                  "[server]\nloop = true\nspeed = [1, 2]\n")
                            .bytes);
}

void write_models(Corpora& corpora) {
  corpora.add("models", box_glb({0.5F, 0.25F, 0.1F}, {0.5F, 0.5F, 0.5F}));
  corpora.add("models", box_glb({1.0F, 0.0F, 0.0F}, {1.0F, 0.1F, 1.0F},
                                R"(,"rotation":[0,0.6,0,0.8],"scale":[-1,2,1],"translation":[0,3,0])"));
}

void write_vox(Corpora& corpora) {
  VoxBytes plain;
  plain.model({3, 4, 5}, {{0, 0, 0, 1}, {2, 3, 4, 255}});
  VoxBytes scene = plain;
  scene.transform(0, 1, {});
  scene.group(1, {2, 4});
  scene.transform(2, 3, {{"_r", "17"}, {"_t", "-3 40 -100"}}, {{"_name", "part"}}, 0);
  scene.shape(3, 0);
  scene.transform(4, 3, {}, {{"_hidden", "1"}});
  for (const std::string& file : {plain.file(), scene.file(200)}) corpora.add("vox", Seed().text(file).bytes);
}

/// Targets that take bytes for choices alone: any bytes are a beginning.
void write_choices(Corpora& corpora) {
  Random random(20261122);
  for (const char* target : {"world", "motions", "server", "mirror", "tls", "web"})
    for (size_t bytes = 64; bytes <= 512; bytes *= 2) {
      Seed seed;
      while (seed.bytes.size() < bytes) seed.byte(static_cast<uint8_t>(random.next()));
      corpora.add(target, seed.bytes);
    }
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  using namespace scree;
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  Corpora corpora(argv[1]);
  write_messages(corpora);
  write_packed(corpora);
  write_session(corpora);
  write_recording(corpora);
  write_saved_values(corpora);
  write_bodies(corpora);
  write_texts(corpora);
  write_config(corpora);
  write_vox(corpora);
  write_models(corpora);
  write_web(corpora);
  write_choices(corpora);
  corpora.print();
  return 0;
}
