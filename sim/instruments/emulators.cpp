// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/emulators.h"

#include "protocols/device_types.h"
#include "sim/instruments/imu_card.h"
#include "sim/instruments/motor_card.h"
#include "sim/instruments/oncore.h"
#include "sim/instruments/tcm2.h"

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

template <Oncore::Kind kind>
std::unique_ptr<Device> make_receiver(const EmulatorOptions& options, const Motion& motion) {
  Oncore::Options of_device;
  of_device.kind = kind;
  of_device.receiver.origin = options.origin;
  of_device.baud = options.baud;
  of_device.seed = options.seed;
  return std::make_unique<Oncore>(of_device, motion);
}

constexpr protocols::PerDevice<EmulatorMaker> kEmulatorMakers({
    {Protocol::tcm2, make_clocked<Tcm2>},
    {Protocol::imu_card, make_clocked<ImuCard>},
    {Protocol::oncore, make_receiver<Oncore::Kind::twelve_channels>},
    {Protocol::motor_card, make_clocked<MotorCard>},
    {Protocol::nmea, make_receiver<Oncore::Kind::nmea>},
    {Protocol::ubx, nullptr},
    {Protocol::mip, nullptr},
    {Protocol::vectornav, nullptr},
    {Protocol::pni, nullptr},
    {Protocol::pd0, nullptr},
    {Protocol::pd6, nullptr},
    {Protocol::water_linked, nullptr},
    {Protocol::samples, nullptr},
    {Protocol::described, nullptr},
});

}  // namespace

std::unique_ptr<Device> make_emulator(Protocol protocol, const EmulatorOptions& options, const Motion& motion) {
  EmulatorOptions complete = options;
  if (complete.baud == 0) complete.baud = protocols::device_type(protocol).baud;
  return kEmulatorMakers[protocol](complete, motion);
}

}  // namespace navcal::sim
