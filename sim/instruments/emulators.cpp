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
std::unique_ptr<Device> make_clocked(const EmulatorOptions& options, const Motion& motion) {
  typename D::Options of_device;
  of_device.baud = options.baud;
  of_device.seed = options.seed;
  of_device.clock_ppm = options.clock_ppm;
  return std::make_unique<D>(of_device, motion);
}

template <class D>
std::unique_ptr<Device> make_doppler(const EmulatorOptions& options, const Motion& motion) {
  typename D::Options of_device;
  of_device.floor = options.floor;
  of_device.baud = options.baud;
  of_device.seed = options.seed;
  of_device.clock_ppm = options.clock_ppm;
  return std::make_unique<D>(of_device, motion);
}

template <Oncore::Kind kind>
std::unique_ptr<Device> make_receiver(const EmulatorOptions& options, const Motion& motion) {
  Oncore::Options of_device;
  of_device.kind = kind;
  of_device.receiver.origin = options.origin;
  of_device.baud = options.baud;
  of_device.seed = options.seed;
  return std::make_unique<Oncore>(of_device, motion);
}

std::unique_ptr<Device> make_sample_sender(const EmulatorOptions& options, const Motion& motion) {
  SampleSender::Options of_device;
  of_device.baud = options.baud;
  of_device.seed = options.seed;
  return std::make_unique<SampleSender>(of_device, motion);
}

std::unique_ptr<Device> make_ubx(const EmulatorOptions& options, const Motion& motion) {
  UbxReceiver::Options of_device;
  of_device.receiver.origin = options.origin;
  of_device.receiver.gps.timing = devices::usual_timing(Protocol::ubx, options.baud);
  of_device.baud = options.baud;
  of_device.seed = options.seed;
  return std::make_unique<UbxReceiver>(of_device, motion);
}

constexpr protocols::PerDevice<EmulatorMaker> kEmulatorMakers({
    {Protocol::tcm2, make_clocked<Tcm2>},
    {Protocol::imu_card, make_clocked<ImuCard>},
    {Protocol::oncore, make_receiver<Oncore::Kind::twelve_channels>},
    {Protocol::motor_card, make_clocked<MotorCard>},
    {Protocol::nmea, make_receiver<Oncore::Kind::nmea>},
    {Protocol::ubx, make_ubx},
    {Protocol::mip, make_clocked<MipUnit>},
    {Protocol::vectornav, make_clocked<VectorNav>},
    {Protocol::pni, make_clocked<PniUnit>},
    {Protocol::pd0, make_doppler<Pd0Doppler>},
    {Protocol::pd6, make_doppler<Pd6Doppler>},
    {Protocol::water_linked, make_doppler<WaterLinkedDoppler>},
    {Protocol::samples, make_sample_sender},
    {Protocol::paroscientific, make_clocked<ParoscientificEmulator>},
    {Protocol::keller, make_clocked<KellerEmulator>},
    {Protocol::described, nullptr},
});

}  // namespace

std::unique_ptr<Device> make_emulator(Protocol protocol, const EmulatorOptions& options, const Motion& motion) {
  EmulatorOptions complete = options;
  if (complete.baud == 0) complete.baud = protocols::device_type(protocol).baud;
  return kEmulatorMakers[protocol](complete, motion);
}

}  // namespace navcal::sim
