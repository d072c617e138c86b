// All drawing methods, by name. A new one is a row of the table in methods.cpp, and nothing else outside its
// folder.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "client/render/scene/draw_method.h"
#include "client/render/scene/work_pool.h"

namespace scree {

struct MethodEntry {
  std::string_view name;     ///< as --method takes it
  std::string_view summary;  ///< one line, for people
  /// The feature that this GL context lacks, as a sentence; nothing if the method can be made. Needs the
  /// context current.
  std::optional<std::string> (*missing)();
  /// `pool` must outlive the method. Needs the context current. Fails when a shader or a buffer does.
  Result<std::unique_ptr<DrawMethod>> (*make)(WorkPool& pool, float view_radius_m);
  /// The method's own options; null: none.
  std::span<const DrawOption> (*options)() = nullptr;
};

/// The first one is the default.
std::span<const MethodEntry> all_methods();

/// A method's own options.
std::span<const DrawOption> options_of(const MethodEntry& entry);
/// The options of all methods.
std::vector<const DrawOption*> all_draw_options();

/// Null if there is none of that name.
const MethodEntry* method_named(std::string_view name);

/// The next method, cyclically, that this GL context can make; the entry itself if there is no other.
const MethodEntry& next_available(const MethodEntry& entry);

/// Each on a line of its own, for --help.
std::string describe_methods();

}  // namespace scree
