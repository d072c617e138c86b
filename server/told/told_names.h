// Subjects and streams of a world that is told over a bus (server/formats/bus.proto).
#pragma once

#include <string>
#include <string_view>

namespace scree {

struct ToldNames {
  explicit ToldNames(const std::string& world) : base("scree." + world), stream("SCREE_" + world) {}

  std::string base;
  std::string stream;

  std::string kept() const { return base + ".told.*"; }  ///< what the stream keeps
  std::string tick() const { return base + ".told.tick"; }
  std::string keyframe() const { return base + ".told.keyframe"; }
  std::string whole() const { return base + ".told.whole"; }
  /// From an edge to the simulating server, and back. `edge` may be "*".
  std::string up(std::string_view edge) const { return base + ".up." + std::string(edge); }
  std::string down(std::string_view edge) const { return base + ".down." + std::string(edge); }
};

}  // namespace scree
