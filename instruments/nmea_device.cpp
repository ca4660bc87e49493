// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "instruments/devices.h"
#include "instruments/nmea_epoch.h"
#include "instruments/samples.h"
#include "instruments/units.h"
#include "protocols/nmea_attitude.h"
#include "protocols/nmea_position.h"

namespace navcal::instruments {
namespace {

namespace nmea = protocols::nmea;

/// Satellites in view from the GSV sentences of all talkers (GP, GL, GA, ...), those in use from GSA.
class NmeaSky {
 public:
  void add_used(const nmea::Gsa& gsa);
  /// The sky as it stands when a talker's group of sentences is complete.
  std::optional<SkySample> add(std::string_view talker, const nmea::Gsv& gsv);

 private:
  [[nodiscard]] bool is_used(std::uint16_t number) const;

  SkySample sky_;
  std::array<std::uint16_t, SkySample::kMaxSatellites> talkers_{};  ///< of each satellite
  std::vector<std::uint16_t> used_;  ///< of the newest GSA sentences, one for each system
  bool used_is_whole_ = false;       ///< the next GSA begins anew
};

void NmeaSky::add_used(const nmea::Gsa& gsa) {
  if (std::exchange(used_is_whole_, false) || used_.size() >= SkySample::kMaxSatellites) used_.clear();
  used_.insert(used_.end(), gsa.satellites.begin(), gsa.satellites.begin() + static_cast<long>(gsa.count));
}

bool NmeaSky::is_used(std::uint16_t number) const {
  return std::find(used_.begin(), used_.end(), number) != used_.end();
}

std::optional<SkySample> NmeaSky::add(std::string_view talker, const nmea::Gsv& gsv) {
  used_is_whole_ = true;
  const auto who = static_cast<std::uint16_t>(talker.size() < 2 ? 0 : talker[0] << 8 | talker[1]);
  if (gsv.sentence == 1) {  // a new group of this talker: its former satellites are dropped
    std::size_t kept = 0;
    for (std::size_t i = 0; i < sky_.count; ++i) {
      if (talkers_[i] == who) continue;
      talkers_[kept] = talkers_[i];
      sky_.satellites[kept++] = sky_.satellites[i];
    }
    sky_.count = kept;
  }
  for (std::size_t i = 0; i < gsv.count && sky_.count < SkySample::kMaxSatellites; ++i) {
    const auto& seen = gsv.satellites[i];
    SkySample::Satellite satellite;
    satellite.prn = seen.number;
    if (seen.elevation_deg) satellite.elevation_deg = *seen.elevation_deg;
    if (seen.azimuth_deg) satellite.azimuth_deg = *seen.azimuth_deg;
    if (seen.cn0_dBHz) satellite.cn0_dBHz = *seen.cn0_dBHz;
    satellite.used = is_used(seen.number);
    talkers_[sky_.count] = who;
    sky_.satellites[sky_.count++] = satellite;
  }
  if (gsv.sentence < gsv.sentences) return std::nullopt;
  return sky_;
}

Verdict give(const Value& value, bool paces, Receiver& receiver) {
  hand_over(value, receiver, paces);
  return Verdict::used;
}

void give_epoch(const GpsSample& sample, bool began_before, bool in_leap_second, Receiver& receiver) {
  receiver.on_measurement({.value = sample,
                           .stated_utc_ns = sample.time_utc_ns,
                           .utc_is_known = sample.time_utc_ns.has_value() && sample.fix != Fix::none,
                           .in_leap_second = in_leap_second,
                           .of_epoch = began_before});
}

std::optional<double> radians(const std::optional<nmea::Decimal>& angle_deg) {
  return angle_deg ? std::optional(angle_deg->value() * base::kRadiansPerDegree) : std::nullopt;
}

Verdict read_attitude(const nmea::Sentence& sentence, Receiver& receiver) {
  const auto attitude = nmea::decode_attitude(sentence);
  if (!attitude) return Verdict::out_of_range;
  CompassSample sample;
  sample.heading_rad = radians(attitude->heading_deg);
  sample.heading_is_true = sample.heading_rad.has_value();
  sample.pitch_rad = radians(attitude->pitch_deg);
  sample.roll_rad = radians(attitude->roll_deg);
  if (!sample.heading_rad && !sample.pitch_rad && !sample.roll_rad) return Verdict::ignored;
  return give(sample, true, receiver);
}

Verdict read_rot(const nmea::Sentence& sentence, Receiver& receiver) {
  const auto rot = nmea::decode_rot(sentence);
  if (!rot) return Verdict::out_of_range;
  if (!rot->valid || !rot->rate_deg_min) return Verdict::ignored;
  CompassSample sample;
  sample.turn_rate_rad_s = rot->rate_deg_min->value() * base::kRadiansPerDegree / 60;
  return give(sample, false, receiver);
}

constexpr double kMaxVoltage_V = 1000;
constexpr double kMaxCurrent_A = 1000;

// A gauge of the pack names itself BATTERY, or BATTERY#0 where it numbers several (the first one counts).
bool is_battery(std::string_view name) { return name == "BATTERY" || name == "BATTERY#0"; }

/// False when the value cannot be.
bool read_gauge(const nmea::Xdr::Transducer& transducer, PowerSample& power) {
  if (!transducer.value || !is_battery(transducer.name)) return true;
  const double value = transducer.value->value();
  if (transducer.type == 'U' && transducer.unit == 'V') {
    power.voltage_V = value;
    return value >= 0 && value <= kMaxVoltage_V;
  }
  if (transducer.type == 'I' && transducer.unit == 'A') {
    power.current_A = value;
    return std::abs(value) <= kMaxCurrent_A;
  }
  return true;
}

/// Whether a name begins with `word`, in whatever case: numbers and further words follow ("Heel Angle", "ROLL#1").
bool is_named(std::string_view name, std::string_view word) {
  return name.size() >= word.size() && std::equal(word.begin(), word.end(), name.begin(), [](char a, char b) {
           return a == std::toupper(static_cast<unsigned char>(b));
         });
}

// Names in use for tilt: PITCH, PTCH (pypilot, Airmar), ROLL, HEEL (NKE). Other transducers have no unit that can
// be relied on.
Verdict read_xdr(const nmea::Sentence& sentence, Receiver& receiver) {
  const auto xdr = nmea::decode_xdr(sentence);
  if (!xdr) return Verdict::out_of_range;
  CompassSample sample;
  PowerSample power;
  for (std::size_t i = 0; i < xdr->count; ++i) {
    const auto& transducer = xdr->transducers[i];
    if (!read_gauge(transducer, power)) return Verdict::out_of_range;
    if (transducer.type != 'A' || transducer.unit != 'D' || !transducer.value) continue;
    const double angle_rad = transducer.value->value() * base::kRadiansPerDegree;
    const auto named = [&](std::string_view word) { return is_named(transducer.name, word); };
    if (!sample.pitch_rad && (named("PITCH") || named("PTCH"))) sample.pitch_rad = angle_rad;
    if (!sample.roll_rad && (named("ROLL") || named("HEEL"))) sample.roll_rad = angle_rad;
  }
  const bool has_power = power.voltage_V || power.current_A;
  if (has_power) give(power, false, receiver);
  if (!sample.pitch_rad && !sample.roll_rad) return has_power ? Verdict::used : Verdict::ignored;
  return give(sample, false, receiver);
}

Verdict read_depth(const nmea::Sentence& sentence, nmea::Type type, Receiver& receiver) {
  const auto depth = nmea::decode_depth(sentence, type);
  if (!depth) return Verdict::out_of_range;
  if (!depth->depth_m) return Verdict::ignored;
  return give(AltimeterSample{*depth->depth_m, {}}, true, receiver);
}

/// Any NMEA 0183 device: position receivers (one sample an epoch), compasses (one sample a sentence), echo
/// sounders.
class NmeaDevice final : public Instrument {
 public:
  explicit NmeaDevice(const config::PortSettings& settings) : compass_(settings.compass), epoch_(settings.gps) {}

  Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
    const auto type = nmea::type_of(frame.id);
    if (type == nmea::Type::other) return Verdict::ignored;
    const nmea::Sentence sentence(frame.bytes);
    switch (type) {
      case nmea::Type::hdt:
      case nmea::Type::hdm:
      case nmea::Type::hdg:
      case nmea::Type::ths: return read_heading(sentence, type, receiver);
      case nmea::Type::ptnthtm: return read_ptnthtm(sentence, receiver);
      case nmea::Type::attitude: return read_attitude(sentence, receiver);
      case nmea::Type::rot: return read_rot(sentence, receiver);
      case nmea::Type::xdr: return read_xdr(sentence, receiver);
      case nmea::Type::dbt:
      case nmea::Type::dpt: return read_depth(sentence, type, receiver);
      case nmea::Type::gsv: {
        const auto gsv = nmea::decode_gsv(sentence);
        if (!gsv) return Verdict::out_of_range;
        const auto sky = sky_.add(sentence.address(), *gsv);
        return sky ? give(*sky, false, receiver) : Verdict::used;
      }
      default: return read_position(sentence, type, receiver);
    }
  }

