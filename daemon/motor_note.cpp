// SPDX-License-Identifier: Apache-2.0
#include "daemon/motor_note.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <cstdlib>
#include <string>

#include "config/load.h"
#include "daemon/motor_control.h"
#include "record/log/checked_file.h"

namespace navcal::daemon {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

/// $STATE_DIRECTORY (systemd.exec(5)) may list several; $XDG_STATE_HOME is of the base directory specification.
std::filesystem::path state_folder() {
  if (const std::string service = environment("STATE_DIRECTORY"); !service.empty())
    return service.substr(0, service.find(':'));
  if (::geteuid() == 0) return "/var/lib/navcal";
  if (const std::string user = environment("XDG_STATE_HOME"); !user.empty())
    return std::filesystem::path(user) / "navcal";
  const std::string home = environment("HOME");
  return home.empty() ? std::filesystem::path() : std::filesystem::path(home) / ".local/state/navcal";
}

config::Settings with_nothing_but_the_card(config::Settings settings, std::uint16_t port) {
  settings.ports = {settings.ports[port]};
  settings.log.enabled = settings.calibration.enabled = settings.navigation.enabled = settings.battery.enabled =
      false;
  return settings;
}

/// The card's port, and the orders to it, without the rest of the daemon.
class Card : private pipeline::Sink, private PortOwner, private MotorOwner {
 public:
  Card(const boost::asio::any_io_executor& executor, const config::Settings& settings,
       const std::filesystem::path& note)
      : pipeline_(settings), log_(settings, ports::monotonic_ns(), {}),
        session_(executor, 0, settings.ports[0], port_owner()),
        motor_(executor, settings, note, session_, log_, pipeline_, motor_owner()) {
    session_.start();
  }
  [[nodiscard]] bool is_safe() const { return motor_.is_safe(); }
  void stop() {
    motor_.stop();
    session_.stop();
  }

 private:
  PortOwner& port_owner() { return *this; }
  MotorOwner& motor_owner() { return *this; }
  void on_sample(const instruments::Sample& sample) override {
    if (const auto* motor = std::get_if<instruments::MotorSample>(&sample.value))
      motor_.status(sample.stamp, *motor);
  }
  void on_port_bytes(std::uint16_t port, std::int64_t arrival_ns, protocols::Bytes bytes) override {
    pipeline_.bytes(port, arrival_ns, bytes, *this);
  }
  void on_port_sent(std::uint16_t, std::int64_t, protocols::Bytes) override {}
  void on_port_event(std::uint16_t, std::int64_t, std::string_view, std::string_view name,
                     std::string_view message) override {
    spdlog::info("{}: {}", name, message);
  }
  void on_port_changed(std::uint16_t) override { motor_.port_changed(ports::monotonic_ns()); }
  [[nodiscard]] std::optional<instruments::ReceiverAid> receiver_aid(std::int64_t) const override { return {}; }
  void on_compass_calibrated(std::uint16_t, std::int64_t, const instruments::CompassCalibration&) override {}
  void on_motor_event(std::int64_t, std::string_view, std::string_view name, std::string_view message) override {
    spdlog::warn("{}: {}", name, message);
  }
  void on_motor_deaf(std::int64_t, bool) override {}
  void on_motor_unnoted(std::int64_t, bool) override {}

  pipeline::Pipeline pipeline_;
  LogWriter log_;
  PortSession session_;
  MotorControl motor_;
};

}  // namespace

std::filesystem::path second_note(const std::filesystem::path& config) {
  const std::filesystem::path folder = state_folder();
  if (folder.empty()) return {};
  std::error_code ignored;
  std::string name =
      std::filesystem::weakly_canonical(std::filesystem::absolute(config, ignored), ignored).string();
  std::replace(name.begin(), name.end(), '/', '-');
  return folder / (name.substr(name.find_first_not_of('-')) + "." + std::string(kMotorNote));
}

bool order_safe_state_of(const std::filesystem::path& note, std::chrono::seconds limit) {
  const auto kept = record::read_checked(note);
  if (kept.state == record::CheckedContent::State::absent) return true;
  try {
    auto settings = config::parse(kept.content, note.string());
    const auto port = motor_port(settings);
    if (!port) return true;
    boost::asio::io_context context;
    Card card(context.get_executor(), with_nothing_but_the_card(std::move(settings), *port), note);
    const auto until = std::chrono::steady_clock::now() + limit;
    while (!card.is_safe() && std::chrono::steady_clock::now() < until)
      context.run_one_for(std::chrono::milliseconds(50));
    card.stop();
    return card.is_safe();
  } catch (const std::exception& error) {
    spdlog::error("{}: {}", note.string(), error.what());
    return false;
  }
}

}  // namespace navcal::daemon
