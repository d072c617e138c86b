// What a byte from outside costs the server, by kinds of message. Sixty sessions of one address, not of this
// machine, send as much of one kind as they may. The bytes that they draw and the processor time that the
// server takes are divided by the bytes that they send. What the same sessions draw without it is subtracted.
#include <cmath>
#include <csignal>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <thread>

#include "bench/support/benches.h"
#include "bench/support/scratch.h"
#include "bench/support/server_process.h"
#include "bench/wire/named_sockets.h"
#include "ground/ground_writer.h"
#include "proto/limits.h"
#include "shared/base/check.h"
#include "shared/base/random.h"

namespace scree {

namespace {

constexpr size_t crowd_size = 60;
constexpr double round_s = 0.02;
constexpr int ground_samples = 2049;
constexpr size_t file_bytes = 2'900'000;
constexpr const char* crowd_address = "203.0.113.1";
constexpr const char* builder_address = "203.0.113.2";

using Crowd = std::vector<std::unique_ptr<NamedSocket>>;

/// One of the crowd, in one round.
struct Turn {
  NamedSocket& socket;
  uint16_t port;
  size_t index;  ///< in the crowd
  int round;
  size_t& asked;  ///< tiles or chunks of ground so far
  Random& random;

  /// Every so many rounds, each one of the crowd in another.
  bool every(int rounds) const { return (round + static_cast<int>(index)) % rounds == 0; }
  glm::vec3 somewhere() { return {random.unit() * 40.0F - 20.0F, 30.0F, random.unit() * 40.0F - 20.0F}; }
};

struct Price {
  const char* name;
  const char* bounded_by;
  std::function<void(Turn&)> act;
  bool joins = true;  ///< the crowd has joined; else each connection is new
  bool kernels = true;
  bool counts = false;  ///< answers are counted
};

HelloMessage hello_of(const Price& price) {
  HelloMessage hello{protocol_version, "prices", {0.0F, 30.0F, 0.0F}, 96.0F};
  hello.lacks_kernels = !price.kernels;
  return hello;
}

template <typename Message>
Message edit_of(Turn& turn) {
  Message message;
  message.request = static_cast<uint32_t>(turn.round) + 1;
  message.shape = sphere(turn.somewhere(), 1.0F);
  return message;
}

void move_to_and_fro(Turn& turn) {
  if (turn.every(5))
    turn.socket.send(InterestMessage{{turn.round / 5 % 2 == 0 ? 600.0F : 0.0F, 30.0F, 0.0F}, 96.0F});
}

void report_wrong_hashes(Turn& turn) {
  if (!turn.every(5)) return;
  RepairMessage repair{1, {}, {}};
  for (int x = -2; x < 2; ++x)
    for (int z = -2; z < 2; ++z)
      for (int y = 2; y < 5; ++y) {
        repair.chunks.push_back({x, y, z});
        repair.hashes.push_back(1);
      }
  turn.socket.send(repair);
}

void ask_for_ground(Turn& turn) {
  if (turn.asked > turn.socket.answers() + limits::ground_chunks_max / 2) return;
  AskGroundMessage ask;
  for (int i = 0; i < 64; ++i, ++turn.asked) {
    const auto k = static_cast<int>(turn.asked);
    ask.chunks.push_back({k % 16 - 8, 2 + k / 256 % 3, k / 16 % 16 - 8});
  }
  turn.socket.send(ask);
}

void ask_for_tiles(Turn& turn) {
  if (turn.asked > turn.socket.answers()) return;
  const int side = HeightLayout::tiles_on(0, ground_samples);
  AskTilesMessage ask;
  for (int i = 0; i < side && static_cast<int>(turn.asked) < side * side; ++i, ++turn.asked)
    ask.wanted.push_back({0, static_cast<int>(turn.asked) % side, static_cast<int>(turn.asked) / side});
  if (!ask.wanted.empty()) turn.socket.send(ask);
}

void offer_wrong_hashes(Turn& turn) {
  if (!turn.every(25)) return;
  OfferMessage offer{turn.socket.world(), {}, {}};
  for (int x = -2; x < 2; ++x)
    for (int y = 2; y < 5; ++y)
      for (int z = -2; z < 2; ++z) offer.chunks.push_back({x, y, z});
  offer.hashes.assign(offer.chunks.size(), uint16_t{1});
  turn.socket.send(offer);
}

void request_files(Turn& turn, const char* path) {
  if (turn.index < 16 && turn.every(2))
    turn.socket.send(fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n", path));
}

std::vector<Price> prices() {
  return {
      {"hello", "connects-per-second, bytes-out-per-address",
       [](Turn& turn) {
         if (turn.socket.sent_bytes() == 0) turn.socket.send(hello_of({}));
       },
       false},
      {"health", "connects-per-second",
       [](Turn& turn) {
         if (turn.socket.sent_bytes() == 0) turn.socket.send(AskHealthMessage{});
       },
       false},
      {"interest", "bytes-out-per-address, limits.scanned_chunks_per_tick", move_to_and_fro},
      {"carve", "requests-per-second, work-percent",
       [](Turn& turn) {
         if (turn.every(10)) turn.socket.send(edit_of<CarveMessage>(turn));
       }},
      {"fill", "requests-per-second, work-percent",
       [](Turn& turn) {
         if (turn.every(10)) turn.socket.send(edit_of<FillMessage>(turn));
       }},
      {"paint", "requests-per-second, work-percent",
       [](Turn& turn) {
         if (turn.every(10)) turn.socket.send(edit_of<PaintMessage>(turn));
       }},
      {"repair", "bytes-out-per-address, limits.messages_per_second_max", report_wrong_hashes},
      {"ack", "limits.messages_per_second_max", [](Turn& turn) { turn.socket.send(AckMessage{1}); }},
      {"admin", "limits.messages_per_second_max",
       [](Turn& turn) {
         turn.socket.send(AdminMessage{1, "", ListSessionsRequest{}});
       }},
      {"cursor", "limits.cursors_max",
       [](Turn& turn) {
         turn.socket.send(CursorMessage{turn.somewhere(), turn.somewhere()});
       }},
      {"watch", "limits.physics_bytes_per_tick, bytes-out-per-address",
       [](Turn& turn) {
         if (turn.every(50)) turn.socket.send(PhysicsSubscriptionMessage{true});
       }},
      {"say", "limits.lines_per_second_party",
       [](Turn& turn) {
         if (turn.every(10)) turn.socket.send(SayMessage{"here"});
       }},
      {"ground", "limits.ground_work_max, bytes-out-per-address", ask_for_ground, true, false, true},
      {"tiles", "bytes-out-per-address, limits.tile_bytes_per_tick_all", ask_for_tiles, true, true, true},
      {"offer", "limits.client_bytes_per_second_max, bytes-out-per-address", offer_wrong_hashes, true, true,
       true},
      {"unknown", "limits.messages_per_second_max",
       [](Turn& turn) {
         constexpr std::array<uint8_t, 9> unknown{5, 0, 0, 0, 0xca, 0x3e, 2, 8, 1};
         turn.socket.send(unknown);
       }},
      {"http_file", "bytes-out-per-address, limits.http_requests_per_second_max",
       [](Turn& turn) { request_files(turn, "/large.bin"); }, false},
      {"http_no_file", "limits.http_requests_per_second_max", [](Turn& turn) { request_files(turn, "/no"); },
       false},
  };
}

void write_ground(const std::string& path) {
  auto writer = GroundWriter::create(path, {ground_samples, ground_samples, 1.0F, 0, 0, {5.0F, 60.0F}}, 0.0F);
  CHECK(writer.has_value());
  std::vector<int32_t> row(ground_samples);
  Random random(3);
  for (int z = 0; z < ground_samples; ++z) {
    for (int x = 0; x < ground_samples; ++x) {
      const float hills = std::sin(static_cast<float>(x) * 0.05F) + std::sin(static_cast<float>(z) * 0.04F);
      row[static_cast<size_t>(x)] =
          static_cast<int32_t>(256.0F * (25.0F + 3.0F * hills + 0.3F * random.unit()));
    }
    (*writer)->add_row(row);
  }
  CHECK((*writer)->finish().has_value());
}

void write_page(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "index.html") << "<!doctype html><title>page</title>";
  std::ofstream(folder / "large.bin", std::ios::binary) << std::string(file_bytes, 'x');
}

/// Sums over connections that are there, and that are over.
struct Sums {
  double sent = 0.0, received = 0.0;
  void add(const NamedSocket& socket, double sign = 1.0) {
    sent += sign * static_cast<double>(socket.sent_bytes());
    received += sign * static_cast<double>(socket.received_bytes());
  }
};

class Measured {
 public:
  Measured(const Price& price, ServerProcess& server) : price_(price), server_(server), asked_(crowd_size) {
    for (size_t i = 0; i < crowd_size; ++i) {
      crowd_.push_back(std::make_unique<NamedSocket>(server.port(), crowd_address));
      if (price.joins) crowd_.back()->send(hello_of(price));
    }
  }