 private:
  Verdict read_position(const nmea::Sentence& sentence, nmea::Type type, Receiver& receiver) {
    if (type == nmea::Type::gsa) {
      if (const auto gsa = nmea::decode_gsa(sentence)) sky_.add_used(*gsa);
    }
    const auto outcome = epoch_.add(sentence, type);
    if (!outcome.in_range) return Verdict::out_of_range;
    if (outcome.closed) give_epoch(*outcome.closed, true, false, receiver);
    if (outcome.sample) give_epoch(*outcome.sample, !outcome.begins, outcome.in_leap_second, receiver);
    return outcome.begins ? Verdict::begins : Verdict::used;
  }

  Verdict read_heading(const nmea::Sentence& sentence, nmea::Type type, Receiver& receiver) const {
    const auto heading = nmea::decode_heading(sentence, type);
    if (!heading) return Verdict::out_of_range;
    if (!heading->heading_deg || heading->mode == 'V') return Verdict::ignored;
    CompassSample sample;
    // The variation of HDG is left alone: which one holds is known here (docs/navigation.md).
    const double deviation_deg = heading->deviation_deg ? heading->deviation_deg->value() : 0;
    sample.heading_rad =
        base::positive_angle((heading->heading_deg->value() + deviation_deg) * base::kRadiansPerDegree);
    sample.heading_is_true = heading->is_true;
    return give(sample, true, receiver);
  }

  Verdict read_ptnthtm(const nmea::Sentence& sentence, Receiver& receiver) const {
    const auto tnt = nmea::decode_ptnthtm(sentence);
    if (!tnt) return Verdict::out_of_range;
    const auto angle = [](const std::optional<protocols::nmea::Decimal>& value, config::AngleUnit unit) {
      return value ? std::optional(radians_of(value->value(), unit)) : std::nullopt;
    };
    CompassSample sample;
    sample.heading_rad = angle(tnt->heading, compass_.heading_unit);
    sample.pitch_rad = angle(tnt->pitch, compass_.tilt_unit);
    sample.roll_rad = angle(tnt->roll, compass_.tilt_unit);
    sample.dip_rad = angle(tnt->dip, compass_.tilt_unit);
    return give(sample, true, receiver);
  }

  config::CompassSettings compass_;
  NmeaEpoch epoch_;
  NmeaSky sky_;
};

}  // namespace

std::unique_ptr<Instrument> make_nmea(const config::PortSettings& settings) {
  return std::make_unique<NmeaDevice>(settings);
}

}  // namespace navcal::instruments
