// SPDX-License-Identifier: Apache-2.0
#include "emulation/emulate_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <functional>

#include "base/failure.h"
#include "devices/instrument_model.h"
#include "emulation/chosen_vehicle.h"
#include "emulation/emulate_motion.h"
#include "emulation/place_arguments.h"
#include "emulation/simulate_run.h"
#include "ports/port.h"
#include "protocols/device_types.h"
#include "sim/instruments/altimeter.h"
#include "sim/instruments/battery_gauge.h"
#include "sim/instruments/emulators.h"
#include "sim/instruments/tcm2.h"
#include "sim/path.h"

namespace navcal::emulation {

EmulateTruth::EmulateTruth(const std::filesystem::path& file, const sim::Motion& motion, std::int64_t start_ns)
    : file_(file), motion_(motion), start_ns_(start_ns), next_ns_(start_ns) {
  sim::begin_truth(rows_);
}

void EmulateTruth::advance(std::int64_t now_ns) {
  constexpr std::int64_t kRow_ns = 10'000'000;
  for (; next_ns_ <= now_ns; next_ns_ += kRow_ns) {
    sim::append_truth(rows_, static_cast<double>(next_ns_ - start_ns_) * 1e-9, motion_.at(next_ns_));
  }
  file_.write(rows_);
  rows_.clear();
}

void EmulateTruth::finish() {
  file_.write(rows_);
  file_.commit();
}

namespace {

constexpr std::string_view kOutputs = "outputs";  ///< port of the commands to a layout
constexpr double kGreatest_ppm = 200;             // ICD section 3: what the card's clock may be off by

std::int64_t utc_minus_monotonic() {
  using namespace std::chrono;
  const auto utc = duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
  return utc - ports::monotonic_ns();
}

std::uint64_t next_seed(sim::Noise& seeds) { return static_cast<std::uint64_t>(seeds.uniform(1, 9e15)); }

const EmulatedDevice* device_at(const EmulateArguments& arguments, std::string_view port) {
  const auto found = std::ranges::find(arguments.devices, port, &EmulatedDevice::port);
  return found == arguments.devices.end() ? nullptr : &*found;
}

/// The floor that was asked for, or the usual one.
sim::SeaFloor floor_of(const EmulateArguments& arguments) {
  sim::SeaFloor floor;
  if (arguments.floor_depth_m) floor.depth_m = *arguments.floor_depth_m;
  if (arguments.floor_slope.size() == 2) {
    floor.slope_north = arguments.floor_slope[0];
    floor.slope_east = arguments.floor_slope[1];
  }
  return floor;
}

std::unique_ptr<sim::Device> emulator_of(const EmulatedDevice& device, const sim::Origin& origin,
                                         const sim::SeaFloor& floor, const sim::Motion& motion,
                                         sim::Noise& seeds) {
  return sim::make_emulator(device.protocol, {.seed = next_seed(seeds), .origin = origin, .floor = floor}, motion);
}

/// The lines of the ports, in the order in which the session adds them.
std::vector<config::PortSettings> port_lines(const EmulateArguments& arguments, bool is_layout) {
  std::vector<config::PortSettings> lines;
  const auto add = [&](std::string_view name, protocols::Protocol protocol, int baud) {
    config::PortSettings& line = lines.emplace_back();
    line.name = name;
    line.protocol = protocol;
    line.baud = baud;
  };
  for (const protocols::DeviceType& type : protocols::kDeviceTypes) {
    if (is_layout && type.protocol == protocols::Protocol::motor_card) {
      if (device_at(arguments, kOutputs) == nullptr)
        add(kOutputs, protocols::Protocol::described, config::kOutputsBaud);
      continue;
    }
    if (type.vehicle.name.empty() || device_at(arguments, type.vehicle.name) != nullptr) continue;
    const bool is_compass = type.protocol == protocols::Protocol::tcm2;
    add(type.vehicle.name, type.protocol, is_compass ? arguments.compass_baud : type.vehicle.baud);
    const bool is_nmea = type.protocol == protocols::Protocol::oncore && arguments.gps == sim::Oncore::Kind::nmea;
    if (is_nmea) lines.back().protocol = protocols::Protocol::nmea;
  }
  for (const EmulatedDevice& device : arguments.devices) {
    add(device.port, device.protocol, protocols::device_type(device.protocol).baud);
  }
  const int nmea_baud = protocols::device_type(protocols::Protocol::nmea).baud;
  if (arguments.battery_Ah) add("battery", protocols::Protocol::nmea, nmea_baud);
  if (arguments.floor_depth_m) add("altimeter", protocols::Protocol::nmea, nmea_baud);
  return lines;
}

/// The effects asked for. Throws Failure where an effect moves a vehicle whose path is given.
sim::EffectSet effects_of(const EmulateArguments& arguments, const std::optional<config::Layout>& layout,
                          std::int64_t start_ns) {
  SimulateArguments wanted;
  wanted.layout = layout;
  wanted.effects = arguments.effects;
  wanted.effects_file = arguments.effects_file;
  wanted.seed = arguments.seed;
  wanted.begin_ns = start_ns;
  sim::EffectSet set = simulate_effects(wanted);
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto& about = set[i].description();
    const bool on_path = !arguments.ordered && arguments.mission.empty();
    if (!on_path || about.place != sim::EffectPlace::vehicle) continue;
    throw base::Failure(
        base::Exit::usage,
        fmt::format("{} changes how the vehicle moves, and a path says how it moves: take --vehicle or --mission",
                    about.name));
  }
  return set;
}

}  // namespace

