#include "bench/wire/intruders.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <thread>

#include "client/connection/connection.h"
#include "shared/base/limits.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds patience(10000);
constexpr glm::vec3 far_m{600.0F, 150.0F, 600.0F};

std::unique_ptr<Connection> join(uint16_t port, const HelloMessage& hello) {
  auto connected = Connection::connect({.port = port}, hello, patience);
  return connected ? std::move(*connected) : nullptr;
}

std::vector<std::unique_ptr<Connection>> join_many(uint16_t port, size_t count, const HelloMessage& hello) {
  std::vector<std::unique_ptr<Connection>> crowd;
  for (size_t i = 0; i < count; ++i)
    if (auto one = join(port, hello)) crowd.push_back(std::move(one));
  return crowd;
}

HelloMessage hello_at(glm::vec3 eye_m, float radius_m) {
  return {.client = "intruder", .eye_m = eye_m, .interest_radius_m = radius_m};
}

/// One client fills boxes of 14 m in the air, which fall.
void fill_the_air(uint16_t port, BenchClock::time_point end) {
  const auto client = join(port, hello_at(far_m, 8.0F));
  for (uint32_t i = 0; client && BenchClock::now() < end; ++i) {
    const glm::vec3 at =
        far_m + glm::vec3(20.0F * static_cast<float>(i % 20), 0.0F, 20.0F * static_cast<float>(i / 20 % 20));
    client->send(CursorMessage{at, at});
    client->send(FillMessage{{box(at, glm::vec3(7.0F))}, i});
    client->wait(milliseconds(17));
  }
}

/// Sixty clients without kernels ask for the ground around them.
void ask_for_ground(uint16_t port, BenchClock::time_point end) {
  HelloMessage hello = hello_at({}, 512.0F);
  hello.lacks_kernels = true;
  const auto crowd = join_many(port, 60, hello);
  for (int32_t turn = 0; BenchClock::now() < end; ++turn)
    for (size_t i = 0; i < crowd.size(); ++i) {
      AskGroundMessage ask;
      for (int32_t k = 0; k < 32; ++k)
        ask.chunks.push_back({turn % 40 - 20, static_cast<int32_t>(i % 8) - 4, k - 16});
      crowd[i]->send(ask);
      crowd[i]->wait(milliseconds(2));
    }
}

/// Sixty clients move their interest to and fro.
void move_to_and_fro(uint16_t port, BenchClock::time_point end) {
  const auto crowd = join_many(port, 60, hello_at({}, 512.0F));
  for (int turn = 0; BenchClock::now() < end; ++turn)
    for (const auto& client : crowd) {
      client->send(InterestMessage{glm::vec3(turn % 2 == 0 ? 0.0F : 1500.0F, 2.0F, 0.0F), 512.0F});
      client->wait(milliseconds(1));
    }
}

/// A hundred clients talk without a pause.
void talk(uint16_t port, BenchClock::time_point end) {
  HelloMessage hello = hello_at({}, 8.0F);
  hello.meets = true;
  const auto crowd = join_many(port, 100, hello);
  while (BenchClock::now() < end)
    for (const auto& client : crowd) {
      client->send(SayMessage{"and another line"});
      client->wait(milliseconds(1));
    }
}

/// Clients come and are lost at once.
void come_and_go(uint16_t port, BenchClock::time_point end) {
  while (BenchClock::now() < end)
    if (const auto client = join(port, hello_at({}, 8.0F))) client->close();
}

}  // namespace

const std::vector<IntruderKind>& intruder_kinds() {
  static const std::vector<IntruderKind> kinds = {{"fills", fill_the_air},
                                                  {"ground", ask_for_ground},
                                                  {"interest", move_to_and_fro},
                                                  {"talk", talk},
                                                  {"churn", come_and_go}};
  return kinds;
}

std::vector<double> falls_of_towers(uint16_t port, BenchClock::time_point end) {
  const glm::vec3 eye_m{40.0F, 4.0F, 0.0F};
  const auto client = join(port, hello_at(eye_m, 24.0F));
  std::vector<double> falls_s;
  const auto wait_until = [&](const auto& is_over) {
    while (BenchClock::now() < end)
      for (const Received& received : client->wait(milliseconds(5)))
        if (is_over(received.message)) return true;
    return false;
  };
  const auto answered = [](uint32_t request) {
    return [request](const ServerMessage& message) {
      const auto* const reply = std::get_if<ReplyMessage>(&message);
      return reply != nullptr && reply->request == request;
    };
  };
  const auto has_fallen = [](const ServerMessage& message) {
    const auto* const frame = std::get_if<FrameMessage>(&message);
    return frame != nullptr && std::ranges::any_of(frame->operations, [](const Operation& operation) {
             const auto* const island = std::get_if<IslandOperation>(&operation);
             return island != nullptr && island->box.size().y > 16;
           });
  };
  for (uint32_t i = 0; client && BenchClock::now() < end; ++i) {
    const glm::vec3 foot_m = eye_m + glm::vec3(8.0F * static_cast<float>(i % 3), 0.0F, 12.0F);
    client->send(FillMessage{{box(foot_m, {1.5F, 8.0F, 1.5F})}, 2 * i});
    if (!wait_until(answered(2 * i))) break;
    CarveMessage cut;
    cut.request = 2 * i + 1;
    cut.shape = box(foot_m - glm::vec3(0.0F, 1.0F, 0.0F), {2.5F, 0.5F, 2.5F});
    cut.seeds = 1;
    cut.impact_m = centre_of(cut.shape);
    client->send(cut);
    const auto cut_at = BenchClock::now();
    const bool fell = wait_until(has_fallen);
    falls_s.push_back(std::chrono::duration<double>(BenchClock::now() - cut_at).count());
    if (!fell) break;
    std::this_thread::sleep_for(milliseconds(1500));
  }
  return falls_s;
}

}  // namespace scree
