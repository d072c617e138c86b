// What a page shows of its client, as texts, most of them JSON; bridge.h says their fields.
#pragma once

#include <string>

#include "client/web/page_client.h"

namespace scree {

std::string catalogue_text();
std::string state_text(PageClient& client);
std::string names_text(PageClient& client);
std::string signs_text(PageClient& client);
std::string marks_text(PageClient& client);
std::string actions_text(const std::vector<Action>& actions);

}  // namespace scree
