#include "transport/websocket_engine.h"

#include <algorithm>
#include <fmt/format.h>
#include <wslay/wslay.h>

#include "shared/base/check.h"

namespace scree {

/// Wslay's context. It takes bytes from `arrived_` and puts bytes into `output_` of the engine.
struct WebSocketEngine::Library {
  explicit Library(WebSocketEngine& engine, uint64_t frame_bytes_max) {
    wslay_event_callbacks calls{};
    calls.recv_callback = read_arrived;
    calls.send_callback = put_output;
    calls.on_frame_recv_start_callback = begin_frame;
    calls.on_frame_recv_chunk_callback = add_payload;
    CHECK(wslay_event_context_server_init(&context, &calls, &engine) == 0);
    wslay_event_config_set_no_buffering(context, 1);  // the stream has no messages
    wslay_event_config_set_max_recv_msg_length(context, frame_bytes_max);
  }
  ~Library() { wslay_event_context_free(context); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  static WebSocketEngine& of(void* engine) { return *static_cast<WebSocketEngine*>(engine); }

  static ssize_t read_arrived(wslay_event_context_ptr context, uint8_t* into, size_t bytes, int /*flags*/,
                              void* engine) {
    std::span<const uint8_t>& arrived = of(engine).arrived_;
    const size_t count = std::min(bytes, arrived.size());
    if (count == 0) {
      wslay_event_set_error(context, WSLAY_ERR_WOULDBLOCK);
      return -1;
    }
    std::copy_n(arrived.begin(), count, into);
    arrived = arrived.subspan(count);
    return static_cast<ssize_t>(count);
  }

  static ssize_t put_output(wslay_event_context_ptr /*context*/, const uint8_t* bytes, size_t count,
                            int /*flags*/, void* engine) {
    std::vector<uint8_t>& output = of(engine).output_;
    output.insert(output.end(), bytes, bytes + count);
    return static_cast<ssize_t>(count);
  }

  static void begin_frame(wslay_event_context_ptr /*context*/,
                          const wslay_event_on_frame_recv_start_arg* frame, void* engine) {
    of(engine).begin_frame(frame->opcode, frame->payload_length);
  }

  static void add_payload(wslay_event_context_ptr /*context*/,
                          const wslay_event_on_frame_recv_chunk_arg* chunk, void* engine) {
    WebSocketEngine& self = of(engine);
    if (self.in_data_frame_)
      self.inbox_.insert(self.inbox_.end(), chunk->data, chunk->data + chunk->data_length);
  }

  bool reads() const { return wslay_event_get_read_enabled(context) != 0; }
  bool close_received() const { return wslay_event_get_close_received(context) != 0; }
  uint16_t code_sent() const { return wslay_event_get_status_code_sent(context); }

  wslay_event_context_ptr context = nullptr;
};

WebSocketEngine::WebSocketEngine(uint64_t frame_bytes_max, std::function<double()> now_s)
    : library_(std::make_unique<Library>(*this, frame_bytes_max)),
      now_s_(std::move(now_s)),
      bare_frames_(limits::bare_frames_per_second_max, limits::bare_frames_burst_max) {}

WebSocketEngine::~WebSocketEngine() = default;

void WebSocketEngine::feed(std::span<const uint8_t> arrived) {
  if (inbox_from_ == inbox_.size()) inbox_.clear(), inbox_from_ = 0;
  arrived_ = arrived;
  // What it returns is an error that it has told the other end already.
  static_cast<void>(wslay_event_recv(library_->context));
  arrived_ = {};
  send_queued();
}

void WebSocketEngine::begin_frame(uint8_t opcode, uint64_t payload_bytes) {
  in_data_frame_ = opcode == WSLAY_BINARY_FRAME || opcode == WSLAY_CONTINUATION_FRAME;
  const bool bare = !in_data_frame_ || payload_bytes == 0;
  if (opcode == WSLAY_TEXT_FRAME) return refuse(WSLAY_CODE_UNSUPPORTED_DATA);
  if (bare && !bare_frames_.try_spend(now_s_())) refuse(WSLAY_CODE_POLICY_VIOLATION);
}

void WebSocketEngine::refuse(uint16_t code) {
  in_data_frame_ = false;
  static_cast<void>(wslay_event_queue_close(library_->context, code, nullptr, 0));
  wslay_event_shutdown_read(library_->context);
}

void WebSocketEngine::send_queued() {
  CHECK(wslay_event_send(library_->context) == 0);  // the buffer takes all
}

Result<StreamEngine::Got> WebSocketEngine::read(std::span<uint8_t> into) {
  const size_t count = std::min(into.size(), inbox_.size() - inbox_from_);
  std::copy_n(inbox_.begin() + static_cast<ptrdiff_t>(inbox_from_), count, into.begin());
  inbox_from_ += count;
  if (count > 0 || library_->reads()) return Got{count, false};
  if (library_->close_received()) return Got{0, true};
  return fail(fmt::format("WebSocket: a frame that breaks the rules (close code {})", library_->code_sent()));
}

Result<void> WebSocketEngine::write(std::span<const uint8_t> plain) {
  if (plain.empty()) return {};
  const wslay_event_msg message{WSLAY_BINARY_FRAME, plain.data(), plain.size()};
  const int queued = wslay_event_queue_msg(library_->context, &message);
  CHECK(queued == 0 || queued == WSLAY_ERR_NO_MORE_MSG);
  send_queued();
  return {};
}

void WebSocketEngine::finish() {
  static_cast<void>(wslay_event_queue_close(library_->context, WSLAY_CODE_NORMAL_CLOSURE, nullptr, 0));
  send_queued();
}

void WebSocketEngine::drain_output(std::vector<uint8_t>& into) {
  into = std::move(output_);
  output_.clear();
}

}  // namespace scree
