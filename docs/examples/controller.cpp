// SPDX-License-Identifier: Apache-2.0
// A controller in a page: holds a heading at a constant shaft speed for some seconds.
//
//   g++ -std=c++20 -o controller docs/examples/controller.cpp
//   ./controller /run/navcal/control 2947 HEADING_DEG RPM SECONDS
//
// It takes a lease of the motor, answers each STATE of navcald with an order, ten times a second, and releases the
// lease. It ends with status 1, and says why, when an order is refused. See docs/control.md. JSON is read with
// nlohmann-json (Debian: nlohmann-json3-dev).
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <string>

namespace {

using Json = nlohmann::json;

constexpr double kTimeout_s = 2;
constexpr double kProportional = 0.6;  // degrees of rudder for a degree of heading
constexpr double kDamping_s = 0.5;     // degrees of rudder for a degree a second
constexpr double kMostRudder_deg = 15;

/// A connected socket, line by line.
class Lines {
 public:
  explicit Lines(int socket) : socket_(socket) {}
  ~Lines() { ::close(socket_); }
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;

  template <class Address>
  void connect(const Address& address) {
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("navcald does not answer");
  }
  void send(const std::string& text) {
    if (::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(text.size()))
      throw std::runtime_error("navcald has closed the connection");
  }
  Json next() {
    for (;;) {
      if (const auto end = bytes_.find('\n'); end != std::string::npos) {
        const Json line = Json::parse(bytes_.substr(0, end));
        bytes_.erase(0, end + 1);
        return line;
      }
      std::array<char, 4096> chunk{};
      const ssize_t n = ::recv(socket_, chunk.data(), chunk.size(), 0);
      if (n <= 0) throw std::runtime_error("navcald has closed the connection");
      bytes_.append(chunk.data(), static_cast<std::size_t>(n));
    }
  }

 private:
  int socket_;
  std::string bytes_;
};

/// One request of the control socket, and its answer.
Json ask(Lines& control, const Json& request) {
  control.send(request.dump() + "\n");
  Json answer = control.next();
  if (answer.at("ok") != true) {
    throw std::runtime_error(request.at("command").get<std::string>() + ": " +
                             answer.at("error").get<std::string>());
  }
  return answer;
}

/// Positive turns to starboard. Without a heading the rudder stays amidships.
double rudder_deg(const Json& state, double wanted_rad) {
  if (state.at("heading_rad").is_null()) return 0;
  const double error_rad =
      std::remainder(wanted_rad - state.at("heading_rad").get<double>(), 2 * std::numbers::pi);
  const double rate_rad_s = state.at("rate_rad_s").is_null() ? 0 : state.at("rate_rad_s").at(2).get<double>();
  const double rudder_rad = kProportional * error_rad - kDamping_s * rate_rad_s;
  return std::clamp(rudder_rad * 180 / std::numbers::pi, -kMostRudder_deg, kMostRudder_deg);
}

void steer(const char* control_path, std::uint16_t status_port, double heading_rad, double rpm, double seconds) {
  Lines control(::socket(AF_UNIX, SOCK_STREAM, 0));
  sockaddr_un control_address{};
  control_address.sun_family = AF_UNIX;
  std::string(control_path).copy(control_address.sun_path, sizeof control_address.sun_path - 1);
  control.connect(control_address);
  Lines status(::socket(AF_INET, SOCK_STREAM, 0));
  sockaddr_in status_address{};
  status_address.sin_family = AF_INET;
  status_address.sin_port = htons(status_port);
  status_address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  status.connect(status_address);
  status.send(R"(?WATCH={"enable":true,"json":true,"classes":["STATE"],"rate_Hz":{"STATE":10}};)"
              "\n");

  const Json lease =
      ask(control,
          {{"command", "motor.lease"}, {"holder", "example-cpp"}, {"priority", 1}, {"timeout_s", kTimeout_s}})
          .at("lease");
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  int orders = 0;
  double latest_s = 0;
  while (std::chrono::steady_clock::now() < end) {
    const Json state = status.next();
    if (state.at("class") == "ERROR") throw std::runtime_error(state.at("message").get<std::string>());
    if (state.at("class") != "STATE") continue;
    const double rudder = rudder_deg(state, heading_rad);
    ask(control, {{"command", "motor.order"},
                  {"lease", lease},
                  {"shaft_rpm", rpm},
                  {"fins_deg", {-rudder, rudder / 2, rudder / 2}},
                  {"state_time", state.at("time")}});
    ++orders;
    if (const Json& late_s = state.at("order").at("late_s"); !late_s.is_null())
      latest_s = std::max(latest_s, late_s.get<double>());
  }
  ask(control, {{"command", "motor.release"}, {"lease", lease}});
  std::printf("%d orders, the latest %.1f ms after its state\n", orders, latest_s * 1000);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fputs("usage: controller CONTROL_SOCKET STATUS_PORT HEADING_DEG RPM SECONDS\n", stderr);
    return 2;
  }
  try {
    steer(argv[1], static_cast<std::uint16_t>(std::atoi(argv[2])), std::atof(argv[3]) * std::numbers::pi / 180,
          std::atof(argv[4]), std::atof(argv[5]));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "controller: %s\n", error.what());
    return 1;
  }
}
