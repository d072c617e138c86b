// The server's end of a WebSocket (RFC 6455) behind its opening handshake, as bytes in and bytes out: the
// payloads of binary messages, one after the other, are the stream within. How they are cut into messages and
// frames means nothing.
//
// The other end is refused, with the close code in brackets, for frames without a mask, reserved bits and
// opcodes, fragments out of order (1002), text (1003) and closing reasons that are no UTF-8 (1007). So are
// more frames without payload than limits::bare_frames_per_second_max (1008), and frames over the limit
// (1009). A close without a code refuses lengths in a longer form than needed, and control frames that are
// long or cut. Pings are answered, and so is its close.
#pragma once

#include <functional>
#include <memory>

#include "shared/base/rate_limit.h"
#include "shared/base/stream_engine.h"
#include "shared/base/timing.h"
#include "transport/limits.h"

namespace scree {

class WebSocketEngine final : public StreamEngine {
 public:
  /// `frame_bytes_max`: the largest payload of one frame. `now_s`: seconds, never going back.
  explicit WebSocketEngine(uint64_t frame_bytes_max, std::function<double()> now_s = steady_now_s);
  ~WebSocketEngine() override;

  void feed(std::span<const uint8_t> arrived) override;
  Result<void> shake() override { return {}; }
  bool established() const override { return true; }
  Result<Got> read(std::span<uint8_t> into) override;
  /// Takes bytes and loses them when the other end has closed: it reads no more.
  Result<void> write(std::span<const uint8_t> plain) override;
  size_t chunk_bytes() const override { return limits::websocket_chunk_bytes; }
  void finish() override;
  size_t output_bytes() const override { return output_.size(); }
  void drain_output(std::vector<uint8_t>& into) override;

 private:
  struct Library;
  void begin_frame(uint8_t opcode, uint64_t payload_bytes);
  void refuse(uint16_t code);
  void send_queued();

  std::unique_ptr<Library> library_;
  std::function<double()> now_s_;
  RateLimit bare_frames_;
  std::span<const uint8_t> arrived_;  ///< within feed(): what is not looked at yet
  bool in_data_frame_ = false;        ///< of the frame that is being read
  std::vector<uint8_t> inbox_;        ///< payload, read up to inbox_from_
  size_t inbox_from_ = 0;
  std::vector<uint8_t> output_;
};

}  // namespace scree
