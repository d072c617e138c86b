#include "transport/layered_transport.h"

#include <algorithm>
#include <fmt/format.h>

#include "shared/base/check.h"

namespace scree {

LayeredTransport::LayeredTransport(std::shared_ptr<Transport> below, std::unique_ptr<StreamEngine> engine,
                                   std::span<const uint8_t> arrived)
    : below_(std::move(below)), engine_(std::move(engine)) {
  engine_->feed(arrived);
}

void LayeredTransport::read_some(std::span<uint8_t> into, Done done) {
  CHECK(!read_done_ && !into.empty());
  into_ = into;
  read_done_ = std::move(done);
  go_on();
}

/// A copy: one record or frame holds what many buffers do, and each costs some bytes.
void LayeredTransport::stage(Buffers buffers) {
  CHECK(!write_done_ && plain_.empty());
  for (const std::span<const uint8_t> bytes : buffers) {
    const auto some = bytes.first(std::min(bytes.size(), engine_->chunk_bytes() - plain_.size()));
    plain_.insert(plain_.end(), some.begin(), some.end());
  }
  staged_bytes_ = plain_.size();
}

void LayeredTransport::write_some(Buffers buffers, Done done) {
  stage(buffers);
  write_done_ = std::move(done);
  go_on();
}

/// While anything waits to be sent, nothing more goes through the engine: it could not leave.
size_t LayeredTransport::write_now(Buffers buffers) {
  const bool waiting = sending_ || unsent_from_ < unsent_.size() || engine_->output_bytes() > 0;
  if (waiting || closed_ || broken_ || !engine_->established()) return 0;
  stage(buffers);
  pass_on();
  if (broken_) return 0;
  engine_->drain_output(unsent_);
  const std::span<const uint8_t> bytes(unsent_);
  unsent_from_ = below_->write_now({&bytes, 1});
  return staged_bytes_;
}

void LayeredTransport::send_rest() {
  below_->send_rest();
  send();
}

/// Does all that can be done now. A handler called from here may end the stream.
void LayeredTransport::go_on() {
  const auto self = shared_from_this();
  if (closed_) return;
  if (!broken_)
    if (const Result<void> shaken = engine_->shake(); !shaken) break_off(shaken.error());
  pass_on();
  send();
  deliver();
  if (closed_) return;
  if (end_) return fail_waiting();
  receive();
}

void LayeredTransport::pass_on() {
  if (broken_ || plain_.empty() || !engine_->established()) return;
  const Result<void> written = engine_->write(plain_);
  plain_.clear();
  if (!written) break_off(written.error());
}

/// The engine is of no more use, but for the reason in its output.
void LayeredTransport::break_off(const Error& error) {
  broken_ = true;
  end_ = StreamEnd{.orderly = false, .why = error.message, .broken = engine_->established()};
}

void LayeredTransport::send() {
  if (sending_ || closed_) return;
  if (unsent_from_ == unsent_.size()) {
    engine_->drain_output(unsent_);
    unsent_from_ = 0;
  }
  if (unsent_.empty()) return;
  sending_ = true;
  const std::span<const uint8_t> bytes = std::span(unsent_).subspan(unsent_from_);
  below_->write_some({&bytes, 1}, [self = shared_from_this()](const Moved& moved) { self->sent(moved); });
}

void LayeredTransport::sent(const Moved& moved) {
  sending_ = false;
  if (closed_) return;
  if (!moved) {
    plain_.clear();
    if (const Done done = std::exchange(write_done_, nullptr)) done(moved);
    return;
  }
  unsent_from_ += *moved;
  if (unsent_from_ < unsent_.size() || engine_->output_bytes() > 0) return send();
  unsent_.clear();
  unsent_from_ = 0;
  if (finishing_) below_->finish_sending();
  if (plain_.empty())
    if (const Done done = std::exchange(write_done_, nullptr)) done(staged_bytes_);
  go_on();
}

void LayeredTransport::deliver() {
  if (!read_done_ || broken_ || !engine_->established()) return;
  const Result<StreamEngine::Got> got = engine_->read(into_);
  if (got && got->bytes > 0) return std::exchange(read_done_, nullptr)(got->bytes);
  if (!got) break_off(got.error());
  if (got && got->ended) end_ = StreamEnd{true, "the other side ended it"};
}

void LayeredTransport::receive() {
  const bool wanted = read_done_ || (!engine_->established() && write_done_);
  const bool blocked =
      engine_->output_bytes() + (unsent_.size() - unsent_from_) > limits::layer_unsent_bytes_max;
  if (!wanted || blocked || receiving_ || end_) return;
  receiving_ = true;
  below_->read_some(incoming_, [self = shared_from_this()](const Moved& moved) { self->received(moved); });
}

void LayeredTransport::received(const Moved& moved) {
  receiving_ = false;
  if (closed_) return;
  if (moved) {
    engine_->feed(std::span(incoming_).first(*moved));
  } else {
    end_ = moved.error();
    if (!engine_->established())
      end_ = StreamEnd{false, fmt::format("the other side ended the TLS handshake ({}): does it speak TLS?",
                                          moved.error().why)};
  }
  go_on();
}

/// Nothing is read any more; what waits for a handshake that failed is not written either.
void LayeredTransport::fail_waiting() {
  send();  // the reason, for the other side
  const StreamEnd end = *end_;
  const bool never_written = !plain_.empty();
  plain_.clear();
  const Done read = std::exchange(read_done_, nullptr);
  const Done write = never_written ? std::exchange(write_done_, nullptr) : nullptr;
  if (read) read(tl::unexpected(end));
  if (write && !closed_) write(tl::unexpected(end));
}

void LayeredTransport::finish_sending() {
  finishing_ = true;
  engine_->finish();
  send();
  if (!sending_) below_->finish_sending();
}

void LayeredTransport::drop() {
  closed_ = true;
  const Done read = std::exchange(read_done_, nullptr);
  const Done write = std::exchange(write_done_, nullptr);
}

void LayeredTransport::close() {
  const auto self = shared_from_this();
  drop();
  below_->close();
}

void LayeredTransport::abort() {
  const auto self = shared_from_this();
  drop();
  below_->abort();
}

}  // namespace scree
