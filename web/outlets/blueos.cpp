// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/blueos.h"

#include <nlohmann/json.hpp>

namespace navcal::web {

std::string blueos_service(std::string_view version) {
  nlohmann::ordered_json service{{"name", "navcal"},
                                 {"description", "Navigation and calibration of the vehicle's instruments"},
                                 {"icon", "mdi-compass-outline"},
                                 {"company", "navcal"}};
  service["version"] = version;
  service["webpage"] = "/";
  service["api"] = "/signalk";
  service["works_in_relative_paths"] = true;
  return service.dump();
}

Handler blueos_handler(std::string_view version) {
  return [answer = blueos_service(version)](const Request&) -> boost::asio::awaitable<Response> {
    co_return respond_json(boost::beast::http::status::ok, answer);
  };
}

}  // namespace navcal::web
