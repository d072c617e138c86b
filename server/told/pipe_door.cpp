#include "server/told/pipe_door.h"

#include <utility>

#include "server/log/log.h"
#include "server/told/limits.h"
#include "shared/base/timing.h"

namespace scree {

PipeDoor::Edge::Edge(double now_s)
    : heard_s(now_s),
      opens(limits::pipes_per_second_max, limits::pipes_burst_max),
      messages(limits::edge_messages_per_second_max, limits::edge_messages_burst_max) {}

PipeDoor::PipeDoor(std::shared_ptr<Bus> bus, const std::string& world, NetServer& net, bool encrypted)
    : bus_(std::move(bus)), names_(world), net_(net), encrypted_(encrypted) {}

Result<std::unique_ptr<PipeDoor>> PipeDoor::open(std::shared_ptr<Bus> bus, const std::string& world,
                                                 NetServer& net, bool encrypted) {
  auto door = std::unique_ptr<PipeDoor>(new PipeDoor(std::move(bus), world, net, encrypted));
  door->subscription_ = TRY(door->bus_->subscribe(
      door->names_.up("*"), [d = door.get()](const std::string& subject, std::span<const uint8_t> bytes) {
        d->heard(subject, bytes);
      }));
  return door;
}

PipeDoor::~PipeDoor() = default;

/// On a thread of the bus.
void PipeDoor::heard(const std::string& subject, std::span<const uint8_t> bytes) {
  const std::string name = subject.substr(names_.up("").size());
  auto message = decode_pipe_message(bytes);
  if (!message || !is_bus_name(name) || waiting_ >= limits::edge_messages_waiting_max) {
    ++refused_;
    return;
  }
  ++waiting_;
  net_.post([this, name, taken = std::move(*message)] {
    --waiting_;
    take(name, taken);
  });
}

PipeDoor::Edge* PipeDoor::edge_of(const std::string& name, const PipeMessage& message, double now_s) {
  auto found = edges_.find(name);
  if (found == edges_.end()) {
    if (edges_.size() >= limits::edges_max) return nullptr;
    found = edges_.emplace(name, Edge(now_s)).first;
    if (const auto more = log_limit_.admit("here", now_s))
      log_of(LogPart::bus).info("the edge {} is here{}", name, *more);
  }
  Edge& edge = found->second;
  if (edge.run != message.edge_run) end_pipes(edge, "the edge has begun anew");
  edge.run = message.edge_run;
  edge.heard_s = now_s;
  return edge.messages.try_spend(now_s) ? &edge : nullptr;
}

void PipeDoor::take(const std::string& edge_name, const PipeMessage& message) {
  const double now_s = steady_now_s();
  Edge* const edge = edge_of(edge_name, message, now_s);
  if (edge == nullptr) {
    ++refused_;
    return;
  }
  if (message.pipe == 0) return count();
  const auto found = edge->pipes.find(message.pipe);
  std::shared_ptr<PipeTransport> pipe = found == edge->pipes.end() ? nullptr : found->second;
  if (pipe == nullptr && message.number == 0 && !message.ends)
    pipe = open_pipe(*edge, edge_name, message, now_s);
  if (pipe == nullptr) {
    if (!message.ends) answer_end(edge_name, message);
    return;
  }
  pass(*edge, message, pipe);
  count();
}

std::shared_ptr<PipeTransport> PipeDoor::open_pipe(Edge& edge, const std::string& name,
                                                   const PipeMessage& message, double now_s) {
  if (edge.pipes.size() >= limits::pipes_of_an_edge_max || pipes_ >= limits::pipes_max ||
      !edge.opens.try_spend(now_s)) {
    ++refused_;
    return nullptr;
  }
  auto pipe = std::make_shared<PipeTransport>(bus_, names_.down(name),
                                              PipeAddress{name, message.edge_run, message.pipe}, encrypted_);
  edge.pipes[message.pipe] = pipe;
  ++pipes_;
  ++opened_;
  net_.enter(pipe);
  return pipe;
}

void PipeDoor::pass(Edge& edge, const PipeMessage& message, const std::shared_ptr<PipeTransport>& pipe) {
  const bool follows = message.number == pipe->next_number();
  pipe->note_received();
  const bool taken = follows && pipe->arrived(message.bytes);
  if (!taken) {
    ++refused_;
    pipe->ended({false, "a message of the pipe is missing, or too many wait", false});
  } else if (message.ends) {
    pipe->ended({true, "the edge has ended the pipe", false});
  }
  if (taken && !message.ends && !pipe->is_closed()) return;
  pipes_ -= edge.pipes.erase(message.pipe);
}

void PipeDoor::end_pipes(Edge& edge, const std::string& why) {
  const auto pipes = std::exchange(edge.pipes, {});
  pipes_ -= pipes.size();
  for (const auto& [number, pipe] : pipes) pipe->ended({false, why, false});
}

/// The edge takes it for one that is open.
void PipeDoor::answer_end(const std::string& edge_name, const PipeMessage& message) {
  static_cast<void>(
      bus_->send(names_.down(edge_name), encode(PipeMessage{message.edge_run, message.pipe, 0, {}, true})));
}

void PipeDoor::check_time(double now_s) {
  for (auto edge = edges_.begin(); edge != edges_.end();) {
    pipes_ -= std::erase_if(edge->second.pipes, [](const auto& one) { return one.second->is_closed(); });
    if (now_s - edge->second.heard_s <= limits::edge_silent_s) {
      ++edge;
      continue;
    }
    if (const auto more = log_limit_.admit("silent", now_s))
      log_of(LogPart::bus).warn("the edge {} is silent: its persons' connections end{}", edge->first, *more);
    end_pipes(edge->second, "the edge is silent");
    edge = edges_.erase(edge);
  }
  count();
}

void PipeDoor::count() {
  edges_seen_ = edges_.size();
  pipes_seen_ = pipes_;
}

PipeDoorStatus PipeDoor::status() const {
  return {edges_seen_, pipes_seen_, opened_, refused_};
}

}  // namespace scree
