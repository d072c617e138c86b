// Where the page of this server's build lies.
#pragma once

#include <cstdint>
#include <string>

namespace scree {

/// The folder of the page beside the running program: installed (../share/scree/web), or in the build tree
/// (../../web/dist), where it was built. Empty: in neither is an index.html.
std::string web_folder_beside_program();

/// The page's address for a person on this machine, by --bind and the port.
std::string page_url(const std::string& bind, uint16_t port, bool tls);

}  // namespace scree
