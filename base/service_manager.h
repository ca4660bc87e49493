// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string_view>

namespace navcal::base {

/// The protocols between systemd and its services, as sd_notify(3), sd_watchdog_enabled(3) and sd_listen_fds(3)
/// describe them. By hand and not by libsystemd, with which come five libraries more and a megabyte of memory, an
/// eighth of all that the daemon may have.

/// First of the descriptors that are handed over.
inline constexpr int kFirstHandedOver = 3;

enum class IfBusy : bool { drop, wait };

/// Sends one state ("READY=1") as a datagram to $NOTIFY_SOCKET. Without one, or when nobody listens, nothing
/// happens: a service does not depend on being heard. What a manager whose queue is full may miss is dropped then:
/// it must not hold up the loop.
void notify_manager(std::string_view state, IfBusy if_busy = IfBusy::drop);

/// Time without WATCHDOG=1 after which systemd takes this process for hung ($WATCHDOG_USEC, $WATCHDOG_PID);
/// zero: never.
[[nodiscard]] std::chrono::microseconds watchdog_limit();

/// Number of descriptors handed over to this process ($LISTEN_FDS, $LISTEN_PID), from kFirstHandedOver on. The
/// call marks them to be closed on exec and removes the variables, so that no child takes them for its own.
[[nodiscard]] int take_handed_over();

/// True for a listening stream socket of this family (AF_INET ...).
[[nodiscard]] bool is_listening(int descriptor, int family);

}  // namespace navcal::base
