// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <termios.h>

#include <optional>

namespace navcal::ports {

/// The constant of termios for a speed in baud; nullopt for one that has none.
[[nodiscard]] std::optional<speed_t> speed_constant(int baud);
/// The inverse; 0 for a constant that is no speed.
[[nodiscard]] int baud_of(speed_t speed);

/// Raw 8N1, no flow control of any kind, modem lines ignored, reads that answer EAGAIN rather than 0 when nothing
/// is there. The speed is left alone.
void make_raw(termios& settings);

/// Applies make_raw() and the speed (where termios has a constant for it) at once; input already received is kept.
/// False with errno set when the device refuses.
[[nodiscard]] bool set_raw(int fd, int baud);

}  // namespace navcal::ports
