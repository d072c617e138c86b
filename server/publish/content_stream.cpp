#include "server/publish/content_stream.h"

#include <algorithm>

#include "crypto/sha256.h"
#include "proto/limits.h"
#include "proto/palette_codec.h"
#include "server/publish/limits.h"
#include "shared/base/check.h"

namespace scree {

ContentStream::ContentStream(std::shared_ptr<const Palette> own,
                             const std::shared_ptr<const ContentFiles>& images,
                             const std::shared_ptr<const ContentFiles>& models)
    : own_(std::move(own)) {
  for (const auto& files : {images, models})
    if (files != nullptr)
      for (const auto& [digest, bytes] : *files)
        files_.emplace(digest, Bytes(files, &bytes));  // which keeps all of them
  take_settings({});
}

bool ContentStream::take_settings(const SettingValues& settings) {
  if (own_ == nullptr) return false;
  auto bytes = std::make_shared<const std::vector<uint8_t>>(encode_palette(*palette_with(own_, settings)));
  CHECK(bytes->size() <= limits::content_bytes_max);
  const Digest digest = sha256(*bytes);
  if (digest_ == digest) return false;
  if (digest_) {
    for (auto& [session, sent] : sent_) sent.erase(*digest_);
    if (former_.size() >= limits::former_palettes_max) former_.clear();
    former_.insert(*digest_);
  }
  former_.erase(digest);
  digest_ = digest;
  palette_ = std::move(bytes);
  for (auto& [session, queue] : queues_) drop_former(queue);
  return true;
}

void ContentStream::drop_former(Queue& queue) const {
  const auto first = queue.wanted.begin() + (queue.bytes == nullptr ? 0 : 1);
  queue.wanted.erase(std::remove_if(first, queue.wanted.end(),
                                    [&](const Digest& digest) { return former_.contains(digest); }),
                     queue.wanted.end());
}

ContentStream::Bytes ContentStream::find(const Digest& digest) const {
  if (digest == digest_) return palette_;
  const auto file = files_.find(digest);
  return file == files_.end() ? nullptr : file->second;
}

bool ContentStream::ask(uint64_t session, uint64_t party, const AskContentMessage& request) {
  if (const auto queue = queues_.find(session); queue != queues_.end()) drop_former(queue->second);
  if (waiting(session) + request.wanted.size() > limits::contents_wanted_max) return false;
  for (const Digest& digest : request.wanted) {
    const auto sent = sent_.find(session);
    if (sent != sent_.end() && sent->second.contains(digest)) continue;
    queues_[session].wanted.push_back(digest);
    turns_.wait(session, party);
  }
  return true;
}

void ContentStream::leave(uint64_t session) {
  queues_.erase(session);
  sent_.erase(session);
  turns_.leave(session);
}

size_t ContentStream::waiting(uint64_t session) const {
  const auto queue = queues_.find(session);
  return queue == queues_.end() ? 0 : queue->second.wanted.size();
}

/// The next bytes of the content that is begun, as many as the session's room allows.
SharedBytes ContentStream::part_of(Queue& queue) {
  const std::vector<uint8_t>& bytes = *queue.bytes;
  const size_t most = std::clamp(queue.room, limits::content_part_bytes_min, limits::content_part_bytes_max);
  const size_t end = std::min(queue.sent + most, bytes.size());
  ContentMessage part{queue.wanted.front(), static_cast<uint32_t>(bytes.size()),
                      static_cast<uint32_t>(queue.sent)};
  part.part.assign(bytes.begin() + static_cast<ptrdiff_t>(queue.sent),
                   bytes.begin() + static_cast<ptrdiff_t>(end));
  queue.sent = end;
  if (end == bytes.size()) {
    queue.bytes = nullptr;
    queue.wanted.pop_front();
  }
  return share(part);
}

/// The next part, or the answer that there is none such. Null: nothing is left.
SharedBytes ContentStream::next_part(uint64_t session, Queue& queue) {
  while (queue.bytes == nullptr && !queue.wanted.empty()) {
    const Digest digest = queue.wanted.front();
    queue.bytes = find(digest);
    queue.sent = 0;
    if (queue.bytes != nullptr && sent_[session].insert(digest).second) break;
    queue.wanted.pop_front();
    if (queue.bytes == nullptr) return share(ContentMessage{digest});
    queue.bytes = nullptr;  // asked for twice
  }
  return queue.bytes == nullptr ? nullptr : part_of(queue);
}

void ContentStream::serve(const std::function<size_t(uint64_t)>& room,
                          const std::function<bool(uint64_t, const SharedBytes&)>& send) {
  for (auto& [session, queue] : queues_) {
    queue.credit_bytes =
        std::min(queue.credit_bytes + limits::content_bytes_per_tick, limits::content_bytes_per_tick);
    queue.room = room(session);
  }
  turns_.begin();
  for (int64_t left = limits::content_bytes_per_tick_all; left > 0 && !turns_.empty();) {
    const uint64_t session = turns_.next();
    Queue& queue = queues_.at(session);
    if (queue.room == 0 || queue.credit_bytes <= 0) {
      turns_.pass_over();
      continue;
    }
    const SharedBytes bytes = next_part(session, queue);
    const int64_t size = bytes ? size_of(bytes) : 0;
    left -= size;
    queue.credit_bytes -= size;
    const bool has_room = !bytes || send(session, bytes);
    turns_.charge(static_cast<uint64_t>(size), queue.wanted.empty() ? FairTurns::Then::leaves
                                               : has_room           ? FairTurns::Then::waits
                                                                    : FairTurns::Then::is_passed_over);
    if (queue.wanted.empty()) queues_.erase(session);
  }
  turns_.end();
}

}  // namespace scree
