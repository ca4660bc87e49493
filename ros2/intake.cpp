// SPDX-License-Identifier: Apache-2.0
#include "ros2/intake.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <cstdio>
#include <tuple>
#include <utility>

#include "ports/no_throw.h"

namespace navcal::ros2 {
namespace asio = boost::asio;
using ports::kNoThrow;
namespace {

/// In the order of kKinds.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kTypes{
    {{"imu", "sensor_msgs/msg/Imu"},
     {"mag", "sensor_msgs/msg/MagneticField"},
     {"pressure", "sensor_msgs/msg/FluidPressure"},
     {"fix", "sensor_msgs/msg/NavSatFix"},
     {"twist", "geometry_msgs/msg/TwistWithCovarianceStamped"}}};
constexpr std::size_t kMaxWaiting = 256 << 10;
constexpr auto kRetry = std::chrono::milliseconds(500);

}  // namespace

std::optional<Source> read_source(std::string_view text) {
  const auto name = text.substr(0, text.find('='));
  const auto known =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& one) { return one.first == name; });
  const std::string topic(text.substr(std::min(name.size() + 1, text.size())));
  if (known == kTypes.end() || !is_topic(topic)) return std::nullopt;
  return Source{analysis::ros::message_type(known->second), {topic}};
}

Intake::Intake(const asio::any_io_executor& executor, std::string port, std::list<Source> sources)
    : port_(std::move(port)), socket_(executor), wake_(executor), sources_(std::move(sources)) {}

void Intake::start(Participant& participant) {
  for (Source& source : sources_) {
    participant.add_reader(source.topic.name, *protocols::ros2::written_type(source.type->name),
                           [this, &source](std::string_view cdr) { take(source, cdr); });
  }
  if (!sources_.empty()) asio::co_spawn(socket_.get_executor(), run(), asio::detached);
}

void Intake::take(Source& source, std::string_view cdr) {
  using namespace std::chrono;
  const auto now_ns = duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
  const std::lock_guard lock(mutex_);
  if (source.type->decode(cdr, source.topic, now_ns, *this)) {
    ++source.taken;
  } else if (std::has_single_bit(++source.refused)) {
    fmt::print(stderr, "navcal-ros2: {}: not a whole {}, {} so far\n", source.topic.name, source.type->name,
               source.refused);
  }
}

void Intake::sample(const analysis::ImportedSample& sample, protocols::samples_line::LineWriter& line) {
  if (sample.utc_ns) line.seconds("time", *sample.utc_ns);
  const std::string text = line.finish();
  if (!connected_ || waiting_.size() + text.size() > kMaxWaiting) {
    ++lost_;
    return;
  }
  if (waiting_.empty()) asio::post(wake_.get_executor(), [this] { wake_.cancel(); });
  waiting_ += text;
}

std::string Intake::summary() {
  const std::lock_guard lock(mutex_);
  std::string text = "taken";
  for (const Source& source : sources_)
    text += fmt::format(" {} {} ({} refused),", source.topic.name, source.taken, source.refused);
  return text + fmt::format(" {} samples lost", lost_.load());
}

std::string Intake::next(bool connected) {
  const std::lock_guard lock(mutex_);
  connected_ = connected;
  return std::exchange(waiting_, {});
}

asio::awaitable<void> Intake::run() {
  for (std::string told, lines;;) {
    auto [error] = co_await socket_.async_connect({port_}, kNoThrow);
    std::string now = error ? error.message() : "connected";
    if (told != now) fmt::print(stderr, "navcal-ros2: {}: {}\n", port_, now);
    told = std::move(now);
    while (!error) {
      lines = next(true);
      wake_.expires_after(std::chrono::hours(1));
      if (lines.empty()) {
        co_await wake_.async_wait(kNoThrow);
      } else {
        std::tie(error, std::ignore) = co_await asio::async_write(socket_, asio::buffer(lines), kNoThrow);
      }
    }
    lines += next(false);
    lost_ += static_cast<std::uint64_t>(std::count(lines.begin(), lines.end(), '\n'));
    lines.clear();
    socket_.close(error);
    wake_.expires_after(kRetry);
    co_await wake_.async_wait(kNoThrow);
  }
}

}  // namespace navcal::ros2
