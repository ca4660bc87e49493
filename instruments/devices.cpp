// SPDX-License-Identifier: Apache-2.0
// The instrument of each device, and its start-up dialogue.
#include "instruments/devices.h"

#include "protocols/device_types.h"

namespace navcal::instruments {
namespace {

using config::PortSettings;
using protocols::Protocol;

struct DeviceMakers {
  MakeInstrument* instrument = nullptr;
  MakeStartUp* start_up = nullptr;  ///< nullptr: it takes no commands
};

template <Read* read_frame>
std::unique_ptr<Instrument> stateless(const PortSettings& settings) {
  struct Stateless final : Instrument {
    explicit Stateless(const PortSettings& port) : settings(port) {}
    Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
      return read_frame(frame, settings, receiver);
    }
    PortSettings settings;
  };
  return std::make_unique<Stateless>(settings);
}

constexpr protocols::PerDevice<DeviceMakers> kDeviceMakers({
    {Protocol::tcm2, {stateless<read_tcm2>, start_tcm2}},
    {Protocol::imu_card, {stateless<read_imu_card>}},
    {Protocol::oncore, {make_oncore, start_oncore}},
    {Protocol::motor_card, {stateless<read_motor_card>}},
    {Protocol::nmea, {make_nmea}},
    {Protocol::ubx, {make_ubx, start_ubx}},
    {Protocol::mip, {make_mip, start_mip}},
    {Protocol::vectornav, {stateless<read_vectornav>, start_vectornav}},
    {Protocol::pni, {stateless<read_pni>, start_pni}},
    // Doppler logs of Teledyne ping as soon as they are powered, if they are set up so. To start them from here
    // (CS) would let them ping in air, or begin a deployment with parameters that nobody has seen.
    {Protocol::pd0, {make_pd0}},
    {Protocol::pd6, {make_pd6}},
    {Protocol::water_linked, {make_water_linked}},
    {Protocol::samples, {stateless<read_samples>}},
    {Protocol::paroscientific, {make_paroscientific, start_paroscientific}},
    {Protocol::keller, {stateless<read_keller>, start_keller}},
    {Protocol::described, {make_described, start_described}},
    {Protocol::mavlink, {make_mavlink, start_mavlink}},
});

}  // namespace

std::unique_ptr<Instrument> make_instrument(const PortSettings& settings) {
  return kDeviceMakers[settings.protocol].instrument(settings);
}

std::unique_ptr<StartUp> make_start_up(const PortSettings& settings) {
  const auto make = kDeviceMakers[settings.protocol].start_up;
  return settings.start_up && make != nullptr ? make(settings) : nullptr;
}

}  // namespace navcal::instruments
