// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "web/hub.h"
#include "web/outlets/outlet_options.h"

namespace navcal::web {

struct MqttCounters {
  bool connected = false;
  std::uint64_t published = 0;  ///< that the broker has, or that were written to its connection
  std::uint64_t dropped = 0;    ///< because there was no broker, or because it was too slow
};

/// Publishes the records to a broker (docs/wires.md): events at once, of states the newest, at a limited rate and
/// retained. Says good-bye when it is destroyed. Throws std::runtime_error, which says what to do.
[[nodiscard]] std::unique_ptr<Subscriber> make_mqtt(const boost::asio::any_io_executor& executor,
                                                    const MqttOptions& options, Hub& hub, MqttCounters& counters);

struct MqttLogin {
  std::string user, password;
};
/// User in the first line, password in the second. Throws std::runtime_error, with the file's name, when it cannot
/// be read, or when everybody may read it.
[[nodiscard]] MqttLogin read_mqtt_login(const std::filesystem::path& file);

}  // namespace navcal::web
