// SPDX-License-Identifier: Apache-2.0
#include "ports/tty.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <libserialport.h>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "ports/holder.h"
#include "ports/raw_mode.h"
#include "ports/sysfs.h"

namespace navcal::ports {
namespace {

std::string ask_driver(int fd, std::optional<int>& former_flags) {
  serial_struct serial{};
  if (::ioctl(fd, TIOCGSERIAL, &serial) != 0) return "the driver has no low latency mode";
  const int former = serial.flags;
  if ((static_cast<unsigned>(former) & ASYNC_LOW_LATENCY) != 0)
    return "the driver was in low latency mode already";
  serial.flags |= ASYNC_LOW_LATENCY;
  if (::ioctl(fd, TIOCSSERIAL, &serial) != 0) return fmt::format("the driver refused: {}", std::strerror(errno));
  former_flags = former;
  serial_struct now{};
  if (::ioctl(fd, TIOCGSERIAL, &now) == 0 && (static_cast<unsigned>(now.flags) & ASYNC_LOW_LATENCY) != 0)
    return "low latency mode is on";
  return "asked for, but the driver does not confirm it";
}

/// Asks the driver (ASYNC_LOW_LATENCY) and, for FTDI adapters, the 16 ms timer in sysfs to hand over bytes at
/// once. Reports only what it reads back.
LowLatency ask_low_latency(int fd, const SysfsTty& sysfs) {
  LowLatency result;
  result.report = ask_driver(fd, result.former_flags);
  if (const auto before = sysfs.latency_timer_ms()) {
    constexpr int kLeast_ms = 1;
    const bool allowed = *before <= kLeast_ms || sysfs.set_latency_timer_ms(kLeast_ms);
    result.report += fmt::format("; latency timer {} ms{}", sysfs.latency_timer_ms().value_or(*before),
                                 allowed ? "" : " (no permission to set it: see the udev rule)");
  }
  return result;
}

void restore_latency(int fd, const LowLatency& asked) {
  if (!asked.former_flags) return;
  serial_struct serial{};
  if (::ioctl(fd, TIOCGSERIAL, &serial) != 0) return;
  serial.flags = *asked.former_flags;
  ::ioctl(fd, TIOCSSERIAL, &serial);
}

/// Slaves of Unix98 pseudo-terminals have these major numbers (Linux, Documentation/admin-guide/devices.txt).
bool is_pseudo_terminal(int fd) {
  constexpr unsigned kFirstMajor = 136;
  constexpr unsigned kLastMajor = 143;
  struct stat status {};
  if (::fstat(fd, &status) != 0 || !S_ISCHR(status.st_mode)) return false;
  return major(status.st_rdev) >= kFirstMajor && major(status.st_rdev) <= kLastMajor;
}

std::string refusal(const std::string& path, int error) {
  if (error == EBUSY) return fmt::format("{}: in use by {}", path, holders_of(path));
  if (error == EACCES) return fmt::format("{}: permission denied (ports belong to the group dialout)", path);
  if (error == ENOENT) return fmt::format("{}: no such device", path);
  return fmt::format("{}: {}", path, std::strerror(error));
}

std::string set_up(sp_port* port, int baud) {
  const bool done = sp_set_baudrate(port, baud) == SP_OK && sp_set_bits(port, 8) == SP_OK &&
                    sp_set_parity(port, SP_PARITY_NONE) == SP_OK && sp_set_stopbits(port, 1) == SP_OK &&
                    sp_set_flowcontrol(port, SP_FLOWCONTROL_NONE) == SP_OK;
  if (done) return {};
  const std::unique_ptr<char, decltype(&sp_free_error_message)> why(sp_last_error_message(),
                                                                    &sp_free_error_message);
  return fmt::format("{}: cannot be set to {} baud 8N1: {}", sp_get_port_name(port), baud, why.get());
}

/// libserialport leaves VMIN at 0, with which an empty queue reads as 0 bytes like a lost device.
bool read_when_there_is_something(int fd) {
  termios settings{};
  if (tcgetattr(fd, &settings) != 0) return false;
  make_raw(settings);
  return tcsetattr(fd, TCSANOW, &settings) == 0;
}

}  // namespace

void Tty::CloseSerial::operator()(sp_port* port) const {
  sp_close(port);
  sp_free_port(port);
}

std::variant<std::unique_ptr<Line>, std::string> Tty::open(const Found& found, int baud, bool low_latency) {
  std::unique_ptr<Tty> opened(new Tty(baud));
  Tty& tty = *opened;
  tty.info_.path = found.path;
  tty.info_.description = found.description;
  tty.device_ = base::Descriptor(::open(found.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!tty.device_) return refusal(found.path, errno);
  if (tcgetattr(tty.device_.get(), &tty.former_) != 0) return fmt::format("{}: is no serial port", found.path);
  if (!lock_device(tty.device_.get())) return refusal(found.path, EBUSY);
  tty.info_.pseudo_terminal = is_pseudo_terminal(tty.device_.get());
  std::string why = tty.info_.pseudo_terminal ? tty.open_pseudo_terminal() : tty.open_serial(low_latency);
  if (!why.empty()) return why;
  return opened;
}

std::string Tty::open_pseudo_terminal() {
  // No TIOCEXCL here: on a pseudo-terminal it outlives a killed owner and would lock out the next one for good.
  if (!set_raw(device_.get(), baud_)) return refusal(info_.path, errno);
  fd_ = device_.get();
  info_.low_latency = "not applicable on a pseudo-terminal";
  return {};
}

std::string Tty::open_serial(bool low_latency) {
  sp_port* port = nullptr;
  if (sp_get_port_by_name(info_.path.c_str(), &port) != SP_OK) return info_.path + ": is no serial port";
  if (sp_open(port, SP_MODE_READ_WRITE) != SP_OK) {
    const int error = sp_last_error_code();
    sp_free_port(port);
    return refusal(info_.path, error);
  }
  serial_.reset(port);
  sp_get_port_handle(port, &fd_);
  if (std::string why = set_up(port, baud_); !why.empty()) return why;
  if (!read_when_there_is_something(fd_)) return refusal(info_.path, errno);
  // TIOCEXCL keeps out programs that do not use our lock.
  if (::ioctl(fd_, TIOCEXCL) != 0) return refusal(info_.path, errno);
  latency_.report = "not asked for";
  if (low_latency) latency_ = ask_low_latency(fd_, SysfsTty(info_.path));
  info_.low_latency = latency_.report;
  return {};
}

ssize_t Tty::read(std::span<std::uint8_t> buffer) { return ::read(fd_, buffer.data(), buffer.size()); }

ssize_t Tty::write(protocols::Bytes bytes) { return ::write(fd_, bytes.data(), bytes.size()); }

std::string Tty::ended() const {
  termios settings{};
  return tcgetattr(fd_, &settings) == 0 ? std::string() : info_.path + ": the device is gone";
}

void Tty::flush(std::chrono::milliseconds limit) const {
  const auto end = std::chrono::steady_clock::now() + limit;
  int waiting = 0;
  while (::ioctl(fd_, TIOCOUTQ, &waiting) == 0 && waiting > 0 && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  // The driver has handed over all; the UART's own FIFO holds sixteen bytes of ten bits.
  if (!info_.pseudo_terminal) std::this_thread::sleep_for(std::chrono::microseconds(160'000'000 / baud_));
}

Tty::~Tty() {
  if (!device_ || fd_ < 0) return;
  restore_latency(fd_, latency_);
  if (serial_) ::ioctl(fd_, TIOCNXCL);
  // This fails on a device that is gone, and nothing is lost by it.
  tcsetattr(fd_, TCSANOW, &former_);
}

}  // namespace navcal::ports
