#include "tools/import/assimp/nesting.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <string_view>
#include <vector>

#include "tools/import/assimp/gltf_nodes.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

using std::string_view;

/// How deep it is so far, and at the deepest.
class Depth {
 public:
  void go_in() { deepest_ = std::max(deepest_, ++now_); }
  void go_out() { now_ -= now_ > 0 ? 1 : 0; }

  Result<void> check(string_view what) const {
    if (deepest_ <= limits::scene_nesting_max) return {};
    return fail(
        fmt::format("its {} are nested {} deep: at most {} can be imported (limits.scene_nesting_max)", what,
                    deepest_, limits::scene_nesting_max));
  }

 private:
  size_t now_ = 0;
  size_t deepest_ = 0;
};

/// The number at a place, as little-endian bytes; 0 beyond the end.
template <typename T>
uint64_t number_at(string_view file, uint64_t at) {
  T number = 0;
  if (at > file.size() || file.size() - at < sizeof number) return 0;
  std::memcpy(&number, file.data() + at, sizeof number);
  return number;
}

/// The JSON of a GLB file, of glTF 1 or 2.
string_view json_of(string_view file) {
  constexpr size_t head_bytes = 20;  // of the file and of its first chunk
  if (!file.starts_with("glTF") || file.size() < head_bytes) return file;
  return file.substr(head_bytes, number_at<uint32_t>(file, 12));
}

Result<void> check_json(string_view json) {
  Depth depth;
  bool in_text = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text && c == '\\') ++i;
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    if (c == '[' || c == '{') depth.go_in();
    if (c == ']' || c == '}') depth.go_out();
  }
  TRY(depth.check("brackets"));
  return check_gltf_nodes(json);
}

/// Where the text after `end` begins, searched from `at`.
size_t after(string_view xml, string_view end, size_t at) {
  const size_t found = xml.find(end, at);
  return found == string_view::npos ? xml.size() : found + end.size();
}

/// The place of a tag's '>', beyond its quoted values.
size_t end_of_tag(string_view xml, size_t at) {
  for (; at < xml.size() && xml[at] != '>'; ++at)
    if (xml[at] == '"' || xml[at] == '\'') at = after(xml, xml.substr(at, 1), at + 1) - 1;
  return at;
}

Result<void> check_xml(string_view xml) {
  if (xml.find('\0') != string_view::npos) return fail("its letters are not UTF-8: write it as UTF-8");
  Depth depth;
  for (size_t at = xml.find('<'); at < xml.size(); at = xml.find('<', at)) {
    const string_view tag = xml.substr(at);
    if (tag.starts_with("<!--")) {
      at = after(xml, "-->", at + 4);
    } else if (tag.starts_with("<![CDATA[")) {
      at = after(xml, "]]>", at);
    } else if (tag.starts_with("<?")) {
      at = after(xml, "?>", at);
    } else if (tag.starts_with("<!")) {
      return fail("it declares a document type, which Collada has none of: remove that line (<!DOCTYPE)");
    } else {
      const size_t end = end_of_tag(xml, at);
      const bool closes = tag.starts_with("</");
      if (closes) depth.go_out();
      if (!closes) depth.go_in();
      if (!closes && end < xml.size() && xml[end - 1] == '/') depth.go_out();
      at = end;
    }
  }
  return depth.check("elements");
}

Result<void> check_fbx_text(string_view text) {
  Depth depth;
  for (size_t at = 0; at < text.size(); ++at) {
    if (text[at] == ';') at = after(text, "\n", at) - 1;
    if (text[at] == '"') at = after(text, "\"", at + 1) - 1;
    if (text[at] == '{') depth.go_in();
    if (text[at] == '}') depth.go_out();
  }
  return depth.check("braces");
}

/// Records begin with the place of their end, and the bytes of their values; what lies between is nested.
Result<void> check_fbx_records(string_view file) {
  constexpr size_t version_at = 23, records_at = 27;
  constexpr uint64_t wide_version = 7500;
  const bool wide = number_at<uint32_t>(file, version_at) >= wide_version;
  const uint64_t word = wide ? 8 : 4, head = 3 * word + 1;
  const auto read = [&](uint64_t at) {
    return wide ? number_at<uint64_t>(file, at) : number_at<uint32_t>(file, at);
  };
  Depth depth;
  std::vector<uint64_t> ends;
  for (uint64_t at = records_at; at + head <= file.size();) {
    const uint64_t end = read(at), values = read(at + 2 * word);
    const uint64_t name = number_at<uint8_t>(file, at + 3 * word);
    const bool is_none = end == 0;
    if (!is_none && (end <= at || end > file.size() || values > end - at)) break;  // assimp refuses it
    at += head + (is_none ? 0 : name + values);
    if (!is_none) {
      ends.push_back(end);
      depth.go_in();
    }
    while (!ends.empty() && at + head > ends.back()) {
      at = ends.back();
      ends.pop_back();
      depth.go_out();
    }
  }
  return depth.check("records");
}

}  // namespace

bool is_nested_form(const std::string& ending) {
  return ending == ".gltf" || ending == ".glb" || ending == ".dae" || ending == ".fbx";
}

Result<void> check_nesting(const std::string& file, const std::string& ending) {
  if (ending == ".gltf" || ending == ".glb") return check_json(json_of(file));
  if (ending == ".dae") return check_xml(file);
  if (ending == ".fbx")
    return file.starts_with("Kaydara FBX Binary") ? check_fbx_records(file) : check_fbx_text(file);
  return {};
}

}  // namespace scree
