// A client as Python holds it, with the events that a wait came across. One thread at a time uses it: a call
// while another one is under way raises `scree.Error`. All functions run with Python's lock held.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <unistd.h>

#include "client/library/handle.h"
#include "python/errors.h"
#include "shared/base/timing.h"

namespace scree::python {

/// Three numbers of the C interface.
inline pybind11::tuple three(const float v[3]) {
  return pybind11::make_tuple(v[0], v[1], v[2]);
}

class HeldClient {
 public:
  HeldClient(std::unique_ptr<Connector> connector, const scree_options& options)
      : client_(std::make_unique<scree_client>(std::move(connector), options)) {}
  ~HeldClient();
  HeldClient(const HeldClient&) = delete;
  HeldClient& operator=(const HeldClient&) = delete;

  /// Takes what has come into the list of events, waiting up to so long for it without Python's lock.
  void poll(uint32_t within_ms);
  /// Polls until `done`, or raises when that takes too long; `what` for people.
  template <typename Done>
  void poll_until(double within_s, const char* what, Done&& done) {
    constexpr uint32_t wait_ms = 20;
    const double end_s = steady_now_s() + within_s;
    while (!done()) {
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
      if (steady_now_s() >= end_s) throw RaisedError(std::string(what) + " did not come in time");
      poll(wait_ms);
    }
  }
  /// The events since the last call.
  pybind11::list take_events();
  /// The reply of that number, which is no event any more; nothing: it has not come.
  std::optional<pybind11::dict> find_reply(uint32_t number);
  /// Whether no other attempt follows; and why there is no connection.
  bool is_over() const { return over_; }
  const std::string& why_lost() const { return why_lost_; }

  /// Raises where it is closed, or has no world yet.
  scree_client& client();
  Mirror& mirror();
  void close();

 private:
  friend class ClientUse;
  std::atomic<bool> in_use_{false};
  std::unique_ptr<scree_client> client_;
  std::deque<pybind11::dict> events_;
  bool over_ = false;
  std::string why_lost_ = "there is no connection yet";
  int process_ = getpid();  ///< in which the client's threads are
};

/// The use of a client, until it goes out of scope: raises RaisedError where another thread has it.
class ClientUse {
 public:
  explicit ClientUse(HeldClient& held) : held_(held) {
    if (held_.in_use_.exchange(true)) throw RaisedError("another thread uses this client");
  }
  ~ClientUse() { held_.in_use_ = false; }
  ClientUse(const ClientUse&) = delete;
  ClientUse& operator=(const ClientUse&) = delete;

 private:
  HeldClient& held_;
};

}  // namespace scree::python
