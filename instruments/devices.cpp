// SPDX-License-Identifier: Apache-2.0
// The instrument of each device, and its start-up dialogue.
#include "instruments/described_device.h"
#include "instruments/imu_card.h"
#include "instruments/instrument.h"
#include "instruments/motor_card.h"
#include "instruments/nmea_device.h"
#include "instruments/oncore_receiver.h"
#include "instruments/start_up.h"
#include "instruments/start_up_described.h"
#include "instruments/start_up_oncore.h"
#include "instruments/start_up_tcm2.h"
#include "instruments/tcm2_compass.h"
#include "protocols/device_types.h"

namespace navcal::instruments {
namespace {

using config::PortSettings;
using protocols::Protocol;

struct DeviceMakers {
  std::unique_ptr<Instrument> (*instrument)(const PortSettings&) = nullptr;
  std::unique_ptr<StartUp> (*start_up)(const PortSettings&) = nullptr;  ///< nullptr: it takes no commands
};

template <class I>
std::unique_ptr<Instrument> make_plain(const PortSettings&) {
  return std::make_unique<I>();
}
template <class I>
std::unique_ptr<Instrument> make_configured(const PortSettings& settings) {
  return std::make_unique<I>(settings);
}
std::unique_ptr<Instrument> make_tcm2(const PortSettings& settings) {
  return std::make_unique<Tcm2Compass>(settings.compass);
}
std::unique_ptr<Instrument> make_imu_card(const PortSettings& settings) {
  return std::make_unique<ImuCard>(settings.imu_card);
}
std::unique_ptr<StartUp> start_tcm2(const PortSettings& settings) {
  return std::make_unique<StartUpTcm2>(settings);
}
std::unique_ptr<StartUp> start_oncore(const PortSettings&) { return std::make_unique<StartUpOncore>(); }

std::unique_ptr<StartUp> start_described(const PortSettings& settings) {
  const bool has_lines = settings.described && !settings.described->start_up.empty();
  return has_lines ? std::make_unique<StartUpDescribed>(settings.described->start_up) : nullptr;
}

constexpr protocols::PerDevice<DeviceMakers> kDeviceMakers({
    {Protocol::tcm2, {make_tcm2, start_tcm2}},
    {Protocol::imu_card, {make_imu_card}},
    {Protocol::oncore, {make_configured<OncoreReceiver>, start_oncore}},
    {Protocol::motor_card, {make_plain<MotorCard>}},
    {Protocol::nmea, {make_configured<NmeaDevice>}},
    {Protocol::ubx, {}},
    {Protocol::mip, {}},
    {Protocol::vectornav, {}},
    {Protocol::pni, {}},
    {Protocol::pd0, {}},
    {Protocol::pd6, {}},
    {Protocol::water_linked, {}},
    {Protocol::samples, {}},
    {Protocol::described, {make_configured<DescribedDevice>, start_described}},
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
