// A network of this process' own, with addresses that are not loopback: nothing outside it is reached or
// disturbed.
#pragma once

#include <arpa/inet.h>
#include <cstring>
#include <fstream>
#include <net/if.h>
#include <netinet/in.h>
#include <sched.h>
#include <string>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

namespace scree {

/// Moves this process into a network that has loopback and these IPv4 addresses. Before there are threads.
/// False: the system does not allow it.
inline bool enter_own_network(const std::vector<std::string>& addresses) {
  const uid_t user = ::getuid();
  const gid_t group = ::getgid();
  if (::unshare(user == 0 ? CLONE_NEWNET : CLONE_NEWUSER | CLONE_NEWNET) != 0) return false;
  if (user != 0) {
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
    std::ofstream("/proc/self/gid_map") << "0 " << group << " 1";
  }
  const int control = ::socket(AF_INET, SOCK_DGRAM, 0);
  bool done = true;
  for (size_t i = 0; i <= addresses.size(); ++i) {
    ifreq wish{};
    const std::string name = i == 0 ? "lo" : "lo:" + std::to_string(i);
    std::strncpy(wish.ifr_name, name.c_str(), IFNAMSIZ - 1);
    auto& address = reinterpret_cast<sockaddr_in&>(wish.ifr_addr);
    address.sin_family = AF_INET;
    ::inet_pton(AF_INET, i == 0 ? "127.0.0.1" : addresses[i - 1].c_str(), &address.sin_addr);
    done = done && ::ioctl(control, SIOCSIFADDR, &wish) == 0;
    wish.ifr_flags = IFF_UP | IFF_LOOPBACK | IFF_RUNNING;
    done = done && ::ioctl(control, SIOCSIFFLAGS, &wish) == 0;
  }
  ::close(control);
  return done;
}

}  // namespace scree
