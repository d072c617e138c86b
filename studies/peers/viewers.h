// Viewers of a server of Scree: clients whose mirrors apply everything and check every hash, all on one
// thread of their own.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "client/session/client.h"

namespace scree {

class Viewers {
 public:
  /// They look from there, at all within the radius.
  Viewers(uint16_t port, glm::vec3 eye_m, float interest_m);
  ~Viewers();
  Viewers(const Viewers&) = delete;
  Viewers& operator=(const Viewers&) = delete;

  /// Joins one more; returns when the server has welcomed it.
  Result<void> add();
  /// Asks for a carve, by the first viewer. There must be one.
  void carve(const CarveRequest& request);

  std::vector<uint64_t> received_bytes() const;  ///< by viewer
  /// By the first viewer's last status, which comes once a second.
  size_t pieces() const { return pieces_; }
  size_t refused() const { return refused_; }
  uint64_t checks() const;
  uint64_t mismatches() const;
  /// Why one of them cannot go on; empty: all can.
  std::string failure() const;

 private:
  void run();
  void receive(Client& viewer, bool first);

  uint16_t port_;
  HelloMessage hello_;
  mutable std::mutex mutex_;  ///< of all below that is not atomic
  std::vector<std::unique_ptr<Client>> viewers_;
  std::string failure_;
  uint32_t requests_ = 0;
  std::atomic<size_t> pieces_{0};
  std::atomic<size_t> refused_{0};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace scree
