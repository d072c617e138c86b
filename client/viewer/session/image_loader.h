// Makes the images of a palette ready to be drawn as their files come: a decoder's work is for the pool's
// threads. One thread owns it.
#pragma once

#include <functional>
#include <memory>
#include <set>

#include "client/cache/received_content.h"
#include "client/render/renderer.h"
#include "client/render/scene/material_texels.h"
#include "client/render/scene/work_pool.h"
#include "shared/material/palette.h"

namespace scree {

/// Decodes the bytes of a PNG, on any thread. Null: nobody decodes.
using DecodeImage = Result<Image> (*)(std::span<const uint8_t>);

class ImageLoader {
 public:
  using Find = std::function<ReceivedContent::Bytes(const Digest&)>;

  /// `pool` must outlive it.
  ImageLoader(WorkPool& pool, DecodeImage decode);
  ~ImageLoader();

  /// Begins with what `find` has of the palette's images, and takes in what is done. Whether texels() has
  /// more than before. An image that cannot be decoded is not tried again.
  bool follow(const Palette& palette, const Find& find);
  const MaterialTexelSet& texels() const { return texels_; }
  bool complete() const { return waiting_ == 0; }

 private:
  struct Inbox;

  void forget_others(const Palette& palette);
  void begin(const Digest& image, const ReceivedContent::Bytes& file);

  WorkPool& pool_;
  DecodeImage decode_;
  std::shared_ptr<Inbox> inbox_;
  std::set<Digest> begun_;
  size_t waiting_ = 0;
  MaterialTexelSet texels_;
};

}  // namespace scree
