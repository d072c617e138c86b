#include "proto/talk_codec.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/limits.h"
#include "shared/base/text.h"

namespace scree {

void write(wire::Persons& to, const PersonsMessage& from) {
  const size_t count = std::min(from.persons.size(), limits::persons_max);
  for (size_t i = 0; i < count; ++i) {
    const Person& person = from.persons[i];
    wire::Person& one = *to.add_persons();
    one.set_session(person.session);
    one.set_name(showable(person.name, limits::person_name_bytes_max));
    one.set_role(static_cast<wire::Role>(person.role));
  }
  to.set_more(from.more + static_cast<uint32_t>(from.persons.size() - count));
  to.set_chat(from.chat);
}

void write(wire::Said& to, const SaidMessage& from) {
  to.set_session(from.session);
  to.set_name(showable(from.name, limits::person_name_bytes_max));
  to.set_text(showable(from.text, limits::line_bytes_max));
}

void write(wire::Say& to, const SayMessage& from) {
  to.set_text(showable(from.text, limits::line_bytes_max));
}

PersonsMessage read(const wire::Persons& from, FieldChecker& check) {
  PersonsMessage persons;
  if (static_cast<size_t>(from.persons_size()) > limits::persons_max)
    check.refuse(fmt::format("more than {} persons", limits::persons_max));
  for (const wire::Person& person : from.persons()) {
    if (check.failed()) break;
    if (!persons.persons.empty() && person.session() <= persons.persons.back().session)
      check.refuse("the sessions of persons do not ascend");
    persons.persons.push_back({person.session(),
                               check.text(person.name(), limits::person_name_bytes_max, "name of a person"),
                               check.kind_or(person.role(), Role::viewer)});
  }
  persons.more = from.more();
  persons.chat = from.chat();
  return persons;
}

SaidMessage read(const wire::Said& from, FieldChecker& check) {
  if (from.text().empty()) check.refuse("a line without text");
  return {from.session(), check.text(from.name(), limits::person_name_bytes_max, "name of a person"),
          check.text(from.text(), limits::line_bytes_max, "text of a line")};
}

SayMessage read(const wire::Say& from, FieldChecker& check) {
  return {check.text(from.text(), limits::line_bytes_max, "text of a line")};
}

}  // namespace scree
