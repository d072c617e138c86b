// A page has no rules: what server and files need of them (proto/rules_codec.h) is left out of its program.
#include "proto/rules_codec.h"
#include "shared/base/check.h"

namespace scree {

std::string pack_rules(const RulesMessage&) {
  CHECK(false, "only a server's own rules make such a request");
  return {};
}

RulesMessage unpack_rules(const std::string&, FieldChecker& check) {
  check.refuse("a page has no rules");
  return {};
}

std::string pack_restore(const RestoreMessage&) {
  CHECK(false, "only a server itself makes such a request");
  return {};
}

RestoreMessage unpack_restore(const std::string&, FieldChecker& check) {
  check.refuse("a page takes nothing back");
  return {};
}

}  // namespace scree
