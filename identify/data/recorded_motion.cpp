// SPDX-License-Identifier: Apache-2.0
#include "identify/data/recorded_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/angles.h"
#include "base/gravity.h"
#include "base/local_plane.h"
#include "devices/instrument_model.h"
#include "gap/data/mission.h"
#include "instruments/compass_error.h"
#include "instruments/samples.h"
#include "pipeline/earth_field.h"
#include "pipeline/pipeline.h"
#include "protocols/frame.h"
#include "protocols/motor_card.h"
#include "record/port_matching.h"

namespace navcal::identify {
namespace {

constexpr double kShortest_s = 0.04;  ///< between two readings of rates and forces
constexpr double kSightLost_s = 3.5;  ///< fixes further apart belong to different surfacings
constexpr double kAtmosphere_Pa = 101325;
constexpr double kWater_kg_m3 = 1000;  ///< of a gauge that states a pressure only

// Noise of devices that state none and of which the configuration knows none. It is estimated anew from the
// residuals.
constexpr double kDopplerNoise_m_s = 0.01;
constexpr double kGaugeNoise_m = 0.01;

/// Readings of one channel by one device.
struct Source {
  std::vector<std::int64_t> times_ns;
  std::vector<double> values, stds;
};

/// Gathers the channels of each port.
class MotionGatherer final : public pipeline::Sink {
 public:
  MotionGatherer(const config::Settings& settings, const devices::InstrumentModel& model)
      : settings_(settings), model_(model), field_(settings.environment), sources_(settings.ports.size()) {}

  void on_sample(const instruments::Sample& sample) override {
    port_ = sample.port;
    time_ns_ = sample.stamp.validity_ns;
    std::visit(
        [&](const auto& value) {
          if constexpr (requires { add(value); }) add(value);
        },
        sample.value);
  }

  [[nodiscard]] RecordedMotion take(std::int64_t begin_ns);

 private:
  void put(Channel channel, double value, double std) {
    if (!std::isfinite(value)) return;
    Source& source = sources_[port_][static_cast<std::size_t>(channel)];
    source.times_ns.push_back(time_ns_);
    source.values.push_back(value);
    source.stds.push_back(std);
  }
  void put3(Channel first, const instruments::Vector3& values, double std) {
    for (std::size_t i = 0; i < 3; ++i)
      put(static_cast<Channel>(static_cast<std::size_t>(first) + i), values[i], std);
  }
  void signal(const std::string& name, const std::optional<double>& value) {
    if (!value || !std::isfinite(*value)) return;
    auto& [times_ns, values] = signals_[name];
    times_ns.push_back(time_ns_);
    values.push_back(*value);
  }

  void add(const instruments::ImuSample& sample);
  void add(const instruments::CompassSample& sample);
  void add(const instruments::GpsSample& sample);
  void add(const instruments::MotorSample& sample);
  void add(const instruments::DvlSample& sample);
  void add(const instruments::DepthSample& sample);
  void add(const instruments::ScalarSample& sample) {
    const std::string name(sample.quantity.view());
    signal(name, sample.value);
    if (sample.unit.view() == "us") pulses_.insert(name);
  }

  [[nodiscard]] const config::PortSettings& port() const { return settings_.ports[port_]; }

