// A world's palette, the images that its rows name, and the models of its props, as they come over the wire
// or from the cache. They are bytes that their SHA-256 names (proto/content.proto), which one server's client
// need not be sent by another.
//
// Invariant: all that is held is an image with the hash that names it, or a model's bytes, which only a
// reader can judge (content/model/glb.h); palettes are decoded at once. A server that sends other bytes, more
// than it may, or a palette that none can use, costs nothing else: fault() says it, the content is as if the
// server had none, and the palette stays. One thread at a time.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "client/cache/tile_folder.h"
#include "proto/messages.h"
#include "shared/material/palette.h"

namespace scree {

class ReceivedContent {
 public:
  using Bytes = std::shared_ptr<const std::vector<uint8_t>>;

  /// `images`: whether images are fetched, too.
  ReceivedContent(TileFolder folder, bool images);

  /// The server's palette by the welcome; nothing where it has none. What was asked for is to be asked for
  /// again.
  void begin_session(const std::optional<Digest>& palette);
  /// The server's palette is another one.
  void change_palette(const Digest& palette);
  /// The model of a prop that is here. Each is asked for once in a session.
  void want_model(const Digest& model);
  /// Takes a part. The content's digest, if that was the last part and it holds.
  std::optional<Digest> accept(const ContentMessage& message);
  /// The next request to send; reads the cache. Empty when all is asked for.
  AskContentMessage next_request();

  /// The palette as far as it has come; never null. Until the first has come, plain_palette().
  const std::shared_ptr<const Palette>& palette() const { return palette_; }
  /// Whether it is the server's as of now. False while it is on its way, and where the server has none.
  bool is_current() const { return wanted_palette_ && current_ == wanted_palette_; }
  /// Whether nothing more is to come: it has come, or never will.
  bool is_settled() const { return wanted_.empty() && asked_.empty(); }
  /// An image's bytes. Null when it has not come.
  Bytes find(const Digest& digest) const;
  /// A model's bytes, which are any. Null when it has not come.
  Bytes find_model(const Digest& digest) const;
  /// What was wrong with the server's content last; empty: nothing.
  const std::string& fault() const { return fault_; }
  /// Bytes of parts that came, of all sessions.
  uint64_t bytes_received() const { return bytes_received_; }

 private:
  struct Partial {
    std::vector<uint8_t> bytes;
    uint32_t total = 0;
  };
  std::string fault_of(const ContentMessage& message, const Partial& partial) const;
  /// Whether it is neither wanted yet, nor given up.
  bool is_new(const Digest& digest) const;
  void want_image(const Digest& digest);
  void want_images();
  void hold_model(const Digest& digest, std::vector<uint8_t> bytes);
  /// Words for it, for people.
  std::string what_is(const Digest& digest) const;
  bool hold_image(const Digest& digest, std::vector<uint8_t> bytes);
  bool take(const Digest& digest, std::vector<uint8_t> bytes);
  bool use_palette(std::span<const uint8_t> bytes);
  void drop(const Digest& digest, const std::string& fault);

  const TileFolder folder_;
  const bool images_;
  std::optional<Digest> wanted_palette_;
  std::optional<Digest> current_;  ///< of palette_
  std::shared_ptr<const Palette> palette_ = plain_palette();
  std::vector<Digest> wanted_;       ///< not asked for yet
  std::map<Digest, Partial> asked_;  ///< and not come whole
  std::set<Digest> given_up_;        ///< in this session
  std::map<Digest, Bytes> held_;     ///< images
  size_t held_bytes_ = 0;
  std::set<Digest> models_;              ///< wanted in this session
  std::map<Digest, Bytes> held_models_;  ///< those that have come
  size_t model_bytes_ = 0;
  uint64_t bytes_received_ = 0;
  std::string fault_;
};

}  // namespace scree
