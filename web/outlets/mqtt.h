// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "web/hub.h"
#include "web/outlets/mqtt_connection.h"
#include "web/outlets/outlet_options.h"
#include "web/outlets/pacer.h"

namespace navcal::web {

/// Publishes the records to a broker (docs/wires.md): events at once, of states the newest, at a limited rate and
/// retained.
class Mqtt final : public Subscriber {
 public:
  /// Throws std::runtime_error, which says what to do.
  Mqtt(const boost::asio::any_io_executor& executor, const MqttOptions& options, Hub& hub);
  ~Mqtt() override { stop(); }
  Mqtt(const Mqtt&) = delete;
  Mqtt& operator=(const Mqtt&) = delete;

  void stop();
  [[nodiscard]] const MqttCounters& counters() const { return connection_->counters(); }

  void on_record(const Record& record) override;
  void on_link(const Link& link) override;

 private:
  struct State {
    Pacer pacer;
    std::string waiting;  ///< the newest, while its time has not come; empty otherwise
  };
  void greet();
  void send_due();
  void tell_link(bool is_up);

  MqttOptions options_;
  Hub& hub_;
  std::shared_ptr<MqttConnection> connection_;
  std::map<std::string, State, std::less<>> states_;  ///< by topic
  Pacer::Clock::duration interval_;
};

/// User in the first line, password in the second. Throws std::runtime_error, with the file's name, when it cannot
/// be read, or when everybody may read it.
[[nodiscard]] MqttLogin read_mqtt_login(const std::filesystem::path& file);

}  // namespace navcal::web
