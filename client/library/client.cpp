// The client's life: options, attempts, what it sends besides requests.
#include <algorithm>
#include <cstdint>

#include "client/library/call.h"
#include "client/library/handle.h"
#include "proto/limits.h"
#include "shared/base/text.h"
#include "shared/base/timing.h"

namespace scree {
namespace {

constexpr float usual_radius_m = 96.0F;
constexpr const char* no_connection = "there is no connection";

HelloMessage hello_of(const scree_options& options) {
  HelloMessage hello;
  hello.client = text_of(options.program, "libscree_client");
  hello.name = text_of(options.name);
  hello.eye_m = vec3_of(options.eye_m);
  hello.interest_radius_m = options.radius_m == 0.0F ? usual_radius_m : options.radius_m;
  hello.at_spawn = (options.flags & SCREE_AT_SPAWN) != 0;
  hello.meets = (options.flags & SCREE_MEETS) != 0;
  hello.stones = (options.flags & SCREE_STONES) != 0;
  return hello;
}

ClientOptions client_options(const scree_options& options) {
  const auto cached_max = static_cast<size_t>(std::min<uint64_t>(options.cache_bytes, SIZE_MAX));
  return {.cache = {.folder = text_of(options.cache_folder), .bytes_max = cached_max},
          .delayed = (options.flags & SCREE_SMOOTH) != 0};
}

}  // namespace

std::string fault_of(const scree_options& options) {
  const bool finite =
      is_finite(options.eye_m, 3) && is_finite(&options.radius_m, 1) && is_finite(&options.contacts_j, 1);
  if (!finite || options.radius_m < 0.0F || options.contacts_j < 0.0F)
    return "the eye, the radius and the energy of blows are finite, and the last two not below 0";
  if (options.port > 65535) return "a port is at most 65535";
  if ((options.allocator.allocate == nullptr) != (options.allocator.release == nullptr))
    return "an allocator has both functions, or neither";
  if (text_of(options.program).size() > limits::client_name_bytes_max)
    return "the program's name is too long";
  const std::string name = text_of(options.name);
  if (name.size() > limits::person_name_bytes_max) return "the person's name is too long";
  if (const auto fault = fault_of_text(name)) return "the person's name " + std::string(*fault);
  if (options.host != nullptr && *options.host == '\0') return "the host is empty";
  if (text_of(options.token).size() > limits::access_token_bytes_max) return "the token is too long";
  if (options.cache_folder != nullptr && options.cache_bytes == 0)
    return "a folder for edits needs cache_bytes";
  return {};
}

}  // namespace scree

using namespace scree;

scree_client::scree_client(std::unique_ptr<Connector> connector, const scree_options& options)
    : arrays(options.allocator),
      client(std::move(connector), client_options(options)),
      flags(options.flags),
      hello_(hello_of(options)),
      contacts_j_(options.contacts_j) {
  client.predict((flags & SCREE_PREDICT) != 0);
  join_if_due(steady_now_s());
}

scree_client::~scree_client() {
  while (!meshers.empty()) scree_mesher_destroy(*meshers.begin());
}

void scree_client::join_if_due(double now_s) {
  if (client.connected() || client.joining() || !attempts_.due(now_s)) return;
  if ((flags & SCREE_ONCE) != 0 && tried_) return;
  tried_ = true;
  client.join(hello_, now_s);
}

void scree_client::poll(uint32_t wait_ms) {
  double now_s = steady_now_s();
  join_if_due(now_s);
  if (wait_ms != 0 && told_.empty()) client.wait(std::chrono::milliseconds(wait_ms));
  now_s = steady_now_s();
  client.poll(now_s);
  settled_ = false;
}