  /// Rounds for so long, in which the crowd acts or only reads.
  void run(double seconds, bool acts) {
    const double begin_s = steady_now_s();
    for (int round = 0; steady_now_s() < begin_s + seconds; ++round) {
      const double next_s = steady_now_s() + round_s;
      for (size_t i = 0; i < crowd_.size(); ++i) serve(i, round, acts);
      std::this_thread::sleep_for(std::chrono::duration<double>(std::max(0.0, next_s - steady_now_s())));
    }
  }
  Sums sums() const {
    Sums all = over_;
    for (const auto& one : crowd_) all.add(*one);
    return all;
  }
  size_t joined() const {
    return static_cast<size_t>(std::ranges::count_if(crowd_, [](const auto& one) { return !one->over(); }));
  }

 private:
  /// A connection that is new each time lasts half a second, or until it is over. One of a browser stays: it
  /// is made anew only when the server has closed it.
  void serve(size_t i, int round, bool acts) {
    const bool stays = std::string_view(price_.name).starts_with("http");
    const bool is_old = !stays && (round + static_cast<int>(i)) % 25 == 0;
    if (!price_.joins && acts && (crowd_[i]->over() || is_old)) {
      over_.add(*crowd_[i]);
      crowd_[i] = std::make_unique<NamedSocket>(server_.port(), crowd_address);
    }
    Turn turn{*crowd_[i], server_.port(), i, round, asked_[i], random_};
    if (acts && !turn.socket.over()) price_.act(turn);
    if (price_.counts)
      turn.socket.receive_messages();
    else
      turn.socket.receive();
  }

