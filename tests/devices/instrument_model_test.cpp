// SPDX-License-Identifier: Apache-2.0
#include "devices/instrument_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <string>

#include "config/load.h"
#include "config/options.h"

namespace navcal::devices {
namespace {

using config::Settings;
using protocols::Protocol;

constexpr double kDegree = base::kRadiansPerDegree;

std::string bytes_of(const InstrumentModel& model) {
  std::string bytes(sizeof model, '\0');
  std::memcpy(bytes.data(), &model, sizeof model);
  return bytes;
}

config::PortSettings port(std::string name, Protocol protocol) {
  return config::default_port(std::move(name), protocol, config::default_baud(protocol));
}

TEST(InstrumentModel, StatesTheReferenceInstruments) {
  // docs/simulator.md, "Instruments".
  const InstrumentModel model;
  EXPECT_EQ(model.compass.field_noise_uT, 0.15);
  EXPECT_EQ(model.compass.tilt_noise_rad, 0.1 * kDegree);
  EXPECT_EQ(model.compass.tilt_lag_s, 0.3);
  EXPECT_EQ(model.compass.temperature_noise_C, 0.1);
  EXPECT_EQ(model.compass.timing.rate_Hz, 10);
  EXPECT_EQ(model.compass.timing.latency_s, 0.05);
  EXPECT_EQ(model.imu.gyro_noise_rad_s, 0.1 * kDegree);
  EXPECT_EQ(model.imu.turn_on_bias_rad_s, 0.3 * kDegree);
  EXPECT_EQ(model.imu.force_noise_m_s2, 0.02);
  EXPECT_EQ(model.imu.depth_noise_m, 0.02);
  EXPECT_EQ(model.imu.timing.rate_Hz, 20);
  EXPECT_EQ(model.imu.timing.latency_s, 0.025);
  EXPECT_EQ(model.gps.position_noise_m, 1);
  EXPECT_EQ(model.gps.velocity_noise_m_s, 0.1);
  EXPECT_EQ(model.gps.antenna_depth_m, 0.35);
  EXPECT_EQ(model.gps.least_search_s, 2);
  EXPECT_EQ(model.gps.longest_search_s, 10);
  EXPECT_EQ(model.gps.timing.rate_Hz, 1);
  EXPECT_EQ(model.gps.timing.latency_s, 0.3);
  EXPECT_EQ(model.motor.fin_noise_rad, 0.1 * kDegree);
  EXPECT_EQ(model.motor.current_noise_A, 0.02);
  EXPECT_EQ(model.motor.timing.rate_Hz, 10);
  EXPECT_EQ(model.motor.timing.latency_s, 0.005);
}

TEST(InstrumentModel, WithoutPortsAndChangesItIsTheDefault) {
  EXPECT_EQ(bytes_of(instrument_model({})), bytes_of({}));
}

TEST(InstrumentModel, EachOptionOfTheTableChangesItAndEachOtherwise) {
  std::set<std::string> models{bytes_of({})};
  std::size_t options = 0;
  for (const auto& option : config::daemon_options()) {
    if (option.table != "instruments") continue;
    Settings settings;
    const bool is_choice = option.kind == config::Kind::choice;
    option.set(settings,
               is_choice ? config::Value(std::string(option.choices.back())) : config::Value(option.high));
    EXPECT_TRUE(models.insert(bytes_of(instrument_model(settings))).second) << option.name();
    ++options;
  }
  EXPECT_GE(options, 15U);
}

TEST(InstrumentModel, TakesLatencyRateZerosAndScalesOfThePorts) {
  Settings settings;
  settings.ports = {port("a", Protocol::tcm2), port("b", Protocol::imu_card), port("c", Protocol::oncore),
                    port("d", Protocol::motor_card)};
  for (std::size_t i = 0; i < 4; ++i) {
    settings.ports[i].latency_s = 0.1 + static_cast<double>(i);
    settings.ports[i].latency_std_s = 0.2 + static_cast<double>(i);
    settings.ports[i].rate_Hz = 3 + static_cast<double>(i);
  }
  settings.ports[1].imu_card.scale[2] = -11;
  const InstrumentModel model = instrument_model(settings);
  const std::array<Timing, 4> timings{model.compass.timing, model.imu.timing, model.gps.timing,
                                      model.motor.timing};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(timings[i].latency_s, settings.ports[i].latency_s);
    EXPECT_EQ(timings[i].latency_std_s, settings.ports[i].latency_std_s);
    EXPECT_EQ(timings[i].rate_Hz, settings.ports[i].rate_Hz);
    EXPECT_EQ(timings[i].baud, settings.ports[i].baud);
  }
  EXPECT_EQ(model.imu.channels, settings.ports[1].imu_card);
}

TEST(InstrumentModel, TakesTheMountingOfThePortsAndIsRidOfItAgain) {
  Settings settings;
  settings.ports = {port("a", Protocol::tcm2), port("b", Protocol::imu_card), port("c", Protocol::oncore)};
  const InstrumentModel straight = instrument_model(settings);
  settings.ports[0].mounting.rotation_deg = {1, 2, 3};
  settings.ports[1].mounting.position_m = {4, 5, 6};
  settings.ports[2].mounting.position_m = {7, 8, 9};
  const InstrumentModel model = instrument_model(settings);
  EXPECT_EQ(model.compass.mounting, settings.ports[0].mounting);
  EXPECT_EQ(model.imu.mounting, settings.ports[1].mounting);
  EXPECT_EQ(model.gps.mounting, settings.ports[2].mounting);
  EXPECT_EQ(bytes_of(without_mounting(model)), bytes_of(straight));
}

TEST(InstrumentModel, TakesThePortThatServesTheRole) {
  Settings settings;
  settings.ports = {port("old", Protocol::imu_card), port("new", Protocol::imu_card)};
  settings.ports[1].latency_s = 0.07;
  EXPECT_EQ(instrument_model(settings).imu.timing.latency_s, 0.025);
  settings.roles.port_names.at(static_cast<std::size_t>(config::Role::rates)) = "new";
  EXPECT_EQ(instrument_model(settings).imu.timing.latency_s, 0.07);
}

TEST(InstrumentModel, AFieldOfNoNamedPortIsThatOfTheHeading) {
  Settings settings;
  settings.ports = {port("old", Protocol::tcm2), port("new", Protocol::tcm2)};
  settings.ports[1].rate_Hz = 5;
  settings.roles.port_names.at(static_cast<std::size_t>(config::Role::heading)) = "new";
  EXPECT_EQ(instrument_model(settings).compass.timing.rate_Hz, 5);
}

TEST(InstrumentModel, ADeviceWithoutLatencyHasNoneAndAnNmeaPortThatStatesNoneIsUsual) {
  Settings settings;
  settings.ports = {port("compass", Protocol::tcm2), port("gps", Protocol::nmea)};
  settings.ports[0].latency_s = settings.ports[0].rate_Hz = 0;
  const InstrumentModel model = instrument_model(settings);
  EXPECT_EQ(model.compass.timing.latency_s, 0);
  EXPECT_EQ(model.compass.timing.rate_Hz, 10);
  EXPECT_EQ(model.gps.timing.latency_s, 0.3);
  EXPECT_EQ(model.gps.timing.rate_Hz, 1);
  EXPECT_EQ(model.gps.timing.baud, 9600);
  settings.ports[1].latency_s = 0.12;
  EXPECT_EQ(instrument_model(settings).gps.timing.latency_s, 0.12);
}

TEST(InstrumentModel, RoundingAddsToTheNoiseAndMakesItWhereThereIsNone) {
  EXPECT_EQ(rounded_noise(0.5, 0), 0.5);
  EXPECT_NEAR(rounded_noise(0, 0.1), 0.1 / std::sqrt(12.0), 1e-15);
  MotorModel card;
  EXPECT_GT(card.fin_report_noise_rad(), card.fin_noise_rad);
  const double reference = card.fin_report_noise_rad();
  card.fin_noise_rad *= 3;
  EXPECT_GT(card.fin_report_noise_rad(), 2 * reference);
  card.fin_noise_rad = 0;
  EXPECT_GT(card.fin_report_noise_rad(), 0);
}

TEST(InstrumentModel, TheFirstFixesAreNoisierAndSettle) {
  const GpsModel gps;
  EXPECT_EQ(gps.noise_factor(0), 3);
  EXPECT_EQ(gps.noise_factor(1), 2);
  EXPECT_LT(gps.noise_factor(8), 1.01);
  for (int n = 0; n < 20; ++n) EXPECT_LT(gps.noise_factor(n + 1), gps.noise_factor(n));
}

TEST(InstrumentModel, WithoutNoiseResolutionLagAndTimingStay) {
  const InstrumentModel quiet = without_noise({}), usual;
  EXPECT_EQ(quiet.compass.field_noise_uT, 0);
  EXPECT_EQ(quiet.imu.turn_on_bias_rad_s, 0);
  EXPECT_EQ(quiet.compass.tilt_lag_s, usual.compass.tilt_lag_s);
  EXPECT_EQ(quiet.compass.tilt_resolution_deg, usual.compass.tilt_resolution_deg);
  EXPECT_EQ(quiet.gps.timing.latency_s, usual.gps.timing.latency_s);
}

}  // namespace
}  // namespace navcal::devices
