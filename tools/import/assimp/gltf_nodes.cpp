#include "tools/import/assimp/gltf_nodes.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/import/limits.h"

namespace scree {

namespace {

using Json = nlohmann::json;

/// Children by node. Nodes are a list in glTF 2, and have names in glTF 1.
std::vector<std::vector<size_t>> children_of(const Json& nodes) {
  std::map<std::string, size_t> numbers;
  if (nodes.is_object())
    for (const auto& [name, node] : nodes.items()) numbers.emplace(name, numbers.size());
  std::vector<std::vector<size_t>> children(nodes.size());
  size_t at = 0;
  for (const Json& node : nodes) {
    std::vector<size_t>& own = children[at++];
    const auto found = node.is_object() ? node.find("children") : node.end();
    if (!node.is_object() || found == node.end() || !found->is_array()) continue;
    for (const Json& child : *found) {
      if (child.is_number_unsigned() && child.get<size_t>() < nodes.size())
        own.push_back(child.get<size_t>());
      if (!child.is_string()) continue;
      if (const auto number = numbers.find(child.get<std::string>()); number != numbers.end())
        own.push_back(number->second);
    }
  }
  return children;
}

/// From the nodes without parents on, each after all of its parents (Kahn 1962).
Result<void> check_tree(const std::vector<std::vector<size_t>>& children) {
  std::vector<size_t> parents(children.size(), 0), depth(children.size(), 1), ready;
  std::vector<uint64_t> copies(children.size(), 0);
  for (const auto& own : children)
    for (const size_t child : own) ++parents[child];
  for (size_t node = 0; node < children.size(); ++node)
    if (parents[node] == 0) {
      ready.push_back(node);
      copies[node] = 1;
    }
  uint64_t all = 0;
  for (size_t i = 0; i < ready.size(); ++i) {
    const size_t node = ready[i];
    all += copies[node];
    if (all > limits::scene_nodes_max)
      return fail(
          fmt::format("its nodes are children of several others and come to more than {} "
                      "(limits.scene_nodes_max)",
                      limits::scene_nodes_max));
    if (depth[node] > limits::scene_nesting_max)
      return fail(fmt::format("its nodes are nested more than {} deep (limits.scene_nesting_max)",
                              limits::scene_nesting_max));
    for (const size_t child : children[node]) {
      depth[child] = std::max(depth[child], depth[node] + 1);
      copies[child] = std::min(copies[child] + copies[node], limits::scene_nodes_max + 1);
      if (--parents[child] == 0) ready.push_back(child);
    }
  }
  if (ready.size() < children.size()) return fail("its nodes are children of each other, in a circle");
  return {};
}

}  // namespace

Result<void> check_gltf_nodes(std::string_view json) {
  json = json.substr(0, json.find_last_not_of(std::string_view("\0 \t\r\n", 5)) + 1);
  const Json scene = Json::parse(json, nullptr, false);
  if (scene.is_discarded()) return fail("its JSON is damaged");
  if (!scene.is_object() || !scene.contains("nodes")) return {};
  const Json& nodes = scene["nodes"];
  return nodes.is_structured() ? check_tree(children_of(nodes)) : Result<void>{};
}

}  // namespace scree
