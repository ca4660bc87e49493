// SPDX-License-Identifier: Apache-2.0
#include "devices/instrument_model.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "base/reference_instruments.h"
#include "config/load.h"

namespace navcal::devices {
namespace {

using config::Role;
using protocols::Protocol;

/// The port that serves a role, of one of these protocols, the first of which is preferred. nullptr: there is
/// none.
const config::PortSettings* port_of(const config::Settings& settings, Role role,
                                    std::initializer_list<Protocol> protocols) {
  const std::string& named = settings.roles.chosen_name(role);
  for (const Protocol protocol : protocols) {
    const auto serves = [&](const config::PortSettings& port) {
      return port.protocol == protocol && (named.empty() || port.name == named);
    };
    const auto found = std::ranges::find_if(settings.ports, serves);
    if (found != settings.ports.end()) return &*found;
  }
  return nullptr;
}

Timing timing_of(const config::PortSettings* port, const Timing& usual) {
  if (port == nullptr) return usual;
  Timing timing{port->latency_s, port->latency_std_s, port->rate_Hz > 0 ? port->rate_Hz : usual.rate_Hz,
                port->baud};
  if (port->protocol != Protocol::nmea) return timing;
  timing.baud = usual.baud;  // of another kind of frames
  if (timing.latency_s == 0) {
    timing.latency_s = usual.latency_s;
    timing.latency_std_s = usual.latency_std_s;
  }
  return timing;
}

}  // namespace

Timing usual_timing(Protocol protocol, int baud) {
  const config::PortSettings port = config::default_port("", protocol, baud);
  return {port.latency_s, port.latency_std_s, port.rate_Hz, port.baud};
}

double rounded_noise(double noise, double resolution) { return std::hypot(noise, resolution / std::sqrt(12.0)); }

double CompassModel::tilt_reading_noise_rad() const {
  return rounded_noise(tilt_noise_rad, tilt_resolution_deg * base::kRadiansPerDegree);
}

double CompassModel::heading_noise_rad() const {
  const auto& [north_uT, east_uT, down_uT] = base::reference::kField_uT;
  const double level_uT = std::hypot(north_uT, east_uT);
  return std::hypot(field_noise_uT / level_uT, tilt_noise_rad * down_uT / level_uT);
}

double GpsModel::excess_noise(int number) { return std::exp2(1 - number); }

double GpsModel::expired_probability(double unseen_s) const {
  return std::clamp(2 * unseen_s / ephemeris_life_s - 1, 0.0, 1.0);
}

double GpsModel::mean_search_s(double unseen_s) const {
  if (search_model == config::SearchModel::uniform) return (least_search_s + longest_search_s) / 2;
  return std::lerp(hot_start_s, warm_start_s, expired_probability(unseen_s));
}

double GpsModel::long_search_s(double unseen_s) const {
  if (search_model == config::SearchModel::uniform) return longest_search_s;
  return (1 + kSearchSpread) * (expired_probability(unseen_s) > 0 ? warm_start_s : hot_start_s);
}

double MotorModel::fin_report_noise_rad() const {
  // To a thousandth of a degree: noise is known no better.
  constexpr double kKnown_per_deg = 1000;
  const double noise_deg = rounded_noise(fin_noise_rad * base::kDegreesPerRadian, fin_resolution_deg);
  return std::round(noise_deg * kKnown_per_deg) / kKnown_per_deg * base::kRadiansPerDegree;
}

InstrumentModel without_noise(InstrumentModel model) {
  model.compass.field_noise_uT = model.compass.tilt_noise_rad = model.compass.temperature_noise_C = 0;
  model.imu.gyro_noise_rad_s = model.imu.turn_on_bias_rad_s = 0;
  model.imu.force_noise_m_s2 = model.imu.depth_noise_m = 0;
  model.gps.position_noise_m = model.gps.velocity_noise_m_s = 0;
  model.motor.fin_noise_rad = model.motor.current_noise_A = 0;
  return model;
}

InstrumentModel without_mounting(InstrumentModel model) {
  model.compass.mounting = model.imu.mounting = model.gps.mounting = {};
  return model;
}

InstrumentModel instrument_model(const config::Settings& settings) {
  InstrumentModel model;
  static_cast<config::CompassAccuracy&>(model.compass) = settings.instruments.compass;
  static_cast<config::ImuAccuracy&>(model.imu) = settings.instruments.imu;
  static_cast<config::GpsAccuracy&>(model.gps) = settings.instruments.gps;
  static_cast<config::MotorAccuracy&>(model.motor) = settings.instruments.motor;
  const config::PortSettings* const compass = port_of(settings, Role::field, {Protocol::tcm2});
  model.compass.timing = timing_of(compass, model.compass.timing);
  if (compass != nullptr) model.compass.mounting = compass->mounting;
  const config::PortSettings* const card = port_of(settings, Role::rates, {Protocol::imu_card});
  model.imu.timing = timing_of(card, model.imu.timing);
  if (card != nullptr) {
    model.imu.channels = card->imu_card;
    model.imu.mounting = card->mounting;
  }
  const config::PortSettings* const receiver =
      port_of(settings, Role::position, {Protocol::oncore, Protocol::nmea});
  model.gps.timing = timing_of(receiver, model.gps.timing);
  if (receiver != nullptr) model.gps.mounting = receiver->mounting;
  model.motor.timing = timing_of(port_of(settings, Role::shaft, {Protocol::motor_card}), model.motor.timing);
  return model;
}

}  // namespace navcal::devices
