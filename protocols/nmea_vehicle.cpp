// SPDX-License-Identifier: Apache-2.0
#include "protocols/nmea_vehicle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "protocols/checked_line.h"
#include "protocols/nmea_position.h"

namespace navcal::protocols::nmea {
namespace {

/// One sentence while it is appended: `$` when it begins, checksum and CR LF when it ends.
class Line {
 public:
  Line(std::string& out, std::string_view talker, std::string_view type) : out_(out), begin_(out.size()) {
    out_ += '$';
    out_ += talker;
    out_ += type;
  }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  ~Line() {
    const auto* body = reinterpret_cast<const std::uint8_t*>(out_.data()) + begin_ + 1;
    append("*%02X\r\n", unsigned{xor_of({body, out_.size() - begin_ - 1})});
  }

  void text(std::string_view field) {
    out_ += ',';
    out_ += field;
  }
  void letter(char field) { text({&field, 1}); }
  void empty(int fields) { out_.append(static_cast<std::size_t>(fields), ','); }
  void number(const std::optional<double>& value, int decimals) {
    out_ += ',';
    if (!value || !std::isfinite(*value)) return;
    const bool is_zero = std::abs(*value) < 0.5 * std::pow(10.0, -decimals);
    append("%.*f", decimals, is_zero ? 0.0 : *value);  // never "-0.0"
  }
  void count(unsigned value, int digits) {
    out_ += ',';
    append("%0*u", digits, value);
  }
  /// 0 to 360 after rounding to hundredths.
  void angle(const std::optional<double>& value_deg) {
    out_ += ',';
    if (!value_deg || !std::isfinite(*value_deg)) return;
    const double wrapped_deg = std::fmod(std::fmod(*value_deg, 360) + 360, 360);
    const long hundredths = std::lround(wrapped_deg * 100) % 36'000;
    append("%ld.%02ld", hundredths / 100, hundredths % 100);
  }
  /// Size and E or W.
  void east(const std::optional<double>& value_deg) {
    number(value_deg ? std::optional(std::abs(*value_deg)) : std::nullopt, 1);
    text(value_deg ? (*value_deg < 0 ? "W" : "E") : "");
  }
  void time(const std::optional<TimeOfDay>& time) {
    out_ += ',';
    if (time)
      append("%02u%02u%02u.%02u", unsigned{time->hour}, unsigned{time->minute}, unsigned{time->second},
             static_cast<unsigned>(time->nanosecond / 10'000'000));
  }
  /// With 1e-5 minutes, 2 cm.
  void place(const StatedPosition& position) {
    if (!position.is_known()) return empty(4);
    coordinate(*position.latitude_deg, 2, "N", "S");
    coordinate(*position.longitude_deg, 3, "E", "W");
  }

 private:
  template <class... Values>
  void append(const char* format, Values... values) {
    std::array<char, 352> room;  // for any double
    const int length = std::snprintf(room.data(), room.size(), format, values...);
    out_.append(room.data(), std::min(static_cast<std::size_t>(std::max(length, 0)), room.size() - 1));
  }
  // Rounded as a whole number of 1e-5 minutes, so that 59.999996 minutes become the next degree and not
  // "60.00000".
  void coordinate(double angle_deg, int degree_digits, std::string_view positive, std::string_view negative) {
    const long total = std::lround(std::abs(angle_deg) * 6'000'000);
    out_ += ',';
    append("%0*ld%02ld.%05ld", degree_digits, total / 6'000'000, total / 100'000 % 60, total % 100'000);
    text(angle_deg < 0 ? negative : positive);
  }

