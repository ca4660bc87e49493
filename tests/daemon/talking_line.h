// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "tests/daemon/daemon_process.h"

namespace navcal::daemon {

/// A compass and a receiver that speak on one line, ten times a second, until the test is over.
class TalkingLine {
 public:
  enum class Fixes { good, none };

  explicit TalkingLine(const FakeLine& line, Fixes fixes = Fixes::good)
      : thread_([this, &line, fixes] {
          for (int i = 0; !over_; i = (i + 1) % 60) {
            char second[16];
            std::snprintf(second, sizeof second, "%02d", i);
            if (fixes == Fixes::good) {
              line.sentence("GPRMC,1200" + std::string(second) +
                            ".00,A,5742.7698,N,01201.3554,E,1.31,10.0,211126,,,A");
              line.sentence("GPGGA,1200" + std::string(second) +
                            ".00,5742.7698,N,01201.3554,E,1,08,1.01,49.4,M,37.0,M,,");
              line.sentence("GPGSA,A,3,05,07,09,13,18,21,27,30,,,,,1.94,1.01,1.66");
              line.sentence("GPGSV,1,1,02,05,43,174,44,07,58,213,46");
            } else {
              line.sentence("GPRMC,1201" + std::string(second) + ".00,V,,,,,,,211126,,,N");
              line.sentence("GPGGA,1201" + std::string(second) + ".00,,,,,0,00,,,M,,M,,");
            }
            line.sentence("PTNTHTM,123.4,N,1.5,N,-2.5,N,60.0,2454");
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
          }
        }) {}
  ~TalkingLine() {
    over_ = true;
    thread_.join();
  }
  TalkingLine(const TalkingLine&) = delete;
  TalkingLine& operator=(const TalkingLine&) = delete;

 private:
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace navcal::daemon
