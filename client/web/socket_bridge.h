// The socket of the page, whose functions bridge.h tells; tests under Node bring bytes by the same.
#pragma once

#include "client/web/socket_connector.h"

namespace scree {

PageSocket& page_socket();

}  // namespace scree
