// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/emulators.h"

#include "protocols/device_types.h"
#include "sim/instruments/doppler_devices.h"
#include "sim/instruments/imu_card.h"
#include "sim/instruments/mip_unit.h"
#include "sim/instruments/motor_card.h"
#include "sim/instruments/oncore.h"
#include "sim/instruments/pni_unit.h"
#include "sim/instruments/pressure_gauges.h"
#include "sim/instruments/sample_sender.h"
#include "sim/instruments/tcm2.h"
#include "sim/instruments/ubx_receiver.h"
#include "sim/instruments/vectornav.h"

namespace navcal::sim {
namespace {

using protocols::Protocol;

using EmulatorMaker = std::unique_ptr<Device> (*)(const EmulatorOptions&, const Motion&);

template <class D>
std::unique_ptr<Device> make_with(typename D::Options of_device, const EmulatorOptions& options,
                                  const Motion& motion) {
  of_device.baud = options.baud;
  of_device.seed = options.seed;
  if constexpr (requires { of_device.clock_ppm; }) of_device.clock_ppm = options.clock_ppm;
  if constexpr (requires { of_device.floor; }) of_device.floor = options.floor;
  if constexpr (requires { of_device.receiver; }) of_device.receiver.origin = options.origin;
  return std::make_unique<D>(of_device, motion);
}

template <class D>
std::unique_ptr<Device> make(const EmulatorOptions& options, const Motion& motion) {
  return make_with<D>({}, options, motion);
}

template <Oncore::Kind kind>
std::unique_ptr<Device> make_receiver(const EmulatorOptions& options, const Motion& motion) {
  Oncore::Options of_device;
  of_device.kind = kind;
  return make_with<Oncore>(of_device, options, motion);
}

std::unique_ptr<Device> make_ubx(const EmulatorOptions& options, const Motion& motion) {
  UbxReceiver::Options of_device;
  of_device.receiver.gps.timing = devices::usual_timing(Protocol::ubx, options.baud);
  return make_with<UbxReceiver>(of_device, options, motion);
}

constexpr protocols::PerDevice<EmulatorMaker> kEmulatorMakers({
    {Protocol::tcm2, make<Tcm2>},
    {Protocol::imu_card, make<ImuCard>},
    {Protocol::oncore, make_receiver<Oncore::Kind::twelve_channels>},
    {Protocol::motor_card, make<MotorCard>},
    {Protocol::nmea, make_receiver<Oncore::Kind::nmea>},
    {Protocol::ubx, make_ubx},
    {Protocol::mip, make<MipUnit>},
    {Protocol::vectornav, make<VectorNav>},
    {Protocol::pni, make<PniUnit>},
    {Protocol::pd0, make<Pd0Doppler>},
    {Protocol::pd6, make<Pd6Doppler>},
    {Protocol::water_linked, make<WaterLinkedDoppler>},
    {Protocol::samples, make<SampleSender>},
    {Protocol::paroscientific, make<ParoscientificEmulator>},
    {Protocol::keller, make<KellerEmulator>},
    {Protocol::described, nullptr},
    {Protocol::mavlink, nullptr},
});

}  // namespace

bool has_emulator(Protocol protocol) { return kEmulatorMakers[protocol] != nullptr; }

std::unique_ptr<Device> make_emulator(Protocol protocol, const EmulatorOptions& options, const Motion& motion) {
  EmulatorOptions complete = options;
  if (complete.baud == 0) complete.baud = protocols::device_type(protocol).baud;
  return kEmulatorMakers[protocol](complete, motion);
}

}  // namespace navcal::sim