  std::string& out_;
  std::size_t begin_;
};

char mode_letter(const StatedPosition& position) {
  if (!position.is_known()) return 'N';
  if (position.fix == Fix::propagated) return 'E';
  return position.fix == Fix::hold ? 'M' : 'A';
}

unsigned quality_of(const StatedPosition& position) {
  if (!position.is_known()) return 0;
  if (position.fix == Fix::propagated) return 6;
  return position.fix == Fix::hold ? 7 : 1;
}

}  // namespace

bool StatedPosition::is_known() const {
  const bool has_fix = fix == Fix::fix_2d || fix == Fix::fix_3d || fix == Fix::propagated || fix == Fix::hold;
  return has_fix && latitude_deg && longitude_deg && std::isfinite(*latitude_deg) && std::isfinite(*longitude_deg);
}

void append_rmc(std::string& out, const StatedPosition& position) {
  Line line(out, position.talker, "RMC");
  const bool known = position.is_known();
  line.time(position.time);
  line.letter(known ? 'A' : 'V');
  line.place(position);
  const auto speed_m_s = known ? position.speed_m_s : std::nullopt;
  line.number(speed_m_s ? std::optional(*speed_m_s / kMetresPerSecondPerKnot) : std::nullopt, 2);
  line.angle(known ? position.course_deg : std::nullopt);
  std::array<char, 16> date{};
  if (position.date)
    std::snprintf(date.data(), date.size(), "%02u%02u%02u", unsigned{position.date->day},
                  unsigned{position.date->month}, position.date->year % 100U);
  line.text(date.data());
  line.east(position.variation_deg);
  line.letter(mode_letter(position));
}

void append_gga(std::string& out, const StatedPosition& position) {
  Line line(out, position.talker, "GGA");
  const bool known = position.is_known();
  line.time(position.time);
  line.place(position);
  line.count(quality_of(position), 1);
  line.count(position.satellites, 2);
  line.number(known ? position.hdop : std::nullopt, 2);
  line.number(known ? position.altitude_m : std::nullopt, 1);
  line.letter('M');
  line.number(known ? position.geoid_separation_m : std::nullopt, 1);
  line.letter('M');
  line.empty(2);
}

void append_gsa(std::string& out, const StatedPosition& position, std::span<const std::uint16_t> used) {
  Line line(out, position.talker, "GSA");
  const bool is_3d = position.fix == Fix::fix_3d || position.fix == Fix::hold;
  line.letter('A');
  line.letter(!position.is_known() ? '1' : (is_3d ? '3' : '2'));
  const std::size_t sent = std::min(used.size(), Gsa::kSlots);
  for (const std::uint16_t number : used.first(sent)) line.count(number, 2);
  line.empty(static_cast<int>(Gsa::kSlots - sent));
  line.number(position.pdop, 2);
  line.number(position.hdop, 2);
  line.number(position.vdop, 2);
}

void append_gst(std::string& out, const StatedPosition& position) {
  if (!position.is_known() || !(position.north_std_m || position.east_std_m || position.height_std_m)) return;
  Line line(out, position.talker, "GST");
  line.time(position.time);
  line.empty(4);  // residuals and ellipse
  line.number(position.north_std_m, 2);
  line.number(position.east_std_m, 2);
  line.number(position.height_std_m, 2);
}

void append_gsv(std::string& out, std::string_view talker, std::span<const StatedSatellite> satellites) {
  constexpr std::size_t kInSentence = 4;
  const std::size_t total = std::max<std::size_t>((satellites.size() + kInSentence - 1) / kInSentence, 1);
  for (std::size_t n = 0; n < total; ++n) {
    Line line(out, talker, "GSV");
    line.count(static_cast<unsigned>(total), 1);
    line.count(static_cast<unsigned>(n + 1), 1);
    line.count(static_cast<unsigned>(satellites.size()), 2);
    for (std::size_t i = n * kInSentence; i < std::min((n + 1) * kInSentence, satellites.size()); ++i) {
      line.count(satellites[i].number, 2);
      line.number(satellites[i].elevation_deg, 0);
      line.number(satellites[i].azimuth_deg, 0);
      line.number(satellites[i].cn0_dBHz, 0);
    }
  }
}

void append_hdt(std::string& out, double heading_deg) {
  if (!std::isfinite(heading_deg)) return;
  Line line(out, "HE", "HDT");
  line.angle(heading_deg);
  line.letter('T');
}

void append_hdg(std::string& out, double sensor_deg, std::optional<double> deviation_deg,
                std::optional<double> variation_deg) {
  if (!std::isfinite(sensor_deg)) return;
  Line line(out, "HC", "HDG");
  line.angle(sensor_deg);
  line.east(deviation_deg);
  line.east(variation_deg);
}

void append_rot(std::string& out, double rate_deg_min) {
  if (!std::isfinite(rate_deg_min)) return;
  Line line(out, "TI", "ROT");
  line.number(rate_deg_min, 1);
  line.letter('A');
}

void append_dpt(std::string& out, double depth_m, std::optional<double> offset_m) {
  if (!std::isfinite(depth_m)) return;
  Line line(out, "SD", "DPT");
  line.number(depth_m, 2);
  line.number(offset_m, 2);
  line.empty(1);
}

void append_dbt(std::string& out, std::optional<double> distance_m) {
  Line line(out, "SD", "DBT");
  line.empty(1);
  line.letter('f');
  line.number(distance_m, 2);
  line.letter('M');
  line.empty(1);
  line.letter('F');
}

void append_vhw(std::string& out, std::optional<double> true_deg, std::optional<double> magnetic_deg,
                double speed_m_s) {
  if (!std::isfinite(speed_m_s)) return;
  Line line(out, "VW", "VHW");
  line.angle(true_deg);
  line.letter('T');
  line.angle(magnetic_deg);
  line.letter('M');
  line.number(speed_m_s / kMetresPerSecondPerKnot, 2);
  line.letter('N');
  line.number(speed_m_s * 3.6, 2);
  line.letter('K');
}

void append_xdr(std::string& out, std::span<const StatedTransducer> transducers) {
  if (transducers.empty()) return;
  Line line(out, "II", "XDR");
  for (const StatedTransducer& transducer : transducers) {
    line.letter(transducer.type);
    line.number(transducer.value, transducer.decimals);
    line.letter(transducer.unit);
    line.text(transducer.name);
  }
}

}  // namespace navcal::protocols::nmea