  const Price& price_;
  ServerProcess& server_;
  Crowd crowd_;
  std::vector<size_t> asked_;
  Sums over_;
  Random random_{7};
};

/// Somebody else has carved at two places, far apart.
void carve_two_places(uint16_t port) {
  NamedSocket builder(port, builder_address);
  builder.send(hello_of({}));
  Random random(5);
  for (uint32_t i = 0; i < 120; ++i) {
    CarveMessage carve;
    carve.request = i + 1;
    const float there = i % 2 == 0 ? 0.0F : 600.0F;
    carve.shape = sphere({there + random.unit() * 60.0F - 30.0F, 25.0F, random.unit() * 60.0F - 30.0F}, 3.0F);
    carve.seeds = 8;
    builder.send(carve);
    builder.receive();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void measure(BenchReport& report, const Price& price, const ScratchFolder& folder, double seconds) {
  ServerProcess server(server_program().c_str(),
                       {"--ground", folder / "hills.ground", "--web", folder / "page", "--proxy", "127.0.0.1",
                        "--reach", "16384", "--sessions-max", "200", "--recombine", "stamp"});
  if (server.port() == 0) return report.check(price.name, false, "the server does not start");
  carve_two_places(server.port());
  Measured crowd(price, server);
  crowd.run(seconds, false);  // they join, and get what is near them
  const Sums before = crowd.sums();
  const double cpu_before_s = server.cpu_s();
  crowd.run(seconds, false);
  const Sums idle = crowd.sums();
  const double cpu_idle_s = server.cpu_s();
  crowd.run(seconds, true);
  const Sums after = crowd.sums();
  const double in = after.sent - idle.sent;
  const double out = std::max(0.0, (after.received - idle.received) - (idle.received - before.received));
  const double cpu_us = 1e6 * std::max(0.0, (server.cpu_s() - cpu_idle_s) - (cpu_idle_s - cpu_before_s));
  const std::string name = price.name;
  report.metric(name + "_in_bytes_per_s", in / seconds);
  report.metric(name + "_out_mb_per_s", out / seconds / 1e6);
  report.metric(name + "_out_per_in", out / std::max(1.0, in));
  report.metric(name + "_cpu_us_per_in", cpu_us / std::max(1.0, in));
  report.metric(name + "_cpu_share", cpu_us / 1e6 / seconds);
  report.condition(name,
                   fmt::format("{:.0f} B/s in, {:.2f} MB/s out: {:.0f} bytes and {:.2f} us for a byte; {}",
                               in / seconds, out / seconds / 1e6, out / std::max(1.0, in),
                               cpu_us / std::max(1.0, in), price.bounded_by));
  server.end(SIGTERM, 10.0);
}

}  // namespace

BenchReport run_prices_bench(const BenchOptions& options) {
  BenchReport report;
  if (!std::filesystem::exists(server_program())) {
    report.check("server", false, "there is no scree-server beside this program");
    return report;
  }
  const ScratchFolder folder("prices");
  write_ground(folder / "hills.ground");
  write_page(folder / "page");
  const std::vector<Price> all = prices();
  for (size_t i = 0; i < all.size(); ++i) {
    if (options.part.empty() || options.part == all[i].name)
      measure(report, all[i], folder, options.quick ? 1.0 : 3.0);
    options.progress(static_cast<double>(i + 1) / static_cast<double>(all.size()));
  }
  return report;
}

}  // namespace scree
