// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "ports/line.h"

namespace navcal::ports {

/// Most programs that are connected to one socket at a time; a further one waits until another one leaves.
inline constexpr std::size_t kMostSenders = 32;

/// A Unix stream socket at `path` to which several programs may be connected at once. Each sends lines; the line
/// hands over whole lines only, in the order in which they were completed, so that the lines of one program do not
/// tear those of another. What is longer than the longest line of the protocol `samples`, or ends with its
/// connection, is handed over as it is. Nothing is ever sent to the programs.
///
/// A socket of that name to which nobody listens any more is removed first; its file may be used by owner and
/// group. A text in place of the line is the reason why there is none, for people.
[[nodiscard]] std::variant<std::unique_ptr<Line>, std::string> open_sample_socket(const std::string& path);

}  // namespace navcal::ports
