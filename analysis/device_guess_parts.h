// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocols/described/description.h"

// Parts of guess_description().
namespace navcal::analysis {

/// How binary frames follow each other.
struct Framing {
  std::string sync;
  protocols::described::Length length;
  std::vector<protocols::Bytes> frames;  ///< those that were found, in the order of the capture
  double coverage = 0;                   ///< share of the capture's bytes that lie in them
};

/// Framings that fit, the likeliest first.
[[nodiscard]] std::vector<Framing> find_framings(protocols::Bytes capture);

/// The checksum that (nearly) all frames have; nullopt: none of those with a name, at none of the usual places.
[[nodiscard]] std::optional<protocols::described::Checksum> find_checksum(const Framing& framing);

/// The lines `{ name = ..., at = ..., type = ... },  # what was seen` of the bytes between sync and checksum.
[[nodiscard]] std::string field_lines(const Framing& framing,
                                      const std::optional<protocols::described::Checksum>& checksum);

/// The [[frame]] tables of a text. Empty: no kind of line comes back.
[[nodiscard]] std::string text_frames(protocols::Bytes capture, char& separator);

}  // namespace navcal::analysis
