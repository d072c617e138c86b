// Bus's streams, which NATS calls JetStream.
#include <fmt/format.h>

#include "server/bus/bus_state.h"
#include "server/bus/limits.h"

namespace scree {

namespace {

Result<std::optional<KeptMessage>> read(jsCtx* streams, const std::string& stream,
                                        jsDirectGetMsgOptions wanted) {
  if (streams == nullptr) return fail("there is no connection to NATS");
  natsMsg* got = nullptr;
  const natsStatus status = js_DirectGetMsg(&got, streams, stream.c_str(), nullptr, &wanted);
  const NatsMessage owned(got);
  if (status == NATS_NOT_FOUND) return std::optional<KeptMessage>();
  if (status != NATS_OK)
    return fail(fmt::format("the stream {} cannot be read: {}", stream, natsStatus_GetText(status)));
  const auto* const bytes = reinterpret_cast<const uint8_t*>(natsMsg_GetData(got));
  return std::optional(KeptMessage{
      natsMsg_GetSequence(got), natsMsg_GetSubject(got), {bytes, bytes + natsMsg_GetDataLength(got)}});
}

}  // namespace

Result<void> Bus::open_stream(const BusStreamConfig& config) {
  jsStreamConfig wanted;
  jsStreamConfig_Init(&wanted);
  const char* subjects[] = {config.subjects.c_str()};
  wanted.Name = config.name.c_str();
  wanted.Subjects = subjects;
  wanted.SubjectsLen = 1;
  wanted.MaxBytes = static_cast<int64_t>(config.bytes_max);
  wanted.Discard = js_DiscardOld;
  wanted.Storage = config.in_memory ? js_MemoryStorage : js_FileStorage;
  wanted.AllowDirect = true;
  jsErrCode code{};
  natsStatus status = js_AddStream(nullptr, state_->streams, &wanted, nullptr, &code);
  if (status != NATS_OK && code == JSStreamNameExistErr)
    status = js_UpdateStream(nullptr, state_->streams, &wanted, nullptr, &code);
  if (status != NATS_OK)
    return state_->failed(fmt::format("the stream {} cannot be made (error {} of JetStream)", config.name,
                                      static_cast<int>(code)),
                          status);
  return {};
}

Result<uint64_t> Bus::keep(const std::string& subject, std::span<const uint8_t> bytes) {
  if (!is_connected()) return fail("there is no connection to NATS");
  jsPubAck* ack = nullptr;
  const natsStatus status = js_Publish(&ack, state_->streams, subject.c_str(), bytes.data(),
                                       static_cast<int>(bytes.size()), nullptr, nullptr);
  const uint64_t sequence = ack != nullptr ? ack->Sequence : 0;
  jsPubAck_Destroy(ack);
  if (status != NATS_OK) return state_->failed("a message was not kept", status);
  return sequence;
}

Result<void> Bus::keep_later(const std::string& subject, std::span<const uint8_t> bytes) {
  if (!is_connected()) return fail("there is no connection to NATS");
  const natsStatus status = js_PublishAsync(state_->streams, subject.c_str(), bytes.data(),
                                            static_cast<int>(bytes.size()), nullptr);
  if (status != NATS_OK) return state_->failed("a message was not kept", status);
  return {};
}

uint64_t Bus::keep_failures() const {
  return state_->keep_failures;
}

Result<std::optional<KeptMessage>> Bus::kept(const std::string& stream, uint64_t sequence) {
  jsDirectGetMsgOptions wanted;
  jsDirectGetMsgOptions_Init(&wanted);
  wanted.Sequence = sequence;
  return read(is_connected() ? state_->streams : nullptr, stream, wanted);
}

Result<std::optional<KeptMessage>> Bus::last_kept(const std::string& stream, const std::string& subject) {
  jsDirectGetMsgOptions wanted;
  jsDirectGetMsgOptions_Init(&wanted);
  wanted.LastBySubject = subject.c_str();
  return read(is_connected() ? state_->streams : nullptr, stream, wanted);
}

}  // namespace scree
