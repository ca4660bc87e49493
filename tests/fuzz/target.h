// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace navcal::fuzz {

using TargetFunction = int(const std::uint8_t* data, std::size_t size);

/// A target of the program `fuzz`, by its name.
class Target {
 public:
  Target(const char* name, TargetFunction* run);
};

}  // namespace navcal::fuzz

/// Defines a target: NAVCAL_FUZZ(nmea) { ... data, size ... return 0; }
#define NAVCAL_FUZZ(name)                                              \
  static int run_##name(const std::uint8_t* data, std::size_t size);   \
  static const navcal::fuzz::Target kTarget_##name{#name, run_##name}; \
  static int run_##name(const std::uint8_t* data, std::size_t size)
