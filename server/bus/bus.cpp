#include "server/bus/bus.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

#include "server/bus/bus_state.h"
#include "server/bus/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// What the library's callbacks have: each keeps the state alive until the connection is closed.
using Kept = std::shared_ptr<Bus::State>;

Bus::State& state_of(void* closure) {
  return **static_cast<Kept*>(closure);
}

void on_connected(natsConnection*, void* closure) {
  Bus::State& state = state_of(closure);
  state.set_fault({});
  ++state.connections;
  state.connected = true;
}

void on_disconnected(natsConnection*, void* closure) {
  Bus::State& state = state_of(closure);
  state.connected = false;
  state.set_fault("the connection was lost");
}

void on_closed(natsConnection*, void* closure) {
  delete static_cast<Kept*>(closure);
}

void on_error(natsConnection*, natsSubscription*, natsStatus status, void* closure) {
  state_of(closure).set_fault(natsStatus_GetText(status));
}

Result<void> check_file(const std::string& path, const char* option) {
  std::error_code none;
  if (path.empty() || std::filesystem::exists(path, none)) return {};
  return fail(fmt::format("there is no file {} ({})", path, option));
}

natsStatus set_times(natsOptions* options) {
  const natsStatus all[] = {
      natsOptions_SetMaxReconnect(options, -1),
      natsOptions_SetReconnectWait(options, limits::bus_retry_ms),
      natsOptions_SetReconnectJitter(options, limits::bus_retry_ms / 4, limits::bus_retry_ms / 4),
      natsOptions_SetPingInterval(options, limits::bus_ping_ms),
      natsOptions_SetMaxPingsOut(options, limits::bus_pings_out_max),
      natsOptions_SetTimeout(options, limits::bus_answer_ms),
      natsOptions_SetWriteDeadline(options, limits::bus_answer_ms),
      natsOptions_SetMaxPendingMsgs(options, limits::bus_waiting_messages_max)};
  const auto* const bad = std::ranges::find_if(all, [](natsStatus status) { return status != NATS_OK; });
  return bad == std::end(all) ? NATS_OK : *bad;
}

natsStatus set_callbacks(natsOptions* options, void* closure) {
  const natsStatus all[] = {natsOptions_SetRetryOnFailedConnect(options, true, on_connected, closure),
                            natsOptions_SetReconnectedCB(options, on_connected, closure),
                            natsOptions_SetDisconnectedCB(options, on_disconnected, closure),
                            natsOptions_SetClosedCB(options, on_closed, closure),
                            natsOptions_SetErrorHandler(options, on_error, closure)};
  const auto* const bad = std::ranges::find_if(all, [](natsStatus status) { return status != NATS_OK; });
  return bad == std::end(all) ? NATS_OK : *bad;
}

Result<void> configure(natsOptions* options, const BusConfig& config) {
  TRY(check_file(config.credentials_path, "--nats-creds"));
  TRY(check_file(config.ca_path, "--nats-ca"));
  if (natsOptions_SetURL(options, config.url.c_str()) != NATS_OK)
    return fail(fmt::format(
        "'{}' is no address of a server of NATS: write nats://HOST:PORT or tls://HOST:PORT (--nats)",
        without_password(config.url)));
  if (const natsStatus status = set_times(options); status != NATS_OK)
    return fail(fmt::format("NATS: {}", natsStatus_GetText(status)));
  natsOptions_SetName(options, config.name.c_str());
  if (!config.credentials_path.empty() &&
      natsOptions_SetUserCredentialsFromFiles(options, config.credentials_path.c_str(), nullptr) != NATS_OK)
    return fail(fmt::format("{} holds no credentials (--nats-creds)", config.credentials_path));
  if (!config.ca_path.empty()) {
    if (natsOptions_SetSecure(options, true) != NATS_OK ||
        natsOptions_LoadCATrustedCertificates(options, config.ca_path.c_str()) != NATS_OK)
      return fail(fmt::format("{} holds no certificates (--nats-ca)", config.ca_path));
  }
  return {};
}

}  // namespace

