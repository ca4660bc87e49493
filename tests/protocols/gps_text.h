// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tests/protocols/stream.h"
#include "tests/protocols/text.h"

// Helpers shared by the tests of the receivers' protocols.
namespace navcal::protocols::test {

/// "Ea Bo Ea " for three frames.
inline std::string ids(const Outcome& outcome) {
  std::string text;
  for (const Seen& frame : outcome.frames) text += std::string(frame.id.view()) + ' ';
  return text;
}

inline Buffer joined(std::initializer_list<Buffer> parts) {
  Buffer all;
  for (const Buffer& part : parts) append(all, part);
  return all;
}

inline Buffer buffer_of(std::string_view text) { return {text.begin(), text.end()}; }

}  // namespace navcal::protocols::test
