#include "server/log/recent_lines.h"

#include <algorithm>
#include <deque>
#include <mutex>
#include <spdlog/sinks/base_sink.h>

#include "server/log/limits.h"
#include "server/log/line_formats.h"
#include "server/log/recent_sink.h"

namespace scree {

namespace {

class RecentSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  RecentSink() : spdlog::sinks::base_sink<std::mutex>(json_lines()) {}

  std::vector<std::string> lines() {
    const std::scoped_lock lock(mutex_);
    return {lines_.begin(), lines_.end()};
  }

 private:
  /// At once: what a line is about is known only while it is written.
  void sink_it_(const spdlog::details::log_msg& line) override {
    spdlog::details::log_msg cut = line;
    cut.payload = {line.payload.data(), std::min(line.payload.size(), limits::recent_message_bytes_max)};
    spdlog::memory_buf_t text;
    formatter_->format(cut, text);
    lines_.emplace_back(text.data(), text.size() - 1);  // without its line feed
    bytes_ += lines_.back().size();
    while (bytes_ > limits::recent_bytes_max) {
      bytes_ -= lines_.front().size();
      lines_.pop_front();
    }
  }
  void flush_() override {}

  std::deque<std::string> lines_;
  size_t bytes_ = 0;
};

const std::shared_ptr<RecentSink>& recent() {
  static const auto sink = std::make_shared<RecentSink>();
  return sink;
}

}  // namespace

std::vector<std::string> recent_lines() {
  return recent()->lines();
}

spdlog::sink_ptr recent_sink() {
  return recent();
}

}  // namespace scree
