// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "web/http.h"
#include "web/hub.h"
#include "web/live_source.h"
#include "web/outlets/exposition.h"
#include "web/server.h"

namespace navcal::web {

/// The newest lines of a report that navcald cuts into several (`part` and `parts`), in their order.
class LatestParts {
 public:
  void take(nlohmann::json part) {
    const auto whole = [&part](const char* key) {
      const auto found = part.find(key);
      return found != part.end() && found->is_number_unsigned() ? found->get<std::size_t>() : std::size_t{1};
    };
    const std::size_t number = whole("part"), count = whole("parts");
    if (number < 1 || number > count || count > kMaxParts) return;
    parts_.resize(count);
    parts_[number - 1] = std::move(part);
  }
  void forget() { parts_.clear(); }
  /// Those that have not come yet are null.
  [[nodiscard]] const std::vector<nlohmann::json>& parts() const { return parts_; }

 private:
  static constexpr std::size_t kMaxParts = 64;
  std::vector<nlohmann::json> parts_;
};

/// State of navcald and of this program for Prometheus. While there is no connection to navcald, only
/// `navcald_up 0` is told about it.
class Metrics final : public Subscriber {
 public:
  explicit Metrics(Hub& hub);
  ~Metrics() override;
  Metrics(const Metrics&) = delete;
  Metrics& operator=(const Metrics&) = delete;

  /// From now on these are told, too. They must live as long as this object is asked.
  void watch(const ServerCounters& server, const LiveSource::Counters& source) {
    server_ = &server;
    source_ = &source;
  }

  void watch(std::function<void(Exposition&)> more) { more_ = std::move(more); }

  /// The whole page in Prometheus' text format.
  [[nodiscard]] std::string page() const;
  [[nodiscard]] Handler handler() const;

  void on_record(const Record& record) override;
  void on_link(const Link& link) override;

 private:
  void append_daemon(Exposition& out) const;
  void append_program(Exposition& out) const;

  Hub& hub_;
  const ServerCounters* server_ = nullptr;
  const LiveSource::Counters* source_ = nullptr;
  std::function<void(Exposition&)> more_;
  LatestParts health_, calibration_;
  nlohmann::json time_, navigation_;
  std::map<std::string, nlohmann::json, std::less<>> batteries_;  ///< by device
  std::map<std::string, std::uint64_t, std::less<>> events_;      ///< by severity
};

}  // namespace navcal::web
