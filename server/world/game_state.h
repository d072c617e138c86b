// What a host's rules keep with a world, show in it, and made of persons: a part of its state.
//
// Lists are replaced, never changed, so that a moment of the world and a tick's delta share them. Not
// thread-safe.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "server/formats/world_value.h"

namespace scree {

class GameState {
 public:
  const GameValue& value() const { return value_; }
  /// 0 where there is nothing.
  uint64_t hash() const { return hash_; }

  /// Null: nothing is kept under the key.
  const KeptValue* kept(const std::string& key) const;
  /// Bytes of all keys and values.
  size_t kept_bytes() const { return kept_bytes_; }
  void keep(const KeptValue& value);
  void forget(const std::string& key);

  const Sign* sign(const Audience& to, const std::string& name) const;
  void show(const Sign& sign);
  void remove(const Audience& to, const std::string& name);
  /// Takes out the signs that end before that tick. False: there are none.
  bool end_signs(Tick now);

  /// Null: the rules made nothing of the session's person.
  const Player* player(uint64_t session) const;
  /// Forgets a person of whom the rules made nothing.
  void set(const Player& player);
  /// The session is over: its person, and the signs for it, are forgotten. False: there were no signs.
  bool leave(uint64_t session);

  /// Takes a value. Refuses what no world has.
  Result<void> restore(const GameValue& value);

 private:
  void changed_kept();
  void changed_signs();
  void sum_up();

  GameValue value_;
  size_t kept_bytes_ = 0;
  uint64_t kept_hash_ = 0, signs_hash_ = 0, hash_ = 0;
};

}  // namespace scree
