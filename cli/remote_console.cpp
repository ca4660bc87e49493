// SPDX-License-Identifier: Apache-2.0
#include "cli/remote_console.h"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/printable.h"
#include "cli/remote_text.h"
#include "cli/watch_text.h"

namespace navcal::cli {
namespace {

constexpr std::string_view kRemoteHelp =
    "lease            take charge of the motor\n"
    "order RPM A B C  shaft speed and three fin angles in degrees, repeated until the next one\n"
    "stop             the safe state at once; ends every lease, whoever holds it\n"
    "release          gives the own lease back, with the same effect\n"
    "status           what navcald says of itself\n"
    "send {JSON}      any line of the control socket\n"
    "quit             stop, and end";

/// The first two rows are the picture, the others scroll.
constexpr const char* kBeginScreen = "\033[2J\033[3r\033[3;1H";
constexpr const char* kEndScreen = "\033[r\033[999;1H\n";

std::string first_word(std::string_view line) {
  std::istringstream words{std::string(line)};
  std::string word;
  words >> word;
  return word;
}

}  // namespace

RemoteConsole::RemoteConsole(RemoteOperator& remote, Picture picture) : remote_(remote), picture_(picture) {
  if (picture_ == Picture::terminal) put(kBeginScreen);
  remote_.on_notice = [this](std::string_view words) { say(words); };
}

RemoteConsole::~RemoteConsole() {
  remote_.on_notice = [](std::string_view) {};
  if (picture_ == Picture::terminal) put(kEndScreen);
}

void RemoteConsole::put(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void RemoteConsole::say(std::string_view words) {
  put((picture_ == Picture::json ? nlohmann::json{{"class", "NOTICE"}, {"text", words}}.dump()
                                 : std::string(words)) +
      "\n");
}

bool RemoteConsole::give_order(std::string_view line) {
  std::istringstream words{std::string(line)};
  std::string name;
  double shaft_rpm = 0;
  std::array<double, 3> fins_deg{};
  words >> name >> shaft_rpm >> fins_deg[0] >> fins_deg[1] >> fins_deg[2];
  std::string rest;
  if (!words || words >> rest) {
    say("order needs four numbers: shaft speed in rpm and three fin angles in degrees");
    return false;
  }
  if (remote_.order(shaft_rpm, fins_deg)) return true;
  say("nobody is in charge: type lease, and wait for its ok");
  return false;
}

bool RemoteConsole::take(std::string_view line) {
  const std::string word = first_word(line);
  if (word.empty()) return true;
  if (word == "quit") return false;
  if (word == "lease") {
    remote_.lease();
  } else if (word == "order") {
    (void)give_order(line);
  } else if (word == "stop") {
    remote_.stop();
  } else if (word == "release") {
    remote_.release();
  } else if (word == "status") {
    if (!remote_.host().request(R"({"command":"status"})")) say("there is no session yet");
  } else if (word == "send") {
    const auto begin = line.find('{');
    if (begin == std::string_view::npos || !remote_.host().request(line.substr(begin)))
      say("send needs an object of JSON and a session");
  } else {
    say(kRemoteHelp);
  }
  return true;
}

void RemoteConsole::show_report(const link::Host::NewReport& report) {
  const auto quality = remote_.host().quality();
  const bool is_alive = remote_.is_alive();
  if (picture_ == Picture::json) {
    put(json_of(report, quality, is_alive) + "\n");
  } else {
    const std::string state = words_of(report.report);
    const std::string link =
        words_of(quality, is_alive) + (report.is_verified ? "" : "; reports are not authenticated");
    if (picture_ == Picture::terminal) {
      put(fmt::format("\0337\033[1;1H\033[?7l\033[2K{}\033[2;1H\033[2K{}\033[?7h\0338", state, link));
    } else {
      if (RemoteOperator::Clock::now() < next_line_) return;
      next_line_ = RemoteOperator::Clock::now() + std::chrono::milliseconds(900);
      put(state + "; " + link + "\n");
    }
  }
}

void RemoteConsole::show() {
  if (const auto report = remote_.host().take_report()) show_report(*report);
  if (const auto answer = remote_.take_answer()) {
    if (picture_ == Picture::json) {
      const bool is_ok = *answer == "ok";
      nlohmann::ordered_json out{{"class", "ANSWER"}, {"ok", is_ok}};
      if (!is_ok) out["error"] = base::printable(*answer);
      put(out.dump() + "\n");
    } else {
      say(base::printable(*answer));
    }
  }
  while (auto response = remote_.host().take_response()) {
    while (response->ends_with('\n')) response->pop_back();
    if (picture_ == Picture::json) {
      auto parsed = nlohmann::ordered_json::parse(*response, nullptr, false);
      if (parsed.is_discarded()) parsed = base::printable(*response);
      put(nlohmann::ordered_json{{"class", "RESPONSE"}, {"response", std::move(parsed)}}.dump() + "\n");
    } else {
      say(base::printable(*response));
    }
  }
}

}  // namespace navcal::cli
