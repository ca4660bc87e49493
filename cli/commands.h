#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>

namespace navcal::cli {

/// Exit statuses of every command (docs/cli.md).
enum class Exit : int { success = 0, failed = 1, usage = 2, bad_input = 3 };

/// Ends a command: the message goes to standard error, the status to the shell.
class Failure : public std::runtime_error {
 public:
  Failure(Exit status, const std::string& message) : std::runtime_error(message), status_(status) {}
  [[nodiscard]] Exit status() const { return status_; }

 private:
  Exit status_;
};

// One file per subcommand; each adds itself to the application with its options, help and example. The callback
// runs the command and throws Failure when it cannot.
void add_calibrate(CLI::App& app);
void add_completion(CLI::App& app);
void add_decode(CLI::App& app);
void add_doctor(CLI::App& app);
void add_emulate(CLI::App& app);
void add_field(CLI::App& app);
void add_gap(CLI::App& app);
void add_log(CLI::App& app);
void add_play(CLI::App& app);
void add_ports(CLI::App& app);
void add_replay(CLI::App& app);
void add_simulate(CLI::App& app);
void add_watch(CLI::App& app);

}  // namespace navcal::cli
