#include "server/app/memory_limit.h"

#include <algorithm>
#include <fstream>
#include <string_view>

namespace scree {

namespace {

constexpr double bytes_per_kb = 1024.0;

/// The smaller of two, where 0 is none.
double least(double a, double b) {
  return a == 0.0 || b == 0.0 ? std::max(a, b) : std::min(a, b);
}

/// The number in a file; 0: there is none, as where a group has no limit ("max").
double number_in(const std::string& path) {
  std::ifstream file(path);
  double number = 0.0;
  return file >> number ? number : 0.0;
}

double machine_bytes(const std::string& root) {
  std::ifstream file(root + "/proc/meminfo");
  std::string name;
  double kb = 0.0;
  return file >> name >> kb && name == "MemTotal:" ? kb * bytes_per_kb : 0.0;
}

/// The limits of a group and of those that it is in. Within a container the path may be the host's: then the
/// files lie at the top.
double least_of_groups(const std::string& mount, std::string group, const char* file) {
  double limit = number_in(mount + "/" + file);
  while (group.size() > 1) {
    limit = least(limit, number_in(mount + group + "/" + file));
    group.resize(group.rfind('/') == std::string::npos ? 0 : group.rfind('/'));
  }
  return limit;
}

}  // namespace

double memory_limit_bytes(const std::string& root) {
  double limit = machine_bytes(root);
  std::ifstream groups(root + "/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // "0::/path", or of version 1 "4:memory:/path"
    const size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const std::string group = line.substr(second + 1);
    if (controllers == ",,")
      limit = least(limit, least_of_groups(root + "/sys/fs/cgroup", group, "memory.max"));
    else if (controllers.find(",memory,") != std::string::npos)
      limit = least(limit, least_of_groups(root + "/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
  }
  return limit;
}

}  // namespace scree