  const config::Settings& settings_;
  const devices::InstrumentModel& model_;
  pipeline::EarthFieldWatch field_;
  bool heading_is_true_ = false;
  std::vector<std::array<Source, kChannels>> sources_;
  std::map<std::string, std::pair<std::vector<std::int64_t>, std::vector<double>>> signals_;
  std::set<std::string> pulses_;  ///< signals in us
  std::size_t port_ = 0;
  std::int64_t time_ns_ = 0;
  std::optional<base::LocalPlane> plane_;
  std::int64_t last_fix_ns_ = 0;
  int fix_number_ = 0;
  bool fins_are_reported_ = false;
  double field_level_uT_ = 0, field_down_uT_ = 0, fields_ = 0;  ///< sums, and their number
};

void MotionGatherer::add(const instruments::ImuSample& sample) {
  if (sample.over_range) return;
  if (sample.rate_rad_s)
    put3(Channel::rate_x, *sample.rate_rad_s, sample.rate_std_rad_s.value_or(model_.imu.gyro_noise_rad_s));
  if (sample.yaw_rate_b_rad_s)
    put(Channel::second_yaw_rate, *sample.yaw_rate_b_rad_s,
        sample.rate_std_rad_s.value_or(model_.imu.gyro_noise_rad_s));
  if (sample.specific_force_m_s2)
    put3(Channel::force_x, *sample.specific_force_m_s2,
         sample.specific_force_std_m_s2.value_or(model_.imu.force_noise_m_s2));
  if (sample.depth_m) put(Channel::depth, *sample.depth_m, sample.depth_std_m.value_or(model_.imu.depth_noise_m));
}

void MotionGatherer::add(const instruments::CompassSample& sample) {
  if (instruments::CompassError(sample.error).unknown) return;
  const double tilt_std = sample.tilt_std_rad.value_or(model_.compass.tilt_reading_noise_rad());
  // Tilt that was made of the accelerometers says what they say once more.
  if (sample.roll_rad && !sample.tilt_by_accelerometers) put(Channel::roll, *sample.roll_rad, tilt_std);
  if (sample.pitch_rad && !sample.tilt_by_accelerometers) put(Channel::pitch, *sample.pitch_rad, tilt_std);
  if (sample.heading_rad) heading_is_true_ = sample.heading_is_true;
  if (sample.heading_rad)
    put(Channel::heading, *sample.heading_rad,
        sample.heading_std_rad.value_or(model_.compass.heading_noise_rad()));
  if (!sample.field_body_uT || !sample.roll_rad || !sample.pitch_rad) return;
  const auto& [x, y, z] = *sample.field_body_uT;
  const double sr = std::sin(*sample.roll_rad), cr = std::cos(*sample.roll_rad);
  const double sp = std::sin(*sample.pitch_rad), cp = std::cos(*sample.pitch_rad);
  field_level_uT_ += std::hypot(x * cp + y * sr * sp + z * cr * sp, y * cr - z * sr);
  field_down_uT_ += -x * sp + y * sr * cp + z * cr * cp;
  ++fields_;
}

void MotionGatherer::add(const instruments::GpsSample& sample) {
  using instruments::Fix;
  if (!sample.latitude_rad || !sample.longitude_rad || (sample.fix != Fix::fix_2d && sample.fix != Fix::fix_3d))
    return;
  field_.take(sample);
  fix_number_ = static_cast<double>(time_ns_ - last_fix_ns_) < kSightLost_s * 1e9 ? fix_number_ + 1 : 0;
  last_fix_ns_ = time_ns_;
  if (!plane_) plane_.emplace(*sample.latitude_rad, *sample.longitude_rad);
  const auto [north_m, east_m] = plane_->position_m(*sample.latitude_rad, *sample.longitude_rad);
  const double factor = model_.gps.noise_factor(fix_number_);
  const double position_std = factor * sample.position_std_m.value_or(model_.gps.position_noise_m);
  put(Channel::north, north_m, position_std);
  put(Channel::east, east_m, position_std);
  if (!sample.speed_m_s || !sample.course_rad) return;
  const double velocity_std = factor * sample.velocity_std_m_s.value_or(model_.gps.velocity_noise_m_s);
  put(Channel::north_velocity, *sample.speed_m_s * std::cos(*sample.course_rad), velocity_std);
  put(Channel::east_velocity, *sample.speed_m_s * std::sin(*sample.course_rad), velocity_std);
}

void MotionGatherer::add(const instruments::MotorSample& sample) {
  if (port().protocol == protocols::Protocol::motor_card) fins_are_reported_ = true;
  signal("rpm", sample.rpm);
  signal("rpm_commanded", sample.rpm_commanded);
  for (std::size_t i = 0; i < 3; ++i) signal(fmt::format("fin_{}", i + 1), sample.fins_rad[i]);
}

void MotionGatherer::add(const instruments::DvlSample& sample) {
  if (sample.frame != instruments::VelocityFrame::body) return;
  if (sample.bottom_velocity_m_s)
    put3(Channel::bottom_x, *sample.bottom_velocity_m_s,
         sample.bottom_velocity_std_m_s.value_or(kDopplerNoise_m_s));
  if (sample.water_velocity_m_s)
    put3(Channel::water_x, *sample.water_velocity_m_s, sample.water_velocity_std_m_s.value_or(kDopplerNoise_m_s));
}

void MotionGatherer::add(const instruments::DepthSample& sample) {
  constexpr double kPa_per_m = kWater_kg_m3 * base::kGravity_m_s2;
  if (sample.depth_m) {
    put(Channel::gauge_depth, *sample.depth_m, sample.depth_std_m.value_or(kGaugeNoise_m));
  } else if (sample.pressure_Pa) {
    put(Channel::gauge_depth, (*sample.pressure_Pa - kAtmosphere_Pa) / kPa_per_m,
        sample.pressure_std_Pa ? *sample.pressure_std_Pa / kPa_per_m : kGaugeNoise_m);
  }
}

/// Readings in order of time; with `least_s` above zero, means of all within that time.
std::vector<Reading> readings_of(const Source& source, std::int64_t begin_ns, double least_s) {
  std::vector<Reading> all;
  for (std::size_t i = 0; i < source.values.size(); ++i)
    all.push_back({static_cast<double>(source.times_ns[i] - begin_ns) * 1e-9, source.values[i], source.stds[i]});
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  const double span_s = all.size() > 1 ? all.back().time_s - all.front().time_s : 0;
  if (least_s <= 0 || span_s <= 0 || span_s / static_cast<double>(all.size() - 1) >= least_s) return all;
  std::vector<Reading> means;
  for (std::size_t i = 0; i < all.size();) {
    Reading mean;
    std::size_t n = 0;
    const double end_s = (std::floor(all[i].time_s / least_s) + 1) * least_s;
    for (; i < all.size() && all[i].time_s < end_s; ++i, ++n) {
      mean.time_s += all[i].time_s;
      mean.value += all[i].value;
      mean.std = all[i].std;
    }
    const auto count = static_cast<double>(n);
    means.push_back({mean.time_s / count, mean.value / count, mean.std / std::sqrt(count)});
  }
  return means;
}

RecordedMotion MotionGatherer::take(std::int64_t begin_ns) {
  RecordedMotion motion;
  const auto place = [](const config::PortSettings& port) {
    return Eigen::Vector3d(port.mounting.position_m[0], port.mounting.position_m[1], port.mounting.position_m[2]);
  };
  for (std::size_t c = 0; c < kChannels; ++c) {
    const auto channel = static_cast<Channel>(c);
    const auto most = std::max_element(sources_.begin(), sources_.end(), [&](const auto& a, const auto& b) {
      return a[c].values.size() < b[c].values.size();
    });
    if (most == sources_.end() || (*most)[c].values.empty()) continue;
    const bool is_inertial = channel <= Channel::force_z;
    motion.channels[c] = readings_of((*most)[c], begin_ns, is_inertial ? kShortest_s : 0);
    motion.duration_s = std::max(motion.duration_s, motion.channels[c].back().time_s);
    const config::PortSettings& from = settings_.ports[static_cast<std::size_t>(most - sources_.begin())];
    if (channel == Channel::force_x || channel == Channel::depth) motion.imu_place_m = place(from);
    if (channel == Channel::gauge_depth) motion.gauge_place_m = place(from);
    if (channel == Channel::bottom_x || channel == Channel::water_x) motion.doppler_place_m = place(from);
    if (channel == Channel::north) motion.antenna_place_m = place(from);
    if (channel == Channel::roll && from.protocol == protocols::Protocol::tcm2)
      motion.tilt_lag_s = model_.compass.tilt_lag_s;
  }
  for (auto& [name, signal] : signals_) {
    std::vector<std::size_t> order(signal.first.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&times = signal.first](std::size_t a, std::size_t b) { return times[a] < times[b]; });
    Signal& out = motion.signals[name];
    out.is_pulse = pulses_.contains(name);
    for (const std::size_t i : order) {
      out.times_s.push_back(static_cast<double>(signal.first[i] - begin_ns) * 1e-9);
      out.values.push_back(signal.second[i]);
    }
  }
  motion.fins_are_reported = fins_are_reported_;
  if (fields_ > 0) {
    motion.dip_rad = std::atan2(field_down_uT_, field_level_uT_);
    motion.field_uT = std::hypot(field_down_uT_, field_level_uT_) / fields_;
  }
  motion.gyro_turn_on_rad_s = model_.imu.turn_on_bias_rad_s;
  motion.heading_is_true = heading_is_true_;
  if (field_.field().declination_source != pipeline::EarthField::Source::none)
    motion.declination_rad = field_.field().declination_rad;
  return motion;
}

}  // namespace

