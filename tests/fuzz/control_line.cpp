// SPDX-License-Identifier: Apache-2.0
// Whatever comes in over the control socket is a request or is refused with one line of valid JSON.
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "daemon/control_request.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace navcal::daemon;
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  const auto parsed = parse_control(line);
  if (const auto* error = std::get_if<std::string>(&parsed)) {
    const std::string answer = control_error(*error);
    if (answer.find('\n') != answer.size() - 1 || !nlohmann::json::accept(answer)) std::abort();
  }
  // Bytes from the client must never break a line either.
  const std::string echoed = control_error(line);
  if (echoed.find('\n') != echoed.size() - 1 || !nlohmann::json::accept(echoed)) std::abort();
  return 0;
}
