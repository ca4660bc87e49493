// SPDX-License-Identifier: Apache-2.0
// Whatever the answer of a task of the job evidence has in it: information that comes back to the same text, or
// std::invalid_argument.
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "fleet/causes/information_json.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::fleet_evidence_target {

NAVCAL_FUZZ(fleet_evidence) {
  const auto json = nlohmann::ordered_json::parse(data, data + size, nullptr, false);
  if (!json.is_object()) return 0;
  try {
    const auto information = navcal::fleet::information_from(json);
    const auto text = navcal::fleet::information_json(information);
    if (navcal::fleet::information_json(navcal::fleet::information_from(text)) != text) std::abort();
  } catch (const std::invalid_argument&) {
  }
  return 0;
}

}  // namespace navcal::fuzz::fleet_evidence_target