std::optional<EmulatedDevice> parse_emulated_device(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string_view::npos) return std::nullopt;
  const std::string_view port = text.substr(0, equals);
  const auto in_name = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
  const auto protocol = protocols::protocol_named(text.substr(equals + 1));
  if (!protocol || !sim::has_emulator(*protocol) || !std::ranges::all_of(port, in_name)) return std::nullopt;
  return EmulatedDevice{std::string(port), *protocol};
}

EmulateSession::EmulateSession(boost::asio::io_context& io, const EmulateArguments& arguments)
    : io_(io), utc_minus_monotonic_ns_(utc_minus_monotonic()), truth_timer_(io) {
  const std::int64_t start_ns = now_ns();
  const SimulatedPlace place = emulated_place(arguments.where, start_ns);
  layout_ = layout_in(arguments.vehicle);
  if (!place.remark.empty()) fmt::print(stderr, "navcal: {}\n", place.remark);
  effects_ = effects_of(arguments, layout_, start_ns);
  EmulatedMotion made = emulate_motion(arguments, {.start_ns = start_ns,
                                                   .influencer = &effects_,
                                                   .field_world_uT = place.field_world_uT,
                                                   .now_ns = [this] { return now_ns(); }});
  obey_card_ = std::move(made.obey_card);
  obey_outputs_ = std::move(made.obey_outputs);
  motion_ = std::move(made.motion);
  if (!arguments.truth.empty()) {
    truth_ = std::make_unique<EmulateTruth>(arguments.truth, *motion_, start_ns);
    write_truth();
  }
  if (!arguments.sent_log.empty()) {
    log_ = std::make_unique<SentLog>(arguments.sent_log, port_lines(arguments, layout_.has_value()));
    log_->comment(place.field_event());
  }
  sim::Noise seeds(arguments.seed);
  add_vehicle_devices(arguments, place.origin, seeds);
  for (const EmulatedDevice& device : arguments.devices) {
    add(arguments, device.port, emulator_of(device, place.origin, floor_of(arguments), *motion_, seeds));
  }
  add_gauges(arguments, seeds);

  for (const StallPlan& plan : arguments.stalls) stall_regularly(plan);
  for (const UnplugPlan& plan : arguments.unplugs) {
    EmulatedPort* port = find(plan.port);
    if (port == nullptr)
      throw base::Failure(base::Exit::usage, fmt::format("--unplug: there is no port {}", plan.port));
    after(plan.at_s, [port] { port->unplug(); });
    after(plan.at_s + plan.duration_s, [port] { port->replug(); });
  }
  if (arguments.seconds > 0) after(arguments.seconds, [this] { stop(); });
}

void EmulateSession::add_vehicle_devices(const EmulateArguments& arguments, const sim::Origin& origin,
                                         sim::Noise& seeds) {
  const auto add_own = [&](std::string name, std::unique_ptr<sim::Device> device) {
    if (device_at(arguments, name) == nullptr) add(arguments, std::move(name), std::move(device));
  };
  const devices::InstrumentModel model =
      arguments.no_noise ? devices::without_noise(arguments.instruments) : arguments.instruments;
  sim::Tcm2::Options compass;
  compass.sensor.compass = model.compass;
  compass.baud = arguments.compass_baud;
  compass.seed = next_seed(seeds);
  compass.sensor.effects = &effects_;
  compass.clock_ppm = sim::clock_ppm(arguments.clocks, "compass", compass.clock_ppm);
  add_own("compass", std::make_unique<sim::Tcm2>(compass, *motion_));
  sim::ImuCard::Options imu;
  imu.imu = model.imu;
  imu.seed = next_seed(seeds);
  imu.effects = &effects_;
  imu.clock_ppm = arguments.imu_ppm.value_or(seeds.uniform(-kGreatest_ppm, kGreatest_ppm));
  imu.clock_ppm = sim::clock_ppm(arguments.clocks, "imu", imu.clock_ppm);
  auto card = std::make_unique<sim::ImuCard>(imu, *motion_);
  if (device_at(arguments, "imu") == nullptr) imu_ = card.get();
  add_own("imu", std::move(card));
  sim::Oncore::Options gps;
  gps.receiver.gps = model.gps;
  gps.kind = arguments.gps;
  gps.receiver.origin = origin;
  gps.receiver.effects = &effects_;
  gps.seed = next_seed(seeds);
  add_own("gps", std::make_unique<sim::Oncore>(gps, *motion_));
  add_commands(arguments, model.motor, seeds);
}

