#include "client/connection/connection.h"

#include <asio/executor_work_guard.hpp>
#include <asio/io_context.hpp>
#include <asio/post.hpp>
#include <asio/steady_timer.hpp>
#include <condition_variable>
#include <deque>
#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <thread>

#include "client/connection/come_again.h"
#include "client/connection/dial.h"
#include "client/connection/intake.h"
#include "client/connection/limits.h"
#include "proto/codec.h"
#include "transport/transport.h"

namespace scree {

/// The network thread alone uses the members that `mutex` does not guard. Until the welcome, connect() runs
/// the context on its caller's thread; then `thread` runs it.
struct Connection::Impl {
  using Clock = std::chrono::steady_clock;

  struct Waiting {
    Received received;
    size_t memory = 0;
  };

  asio::io_context context;
  std::optional<asio::executor_work_guard<asio::io_context::executor_type>> work;
  std::thread thread;
  Dial dial{context};                    ///< until it has reached the server
  std::shared_ptr<Transport> transport;  ///< from then on
  Intake intake;
  std::vector<uint8_t> buffer = std::vector<uint8_t>(limits::read_bytes);
  std::deque<std::vector<uint8_t>> outbox;
  size_t front_sent_bytes = 0;  ///< sent bytes of the first message in the outbox
  size_t outbox_bytes = 0;
  bool reading = false;  ///< a read is under way
  bool paused = false;   ///< by pause_reading
  bool leaving = false;  ///< ends when all is sent
  bool ended = false;    ///< the socket is closed
  asio::steady_timer silence{context};
  double silent_seconds_max = 0.0;
  Clock::time_point heard{};  ///< when bytes came last, or were not asked for

  mutable std::mutex mutex;
  std::condition_variable changed;
  std::deque<Waiting> queue;  // guarded by mutex, as all below
  size_t queue_memory = 0;
  bool starved = false;  ///< reading stopped because the queue is full
  bool open = false;
  ConnectionEnd reason;
  ConnectionCounters counters;

