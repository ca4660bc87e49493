// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <variant>

#include "base/descriptor.h"
#include "config/network_address.h"
#include "ports/line.h"

namespace navcal::ports {

// Lines through the network. Nothing here waits: the caller waits until a socket is ready. A text in place of what
// was asked for is the reason why not, for people.

/// One read of a datagram takes all of it: the rest would be lost (udp(7)).
inline constexpr std::size_t kLargestDatagram_bytes = 65'536;

/// A socket that is about to be connected. It becomes writable when that is decided; then finish_connect().
[[nodiscard]] std::variant<base::Descriptor, std::string> begin_connect(const config::NetworkAddress& address);
[[nodiscard]] std::variant<std::unique_ptr<Line>, std::string> finish_connect(
    const config::NetworkAddress& address, base::Descriptor socket);

/// A socket that becomes readable when a device connects to it.
[[nodiscard]] std::variant<base::Descriptor, std::string> listen_at(const config::NetworkAddress& address);
/// The device that has connected; null when there is none any more.
[[nodiscard]] std::unique_ptr<Line> accept_at(int listening);

/// Takes the datagrams of all senders, in the order in which they arrive; writes to the sender of the last one.
[[nodiscard]] std::variant<std::unique_ptr<Line>, std::string> bind_datagrams(
    const config::NetworkAddress& address);

}  // namespace navcal::ports
