// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocols/frame.h"

namespace navcal::analysis {

/// Begins the description of an unknown device from a capture of its bytes (docs/devices.md): framing, checksum
/// and the numbers that it can see, with what was seen as comments. Meanings and units are for the user to fill
/// in.
///
/// Binary: the pair of bytes that comes back at one distance, or at distances that a number behind it states; then
/// every checksum that has a name, at every place near the end. Text: lines that begin alike.
/// `seconds`: duration of the capture, where it is known. Throws Failure when nothing comes back.
[[nodiscard]] std::string guess_description(protocols::Bytes capture, std::optional<double> seconds);

}  // namespace navcal::analysis
