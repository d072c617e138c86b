// How much memory the machine, or the container in which this process runs, has for it.
#pragma once

#include <string>

namespace scree {

/// Bytes: the least of the machine's RAM and of the limits of this process's groups (cgroups of both
/// versions). `root`: where /proc and /sys lie, for tests. 0: the system does not say.
double memory_limit_bytes(const std::string& root = "");

}  // namespace scree
