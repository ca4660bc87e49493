// SPDX-License-Identifier: Apache-2.0
// Targets of requests: path and query values come from the target, and decoding never makes them longer.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tests/fuzz/target.h"
#include "web/access.h"
#include "web/http.h"

namespace navcal::fuzz::http_query_target {

NAVCAL_FUZZ(http_query) {
  using namespace navcal::web;
  const std::string target(reinterpret_cast<const char*>(data), size);
  const auto path = path_of(target);
  if (path.size() > target.size() || path.find_first_of("?#") != std::string_view::npos) std::abort();
  for (const char* name : {"a", "", "speed", "%61"}) {
    if (query_value(target, name).size() > target.size()) std::abort();
  }
  const Access access("0123456789abcdef", {"vehicle.example"});
  // As Host and as Authorization: it must not crash, and must not be let in but for the token.
  (void)access.knows_host(target);
  (void)Access().knows_origin(target, "localhost:8765");
  if (!access.refusal(target) && target.find("0123456789abcdef") == std::string::npos) std::abort();
  return 0;
}

}  // namespace navcal::fuzz::http_query_target