extern "C" {

scree_result scree_options_init(scree_options* options, uint32_t size) {
  scree_options usual{};
  usual.flags = SCREE_AT_SPAWN;
  usual.radius_m = usual_radius_m;
  return init_struct(options, size, usual) ? SCREE_OK : fail(SCREE_INVALID, "no release has such options");
}

scree_result scree_client_create(const scree_options* options, scree_client** client) {
  return guarded([&] {
    const std::optional<scree_options> given = read_struct(options);
    if (!given) return fail(SCREE_INVALID, "no release has such options");
    if (client == nullptr) return fail(SCREE_INVALID, "there is no place for the client");
    *client = nullptr;
    if (const std::string fault = fault_of(*given); !fault.empty()) return fail(SCREE_INVALID, fault);
    Result<std::unique_ptr<Connector>> connector = make_connector(*given);
    if (!connector) return fail(SCREE_INVALID, connector.error().message);
    *client = new scree_client(std::move(*connector), *given);
    return done;
  });
}

void scree_client_destroy(scree_client* client) {
  if (client != nullptr && client->is_calling())
    client->end_after_call();
  else
    delete client;
}

scree_result scree_client_poll(scree_client* client, uint32_t wait_ms) {
  return guarded([&] {
    if (client == nullptr) return fail(SCREE_INVALID, "the client is null");
    if (client->is_calling()) return fail(SCREE_REFUSED, no_call_from_callbacks);
    client->poll(wait_ms);
    return done;
  });
}

scree_result scree_client_follow(scree_client* client, const float eye_m[3], float radius_m) {
  return guarded([&] {
    if (client == nullptr || eye_m == nullptr || !is_finite(eye_m, 3) || !(radius_m >= 0.0F) ||
        !is_finite(&radius_m, 1))
      return fail(SCREE_INVALID, "a client, a finite place and a radius of 0 or more are needed");
    if (!client->client.connected()) return fail(SCREE_NOT_CONNECTED, no_connection);
    client->follow(vec3_of(eye_m), radius_m);
    return done;
  });
}

scree_result scree_client_say(scree_client* client, const char* text) {
  return guarded([&] {
    if (client == nullptr || text == nullptr) return fail(SCREE_INVALID, "a client and a line are needed");
    const std::string line = text;
    if (line.empty() || line.size() > limits::line_bytes_max)
      return fail(SCREE_INVALID,
                  "a line has 1 to " + std::to_string(limits::line_bytes_max) + " bytes of UTF-8");
    if (const auto fault = fault_of_text(line)) return fail(SCREE_INVALID, "the line " + std::string(*fault));
    if (!client->client.connected()) return fail(SCREE_NOT_CONNECTED, no_connection);
    client->client.send(SayMessage{line});
    return done;
  });
}

scree_result scree_client_send(scree_client* client, const char* channel, const void* data, size_t bytes) {
  return guarded([&] {
    if (client == nullptr || channel == nullptr || (data == nullptr && bytes != 0))
      return fail(SCREE_INVALID, "a client, a channel and bytes are needed");
    if (!client->client.connected()) return fail(SCREE_NOT_CONNECTED, no_connection);
    const auto* const first = static_cast<const uint8_t*>(data);
    ChannelMessage message;
    message.channel = channel;
    if (bytes > limits::channel_data_bytes_max) return fail(SCREE_INVALID, "the message is too long");
    message.bytes.assign(first, first + bytes);
    if (const Result<void> valid = validate(message); !valid)
      return fail(SCREE_INVALID, valid.error().message);
    client->client.send(message);
    return done;
  });
}

scree_result scree_client_walk(scree_client* client, const float way[2], uint32_t buttons,
                               const float look[3]) {
  return guarded([&] {
    if (client == nullptr || way == nullptr || look == nullptr || !is_finite(way, 2) || !is_finite(look, 3))
      return fail(SCREE_INVALID, "a client, a finite way and a look are needed");
    if (!client->client.connected()) return fail(SCREE_NOT_CONNECTED, no_connection);
    return client->step_on_foot({way[0], 0.0F, way[1]}, buttons, vec3_of(look));
  });
}

scree_result scree_client_draw_tick(scree_client* client, double* tick) {
  return guarded([&] {
    if (client == nullptr || tick == nullptr) return fail(SCREE_INVALID, "a client and a place are needed");
    if (client->client.mirror() == nullptr) return fail(SCREE_NOT_CONNECTED, "no server was reached yet");
    *tick = (client->flags & SCREE_SMOOTH) != 0 ? client->client.draw_tick(steady_now_s())
                                                : static_cast<double>(client->client.mirror()->tick());
    return done;
  });
}
}
