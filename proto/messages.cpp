#include "proto/messages.h"

#include "shared/base/overloaded.h"

namespace scree {

namespace {

template <typename T>
size_t bytes_of(const std::vector<T>& list) {
  return list.size() * sizeof(T);
}

size_t bytes_of(const std::vector<BrickPatch>& bricks) {
  size_t bytes = bricks.size() * sizeof(BrickPatch);
  for (const BrickPatch& patch : bricks) bytes += patch.materials.bytes();
  return bytes;
}

size_t bytes_of(const Volume& volume) {
  return bytes_of(volume.window.codes) + bytes_of(volume.materials.each) + bytes_of(volume.masses);
}

size_t bytes_of(const SettingValues& settings) {
  size_t bytes = 0;
  for (const SettingValue& setting : settings)
    bytes += sizeof(SettingValue) + setting.name.size() + setting.value.size();
  return bytes;
}

size_t bytes_of(const std::vector<StageTime>& stages) {
  size_t bytes = 0;
  for (const StageTime& stage : stages) bytes += sizeof(StageTime) + stage.name.size();
  return bytes;
}

size_t bytes_of(const std::vector<RefusalCount>& refusals) {
  size_t bytes = 0;
  for (const RefusalCount& refusal : refusals) bytes += sizeof(RefusalCount) + refusal.reason.size();
  return bytes;
}

size_t bytes_of(const std::vector<PlayerCursor>& cursors) {
  size_t bytes = 0;
  for (const PlayerCursor& cursor : cursors) bytes += sizeof(PlayerCursor) + cursor.name.size();
  return bytes;
}

size_t bytes_of(const std::vector<Person>& persons) {
  size_t bytes = 0;
  for (const Person& person : persons) bytes += sizeof(Person) + person.name.size();
  return bytes;
}

size_t bytes_of(const std::vector<SessionRow>& sessions) {
  size_t bytes = 0;
  for (const SessionRow& row : sessions)
    bytes += sizeof(SessionRow) + row.name.size() + row.program.size() + row.address.size();
  return bytes;
}

size_t bytes_of(const std::vector<BanRow>& bans) {
  size_t bytes = 0;
  for (const BanRow& row : bans) bytes += sizeof(BanRow) + row.address.size() + row.reason.size();
  return bytes;
}

size_t bytes_of(const std::vector<HealthFault>& faults) {
  size_t bytes = 0;
  for (const HealthFault& fault : faults)
    bytes += sizeof(HealthFault) + fault.name.size() + fault.words.size();
  return bytes;
}

size_t bytes_of(const std::vector<BodyView>& bodies) {
  size_t bytes = 0;
  for (const BodyView& body : bodies) bytes += sizeof(BodyView) + bytes_of(body.hull_m);
  return bytes;
}

}  // namespace

namespace {

size_t bytes_of(const Prop& prop) {
  size_t bytes = prop.data.size();
  for (const PropPart& part : prop.parts) bytes += sizeof part + part.corners_m.size() * sizeof(glm::vec3);
  return bytes;
}

size_t bytes_of(const std::vector<Region>& regions) {
  size_t bytes = 0;
  for (const Region& region : regions) {
    bytes += sizeof region + region.name.size();
    for (const std::string& person : region.persons) bytes += sizeof person + person.size();
  }
  return bytes;
}

size_t bytes_of(const AnswerMessage& message) {
  size_t bytes = message.refusal.size() + message.refusal_name.size() + bytes_of(message.answers);
  for (const QuestionReply& reply : message.answers) {
    bytes += reply.refusal.size() + reply.refusal_name.size();
    if (!reply.answer) continue;
    bytes += std::visit(
        Overloaded{[](const std::optional<Hit>&) { return size_t{0}; }, [](bool) { return size_t{0}; },
                   [](const Overlapping& found) { return bytes_of(found.ids); },
                   [](const BoxContent& content) { return bytes_of(content.masses); },
                   [](const std::vector<PieceId>& ids) { return bytes_of(ids); }},
        *reply.answer);
  }
  return bytes;
}

}  // namespace

size_t memory_bytes(const ServerMessage& message) {
  const size_t held = std::visit(
      Overloaded{
          [](const WelcomeMessage& m) { return m.ticket.size(); },
          [](const RefusalMessage& m) { return m.reason.size() + m.name.size(); },
          [](const FrameMessage& m) {
            return bytes_of(m.operations) + bytes_of(m.patches) + bytes_of(m.dropped_chunks) +
                   bytes_of(m.removed_pieces) + bytes_of(m.transforms) + bytes_of(m.motions);
          },
          [](const ChunkMessage& m) { return bytes_of(m.bricks); },
          [](const UnchangedChunksMessage& m) { return bytes_of(m.chunks) + bytes_of(m.hashes); },
          [](const PieceMessage& m) { return bytes_of(m.volume); },
          [](const StoneMessage& m) { return bytes_of(m.volume); },
          [](const PropMessage& m) { return bytes_of(m.prop); },
          [](const ContactsMessage& m) { return m.contacts.size() * sizeof(ContactEvent); },
          [](const JointsMessage& m) { return bytes_of(m.here) + bytes_of(m.gone); },
          [](const StoresMessage& m) {
            size_t bytes = bytes_of(m.stores);
            for (const StoreContent& one : m.stores) bytes += bytes_of(one.masses);
            return bytes;
          },
          [](const SignsMessage& m) {
            size_t bytes = bytes_of(m.signs);
            for (const Sign& sign : m.signs)
              bytes += sign.name.size() + sign.text.size() + sign.to.team.size();
            return bytes;
          },
          [](const CuesMessage& m) { return bytes_of(m.cues); },
          [](const ChannelMessage& m) { return m.channel.size() + bytes_of(m.bytes); },
          [](const KeptPiecesMessage& m) { return bytes_of(m.kept) + bytes_of(m.released); },
          [](const PersonPlacesMessage& m) { return m.persons ? bytes_of(*m.persons) : size_t{0}; },
          [](const AnswerMessage& m) { return bytes_of(m); },
          [](const RegionsMessage& m) { return bytes_of(m.regions); },
          [](const GroundMessage& m) { return bytes_of(m.bricks); },
          [](const TileMessage& m) { return m.bytes.size(); },
          [](const ContentMessage& m) { return m.part.size(); },
          [](const PaletteChangedMessage&) { return size_t{0}; },
          [](const ResetMessage&) { return size_t{0}; },
          [](const ReplyMessage& m) { return m.refusal.size() + m.refusal_name.size(); },
          [](const StatusMessage& m) {
            return bytes_of(m.settings) + bytes_of(m.refusals) + bytes_of(m.stages) +
                   bytes_of(m.materials.rows());
          },
          [](const CursorsMessage& m) { return bytes_of(m.cursors); },
          [](const PersonsMessage& m) { return bytes_of(m.persons); },
          [](const PlaybackMessage& m) { return m.refusal.size(); },
          [](const MarksMessage& m) { return bytes_of(m.marks); },
          [](const RecordedCursorsMessage& m) { return bytes_of(m.cursors); },
          [](const UnknownMessage& m) { return m.value.size(); },
          [](const HealthMessage& m) { return bytes_of(m.faults); },
          [](const SaidMessage& m) { return m.name.size() + m.text.size(); },
          [](const AdminListMessage& m) {
            return bytes_of(m.sessions) + bytes_of(m.bans) + bytes_of(m.bodies) + bytes_of(m.joints) +
                   bytes_of(m.region_masses);
          },
          [](const PhysicsMessage& m) {
            return bytes_of(m.bodies) + bytes_of(m.contacts) + bytes_of(m.searched);
          },
      },
      message);
  return sizeof(ServerMessage) + held;
}

}  // namespace scree
