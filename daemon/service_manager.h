// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string_view>

namespace navcal::daemon {

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

/// After how long without WATCHDOG=1 this process is taken for hung ($WATCHDOG_USEC, $WATCHDOG_PID); zero: never.
[[nodiscard]] std::chrono::microseconds watchdog_limit();

/// How many descriptors were handed over to this process ($LISTEN_FDS, $LISTEN_PID), from kFirstHandedOver on.
/// They are closed on exec from here on, and the variables are gone: no child takes them for its own.
[[nodiscard]] int take_handed_over();

/// Whether it is a stream socket of this family (AF_INET ...) that listens.
[[nodiscard]] bool is_listening(int descriptor, int family);

}  // namespace navcal::daemon
