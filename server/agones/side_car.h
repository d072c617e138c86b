// Agones' side-car, which stands beside a game server in its pod: one request of its SDK at a time, by the
// REST gateway (https://agones.dev/site/docs/guides/client-sdks/rest/; paths and bodies as in Agones' OpenAPI
// files sdks/swagger/sdk.swagger.json and beta.swagger.json). The library of HTTP is seen by side_car.cpp
// alone.
//
// Threads: one at a time. A call waits at most limits::agones_request_ms.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "shared/base/result.h"

namespace scree {

class SideCar {
 public:
  /// On this machine's loopback.
  explicit SideCar(uint16_t port);
  ~SideCar();
  SideCar(const SideCar&) = delete;
  SideCar& operator=(const SideCar&) = delete;

  Result<void> ready();
  Result<void> health();
  /// The server is somebody's: Agones does not end it to make the fleet smaller.
  Result<void> allocate();
  /// The same for so long; then it is ready again.
  Result<void> reserve(uint32_t seconds);
  Result<void> shut_down();
  /// A label of the game server's record; Agones puts "agones.dev/sdk-" in front of the key.
  Result<void> set_label(const std::string& key, const std::string& value);
  /// A counter that the fleet declares. `false`: it declares none of this name, or this Agones knows no
  /// counters.
  Result<bool> set_counter(const std::string& name, uint64_t count, uint64_t capacity);

 private:
  struct Handle;
  /// The status of the answer; an error: there was none.
  Result<long> ask(const char* method, const std::string& path, const std::string& body);
  Result<void> tell(const char* method, const std::string& path, const std::string& body);

  const uint16_t port_;
  std::unique_ptr<Handle> handle_;
};

}  // namespace scree
