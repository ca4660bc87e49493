// SPDX-License-Identifier: Apache-2.0
// The instrument of each device, and its start-up dialogue.
#include <memory>

#include "instruments/described_device.h"
#include "instruments/imu_card.h"
#include "instruments/injected_samples.h"
#include "instruments/instrument.h"
#include "instruments/keller_gauge.h"
#include "instruments/mip_sensor.h"
#include "instruments/motor_card.h"
#include "instruments/nmea_device.h"
#include "instruments/oncore_receiver.h"
#include "instruments/paroscientific_gauge.h"
#include "instruments/pd0_log.h"
#include "instruments/pd6_log.h"
#include "instruments/pni_compass.h"
#include "instruments/start_ups.h"
#include "instruments/tcm2_compass.h"
#include "instruments/ubx_receiver.h"
#include "instruments/vectornav_sensor.h"
#include "instruments/water_linked_log.h"
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

constexpr protocols::PerDevice<DeviceMakers> kDeviceMakers({
    {Protocol::tcm2, {make_tcm2, start_tcm2}},
    {Protocol::imu_card, {make_imu_card}},
    {Protocol::oncore, {make_configured<OncoreReceiver>, start_oncore}},
    {Protocol::motor_card, {make_plain<MotorCard>}},
    {Protocol::nmea, {make_configured<NmeaDevice>}},
    {Protocol::ubx, {make_configured<UbxReceiver>, start_ubx}},
    {Protocol::mip, {make_plain<MipSensor>, start_mip}},
    {Protocol::vectornav, {make_plain<VectorNavSensor>, start_vectornav}},
    {Protocol::pni, {make_plain<PniCompass>, start_pni}},
    // Doppler logs of Teledyne ping as soon as they are powered, if they are set up so. To start them from here
    // (CS) would let them ping in air, or begin a deployment with parameters that nobody has seen.
    {Protocol::pd0, {make_plain<Pd0Log>}},
    {Protocol::pd6, {make_plain<Pd6Log>}},
    {Protocol::water_linked, {make_plain<WaterLinkedLog>}},
    {Protocol::samples, {make_plain<InjectedSamples>}},
    {Protocol::paroscientific, {make_configured<ParoscientificGauge>, start_paroscientific}},
    {Protocol::keller, {make_plain<KellerGauge>, start_keller}},
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
