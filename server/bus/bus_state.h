// What a Bus is made of. Internal to its own sources, which see the library: bus.cpp has the connection,
// bus_streams.cpp the streams.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <nats/nats.h>
#include <string>

#include "server/bus/bus.h"

namespace scree {

/// Frees a value of the library.
template <auto destroy>
struct NatsEnd {
  template <typename T>
  void operator()(T* value) const {
    destroy(value);
  }
};
using NatsOptions = std::unique_ptr<natsOptions, NatsEnd<natsOptions_Destroy>>;
using NatsMessage = std::unique_ptr<natsMsg, NatsEnd<natsMsg_Destroy>>;

/// The library's threads may call as long as the connection is not closed: until then they keep it alive.
struct Bus::State {
  BusConfig config;
  natsConnection* connection = nullptr;
  jsCtx* streams = nullptr;
  /// As the callbacks say, in order: the library's own status is ahead of them.
  std::atomic<bool> connected{false};
  std::atomic<uint64_t> connections{0};
  std::atomic<uint64_t> keep_failures{0};

  mutable std::mutex mutex;  ///< guards the member below
  std::string fault;

  void set_fault(std::string words);
  tl::unexpected<Error> failed(const std::string& what, natsStatus status);
};

}  // namespace scree
