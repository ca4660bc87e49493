// SPDX-License-Identifier: Apache-2.0
// Any bytes as a configuration file: an Error or settings, and settings come back from to_toml() unchanged.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "config/load.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::toml_target {

NAVCAL_FUZZ(toml) {
  using namespace navcal::config;
  // The first byte says how much of the input is a --set.
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t override_size = input.empty() ? 0 : std::min<std::size_t>(data[0] % 64, input.size() - 1);
  Overrides overrides;
  if (override_size > 0) overrides.emplace_back(input.substr(1, override_size));
  try {
    const auto toml = input.empty() ? input : input.substr(1 + override_size);
    const Settings settings = parse(toml, "fuzz.toml", overrides);
    if (!(parse(to_toml(settings), "again.toml") == settings)) std::abort();
  } catch (const Error& error) {
    if (error.problems().empty()) std::abort();
  }
  return 0;
}

}  // namespace navcal::fuzz::toml_target
