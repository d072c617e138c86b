#include "python/held_client.h"

#include <iterator>
#include <vector>

#include "python/arrays.h"

namespace scree::python {

namespace py = pybind11;

namespace {

/// By SCREE_EVENT_*, from 1.
constexpr const char* event_names[] = {
    "",           "joined",       "lost",  "frame", "terrain", "piece_added", "piece_removed",
    "body_added", "body_removed", "stone", "reply", "status",  "palette",     "said",
    "person",     "message",      "sign",  "cue",   "contact"};

/// What an event of that kind has; bricks as an array of triples.
py::dict event_dict(const scree_event& event) {
  py::dict told;
  told["kind"] = event.kind < std::size(event_names) ? event_names[event.kind] : "";
  told["flags"] = event.flags;
  told["request"] = event.request;
  told["tick"] = event.tick;
  told["session"] = event.session;
  told["number"] = event.number;
  told["id"] = event.id;
  told["value"] = event.value;
  told["position"] = three(event.position);
  told["rotation"] =
      py::make_tuple(event.rotation[3], event.rotation[0], event.rotation[1], event.rotation[2]);
  told["name"] = std::string(event.name);
  told["text"] = std::string(event.text);
  if (event.data != nullptr)
    told["data"] = py::bytes(reinterpret_cast<const char*>(event.data), event.data_bytes);
  if (event.coords != nullptr)
    told["bricks"] = array_over(std::vector<int32_t>(event.coords, event.coords + 3 * event.coord_count),
                                {static_cast<py::ssize_t>(event.coord_count), 3});
  return told;
}

}  // namespace

void HeldClient::poll(uint32_t within_ms) {
  {
    const py::gil_scoped_release unlocked;
    client().poll(within_ms);
  }
  while (const scree_event* const event = client().next()) {
    if (event->kind == SCREE_EVENT_LOST) {
      over_ = (event->flags & 1U) != 0;
      why_lost_ = event->text;
    }
    events_.push_back(event_dict(*event));
  }
}

py::list HeldClient::take_events() {
  py::list all;
  for (; !events_.empty(); events_.pop_front()) all.append(events_.front());
  return all;
}

std::optional<py::dict> HeldClient::find_reply(uint32_t number) {
  for (auto at = events_.begin(); at != events_.end(); ++at) {
    if (py::cast<std::string>((*at)["kind"]) != "reply" || py::cast<uint32_t>((*at)["request"]) != number)
      continue;
    py::dict reply = *at;
    events_.erase(at);
    return reply;
  }
  return std::nullopt;
}

/// A child that os.fork() made has none of the client's threads, for which its end would wait.
HeldClient::~HeldClient() {
  if (process_ != getpid()) (void)client_.release();
}

scree_client& HeldClient::client() {
  if (client_ == nullptr) throw RaisedError("the client is closed");
  if (process_ != getpid()) throw RaisedError("the client is that of the process before os.fork()");
  return *client_;
}

Mirror& HeldClient::mirror() {
  if (client().client.mirror() == nullptr) throw RaisedError("no server was reached yet");
  return *client().client.mirror();
}

void HeldClient::close() {
  if (process_ != getpid()) return;
  std::unique_ptr<scree_client> gone = std::move(client_);
  const py::gil_scoped_release unlocked;
  gone.reset();
}

}  // namespace scree::python
