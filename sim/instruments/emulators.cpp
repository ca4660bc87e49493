// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/emulators.h"

#include <string>

#include "protocols/device_types.h"
#include "protocols/samples_line.h"
#include "sim/instruments/doppler_devices.h"
#include "sim/instruments/imu_card.h"
#include "sim/instruments/mip_unit.h"
#include "sim/instruments/motor_card.h"
#include "sim/instruments/oncore.h"
#include "sim/instruments/pni_unit.h"
#include "sim/instruments/pressure_gauges.h"
#include "sim/instruments/tcm2.h"
#include "sim/instruments/ubx_receiver.h"
#include "sim/instruments/vectornav.h"
#include "sim/noise.h"

namespace navcal::sim {
namespace {

constexpr double kSender_Hz = 5;
constexpr std::uint64_t kTicksPerTemperature = 5;
constexpr std::int64_t kSenderTimeStd_ns = 1'000'000;

using protocols::samples_line::LineWriter;

LineWriter line_at(std::string_view class_name, std::int64_t t_ns) {
  LineWriter line(class_name);
  line.seconds("time", t_ns).seconds("time_std", kSenderTimeStd_ns);
  return line;
}

struct SenderOptions {
  double velocity_noise_m_s = 0.005;
  double depth_noise_m = 0.01;
  double temperature_noise_C = 0.01;
  std::uint64_t seed = 1;
  int baud = 4'000'000;
};

/// A program that sends samples as lines (ICD section 13), each with its time of validity: a Doppler log with
/// bottom lock and a pressure gauge five times a second, and a mission sensor of the water's temperature once a
/// second.
class SampleSender final : public MeasuringDevice<SenderOptions> {
 public:
  using MeasuringDevice::MeasuringDevice;

  void power_on(std::int64_t t_ns) override { ticks_ = Ticks(t_ns, 1 / kSender_Hz, 0); }

 private:
  void act(std::int64_t t_ns, std::vector<Emission>& out) override {
    const State state = motion_.at(t_ns);
    std::string lines =
        line_at("DVL", t_ns)
            .text("frame", "body")
            .vector("bottom_velocity_m_s", noisy(state.velocity_body_m_s, options_.velocity_noise_m_s))
            .number("bottom_velocity_std_m_s", options_.velocity_noise_m_s)
            .finish();
    lines += line_at("DEPTH", t_ns)
                 .number("depth_m", state.position_m[2] + noise_.normal(options_.depth_noise_m))
                 .number("depth_std_m", options_.depth_noise_m)
                 .finish();
    if (sent_++ % kTicksPerTemperature == 0) {
      lines += line_at("SENSOR", t_ns)
                   .text("quantity", "temperature")
                   .text("unit", "degC")
                   .number("value", state.water_temperature_C + noise_.normal(options_.temperature_noise_C))
                   .finish();
    }
    send(t_ns, {lines.begin(), lines.end()}, out);
    ticks_.pass();
  }

  std::uint64_t sent_ = 0;
};

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