  Result<void> start(const ServerEndpoint& server, const std::vector<ClientMessage>& first);
  void end(const std::string& why, const std::string& refusal = {});
  void check_silence();
  void read();
  void queue_messages();
  void enqueue(ServerMessage message, size_t bytes);
  void open_up();
  void push(std::vector<uint8_t> bytes);
  void note_sent(size_t bytes);
  void write();
  void leave();
  std::vector<Received> pop_all();
};

/// Connects, and says hello.
Result<void> Connection::Impl::start(const ServerEndpoint& server, const std::vector<ClientMessage>& first) {
  return dial.begin(
      server,
      [this, first](std::shared_ptr<Transport> stream) {
        transport = std::move(stream);
        for (const ClientMessage& message : first) {
          std::vector<uint8_t> bytes = encode(message);
          note_sent(bytes.size());
          push(std::move(bytes));
        }
        read();
      },
      [this](const ConnectionEnd& failed) { end(failed.message, failed.refusal); });
}

void Connection::Impl::end(const std::string& why, const std::string& refusal) {
  if (ended) return;
  ended = true;
  dial.cancel();
  if (transport) transport->close();
  silence.cancel();
  work.reset();
  {
    const std::scoped_lock lock(mutex);
    open = false;
    reason = {{why}, refusal};
  }
  changed.notify_all();
  if (!intake.welcome()) context.stop();
}

void Connection::Impl::read() {
  if (ended || reading || paused) return;
  reading = true;
  transport->read_some(buffer, [this](const Moved& moved) {
    reading = false;
    if (ended) return;
    if (!moved && !transport->established()) return end(moved.error().why);
    if (!moved && moved.error().orderly) return end("the server closed the connection");
    if (!moved) return end("the connection was lost: " + moved.error().why);
    {
      const std::scoped_lock lock(mutex);
      counters.received_bytes += *moved;
    }
    heard = Clock::now();
    intake.push(std::span<const uint8_t>(buffer).first(*moved));
    queue_messages();
  });
}

/// Ends the connection when the server has fallen silent.
void Connection::Impl::check_silence() {
  const std::chrono::duration<double> most(silent_seconds_max);
  silence.expires_after(std::chrono::duration_cast<Clock::duration>(most / 4));
  silence.async_wait([this, most](const asio::error_code& error) {
    if (error || ended) return;
    if (!reading || !intake.sends_frames()) heard = Clock::now();
    if (Clock::now() - heard > most)
      return end(fmt::format("the connection was lost: the server has been silent for {} s",
                             std::lround(most.count())));
    check_silence();
  });
}

/// Moves the reader's messages into the queue, as far as it has room; then continues to read.
void Connection::Impl::queue_messages() {
  while (!ended) {
    {
      const std::scoped_lock lock(mutex);
      counters.messages_unknown = intake.unknown();
      const bool full =
          queue.size() >= limits::received_messages_max || queue_memory >= limits::received_bytes_max;
      if (full) {
        if (!starved) ++counters.pauses;
        starved = true;
        return;
      }
    }
    auto next = intake.next();
    if (!next) return end(next.error().message, next.error().refusal);
    if (!*next) break;
    if (std::holds_alternative<WelcomeMessage>((*next)->message)) {
      open_up();
    } else {
      enqueue(std::move((*next)->message), (*next)->bytes);
    }
  }
  read();
}

/// The welcome has come.
void Connection::Impl::open_up() {
  {
    const std::scoped_lock lock(mutex);
    open = true;
  }
  context.stop();  // connect() waits for this; the thread goes on from here
}

void Connection::Impl::enqueue(ServerMessage message, size_t bytes) {
  const size_t memory = memory_bytes(message);
  {
    const std::scoped_lock lock(mutex);
    queue.push_back({{std::move(message), bytes, Clock::now()}, memory});
    queue_memory += memory;
    ++counters.received_messages;
  }
  changed.notify_all();
}

void Connection::Impl::note_sent(size_t bytes) {
  const std::scoped_lock lock(mutex);
  counters.sent_bytes += bytes;
  ++counters.sent_messages;
}

void Connection::Impl::push(std::vector<uint8_t> bytes) {
  if (ended) return;
  outbox_bytes += bytes.size();
  if (outbox_bytes > limits::unsent_bytes_max)
    return end(fmt::format("the server does not read: {} bytes wait to be sent (limits.unsent_bytes_max)",
                           outbox_bytes));
  outbox.push_back(std::move(bytes));
  if (outbox.size() == 1) write();
}

void Connection::Impl::write() {
  const std::span<const uint8_t> rest = std::span<const uint8_t>(outbox.front()).subspan(front_sent_bytes);
  transport->write_some({&rest, 1}, [this](const Moved& moved) {
    if (ended) return;
    if (!moved) {
      // The server may have sent its reason before it closed: unread bytes say more than this error.
      outbox.clear();
      outbox_bytes = front_sent_bytes = 0;
      if (leaving) end("closed here");
      return;
    }
    front_sent_bytes += *moved;
    if (front_sent_bytes < outbox.front().size()) return write();
    outbox_bytes -= outbox.front().size();
    outbox.pop_front();
    front_sent_bytes = 0;
    if (!outbox.empty()) return write();
    if (leaving) end("closed here");
  });
}

/// Ends when the goodbye, and all before it, is sent, or cannot be sent in time.
void Connection::Impl::leave() {
  if (ended || leaving) return;
  silence.expires_after(std::chrono::milliseconds(limits::goodbye_ms_max));
  silence.async_wait([this](const asio::error_code& error) {
    if (!error) end("closed here");
  });
  leaving = true;
  push(encode(ClientMessage(GoodbyeMessage{})));
}

std::vector<Received> Connection::Impl::pop_all() {
  std::vector<Received> all;
  all.reserve(queue.size());
  for (Waiting& waiting : queue) all.push_back(std::move(waiting.received));
  queue.clear();
  queue_memory = 0;
  if (starved) asio::post(context, [this] { queue_messages(); });
  starved = false;
  return all;
}

Connection::Connection(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

tl::expected<std::unique_ptr<Connection>, ConnectionEnd> Connection::connect(
    const ServerEndpoint& server, HelloMessage hello, std::chrono::milliseconds within,
    const std::vector<ClientMessage>& then) {
  const auto failed = [&server](const std::string& why, const std::string& refusal = {}) {
    return tl::unexpected(ConnectionEnd{{fmt::format("{}: {}", text_of(server), why)}, refusal});
  };
  hello.token = server.socket.empty() ? server.token : std::string();
  std::vector<ClientMessage> first{std::move(hello)};
  first.insert(first.end(), then.begin(), then.end());
  try {
    auto impl = std::make_unique<Impl>();
    impl->work.emplace(impl->context.get_executor());  // a link may have nothing to do until the time is over
    impl->silent_seconds_max = server.silent_seconds_max;
    if (Result<void> started = impl->start(server, first); !started) return failed(started.error().message);
    impl->context.run_for(within);
    if (!impl->intake.welcome()) {
      impl->end(fmt::format("no answer within {} ms", within.count()));
      return failed(impl->reason.message, impl->reason.refusal);
    }
    impl->context.restart();
    if (!impl->ended) impl->check_silence();
    impl->thread = std::thread([context = &impl->context] { context->run(); });
    return std::unique_ptr<Connection>(new Connection(std::move(impl)));
  } catch (const std::exception& error) {
    return failed(error.what());
  }
}

Connection::~Connection() {
  close();
  if (impl_->thread.joinable()) impl_->thread.join();
}

const WelcomeMessage& Connection::welcome() const {
  return *impl_->intake.welcome();
}

std::vector<Received> Connection::poll() {
  const std::scoped_lock lock(impl_->mutex);
  return impl_->pop_all();
}

void Connection::await(std::chrono::milliseconds within) {
  std::unique_lock lock(impl_->mutex);
  impl_->changed.wait_for(lock, within, [this] { return !impl_->queue.empty() || !impl_->open; });
}

std::vector<Received> Connection::wait(std::chrono::milliseconds within) {
  await(within);
  return poll();
}

void Connection::send(const ClientMessage& message) {
  std::vector<uint8_t> bytes = encode(message);
  {
    const std::scoped_lock lock(impl_->mutex);
    if (!impl_->open) return;
  }
  impl_->note_sent(bytes.size());
  asio::post(impl_->context,
             [impl = impl_.get(), bytes = std::move(bytes)]() mutable { impl->push(std::move(bytes)); });
}

bool Connection::connected() const {
  const std::scoped_lock lock(impl_->mutex);
  return impl_->open;
}

ConnectionEnd Connection::end() const {
  const std::scoped_lock lock(impl_->mutex);
  return impl_->reason;
}

ConnectionCounters Connection::counters() const {
  const std::scoped_lock lock(impl_->mutex);
  ConnectionCounters counters = impl_->counters;
  counters.waiting_messages = impl_->queue.size();
  counters.waiting_bytes = impl_->queue_memory;
  return counters;
}

void Connection::close() {
  asio::post(impl_->context, [impl = impl_.get()] {
    if (!impl->leaving) impl->end("closed here");
  });
}

void Connection::leave() {
  asio::post(impl_->context, [impl = impl_.get()] { impl->leave(); });
}

void Connection::pause_reading(bool pause) {
  asio::post(impl_->context, [impl = impl_.get(), pause] {
    impl->paused = pause;
    if (!pause) impl->queue_messages();
  });
}

void Connection::abort() {
  asio::post(impl_->context, [impl = impl_.get()] {
    if (!impl->ended) impl->transport->abort();
    impl->end("cut here");
  });
}

}  // namespace scree
