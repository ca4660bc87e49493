// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/tcm2.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "base/rounding.h"
#include "protocols/tcm2_word.h"

namespace navcal::sim {
namespace {

constexpr double kMagnitude = 0.05;
constexpr double kTiltForAPoint_rad = 5 * std::numbers::pi / 180;

namespace tcm2 = protocols::tcm2;
using tcm2::Parameter;
using tcm2::Verb;

constexpr std::int64_t kThinks_ns = 2'000'000;      // from a command to the first byte of its answer
constexpr std::int64_t kStartsUp_ns = 200'000'000;  // from power to the banner
constexpr double kMils = 3200 / std::numbers::pi;
constexpr std::string_view kBanner = "TCM2 emulated, navcal\r\n";

/// An angle in 0 to one turn that stays below the turn when it is rounded.
double wrapped(double angle, double turn, double resolution) {
  return std::fmod(base::rounded(angle, resolution), turn);
}

}  // namespace

void Tcm2Score::add(const Tcm2Reading& reading) {
  const double sector = reading.heading_rad / (2 * std::numbers::pi) * kSectors;
  headings_.set(std::min(static_cast<std::size_t>(std::max(sector, 0.0)), kSectors - 1));
  least_pitch_rad_ = std::min(least_pitch_rad_, reading.pitch_rad);
  greatest_pitch_rad_ = std::max(greatest_pitch_rad_, reading.pitch_rad);
  least_roll_rad_ = std::min(least_roll_rad_, reading.roll_rad);
  greatest_roll_rad_ = std::max(greatest_roll_rad_, reading.roll_rad);
}

protocols::tcm2::CalibrationScore Tcm2Score::score() const {
  if (headings_.none()) return {};
  const double tilt = greatest_pitch_rad_ - least_pitch_rad_ + greatest_roll_rad_ - least_roll_rad_;
  const auto points = [](double value) {
    return static_cast<std::uint8_t>(std::clamp(std::floor(value), 0.0, 9.0));
  };
  return {points(9.0 * static_cast<double>(headings_.count()) / kSectors), points(tilt / kTiltForAPoint_rad),
          kMagnitude};
}

Tcm2::Tcm2(const Options& options, const Motion& motion)
    : CommandedDevice(options.baud), options_(options),
      effects_(options.sensor.effects != nullptr ? *options.sensor.effects : none_),
      sensor_(options.sensor, motion, options.seed), next_baud_(options.baud) {}

void Tcm2::power_on(std::int64_t t_ns) {
  sensor_.power_on(t_ns);
  measured_ns_ = t_ns;
  settings_ = {};
  settings_.field = options_.field_at_power_on;
  settings_.clock_Hz = options_.sensor.compass.timing.rate_Hz;
  restart(t_ns);
  if (options_.go_at_power_on) start(t_ns + kStartsUp_ns);
}

void Tcm2::restart(std::int64_t t_ns) {
  forget();
  running_ = calibrating_ = false;
  score_.clear();
  baud_ = next_baud_;
  answer(t_ns + kStartsUp_ns + kThinks_ns, Message(kBanner.begin(), kBanner.end()));
}

void Tcm2::start(std::int64_t t_ns) {
  running_ = true;
  ticks_ = Ticks(t_ns, period_s(), options_.clock_ppm);
}

std::int64_t Tcm2::latency_ns() const { return std::llround(options_.sensor.compass.timing.latency_s * 1e9); }

double Tcm2::period_s() const { return static_cast<double>(settings_.divider) / settings_.clock_Hz; }

std::int64_t Tcm2::next_act_ns() const { return running_ ? ticks_.next_ns() : kNever_ns; }

void Tcm2::act(std::int64_t now_ns, std::vector<Emission>& out) {
  ticks_.pass(effects_.slow_ppm(Instrument::compass, effects_.time_s(now_ns)));
  // A device that samples faster than its line can carry leaves words out.
  if (line_.free_ns() <= now_ns) send(now_ns, word(now_ns, settings_), out);
}

void Tcm2::obey(std::int64_t t_ns, const protocols::Frame& line) {
  const auto parsed = tcm2::parse_command({reinterpret_cast<const char*>(line.bytes.data()), line.bytes.size()});
  if (const auto* refusal = std::get_if<tcm2::Refusal>(&parsed)) {
    tcm2::Reply reply;
    reply.kind = tcm2::Reply::Kind::refused;
    reply.error = refusal->error;
    return answer_with(t_ns, reply);
  }
  obey(t_ns, std::get<tcm2::Command>(parsed));
}

void Tcm2::obey(std::int64_t t_ns, const tcm2::Command& command) {
  Settings only{
      false, false, false, false, false, settings_.heading_in_mils, settings_.tilt_in_mils, settings_.fahrenheit};
  tcm2::Reply reply;
  switch (command.verb) {
    case Verb::go: start(t_ns); break;
    case Verb::halt: running_ = false; break;
    case Verb::sample: return answer_word(t_ns, settings_);
    case Verb::heading: only.heading = true; return answer_word(t_ns, only);
    case Verb::inclination: only.pitch = only.roll = true; return answer_word(t_ns, only);
    case Verb::magnetometer: only.field = true; return answer_word(t_ns, only);
    case Verb::temperature: only.temperature = true; return answer_word(t_ns, only);
    case Verb::clear_calibration: score_.clear(); [[fallthrough]];
    case Verb::calibration_score:
      reply.kind = tcm2::Reply::Kind::calibration;
      reply.score = score_.score();
      break;
    case Verb::warm_restart: return restart(t_ns);
    case Verb::set:
      if (const bool ends = command.parameter == Parameter::multipoint_calibration && command.letter == 'd';
          ends && calibrating_) {
        reply.kind = tcm2::Reply::Kind::calibration;
        reply.score = score_.score();
      }
      if (const std::uint32_t error = set(command); error != 0) {
        reply.kind = tcm2::Reply::Kind::refused;
        reply.error = error;
      }
      break;
  }
  answer_with(t_ns, reply);
}

std::uint32_t Tcm2::set(const tcm2::Command& command) {
  const bool on = command.letter == 'e';
  switch (command.parameter) {
    case Parameter::output_heading: settings_.heading = on; break;
    case Parameter::output_pitch: settings_.pitch = on; break;
    case Parameter::output_roll: settings_.roll = on; break;
    case Parameter::output_field: settings_.field = on; break;
    case Parameter::output_temperature: settings_.temperature = on; break;
    case Parameter::heading_unit: settings_.heading_in_mils = command.letter == 'm'; break;
    case Parameter::tilt_unit: settings_.tilt_in_mils = command.letter == 'm'; break;
    case Parameter::temperature_unit: settings_.fahrenheit = command.letter == 'f'; break;
    case Parameter::output_format:
      if (command.letter == 'r') return tcm2::error::kBadParameter;  // no source at hand describes raw words
      settings_.nmea = command.letter == 'n';
      break;
    case Parameter::baud: next_baud_ = tcm2::kBauds[command.number]; break;
    case Parameter::clock: settings_.clock_Hz = command.number; break;
    case Parameter::sample_period: settings_.divider = command.number; break;
    case Parameter::fast:
    case Parameter::damping: break;  // filters that this model does not have
    case Parameter::multipoint_calibration: calibrating_ = on; break;
  }
  return 0;
}

void Tcm2::answer_with(std::int64_t t_ns, const tcm2::Reply& reply) {
  answer(t_ns + kThinks_ns, tcm2::encode_reply(reply));
}

void Tcm2::answer_word(std::int64_t t_ns, const Settings& fields) {
  answer(t_ns + kThinks_ns + latency_ns(), [this, fields](std::int64_t due_ns) { return word(due_ns, fields); });
}

std::vector<std::uint8_t> Tcm2::word(std::int64_t t_ns, const Settings& fields) {
  // Words asked for one by one may overlap with those that come of themselves.
  measured_ns_ = std::max(measured_ns_, t_ns - latency_ns());
  const Tcm2Reading reading = sensor_.measure(measured_ns_);
  if (calibrating_) score_.add(reading);
  const auto& compass = options_.sensor.compass;
  const double heading_deg =
      wrapped(reading.heading_rad * base::kDegreesPerRadian, 360, compass.heading_resolution_deg);
  if (fields.nmea) return tcm2::encode_hchdm(heading_deg);
  tcm2::Word out;
  if (fields.heading) {
    out.heading = fields.heading_in_mils ? wrapped(reading.heading_rad * kMils, 6400, 1) : heading_deg;
  }
  const double tilt_scale = fields.tilt_in_mils ? kMils : base::kDegreesPerRadian;
  const double tilt_resolution = fields.tilt_in_mils ? 1 : compass.tilt_resolution_deg;
  if (fields.pitch) out.pitch = base::rounded(reading.pitch_rad * tilt_scale, tilt_resolution);
  if (fields.roll) out.roll = base::rounded(reading.roll_rad * tilt_scale, tilt_resolution);
  if (fields.field) {
    out.x = reading.field_uT[0];
    out.y = reading.field_uT[1];
    out.z = reading.field_uT[2];
  }
  if (fields.temperature) {
    out.temperature = fields.fahrenheit ? reading.temperature_C * 1.8 + 32 : reading.temperature_C;
  }
  const std::uint32_t error = (reading.distorted ? tcm2::error::kDistortion : 0U) |
                              (reading.tilt_out_of_range ? tcm2::error::kInclinometerOutOfRange : 0U);
  if (error != 0) out.error = error;
  return tcm2::encode_word(out);
}

}  // namespace navcal::sim
