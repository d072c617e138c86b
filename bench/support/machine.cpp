#include "bench/support/machine.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <sched.h>
#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

namespace scree {
namespace {

constexpr size_t slug_bytes_max = 64;

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown";
}

std::string compiler_name() {
#ifdef __clang__
  return "clang " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

std::string system_name() {
  utsname names{};
  if (::uname(&names) != 0) return "unknown";
  return std::string(names.sysname) + " " + names.release;
}

}  // namespace

Machine this_machine() {
  constexpr double bytes_per_gib = 1024.0 * 1024.0 * 1024.0;
  const double memory_bytes =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  return {.processor = processor_name(),
          .threads = usable_cores(),
          .memory_gib = memory_bytes / bytes_per_gib,
          .compiler = compiler_name(),
          .system = system_name()};
}

unsigned usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof(set), &set) != 0)
    return std::max(1U, std::thread::hardware_concurrency());
  return static_cast<unsigned>(CPU_COUNT(&set));
}

std::string slug_of(const Machine& machine) {
  // Marks, the clock's rate and words that every processor's name has say nothing.
  static const std::regex noise(R"(\((r|tm|c)\)|@.*|\b(cpu|processor)\b|\b\d+-core\b)", std::regex::icase);
  std::string slug;
  for (const char c : std::regex_replace(machine.processor, noise, " ")) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0)
      slug += static_cast<char>(std::tolower(byte));
    else if (!slug.empty() && slug.back() != '-')
      slug += '-';
  }
  if (slug.size() > slug_bytes_max) slug.resize(slug_bytes_max);
  while (slug.ends_with('-')) slug.pop_back();
  return (slug.empty() ? "unknown" : slug) + "-" + std::to_string(machine.threads);
}

}  // namespace scree