void set_field(RecordedMotion& motion, const std::array<double, 3>& field_uT) {
  const auto [north, east, down] = field_uT;
  motion.declination_rad = std::atan2(east, north);
  motion.dip_rad = std::atan2(down, std::hypot(north, east));
  motion.field_uT = std::hypot(north, east, down);
  motion.declination_is_stated = true;
}

RecordedMotion thinned(RecordedMotion motion, double interval_s) {
  constexpr double kRounding_s = 1e-3;
  for (std::vector<Reading>& readings : motion.channels) {
    double next_s = -std::numeric_limits<double>::infinity();
    std::erase_if(readings, [&](const Reading& reading) {
      if (reading.time_s < next_s) return true;
      next_s = reading.time_s + interval_s - kRounding_s;
      return false;
    });
  }
  return motion;
}

RecordedMotion motion_of(std::span<const instruments::Sample> samples, std::int64_t begin_ns,
                         const config::Settings& settings, const devices::InstrumentModel& instruments) {
  MotionGatherer gatherer(settings, instruments);
  for (const instruments::Sample& sample : samples) gatherer.on_sample(sample);
  return gatherer.take(begin_ns);
}

RecordedMotion load_motion(const std::filesystem::path& file, const std::function<void(double)>& progress,
                           const std::optional<config::Settings>& stated, const record::TimeWindow& window) {
  const auto recording = record::Recording::open(file, window);
  const config::Settings settings = gap::samples_only(stated ? *stated : recording->settings());
  const record::PortMatch ports(recording->settings(), settings);
  const devices::InstrumentModel model = devices::without_mounting(devices::instrument_model(settings));
  pipeline::Pipeline pipeline(settings);
  MotionGatherer gatherer(settings, model);
  std::optional<std::int64_t> begin_ns;
  std::vector<std::int64_t> orders_ns;
  std::vector<std::array<double, 3>> ordered_fins_rad;
  std::optional<protocols::motor_card::Command> last_order;
  while (const auto entry = recording->next()) {
    ports.give(*entry, pipeline, gatherer);
    const auto* const raw = std::get_if<record::RawRead>(&*entry);
    if (raw != nullptr && !begin_ns) begin_ns = raw->time_ns;
    // A repeated order moves nothing.
    if (const auto order = record::sent_command(*entry); order && order != last_order) {
      orders_ns.push_back(raw->time_ns);
      ordered_fins_rad.push_back(gap::order_of(*order, 0).fins_rad);
      last_order = order;
    }
    progress(recording->progress());
  }
  RecordedMotion motion = gatherer.take(begin_ns.value_or(0));
  motion.name = file.string();
  for (const std::int64_t time_ns : orders_ns)
    motion.order_times_s.push_back(static_cast<double>(time_ns - *begin_ns) * 1e-9);
  motion.ordered_fins_rad = std::move(ordered_fins_rad);
  for (std::string& remark : ports.remarks(motion.name)) motion.remarks.push_back(std::move(remark));
  motion.remarks.insert(motion.remarks.end(), recording->remarks().begin(), recording->remarks().end());
  return motion;
}

}  // namespace navcal::identify
