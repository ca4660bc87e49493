// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "instruments/instrument.h"
#include "protocols/stream_parser.h"

namespace navcal::instruments {

/// Runs bytes through a parser and an instrument and keeps what comes out.
class Collector : public Receiver {
 public:
  explicit Collector(Instrument& instrument) : instrument_(instrument) {}
  /// Collects from the instrument that the daemon makes for a port.
  explicit Collector(const config::PortSettings& settings) : own_(make_instrument(settings)), instrument_(*own_) {}
  explicit Collector(protocols::Protocol protocol) : Collector(port_with(protocol)) {}

  template <class Parser>
  void feed(protocols::Bytes bytes) {
    Parser parser;
    parser.feed(bytes,
                [this](const protocols::Frame& frame) { verdicts.push_back(instrument_.read(frame, *this)); });
  }
  template <class Parser>
  void feed(std::string_view text) {
    feed<Parser>(protocols::Bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  }
  void on_measurement(const Measurement& measurement) override { measurements.push_back(measurement); }

  template <class T>
  [[nodiscard]] std::vector<T> all() const {
    std::vector<T> found;
    for (const auto& measurement : measurements) {
      if (const auto* value = std::get_if<T>(&measurement.value)) found.push_back(*value);
    }
    return found;
  }

  std::vector<Measurement> measurements;
  std::vector<Instrument::Verdict> verdicts;

 private:
  static config::PortSettings port_with(protocols::Protocol protocol) {
    config::PortSettings settings;
    settings.protocol = protocol;
    return settings;
  }

  std::unique_ptr<Instrument> own_;
  Instrument& instrument_;
};

/// `$body*hh` CR LF.
inline std::string nmea(std::string_view body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  constexpr std::string_view kHex = "0123456789ABCDEF";
  return "$" + std::string(body) + "*" + kHex[sum >> 4] + kHex[sum & 15] + "\r\n";
}

}  // namespace navcal::instruments
