// SPDX-License-Identifier: Apache-2.0
#include "sim/truth.h"

#include <fmt/format.h>

#include <iterator>

namespace navcal::sim {

void begin_truth(std::string& out) { out += "t,x,y,z,phi,theta,psi,u,v,w,p,q,r,rpm,fin1,fin2,fin3\n"; }

void append_truth(std::string& out, double time_s, const State& state) {
  auto to = std::back_inserter(out);
  fmt::format_to(to, "{:.9g}", time_s);
  for (const auto* vector : {&state.position_m, &state.euler_rad, &state.velocity_body_m_s, &state.rate_rad_s}) {
    fmt::format_to(to, ",{:.9g},{:.9g},{:.9g}", (*vector)[0], (*vector)[1], (*vector)[2]);
  }
  fmt::format_to(to, ",{:.9g},{:.9g},{:.9g},{:.9g}\n", state.rpm, state.fins_rad[0], state.fins_rad[1],
                 state.fins_rad[2]);
}

}  // namespace navcal::sim