void EmulateSession::add_commands(const EmulateArguments& arguments, const devices::MotorModel& model,
                                  sim::Noise& seeds) {
  if (layout_) {
    if (device_at(arguments, kOutputs) == nullptr)
      add(arguments, std::string(kOutputs), std::make_unique<sim::ActuatorOutputs>(*motion_, obey_outputs_));
    return;
  }
  sim::MotorCard::Options motor;
  motor.motor = model;
  motor.seed = next_seed(seeds);
  motor.effects = &effects_;
  motor.clock_ppm = sim::clock_ppm(arguments.clocks, "motor", motor.clock_ppm);
  motor.obey = obey_card_;
  if (device_at(arguments, "motor") == nullptr)
    add(arguments, "motor", std::make_unique<sim::MotorCard>(motor, *motion_));
}

void EmulateSession::add_gauges(const EmulateArguments& arguments, sim::Noise& seeds) {
  if (arguments.battery_Ah) {
    sim::BatteryGauge::Options gauge;
    gauge.battery.charge_Ah = *arguments.battery_Ah;
    gauge.seed = next_seed(seeds);
    if (arguments.no_noise) gauge.voltage_noise_V = gauge.current_noise_A = 0;
    add(arguments, "battery", std::make_unique<sim::BatteryGauge>(gauge, *motion_));
  }
  if (arguments.floor_depth_m) {
    sim::Altimeter::Options altimeter;
    altimeter.floor = floor_of(arguments);
    altimeter.seed = next_seed(seeds);
    if (arguments.no_noise) altimeter.noise_m = altimeter.lost = 0;
    add(arguments, "altimeter", std::make_unique<sim::Altimeter>(altimeter, *motion_));
  }
}

std::int64_t EmulateSession::now_ns() const { return ports::monotonic_ns() + utc_minus_monotonic_ns_; }

void EmulateSession::write_truth() {
  constexpr auto kEvery = std::chrono::milliseconds(500);
  truth_->advance(now_ns());
  truth_timer_.expires_after(kEvery);
  truth_timer_.async_wait([this](const boost::system::error_code& error) {
    if (!error) write_truth();
  });
}

void EmulateSession::finish() {
  if (truth_ == nullptr) return;
  truth_->advance(now_ns());
  truth_->finish();
}

void EmulateSession::finish_after_error() {
  if (truth_ == nullptr) return;
  try {
    truth_->advance(now_ns());
  } catch (const std::runtime_error&) {
    // Expected: an unstable vehicle, or a mission that does not end. These are the rows before it.
  }
  truth_->finish();
}

void EmulateSession::add(const EmulateArguments& arguments, std::string name,
                         std::unique_ptr<sim::Device> device) {
  const auto index = static_cast<std::uint16_t>(ports_.size());
  const EmulatedPort::Place place{arguments.dir,           std::move(name),        index,
                                  utc_minus_monotonic_ns_, arguments.seed + index, &effects_};
  ports_.push_back(std::make_unique<EmulatedPort>(io_.get_executor(), place, std::move(device), log_.get()));
  ports_.back()->misbehaviour().set_noise(arguments.noise);
  ports_.back()->misbehaviour().set_drop(arguments.drop);
}

EmulatedPort* EmulateSession::find(std::string_view name) const {
  const auto found = std::ranges::find_if(ports_, [&](const auto& port) { return port->name() == name; });
  return found == ports_.end() ? nullptr : found->get();
}

void EmulateSession::after(double seconds, std::function<void()> what) {
  timers_.push_back(std::make_unique<boost::asio::steady_timer>(io_));
  timers_.back()->expires_after(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(seconds)));
  timers_.back()->async_wait([what = std::move(what)](const boost::system::error_code& error) {
    if (!error) what();
  });
}

void EmulateSession::stall_regularly(const StallPlan& plan) {
  timers_.push_back(std::make_unique<boost::asio::steady_timer>(io_));
  boost::asio::steady_timer& timer = *timers_.back();
  const auto every =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(plan.every_s));
  timer.expires_after(every);
  const auto again = std::make_shared<std::function<void()>>();
  *again = [this, plan, every, &timer, weak = std::weak_ptr(again)] {
    timer.async_wait([this, plan, every, &timer, self = weak.lock()](const boost::system::error_code& error) {
      if (error) return;
      for (const auto& port : ports_) port->stall(plan.duration_s);
      timer.expires_at(timer.expiry() + every);
      (*self)();
    });
  };
  (*again)();
}

void EmulateSession::report() const {
  for (const auto& port : ports_) {
    const auto& tally = port->host().tally();
    fmt::print(stderr, "{}: {} bytes taken, {} sent while nobody had it open", port->name(), tally.taken,
               tally.unheard);
    if (tally.overrun > 0) fmt::print(stderr, ", {} lost because the reader did not keep up", tally.overrun);
    fmt::print(stderr, "\n");
  }
}

}  // namespace navcal::emulation