bool is_bus_name(std::string_view name) {
  return !name.empty() && name.size() <= limits::bus_name_bytes_max && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

std::string without_password(const std::string& url) {
  const size_t host = url.rfind('@'), scheme = url.find("://");
  if (host == std::string::npos) return url;
  const size_t from = scheme == std::string::npos ? 0 : scheme + 3;
  return fmt::format("{}{}", url.substr(0, from), url.substr(host + 1));
}

void Bus::State::set_fault(std::string words) {
  const std::scoped_lock lock(mutex);
  fault = std::move(words);
}

tl::unexpected<Error> Bus::State::failed(const std::string& what, natsStatus status) {
  std::string words = fmt::format("{}: {}", what, natsStatus_GetText(status));
  set_fault(words);
  return fail(std::move(words));
}

Bus::Bus(std::shared_ptr<State> state) : state_(std::move(state)) {}

Result<std::shared_ptr<Bus>> Bus::connect(const BusConfig& config) {
  natsOptions* made = nullptr;
  if (natsOptions_Create(&made) != NATS_OK) return fail("NATS: there is no memory");
  const NatsOptions options(made);
  TRY(configure(made, config));
  auto state = std::make_shared<State>();
  state->config = config;
  auto* const kept = new Kept(state);  // on_closed() frees it
  const auto give_up = [&](natsStatus status) {
    delete kept;
    return fail(
        fmt::format("NATS at {}: {} (--nats)", without_password(config.url), natsStatus_GetText(status)));
  };
  if (const natsStatus status = set_callbacks(made, kept); status != NATS_OK) return give_up(status);
  const natsStatus status = natsConnection_Connect(&state->connection, made);
  if (status != NATS_OK && status != NATS_NOT_YET_CONNECTED) return give_up(status);
  if (status == NATS_OK) {
    ++state->connections;
    state->connected = true;
  }
  if (status != NATS_OK) state->set_fault("there is no connection yet");
  jsOptions js;
  jsOptions_Init(&js);
  js.Wait = limits::bus_answer_ms;
  js.PublishAsync.MaxPending = limits::bus_unconfirmed_max;
  js.PublishAsync.StallWait = limits::bus_answer_ms;
  js.PublishAsync.ErrHandler = [](jsCtx*, jsPubAckErr* error, void* closure) {
    State& failed = state_of(closure);
    ++failed.keep_failures;
    const char* const words = error->ErrText != nullptr ? error->ErrText : natsStatus_GetText(error->Err);
    failed.set_fault(fmt::format("a message was not kept: {}", words));
  };
  js.PublishAsync.ErrHandlerClosure = kept;
  auto bus = std::shared_ptr<Bus>(new Bus(state));
  if (const natsStatus no = natsConnection_JetStream(&state->streams, state->connection, &js); no != NATS_OK)
    return fail(fmt::format("NATS: {}", natsStatus_GetText(no)));
  return bus;
}

Bus::~Bus() {
  jsCtx_Destroy(std::exchange(state_->streams, nullptr));
  natsConnection_Destroy(std::exchange(state_->connection, nullptr));
}

bool Bus::is_connected() const {
  return state_->connected && natsConnection_Status(state_->connection) == NATS_CONN_STATUS_CONNECTED;
}

uint64_t Bus::connections() const {
  return state_->connections;
}

std::string Bus::fault() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->fault;
}

size_t Bus::payload_max() const {
  return static_cast<size_t>(std::max<int64_t>(0, natsConnection_GetMaxPayload(state_->connection)));
}

Result<void> Bus::send(const std::string& subject, std::span<const uint8_t> bytes) {
  if (!is_connected()) return fail("there is no connection to NATS");
  const natsStatus status = natsConnection_Publish(state_->connection, subject.c_str(), bytes.data(),
                                                   static_cast<int>(bytes.size()));
  if (status != NATS_OK) return state_->failed("a message was not sent", status);
  return {};
}

// ---- subscriptions

struct BusSubscription::Handler {
  std::mutex mutex;  ///< held while `handle` runs
  Bus::Handler handle;
};

namespace {

using KeptHandler = std::shared_ptr<BusSubscription::Handler>;

void on_message(natsConnection*, natsSubscription*, natsMsg* message, void* closure) {
  const NatsMessage owned(message);
  BusSubscription::Handler& handler = **static_cast<KeptHandler*>(closure);
  const std::scoped_lock lock(handler.mutex);
  if (!handler.handle) return;
  const auto* const bytes = reinterpret_cast<const uint8_t*>(natsMsg_GetData(message));
  handler.handle(natsMsg_GetSubject(message), {bytes, static_cast<size_t>(natsMsg_GetDataLength(message))});
}

void on_complete(void* closure) {
  delete static_cast<KeptHandler*>(closure);
}

}  // namespace

BusSubscription::BusSubscription(void* subscription, std::shared_ptr<Handler> handler)
    : subscription_(subscription), handler_(std::move(handler)) {}

BusSubscription::~BusSubscription() {
  {
    const std::scoped_lock lock(handler_->mutex);
    handler_->handle = {};
  }
  natsSubscription_Destroy(static_cast<natsSubscription*>(subscription_));
}

Result<std::unique_ptr<BusSubscription>> Bus::subscribe(const std::string& subject, Handler handler) {
  auto shared = std::make_shared<BusSubscription::Handler>();
  shared->handle = std::move(handler);
  auto* const kept = new KeptHandler(shared);  // on_complete() frees it
  natsSubscription* made = nullptr;
  const natsStatus status =
      natsConnection_Subscribe(&made, state_->connection, subject.c_str(), on_message, kept);
  if (status != NATS_OK) {
    delete kept;
    return state_->failed(fmt::format("{} cannot be listened to", subject), status);
  }
  natsSubscription_SetOnCompleteCB(made, on_complete, kept);
  natsSubscription_SetPendingLimits(made, limits::bus_waiting_messages_max, limits::bus_waiting_bytes_max);
  return std::make_unique<BusSubscription>(made, std::move(shared));
}

}  // namespace scree
